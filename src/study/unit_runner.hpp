// SPDX-License-Identifier: MIT
//
// Makes the sets of a study and measures them: units in, results out.
//
// What a set is measured on: its points after all warps. A measure that cannot take what those are
// on (most discrepancies take the unit cube only) looks at the points before the first warp, after
// the scrambles that stand there; the row's domain says so.
//
// Promise  results, except seconds, depend on the unit alone: not on the units that are measured
//          with it, nor on threads. A failure is a result with the reason.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "stipple/run.hpp"
#include "study/study_table.hpp"
#include "study/sweep.hpp"

namespace stipple {

/// What became of a piece of work.
struct WorkDone {
    std::vector<Segment> segments = {};
    std::vector<UnitRange> too_large = {};  ///< units that need more memory than a worker's share
    double seconds = 0;                     ///< spent on making and measuring sets
};

class UnitRunner {
  public:
    /// @param run its memory is what units may have that are too large for a worker's share
    /// @throws Error(cancelled)
    UnitRunner(const Sweep& sweep, const RunContext& run);

    [[nodiscard]] const Sweep& sweep() const { return sweep_; }

    /// @param run its memory is the worker's share; it hears of nothing
    /// @throws Error(cancelled)
    [[nodiscard]] WorkDone run(const std::vector<UnitRange>& ranges, const RunContext& run) const;

    /// The measures that look at points before the warps, in a sentence each.
    [[nodiscard]] std::vector<std::string> before_warps() const;

    /// @throws Error(usage): a measure's options that are wrong for every set of the study
    void require_options(const RunContext& run) const;

  private:
    [[nodiscard]] bool takes_image(std::size_t dimension, std::size_t measure) const {
        return !before_warps_.contains({dimension, measure});
    }
    [[nodiscard]] std::optional<Error> refusal_of(std::size_t measure, std::size_t dimension,
                                                  std::size_t count, const RunContext& run) const;

    const Sweep& sweep_;
    std::uint64_t whole_memory_;
    /// Dimensions, and measures that look at points of them before the warps.
    std::set<std::pair<std::size_t, std::size_t>> before_warps_;
};

/// A report's numbers in order, under dotted keys, flags as 0 and 1. Lists of numbers as NAME[I]:
/// with `curves`, or where there is nothing else. With `keys`, those of which a key is a part, from
/// dot to dot: value is in centered.value, mean in mean[0].
std::vector<KeyedNumber> numbers_of(const Report& report, const std::vector<std::string>& keys,
                                    bool curves);

}  // namespace stipple
