// SPDX-License-Identifier: MIT
//
// How many darts of a shower fall on a piece of a box: Poisson, one draw for a piece.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/mixer.hpp"

namespace stipple {

/// Poisson numbers for pieces of 0 ... most equal parts.
class Shower {
  public:
    /// @param mean number of darts to a part; finite
    Shower(double mean, std::size_t most);

    [[nodiscard]] double mean(std::size_t parts) const {
        return mean_ * static_cast<double>(parts);
    }

    /// Darts on that many parts.
    [[nodiscard]] std::uint64_t on(std::size_t parts, Mixer& mixer) const;

  private:
    double mean_;
    std::vector<double> none_;  ///< probability of no dart on so many parts
};

}  // namespace stipple
