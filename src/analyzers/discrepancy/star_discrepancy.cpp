// SPDX-License-Identifier: MIT
//
// Star discrepancy of n points in the unit cube, exact or, if that takes too long, between bounds
// that are certain:
//
//     D* = sup over c in [0,1]^d of  | #{points in [0,c)} / n  -  vol [0,c) |.
//
// It is reached or approached at corners c made of point coordinates and 1, once with the box open
// (too few points inside) and once with it closed (too many), so both are counted:
//
//     D* = max over c of  max( vol(c) - #{x < c} / n,  #{x <= c} / n - vol(c) ).
//
// --boxes half-open uses the first formula literally: points with a coordinate 1 are in no box.
// --kind extreme takes all boxes [a,b) in the cube, --kind periodic those of the torus, where 1 is
// 0 and each side may wrap; closed boxes count as limits of half-open ones. So D* <= extreme <= 2^d
// D* and extreme <= periodic. In one dimension, both are Kuiper's statistic.
//
// Shape   points n x d in [0, 1];  result in [1/(2n), 1], a pure number, smaller is more even;
//         other kinds in [1/n, 1].
// Cost    d = 1: O(n log n). d = 2: O(n^(4/3)) time in practice and O(n) memory, 65 bytes a point
//         with the points; 2^16 points take 0.04 s, 10^6 1 s and 10^7 20 s on one core.
//         d > 2: exponential in d at worst (the problem is NP-hard); branch and bound, which ends
//         after --max-work or --time-limit. Both are for all rows of a table together.
//         Other kinds, d = 2: branch and bound over O(n^2) cells at worst, of a few points each.
//         1024 points take 0.1 s (random) to 0.4 s (Hammersley), 4096 points 0.5 s to 9 s; the
//         periodic kind of even points takes ten times as long. d > 2: up to n^(2(d - 1)) cells;
//         1000 random points in 3-D take 10 s, 128 in 5-D 5 s. A first bound of many points in few
//         dimensions is 2^d D* (periodic: (3^d - 1) D*).
// Promise `exact` reports whether the value is: counts are integers, boxes are compared without
//         rounding, and the value is the double nearest to that of the worst box. Otherwise the
//         worst box found gives `lower`, and no box is worse than `upper`. Never depends on the
//         number of threads; depends on the machine if --time-limit ends it.
// Beware  if `exact` is false, `value` is `lower`; a --check of it must hold for both bounds.
//         Coordinates are the exact values of the doubles: 0.1 is a little more than 1/10.
// Source  C. Doerr, M. Gnewuch, M. Wahlstroem, "Calculation of discrepancy measures and
//         applications", arXiv:1405.1653 (survey); M. Gnewuch, A. Srivastav, C. Winzen, J.
//         Complexity 25 (2009) 115-127 (NP-hard). Other kinds: W. J. Morokoff, R. E. Caflisch, SIAM
//         J. Sci. Comput. 15 (1994) 1251-1279, doi:10.1137/0915077 (the measures); N. H. Kuiper,
//         Indag. Math. 22 (1960) 38-47.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "analyzers/analyzer.hpp"
#include "analyzers/discrepancy/tables.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "math/discrepancy/extreme/search.hpp"
#include "math/discrepancy/search_limits.hpp"
#include "math/discrepancy/star/search.hpp"

