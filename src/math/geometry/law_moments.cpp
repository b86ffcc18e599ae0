// SPDX-License-Identifier: MIT
#include "math/geometry/law_moments.hpp"

#include <cmath>
#include <utility>

namespace stipple {
namespace {

Moments sized(std::size_t d) {
    return {std::vector<double>(d), std::vector<double>(d * d), std::vector<double>(d)};
}

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
        m.mean[k] = coordinates[k].mean;
        m.covariance[k * d + k] = coordinates[k].variance;
        m.skewness[k] = skewness_of(coordinates[k].variance, coordinates[k].third);
    }
    return m;
}

Moments triangle_moments(const std::array<std::vector<double>, 3>& corners) {
    const std::size_t d = corners[0].size();
    Moments m = sized(d);
    for (std::size_t k = 0; k < d; ++k)
        m.mean[k] = (corners[0][k] + corners[1][k] + corners[2][k]) / 3;
    for (std::size_t k = 0; k < d; ++k) {
        double third = 0;
        for (const auto& corner : corners) {
            const double from = corner[k] - m.mean[k];
            third += from * from * from / 30;
            for (std::size_t j = 0; j < d; ++j)
                m.covariance[k * d + j] += from * (corner[j] - m.mean[j]) / 12;
        }
        m.skewness[k] = skewness_of(m.covariance[k * d + k], third);
    }
    return m;
}

MixedMoments::MixedMoments(std::vector<double> about)
    : about_(std::move(about)),
      first_(about_.size()),
      second_(about_.size() * about_.size()),
      third_(about_.size()) {}

void MixedMoments::add(double weight, const Moments& part) {
    const std::size_t d = about_.size();
    weight_ += weight;
    for (std::size_t k = 0; k < d; ++k) {
        const double m = part.mean[k] - about_[k];
        const double variance = part.covariance[k * d + k];
        const double third = part.skewness[k] * variance * std::sqrt(variance);
        first_[k] += weight * m;
        third_[k] += weight * (third + m * (3 * variance + m * m));
        for (std::size_t j = 0; j < d; ++j)
            second_[k * d + j] +=
                weight * (part.covariance[k * d + j] + m * (part.mean[j] - about_[j]));
    }
}

Moments MixedMoments::moments() const {
    const std::size_t d = about_.size();
    Moments all = sized(d);
    for (std::size_t k = 0; k < d; ++k) {
        const double m = first_[k] / weight_;
        all.mean[k] = about_[k] + m;
        for (std::size_t j = 0; j < d; ++j)
            all.covariance[k * d + j] = second_[k * d + j] / weight_ - m * (first_[j] / weight_);
        const double raw = second_[k * d + k] / weight_;
        const double third = third_[k] / weight_ - m * (3 * raw - 2 * m * m);
        all.skewness[k] = skewness_of(all.covariance[k * d + k], third);
    }
    return all;
}

}  // namespace stipple
