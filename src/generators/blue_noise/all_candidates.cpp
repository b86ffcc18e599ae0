// SPDX-License-Identifier: MIT
#include "generators/blue_noise/all_candidates.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/machine/wide.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple {
namespace {

constexpr std::size_t together = 32;  ///< points that are looked at at once
constexpr double out_of_reach = 1e300;

/// The least squared distance of p to some points; or `enough`, as soon as one is as near as that.
/// @param along coordinates, up to a multiple of `together`
STIPPLE_WIDE double least_squared(std::span<const std::vector<double>> along,
                                  std::span<const double> turns, const double* p, double enough) {
    std::array<double, together> least;
    least.fill(std::numeric_limits<double>::infinity());
    for (std::size_t first = 0; first < along[0].size(); first += together) {
        std::array<double, together> squared{};
        for (std::size_t k = 0; k < along.size(); ++k) {
            const double* const q = &along[k][first];
            for (std::size_t i = 0; i < together; ++i) {
                const double straight = std::abs(q[i] - p[k]);
                const double around = turns[k] - straight;
                const double shorter = around < straight ? around : straight;
                squared[i] += shorter * shorter;
            }
        }
        std::int64_t near = 0;
        for (std::size_t i = 0; i < together; ++i) {
            near |= squared[i] <= enough ? 1 : 0;
            least[i] = squared[i] < least[i] ? squared[i] : least[i];
        }
        if (near != 0) return enough;
    }
    return std::ranges::min(least);
}

}  // namespace

AllCandidates::AllCandidates(const BoxSpace& space, std::uint64_t seed, double factor,
                             const RunContext& run)
    : space_(space), factor_(factor), run_(run), rng_(seed), along_(space.box.dimension()) {
    for (std::size_t k = 0; k < along_.size(); ++k)
        turns_.push_back(space.torus ? space.box.extent(k)
                                     : std::numeric_limits<double>::infinity());
}

void AllCandidates::add() {
    const std::size_t d = along_.size();
    const std::size_t number = rows_.size() / d;
    const auto all = static_cast<std::uint64_t>(
        std::max(1.0, std::floor(factor_ * static_cast<double>(number))));
    SplitMix64 stream(rng_.bits(number));
    std::vector<double> winner(d);
    std::vector<double> p(d);
    double best = -1;
    for (std::uint64_t candidate = 0; candidate < all; ++candidate) {
        if (candidate % 0x10000 == 0xffff) run_.check_stop();
        for (std::size_t k = 0; k < d; ++k) do
                p[k] = space_.box.low[k] + to_unit(stream.next()) * space_.box.extent(k);
            while (p[k] >= space_.box.high[k]);
        const double squared = least_squared(along_, turns_, p.data(), best);
        if (squared <= best) continue;
        best = squared;
        winner = p;
    }
    rows_.insert(rows_.end(), winner.begin(), winner.end());
    for (std::size_t k = 0; k < d; ++k) {
        if (number % together == 0) along_[k].resize(number + together, out_of_reach);
        along_[k][number] = winner[k];
    }
}

}  // namespace stipple
