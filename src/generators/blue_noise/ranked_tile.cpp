// SPDX-License-Identifier: MIT
#include "generators/blue_noise/ranked_tile.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rng.hpp"
#include "generators/blue_noise/relaxation/gaussian_relaxation.hpp"
#include "math/functions/exponential.hpp"

namespace stipple {
namespace {

double difference(double a, double b) {
    const double t = std::abs(a - b);
    return std::min(t, 1 - t);
}

/// The points of the torus, those taken last in front.
std::vector<Vec2> ranked(std::vector<Vec2> points, Vec2 sides, const RunContext& run) {
    const Vec2 torus{std::sqrt(sides.x / sides.y), std::sqrt(sides.y / sides.x)};  // of area 1
    const auto felt = [&](const Vec2& p, const Vec2& q, double sharpness) {
        const double x = torus.x * difference(p.x, q.x);
        const double y = torus.y * difference(p.y, q.y);
        return exponential(-sharpness * (x * x + y * y));
    };
    std::vector<double> energies(points.size());
    std::size_t widen = points.size();
    // 1 / (2 sigma^2): to begin with, sigma is 0.47 of the mean distance.
    double sharpness = 4 * 0.5 * static_cast<double>(points.size()) / (0.47 * 0.47);
    for (std::size_t left = points.size(); left > 0; --left) {
        run.tick(points.size() - left, points.size());
        if (left == widen) {
            sharpness /= 4;
            widen /= 4;
            for (std::size_t i = 0; i < left; ++i) {
                if (i % 64 == 0) run.check_stop();
                energies[i] = 0;
                for (std::size_t j = 0; j < left; ++j)
                    energies[i] += felt(points[i], points[j], sharpness);
            }
        }
        const auto end = energies.begin() + static_cast<std::ptrdiff_t>(left);
        const auto fullest =
            static_cast<std::size_t>(std::max_element(energies.begin(), end) - energies.begin());
        std::swap(points[fullest], points[left - 1]);
        std::swap(energies[fullest], energies[left - 1]);
        for (std::size_t i = 0; i + 1 < left; ++i)
            energies[i] -= felt(points[i], points[left - 1], sharpness);
    }
    return points;
}

}  // namespace

std::vector<Vec2> ranked_tile(std::size_t count, std::uint64_t steps, Vec2 sides,
                              std::uint64_t seed, const RunContext& run) {
    constexpr double grain = 0x1p28;
    run.need_memory(relaxation_bytes(count, 2) + 56 * static_cast<double>(count), "the tile");
    std::vector<double> rows(2 * count);
    Rng(seed).fill(0, rows);
    relax_gaussian(rows, 2, steps, run.stage(0, 0.7), std::array{sides.x, sides.y});
    std::vector<Vec2> points(count);
    for (std::size_t i = 0; i < count; ++i)
        points[i] = {std::floor(rows[2 * i] * grain) / grain,
                     std::floor(rows[2 * i + 1] * grain) / grain};
    return ranked(std::move(points), sides, run.stage(0.7, 1));
}

}  // namespace stipple
