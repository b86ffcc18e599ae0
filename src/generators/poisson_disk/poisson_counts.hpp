// SPDX-License-Identifier: MIT
//
// Number of darts that a round throws at a region of a box, such as a gap: one draw from a Poisson
// distribution for the whole region.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/rng.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::poisson_disk {

/// Poisson-distributed counts of darts on regions that consist of any number of equal parts, such
/// as sub-cells. Counts on up to `most` parts are drawn fastest.
class PoissonCounts {
  public:
    /// @param mean expected number of darts on one part; finite
    PoissonCounts(double mean, std::size_t most);

    [[nodiscard]] double mean(std::size_t parts) const {
        return mean_ * static_cast<double>(parts);
    }

    [[nodiscard]] std::uint64_t draw(std::size_t parts, SplitMix64& mixer) const {
        const double u = to_unit(mixer.next());
        if (parts < none_.size()) {
            const double none = none_[parts];
            if (u < none) return 0;
            return u < none + none * mean(parts) ? 1 : by_inversion(u, parts);
        }
        return in_portions(u, parts, mixer);
    }

  private:
    [[nodiscard]] std::uint64_t by_inversion(double u, std::size_t parts) const;
    [[nodiscard]] std::uint64_t in_portions(double u, std::size_t parts, SplitMix64& mixer) const;

    double mean_;
    std::vector<double> none_;  ///< probability of no dart, indexed by the number of parts
};

}  // namespace stipple::poisson_disk
