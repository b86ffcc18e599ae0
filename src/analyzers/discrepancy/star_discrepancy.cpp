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
//         after --max-work or --time-limit. Both limit all rows of a table together.
//         Other kinds, d = 2: branch and bound over O(n^2) cells at worst, of a few points each.
//         1024 points take 0.1 s (random) to 0.4 s (Hammersley), 4096 points 0.5 s to 9 s; the
//         periodic kind of even points takes ten times as long. d > 2: up to n^(2(d - 1)) cells;
//         1000 random points in 3-D take 10 s, 128 in 5-D 5 s. For many points in few dimensions
//         a first upper bound is 2^d D* (periodic: (3^d - 1) D*).
// Promise `exact` reports whether the value is exact: counts are integers, boxes are compared
//         without rounding, and the value is the double nearest to that of the worst box. Otherwise
//         the worst box found gives `lower`, and no box is worse than `upper`. Never depends on the
//         number of threads; depends on the machine if --time-limit ends the search.
// Beware  if `exact` is false, `value` is `lower`; a --check of `value` must hold for both bounds.
//         Coordinates are the exact values of the doubles: 0.1 is a little more than 1/10.
// Source  C. Doerr, M. Gnewuch, M. Wahlstroem, "Calculation of discrepancy measures and
//         applications", arXiv:1405.1653 (survey); M. Gnewuch, A. Srivastav, C. Winzen, J.
//         Complexity 25 (2009) 115-127 (NP-hard). Other kinds: W. J. Morokoff, R. E. Caflisch, SIAM
//         J. Sci. Comput. 15 (1994) 1251-1279, doi:10.1137/0915077 (the measures); N. H. Kuiper,
//         Indag. Math. 22 (1960) 38-47.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/peers.hpp"
#include "core/text.hpp"
#include "math/combinatorics/combinations.hpp"
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

constexpr Param<Numbers> prefixes{
    {.name = "prefixes",
     .unit = "points",
     .help = "Measure prefixes instead of the whole set: increasing numbers of points, such as "
             "16,32,64; gives a table. Limits of work and time apply to the whole table: work is "
             "divided in proportion to the numbers of points, and each row gets a part of the time "
             "that is left"}};

constexpr Param<std::int64_t> every{
    .name = "every",
    .low = 1,
    .optional = true,
    .unit = "points",
    .help = "Like --prefixes, for every multiple of this number up to the size of the set"};

constexpr Param<std::int64_t> projections{
    .name = "projections",
    .low = 1,
    .high = 8,
    .optional = true,
    .unit = "coordinates",
    .help =
        "Measure all projections to this many coordinates instead of the whole set; gives a table "
        "in the order 1-2, 1-3, 2-3, 1-4, 2-4, ...: sorted by the last axis, then by the preceding "
        "one"};

/// Limit beyond any machine's memory; counts of points fit 32-bit integers.
constexpr std::size_t max_count = std::size_t{1} << 29;

/// A set to measure, with its limits.
struct Member {
    const PointSet& points;
    const Limits& limits;
    Peers* peers = nullptr;  ///< processes that share the search; may be null
};

/// Measures one set; reports `lower`, `upper` and, if it is known, `value`.
using MeasureSet = std::function<Report(const Member&, const RunContext&)>;

/// Columns of every table. Unknown values are NaN.
struct Columns {
    explicit Columns(std::size_t rows) : value(rows), lower(rows), upper(rows) {}

    void put(std::size_t row, const Report& found) {
        value[row] = found.find("value") ? found.number("value") : std::nan("");
        lower[row] = found.number("lower");
        upper[row] = found.number("upper");
    }

    void add_to(Report& table) && {
        Report::Integers exact(value.size());
        for (std::size_t row = 0; row < exact.size(); ++row) exact[row] = lower[row] == upper[row];
        table.add("value", std::move(value));
        table.add("lower", std::move(lower));
        table.add("upper", std::move(upper));
        table.add("exact", std::move(exact));
    }

    Report::Curve value;
    Report::Curve lower;
    Report::Curve upper;
};

