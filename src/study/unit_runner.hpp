// SPDX-License-Identifier: MIT
//
// Makes the sets of a study and analyzes them: units in, results out.
//
// A set is analyzed after all warps. A measure that does not accept the warps' domain (most
// discrepancies accept the unit cube only) gets the points before the first warp, but after any
// scrambles before it; the row names the domain of these points.
//
// Promise  results, except seconds, depend on the unit alone: neither on the units that are run
//          together with it nor on threads. A failure is a result with the reason.
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

/// Results of a piece of work.
struct WorkDone {
    std::vector<Segment> segments = {};
    std::vector<UnitRange> too_large = {};  ///< units that need more memory than this worker had
    double seconds = 0;                     ///< spent on making and measuring sets
};

class UnitRunner {
  public:
    /// Finds out which measures accept warped points. @param run has the memory limit of a unit
    /// that runs alone
    /// @throws Error(cancelled)
    UnitRunner(const Sweep& sweep, const RunContext& run);

    [[nodiscard]] const Sweep& sweep() const { return sweep_; }

    /// Runs units. @param run has the memory limit of this worker; receives no progress and no
    /// warnings
    /// @throws Error(cancelled)
    [[nodiscard]] WorkDone run(const std::vector<UnitRange>& ranges, const RunContext& run) const;

    /// One sentence for the user for each measure that gets the points before the warps.
    [[nodiscard]] std::vector<std::string> before_warps() const;

    /// Checks the measures' options. @throws Error(usage) for options that are wrong for every set
    /// of the study
    void require_options(const RunContext& run) const;

  private:
    /// A measure and a group of sets that it either all accepts or all refuses.
    struct View {
        std::size_t warps = 0;  ///< index of their WarpList
        std::size_t dimension = 0;
        std::size_t measure = 0;
        auto operator<=>(const View&) const = default;
    };
    [[nodiscard]] bool may_take_image(const View& view, const RunContext& run) const;
    [[nodiscard]] bool takes_image(const View& view) const { return !before_warps_.contains(view); }
    [[nodiscard]] std::optional<Error> refusal_of(const View& view, std::size_t count,
                                                  const RunContext& run) const;

    const Sweep& sweep_;
    std::uint64_t whole_memory_;
    std::set<View> before_warps_;  ///< those where the measure gets the points before the warps
};

/// Whether one of `wanted` is the key or one of its parts, which are separated by dots: `value` and
/// `centered` match centered.value, `mean` matches mean[0].
bool is_meant(const std::string& key, const std::vector<std::string>& wanted);

/// Returns a report's numbers in order, under dotted keys; flags are 0 and 1. Lists, as numbers
/// NAME[I], are included if `curves` is true, if `keys` is not empty, or if there are no other
/// numbers. If `keys` is not empty, only numbers with is_meant() keys are returned.
std::vector<KeyedNumber> numbers_of(const Report& report, const std::vector<std::string>& keys,
                                    bool curves);

}  // namespace stipple
