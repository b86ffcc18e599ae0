// SPDX-License-Identifier: MIT
//
// Adds points to given ones so that all n are as close to a Latin hypercube as possible: along
// every coordinate, new points are in strata [l/n, (l+1)/n) without any other point. If no two
// given ones share a stratum, as in a Latin hypercube whose number of points divides n, the result
// is a Latin hypercube; else one stratum stays empty for each surplus point.
//
// Source  P. Z. G. Qian, Biometrika 96 (2009) 957-970, doi:10.1093/biomet/asp045 (nested designs);
//         C. J. Sallaberry, J. C. Helton, S. C. Hora, Reliab. Eng. Syst. Saf. 93 (2008) 1047-1059,
//         doi:10.1016/j.ress.2007.04.005 (extension of Latin hypercubes).
#pragma once

#include "core/point_set.hpp"
#include "core/rng.hpp"
#include "generators/stratified/latin_hypercube_search/design.hpp"

namespace stipple::generators {

/// Design of `count` points: first the given ones, then others at random in empty strata. Spare
/// rows hold the strata that stay empty.
latin_hypercube_search::Design extended(const PointSet& given, std::size_t count, const Rng& rng);

/// Number of the `count` strata along a coordinate that hold two or more points; a coordinate of 1
/// belongs to the last.
std::size_t crowded_strata(const PointSet& given, std::size_t coordinate, std::size_t count);

}  // namespace stipple::generators