/// Bounds that hold for any kind of discrepancy and any n points: 1 and 1/(2n), the smallest
/// star discrepancy of n numbers on an axis.
Report least_known(std::size_t count) {
    const double lower = 0.5 / static_cast<double>(count);
    Report known;
    known.add("lower", lower).add("upper", 1.0);
    return known;
}

/// Measures the sets of a table, and collects their results.
class Table {
  public:
    Table(std::size_t rows, double weight, const Limits& limits, const MeasureSet& measure,
          const RunContext& run)
        : columns(rows),
          rows_(rows),
          limits_(limits),
          weight_(weight),
          left_(weight),
          measure_(measure),
          run_(run) {}

    /// Measures one set; on a single thread if `together` > 1 sets are measured at a time.
    void fill(std::size_t row, const PointSet& points, double weight, double together) {
        RunContext mine = together > 1 ? run_ : progress_of(points.count());
        if (together > 1) mine.progress = {}, mine.threads = 1;
        mine.warn = {};  // bounds are reported once for the whole table
        const auto [limits, first] = next_limits(weight, together);
        const bool skip = !first && !limits.exact && limits.search.late(run_);
        Report found;
        try {
            found = skip ? least_known(points.count()) : measure_({points, limits}, mine);
        } catch (const Error& e) {
            if (e.kind() != ErrorKind::cancelled) throw;
            found = least_known(points.count());
        }
        columns.put(row, found);
        const std::lock_guard lock(counting_);
        if (!run_.stop.stop_requested()) run_.tick(++done_, rows_);
    }

    /// Warns of values that are only bounds; name(row) is text such as "the first 64 points".
    void tell_of_bounds(const std::function<std::string(std::size_t)>& name) const {
        std::size_t open = 0;
        std::size_t first = 0;
        for (std::size_t row = rows_; row-- > 0;)
            if (std::isnan(columns.value[row])) ++open, first = row;
        if (open == 0 || run_.stop.stop_requested()) return;
        run_.notify(
            fmt::format("{} of {} discrepancies are not known exactly; the first, that of {}, is "
                        "between {} and {}",
                        open, rows_, name(first), format_number(columns.lower[first]),
                        format_number(columns.upper[first])));
    }

    Columns columns;

  private:
    /// Limits of the next set while `together` sets are measured at once; whether it is the first.
    std::pair<Limits, bool> next_limits(double weight, double together) {
        const std::lock_guard lock(counting_);
        const bool first = left_ == weight_;
        const double of_time = std::min(1.0, together * weight / left_);
        left_ = std::max(left_ - weight, weight_ * 1e-12);
        return {limits_.part(weight / weight_, of_time, run_), first};
    }

    /// Context for the next row, if it is measured alone. Its progress is a fraction of the
    /// table's, and its notes begin with the number of points.
    [[nodiscard]] RunContext progress_of(std::size_t count) const {
        const double rows = static_cast<double>(rows_);
        const double done = static_cast<double>(done_);
        RunContext part = run_.stage(done / rows, (done + 1) / rows);
        if (run_.note)
            part.note = [note = run_.note, count](const std::string& words) {
                note(fmt::format("{} points: {}", count, words));
            };
        return part;
    }

    std::size_t rows_;
    const Limits& limits_;
    double weight_;
    double left_;  ///< total weight of the sets not yet begun
    const MeasureSet& measure_;
    const RunContext& run_;
    std::size_t done_ = 0;
    std::mutex counting_;
};

std::vector<std::size_t> given_sizes(const Values& options) {
    constexpr double most = 0x1p53;
    std::vector<std::size_t> sizes;
    for (const double size : options[prefixes]) {
        if (!(size >= 1 && size <= most) || size != std::floor(size))
            fail(ErrorKind::usage, "--prefixes: {} is not a number of points; expected 1, 2, ...",
                 format_number(size));
        const auto count = static_cast<std::size_t>(size);
        if (!sizes.empty() && count == sizes.back())
            fail(ErrorKind::usage, "--prefixes: {} is given twice; expected increasing numbers",
                 count);
        if (!sizes.empty() && count < sizes.back())
            fail(ErrorKind::usage, "--prefixes: {} comes after {}; expected increasing numbers",
                 count, sizes.back());
        sizes.push_back(count);
    }
    return sizes;
}

