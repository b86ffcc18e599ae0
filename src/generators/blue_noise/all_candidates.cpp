// SPDX-License-Identifier: MIT
#include "generators/blue_noise/all_candidates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

#include "core/machine/wide.hpp"
#include "core/rng.hpp"
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

/// Of `all` candidates the one farthest from the points so far.
std::vector<double> farthest(const BoxSpace& space, std::span<const std::vector<double>> along,
                             std::span<const double> turns, std::uint64_t all, SplitMix64 stream,
                             const RunContext& run) {
    std::vector<double> winner(along.size());
    std::vector<double> p(along.size());
    double best = -1;
    for (std::uint64_t candidate = 0; candidate < all; ++candidate) {
        if (candidate % 0x10000 == 0xffff) run.check_stop();
        for (std::size_t k = 0; k < along.size(); ++k) do
                p[k] = space.box.low[k] + to_unit(stream.next()) * space.box.extent(k);
            while (p[k] >= space.box.high[k]);
        const double squared = least_squared(along, turns, p.data(), best);
        if (squared <= best) continue;
        best = squared;
        winner = p;
    }
    return winner;
}

}  // namespace

std::vector<double> all_candidates(const BoxSpace& space, std::uint64_t seed, double factor,
                                   std::uint64_t wanted, const RunContext& run) {
    const std::size_t d = space.box.dimension();
    run.need_memory(static_cast<double>(wanted) * 2 * sizeof(double) * static_cast<double>(d),
                    fmt::format("{} points", wanted));
    std::vector<double> turns;  // sides of the torus; else infinite
    for (std::size_t k = 0; k < d; ++k)
        turns.push_back(space.torus ? space.box.extent(k)
                                    : std::numeric_limits<double>::infinity());
    const Rng rng(seed);
    std::vector<double> rows;
    std::vector<std::vector<double>> along(d);  // coordinates of the points; far ones behind them
    for (std::uint64_t i = 0; i < wanted; ++i) {
        if (i % 16 == 0) run.tick(i, wanted);
        const double all = std::max(1.0, std::floor(factor * static_cast<double>(i)));
        const std::vector<double> point = farthest(
            space, along, turns, static_cast<std::uint64_t>(all), SplitMix64(rng.bits(i)), run);
        rows.insert(rows.end(), point.begin(), point.end());
        for (std::size_t k = 0; k < d; ++k) {
            if (i % together == 0) along[k].resize(i + together, out_of_reach);
            along[k][i] = point[k];
        }
    }
    return rows;
}

}  // namespace stipple
