// SPDX-License-Identifier: MIT
//
// Star discrepancy of n points in the unit cube, exact, or where that takes too long, between
// bounds that are certain:
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
//         d > 2: exponential in d at worst (the problem is NP-hard); branch and bound, which ends
//         after --max-work or --time-limit.
// Promise `exact` says whether it is: counts are integers, boxes are compared without rounding, and
//         the value is the double nearest to that of the worst box. Where it is not, the worst box
//         found gives `lower`, and no box is worse than `upper`. Never depends on the number of
//         threads; depends on the machine if --time-limit ends it.
// Beware  where `exact` is false, `value` is `lower`; a --check of it must hold for both bounds.
//         Coordinates are taken as the doubles that they are: 0.1 is a little more than 1/10.
// Source  C. Doerr, M. Gnewuch, M. Wahlstroem, "Calculation of discrepancy measures and
//         applications", arXiv:1405.1653 (survey); M. Gnewuch, A. Srivastav, C. Winzen, J.
//         Complexity 25 (2009) 115-127 (NP-hard).

#include <fmt/format.h>

#include <limits>
#include <optional>

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

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "auto",
    .choices = "auto|exact|bounds",
    .help =
        "auto: exact, or where a limit comes first, certain bounds; exact: that, or an error; "
        "bounds: certain bounds that meet within --tolerance"};

constexpr Param<double> time_limit{
    .name = "time-limit",
    .low = 0,
    .low_open = true,
    .optional = true,
    .unit = "seconds",
    .help =
        "Stop after this time, in place of --max-work; what bounds it gives depends on the "
        "machine and its load, and the sorting of millions of points is not cut short; for each "
        "prefix and projection"};

constexpr Param<double> tolerance{
    .name = "tolerance",
    .low = 0,
    .optional = true,
    .help =
        "Enough if upper - lower is at most this, relative to lower [default: 0.1 for bounds, "
        "else 0]"};

constexpr Param<std::int64_t> max_work{
    .name = "max-work",
    .fallback = 100'000'000'000,
    .low = 1,
    .unit = "comparisons",
    .help =
        "Stop when branch and bound (3 and more dimensions; 2 for other kinds than star) has "
        "compared this many coordinates, the same on any machine, for each prefix and projection; "
        "10^9 take one to two seconds on one core"};

constexpr Param<Choice> boxes{
    .name = "boxes",
    .fallback = "closed",
    .choices = "closed|half-open",
    .help =
        "Whether boxes that end at 1 are closed there, or half-open as all others; they differ "
        "for points with a coordinate 1"};

/// More points than any machine's memory holds; counts of points stay far from 2^31.
constexpr std::size_t max_count = std::size_t{1} << 29;

Report report(const star::WorstBox& worst, double upper, const char* how) {
    Report box;
    box.add("corner", worst.corner());
    box.add("closed", worst.side() == star::Side::closed);
    box.add("points", worst.points());
    box.add("volume", worst.volume());
    Report results;
    results.add("value", worst.value());
    results.add("lower", worst.value());
    results.add("upper", upper);
    results.add("exact", upper == worst.value());
    results.add("method", how);
    results.add("worst_box", std::move(box));
    return results;
}

Report exact_report(const star::WorstBox& worst, const char* how) {
    return report(worst, worst.value(), how);
}

/// What the options say, for a run whose clock is at `start`.
struct Limits {
    Limits(const Values& options, const RunContext& run) : exact(options[method] == "exact") {
        const bool bounds = options[method] == "bounds";
        if (exact && options.given(tolerance))
            fail(ErrorKind::usage, "--tolerance: has no meaning with --method exact");
        search.tolerance = options.given(tolerance) ? options[tolerance] : bounds ? 0.1 : 0;
        sweeps = !bounds;
        if (!options.given(time_limit) || options.given(max_work))
            search.work = static_cast<std::uint64_t>(options[max_work]);
        if (options.given(time_limit) && run.seconds) {
            seconds = options[time_limit];
            start = run.seconds();
            search.deadline = start + seconds;
        }
    }

    star::SearchLimits search;
    bool exact;
    bool sweeps = true;
    double start = 0;
    double seconds = std::numeric_limits<double>::infinity();
};

[[noreturn]] void give_up(const star::CornerGrid& grid, const star::SearchResult& found,
                          const Limits& limits) {
    const bool time = found.ending == star::Ending::time;
    fail_with_hint(
        ErrorKind::limit,
        fmt::format("a larger {}, or fewer points, may give the exact value; --method bounds is "
                    "content with bounds",
                    time ? "--time-limit" : "--max-work"),
        "the star discrepancy of {} points in {} dimensions takes more than {}; certain so far: it "
        "is between {} and {}",
        grid.count, grid.dimension(),
        time ? fmt::format("{} seconds (--time-limit)", limits.seconds)
             : fmt::format("{} comparisons (--max-work)", limits.search.work),
        format_number(found.worst.value()), format_number(found.upper));
}

