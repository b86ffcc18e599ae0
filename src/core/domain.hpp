// SPDX-License-Identifier: MIT
//
// The space that points live on: its measure, density, membership test, and coordinates in which
// cells of known probability are axis-parallel boxes.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "stipple/points.hpp"

namespace stipple {

double volume_of(const Box& box);

/// An approximate number: the true value differs from `value` by at most `error`; error 0 means
/// exact up to rounding.
struct Estimate {
    double value = 0;
    double error = 0;

    Estimate& operator+=(const Estimate& other) {
        value += other.value;
        error += other.error;
        return *this;
    }
};

/// Scales value and error. @param factor exact and not negative
inline Estimate operator*(double factor, const Estimate& a) {
    return {factor * a.value, factor * a.error};
}

/// Exact moments of a distribution: mean and skewness of each coordinate, and the covariance matrix
/// in row-major order.
struct Moments {
    std::vector<double> mean;
    std::vector<double> covariance;
    std::vector<double> skewness;

    [[nodiscard]] std::size_t dimension() const { return mean.size(); }
};

/// Part of a domain where its density is not 0. The mean of f / p over points with density p
/// estimates the integral of f over this part, not over the whole domain.
struct Support {
    bool whole = true;   ///< the part is the whole domain, except for a set of measure 0
    bool finite = true;  ///< the measure of the part is finite, though perhaps unknown

    /// Whether a point is in a gap exactly if density() is 0 there, up to rounding at the edges.
    bool by_density = false;

    /// Measure of the part, if known.
    std::optional<Estimate> measure = {};

    /// Disjoint boxes that cover the part; empty if there would be too many.
    std::vector<Box> boxes = {};
};

/// The circle normal . x = height on the unit sphere; `normal` is a unit vector.
struct SphereCircle {
    std::array<double, 3> normal;
    double height = 0;
};

/// Circles where a density on the unit sphere is not smooth, and the axis of its map to the cube.
struct SphereShape {
    /// Axis of the map to the cube, if it has one: the cube coordinates of a direction are then the
    /// fraction of directions that are nearer to the axis, and the longitude.
    struct Pole {
        std::array<double, 3> axis;  ///< a unit vector
        bool hemisphere;             ///< only directions within 90 degrees of the axis; false: all
    };

    std::vector<SphereCircle> circles;  ///< where the density jumps, has a kink or is steep
    bool level = true;                  ///< the density is constant between the circles
    std::optional<Pole> pole = {};
};

class Domain {
  public:
    Domain() = default;
    Domain(const Domain&) = delete;
    Domain& operator=(const Domain&) = delete;
    virtual ~Domain() = default;

    /// Spec of the domain: "unit-cube", "disk", "disk:radius=2".
    [[nodiscard]] virtual std::string spec() const = 0;

    /// Name of the domain in messages.
    [[nodiscard]] virtual std::string title() const { return spec(); }

    [[nodiscard]] virtual std::size_t dimension() const = 0;

    /// Length, area, volume, ...; infinite for a whole line, plane or space.
    [[nodiscard]] virtual double measure() const = 0;

    /// Whether the closed domain contains the point, with a tolerance for points that rounding
    /// moved off the boundary.
    [[nodiscard]] virtual bool contains(std::span<const double> point) const = 0;

    /// The smallest axis-parallel box around the domain. If it is unbounded, a box around nearly
    /// all points that follow its density, for pictures.
    [[nodiscard]] virtual Box bounding_box() const = 0;

    /// Number of coordinates that to_cube() writes.
    [[nodiscard]] virtual std::size_t cube_dimension() const { return dimension(); }

    /// Density of the domain's points with respect to its measure; 0 outside. Uniform by default.
    [[nodiscard]] virtual double density(std::span<const double> point) const {
        return contains(point) ? 1 / measure() : 0;
    }

    /// Maps a point to coordinates in [0, 1]. If even(), they preserve probability: a point that
    /// follows density() becomes uniform on the cube.
    virtual void to_cube(std::span<const double> point, std::span<double> cube) const = 0;

    /// Whether the probability of every box of the cube equals its volume.
    [[nodiscard]] virtual bool even() const { return true; }

    /// Whether discrete coordinates are the only reason why even() is false. to_cube() maps an
    /// outcome to the middle of its cell, whose length is the outcome's probability.
    [[nodiscard]] virtual bool has_outcomes() const { return false; }

    /// Probability of a box of the cube, for points that follow density().
    [[nodiscard]] virtual Estimate probability(const Box& cell) const {
        return {volume_of(cell), 0};
    }

    /// Moments of points that follow density(); nullopt if no closed form is known.
    [[nodiscard]] virtual std::optional<Moments> moments() const { return std::nullopt; }

    /// Readable names of the coordinates of to_cube(): "x", "area fraction r^2/R^2", "angle".
    [[nodiscard]] virtual std::vector<std::string> cube_axes() const = 0;

    /// Probability of a box of the domain's own space, for points that follow density(); nullopt if
    /// unknown. The box may extend beyond the domain, even to infinity. Needed for mixtures: no map
    /// to the cube preserves their probability, so their points are counted in boxes of their own
    /// space, or in zones of the sphere.
    [[nodiscard]] virtual std::optional<Estimate> box_mass(const Box& /*box*/) const {
        return std::nullopt;
    }

    /// Part of the domain where density() is not 0; by default the whole domain.
    [[nodiscard]] virtual Support support() const;

    /// Whether the density may have gaps that support() can describe at little cost, by `boxes` or
    /// `by_density`.
    [[nodiscard]] virtual bool shows_gaps() const { return false; }

    /// Shape of a density of directions; nullopt for other domains, and for those whose cells are
    /// already zones of the sphere.
    [[nodiscard]] virtual std::optional<SphereShape> sphere_shape() const { return std::nullopt; }

    /// Names of the coordinates; empty: x, y, ...
    [[nodiscard]] virtual std::vector<std::string> names() const { return {}; }

    /// Level names of the categorical coordinates.
    [[nodiscard]] virtual Levels levels() const { return {}; }
};

/// Probability of a box of the domain's own space. Requires that coordinate k of to_cube() is a
/// monotonic function of coordinate k of the point alone.
Estimate box_mass_by_axes(const Domain& domain, const Box& box);

/// @param names names of the coordinates; empty: x, y, ...
DomainPtr unit_cube(std::size_t dimension, std::vector<std::string> names = {});
DomainPtr box_domain(Box box);

/// A factor of a product of domains: `domain` describes the given coordinates of a point. Products
/// may be nested; product_domain() neither flattens them nor reorders the factors.
struct Factor {
    DomainPtr domain;
    std::vector<std::size_t> coordinates;
};
DomainPtr product_domain(std::vector<Factor> factors);

/// Parses "lo..hi" (for all coordinates) or "lo..hi,lo..hi,...". @throws Error(usage)
Box parse_box(std::string_view text, std::size_t dimension);
std::string format_box(const Box& box);

/// The smallest box that contains the points `rows` and the box `around`; extents may be 0.
Box bounding_box(std::span<const double> rows, const Box& around);

/// The smallest box that contains all rows; at least one row is required.
Box bounding_box(std::span<const double> rows, std::size_t dimension);

/// Maps points of the unit cube into the box, in place. The result stays below box.high.
void scale_into(const Box& box, std::span<double> rows);

}  // namespace stipple
