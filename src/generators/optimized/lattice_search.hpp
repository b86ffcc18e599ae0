// SPDX-License-Identifier: MIT
//
// The lattice of least objective among all of Korobov's form: points i (1, g, g^2, ...) / n modulo
// 1, for every g; in the plane these are all of rank 1 whose projections have n places.
//
// Promise   a function of the count, the dimension and the objective, for any number of threads.
// Cost      n / 2 values: g and n - g give mirror images.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "generators/optimized/objective.hpp"
#include "generators/optimized/search_run.hpp"

namespace stipple::optimized {

/// Reports progress with the least value so far, as reports have it, behind `words`.
/// @throws Error(cancelled)
OptimizedRows least_lattice(std::size_t count, std::size_t dimension,
                            const std::function<std::unique_ptr<Objective>()>& objective,
                            const std::string& words, const RunContext& run);

}  // namespace stipple::optimized
