// SPDX-License-Identifier: MIT
//
// Weighted sample elimination (eliminator.hpp): of M points, the most crowded ones are removed one
// by one, until N are left.
//
//     M = --ratio N points, uniform in the box, or the points of a file (--from), in any box.
//
// Only distances below 2 r_max count, the distance in the densest packing of N points: on an
// interval, 2 r_max = L / N; in the plane r_max^2 = A / (2 sqrt(3) N), in space
// r_max^3 = V / (4 sqrt(2) N), in d > 3 dimensions r_max^d = V / (N C_d), C_d the volume of the
// unit ball. The points of a file may fill a part of their box, or be on a surface:
// --manifold-dimension 2 --measure 12.566 takes d and A from the unit sphere, while distances stay
// those in space. Without these options, d and A are estimated from the points (crowd_extent() in
// eliminator.hpp), and a note reports them. If points of a file are equal, all but one of them are
// removed before any other point.
//
// --density: in the plane, the M points are distributed by the density, scaled to a mean of 1. The
// r_max of a point is divided by the root of the density at the point.
//
// --order random       the remaining points, in their original order
// --order progressive  half of the remaining points are eliminated in the same way, with r_max for
//                      the points that are left, and put at the end, the first eliminated one last;
//                      then half of the others, and so on. Every prefix is well spread.
//
// Shape   d = 1, ..., 6; distances are those in the box of --bounds, across its faces (torus) or
//         bounded. With --from they are bounded unless --torus is given; the box is --bounds, or on
//         the torus the unit cube, or else the smallest one around the points.
// Cost    2-D, ratio 5: 15 us and 450 bytes a point of the result; with a density 22 us and 650
//         bytes. A file is read three times.
// Promise exactly N points. The point of greatest weight is removed each time, the first of equals.
// Source  C. Yuksel, Comput. Graph. Forum 34 (2015) 25-32, doi:10.1111/cgf.12538.

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "core/machine/first_touch.hpp"
#include "core/text.hpp"
#include "generators/blue_noise/eliminator.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "generators/given_points.hpp"
#include "io/files.hpp"
#include "io/point_stream.hpp"
#include "math/combinatorics/draws.hpp"

