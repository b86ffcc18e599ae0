// SPDX-License-Identifier: MIT
//
// Chooses n of N points with a small star discrepancy, by exchanges of chosen points for others
// that lower it. Every box [0, c) or [0, c] bounds the discrepancy of every subset from below:
//
//     D*(S)  >=  | #(S in the box) / n  -  volume |,
//
// so the worst boxes of all measured subsets are kept, each with its points as bits. They rule out
// most exchanges quickly, for all N possible replacements of a member at once. The most promising
// of the remaining exchanges are measured by the exact search. The best is made if it improves the
// set; the worst boxes of the others are kept, too. If no exchange remains, some are made at random
// that keep all boxes nearly as good, and the search continues from there, or from the best set if
// that leads nowhere.
//
// Cost    the measurements: in 6-D 2 to 50 ms each for 30 to 240 points. Some 2^12 N / 8 bytes.
// Promise depends only on the points, the start, the seed and the number of measurements.
// Beware  the exact search bounds cells by the C library's logarithms. Values do not depend on
//         them, but which of several equally bad boxes is kept may differ between machines.
// Source  F. Clement, C. Doerr, L. Paquete, "Heuristic approaches to obtain low-discrepancy point
//         sets via subset selection", J. Complexity 83 (2024) 101852, arXiv:2306.15276 (exchanges
//         that break the worst box). Keeping boxes is this program's own idea.
#pragma once

#include <cstdint>

#include "core/point_set.hpp"
#include "generators/subset/kernel_choice.hpp"

namespace stipple::generators::subset {

/// Bounds of a star discrepancy, equal if it is known.
struct StarBounds {
    double lower = 0;
    double upper = 1;
};

/// Star discrepancy of the rows, exact unless that takes minutes.
StarBounds star_discrepancy(const PointSet& points, const Rows& rows, const RunContext& run);

/// @param start initial rows
/// @param measures number of sets that may be measured
Rows choose_by_star(const PointSet& points, Rows start, std::uint64_t measures, std::uint64_t seed,
                    const RunContext& run);

/// Reduces the largest star discrepancy among `sets`, a partition of the points, by exchanging
/// points between them.
void even_out_by_star(const PointSet& points, std::vector<Rows>& sets, std::uint64_t measures,
                      std::uint64_t seed, const RunContext& run);

/// Bytes that choose_by_star() needs.
double star_memory(double points);

}  // namespace stipple::generators::subset
