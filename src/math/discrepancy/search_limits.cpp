// SPDX-License-Identifier: MIT
#include "math/discrepancy/search_limits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::discrepancy {

SearchLimits SearchLimits::after(std::uint64_t spent) const {
    SearchLimits left = *this;
    left.work = work > spent ? work - spent : 1;
    return left;
}

SearchResult result_of_sweep(WorstBox worst, bool complete, const SearchLimits& limits,
                             const RunContext& run) {
    const double value = worst.value();
    if (complete) return {std::move(worst), value, Ending::complete};
    return {std::move(worst), 1, limits.late(run) ? Ending::time : Ending::stopped};
}

Report report_of(const SearchResult& found, double tolerance, const char* method) {
    const double value = found.worst.value();
    Report results;
    if (found.within(tolerance)) results.add("value", value);
    results.add("lower", value).add("upper", found.upper);
    return results.add("exact", found.upper == value).add("method", method);
}

void report_gap(double lower, double upper, const RunContext& run) {
    if (!run.progress) return run.check_stop();
    constexpr std::uint64_t parts = 1'000'000;
    const double open = lower < 1 ? std::clamp((upper - lower) / (1 - lower), 0.0, 1.0) : 0;
    run.tick(parts - static_cast<std::uint64_t>(open * static_cast<double>(parts)), parts,
             fmt::format("between {:.4g} and {:.4g}", lower, upper));
}

Limits::Limits(const Values& options, const RunContext& run)
    : exact(options[limit::method] == "exact"),
      bounded(options[limit::method] == "bounds"),
      work_(options[limit::max_work]) {
    if (exact && options.given(limit::tolerance))
        fail(ErrorKind::usage, "--tolerance cannot be combined with --method exact");
    search.tolerance = options.given(limit::tolerance) ? options[limit::tolerance]
                       : bounded                       ? 0.1
                                                       : 0;
    if (!options.given(limit::time_limit) || options.given(limit::max_work))
        search.work = static_cast<std::uint64_t>(work_);
    if (run.seconds) start = run.seconds();
    if (options.given(limit::time_limit) && run.seconds) {
        seconds_ = options[limit::time_limit];
        search.deadline = start + seconds_;
    }
}

Limits Limits::part(double of_work, double of_time, const RunContext& run) const {
    Limits mine = *this;
    if (search.work < std::numeric_limits<std::uint64_t>::max()) {
        const double share = of_work * static_cast<double>(search.work);
        mine.search.work = static_cast<std::uint64_t>(std::max(1.0, share));
    }
    if (run.seconds) mine.start = run.seconds();
    if (search.timed())
        mine.search.deadline = mine.start + of_time * std::max(0.0, search.deadline - mine.start);
    return mine;
}

void Limits::give_up(const SearchResult& found, const std::string& what,
                     const PointSet& points) const {
    const bool time = found.ending == Ending::time;
    fail_with_hint(ErrorKind::limit,
                   fmt::format("a larger {}, or fewer points, may give the exact value; --method "
                               "bounds accepts bounds",
                               time ? "--time-limit" : "--max-work"),
                   "{} of {} points in {} dimensions takes more than {}; so far it is proven to be "
                   "between {} and {}",
                   what, points.count(), points.dimension(),
                   time ? fmt::format("{} seconds (--time-limit)", seconds_)
                        : fmt::format("{} comparisons (--max-work)", work_),
                   format_number(found.worst.value()), format_number(found.upper));
}

void Limits::judge(const SearchResult& found, const std::string& what, const PointSet& points,
                   const RunContext& run) const {
    const bool cut = found.ending == Ending::work || found.ending == Ending::time;
    if (exact && (cut || found.ending == Ending::tolerance)) give_up(found, what, points);
    if (!cut || found.within(search.tolerance)) return;
    const std::string missed =
        search.tolerance > 0
            ? fmt::format(" (--tolerance {} was not reached)", format_number(search.tolerance))
            : "";
    run.notify(fmt::format("{} is not known exactly; it is between {} and {}{}", what,
                           format_number(found.worst.value()), format_number(found.upper), missed));
}

}  // namespace stipple::discrepancy
