// SPDX-License-Identifier: MIT
//
// Points added to given ones, so that all n are as near a Latin hypercube as can be: along every
// coordinate, new points are in strata [l/n, (l+1)/n) that no other point is in. Where no two given
// ones share a stratum, as in a Latin hypercube whose number of points divides n, that is a Latin
// hypercube; else a stratum stays empty for each one too many.
//
// Source  P. Z. G. Qian, Biometrika 96 (2009) 957-970, doi:10.1093/biomet/asp045 (nested designs);
//         C. J. Sallaberry, J. C. Helton, S. C. Hora, Reliab. Eng. Syst. Saf. 93 (2008) 1047-1059,
//         doi:10.1016/j.ress.2007.04.005 (extension of Latin hypercubes).
#pragma once

#include "core/point_set.hpp"
#include "core/rng.hpp"
#include "generators/stratified/latin_hypercube_search/design.hpp"

namespace stipple::generators {

/// A design of `count` points of which the first are given, the others at random in empty strata.
/// Its spare rows hold those that stay empty.
latin_hypercube_search::Design extended(const PointSet& given, std::size_t count, const Rng& rng);

/// The number of strata of n, along a coordinate, that hold two or more points; a coordinate of 1
/// counts to the last.
std::size_t crowded_strata(const PointSet& given, std::size_t coordinate, std::size_t count);

}  // namespace stipple::generators
