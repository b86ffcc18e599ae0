// SPDX-License-Identifier: MIT
#include "math/combinatorics/permutation_family.hpp"

#include <algorithm>

#include "math/combinatorics/permutation.hpp"

namespace stipple {
namespace {

constexpr std::uint64_t most_entries = std::uint64_t{1} << 20;

}  // namespace

PermutationFamily::PermutationFamily(std::uint64_t size, std::uint64_t members, const Rng& keys)
    : size_(size), keys_(keys) {
    if (members == 0 || size > most_entries / members) return;
    std::vector<double> images(size);
    table_.reserve(size * members);
    for (std::uint64_t member = 0; member < members; ++member) {
        Permutation(size, keys.bits(member)).fill(0, images);
        for (const double image : images) table_.push_back(static_cast<std::uint32_t>(image));
    }
}

std::uint64_t PermutationFamily::operator()(std::uint64_t member, std::uint64_t i) const {
    if (!table_.empty()) return table_[member * size_ + i];
    return Permutation(size_, keys_.bits(member))(i);
}

}  // namespace stipple
