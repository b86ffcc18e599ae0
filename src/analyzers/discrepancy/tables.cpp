// SPDX-License-Identifier: MIT
#include "analyzers/discrepancy/tables.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "math/combinatorics/combinations.hpp"

namespace stipple::discrepancy::star {
namespace {

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

/// Trivial bounds of any kind of discrepancy for any n points. The lower one, 1/(2n), holds even
/// for the coordinates on a single axis.
Report least_known(std::size_t count) {
    const double lower = 0.5 / static_cast<double>(count);
    Report known;
    known.add("lower", lower).add("upper", 1.0);
    return known;
}

/// Measures the sets of a table, and collects their results.
class Table {
  public:
    Table(std::size_t rows, double weight, const Limits& limits, const Measure& measure,
          const RunContext& run)
        : columns(rows),
          rows_(rows),
          limits_(limits),
          weight_(weight),
          left_(weight),
          measure_(measure),
          run_(run) {}

    /// Measures one set. If `together` sets are measured at a time, each uses a single thread.
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
    /// Limits of the next set, if `together` sets are measured at a time; and whether it is the
    /// first set.
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
    double left_;  ///< weight of the sets that have not begun
    const Measure& measure_;
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

/// @throws Error(input) if the set has fewer points
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
/// the fractions of points differ by at most (m - n) / m. Adds a margin for rounding.
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

/// Prefixes that take much of the total work use all threads, one after another; the others are
/// distributed over the threads.
Report of_prefixes(const PointSet& points, const std::vector<std::size_t>& sizes,
                   const Limits& limits, const Measure& measure, const RunContext& run) {
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

/// Adds bounds of the table's largest value, and the value itself if the worst row is certain and
/// exact.
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

Report of_projections(const PointSet& points, std::size_t size, const Limits& limits,
                      const Measure& measure, const RunContext& run) {
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

}  // namespace

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

bool wants_families(const Values& options) {
    if (options.given(prefixes) && options.given(every))
        fail(ErrorKind::usage, "--prefixes and --every cannot be combined; give one of them");
    given_sizes(options);
    return options.given(prefixes) || options.given(every) || options.given(projections);
}

Report families(const PointSet& points, const Values& options, const Limits& limits,
                const Measure& measure, const RunContext& run) {
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

}  // namespace stipple::discrepancy::star
