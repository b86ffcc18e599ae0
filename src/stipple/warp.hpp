// SPDX-License-Identifier: MIT
//
// Maps points of the unit cube onto other domains and densities, and back. A warp is named by a
// spec, NAME[@I,J][:OPTION=VALUE,...]: "disk", "triangle:vertices=[0,0 1,0 0,1]", "disk@4,5" for
// coordinates 4 and 5 of a row. A scramble ("owen", "cranley-patterson") is named in the same way,
// and moves points within the cube.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Names of all warps and of all scrambles, each in alphabetical order.
std::vector<std::string> warp_names();
std::vector<std::string> scramble_names();

/// Returns the images of points of the unit cube, with their new domain; fewer points than given if
/// a method rejects some.
/// @throws Error(usage) for unknown names and options and for points that are already on another
/// domain; Error(input) for points outside the cube
PointSet warp(std::string_view spec, const PointSet& points, const RunContext& run = {});

/// Returns the points of the unit cube that the warp maps to `points`.
/// @throws Error(usage) if the warp has no inverse; Error(input) for points off its domain
PointSet warp_back(std::string_view spec, const PointSet& points, const RunContext& run = {});

/// The domain of a set as a spec: "unit-cube", "disk:radius=2".
std::string domain_of(const PointSet& points);

/// The domain with this spec. @throws Error(usage), Error(input) for another dimension
DomainPtr domain_named(std::string_view spec, std::size_t dimension, const RunContext& run = {});

/// Length, area, volume, ... of a set's domain; infinite for a whole line, plane or space.
double measure_of(const PointSet& points);

/// Density of each point with respect to the measure of its domain; 0 outside.
std::vector<double> densities(const PointSet& points);

/// A chain of warps for single rows of numbers. One Warper can serve several threads at once.
class Warper {
  public:
    /// @param dimension numbers in a row of the unit cube
    /// @throws Error(usage)
    Warper(std::span<const std::string> specs, std::size_t dimension);
    Warper(const std::string& spec, std::size_t dimension);
    Warper(Warper&&) noexcept;
    Warper& operator=(Warper&&) noexcept;
    ~Warper();

    [[nodiscard]] std::size_t dimension_in() const;
    [[nodiscard]] std::size_t dimension_out() const;

    /// Returns the images of rows in [0, 1); fewer rows if a method rejects some. If a warp
    /// reorders the set before mapping it, `rows` must be a whole set.
    /// @throws Error(usage) if the size is not a multiple of dimension_in(), Error(input) for
    /// numbers outside [0, 1]
    [[nodiscard]] std::vector<double> forward(std::span<const double> rows) const;

    /// Maps rows back to the unit cube; coordinates below 1.
    /// @throws Error(usage), also if a warp has no inverse; Error(input) for rows off the domain
    [[nodiscard]] std::vector<double> inverse(std::span<const double> rows) const;

    /// Density of each row that forward() returned. @throws Error(usage) for a wrong size
    [[nodiscard]] std::vector<double> density(std::span<const double> rows) const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace stipple
