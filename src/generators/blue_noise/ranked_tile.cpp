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

/// Orders points of the torus.
class Ranking {
  public:
    Ranking(std::vector<Vec2> points, Vec2 sides, const RunContext& run)
        : points_(std::move(points)),
          sides_{std::sqrt(sides.x / sides.y), std::sqrt(sides.y / sides.x)},
          energies_(points_.size()),
          run_(run) {}

    /// The points, those taken last in front.
    std::vector<Vec2> ranked() {
        const auto all = static_cast<double>(points_.size());
        std::size_t widen = points_.size();
        double narrow = 0.5 * all / (0.47 * 0.47);  // 1 / (2 sigma^2): 0.47 of the mean distance
        for (std::size_t left = points_.size(); left > 0; --left) {
            run_.tick(points_.size() - left, points_.size());
            if (left == widen) {
                gather(left, narrow);
                sharpness_ = narrow;
                narrow /= 4;
                widen /= 4;
            }
            const auto end = energies_.begin() + static_cast<std::ptrdiff_t>(left);
            const auto fullest = static_cast<std::size_t>(std::max_element(energies_.begin(), end) -
                                                          energies_.begin());
            std::swap(points_[fullest], points_[left - 1]);
            std::swap(energies_[fullest], energies_[left - 1]);
            for (std::size_t i = 0; i + 1 < left; ++i)
                energies_[i] -= felt(points_[i], points_[left - 1], sharpness_);
        }
        return std::move(points_);
    }

  private:
    [[nodiscard]] double felt(const Vec2& p, const Vec2& q, double sharpness) const {
        const double x = sides_.x * difference(p.x, q.x);
        const double y = sides_.y * difference(p.y, q.y);
        return exponential(-sharpness * (x * x + y * y));
    }

    void gather(std::size_t left, double sharpness) {
        for (std::size_t i = 0; i < left; ++i) {
            if (i % 64 == 0) run_.check_stop();
            energies_[i] = 0;
            for (std::size_t j = 0; j < left; ++j)
                energies_[i] += felt(points_[i], points_[j], sharpness);
        }
    }

    std::vector<Vec2> points_;
    Vec2 sides_;  ///< of the torus of area 1
    std::vector<double> energies_;
    double sharpness_ = 0;
    const RunContext& run_;
};

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
    return Ranking(std::move(points), sides, run.stage(0.7, 1)).ranked();
}

}  // namespace stipple
