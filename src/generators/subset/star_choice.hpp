// SPDX-License-Identifier: MIT
//
// The n of N points whose star discrepancy is small, by exchanges of a chosen point for another
// that lower it. Every box [0, c) or [0, c] bounds the discrepancy of every subset from below:
//
//     D*(S)  >=  | #(S in the box) / n  -  volume |,
//
// so the worst boxes of all subsets that were measured are kept, each with the points in it as
// bits. They rule out most exchanges at once, for all N points to put in for one at a time. Of what
// is left, some that look best are measured, by the exact search; the best of them is taken if it
// is better than the set before, and what was wrong with the others becomes a box to keep. Where
// nothing is left, no exchange helps: some are made at random that the boxes hold harmless, and it
// goes on from there, and from the best set if that leads nowhere.
//
// Cost    the measures: in 6-D 2 to 50 ms each for 30 to 240 points. Some 2^12 N / 8 bytes.
// Promise a function of the points, the start, the seed and the number of measures.
// Beware  the exact search bounds cells by the C library's logarithms. Values do not depend on
//         them, but which of several boxes that are equally bad is kept might, between machines.
// Source  F. Clement, C. Doerr, L. Paquete, "Heuristic approaches to obtain low-discrepancy point
//         sets via subset selection", J. Complexity 83 (2024) 101852, arXiv:2306.15276 (exchanges
//         that break the worst box). The boxes that are kept: this program's own.
#pragma once

#include <cstdint>

#include "core/point_set.hpp"
#include "generators/subset/kernel_choice.hpp"

namespace stipple::generators::subset {

/// What is certain of a star discrepancy; both the same where it is known.
struct StarBounds {
    double lower = 0;
    double upper = 1;
};

/// The rows' star discrepancy, exact unless that takes minutes.
StarBounds star_discrepancy(const PointSet& points, const Rows& rows, const RunContext& run);

/// @param start rows to begin with
/// @param measures sets that may be measured
Rows choose_by_star(const PointSet& points, Rows start, std::uint64_t measures, std::uint64_t seed,
                    const RunContext& run);

/// Lowers the largest star discrepancy of sets that make up all points, by exchanges between them.
void even_out_by_star(const PointSet& points, std::vector<Rows>& sets, std::uint64_t measures,
                      std::uint64_t seed, const RunContext& run);

/// Bytes that choose_by_star needs.
double star_memory(double points);

}  // namespace stipple::generators::subset
