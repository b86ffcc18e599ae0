// SPDX-License-Identifier: MIT
//
// Many random permutations of {0, ..., size - 1}: one for each member 0, 1, ..., drawn from one
// stream of random numbers.
//
// Cost    a table of all images where there are at most 2^20 of them; else a permutation is made
//         anew for every image, in some 100 ns.
#pragma once

#include <cstdint>
#include <vector>

#include "core/rng.hpp"

namespace stipple {

class PermutationFamily {
  public:
    PermutationFamily() = default;
    PermutationFamily(std::uint64_t size, std::uint64_t members, const Rng& keys);

    /// Image of i < size under the permutation of `member`.
    [[nodiscard]] std::uint64_t operator()(std::uint64_t member, std::uint64_t i) const;

  private:
    std::uint64_t size_ = 1;
    Rng keys_{0};
    std::vector<std::uint32_t> table_;  ///< member after member, or empty
};

}  // namespace stipple
