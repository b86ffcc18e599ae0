// SPDX-License-Identifier: MIT
//
// When searches for a worst box end before they found the worst of all: by the clock, by the work
// done, or when the bounds that are certain are near enough.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include "core/options.hpp"
#include "math/discrepancy/box_grid.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

/// The options.
namespace limit {

inline constexpr Param<Choice> method{
    .name = "method",
    .fallback = "auto",
    .choices = "auto|exact|bounds",
    .help =
        "auto: exact, or where a limit comes first, certain bounds; exact: that, or an error; "
        "bounds: certain bounds that meet within --tolerance"};

inline constexpr Param<double> time_limit{
    .name = "time-limit",
    .low = 0,
    .low_open = true,
    .optional = true,
    .unit = "seconds",
    .help =
        "Stop after this time, in place of --max-work; what bounds it gives depends on the "
        "machine and its load. The sorting of millions of points is not cut short"};

inline constexpr Param<double> tolerance{
    .name = "tolerance",
    .low = 0,
    .optional = true,
    .help =
        "Enough if upper - lower is at most this, relative to lower [default: 0.1 for bounds, "
        "else 0]"};

inline constexpr Param<std::int64_t> max_work{
    .name = "max-work",
    .fallback = 100'000'000'000,
    .low = 1,
    .unit = "comparisons",
    .help =
        "Stop when a search, where no sweep gives the value, has compared this many coordinates, "
        "the same on any machine; 10^9 take one to four seconds on one core"};

}  // namespace limit

/// When to stop before the worst box is found.
struct SearchLimits {
    std::uint64_t work = std::numeric_limits<std::uint64_t>::max();  ///< comparisons of coordinates
    double deadline = std::numeric_limits<double>::infinity();       ///< in the run's seconds
    double tolerance = 0;  ///< enough if upper - lower <= tolerance * lower

    /// Comparisons of about a quarter of a second.
    static constexpr std::uint64_t short_work = 1U << 28;

    /// Whether bounds may be all that is wanted.
    [[nodiscard]] bool wants_bounds() const {
        return tolerance > 0 || work < 4 * short_work || timed();
    }

    [[nodiscard]] bool timed() const { return deadline < std::numeric_limits<double>::infinity(); }

    /// Whether the time is over.
    [[nodiscard]] bool late(const RunContext& run) const {
        return timed() && run.seconds && run.seconds() >= deadline;
    }

    /// Whether the time is over or a stop was requested.
    [[nodiscard]] bool over(const RunContext& run) const {
        return run.stop.stop_requested() || late(run);
    }

    /// What is left when so many comparisons are done.
    [[nodiscard]] SearchLimits after(std::uint64_t spent) const;
};

enum class Ending { complete, tolerance, work, time, stopped };

/// What is certain when a search ended.
struct SearchResult {
    WorstBox worst;
    double upper;   ///< no value is above this
    Ending ending;  ///< if `complete`, the worst box is the worst of all

    /// Whether upper - lower <= tolerance * lower.
    [[nodiscard]] bool within(double tolerance) const {
        return upper - worst.value() <= tolerance * worst.value();
    }
};

/// Of one that found the worst of all, or was cut short, so that any value may be its upper bound.
SearchResult result_of_sweep(WorstBox worst, bool complete, const SearchLimits& limits,
                             const RunContext& run);

/// The results that every search has: lower, upper, exact, method; and value, where these are within
/// the tolerance.
Report report_of(const SearchResult& found, double tolerance, const char* method);

/// Progress of a search for what is between these bounds: how much of the gap is closed, and words
/// that say where it is. Ticks.
void report_gap(double lower, double upper, const RunContext& run);

/// What the options say, for a run whose clock is at `start`.
class Limits {
  public:
    /// @throws Error(usage)
    Limits(const Values& options, const RunContext& run);

    /// Those of a part of the whole, which has these shares of the work and of the time left.
    [[nodiscard]] Limits part(double of_work, double of_time, const RunContext& run) const;

    /// Says where bounds are all that is known of `what`, "the star discrepancy".
    /// @throws Error(limit) where nothing but the exact value will do
    void judge(const SearchResult& found, const std::string& what, const PointSet& points,
               const RunContext& run) const;

    SearchLimits search;
    bool exact = false;    ///< or nothing
    bool bounded = false;  ///< bounds will do
    double start = 0;

  private:
    [[noreturn]] void give_up(const SearchResult& found, const std::string& what,
                              const PointSet& points) const;

    double seconds_ = std::numeric_limits<double>::infinity();
    std::int64_t work_ = 0;
};

}  // namespace stipple::discrepancy
