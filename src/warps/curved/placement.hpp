// SPDX-License-Identifier: MIT
//
// Position and orientation of shapes in space: options shared by several warps, with their checks.
#pragma once

#include <span>
#include <vector>

#include "core/domain.hpp"
#include "core/options.hpp"
#include "math/geometry/vector3.hpp"
#include "warps/common_options.hpp"

namespace stipple::warps {

constexpr auto radius = length_option("radius", 1, "Radius, above 0");

constexpr Param<Numbers> center_option{
    {.name = "center", .fallback = "0,0,0", .help = "Centre: x,y,z"}};

constexpr Param<Numbers> axis_option{
    {.name = "axis", .fallback = "0,0,1", .help = "Axis: x,y,z, of any length above 0"}};

/// Returns --center. @throws Error(usage) if the centre is not three numbers, or is so far from 0
/// that rounding destroys a shape of size `reach`
Vector3 center_of(const Values& options, double reach);

/// Frame with the z axis --axis. @throws Error(usage) unless this is three numbers, not all 0
Frame frame_of(const Values& options);

/// Vector of an option's three numbers. @throws Error(usage) for another count of numbers
Vector3 vector_of(const Param<Numbers>& option, const std::vector<double>& numbers);

/// Bounding box of all points within the distance `beyond` of a cylinder with centre `middle`, axis
/// `direction`, length 2 `along` and radius `across`.
Box box_about(const Vector3& middle, const Vector3& direction, double beyond, double along,
              double across);

struct Sphere {
    double radius;
    Vector3 center;

    /// Maps a point of space to the unit ball's coordinates: centre 0, radius 1.
    [[nodiscard]] Vector3 unit(std::span<const double> point) const {
        return {(point[0] - center[0]) / radius, (point[1] - center[1]) / radius,
                (point[2] - center[2]) / radius};
    }

    /// Maps a point of the unit ball to space.
    [[nodiscard]] Vector3 place(const Vector3& v) const {
        return {center[0] + radius * v[0], center[1] + radius * v[1], center[2] + radius * v[2]};
    }

    [[nodiscard]] Box bounding_box() const { return box_about(center, {}, radius, 0, 0); }

    /// Rounding error of a position, relative to the radius: 8 epsilon (1 + largest |c| / R).
    [[nodiscard]] double rounding() const;
};

inline Vector3 vector_of(std::span<const double> point) { return {point[0], point[1], point[2]}; }

}  // namespace stipple::warps
