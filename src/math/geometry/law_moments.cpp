// SPDX-License-Identifier: MIT
#include "math/geometry/law_moments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/functions/powers.hpp"

namespace stipple {
namespace {

Moments sized(std::size_t d) {
    return {std::vector<double>(d), std::vector<double>(d * d), std::vector<double>(d)};
}

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

double skewness_of(double variance, double third) {
    return variance == 0 ? 0 : third / variance / std::sqrt(variance);
}

}  // namespace

PlaneMoments about_the_mean(const PlaneMoments& raw) {
    const auto [x, y] = raw.mean;
    PlaneMoments m{.mean = raw.mean};
    m.xx = raw.xx - x * x;
    m.xy = raw.xy - x * y;
    m.yy = raw.yy - y * y;
    m.xxx = raw.xxx - 3 * x * raw.xx + 2 * x * x * x;
    m.xxy = raw.xxy - 2 * x * raw.xy - y * raw.xx + 2 * x * x * y;
    m.xyy = raw.xyy - 2 * y * raw.xy - x * raw.yy + 2 * x * y * y;
    m.yyy = raw.yyy - 3 * y * raw.yy + 2 * y * y * y;
    return m;
}

Moments placed_moments(const PlaneMoments& shape, const Placement& at) {
    Moments m = sized(2);
    const double center[] = {at.center.x, at.center.y};
    const PlanePoint rows[] = {{at.cos, -at.sin}, {at.sin, at.cos}};
    const auto second = [&](const PlanePoint& a, const PlanePoint& b) {
        return a.x * b.x * shape.xx + (a.x * b.y + a.y * b.x) * shape.xy + a.y * b.y * shape.yy;
    };
    for (std::size_t k = 0; k < 2; ++k) {
        const auto [a, b] = rows[k];
        m.mean[k] = center[k] + at.size * (a * shape.mean.x + b * shape.mean.y);
        const double third = a * a * a * shape.xxx + 3 * a * a * b * shape.xxy +
                             3 * a * b * b * shape.xyy + b * b * b * shape.yyy;
        m.skewness[k] = skewness_of(second(rows[k], rows[k]), third);
        for (std::size_t j = 0; j < 2; ++j)
            m.covariance[2 * k + j] = at.size * at.size * second(rows[k], rows[j]);
    }
    return m;
}

AxialMoments direction_moments(double z, double zz, double zzz) {
    const double across = 0.5 * (1 - zz);
    return {.along = {z, zz - z * z, zzz - 3 * z * zz + 2 * z * z * z},
            .across = across,
            .across_along = 0.5 * (z - zzz) - z * across};
}

Moments axial_moments(const AxialMoments& shape, const Frame& frame, const Vector3& center,
                      double size) {
    Moments m = sized(3);
    const Vector3& z = frame.z;
    for (std::size_t k = 0; k < 3; ++k) {
        m.mean[k] = center[k] + size * (z[k] * shape.along.mean);
        const double rest = 1 - z[k] * z[k];
        const double variance = z[k] * z[k] * shape.along.variance + rest * shape.across;
        const double third =
            z[k] * (z[k] * z[k] * shape.along.third + 3 * rest * shape.across_along);
        m.skewness[k] = skewness_of(variance, third);
        for (std::size_t j = 0; j < 3; ++j) {
            const double both = z[k] * z[j];
            const double across = (k == j ? 1 : 0) - both;
            m.covariance[3 * k + j] =
                size * size * (both * shape.along.variance + across * shape.across);
        }
    }
    return m;
}

Moments independent_moments(std::span<const LineMoments> coordinates) {
    const std::size_t d = coordinates.size();
    Moments m = sized(d);
    for (std::size_t k = 0; k < d; ++k) {
        const auto& [mean, variance, third, unit] = coordinates[k];
        m.mean[k] = mean;
        const double whole = variance * unit * unit;
        const bool lost = variance > 0 && whole < std::numeric_limits<double>::min();
        m.covariance[k * d + k] = lost ? unknown : whole;
        m.skewness[k] = skewness_of(variance, third);
    }
    return m;
}

Moments triangle_moments(const std::array<std::vector<double>, 3>& corners) {
    const std::size_t d = corners[0].size();
    Moments m = sized(d);
    for (std::size_t k = 0; k < d; ++k)
        m.mean[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3;
    for (std::size_t k = 0; k < d; ++k) {
        double most = 0;
        for (const auto& corner : corners) most = std::max(most, std::abs(corner[k] - m.mean[k]));
        const double unit = unit_for(most);
        double square = 0, third = 0;
        for (const auto& corner : corners) {
            const double from = corner[k] - m.mean[k];
            const double own = from / unit;
            square += own * own / 12;
            third += own * own * own / 30;
            for (std::size_t j = 0; j < d; ++j)
                m.covariance[k * d + j] += from * (corner[j] - m.mean[j]) / 12;
        }
        m.skewness[k] = skewness_of(square, third);
    }
    return m;
}

MixedMoments::MixedMoments(const Box& around)
    : mean_(around.low),
      off_(mean_.size()),
      covariance_(mean_.size() * mean_.size()),
      third_(mean_.size()) {
    for (std::size_t k = 0; k < mean_.size(); ++k)
        per_unit_.push_back(1 / unit_for(around.extent(k)));
}

void MixedMoments::add(double weight, const Moments& part) {
    if (!(weight > 0)) return;
    const std::size_t d = mean_.size();
    const double all = weight_ + weight;
    const double here = weight / all;
    const double before = weight_ / all;
    weight_ = all;
    for (std::size_t k = 0; k < d; ++k) {
        const double step = part.mean[k] - mean_[k];
        const double m = off_[k] = step * per_unit_[k];
        const double old = covariance_[k * d + k];
        const double variance = part.covariance[k * d + k] * per_unit_[k] * per_unit_[k];
        const double third = part.skewness[k] * variance * std::sqrt(variance);
        third_[k] = before * third_[k] + here * third +
                    before * here * m * (3 * (variance - old) + (before - here) * m * m);
        for (std::size_t j = 0; j <= k; ++j) {
            double& both = covariance_[k * d + j];
            both = before * both +
                   here * (part.covariance[k * d + j] * per_unit_[k] * per_unit_[j]) +
                   before * here * m * off_[j];
        }
        mean_[k] = here < before ? mean_[k] + here * step : part.mean[k] - before * step;
    }
}

Moments MixedMoments::moments() const {
    const std::size_t d = mean_.size();
    Moments all = sized(d);
    all.mean = mean_;
    for (std::size_t k = 0; k < d; ++k) {
        for (std::size_t j = 0; j <= k; ++j)
            all.covariance[k * d + j] = all.covariance[j * d + k] =
                covariance_[k * d + j] / per_unit_[k] / per_unit_[j];
        const double variance = covariance_[k * d + k];
        constexpr double least = 1e-190;  // third moments of smaller ones underflow
        all.skewness[k] =
            variance > 0 && variance < least ? unknown : skewness_of(variance, third_[k]);
    }
    return all;
}

}  // namespace stipple
