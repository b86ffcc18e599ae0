// SPDX-License-Identifier: MIT
//
// A domain in the coordinates of integrands: a box stretched onto the unit cube, a hemisphere
// rotated so that its axis is z, or any domain as it is.
#pragma once

#include <optional>
#include <span>

#include "core/domain.hpp"
#include "math/geometry/vector3.hpp"
#include "math/integrands/integrands.hpp"

namespace stipple::analyzers {

class RegionView {
  public:
    /// The domain must outlive the view.
    RegionView(const Domain& domain, const Support& support);

    [[nodiscard]] bool has(Region region) const;

    /// Factor that converts the integral over the region to that over the domain.
    [[nodiscard]] double scale(Region region) const;

    /// Converts a point of the domain to the coordinates of the region.
    void see(Region region, std::span<const double> point, std::span<double> seen) const;

    /// Whether uniform() is available: for boxes, hemispheres and lobes on the whole sphere.
    [[nodiscard]] bool has_uniform() const;

    /// Maps a point of the unit cube to the domain, uniformly by measure, regardless of density.
    void uniform(std::span<const double> cube, std::span<double> point) const;

  private:
    const Domain& domain_;
    bool finite_;                ///< whether the support has a finite measure
    std::optional<Box> box_;     ///< bounding box, if the domain fills it
    std::optional<Frame> axes_;  ///< for a hemisphere: frame with its axis as z
    std::optional<Frame> pole_;  ///< for the whole sphere: frame with the distribution's axis as z
};

}  // namespace stipple::analyzers
