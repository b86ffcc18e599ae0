// SPDX-License-Identifier: MIT
//
// Latin hypercubes near lattices, whose points are far apart.
//
// Of some lattices of rank 1 of N = n, ..., 1.3 n points the one of largest least distance; moved at
// random on the torus, and of its points the n nearest to the middle by a maximum of differences,
// weighted at random. Levels are the ranks of their coordinates. With n + 1 points and no move the
// point that goes is a corner, and distances stay as they are.
#pragma once

#include "generators/stratified/latin_hypercube_search/design.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::latin_hypercube_search {

Design lattice_start(std::size_t points, std::size_t dimension, SplitMix64& draws);

}  // namespace stipple::latin_hypercube_search
