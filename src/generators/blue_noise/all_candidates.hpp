// SPDX-License-Identifier: MIT
//
// Mitchell's method as it is written down (best_candidate.cpp): of max(1, c i) places
// uniform in the box, all of which are made, the one farthest from the i points before it.
//
// A place loses as soon as a point is met that is as near as one of the best so far.
//
// Cost    one core does 10^4 points in 5-D with c = 1 in 20 s; c n^3.
// Promise point i does not depend on the number of points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "generators/box_space.hpp"
#include "stipple/run.hpp"

namespace stipple {

class AllCandidates {
  public:
    /// @param factor c; positive
    AllCandidates(const BoxSpace& space, std::uint64_t seed, double factor, const RunContext& run);

    /// Adds a point. @throws Error(cancelled)
    void add();

    /// Point after point.
    [[nodiscard]] const std::vector<double>& rows() const { return rows_; }

    /// Bytes that many points take.
    static double memory(double count, std::size_t dimension) {
        return count * 2 * sizeof(double) * static_cast<double>(dimension);
    }

  private:
    const BoxSpace& space_;
    double factor_;
    const RunContext& run_;
    Rng rng_;
    std::vector<double> rows_;
    std::vector<std::vector<double>> along_;  ///< coordinates of the points; far ones behind them
    std::vector<double> turns_;               ///< sides of the torus; else infinite
};

}  // namespace stipple
