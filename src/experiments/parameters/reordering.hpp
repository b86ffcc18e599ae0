// SPDX-License-Identifier: MIT
//
// Iman and Conover's reordering: rearranges the numbers of each coordinate among the points of a
// set, so that the ranks have requested correlations. With the van der Waerden scores R_ik =
// Phi^-1(r / (n + 1)) of the rank r = 1 ... n of point i in coordinate k,
//
//     T = R S^T,   S = P Q^-1,   P P^T = C,   Q Q^T = E,
//
// where E are the correlations of the scores and C the requested ones, 2 sin(pi r / 6) for a rank
// correlation r. In coordinate k, point i gets the number whose rank equals the rank of T_ik. The
// remaining error of the rank correlations, or a multiple of it for parameters with ties, is added
// to C, and the scores are transformed again, as long as that reduces the error. The paper's scores
// are random; here they are those of the points, so that nothing is random.
//
// Shape   n > d points of d coordinates; no coordinate is the same in all points.
// Cost    up to 11 rounds, 31 with ties, of d sorts of n numbers and n d^2 multiplications; 36 n d
//         bytes.
// Promise each coordinate keeps its numbers exactly: a Latin hypercube remains a Latin hypercube.
//         The first coordinate also keeps its order. Equal numbers are ordered by point, equal
//         scores by number. The same bits on every machine.
// Source  R. L. Iman, W. J. Conover, Commun. Statist. B 11 (1982) 311-334,
//         doi:10.1080/03610918208812265.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "math/distributions/marginal.hpp"
#include "stipple/run.hpp"

namespace stipple::parameters {

/// Ranks 0, 1, ... of the points in one coordinate.
using Ranks = std::vector<std::uint32_t>;

struct Reordering {
    std::vector<double> spearman;    ///< requested rank correlations, d x d in row-major order
    std::vector<double> scores;      ///< correlations of the scores that produce these; valid
    std::vector<std::string> names;  ///< of the coordinates, for messages
    /// Distributions of discrete parameters, whose ranks are used; null for others.
    std::vector<MarginalPtr> laws;

    /// Reorders a whole set in place. Reports rank correlations that could not be reached. @throws
    /// Error(input) if there are too few points, or if some coordinates have the same order;
    /// Error(limit), Error(cancelled)
    void apply(std::span<double> rows, const RunContext& run) const;
};

}  // namespace stipple::parameters
