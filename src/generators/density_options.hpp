// SPDX-License-Identifier: MIT
//
// Options of generators whose points follow a density (media/density_map.hpp), and the map that
// makes points follow it.
#pragma once

#include <cstddef>
#include <optional>

#include "core/domain.hpp"
#include "core/options.hpp"
#include "core/point_set.hpp"
#include "media/density_map.hpp"
#include "stipple/run.hpp"

namespace stipple {

inline constexpr Param<Path> density_option{
    {.name = "density",
     .help =
         "Picture (PNG, PFM) or array (NPY, row 0 at y = 0); points per area follow its values"}};
inline constexpr Param<bool> invert_option{
    .name = "invert", .help = "Place points where --density is dark, like ink on paper"};

/// @throws Error(usage) if --invert is given without --density
void check_invert(const Values& options);

/// @throws Error(usage) as check_invert, or if --density is given and the dimension is not 2
void check_density(const Values& options, std::size_t dimension);

/// Density map read from --density; nullopt if that is not given, or no option of the generator.
/// @throws as check_invert, read_density
std::optional<DensityMap> given_density(const Values& options, const RunContext& run);

/// Moves a uniform point of the box, in place, so that it follows the density.
/// @return 1 / sqrt(density at the new point), for a mean density of 1: the local spacing of points
double follow(const DensityMap& map, const Box& box, double* point);

/// Adds --density and --invert, if given, to the points' provenance.
void note_density(const Values& options, PointSet& points);

/// Name of the given option that makes points uneven (density, mask or radius-map), or nullptr.
const char* shaping_option(const Values& options);

}  // namespace stipple
