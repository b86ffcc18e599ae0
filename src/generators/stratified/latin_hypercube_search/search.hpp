// SPDX-License-Identifier: MIT
//
// A search for the Latin hypercube that is best by a criterion (criteria.hpp).
//
// Stages    of few trials, then of twice as many from one to the next, as long as the budget has room
//           for them: more trials add stages, so the result of fewer is among what they choose from.
// Rounds    of a stage: eight short annealings, eight of three times their trials, then four that take
//           two thirds of it, two of them from the best so far (annealing.hpp).
// Starts    random exchanges of the given design. For maximin of two or three coordinates there are
//           more of them, three of four near lattices and annealed from a low temperature.
// Targets   of maximin are up to a fiftieth beyond the best squared distance so far.
//
// Cost      the budget in trials of an exchange, each O(n) but for correlations, and 4 n^2 or 8 n^2
//           bytes for each of eight annealings, two where there are more than 2000 points.
// Promise   a function of the search and its seed, for any number of threads; never worse with more
//           trials; the best there is where all designs can be tried instead (enumeration.hpp).
// Source    ideas of M. D. Morris, T. J. Mitchell, J. Statist. Plann. Inference 43 (1995) 381-402
//           (annealing), R. Jin, W. Chen, A. Sudjianto, ibid. 134 (2005) 268-287,
//           doi:10.1016/j.jspi.2004.02.014 (what an exchange changes).
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

/// Reports progress with the best value behind `words`. @throws Error(limit, cancelled)
Result best_design(const Search& search, const std::string& words, const RunContext& run);

/// Trials of some 20 seconds of one core, fewer for few points.
double usual_trials(const Objective& objective, const Design& design);

}  // namespace stipple::latin_hypercube_search
