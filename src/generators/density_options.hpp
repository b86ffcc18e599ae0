// SPDX-License-Identifier: MIT
//
// The options of generators whose points follow a density (media/density_map.hpp).
#pragma once

#include "core/error.hpp"
#include "core/options.hpp"

namespace stipple {

inline constexpr Param<Path> density_option{
    {.name = "density",
     .help =
         "Picture (PNG, PFM) or array (NPY, row 0 at y = 0): points per area go by its values"}};
inline constexpr Param<bool> invert_option{
    .name = "invert", .help = "Points where --density is dark, as ink on paper"};

/// @throws Error(usage) where there is nothing to invert.
inline void check_invert(const Values& options) {
    if (options[invert_option] && !options.given(density_option))
        fail(ErrorKind::usage, "--invert: there is no --density to invert");
}

/// @throws Error(usage) also where points have other than two coordinates.
inline void check_density(const Values& options, std::size_t dimension) {
    check_invert(options);
    if (options.given(density_option) && dimension != 2)
        fail(ErrorKind::usage, "--dimension: {} is not 2, the dimension of a --density", dimension);
}

/// The option, if one is given, by which points are not spread evenly; else nullptr.
inline const char* shaping_option(const Values& options) {
    for (const char* name : {"density", "mask", "radius-map"})
        if (const auto* item = options.try_find(name); item != nullptr && item->given) return name;
    return nullptr;
}

}  // namespace stipple
