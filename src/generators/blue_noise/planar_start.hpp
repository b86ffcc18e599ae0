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

#include <functional>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "core/rng.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "math/neighbors/periodic_voronoi.hpp"
#include "media/density_map.hpp"
#include "media/density_moments.hpp"

namespace stipple {

namespace planar {
constexpr Param<Path> from{
    {.name = "from", .help = "File of the points to start from, which make the count"}};
constexpr Param<Choice> initial{.name = "initial",
                                .fallback = "jittered",
                                .choices = "jittered|random",
                                .help = "Points to start from"};

constexpr Param<std::int64_t> iterations_option(std::int64_t usual, std::string_view help) {
    return {.name = "iterations",
            .fallback = usual,
            .low = 0,
            .high = 1'000'000'000,
            .unit = "iterations",
            .help = help};
}

/// For Generator::uses_seed, of those that need no random numbers but to begin with.
inline bool uses_seed(const Values& options) { return !options.given(from); }
}  // namespace planar

/// The rectangle of a plan; points are worked on from its lower corner.
struct Planar {
    Vec2 low;
    Vec2 sides;
    bool torus = true;
};

/// The plan of a set in two dimensions, its box checked; the count is 0 with --from.
Plan planar_plan(const Request& request, const Values& options);

/// Points to start from, and what they are to follow.
struct PlanarStart {
    Planar planar;
    std::optional<DensityMap> density;
    std::vector<double> rows;  ///< x, y in [0, side)

    [[nodiscard]] std::size_t count() const { return rows.size() / 2; }
};

/// The start that the options ask for.
/// @param bytes that a point takes, of what messages call `who`. @throws Error(limit) too
PlanarStart planar_start(const Plan& plan, const Values& options, double bytes,
                         std::string_view who, const RunContext& run);

/// Moments of a function of the density over cells, scaled to a mean of 1.
std::optional<DensityMoments> planar_moments(const std::optional<DensityMap>& density,
                                             const std::function<double(double)>& function,
                                             const Planar& planar, const RunContext& run);

/// The order of the points along strips of the rectangle: what is near in it is near in memory.
std::vector<std::uint32_t> along_strips(const std::vector<double>& rows, const Planar& planar,
                                        const RunContext& run);

/// Random places of the rectangle, in proportion to the density: x, y in [0, side).
std::vector<double> random_places(std::uint64_t n, const Planar& planar,
                                  const std::optional<DensityMap>& density, const Rng& rng,
                                  const RunContext& run);

/// The sites at their places in the box of the plan.
/// @param order number of each site's point; none: the site's own
PointSet planar_points(const Plan& plan, const Planar& planar, const PeriodicVoronoi& sites,
                       std::span<const std::uint32_t> order = {});

}  // namespace stipple
