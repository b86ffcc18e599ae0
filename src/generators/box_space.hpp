// SPDX-License-Identifier: MIT
//
// Common code of generators that use distances between points of a box: the box, bounded or closed
// to a torus, and the options for both.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/options.hpp"
#include "generators/generator.hpp"

namespace stipple {

inline constexpr Param<bool> torus_option{
    .name = "torus", .help = "Measure distances across opposite faces (the default)"};
inline constexpr Param<bool> bounded_option{
    .name = "bounded", .help = "Measure distances inside the box only, not across opposite faces"};

/// @throws Error(usage) if both --torus and --bounded are given
void check_torus(const Values& options);

/// Mean number of points in a cube of side r, in d = 0, ..., 6 dimensions, once random points of
/// minimum distance r leave no room for another: the saturation densities of random sequential
/// addition (S. Torquato, O. U. Uche, F. H. Stillinger, Phys. Rev. E 74 (2006) 061308,
/// doi:10.1103/PhysRevE.74.061308).
inline constexpr std::array<double, 7> saturated_density{0,      0.7476, 0.6966, 0.7336,
                                                         0.8430, 1.0377, 1.3598};

/// A box and its metric; on the torus, distances also go across opposite faces.
struct BoxSpace {
    Box box;
    bool torus = true;

    /// Supremum of the distances between two points of the space.
    [[nodiscard]] double largest_distance() const;

    /// Largest absolute value of a coordinate.
    [[nodiscard]] double largest_coordinate() const;

    /// Approximate number of points of minimum distance `radius` if a cube of side `radius` holds
    /// `density` of them; in a bounded box, a few more fit along the walls.
    [[nodiscard]] double expected_points(double density, double radius) const;

    /// @throws Error(limit) naming `name` if rounding may move points by more than radius / 1000
    void check_resolution(double radius, std::string_view name) const;
};

/// Space of the plan's box, or of the unit cube if it has none.
BoxSpace space_of(const Plan& plan, bool torus);

/// @throws Error of this kind naming `name` if float64 cannot represent squared distances in the box
void require_squares(const Box& box, ErrorKind kind, std::string_view name);

/// Plan for a request; its box, if there is one, determines the default dimension.
Plan plan_in_bounds(const Request& request);

/// plan_in_bounds() for generators that use distances.
/// @throws Error(usage) as check_torus() and require_squares()
Plan plan_in_box(const Request& request, const Values& options);

/// Side lengths of the plan's box over the shortest; empty without a box or if all are equal.
std::vector<double> proportions_of(const Plan& plan);

/// Largest ratio of two sides that plan_in_proportion() accepts.
inline constexpr double largest_proportion = 1000;

/// Plan of a generator that uses only the proportions of its box.
/// @throws Error(usage) if a ratio of two sides is above largest_proportion
Plan plan_in_proportion(const Request& request);

/// Traits of generators that make a whole set in a rectangle.
inline const GeneratorTraits planar_traits{
    .min_dimension = 2, .max_dimension = 2, .sequence = false, .prefix = false, .boxed = true};

/// Moves points of the unit cube into the plan's box, which becomes their domain.
void put_in_box(const Plan& plan, PointSet& points);

/// Point set from `rows` without the first plan.start points; its domain is the plan's box.
PointSet set_in_box(std::vector<double> rows, const Plan& plan);

/// Largest dimension for which templates that use distances are instantiated.
inline constexpr std::size_t most_directions = 6;

}  // namespace stipple
