// SPDX-License-Identifier: MIT
//
// The options of generators whose points follow a density (media/density_map.hpp), and how they do.
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
         "Picture (PNG, PFM) or array (NPY, row 0 at y = 0): points per area go by its values"}};
inline constexpr Param<bool> invert_option{
    .name = "invert", .help = "Points where --density is dark, as ink on paper"};

/// @throws Error(usage) where there is nothing to invert.
void check_invert(const Values& options);

/// @throws Error(usage) also where points have other than two coordinates.
void check_density(const Values& options, std::size_t dimension);

/// The density of --density; nothing where it is not given, or the unit has no such option.
/// @throws as check_invert, read_density
std::optional<DensityMap> given_density(const Values& options, const RunContext& run);

/// Moves a uniform point of a rectangle to where the density has it.
/// @return 1 / sqrt(density there), the mean density being 1: as far apart as such points are
double follow(const DensityMap& map, const Box& box, double* point);

/// Puts these options, where they are given, into the points' provenance.
void note_density(const Values& options, PointSet& points);

/// The option, if one is given, by which points are not spread evenly; else nullptr.
const char* shaping_option(const Values& options);

}  // namespace stipple
