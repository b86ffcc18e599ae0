// SPDX-License-Identifier: MIT
//
// What points live on: its measure, its density, a membership test, and coordinates in which cells
// of known probability are plain boxes.
#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stipple/points.hpp"

namespace stipple {

/// The product of a box's extents.
double volume_of(const Box& box);

/// A number that was worked out to a tolerance: the right one is within `error`; 0: it is exact, up
/// to its rounding.
struct Estimate {
    double value = 0;
    double error = 0;

    Estimate& operator+=(const Estimate& other) {
        value += other.value;
        error += other.error;
        return *this;
    }
};

/// @param factor exact, and not below 0
inline Estimate operator*(double factor, const Estimate& a) {
    return {factor * a.value, factor * a.error};
}

/// Exact moments of a law: per coordinate the mean and the skewness, and the covariance of each
/// pair of coordinates, row after row.
struct Moments {
    std::vector<double> mean;
    std::vector<double> covariance;
    std::vector<double> skewness;

    [[nodiscard]] std::size_t dimension() const { return mean.size(); }
};

/// What a unit coordinate becomes that stands for outcomes of a discrete distribution.
struct OutcomeAxis {
    std::function<double(double u)> outcome = {};  ///< rises with u; none: the axis is continuous
    bool categories = false;  ///< outcomes have no order, and are all as different

    [[nodiscard]] bool discrete() const { return static_cast<bool>(outcome); }
};

/// The part of a domain where its density is not 0. A mean of f / p over points that follow p is the
/// integral of f over that part alone, so that whoever compares it with an exact value must know it.
struct Support {
    bool whole = true;   ///< all of the domain, but for a set of measure 0
    bool finite = true;  ///< its measure is, though perhaps not known

    /// No point that follows the density, unrounded, is where density() says 0.
    bool by_density = false;

    /// Its measure, where that is known.
    std::optional<Estimate> measure = {};

    /// Boxes side by side that hold all of it; none where they would be many.
    std::vector<Box> boxes = {};
};

/// Where normal . x = height on the unit sphere, for a unit vector `normal`.
struct SphereCircle {
    std::array<double, 3> normal;
    double height = 0;
};

/// The circles at which a density on the sphere jumps, bends or is steep.
struct Discontinuities {
    std::vector<SphereCircle> circles;
    bool level = true;  ///< constant between circles
};

/// What directions, unit vectors in space, lie about.
struct Pole {
    std::array<double, 3> axis;  ///< a unit vector
    bool hemisphere;             ///< all are within a right angle of it; else there are all of them
};

class Domain {
  public:
    Domain() = default;
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;
    virtual ~Domain() = default;

    /// How it is written: "unit-cube", "disk", "disk:radius=2".
    [[nodiscard]] virtual std::string spec() const = 0;

    /// What messages call it.
    [[nodiscard]] virtual std::string title() const { return spec(); }

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

    /// Whether it is not even() for one reason: some coordinates are outcomes, and the cube has the
    /// middles of their cells, which are as long as outcomes are likely.
    [[nodiscard]] virtual bool has_outcomes() const { return false; }

    /// Probability of a box of the cube, for points that follow density().
    [[nodiscard]] virtual Estimate probability(const Box& cell) const {
        return {volume_of(cell), 0};
    }

    /// Moments of points that follow density(); nothing where no closed form is known.
    [[nodiscard]] virtual std::optional<Moments> moments() const { return std::nullopt; }

    /// What the coordinates of to_cube mean, for people: "x", "area fraction r^2/R^2", "angle".
    [[nodiscard]] virtual std::vector<std::string> cube_axes() const = 0;

    /// Probability of a box of the domain's own space, which may be larger than the domain, and
    /// reach to infinity, for points that follow density(); nothing where it is not known. A mixture
    /// has no coordinates that preserve probability: its cells are such boxes, or zones of the
    /// sphere.
    [[nodiscard]] virtual std::optional<Estimate> box_mass(const Box& /*box*/) const {
        return std::nullopt;
    }

    /// Where density() is not 0: everywhere, unless the domain says otherwise.
    [[nodiscard]] virtual Support support() const;

    /// Whether there may be gaps, and support() costs next to nothing and tells where they are, by
    /// boxes or by_density.
    [[nodiscard]] virtual bool shows_gaps() const { return false; }

    /// Of directions, where their density is not smooth; nothing where their cells are zones of the
    /// sphere themselves.
    [[nodiscard]] virtual std::optional<Discontinuities> discontinuities() const {
        return std::nullopt;
    }

    /// Names of the coordinates; none: x, y, ...
    [[nodiscard]] virtual std::vector<std::string> names() const { return {}; }

    /// What numbers of the coordinates stand for.
    [[nodiscard]] virtual Levels levels() const { return {}; }

    /// Of directions whose cube has a share of them nearer to the axis first, then a longitude.
    [[nodiscard]] virtual std::optional<Pole> pole() const { return std::nullopt; }
};

/// Of a domain on which the coordinate k of to_cube depends on coordinate k of a point alone, and
/// rises or falls with it.
Estimate box_mass_by_axes(const Domain& domain, const Box& box);

/// @param names of its coordinates; none: x, y, ...
DomainPtr unit_cube(std::size_t dimension, std::vector<std::string> names = {});
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
