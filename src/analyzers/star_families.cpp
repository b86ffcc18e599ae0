// SPDX-License-Identifier: MIT
#include "analyzers/star_families.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "math/combinations.hpp"

namespace stipple::analyzers::star {
namespace {

/// The columns that every table has.
struct Columns {
    explicit Columns(std::size_t rows) : value(rows), lower(rows), upper(rows) {}

    void put(std::size_t row, const Report& found) {
        value[row] = found.number("value");
        lower[row] = found.number("lower");
        upper[row] = found.number("upper");
    }

    void add_to(Report& table) && {
        table.add("value", std::move(value));
        table.add("lower", std::move(lower));
        table.add("upper", std::move(upper));
    }

    Report::Curve value;
    Report::Curve lower;
    Report::Curve upper;
};

/// A run whose warnings may come from several threads at once, and that tells no progress.
class Together {
  public:
    explicit Together(const RunContext& run) : quiet_(run) {
        quiet_.progress = {};
        if (run.warn)
            quiet_.warn = [this, tell = run.warn](const std::string& sentence) {
                const std::lock_guard lock(telling_);
                tell(sentence);
            };
    }

    [[nodiscard]] RunContext each(unsigned threads) const {
        RunContext one = quiet_;
        one.threads = threads;
        return one;
    }

  private:
    RunContext quiet_;
    std::mutex telling_;
};

std::vector<std::size_t> given_sizes(const Values& options) {
    constexpr double most = 0x1p53;
    std::vector<std::size_t> sizes;
    for (const double size : options[prefixes]) {
        if (!(size >= 1 && size <= most) || size != std::floor(size))
            fail(ErrorKind::usage, "--prefixes: {} is not a number of points; expected 1, 2, ...",
                 format_number(size));
        const auto count = static_cast<std::size_t>(size);
        if (!sizes.empty() && count <= sizes.back())
            fail(ErrorKind::usage, "--prefixes: {} stands behind {}; expected rising numbers",
                 count, sizes.back());
        sizes.push_back(count);
    }
    return sizes;
}

/// @throws Error(input) when the set does not have so many points.
std::vector<std::size_t> prefix_sizes(std::size_t count, const Values& options) {
    if (options.given(every)) {
        const auto step = static_cast<std::size_t>(options[every]);
        if (step > count)
            fail(ErrorKind::input, "--every: {} is beyond the set's {} points", step, count);
        std::vector<std::size_t> sizes;
        for (std::size_t size = step; size <= count; size += step) sizes.push_back(size);
        return sizes;
    }
    std::vector<std::size_t> sizes = given_sizes(options);
    if (!sizes.empty() && sizes.back() > count)
        fail(ErrorKind::input, "--prefixes: {} is beyond the set's {} points", sizes.back(), count);
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

/// Prefixes that are a large part of all the work use all threads, one after the other; the others
/// a thread each.
Report of_prefixes(const PointSet& points, const std::vector<std::size_t>& sizes,
                   const Measure& measure, const RunContext& run) {
    double total = 0;
    for (const std::size_t size : sizes) total += static_cast<double>(size);
    const double share = total / (2 * run.thread_count());
    const auto small = static_cast<std::size_t>(
        std::ranges::upper_bound(sizes, share, {},
                                 [](std::size_t size) { return static_cast<double>(size); }) -
        sizes.begin());
    Columns columns(sizes.size());
    const Together together(run);
    std::size_t done = 0;
    std::mutex counting;
    const auto fill = [&](std::size_t row, unsigned threads) {
        columns.put(row, measure(prefix(points, sizes[row]), together.each(threads)));
        const std::lock_guard lock(counting);
        run.tick(++done, sizes.size());
    };
    constexpr bool silent = true;
    for_each_block(
        run, small, 1, [&](const Block& block) { fill(block.index, 1); }, silent);
    for (std::size_t row = small; row < sizes.size(); ++row) fill(row, run.threads);

    Report table;
    table.add("count", Report::Integers(sizes.begin(), sizes.end()));
    std::move(columns).add_to(table);
    return table;
}

/// The first of the projections with the largest value; the table marks it.
void mark_worst(Report& table, std::size_t size) {
    const auto& value = table.curve("value");
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(value) - value.begin());
    Report::Integers marks(value.size());
    marks[worst] = 1;
    Report::Integers axes;
    for (const std::size_t k : combination(worst, size))
        axes.push_back(static_cast<std::int64_t>(k + 1));
    Report largest;
    for (const char* name : {"value", "lower", "upper"})
        largest.add(name, std::ranges::max(table.curve(name)));
    table.add("is_worst", std::move(marks));
    table.add("worst", std::move(axes));
    table.add("largest", std::move(largest));
}

Report of_projections(const PointSet& points, std::size_t size, const Measure& measure,
                      const RunContext& run) {
    if (size > points.dimension())
        fail(ErrorKind::input, "--projections: {} is beyond the points' {} coordinates", size,
             points.dimension());
    const std::uint64_t count = binomial(points.dimension(), size);
    const double row_bytes = static_cast<double>(8 * (size + 4));
    run.need_memory(static_cast<double>(count) * row_bytes +
                        static_cast<double>(8 * points.count() * size) * run.thread_count(),
                    "the table of projections");
    Columns columns(count);
    std::vector<Report::Integers> axes(size, Report::Integers(count));
    const Together together(run);
    const unsigned threads = count > 1 ? 1 : run.threads;
    for_each_block(run, count, 1, [&](const Block& block) {
        const Combination along = combination(block.index, size);
        for (std::size_t k = 0; k < size; ++k)
            axes[k][block.index] = static_cast<std::int64_t>(along[k] + 1);
        columns.put(block.index, measure(projection(points, along), together.each(threads)));
    });

    Report table;
    for (std::size_t k = 0; k < size; ++k)
        table.add(fmt::format("axis_{}", k + 1), std::move(axes[k]));
    std::move(columns).add_to(table);
    mark_worst(table, size);
    return table;
}

}  // namespace

bool wants_families(const Values& options) {
    if (options.given(prefixes) && options.given(every))
        fail(ErrorKind::usage, "--prefixes and --every: give one of them");
    given_sizes(options);
    return options.given(prefixes) || options.given(every) || options.given(projections);
}

Report families(const PointSet& points, const Values& options, const Measure& measure,
                const RunContext& run) {
    const auto sizes = prefix_sizes(points.count(), options);
    const bool both = !sizes.empty() && options.given(projections);
    Report results;
    if (!sizes.empty())
        results.add("prefixes", of_prefixes(points, sizes, measure, run.stage(0, both ? 0.5 : 1)));
    if (options.given(projections))
        results.add("projections",
                    of_projections(points, static_cast<std::size_t>(options[projections]), measure,
                                   run.stage(both ? 0.5 : 0, 1)));
    return results;
}

}  // namespace stipple::analyzers::star
