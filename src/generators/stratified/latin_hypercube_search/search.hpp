// SPDX-License-Identifier: MIT
//
// Search for the Latin hypercube that is best by a criterion (criteria.hpp).
//
// Stages    The first has few trials; their number doubles from one stage to the next, as long as
//           the budget lasts. More trials add stages, so the result of fewer trials is among those
//           that are compared.
// Rounds    Each stage has three: eight short annealings, eight with three times their trials, and
//           four with two thirds of the stage's trials, two of them from the best designs.
// Starts    The given design after random exchanges. For maximin in two or three coordinates there
//           are more annealings; three of four start near lattices, at a low temperature.
// Targets   For maximin, up to a fiftieth beyond the best squared distance so far (annealing.hpp).
//
// Cost      the budget in trials of an exchange, each O(n) except for correlations, and 4 n^2 or
//           8 n^2 bytes for each of eight annealings, two if there are more than 2000 points.
// Promise   a function of the search and its seed, for any number of threads; never worse with more
//           trials; optimal if there are so few designs that all can be tried.
// Source    ideas of M. D. Morris, T. J. Mitchell, J. Statist. Plann. Inference 43 (1995) 381-402
//           (annealing), R. Jin, W. Chen, A. Sudjianto, ibid. 134 (2005) 268-287,
//           doi:10.1016/j.jspi.2004.02.014 (updates by exchanges).
#pragma once

#include <string>

#include "generators/stratified/latin_hypercube_search/criteria.hpp"

namespace stipple::latin_hypercube_search {

struct Search {
    Objective objective;
    Rules rules;
    Design start;
    std::uint64_t seed = 1;
    double trials = 1e6;
};

/// Searches. Progress reports show `words` and the best value. @throws Error(limit, cancelled)
Result best_design(const Search& search, const std::string& words, const RunContext& run);

/// Default number of trials: about 20 seconds of one core, fewer for few points.
double usual_trials(const Objective& objective, const Design& design);

/// Number of all designs except mirror images, (n! / 2)^(d - 1); infinite for more than 11 points
/// in two or more coordinates.
double designs_to_try(const Design& start);

}  // namespace stipple::latin_hypercube_search
