// SPDX-License-Identifier: MIT
#include "math/combinatorics/combinations.hpp"

#include <algorithm>
#include <limits>

#include "core/machine/int128.hpp"

namespace stipple {

std::uint64_t binomial(std::uint64_t n, std::uint64_t k) {
    if (k > n) return 0;
    k = std::min(k, n - k);
    Uint128 value = 1;
    for (std::uint64_t i = 1; i <= k; ++i) {
        value = value * (n - k + i) / i;  // C(n - k + i, i), an integer that grows with i
        if (value > std::numeric_limits<std::uint64_t>::max())
            return std::numeric_limits<std::uint64_t>::max();
    }
    return static_cast<std::uint64_t>(value);
}

Combination combination(std::uint64_t number, std::size_t size) {
    Combination found(size);
    for (std::size_t k = size; k > 0; --k) {
        std::uint64_t c = k - 1;
        std::uint64_t above = 1;  // C(c + 1, k)
        for (; above <= number; above = binomial(c + 1, k)) ++c;
        found[k - 1] = c;
        number -= binomial(c, k);
    }
    return found;
}

std::uint64_t combination_number(const Combination& combination) {
    std::uint64_t number = 0;
    for (std::size_t k = 0; k < combination.size(); ++k) number += binomial(combination[k], k + 1);
    return number;
}

void next_combination(Combination& combination) {
    std::size_t k = 0;
    while (k + 1 < combination.size() && combination[k] + 1 == combination[k + 1]) {
        combination[k] = k;
        ++k;
    }
    ++combination[k];
}

}  // namespace stipple
