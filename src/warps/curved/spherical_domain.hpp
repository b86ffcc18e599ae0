// SPDX-License-Identifier: MIT
//
// A convex polygon of directions, uniform in solid angle. Its cells are the way back of a map,
// other than the warp's own, so that they do not line up with its strata.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "math/geometry/spherical_polygon.hpp"
#include "warps/curved/placement.hpp"
#include "warps/named_domain.hpp"

namespace stipple::warps {

class SphericalDomain final : public NamedDomain {
  public:
    using Cells = std::function<std::array<double, 2>(std::span<const double>)>;

    /// @param cells the map's way back
    /// @param slack how far beyond the planes of the edges, and how much longer or shorter than 1,
    /// rounding may take a direction that was made
    SphericalDomain(std::string spec, SphericalPolygon polygon, Cells cells, double area,
                    double slack, std::vector<std::string> axes)
        : NamedDomain(std::move(spec), 3, 2),
          polygon_(std::move(polygon)),
          cells_(std::move(cells)),
          area_(area),
          slack_(slack),
          axes_(std::move(axes)) {}

    double measure() const override { return area_; }
    bool contains(std::span<const double> point) const override {
        return polygon_.contains(vector_of(point), slack_);
    }
    Box bounding_box() const override { return polygon_.bounding_box(); }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        put_clamped(cells_(point), cube);
    }
    std::optional<Discontinuities> discontinuities() const override {
        return Discontinuities{.circles = polygon_.edges()};
    }
    std::optional<Moments> moments() const override { return polygon_.moments(area_); }
    std::vector<std::string> cube_axes() const override { return axes_; }

  private:
    SphericalPolygon polygon_;
    Cells cells_;
    double area_;
    double slack_;
    std::vector<std::string> axes_;
};

}  // namespace stipple::warps
