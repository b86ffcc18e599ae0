// SPDX-License-Identifier: MIT
//
// Searches for the radius at which a process leaves exactly the wanted number of points, as
// --count does (poisson_disk.cpp).
#pragma once

#include <cstdint>
#include <functional>

#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// Points, and a lower bound of the distance between any two of them.
struct Packing {
    Rows rows = {};
    double radius = 0;
};

/// Makes the points for a radius and a seed. Darts are thrown for `cell_radius`, at most the
/// radius; with the same cell_radius, similar radii give similar sets.
using Pack = std::function<Rows(double radius, double cell_radius, std::uint64_t seed,
                                const RunContext& run)>;

struct SearchGoal {
    std::uint64_t count;
    std::size_t dimension;
    double typical;  ///< radius that gives about `count` points
    double largest;  ///< radius that leaves a single point
};

/// Returns exactly goal.count points: a maximal set, unless a note reports otherwise.
Packing search_radius(const SearchGoal& goal, std::uint64_t seed, const Pack& pack,
                      const RunContext& run);

}  // namespace stipple::poisson_disk
