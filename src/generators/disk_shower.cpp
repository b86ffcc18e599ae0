// SPDX-License-Identifier: MIT
#include "generators/disk_shower.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "math/exponential.hpp"

namespace stipple {
namespace {

constexpr double most_at_once = 16;  ///< mean that inversion is used for; more is drawn in portions

/// A Poisson number by inversion: the first whose cumulated probability is above u.
std::uint64_t by_inversion(double u, double mean, double none) {
    constexpr double nothing = 1e-20;  // probabilities that no double u can tell from 0
    double chance = none;
    double sum = none;
    std::uint64_t k = 0;
    while (u >= sum && chance > nothing) {
        chance *= mean / static_cast<double>(++k);
        sum += chance;
    }
    return k;
}

}  // namespace

Shower::Shower(double mean, std::size_t most) : mean_(mean) {
    double none = 1;
    const double none_on_one = exponential(-std::min(mean, most_at_once));
    for (std::size_t parts = 0; parts <= most && this->mean(parts) <= most_at_once; ++parts) {
        none_.push_back(none);
        none *= none_on_one;
    }
}

std::uint64_t Shower::on(std::size_t parts, Mixer& mixer) const {
    const double all = mean(parts);
    if (parts < none_.size()) return by_inversion(to_unit(mixer.next()), all, none_[parts]);
    const double portions = std::ceil(all / most_at_once);
    const double none = exponential(-all / portions);
    std::uint64_t sum = 0;
    for (double i = 0; i < portions; ++i)
        sum += by_inversion(to_unit(mixer.next()), all / portions, none);
    return sum;
}

}  // namespace stipple
