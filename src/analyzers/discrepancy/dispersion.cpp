// SPDX-License-Identifier: MIT
//
// Dispersion of n points in the unit cube: the volume of the largest axis-parallel box without a
// point inside,
//
//     value = max { vol (a,b) : no x_i in (a,b) },      (a,b) open, in [0,1]^d.
//
// On the torus (--torus), where 1 is 0, each side of a box may wrap from 1 to 0. Its lower end is
// then above its upper end, or equal to it if the side goes all the way round.
//
// Shape   points n x d in [0, 1];  result in [1/(n+1), 1].
// Cost    d = 1: O(n log n). d = 2: O((n + s) log n), where s is the number of maximal empty
//         rectangles, about n log n for random points and n^2 at worst; 10^5 random points take 0.4
//         s on one core, on the torus 0.5 s; --time-limit cuts it short.
//         d > 2: branch and bound over the boxes' sides, which stops at --max-work or --time-limit
//         with valid bounds; it grows as fast as n^(2(d - 1)) at worst. 4000 random points in
//         3-D take 0.4 s, 200 in 5-D 0.6 s.
// Promise `exact` reports whether the value is exact: boxes are compared without rounding, and the
//         value is the double nearest to the box's volume. Never depends on the number of threads.
// Beware  points on the boundary of a box are not inside. Not the covering radius, which is also
//         called dispersion: that is the analyzer coverage.
// Source  A. Naamad, D. T. Lee, W.-L. Hsu, Discrete Appl. Math. 8 (1984) 267-277,
//         doi:10.1016/0166-218X(84)90124-0 (2-D); G. Rote, R. F. Tichy, "Quasi-Monte-Carlo methods
//         and the dispersion of point sequences", Math. Comput. Modelling 23 (1996) 9-23,
//         doi:10.1016/0895-7177(96)00155-3 (the measure).

#include <algorithm>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "math/discrepancy/empty_rectangle.hpp"
#include "math/discrepancy/extreme/search.hpp"

namespace stipple::analyzers::dispersion {
namespace {

using namespace discrepancy;

constexpr Param<bool> torus{
    .name = "torus", .help = "Join opposite faces of the cube, so that boxes may wrap around"};

/// Limit beyond any machine's memory; keys of points in the planar sweep fit 32-bit integers.
constexpr std::size_t max_count = std::size_t{1} << 29;

/// Largest empty box. If the search in the plane is cut short, the upper bound is that of the
/// discrepancy for the same boxes: an empty box contributes its volume to the discrepancy.
SearchResult largest_empty_box(const BoxGrid& grid, const PointSet& points,
                               const SearchLimits& limits, const RunContext& run) {
    if (grid.dimension() != 2) return extreme::find_worst(grid, limits, run);
    SearchResult found = largest_empty_rectangle(grid, limits, run);
    if (found.ending != Ending::complete)
        found.upper = std::max(found.worst.value(), extreme::quick_bound(points, grid.family, run));
    return found;
}

const char* how(std::size_t dimension) {
    constexpr const char* names[] = {"sweep-1d", "maximal-rectangles"};
    return dimension <= 2 ? names[dimension - 1] : "branch-and-bound";
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const std::size_t d = points.dimension();
    if (points.count() > max_count)
        fail(ErrorKind::limit, "dispersion accepts up to {} points; these are {}", max_count,
             points.count());
    const Limits limits(options, run);
    const double lines = extreme::search_memory(points, d > 2 ? run.thread_count() : 0);
    run.need_memory(lines + static_cast<double>(points.count() * rectangle_bytes),
                    "the search for the largest empty box");
    const BoxGrid grid =
        box_grid(points, options[torus] ? Family::torus : Family::cube, run, Measure::emptiness);
    const SearchResult found = largest_empty_box(grid, points, limits.search, run);
    limits.judge(found, "the largest empty box", points, run);
    Report box;
    box.add("lower_corner", found.worst.corner(&Interval::lower));
    box.add("upper_corner", found.worst.corner(&Interval::upper));
    return report_of(found, limits.search.tolerance, how(d)).add("box", std::move(box));
}

/// Removes the box, which cannot be averaged.
void refine(Report& mean, std::size_t sets, const Values&) {
    if (sets > 1) drop(mean, {"box"});
}

}  // namespace

Analyzer unit() {
    return {
        .name = "dispersion",
        .summary = "Volume of the largest empty axis-parallel box, and where it is",
        .source = "Naamad, Lee, Hsu 1984, doi:10.1016/0166-218X(84)90124-0",
        .related = {"largest-empty-box"},
        .traits = {.max_dimension = 1000},
        .options =
            Schema(torus, limit::method, limit::time_limit, limit::tolerance, limit::max_work),
        .results = {lower({"value",
                           "volume of the largest empty box; present only if exact, or if the "
                           "bounds are within --tolerance"}),
                    {"lower", "volume of an empty box that was found, a lower bound"},
                    {"upper", "upper bound of the volume of all empty boxes"},
                    {"exact", "whether the two bounds are equal", true, true_or_false},
                    {"method", "sweep-1d, maximal-rectangles or branch-and-bound", true,
                     "sweep-1d|maximal-rectangles|branch-and-bound"},
                    {"box.lower_corner", "lower corner of the box found"},
                    {"box.upper_corner",
                     "its upper corner; the box wraps around on axes where this is not above the "
                     "lower corner"}},
        .part = PagePart::gaps,
        .page = {{"Dispersion", {{"value", "Dispersion: largest empty box"}}, {{"max-work", ""}}}},
        .analyze = analyze,
        .cost = [](double n, double d) { return d <= 2 ? 3e-6 * n : 1e-8 * std::pow(n, d - 1); },
        .refine = refine};
}

}  // namespace stipple::analyzers::dispersion
