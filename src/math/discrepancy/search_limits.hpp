// SPDX-License-Identifier: MIT
//
// Limits that end searches for a worst box early: time, work, or a tolerance of the bounds.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/options.hpp"
#include "math/discrepancy/box_grid.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

namespace limit {

inline constexpr Param<Choice> method{
    .name = "method",
    .fallback = "auto",
    .choices = "auto|exact|bounds",
    .help =
        "auto: the exact value, or proven bounds if a limit is reached first; exact: the exact "
        "value, or an error; bounds: proven bounds within --tolerance of each other"};

inline constexpr Param<double> time_limit{
    .name = "time-limit",
    .low = 0,
    .low_open = true,
    .optional = true,
    .unit = "seconds",
    .help =
        "Stop after this time, instead of --max-work; the bounds then depend on the machine and "
        "its load. Sorting millions of points is not interrupted"};

inline constexpr Param<double> tolerance{.name = "tolerance",
                                         .low = 0,
                                         .optional = true,
                                         .help =
                                             "Stop when upper - lower is at most this, relative to "
                                             "lower [default: 0.1 for bounds, else 0]"};

inline constexpr Param<std::int64_t> max_work{
    .name = "max-work",
    .fallback = 100'000'000'000,
    .low = 1,
    .unit = "comparisons",
    .help =
        "Stop a search after comparing this many coordinates, with the same result on any machine "
        "(sweeps are not limited); 10^9 take one to four seconds on one core"};

}  // namespace limit

/// Conditions to stop before the worst box is found.
struct SearchLimits {
    std::uint64_t work = std::numeric_limits<std::uint64_t>::max();  ///< comparisons of coordinates
    double deadline = std::numeric_limits<double>::infinity();  ///< in seconds, by the run's clock
    double tolerance = 0;  ///< stops if upper - lower <= tolerance * lower

    /// Comparisons that take a quarter of a second to a second.
    static constexpr std::uint64_t short_work = 1U << 28;

    /// True if bounds may suffice: there is a tolerance, a deadline or a low limit of work.
    [[nodiscard]] bool wants_bounds() const {
        return tolerance > 0 || work < 4 * short_work || timed();
    }

    [[nodiscard]] bool timed() const { return deadline < std::numeric_limits<double>::infinity(); }

    /// True if the deadline has passed.
    [[nodiscard]] bool late(const RunContext& run) const {
        return timed() && run.seconds && run.seconds() >= deadline;
    }

    /// True if the deadline has passed or a stop was requested.
    [[nodiscard]] bool over(const RunContext& run) const {
        return run.stop.stop_requested() || late(run);
    }

    /// Limits that remain after `spent` comparisons.
    [[nodiscard]] SearchLimits after(std::uint64_t spent) const;
};

enum class Ending { complete, tolerance, work, time, stopped };

/// Proven bounds at the end of a search.
struct SearchResult {
    WorstBox worst;
    double upper;   ///< upper bound on the values of all boxes
    Ending ending;  ///< if `complete`, `worst` is the worst of all boxes

    [[nodiscard]] bool within(double tolerance) const {
        return upper - worst.value() <= tolerance * worst.value();
    }
};

/// Result of a sweep. Its upper bound is 1 unless the sweep was completed.
SearchResult result_of_sweep(WorstBox worst, bool complete, const SearchLimits& limits,
                             const RunContext& run);

/// Report of lower, upper, exact and method; also of value if the bounds are within the tolerance.
Report report_of(const SearchResult& found, double tolerance, const char* method);

/// Reports progress of a search between these bounds: the fraction of the gap closed, and the
/// bounds as text. Checks for a stop.
void report_gap(double lower, double upper, const RunContext& run);

/// Limits from the options; `start` is the run's clock when they are read.
class Limits {
  public:
    /// Reads the options. @throws Error(usage) if they contradict each other
    Limits(const Values& options, const RunContext& run);

    /// Limits for one of several searches: fractions of the work and of the remaining time.
    [[nodiscard]] Limits part(double of_work, double of_time, const RunContext& run) const;

    /// Warns if a limit ended the search of `what`, such as "the star discrepancy", before its
    /// bounds were within the tolerance.
    /// @throws Error(limit) if the exact value is required
    void judge(const SearchResult& found, const std::string& what, const PointSet& points,
               const RunContext& run) const;

    SearchLimits search;
    bool exact = false;    ///< only the exact value is accepted
    bool bounded = false;  ///< bounds within the tolerance suffice
    double start = 0;

  private:
    [[noreturn]] void give_up(const SearchResult& found, const std::string& what,
                              const PointSet& points) const;

    double seconds_ = std::numeric_limits<double>::infinity();
    std::int64_t work_ = 0;
};

}  // namespace stipple::discrepancy
