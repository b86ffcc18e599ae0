// SPDX-License-Identifier: MIT
//
// Good lower bounds quickly: coordinate ascent from random corners, and from corners that are near
// those where it ended.
#pragma once

#include <functional>
#include <vector>

#include "analyzers/discrepancy/search_limits.hpp"
#include "analyzers/discrepancy/star/star_box.hpp"
#include "core/run_context.hpp"

namespace stipple::analyzers::star {

/// A box found bad in a set that is much the same.
struct Hint {
    Side side;
    std::vector<double> corner;
};

struct Ascent {
    WorstBox worst;
    std::uint64_t work;  ///< comparisons of coordinates
};

/// The worst box that ascents from up to 200 corners on each side reach, fewer for large sets, for
/// little work, and where there is a hint to start from; every ascent takes the best place on one
/// axis with the others fixed, until none helps. One step there is at least. Deterministic, unless
/// the time or a stop ends it: then with what it has.
Ascent ascend(const CornerGrid& grid, const SearchLimits& limits, const RunContext& run,
              const Hint* hint = nullptr);

/// A search for bad boxes without end: ascents whose starts are the ends of others, moved a bit on
/// some axes; a worse end is taken for one that is better by less than a threshold, which falls.
///
/// Source  M. Gnewuch, M. Wahlstroem, C. Winzen, SIAM J. Numer. Anal. 50 (2012) 781-807 (threshold
///         accepting for star discrepancies, there without ascents).
class BoxHunt {
  public:
    /// Keeps a reference to the grid.
    explicit BoxHunt(const CornerGrid& grid) : grid_(grid) {}

    /// Some walks more; offers what they find. Deterministic, unless the time ends it.
    /// @returns the comparisons of coordinates that it took.
    std::uint64_t go(WorstBox& worst, const SearchLimits& limits, const RunContext& run);

  private:
    void walk(class Climber& climber, std::uint64_t number, WorstBox& worst,
              const std::function<bool()>& late) const;

    const CornerGrid& grid_;
    std::uint64_t round_ = 0;
};

}  // namespace stipple::analyzers::star
