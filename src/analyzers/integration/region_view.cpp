// SPDX-License-Identifier: MIT
#include "analyzers/integration/region_view.hpp"

#include <algorithm>
#include <cmath>

#include "math/functions/trigonometry.hpp"

namespace stipple::analyzers {
namespace {

/// Bounding box of a domain that fills it; nullopt if their volumes differ.
std::optional<Box> filled_box(const Domain& domain) {
    if (domain.cube_dimension() != domain.dimension()) return std::nullopt;
    Box box = domain.bounding_box();
    const double volume = volume_of(box);
    const double measure = domain.measure();
    if (!(volume > 0) || !(std::abs(measure - volume) <= 1e-12 * volume)) return std::nullopt;
    return box;
}

/// Orthonormal frame with the given z axis.
Frame axes_about(const Vector3& z) {
    const bool near_x = std::abs(z[0]) > 0.5;
    const Vector3 other{near_x ? 0.0 : 1.0, near_x ? 1.0 : 0.0, 0.0};
    const double along = near_x ? z[1] : z[0];
    Vector3 x = minus(other, times(z, along));
    const double size = std::sqrt(dot(x, x));
    for (double& t : x) t /= size;
    return {x, cross(z, x), z};
}

}  // namespace

RegionView::RegionView(const Domain& domain, const Support& support)
    : domain_(domain), finite_(support.finite), box_(filled_box(domain)) {
    if (const auto shape = domain.sphere_shape(); shape && shape->pole)
        (shape->pole->hemisphere ? axes_ : pole_) = axes_about(shape->pole->axis);
}

bool RegionView::has(Region region) const {
    if (region == Region::cube) return box_.has_value();
    if (region == Region::hemisphere) return axes_.has_value();
    return finite_;
}

double RegionView::scale(Region region) const {
    return region == Region::hemisphere ? 1 : domain_.measure();
}

void RegionView::see(Region region, std::span<const double> point, std::span<double> seen) const {
    if (region == Region::hemisphere) {
        std::ranges::copy(axes_->in({point[0], point[1], point[2]}), seen.begin());
        return;
    }
    for (std::size_t k = 0; k < point.size(); ++k)
        seen[k] = region == Region::cube ? (point[k] - box_->low[k]) / box_->extent(k) : point[k];
}

bool RegionView::has_uniform() const { return domain_.even() && (box_ || axes_ || pole_); }

void RegionView::uniform(std::span<const double> cube, std::span<double> point) const {
    if (box_) {
        for (std::size_t k = 0; k < cube.size(); ++k)
            point[k] = box_->low[k] + cube[k] * box_->extent(k);
        return;
    }
    const Frame& axes = axes_ ? *axes_ : *pole_;
    const double drop = axes_ ? cube[0] : 2 * cube[0];
    const double z = 1 - drop;
    const double r = std::sqrt(drop * (2 - drop));
    const auto [cos, sin] = cos_sin_turns(cube[1]);
    std::ranges::copy(axes.out({r * cos, r * sin, z}), point.begin());
}

}  // namespace stipple::analyzers