namespace stipple::generators::sample_elimination {
namespace {

constexpr Param<double> ratio{
    .name = "ratio",
    .fallback = 5,
    .low = 1,
    .high = 1e6,
    .unit = "points",
    .help = "Number of random points to choose from, per point of the result"};
constexpr Param<Choice> order{
    .name = "order",
    .fallback = "random",
    .choices = "random|progressive",
    .help = "random: original order; progressive: every prefix is well spread"};
constexpr Param<Path> from{
    {.name = "from",
     .unit = "file",
     .help =
         "File of points to choose from, on any domain, instead of random ones. Default count: a "
         "fifth of them. Distances do not cross faces, except with --torus; the seed is unused"}};
constexpr Param<std::int64_t> manifold{
    .name = "manifold-dimension",
    .low = 1,
    .high = static_cast<std::int64_t>(most_directions),
    .optional = true,
    .help =
        "Dimension of the curve or surface that contains a file's points; default: estimated from "
        "their distances"};
constexpr Param<double> measure{.name = "measure",
                                .low = 0,
                                .low_open = true,
                                .optional = true,
                                .unit = "length, area, ...",
                                .help =
                                    "Length of the curve, area of the surface...; default: that of "
                                    "the box, or an estimate if the points fill less of it"};

/// All points to choose from, and the space that contains them.
struct Crowd {
    std::vector<double> rows;
    BoxSpace space;
    std::vector<double> shares = {};  ///< radius of each point as a multiple of r_max
    CrowdExtent extent = {};
    std::vector<std::uint32_t> copies = {};
};

/// For each point, the number of equal points before it; empty if all differ.
std::vector<std::uint32_t> copies_among(const std::vector<double>& rows, std::size_t d) {
    const auto row = [&](std::uint32_t i) { return std::span(rows).subspan(i * d, d); };
    std::vector<std::uint32_t> sorted(rows.size() / d);
    std::iota(sorted.begin(), sorted.end(), 0U);
    std::ranges::sort(sorted, [&](std::uint32_t i, std::uint32_t j) {
        const auto way = std::lexicographical_compare_three_way(row(i).begin(), row(i).end(),
                                                                row(j).begin(), row(j).end());
        return way < 0 || (way == 0 && i < j);
    });
    std::vector<std::uint32_t> copies(sorted.size());
    bool any = false;
    for (std::size_t k = 1; k < sorted.size(); ++k)
        if (std::ranges::equal(row(sorted[k - 1]), row(sorted[k]))) {
            copies[sorted[k]] = copies[sorted[k - 1]] + 1;
            any = true;
        }
    if (!any) copies.clear();
    return copies;
}

Plan plan_for_file(const Request& request, const Values& options) {
    if (options.given(ratio))
        fail(ErrorKind::usage,
             "--ratio applies to random points only; --from chooses from all points of the file");
    if (options.given(density_option))
        fail(
            ErrorKind::usage,
            "--density applies to random points only; the points of --from have a density already");
    const std::size_t d = io::width_of_given(from.name, options[from]);
    if (d > most_directions)
        fail(ErrorKind::input, "{}: points of {} coordinates; sample-elimination takes up to {}",
             options[from], d, most_directions);
    require_dimension(request, d, options[from]);
    Request complete = request;
    complete.dimension = d;
    if (options[manifold] > static_cast<std::int64_t>(d))
        fail(ErrorKind::usage, "--manifold-dimension: {} is above the {} coordinates of a point",
             options[manifold], d);
    Plan plan = plan_in_box(complete, options);
    if (!request.count) plan.count = 0;  // 0: a fifth of the file's points
    return plan;
}

Plan plan(const Request& request, const Values& options) {
    check_invert(options);
    if (options.given(from)) return plan_for_file(request, options);
    if (options.given(manifold) || options.given(measure))
        fail(ErrorKind::usage,
             "--manifold-dimension and --measure apply to points from a file; give --from too");
    const Plan plan = plan_in_box(request, options);
    check_density(options, plan.dimension);
    return plan;
}

/// @throws Error(input) naming the first point outside the box, if any
void check_inside(const PointSet& points, const Box& box, const std::string& file) {
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < points.dimension(); ++k)
            if (!(points[i][k] >= box.low[k] && points[i][k] <= box.high[k]))
                fail(ErrorKind::input, "{}: point {} is outside the box {}; coordinate {} is {}",
                     file, i, format_box(box), k + 1, format_number(points[i][k]));
}

Crowd crowd_of_file(const Plan& plan, const Values& options, const RunContext& run) {
    const PointSet points = io::read_given(from.name, options[from], {}, run);
    BoxSpace space = space_of(plan, options[torus_option]);
    if (plan.bounds || space.torus) {
        check_inside(points, space.box, options[from]);
    } else {
        const std::vector<double> first(points[0].begin(), points[0].end());
        space.box = bounding_box(points.flat(), {first, first});
        if (space.box.low != space.box.high)
            require_squares(space.box, ErrorKind::input, options[from]);
    }
    Crowd crowd{{points.flat().begin(), points.flat().end()}, std::move(space)};
    crowd.copies = copies_among(crowd.rows, points.dimension());
    return crowd;
}

Crowd random_crowd(const Plan& plan, const Values& options, const RunContext& run) {
    const double wanted = std::ceil(options[ratio] * static_cast<double>(plan.count));
    const bool dense = options.given(density_option);
    run.need_memory(elimination_memory(wanted, plan.dimension, dense) +
                        16 * wanted * static_cast<double>(plan.dimension + (dense ? 1 : 0)),
                    fmt::format("choosing from {:.4g} points", wanted));
    if (wanted >= 0xffff'fff0)
        fail(ErrorKind::limit,
             "--count: {} points are chosen from {:.4g}; at most 2^32 are possible, for {:.2g} "
             "points",
             plan.count, wanted, 0x1p32 / options[ratio]);
    const auto count = static_cast<std::size_t>(wanted);
    Crowd crowd{{}, space_of(plan, !options[bounded_option])};
    grow(crowd.rows, count * plan.dimension, run);
    DrawStream draws{Rng(plan.seed)};
    for (std::size_t i = 0; i < count; ++i) {
        if (i % 65536 == 0) run.check_stop();
        draws.point(crowd.space.box, crowd.rows.data() + i * plan.dimension);
    }
    if (const auto map = given_density(options, run))
        for (std::size_t i = 0; i < crowd.rows.size(); i += 2)
            crowd.shares.push_back(follow(*map, crowd.space.box, &crowd.rows[i]));
    return crowd;
}

/// Rows of the distinct points, each once.
std::vector<double> different_rows(const Crowd& crowd) {
    const std::size_t d = crowd.space.box.dimension();
    std::vector<double> rows;
    for (std::size_t i = 0; i < crowd.rows.size() / d; ++i)
        if (crowd.copies.empty() || crowd.copies[i] == 0) {
            const auto row = crowd.rows.begin() + static_cast<std::ptrdiff_t>(i * d);
            rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(d));
        }
    return rows;
}

/// Extent of a file's points: given by options; or that of their box, if filled; or estimated.
CrowdExtent extent_of_file(const Crowd& crowd, std::uint64_t kept, const Values& options,
                           const RunContext& run) {
    constexpr double most_of_it = 0.88;
    const BoxSpace& space = crowd.space;
    const std::size_t d = space.box.dimension();
    const bool said = options.given(manifold);
    const std::size_t wanted = said ? static_cast<std::size_t>(options[manifold]) : 0;
    if (options.given(measure)) return {said ? wanted : d, options[measure]};
    const CrowdExtent box{d, volume_of(space.box)};
    if (space.torus || wanted == d) return box;
    const auto rows = different_rows(crowd);
    const CrowdExtent found = crowd_extent(rows, d, wanted, run, kept);
    const bool filled =
        found.dimension == d && (rows.size() / d < 128 ||
                                 crowd_extent(rows, d, d, run).measure >= most_of_it * box.measure);
    if (filled || (found.dimension == 0 && !said)) return box;
    if (found.dimension == 0)
        fail(ErrorKind::input,
             "{}: too few different points to estimate the length, area or volume that they fill; "
             "give --measure",
             options[from]);
    run.notify(fmt::format(
        "{}: the points fill only a part of their box, of {} dimension{} and measure about {:.3g}; "
        "--manifold-dimension and --measure replace this estimate",
        options[from], found.dimension, found.dimension == 1 ? "" : "s", found.measure));
    return found;
}

double radius_for(const Crowd& crowd, std::uint64_t kept) {
    return packing_radius(static_cast<double>(kept), crowd.extent.dimension, crowd.extent.measure);
}

/// Removes copies of other points until `kept` points or no copies are left. Returns the removed
/// copies in order: those of the most frequent points first.
std::vector<std::uint32_t> take_copies(const Crowd& crowd, std::vector<std::uint32_t>& points,
                                       std::uint64_t kept) {
    std::vector<std::uint32_t> gone;
    for (const std::uint32_t i : points)
        if (!crowd.copies.empty() && crowd.copies[i] > 0) gone.push_back(i);
    std::ranges::stable_sort(gone, std::greater(),
                             [&](std::uint32_t i) { return crowd.copies[i]; });
    gone.resize(std::min<std::size_t>(gone.size(), points.size() - kept));
    auto sorted = gone;
    std::ranges::sort(sorted);
    std::erase_if(points, [&](std::uint32_t i) { return std::ranges::binary_search(sorted, i); });
    return gone;
}

/// Eliminates points (row indices) until `kept` are left. Returns the removed points, in order.
std::vector<std::uint32_t> thin(const Crowd& crowd, std::vector<std::uint32_t>& points,
                                std::uint64_t kept, const RunContext& run) {
    const std::size_t d = crowd.space.box.dimension();
    std::vector<std::uint32_t> names = take_copies(crowd, points, kept);
    if (points.size() == kept) return names;
    std::vector<double> rows;
    std::vector<double> shares;
    rows.reserve(points.size() * d);
    for (const std::uint32_t i : points) {
        const auto row = crowd.rows.begin() + static_cast<std::ptrdiff_t>(i * d);
        rows.insert(rows.end(), row, row + static_cast<std::ptrdiff_t>(d));
        if (!crowd.shares.empty()) shares.push_back(crowd.shares[i]);
    }
    const auto gone = eliminate(rows, crowd.space, radius_for(crowd, kept), kept, run, shares);
    std::vector<bool> stays(points.size(), true);
    for (const std::uint32_t i : gone) {
        stays[i] = false;
        names.push_back(points[i]);
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
        if (stays[i]) points[left++] = points[i];
    points.resize(left);
    return names;
}

/// Reorders the points so that every prefix is well spread.
void arrange(const Crowd& crowd, std::vector<std::uint32_t>& points, const RunContext& run) {
    std::vector<std::uint32_t> tail;  // eliminated points, in the reverse of their new order
    const auto done = [all = static_cast<double>(points.size())](std::size_t left) {
        return 1 - static_cast<double>(left) / all;
    };
    while (points.size() > 1) {
        const std::size_t half = points.size() / 2;
        const auto gone = thin(crowd, points, half, run.stage(done(points.size()), done(half)));
        tail.insert(tail.end(), gone.begin(), gone.end());
    }
    points.insert(points.end(), tail.rbegin(), tail.rend());
}

PointSet make(const Plan& plan, const Values& options, const RunContext& outside) {
    const RunContext run = outside.rising();
    const bool file = options.given(from);
    Crowd crowd = file ? crowd_of_file(plan, options, run) : random_crowd(plan, options, run);
    const std::size_t d = plan.dimension;
    const std::uint64_t all = crowd.rows.size() / d;
    const std::uint64_t count =
        file ? chosen_count(plan.count, std::max<std::uint64_t>(1, all / 5), all, options[from])
             : plan.count;
    crowd.extent = file ? extent_of_file(crowd, count, options, run)
                        : CrowdExtent{d, volume_of(crowd.space.box)};
    if (!(radius_for(crowd, count) > 0))
        fail_with_hint(ErrorKind::input, "give --manifold-dimension and --measure",
                       "the box around the points of {} has no volume", options[from]);
    const bool progressive = options[order] == "progressive";
    std::vector<std::uint32_t> chosen(all);
    std::iota(chosen.begin(), chosen.end(), 0U);
    thin(crowd, chosen, count, run.stage(0, progressive ? 0.7 : 1));
    if (progressive) arrange(crowd, chosen, run.stage(0.7, 1));

    std::vector<double> rows;
    rows.reserve(chosen.size() * d);
    for (const std::uint32_t i : chosen)
        rows.insert(rows.end(), crowd.rows.begin() + static_cast<std::ptrdiff_t>(i * d),
                    crowd.rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * d));
    run.tick(1, 1);
    PointSet points = set_in_box(std::move(rows), plan);
    if (file) points.domain = box_domain(crowd.space.box);
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "sample-elimination",
            .summary = "Random points without the most crowded ones (blue noise, exact count)",
            .source = "Yuksel 2015, doi:10.1111/cgf.12538",
            .related = {"blue-noise"},
            .traits = {.max_dimension = most_directions,
                       .sequence = false,
                       .prefix = false,
                       .boxed = true},
            .options = Schema(ratio, order, density_option, invert_option, from, manifold, measure,
                              torus_option, bounded_option),
            .aliases = {"weighted-sample-elimination", "yuksel"},
            .stream_version = 2,
            .plan = plan,
            .set = make,
            .uses_seed = [](const Values& options) { return !options.given(from); }};
}

}  // namespace stipple::generators::sample_elimination
