// SPDX-License-Identifier: MIT
#include "cli/bounds.hpp"

#include <vector>

#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"

namespace stipple::cli {
namespace {

/// The box of the points' extremes.
Box extremes_of(const PointSet& points) {
    const std::vector<double> first(points[0].begin(), points[0].end());
    return bounding_box(points.flat(), {first, first});
}

/// The same, with a direction that has no extent made as wide as 1.
Box box_around(const PointSet& points) {
    Box box = extremes_of(points);
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (!(box.high[k] > box.low[k])) box.high[k] = box.low[k] + 1;
    return box;
}

void require_inside(std::span<const double> rows, std::size_t width, const Box& box,
                    std::uint64_t first) {
    const DomainPtr domain = box_domain(box);
    const std::size_t d = box.dimension();
    for (std::size_t i = 0; i < rows.size(); i += width)
        if (!domain->contains(rows.subspan(i, d)))
            fail(ErrorKind::input, "point {} is outside the bounds {}", first + i / width,
                 format_box(box));
}

void into_unit_cube(std::span<double> rows, std::size_t width, const Box& box) {
    const DomainPtr domain = box_domain(box);
    const std::size_t d = box.dimension();
    for (std::size_t i = 0; i < rows.size(); i += width)
        domain->to_cube(rows.subspan(i, d), rows.subspan(i, d));
}

}  // namespace

void require_width(const PointSet& points, const std::string& input) {
    constexpr double most = 1e307;  // and room for margins around
    const Box box = extremes_of(points);
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (box.low[k] < -most || box.high[k] > most)
            fail(ErrorKind::input,
                 "{}the box around the points is too wide for float64: x{} goes from {} to {}",
                 input.empty() ? "" : (input == "-" ? "stdin" : input) + ": ", k + 1,
                 format_number(box.low[k]), format_number(box.high[k]));
}

void take_bounds(std::span<double> rows, std::size_t width, const Box& box, std::uint64_t first,
                 const Analyzer& analyzer) {
    require_inside(rows, width, box, first);
    if (analyzer.traits.unit_cube) into_unit_cube(rows, width, box);
}

DomainPtr domain_of(const io::PointStream& stream, std::size_t d, const Analyzer& analyzer,
                    const Arguments& arguments, const RunContext& run) {
    if (const auto bounds = arguments.get("bounds"))
        return analyzer.traits.unit_cube ? unit_cube(d) : box_domain(parse_box(*bounds, d));
    if (const auto named = arguments.get("domain")) return parse_domain(*named, d);
    return input_domain(stream.provenance(), d, arguments, run);
}

void check_bounds(const Arguments& arguments) {
    for (const char* other : {"rescale", "domain"})
        if (arguments.has("bounds") && arguments.has(other))
            fail(ErrorKind::usage, "--bounds and --{}: give one of them", other);
}

namespace {

/// @throws Error(input) for points outside the box.
PointSet to_unit_cube(PointSet points, const Box& box) {
    require_inside(points.flat(), box.dimension(), box, 0);
    into_unit_cube(points.flat(), box.dimension(), box);
    points.domain = unit_cube(points.dimension());
    return points;
}

}  // namespace

PointSet of_the_cube(PointSet points, const Analyzer& analyzer) {
    const std::string domain = points.domain->spec();
    const auto outside = [](double x) { return !(x >= 0 && x <= 1); };
    if (!analyzer.traits.unit_cube || domain == "unit-cube" ||
        (domain.starts_with("box") &&
         points.domain->bounding_box() == unit_cube(points.dimension())->bounding_box()) ||
        std::ranges::any_of(points.flat(), outside))  // which is said with the first of them
        return points;
    fail_with_hint(ErrorKind::input,
                   "--rescale or --bounds lo..hi moves points into the cube; --domain unit-cube "
                   "takes them as they are",
                   "{} measures points against the unit cube; the domain of these is {}",
                   analyzer.name, domain);
}

PointSet prepared(PointSet points, const Analyzer& analyzer, const Arguments& arguments) {
    const auto bounds = arguments.get("bounds");
    check_bounds(arguments);
    if (const auto domain = arguments.get("domain"))
        points.domain = parse_domain(*domain, points.dimension());
    if (bounds) {
        const Box box = parse_box(*bounds, points.dimension());
        if (analyzer.traits.unit_cube) return to_unit_cube(std::move(points), box);
        require_inside(points.flat(), box.dimension(), box, 0);
        points.domain = box_domain(box);
        return points;
    }
    if (arguments.has("rescale")) {
        require_width(points);
        const Box box = box_around(points);
        return to_unit_cube(std::move(points), box);
    }
    return of_the_cube(std::move(points), analyzer);
}

}  // namespace stipple::cli