/// @throws Error(input) if the set has fewer points than a requested prefix
std::vector<std::size_t> prefix_sizes(std::size_t count, const Values& options) {
    if (options.given(every)) {
        const auto step = static_cast<std::size_t>(options[every]);
        if (step > count)
            fail(ErrorKind::input, "--every: {} is above the number of points, {}", step, count);
        std::vector<std::size_t> sizes;
        for (std::size_t size = step; size <= count; size += step) sizes.push_back(size);
        return sizes;
    }
    std::vector<std::size_t> sizes = given_sizes(options);
    if (!sizes.empty() && sizes.back() > count)
        fail(ErrorKind::input, "--prefixes: {} is above the number of points, {}", sizes.back(),
             count);
    return sizes;
}

PointSet prefix(const PointSet& points, std::size_t size) {
    const auto rows = points.flat().first(size * points.dimension());
    return {std::vector<double>(rows.begin(), rows.end()), points.dimension()};
}

PointSet projection(const PointSet& points, const Combination& along) {
    PointSet flat(points.count(), along.size());
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < along.size(); ++k) flat[i][k] = points[i][along[k]];
    return flat;
}

/// Largest difference between the discrepancies of m points and of n of these points: in every box,
/// the fractions of points differ by at most (m - n) / m. Includes a margin for rounding.
double step_between(std::size_t n, std::size_t m) {
    return static_cast<double>(m - n) / static_cast<double>(m) + 0x1p-50;
}

/// Tightens the bounds of each prefix by those of the neighbouring ones.
void carry_bounds(const std::vector<std::size_t>& sizes, Columns& columns) {
    const auto carry = [&](std::size_t from, std::size_t to) {
        const auto [n, m] = std::minmax(sizes[from], sizes[to]);
        const double step = step_between(n, m);
        columns.upper[to] = std::min(columns.upper[to], columns.upper[from] + step);
        columns.lower[to] = std::max(columns.lower[to], columns.lower[from] - step);
        if (!std::isnan(columns.value[to]) || columns.lower[to] == columns.upper[to])
            columns.value[to] = columns.lower[to];
    };
    for (std::size_t row = 1; row < sizes.size(); ++row) carry(row - 1, row);
    for (std::size_t row = sizes.size(); row-- > 1;) carry(row, row - 1);
}

/// Prefixes that take a large fraction of the total work use all threads, one prefix after another;
/// the other prefixes are distributed over the threads.
Report of_prefixes(const PointSet& points, const std::vector<std::size_t>& sizes,
                   const Limits& limits, const MeasureSet& measure, const RunContext& run) {
    double total = 0;
    for (const std::size_t size : sizes) total += static_cast<double>(size);
    const double threads = run.thread_count();
    const auto small = static_cast<std::size_t>(
        std::ranges::upper_bound(sizes, total / (2 * threads), {},
                                 [](std::size_t size) { return static_cast<double>(size); }) -
        sizes.begin());
    Table table(sizes.size(), total, limits, measure, run);
    const auto fill = [&](std::size_t row, double together) {
        table.fill(row, prefix(points, sizes[row]), static_cast<double>(sizes[row]), together);
    };
    for_each_block(silent(unstopped(run)), small, 1,
                   [&](const Block& block) { fill(block.index, threads); });
    for (std::size_t row = small; row < sizes.size(); ++row) fill(row, 1);
    carry_bounds(sizes, table.columns);
    table.tell_of_bounds(
        [&](std::size_t row) { return fmt::format("the first {} points", sizes[row]); });

    Report result;
    result.add("count", Report::Integers(sizes.begin(), sizes.end()));
    std::move(table.columns).add_to(result);
    return result;
}

/// Adds the bounds of the table's largest value; also the value, if its row is certain and exact.
void add_largest(Report& table) {
    const auto& lower = table.curve("lower");
    const auto& upper = table.curve("upper");
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(lower) - lower.begin());
    bool certain = true;
    for (std::size_t row = 0; row < upper.size(); ++row)
        certain = certain && (row == worst || upper[row] <= lower[worst]);
    Report largest;
    const double value = table.curve("value")[worst];
    if (certain && !std::isnan(value)) largest.add("value", value);
    for (const char* name : {"lower", "upper"})
        largest.add(name, std::ranges::max(table.curve(name)));
    table.add("worst_is_certain", certain);
    table.add("largest", std::move(largest));
}

