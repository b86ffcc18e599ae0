// SPDX-License-Identifier: MIT
//
// A domain as integrands see it: a box, stretched onto the unit cube, a hemisphere, turned until
// its axis is z, or any domain as it is.
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

    /// By what the integral over the region is to be multiplied to be that over the domain.
    [[nodiscard]] double scale(Region region) const;

    /// A point of the domain in the coordinates of the region.
    void see(Region region, std::span<const double> point, std::span<double> seen) const;

    /// Whether `uniform` can be asked: of boxes, hemispheres and lobes on the whole sphere.
    [[nodiscard]] bool has_uniform() const;

    /// The point of the domain that its measure alone, without its density, gives to a point of the
    /// unit cube.
    void uniform(std::span<const double> cube, std::span<double> point) const;

  private:
    const Domain& domain_;
    bool finite_;                ///< the measure of where the density is not 0
    std::optional<Box> box_;     ///< of a domain that fills it
    std::optional<Frame> axes_;  ///< of a hemisphere; z is its own
    std::optional<Frame> pole_;  ///< the same, of a law on the whole sphere
};

}  // namespace stipple::analyzers
