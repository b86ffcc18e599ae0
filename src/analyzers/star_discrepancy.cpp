// SPDX-License-Identifier: MIT
//
// Star discrepancy of n points in the unit cube, exact:
//
//     D* = sup over c in [0,1]^d of  | #{points in [0,c)} / n  -  vol [0,c) |.
//
// It is reached or approached at corners c made of point coordinates and 1, once with the box open
// (too few points inside) and once with it closed (too many), so both are counted:
//
//     D* = max over c of  max( vol(c) - #{x < c} / n,  #{x <= c} / n - vol(c) ).
//
// --boxes half-open takes the first line at its word: points with a coordinate 1 are in no box.
//
// Shape   points n x d in [0, 1];  result in [1/(2n), 1], a pure number, smaller is more even.
// Cost    d = 1: O(n log n). d = 2: O(n^(4/3)) time in practice and O(n) memory, 65 bytes a point
//         with the points; 2^16 points take 0.04 s, 10^6 0.8 s and 10^7 17 s on one core.
//         d > 2: exponential in d at worst (the problem is NP-hard); branch and bound, which gives
//         up after --max-work.
// Promise exact: counts are integers, boxes are compared without rounding, and the value is the
//         double nearest to that of the worst box. Never depends on the number of threads.
// Beware  coordinates are taken as the doubles that they are: 0.1 is a little more than 1/10.
// Source  C. Doerr, M. Gnewuch, M. Wahlstroem, "Calculation of discrepancy measures and
//         applications", arXiv:1405.1653 (survey); M. Gnewuch, A. Srivastav, C. Winzen, J.
//         Complexity 25 (2009) 115-127 (NP-hard).

#include "analyzers/analyzer.hpp"
#include "analyzers/extreme_discrepancy.hpp"
#include "analyzers/star_ascent.hpp"
#include "analyzers/star_families.hpp"
#include "analyzers/star_search.hpp"
#include "analyzers/star_sweep.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::analyzers {
namespace {

constexpr Param<std::int64_t> max_work{
    .name = "max-work",
    .fallback = 100'000'000'000,
    .low = 1,
    .unit = "comparisons",
    .help =
        "Give up when branch and bound (3 and more dimensions) has compared this many "
        "coordinates; 10^9 take about two seconds on one core"};

constexpr Param<Choice> boxes{
    .name = "boxes",
    .fallback = "closed",
    .choices = "closed|half-open",
    .help =
        "Whether boxes that end at 1 are closed there, or half-open as all others; they differ "
        "for points with a coordinate 1"};

/// More points than any machine's memory holds; counts of points stay far from 2^31.
constexpr std::size_t max_count = std::size_t{1} << 29;

Report report(const star::WorstBox& worst, const char* method) {
    Report box;
    box.add("corner", worst.corner());
    box.add("closed", worst.side() == star::Side::closed);
    box.add("points", worst.points());
    box.add("volume", worst.volume());
    Report results;
    results.add("value", worst.value());
    results.add("lower", worst.value());
    results.add("upper", worst.value());
    results.add("exact", true);
    results.add("method", method);
    results.add("worst_box", std::move(box));
    return results;
}

Report search_for_it(const star::CornerGrid& grid, std::int64_t work, const RunContext& run) {
    const star::SearchResult found =
        star::search(grid, star::ascend(grid, run), static_cast<std::uint64_t>(work), run);
    if (found.complete) return report(found.worst, "branch-and-bound");
    fail_with_hint(ErrorKind::limit,
                   "a larger --max-work, or fewer points, may give the exact value",
                   "the star discrepancy of {} points in {} dimensions takes more than {} "
                   "comparisons (--max-work); certain so far: it is between {} and {}",
                   grid.count, grid.dimension(), work, format_number(found.worst.value()),
                   format_number(found.upper));
}

Report measure(const PointSet& points, const Values& options, const RunContext& run) {
    if (points.count() == 0) fail(ErrorKind::input, "star-discrepancy needs at least one point");
    if (points.count() > max_count)
        fail(ErrorKind::limit, "star-discrepancy takes up to {} points; these are {}", max_count,
             points.count());
    if (options[extreme::kind] != "star" && options.given(boxes))
        fail(ErrorKind::usage, "--boxes is of --kind star");
    if (options[extreme::kind] != "star")
        return extreme::discrepancy(
            points, options[extreme::kind] == "extreme" ? extreme::Space::cube : extreme::Space::torus,
            static_cast<std::uint64_t>(options[max_work]), run);
    run.need_memory(static_cast<double>(points.count()) *
                        (static_cast<double>(points.dimension() * star::axis_bytes) + 32),
                    "the star discrepancy's grid of corners");
    const star::CornerGrid grid = star::corner_grid(
        points, run, options[boxes] == "closed" ? star::Boxes::closed : star::Boxes::half_open);
    if (grid.dimension() == 1) return report(star::sweep_1d(grid, run), "sweep-1d");
    if (grid.dimension() == 2) return report(star::sweep_2d(grid, run), "sweep-2d");
    return search_for_it(grid, options[max_work], run);
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    if (!star::wants_families(options)) return measure(points, options, run);
    const auto one = [&options](const PointSet& part, const RunContext& part_run) {
        return measure(part, options, part_run);
    };
    return star::families(points, options, one, run);
}

}  // namespace

Analyzer star_discrepancy() {
    return {
        .name = "star-discrepancy",
        .summary = "Star discrepancy, exact, with the worst box",
        .source = "Doerr, Gnewuch, Wahlstroem 2014, arXiv:1405.1653",
        .traits = {.max_dimension = 10'000},
        .options = Schema(extreme::kind, boxes, max_work, star::prefixes, star::every, star::projections),
        .results = {{"value", "the star discrepancy"},
                    {"lower", "it is at least this"},
                    {"upper", "it is at most this"},
                    {"exact", "whether the two bounds are the same"},
                    {"method", "sweep-1d, sweep-2d or branch-and-bound"},
                    {"worst_box.corner", "upper corner of the box where it is reached"},
                    {"worst_box.lower_corner",
                     "lower corner, for the kinds extreme and periodic; where it is above the "
                     "upper one, the box wraps",
                     false},
                    {"worst_box.closed", "whether points on the box's upper faces count"},
                    {"worst_box.points", "points in that box"},
                    {"worst_box.volume", "its volume"},
                    {"prefixes.count", "points of each prefix", false},
                    {"prefixes.value", "its star discrepancy", false},
                    {"prefixes.lower", "which is at least this", false},
                    {"prefixes.upper", "and at most this", false},
                    {"projections.axis_1", "first axis of each projection, from 1", false},
                    {"projections.axis_2", "the second, and so on", false},
                    {"projections.value", "its star discrepancy", false},
                    {"projections.lower", "which is at least this", false},
                    {"projections.upper", "and at most this", false},
                    {"projections.is_worst", "1 for the first with the largest value", false},
                    {"projections.worst", "the axes of that one", false},
                    {"projections.largest", "its value", false}},
        .analyze = analyze};
}

}  // namespace stipple::analyzers
