// SPDX-License-Identifier: MIT
//
// Latin hypercubes that are close to lattices, with points that are far apart.
//
// Some random lattices of rank 1 with N = n, ..., 1.3 n points are compared, and the one of largest
// minimum distance is shifted at random on the torus. Its n points nearest to the middle are kept,
// by a maximum norm with random weights. Levels are the ranks of their coordinates. For N = n + 1
// there is no shift: the removed point is a corner, and distances stay the same.
#pragma once

#include "generators/stratified/latin_hypercube_search/design.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::latin_hypercube_search {

Design lattice_start(std::size_t points, std::size_t dimension, SplitMix64& draws);

}  // namespace stipple::latin_hypercube_search