Report search_for_it(const star::CornerGrid& grid, const Limits& limits, const RunContext& run) {
    const auto late = [&] { return run.seconds && run.seconds() >= limits.search.deadline; };
    const star::SearchResult found =
        star::search(grid, star::ascend(grid, run, late), limits.search, run);
    const bool complete = found.ending == star::Ending::complete;
    if (limits.exact && !complete && found.ending != star::Ending::stopped)
        give_up(grid, found, limits);
    if (found.ending == star::Ending::work || found.ending == star::Ending::time)
        run.tell(
            fmt::format("the star discrepancy is not exact, but between {} and {}; the value given "
                        "is the lower of these",
                        format_number(found.worst.value()), format_number(found.upper)));
    return report(found.worst, found.upper, "branch-and-bound");
}

/// @throws Error(limit) saying how many points would do.
void need_room(const PointSet& points, const RunContext& run) {
    const std::size_t d = points.dimension();
    const double search = d < 3 ? 0 : star::search_bytes(1, d, run.thread_count());
    const double each = static_cast<double>(d * star::axis_bytes) + 32 + search;
    const double all = static_cast<double>(points.count()) * each;
    const double room = static_cast<double>(run.max_memory);
    if (all <= room) return;
    fail_with_hint(ErrorKind::limit,
                   fmt::format("{} points would do; or raise the limit with --max-memory",
                               static_cast<std::uint64_t>(room / each)),
                   "the star discrepancy of {} points in {} dimensions needs {} of memory; the "
                   "limit is {}",
                   points.count(), d, format_bytes(all), format_bytes(room));
}

/// Ends a sweep.
struct OutOfTime {};

/// The square's worst box, or none if that takes longer than a part of the time limit.
std::optional<star::WorstBox> sweep_in_time(const star::CornerGrid& grid, const Limits& limits,
                                            const RunContext& run) {
    constexpr double part = 0.7;  // what is left is for bounds
    RunContext timed = run;
    timed.progress = [&](double done) {
        if (run.seconds && run.seconds() > limits.start + part * limits.seconds) throw OutOfTime{};
        if (run.progress) run.progress(done);
    };
    try {
        return star::sweep_2d(grid, timed);
    } catch (const OutOfTime&) {
        return {};
    }
}

/// The kinds extreme and periodic.
Report other_kind(const PointSet& points, const Values& options, const RunContext& run) {
    const auto refuse = [&](const auto& option) {
        if (options.given(option))
            fail(ErrorKind::usage, "--{} applies to --kind star only", option.name);
    };
    refuse(boxes);
    refuse(method);
    refuse(time_limit);
    refuse(tolerance);
    return extreme::discrepancy(
        points, options[extreme::kind] == "extreme" ? extreme::Space::cube : extreme::Space::torus,
        static_cast<std::uint64_t>(options[max_work]), run);
}

Report measure(const PointSet& points, const Values& options, const RunContext& run) {
    if (points.count() == 0) fail(ErrorKind::input, "star-discrepancy needs at least one point");
    if (points.count() > max_count)
        fail(ErrorKind::limit, "star-discrepancy takes up to {} points; these are {}", max_count,
             points.count());
    if (options[extreme::kind] != "star") return other_kind(points, options, run);
    const Limits limits(options, run);
    need_room(points, run);
    const star::CornerGrid grid = star::corner_grid(
        points, run, options[boxes] == "closed" ? star::Boxes::closed : star::Boxes::half_open);
    if (grid.dimension() == 1) return exact_report(star::sweep_1d(grid, run), "sweep-1d");
    if (grid.dimension() == 2 && limits.sweeps)
        if (const auto worst = sweep_in_time(grid, limits, run))
            return exact_report(*worst, "sweep-2d");
    return search_for_it(grid, limits, run);
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
    return {.name = "star-discrepancy",
            .summary = "Star discrepancy, exact or between bounds, with the worst box",
            .source = "Doerr, Gnewuch, Wahlstroem 2014, arXiv:1405.1653",
            .traits = {.max_dimension = 10'000},
            .options = Schema(extreme::kind, boxes, method, time_limit, tolerance, max_work,
                              star::prefixes, star::every, star::projections),
            .results = {{"value", "the star discrepancy; where exact is false, lower"},
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
                        {"projections.largest.value", "the largest value", false},
                        {"projections.largest.lower", "the largest of all is at least this", false},
                        {"projections.largest.upper", "and at most this", false}},
            .analyze = analyze};
}

}  // namespace stipple::analyzers
