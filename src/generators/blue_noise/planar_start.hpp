// SPDX-License-Identifier: MIT
//
// Common code of the generators that improve a set of points in a rectangle: the rectangle, the
// initial points and the density.
//
// random      uniform points, or points distributed by the density.
// jittered    one point in or beside each of n strata of equal area (mass): more even than random,
//             without the strata's rows and columns.
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
    {.name = "from", .help = "File of points to start from; gives the count"}};
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
}  // namespace planar

/// Rectangle of a plan; points are relative to its lower corner while they are improved.
struct Planar {
    Vec2 low;
    Vec2 sides;
    bool torus = true;
};

/// Plan of a set in two dimensions, with its box checked; the count is 0 with --from.
Plan planar_plan(const Request& request, const Values& options);

/// Initial points, and the density that they should follow.
struct PlanarStart {
    Planar planar;
    std::optional<DensityMap> density;
    std::vector<double> rows;  ///< x, y in [0, side)

    [[nodiscard]] std::size_t count() const { return rows.size() / 2; }
};

/// @param bytes memory per point, checked against the limit; error messages name `who`
/// @throws Error(limit), and errors of reading the files
PlanarStart planar_start(const Plan& plan, const Values& options, double bytes,
                         std::string_view who, const RunContext& run);

/// Moments of cells for function(density), scaled to a mean of 1; nullopt without a density.
std::optional<DensityMoments> planar_moments(const std::optional<DensityMap>& density,
                                             const std::function<double(double)>& function,
                                             const Planar& planar, const RunContext& run);

/// Indices of the points along strips of the rectangle: neighbours become close in memory.
std::vector<std::uint32_t> along_strips(const std::vector<double>& rows, const Planar& planar,
                                        const RunContext& run);

/// Random points of the rectangle that follow the density, if any: x, y in [0, side).
std::vector<double> random_places(std::uint64_t n, const Planar& planar,
                                  const std::optional<DensityMap>& density, const Rng& rng,
                                  const RunContext& run);

/// Point set at the sites, moved into the plan's box.
/// @param order index of each site's point; empty: the site's own index
PointSet planar_points(const Plan& plan, const Planar& planar, const PeriodicVoronoi& sites,
                       std::span<const std::uint32_t> order = {});

}  // namespace stipple