namespace stipple::analyzers::star_discrepancy {
namespace {

using namespace discrepancy;

constexpr Param<Choice> kind{.name = "kind",
                             .fallback = "star",
                             .choices = "star|extreme|periodic",
                             .help =
                                 "star: boxes from the origin; extreme: all axis-parallel boxes; "
                                 "periodic: boxes of the torus, which may wrap around"};

constexpr Param<Choice> boxes{.name = "boxes",
                              .fallback = "closed",
                              .choices = "closed|half-open",
                              .help =
                                  "Whether boxes that end at 1 are closed there, or half-open like "
                                  "all others; this matters only for points with a coordinate 1"};

/// Maximum number of points. Memory runs out earlier; the limit keeps counts of points within
/// 32-bit integers.
constexpr std::size_t max_count = std::size_t{1} << 29;

/// Result of a search, and its method.
struct Found {
    SearchResult result;
    const char* method = "branch-and-bound";
};

Report report(const Found& found, double tolerance, Family family) {
    const WorstBox& worst = found.result.worst;
    Report box;
    if (family >= Family::cube) box.add("lower_corner", worst.corner(&Interval::lower));
    box.add("corner", worst.corner(&Interval::upper));
    box.add("closed", worst.closed());
    box.add("points", worst.points());
    box.add("volume", worst.volume());
    return report_of(found.result, tolerance, found.method).add("worst_box", std::move(box));
}

Family family_of(const Values& options) {
    if (options[kind] == "star")
        return options[boxes] == "closed" ? Family::anchored : Family::half_open;
    if (options.given(boxes))
        fail(ErrorKind::usage, "--{} applies to --kind star only", boxes.name);
    return options[kind] == "extreme" ? Family::cube : Family::torus;
}

/// Checks memory. @throws Error(limit) naming a number of points that fits
void need_room(const PointSet& points, Family family, const RunContext& run) {
    const std::size_t d = points.dimension();
    if (family >= Family::cube)
        return run.need_memory(extreme::search_memory(points, run.thread_count()),
                               "the search for the worst box");
    const double search = d < 3 ? 0 : star::search_bytes(1, d, run.thread_count());
    const double each = static_cast<double>(d * axis_bytes(true)) + 32 + search;
    const double all = static_cast<double>(points.count()) * each;
    const double room = static_cast<double>(run.memory_left());
    if (all <= room) return;
    fail_with_hint(ErrorKind::limit,
                   fmt::format("{} points would fit; or raise the limit with --max-memory",
                               static_cast<std::uint64_t>(room / each)),
                   "the star discrepancy of {} points in {} dimensions needs {} of memory; the "
                   "limit is {}",
                   points.count(), d, format_bytes(all), format_bytes(room));
}

/// Finds the worst box in two dimensions. Returns only bounds if the sweep exceeds its share of the
/// time limit.
Found sweep_or_search(const BoxGrid& grid, const Limits& limits, const RunContext& run) {
    constexpr double part = 0.7;  // the rest is for bounds
    SearchLimits first = limits.search;
    first.deadline = limits.start + part * (first.deadline - limits.start);
    const SearchResult sweep = star::sweep_2d(grid, first, run);
    if (sweep.ending == Ending::complete) return {sweep, "sweep-2d"};
    const bool stopped = run.stop.stop_requested();
    return {star::search(grid, sweep.worst, limits.search, run),
            stopped ? "sweep-2d" : "branch-and-bound"};
}

Found search(const BoxGrid& grid, const star::Member& set, const RunContext& run) {
    if (!grid.anchored())
        return {extreme::find_worst(set.points, grid, set.limits.search, run),
                grid.dimension() == 1 ? "sweep-1d" : "branch-and-bound"};
    if (grid.dimension() == 1) return {star::sweep_1d(grid, run), "sweep-1d"};
    if (grid.dimension() == 2 && !set.limits.bounded) return sweep_or_search(grid, set.limits, run);
    return {star::find_worst(grid, set.limits.search, run, set.peers)};
}

Report measure(const star::Member& set, const Values& options, const RunContext& run) {
    const PointSet& points = set.points;
    if (points.count() == 0) fail(ErrorKind::input, "star-discrepancy needs at least one point");
    if (points.count() > max_count)
        fail(ErrorKind::limit, "star-discrepancy accepts up to {} points; these are {}", max_count,
             points.count());
    const Family family = family_of(options);
    need_room(points, family, run);
    // All processes must stop together. The search ensures that; the grid is built without stops.
    const BoxGrid grid = box_grid(points, family, set.peers != nullptr ? unstopped(run) : run);
    const Found found = search(grid, set, run);
    set.limits.judge(found.result, fmt::format("the {} discrepancy", options[kind]), points, run);
    return report(found, set.limits.search.tolerance, family);
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Limits limits(options, run);
    if (!star::wants_families(options)) return measure({points, limits}, options, run);
    const auto one = [&options](const star::Member& part, const RunContext& part_run) {
        return measure(part, options, part_run);
    };
    return star::families(points, options, limits, one, run);
}

/// Divides the search for the worst box among processes. The sweeps in one and two dimensions are
/// not divided, since that would take longer than the sweep.
Report analyze_together(const PointSet& points, const Values& options, Peers& peers,
                        const RunContext& run) {
    if (star::wants_families(options) || options[kind] != "star")
        fail(ErrorKind::usage,
             "star-discrepancy: ranks share the search of one set for the kind star only; use one "
             "process for tables and other kinds");
    const Limits limits(options, run);
    const bool sweeps = points.dimension() < 2 || (points.dimension() == 2 && !limits.bounded);
    return measure({.points = points, .limits = limits, .peers = sweeps ? nullptr : &peers},
                   options, run);
}

/// Boxes and axes cannot be averaged; the worst projection is found anew from the means.
void refine(Report& mean, std::size_t sets, const Values&) {
    if (sets < 2) return;
    drop(mean, {"worst_box"});
    auto* const item = mean.find("projections");
    if (item == nullptr) return;
    auto& table = std::get<Report>(*item);
    drop(table, {"is_worst", "worst", "worst_is_certain"});
    star::mark_worst(table);
}

std::vector<ResultKey> results() {
    std::vector<ResultKey> keys = {
        lower({"value",
               "the discrepancy of the --kind, the star discrepancy by default; present only if "
               "exact, or if the bounds are within --tolerance"}),
        {"lower", "lower bound of the discrepancy"},
        {"upper", "upper bound of the discrepancy"},
        {"exact", "whether the two bounds are equal", true, true_or_false},
        {"method", "sweep-1d, sweep-2d or branch-and-bound", true,
         "sweep-1d|sweep-2d|branch-and-bound"},
        {"worst_box.corner",
         "upper corner of the worst box found, whose discrepancy is 'lower' (among boxes from the "
         "origin, or among all boxes of the kind)"},
        {"worst_box.lower_corner",
         "its lower corner, for the kinds extreme and periodic; on an axis where it is above the "
         "upper corner, the box wraps around from 1 to 0 (an open box with both equal covers the "
         "whole axis)",
         false},
        {"worst_box.closed",
         "whether points on the faces of the box count (upper faces for the kind star)", true,
         true_or_false},
        {"worst_box.points", "number of points in that box"},
        {"worst_box.volume", "its volume"},
        {"prefixes.count", "number of points of each prefix", false}};
    const auto add_columns = [&](const std::string& table) {
        keys.push_back({table + ".value", "its star discrepancy; empty if not known", false});
        keys.push_back({table + ".lower", "lower bound of its star discrepancy", false});
        keys.push_back({table + ".upper", "upper bound of its star discrepancy", false});
        keys.push_back({table + ".exact", "1 if the two bounds are equal, else 0", false});
    };
    add_columns("prefixes");
    keys.push_back({"projections.axis_1", "first axis of each projection, from 1", false});
    keys.push_back({"projections.axis_2", "second axis, and so on", false});
    add_columns("projections");
    keys.insert(
        keys.end(),
        {{"projections.is_worst",
          "1 for the first projection with the largest value; if only bounds are known, with the "
          "largest lower bound",
          false},
         {"projections.worst", "axes of that projection", false},
         {"projections.worst_is_certain",
          "whether no other projection has an upper bound above its value", false, true_or_false},
         {"projections.largest.value", "largest value of all projections, if certain", false},
         {"projections.largest.lower", "lower bound of the largest value", false},
         {"projections.largest.upper", "upper bound of the largest value", false}});
    return keys;
}

}  // namespace

Analyzer unit() {
    return {.name = "star-discrepancy",
            .summary = "Star discrepancy, exact or with bounds, and the worst box",
            .source = "Doerr, Gnewuch, Wahlstroem 2014, arXiv:1405.1653",
            .related = {"d-star", "discrepancy", "kuipers-niederreiter"},
            .traits = {.max_dimension = 10'000},
            .options = Schema(kind, boxes, limit::method, limit::time_limit, limit::tolerance,
                              limit::max_work, star::prefixes, star::every, star::projections),
            .results = results(),
            .curves = {{"prefixes.value", "prefixes.count", "", "", "points n", true,
                        "Star discrepancy of the first n points, over n"},
                       {"prefixes.lower", "prefixes.count", "", "", "points n", true},
                       {"prefixes.upper", "prefixes.count", "", "", "points n", true}},
            .part = PagePart::discrepancy,
            .page = {{"Star discrepancy", {{"value", "Star discrepancy"}}, {{"max-work", ""}}},
                     {"Star discrepancy of prefixes",
                      {},
                      {{"max-work", ""}, {"prefixes", ""}},
                      "convergence"},
                     {"Extreme discrepancy",
                      {{"value", "Extreme discrepancy"}},
                      {{"kind", "extreme"}, {"max-work", ""}},
                      "extreme-discrepancy"},
                     {"Periodic discrepancy",
                      {{"value", "Periodic discrepancy"}},
                      {{"kind", "periodic"}, {"max-work", ""}},
                      "periodic-discrepancy"}},
            .analyze = analyze,
            .cost =
                [](double n, double d) {  // exact searches of Halton's, Sobol's and random points
                    if (d <= 2) return 3e-8 * std::pow(n, 1.33);
                    return std::min(100.0, 5e-8 * std::pow(n, d <= 8 ? 1 + d / 4 : 2.2 + d / 10));
                },
            .sharing = {.together = analyze_together},
            .refine = refine};
}

}  // namespace stipple::analyzers::star_discrepancy
