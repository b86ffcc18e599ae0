// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/poisson_counts.hpp"

#include <algorithm>
#include <cmath>

#include "math/functions/exponential.hpp"

namespace stipple::poisson_disk {
namespace {

constexpr double most_at_once = 16;  ///< largest mean for inversion; a larger mean is split

constexpr auto inverses = [] {
    std::array<double, 64> table{};
    for (std::size_t k = 1; k < table.size(); ++k) table[k] = 1 / static_cast<double>(k);
    return table;
}();

/// First count with a cumulative Poisson probability above u; `none` is the probability of 0.
std::uint64_t first_above(double u, double mean, double none) {
    constexpr double nothing = 1e-20;  // probabilities below the resolution of u
    double chance = none;
    double sum = none;
    std::uint64_t k = 0;
    while (u >= sum && chance > nothing) {
        ++k;
        chance *= k < inverses.size() ? mean * inverses[k] : mean / static_cast<double>(k);
        sum += chance;
    }
    return k;
}

}  // namespace

PoissonCounts::PoissonCounts(double mean, std::size_t most) : mean_(mean) {
    double none = 1;
    const double none_on_one = exponential(-std::min(mean, most_at_once));
    for (std::size_t parts = 0; parts <= most && this->mean(parts) <= most_at_once; ++parts) {
        none_.push_back(none);
        none *= none_on_one;
    }
}

std::uint64_t PoissonCounts::by_inversion(double u, std::size_t parts) const {
    return first_above(u, mean(parts), none_[parts]);
}

std::uint64_t PoissonCounts::in_portions(double u, std::size_t parts, SplitMix64& mixer) const {
    const double all = mean(parts);
    const double portions = std::ceil(all / most_at_once);
    const double none = exponential(-all / portions);
    std::uint64_t sum = 0;
    for (double left = portions; left > 0; --left, u = to_unit(mixer.next()))
        sum += first_above(u, all / portions, none);
    return sum;
}

}  // namespace stipple::poisson_disk