/// Text such as "the projection to axes 1, 3".
std::string axes_of(const Combination& along) {
    std::vector<std::string> axes;
    for (const std::size_t k : along) axes.push_back(fmt::format("{}", k + 1));
    return fmt::format("the projection to {} {}", along.size() == 1 ? "axis" : "axes",
                       join(axes, ", "));
}

/// In a table of projections, marks the first row with the largest lower bound.
void mark_worst(Report& table) {
    const auto& lower = table.curve("lower");
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(lower) - lower.begin());
    Report::Integers marks(lower.size());
    marks[worst] = 1;
    Report::Integers axes;
    while (const auto* axis = table.find(fmt::format("axis_{}", axes.size() + 1)))
        axes.push_back(std::get<Report::Integers>(*axis)[worst]);
    table.add("is_worst", std::move(marks));
    table.add("worst", std::move(axes));
}

Report of_projections(const PointSet& points, std::size_t size, const Limits& limits,
                      const MeasureSet& measure, const RunContext& run) {
    if (size > points.dimension())
        fail(ErrorKind::input, "--projections: {} is above the number of coordinates, {}", size,
             points.dimension());
    constexpr std::uint64_t most_rows = 1'000'000;
    const std::uint64_t count = binomial(points.dimension(), size);
    if (count > most_rows)
        fail_with_hint(
            ErrorKind::limit, "use fewer axes, or fewer coordinates with --column",
            "--projections: {} of {} coordinates give {} projections; expected at most {}", size,
            points.dimension(), count, most_rows);
    const double row_bytes = static_cast<double>(8 * (size + 4));
    run.need_memory(static_cast<double>(count) * row_bytes +
                        static_cast<double>(8 * points.count() * size) * run.thread_count(),
                    "the table of projections");
    Table table(count, static_cast<double>(count), limits, measure, run);
    std::vector<Report::Integers> axes(size, Report::Integers(count));
    const double together = std::min<double>(run.thread_count(), static_cast<double>(count));
    for_each_block(silent(unstopped(run)), count, 1, [&](const Block& block) {
        const Combination along = combination(block.index, size);
        for (std::size_t k = 0; k < size; ++k)
            axes[k][block.index] = static_cast<std::int64_t>(along[k] + 1);
        table.fill(block.index, projection(points, along), 1, together);
    });
    table.tell_of_bounds([&](std::size_t row) { return axes_of(combination(row, size)); });

    Report result;
    for (std::size_t k = 0; k < size; ++k)
        result.add(fmt::format("axis_{}", k + 1), std::move(axes[k]));
    std::move(table.columns).add_to(result);
    mark_worst(result);
    add_largest(result);
    return result;
}

/// Whether tables of prefixes or projections are requested. @throws Error(usage)
bool wants_families(const Values& options) {
    if (options.given(prefixes) && options.given(every))
        fail(ErrorKind::usage, "--prefixes and --every cannot be combined; give one of them");
    given_sizes(options);
    return options.given(prefixes) || options.given(every) || options.given(projections);
}

/// Tables of several sets, measured in parallel. They do not depend on the number of threads unless
/// a time limit ends the search. The limits apply to all sets together: work is divided in
/// proportion to the numbers of points, and so is the remaining time among the sets not yet begun.
/// Bounds of a prefix are also used for its neighbours, widened by the effect of the additional
/// points. Sets not measured because of a stop or the time limit get the bounds 1/(2n) and 1.
/// @throws Error(input) for prefixes and projections that these points do not have
Report families(const PointSet& points, const Values& options, const Limits& limits,
                const MeasureSet& measure, const RunContext& run) {
    const auto sizes = prefix_sizes(points.count(), options);
    const bool both = !sizes.empty() && options.given(projections);
    const double half = both ? 0.5 : 1;
    Report results;
    if (!sizes.empty())
        results.add("prefixes", of_prefixes(points, sizes, limits.part(half, half, run), measure,
                                            run.stage(0, half)));
    if (options.given(projections))
        results.add("projections",
                    of_projections(points, static_cast<std::size_t>(options[projections]),
                                   limits.part(half, 1, run), measure, run.stage(1 - half, 1)));
    return results;
}

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

