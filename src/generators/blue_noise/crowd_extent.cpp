// SPDX-License-Identifier: MIT
#include "generators/blue_noise/crowd_extent.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "generators/box_space.hpp"

namespace stipple {
namespace {

constexpr std::size_t most_points = 65'536;
constexpr std::size_t most_balls = 256;
constexpr std::size_t outer_most = 64;  ///< points in a ball, its centre not counted
constexpr std::size_t fewest = 128;     ///< points that tell anything

/// The squares of two distances of a point: to its k-th and its 4k-th neighbour.
struct Balls {
    double inner;
    double outer;
};

/// One of each of `some` equal stretches of the numbers below `all`.
std::vector<std::size_t> spread_numbers(std::size_t all, std::size_t some) {
    const Rng rng(0, 0);
    std::vector<std::size_t> numbers;
    for (std::size_t i = 0; i < some; ++i) {
        const std::size_t first = i * all / some;
        numbers.push_back(first + rng.below(i, (i + 1) * all / some - first));
    }
    return numbers;
}

double quantile(std::vector<double> values, double share) {
    const double at = share * static_cast<double>(values.size());
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(at);
    std::ranges::nth_element(values, place);
    return *place;
}

std::vector<Balls> balls_of(std::span<const double> rows, std::size_t directions, std::size_t inner,
                            const RunContext& run) {
    const std::size_t all = rows.size() / directions;
    const auto others = spread_numbers(all, std::min(all, most_points));
    const auto centres = spread_numbers(others.size(), std::min(others.size(), most_balls));
    std::vector<double> squares(others.size());
    std::vector<Balls> balls;
    for (const std::size_t centre : centres) {
        run.check_stop();
        const double* from = rows.data() + others[centre] * directions;
        for (std::size_t i = 0; i < others.size(); ++i) {
            squares[i] = 0;
            for (std::size_t k = 0; k < directions; ++k) {
                const double step = rows[others[i] * directions + k] - from[k];
                squares[i] += step * step;
            }
        }
        const auto far = squares.begin() + static_cast<std::ptrdiff_t>(4 * inner);
        std::ranges::nth_element(squares, far);
        const auto near = squares.begin() + static_cast<std::ptrdiff_t>(inner);
        const double outer = *far;
        std::nth_element(squares.begin(), near, far);
        if (*near > 0) balls.push_back({*near, outer});
    }
    return balls;
}

/// The d for which 16^(1/d), the growth of a square, is nearest.
std::size_t dimension_for(double growth, std::size_t most) {
    // 16^(1 / (d + 1/2))
    constexpr std::array<double, 5> between = {6.3496, 3.0314, 2.2082, 1.8517, 1.6556};
    std::size_t d = 1;
    while (d < most && growth < between[d - 1]) ++d;
    return d;
}

}  // namespace

CrowdExtent crowd_extent(std::span<const double> rows, std::size_t directions,
                         std::size_t dimension, const RunContext& run) {
    const std::size_t all = rows.size() / directions;
    if (all < fewest) return {};
    const std::size_t inner = std::min(outer_most, all / 8) / 4;
    const auto balls = balls_of(rows, directions, inner, run);
    if (balls.empty()) return {};
    std::vector<double> growth;
    for (const Balls& b : balls) growth.push_back(b.outer / b.inner);
    const std::size_t d =
        dimension > 0 ? dimension : dimension_for(quantile(std::move(growth), 0.5), directions);
    std::vector<double> volumes;
    for (const Balls& b : balls) {
        double volume = unit_ball_volume(d) * (d % 2 == 1 ? std::sqrt(b.outer) : 1);
        for (std::size_t k = 0; k < d / 2; ++k) volume *= b.outer;
        volumes.push_back(volume);
    }
    const double points = static_cast<double>(4 * inner) - 0.5;
    const double looked_at = static_cast<double>(std::min(all, most_points));
    constexpr double inside = 0.3;  // far from any rim, as a rule
    return {d, quantile(std::move(volumes), inside) * looked_at / points};
}

}  // namespace stipple
