// SPDX-License-Identifier: MIT
//
// What generators of sets with distances in a box share: the box, closed to a torus or not, and the
// options that say so.
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
    .name = "torus", .help = "Distances go across opposite faces (so they do by default)"};
inline constexpr Param<bool> bounded_option{.name = "bounded",
                                            .help = "Distances end at the faces"};

/// @throws Error(usage): --torus and --bounded
void check_torus(const Values& options);

/// Points to r^d in a large box, d = 0 ... 6, when points thrown at random with a least distance r
/// leave no place for another: the saturation densities of random sequential addition (S. Torquato,
/// O. U. Uche, F. H. Stillinger, Phys. Rev. E 74 (2006) 061308, doi:10.1103/PhysRevE.74.061308).
inline constexpr std::array<double, 7> saturated_density{0,      0.7476, 0.6966, 0.7336,
                                                         0.8430, 1.0377, 1.3598};

/// Volume of the ball of radius 1.
double unit_ball_volume(std::size_t dimension);

/// A box with distances; they go across opposite faces on the torus.
struct BoxSpace {
    Box box;
    bool torus = true;

    /// The least number that no distance in it is above.
    [[nodiscard]] double largest_distance() const;

    /// The largest absolute value of a coordinate.
    [[nodiscard]] double largest_coordinate() const;

    /// About how many points there are when `density` of them fill the cube of side `radius`, which
    /// they keep as their distance; walls let some more in.
    [[nodiscard]] double expected_points(double density, double radius) const;

    /// @throws Error(limit) when `name` is so small a radius that rounding moves points by more
    /// than a thousandth of it.
    void check_resolution(double radius, std::string_view name) const;
};

/// The plan's box, or the unit cube.
BoxSpace space_of(const Plan& plan, bool torus);

/// The plan for a request whose box may say the dimension.
/// @throws Error(usage): a box of another dimension
Plan plan_in_bounds(const Request& request);

/// The same for distances. @throws Error(usage): --torus and --bounded, or a box whose distances
/// cannot be squared
Plan plan_in_box(const Request& request, const Values& options);

/// Sides of the plan's box in proportion, the shortest 1; none where all are alike, as those of the
/// unit cube.
std::vector<double> proportions_of(const Plan& plan);

/// Of the longest side to the shortest, for those.
inline constexpr double largest_proportion = 1000;

/// The plan of a generator that knows its box by its proportions. @throws Error(usage): a box of
/// another dimension, or with a side longer than largest_proportion times another.
Plan plan_in_proportion(const Request& request);

/// Traits of sets that are made as a whole in a rectangle.
inline const GeneratorTraits planar_traits{
    .min_dimension = 2, .max_dimension = 2, .sequence = false, .prefix = false, .boxed = true};

/// Moves points of the unit cube into the plan's box, which becomes their domain.
void put_in_box(const Plan& plan, PointSet& points);

/// The points, on their box, from index plan.start on.
PointSet set_in_box(std::vector<double> rows, const Plan& plan);

/// Largest dimension that code for distances is compiled for.
inline constexpr std::size_t most_directions = 6;

}  // namespace stipple