/// @throws Error(limit) if memory does not suffice; the hint says how many points would fit
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

/// Worst box in two dimensions; only bounds if the sweep exceeds its part of the time limit.
Found sweep_or_search(const BoxGrid& grid, const Limits& limits, const RunContext& run) {
    constexpr double part = 0.7;  // fraction of the time limit; the remaining time is for bounds
    SearchLimits first = limits.search;
    first.deadline = limits.start + part * (first.deadline - limits.start);
    const SearchResult sweep = star::sweep_2d(grid, first, run);
    if (sweep.ending == Ending::complete) return {sweep, "sweep-2d"};
    const bool stopped = run.stop.stop_requested();
    return {star::search(grid, sweep.worst, limits.search, run),
            stopped ? "sweep-2d" : "branch-and-bound"};
}

Found search(const BoxGrid& grid, const Member& set, const RunContext& run) {
    if (!grid.anchored())
        return {extreme::find_worst(set.points, grid, set.limits.search, run),
                grid.dimension() == 1 ? "sweep-1d" : "branch-and-bound"};
    if (grid.dimension() == 1) return {star::sweep_1d(grid, run), "sweep-1d"};
    if (grid.dimension() == 2 && !set.limits.bounded) return sweep_or_search(grid, set.limits, run);
    return {star::find_worst(grid, set.limits.search, run, set.peers)};
}

Report measure(const Member& set, const Values& options, const RunContext& run) {
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
    if (!wants_families(options)) return measure({points, limits}, options, run);
    const auto one = [&options](const Member& part, const RunContext& part_run) {
        return measure(part, options, part_run);
    };
    return families(points, options, limits, one, run);
}

/// Divides the search for the worst box among processes. The sweeps in one and two dimensions are
/// not divided, since that would take longer than the sweep.
Report analyze_together(const PointSet& points, const Values& options, Peers& peers,
                        const RunContext& run) {
    if (wants_families(options) || options[kind] != "star")
        fail(ErrorKind::usage,
             "star-discrepancy: ranks share the search of one set for the kind star only; use one "
             "process for tables and other kinds");
    const Limits limits(options, run);
    const bool sweeps = points.dimension() < 2 || (points.dimension() == 2 && !limits.bounded);
    return measure({.points = points, .limits = limits, .peers = sweeps ? nullptr : &peers},
                   options, run);
}

/// Removes boxes and axes, which cannot be averaged; finds the worst projection from the means.
void refine(Report& mean, std::size_t sets, const Values&) {
    if (sets < 2) return;
    drop(mean, {"worst_box"});
    auto* const item = mean.find("projections");
    if (item == nullptr) return;
    auto& table = std::get<Report>(*item);
    drop(table, {"is_worst", "worst", "worst_is_certain"});
    mark_worst(table);
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
                              limit::max_work, prefixes, every, projections),
            .results = results(),
            .curves = {{"prefixes.value", "prefixes.count", "", "", "points n", true,
                        "Star discrepancy of the first n points, over n"},
                       {"prefixes.lower", "prefixes.count", "", "", "points n", true},
                       {"prefixes.upper", "prefixes.count", "", "", "points n", true},
                       {"projections.value", "", "", "star discrepancy"},
                       {"projections.upper", "", "", "upper bound of the star discrepancy"}},
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
                [](double n, double d) {  // seconds fitted to Halton, Sobol' and random points
                    if (d <= 2) return 3e-8 * std::pow(n, 1.33);
                    return std::min(100.0, 5e-8 * std::pow(n, d <= 8 ? 1 + d / 4 : 2.2 + d / 10));
                },
            .sharing = {.together = analyze_together},
            .refine = refine};
}

}  // namespace stipple::analyzers::star_discrepancy
