// SPDX-License-Identifier: MIT
#include "pipeline/pipeline.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"

namespace stipple {

Found analyze(const Analyzer& analyzer, const Arrival& arrival, const NextRows& next,
              const Values& options, const RunContext& run) {
    const auto measure = accumulator_for(analyzer, arrival, options, run);
    const std::uint64_t count = add_all(*measure, arrival, next, run);
    if (count == 0)
        fail(ErrorKind::input, "{} needs at least one point; the set is empty", analyzer.name);
    return {.report = measure->report(silent(run)), .count = count};
}

std::uint64_t add_all(Accumulator& measure, const Arrival& arrival, const NextRows& next,
                      const RunContext& run) {
    const RunContext quiet = silent(run);
    std::uint64_t done = 0;
    const std::uint64_t batch = arrival_batch(arrival.dimension());
    const auto rows_at_once =
        static_cast<std::size_t>(std::min(batch, arrival.count.value_or(batch)));
    in_batches(next, rows_at_once, arrival.width(), run, [&](std::span<const double> rows) {
        measure.add(rows, quiet);
        done += rows.size() / arrival.width();
        if (arrival.count) run.tick(done, *arrival.count);
        return true;
    });
    return done;
}

std::unique_ptr<Accumulator> accumulator_for(const Analyzer& analyzer, const Arrival& arrival,
                                             const Values& options, const RunContext& run) {
    check_dimension(analyzer, arrival.dimension());
    return analyzer.accumulate(arrival, options, run);
}

PointSet generate(const Generator& generator, const Request& request, const Values& options,
                  const RunContext& run) {
    SetsToMake job{&generator, options, request};
    job.command = command_of(job);
    return GeneratedSets(std::move(job), run).made(0, run);
}

std::string way_to_cube(const PointSet& points) {
    const auto& warps = points.provenance.warps;
    const auto last = std::ranges::find_if(
        warps.rbegin(), warps.rend(), [](const auto& step) { return !step.starts_with("cut:"); });
    const std::string step = last == warps.rend() ? "" : *last;
    const std::string name = step.substr(0, step.find_first_of("@:"));
    const auto warp = std::ranges::find(warps::all(), name, &Warp::name);
    if (warp == warps::all().end() || !warp->traits.invertible)
        return "--rescale or --bounds lo..hi moves points into the cube";
    if (step.find('"') != std::string::npos)  // contains a parameter file's text
        return fmt::format(
            "--unit-cube beside --parameters leaves generated points there; 'stipple warp {} "
            "--parameters FILE --inverse' takes others back",
            name);
    const char* quote = step.find_first_of(" []") == std::string::npos ? "" : "\"";
    return fmt::format("'stipple warp {1}{0}{1} --inverse' takes them back to the cube", step,
                       quote);
}

bool in_cube(std::span<const double> row, std::span<const std::size_t> coordinates) {
    return std::ranges::all_of(coordinates,
                               [&](std::size_t k) { return row[k] >= 0 && row[k] <= 1; });
}

void require_in_cube(const PointSet& points, std::span<const std::size_t> coordinates,
                     const std::string& cube, const std::string& hint) {
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (!in_cube(points[i], coordinates) && count++ == 0) first = i;
    if (count == 0) return;
    fail_with_hint(ErrorKind::input, hint,
                   "{} of {} points are outside {}; the first is point {}: ({})", count,
                   points.count(), cube, first,
                   join(gather(points[first], points.dimension(), coordinates), ", "));
}

void require_unit_cube(const PointSet& points) {
    const std::size_t d = points.dimension();
    require_in_cube(points, named_or_all({}, d), fmt::format("the unit cube [0, 1]^{}", d),
                    "the measure is defined for the unit cube; " + way_to_cube(points));
}

void check_densities(const PointSet& points) {
    const auto& densities = points.densities;
    if (!densities.empty() && densities.size() != points.count())
        fail(ErrorKind::usage, "{} densities for {} points", densities.size(), points.count());
    for (std::size_t i = 0; i < densities.size(); ++i)
        if (!(densities[i] > 0))
            fail(ErrorKind::input, "point {}: its density is {}; expected a number above 0", i,
                 densities[i]);
}

void check_set(const PointSet& points) {
    if (points.domain && points.domain->dimension() != points.dimension())
        fail(ErrorKind::usage, "points of {} coordinates are not on {}", points.dimension(),
             points.domain->title());
    check_densities(points);
    const auto numbers = points.flat();
    for (std::size_t i = 0; i < numbers.size(); ++i)
        if (!std::isfinite(numbers[i]))
            fail(ErrorKind::input, "point {}: coordinate {} is {}; expected a finite number",
                 i / points.dimension(), i % points.dimension() + 1, numbers[i]);
}

void require_cube_domain(const PointSet& points, const Analyzer& analyzer) {
    const std::string domain = points.domain->spec();
    const auto outside = [](double x) { return !(x >= 0 && x <= 1); };
    if (!analyzer.traits.unit_cube || domain == "unit-cube" ||
        (domain.starts_with("box") &&
         points.domain->bounding_box() == unit_cube(points.dimension())->bounding_box()) ||
        std::ranges::any_of(points.flat(), outside))  // a later check reports the first such point
        return;
    fail_with_hint(ErrorKind::input,
                   way_to_cube(points) + "; --domain unit-cube takes them as they are",
                   "{} requires points of the unit cube; the domain of these is {}", analyzer.name,
                   points.domain->title());
}

Report analyze(const Analyzer& analyzer, const PointSet& points, const Values& options,
               const RunContext& run) {
    if (points.count() == 0)
        fail(ErrorKind::input, "{} needs at least one point; the set is empty", analyzer.name);
    check_dimension(analyzer, points.dimension());
    if (points.domain->dimension() != points.dimension())
        fail(ErrorKind::input, "points of the domain {} have dimension {}; these have {}",
             points.domain->title(), points.domain->dimension(), points.dimension());
    require_cube_domain(points, analyzer);
    if (analyzer.traits.unit_cube) require_unit_cube(points);
    if (analyzer.traits.densities && points.densities.empty()) {
        if (auto densities = biased_densities(points, run); !densities.empty()) {
            PointSet own = points;
            own.densities = std::move(densities);
            return analyzer.analyze(own, options, run);
        }
    }
    if (!analyzer.accumulate) return analyzer.analyze(points, options, run);
    // Analyzes the points in place: a copy would take as long as some analyzers.
    const auto measure = analyzer.accumulate({points.domain, points.count()}, options, run);
    const RunContext quiet = silent(run);
    const auto batch = static_cast<std::size_t>(arrival_batch(points.dimension()));
    for (std::size_t i = 0; i < points.count(); i += batch) {
        run.tick(i, points.count());
        const std::size_t some = std::min(batch, points.count() - i);
        measure->add(points.flat().subspan(i * points.dimension(), some * points.dimension()),
                     quiet);
    }
    run.tick(1, 1);
    return measure->report(quiet);
}

}  // namespace stipple
