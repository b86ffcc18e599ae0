// SPDX-License-Identifier: MIT
//
// Finds the radius at which a process leaves exactly as many points as are wanted: the same darts
// leave fewer points for a larger radius, mostly, and hardly other points for one that hardly
// differs, so that a few tries come to exactly the count. Where it is passed over other darts are
// tried; of eight in vain the surplus of the best set is removed, and the user is told.
#pragma once

#include <cstdint>
#include <functional>

#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple::poisson_disk {

/// Points with a radius that they keep.
struct Packing {
    Rows rows = {};
    double radius = 0;
};

/// The points for a radius and a seed; cell_radius, at most the radius, is what the darts are
/// thrown for: with the same one, sets for radii that hardly differ hardly differ themselves.
using Pack = std::function<Rows(double radius, double cell_radius, std::uint64_t seed,
                                const RunContext& run)>;

/// What is searched for.
struct SearchGoal {
    std::uint64_t count;
    std::size_t dimension;
    double typical;  ///< radius that gives about the count
    double largest;  ///< radius that leaves one point
};

/// Exactly as many points as wanted: a maximal set, unless the user is told otherwise.
Packing search_radius(const SearchGoal& goal, std::uint64_t seed, const Pack& pack,
                      const RunContext& run);

}  // namespace stipple::poisson_disk
