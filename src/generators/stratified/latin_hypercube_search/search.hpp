// SPDX-License-Identifier: MIT
//
// Search for the Latin hypercube that is best by a criterion (criteria.hpp).
//
// Stages    start with few trials, which double from one stage to the next, as long as the budget
//           lasts: more trials add stages, so the result of fewer trials is among those that are
//           compared.
// Rounds    of a stage: eight short annealings, eight of three times their trials, then four that
//           take two thirds of the trials, two of them from the best designs (annealing.hpp).
// Starts    random exchanges of the given design. For maximin in two or three coordinates there are
//           more annealings; three of four start near lattices, at a low temperature.
// Targets   of maximin are up to a fiftieth beyond the best squared distance so far.
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

/// Searches, and reports progress with `words` and the best value. @throws Error(limit, cancelled)
Result best_design(const Search& search, const std::string& words, const RunContext& run);

/// Default number of trials: about 20 seconds of one core, fewer for few points.
double usual_trials(const Objective& objective, const Design& design);

/// Number of all designs except mirror images, (n! / 2)^(d - 1); infinite for more than 11 points
/// in two or more coordinates.
double designs_to_try(const Design& start);

}  // namespace stipple::latin_hypercube_search
