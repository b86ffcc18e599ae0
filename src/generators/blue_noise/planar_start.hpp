// SPDX-License-Identifier: MIT
//
// What the generators that improve a set of points of a rectangle share: its walls, the points they
// start from, and the density.
//
// random      uniform points, or of the density.
// jittered    one point for each of n strata of equal area (mass), in it or beside it: evener than
//             random, and without the strata's rows and columns.
// --from      points of a file, in the box.
#pragma once

#include <optional>
#include <vector>

#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "math/neighbors/periodic_voronoi.hpp"
#include "media/density_map.hpp"
#include "media/density_moments.hpp"

namespace stipple {

namespace planar {
constexpr Param<Path> from{
    {.name = "from", .help = "Text file of the points to start from, which make the count"}};
constexpr Param<Choice> initial{.name = "initial",
                                .fallback = "jittered",
                                .choices = "jittered|random",
                                .help = "Points to start from"};
}  // namespace planar

/// The rectangle of a plan; points are worked on from its lower corner.
struct Planar {
    Vec2 low;
    Vec2 sides;
    bool torus = true;
};

/// The plan of a set in two dimensions, its box checked; the count is 0 with --from.
Plan planar_plan(const Request& request, const Values& options);

Planar planar_of(const Plan& plan, bool torus);

/// The density of --density over the rectangle, nothing without the option.
std::optional<DensityMap> planar_density(const Values& options, const RunContext& run);

/// Moments of a function of it over cells, scaled to a mean of 1.
std::optional<DensityMoments> planar_moments(const std::optional<DensityMap>& density,
                                             double (*function)(double), const Planar& planar,
                                             const RunContext& run);

/// Rows (x, y) in [0, side) to start from, as the options say.
std::vector<double> starting_rows(const Plan& plan, const Values& options, const Planar& planar,
                                  const std::optional<DensityMap>& density, const RunContext& run);

/// The order of the points along strips of the rectangle: what is near in it is near in memory.
std::vector<std::uint32_t> along_strips(const std::vector<double>& rows, const Planar& planar,
                                        const RunContext& run);

/// Points of [0, side) at their places in the box of the plan.
PointSet planar_points(const Plan& plan, const Planar& planar, std::vector<double> rows);

}  // namespace stipple
