// SPDX-License-Identifier: MIT
//
// Finds the lattice with the least objective among all of Korobov's form: points
// i (1, g, g^2, ...) / n modulo 1, for every g. In the plane these are all lattices of rank 1 whose
// projections have n distinct coordinates.
//
// Promise   depends only on the count, the dimension and the objective, not on the number of
//           threads.
// Cost      n / 2 objective values: g and n - g give mirror images.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "generators/optimized/objective.hpp"
#include "generators/optimized/search_run.hpp"

namespace stipple::optimized {

/// Runs the search. Progress notes begin with `words` and have the lowest value so far, as
/// Objective::reported() converts it.
/// @throws Error(cancelled)
OptimizedRows least_lattice(std::size_t count, std::size_t dimension,
                            const std::function<std::unique_ptr<Objective>()>& objective,
                            const std::string& words, const RunContext& run);

}  // namespace stipple::optimized
