// SPDX-License-Identifier: MIT
//
// Domains of directions about an axis.
#pragma once

#include <array>

namespace stipple {

/// What a domain also is whose points are unit vectors about an axis, and whose cube has a share of
/// the directions nearer to the axis first, then a longitude.
class Directional {
  public:
    Directional() = default;
    Directional(const Directional&) = delete;
    Directional& operator=(const Directional&) = delete;
    virtual ~Directional() = default;

    /// A unit vector.
    [[nodiscard]] virtual std::array<double, 3> axis() const = 0;

    /// Whether directions are within a right angle of the axis; else they are all there are.
    [[nodiscard]] virtual bool is_hemisphere() const = 0;
};

}  // namespace stipple
