// SPDX-License-Identifier: MIT
//
// Search over coordinates for points with a minimal objective, by descents along its gradient.
//
// Starts    given sets, or the best of several generated ones. A descent follows from each. The
//           2 to 16 best results are kept, more if the budget allows more objective values.
// Hops      half of a set's points are moved and a descent follows; the new set replaces the old
//           one unless it is worse. The number of sets shrinks over time.
// Descents  steps that adapt to each coordinate's gradient (Adam), shorter and shorter, while the
//           soft maximum approaches the maximum.
//
// Promise   depends only on the arguments, not on the number of threads.
// Source    D. P. Kingma, J. Ba, arXiv:1412.6980 (Adam).
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "generators/optimized/objective.hpp"
#include "math/combinatorics/splitmix64.hpp"
#include "stipple/run.hpp"

namespace stipple::optimized {

// Starts.

/// Rows (i phi) in one dimension or (i / n, i phi) in two, modulo 1, with the golden ratio phi;
/// shifted at random.
std::vector<double> golden_rows(std::size_t count, std::size_t dimension, SplitMix64& draws);

/// Rows of a randomly shifted lattice of rank 1: of several random vectors, the one with the least
/// wraparound L2 discrepancy.
std::vector<double> lattice_rows(std::size_t count, std::size_t dimension, SplitMix64& draws,
                                 const RunContext& run);

/// Rows (i / n + random shift, point i of Sobol's sequence with Owen scrambling); a net if the
/// count is a power of two. The dimension is at least 2.
std::vector<double> net_rows(std::size_t count, std::size_t dimension, SplitMix64& draws);

// Searches.

/// Parameters of a descent; rate and sharpness change geometrically from first to last.
struct Schedule {
    std::size_t steps;
    double first_rate;  ///< largest change of a coordinate in one step
    double last_rate;
    double first_sharpness;
    double last_sharpness;
};

struct CoordinateSearch {
    std::size_t count;
    std::size_t dimension;
    std::size_t kept;  ///< number of leading points that stay fixed
    std::function<std::unique_ptr<Objective>()> objective;
    /// Rows of the i-th candidate for a start.
    std::function<std::vector<double>(std::uint64_t i, SplitMix64& draws)> start;
    Schedule from_start;
    Schedule from_hop;
    double hop;  ///< largest displacement of a coordinate by a hop
    std::uint64_t seed;
    double budget;           ///< in steps, see Objective::steps()
    bool one_start = false;  ///< whether all starts are the same set
    std::size_t sets_a_start = 16;
};

/// Runs the search. Progress notes begin with `words`, then give the latest and the lowest value so
/// far, converted by Objective::reported().
/// @throws Error(cancelled)
OptimizedRows search_coordinates(const CoordinateSearch& search, const std::string& words,
                                 const RunContext& run);

/// Finds the lattice with the least objective among all of Korobov's form: points
/// i (1, g, g^2, ...) / n modulo 1, for every g. In the plane these include all lattices of rank 1
/// whose projections have n distinct coordinates. Takes n / 2 objective values, because g and n - g
/// give mirror images. Progress and errors are those of search_coordinates().
OptimizedRows least_lattice(std::size_t count, std::size_t dimension,
                            const std::function<std::unique_ptr<Objective>()>& objective,
                            const std::string& words, const RunContext& run);

}  // namespace stipple::optimized
