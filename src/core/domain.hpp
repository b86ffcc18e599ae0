// SPDX-License-Identifier: MIT
//
// What points live on: its measure, its density, a membership test, and coordinates in which cells
// of known probability are plain boxes.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "stipple/points.hpp"

namespace stipple {

/// A number that was worked out to a tolerance: the right one is within `error`; 0: it is exact, up
/// to its rounding.
struct Estimate {
    double value = 0;
    double error = 0;
};

/// Exact moments of a law: per coordinate the mean and the skewness, and the covariance of each
/// pair of coordinates, row after row.
struct Moments {
    std::vector<double> mean;
    std::vector<double> covariance;
    std::vector<double> skewness;

    [[nodiscard]] std::size_t dimension() const { return mean.size(); }
};

class Domain {
  public:
    Domain() = default;
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;
    virtual ~Domain() = default;

    /// How it is written: "unit-cube", "disk", "disk:radius=2".
    [[nodiscard]] virtual std::string spec() const = 0;

    /// Numbers that make a point.
    [[nodiscard]] virtual std::size_t dimension() const = 0;

    /// Length, area, volume...; infinite for a whole line or plane.
    [[nodiscard]] virtual double measure() const = 0;

    /// Whether the closed domain contains the point, up to the rounding that a point on its rim
    /// has.
    [[nodiscard]] virtual bool contains(std::span<const double> point) const = 0;

    /// The smallest axis-parallel box around it or, where it has no end, around nearly all points
    /// that follow its density: what a picture shows.
    [[nodiscard]] virtual Box bounding_box() const = 0;

    /// Numbers that to_cube gives.
    [[nodiscard]] virtual std::size_t cube_dimension() const { return dimension(); }

    /// Density of the domain's points with respect to its measure; 0 outside. Uniform, unless the
    /// domain says otherwise.
    [[nodiscard]] virtual double density(std::span<const double> point) const {
        return contains(point) ? 1 / measure() : 0;
    }

    /// Coordinates in [0, 1]. Where even(), they preserve probability: a point that follows
    /// density() is uniform on the cube.
    virtual void to_cube(std::span<const double> point, std::span<double> cube) const = 0;

    /// Whether the probability of every box of the cube is its volume.
    [[nodiscard]] virtual bool even() const { return true; }

    /// Probability of a box of the cube, for points that follow density().
    [[nodiscard]] virtual Estimate probability(const Box& cell) const {
        double volume = 1;
        for (std::size_t k = 0; k < cell.dimension(); ++k) volume *= cell.extent(k);
        return {volume, 0};
    }

    /// Moments of points that follow density(); nothing where no closed form is known.
    [[nodiscard]] virtual std::optional<Moments> moments() const { return std::nullopt; }

    /// What the coordinates of to_cube mean, for people: "x", "area fraction r^2/R^2", "angle".
    [[nodiscard]] virtual std::vector<std::string> cube_axes() const = 0;
};

/// What a domain also is that knows the probability of boxes of its own space. A mixture has no
/// coordinates that preserve probability: its cells are such boxes, or zones of the sphere.
class Weighable {
  public:
    Weighable() = default;
    Weighable(const Weighable&) = delete;
    Weighable& operator=(const Weighable&) = delete;
    virtual ~Weighable() = default;

    /// Of points that follow the domain's density; the box may be larger than the domain, and
    /// reach to infinity.
    [[nodiscard]] virtual Estimate box_mass(const Box& box) const = 0;
};

/// Of a domain on which the coordinate k of to_cube depends on coordinate k of a point alone, and
/// rises or falls with it.
Estimate box_mass_by_axes(const Domain& domain, const Box& box);

DomainPtr unit_cube(std::size_t dimension);
DomainPtr box_domain(Box box);

/// Domains side by side: factor j lives on coordinates[j] of the row. Flattens nothing, sorts
/// nothing.
struct Factor {
    DomainPtr domain;
    std::vector<std::size_t> coordinates;
};
DomainPtr product_domain(std::vector<Factor> factors);

/// Parses "lo..hi" (for all coordinates) or "lo..hi,lo..hi,...". @throws Error(usage)
Box parse_box(std::string_view text, std::size_t dimension);
std::string format_box(const Box& box);

/// The smallest box around rows of numbers and around `around`; it may be flat.
Box bounding_box(std::span<const double> rows, const Box& around);

/// The smallest box around one row or more.
Box bounding_box(std::span<const double> rows, std::size_t dimension);

/// Moves points of the unit cube into the box, in place; half-open stays half-open.
void scale_into(const Box& box, std::span<double> rows);

}  // namespace stipple
