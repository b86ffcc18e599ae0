// SPDX-License-Identifier: MIT
//
// Iman and Conover's reordering: the numbers that a set has in each coordinate are given out anew
// among its points, so that ranks have the correlations that are asked for. With the van der Waerden
// scores R_ik = Phi^-1(r / (n + 1)) of the rank r = 1 ... n of point i in coordinate k,
//
//     T = R S^T,   S = P Q^-1,   P P^T = C,   Q Q^T = E,
//
// where E are the correlations of the scores and C those that they shall have, 2 sin(pi r / 6) for a
// rank correlation r. Point i then has the number of coordinate k whose rank is that of T_ik. What
// ranks still lack is added to C and the scores are transformed again, as long as that helps; of
// parameters that are equal in several points, ranks are their means, and C is between what was too
// little and too much.
//
// The paper has random scores. Here they are those of the points, so that their own order is what
// the reordering starts from, and nothing is random.
//
// Shape   n > d points of d coordinates, no coordinate the same in all points.
// Cost    up to 11 times d sorts of n numbers and n d^2 multiplications, 31 times with equal ones;
//         36 n d bytes.
// Promise each coordinate keeps its numbers exactly: a Latin hypercube remains one. The first
//         coordinate keeps their order, too. Equal numbers are in the order of the points, equal
//         scores in that of the numbers. The same bits on every machine.
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

/// 0, 1, ... of the points in one coordinate.
using Ranks = std::vector<std::uint32_t>;

class Reordering {
  public:
    /// @param spearman rank correlations, d x d, row after row
    /// @param scores correlations of scores that would have them; a valid matrix
    /// @param names of the coordinates, for messages
    /// @param laws by which coordinates become what is ranked, where that is discrete
    Reordering(std::vector<double> spearman, std::vector<double> scores,
               std::vector<std::string> names, std::vector<MarginalPtr> laws);

    /// Reorders a whole set, in place, and tells the user where the rank correlations are others.
    /// @throws Error(input) for too few points, and for those whose order in one coordinate is that
    /// in others; Error(limit), Error(cancelled)
    void apply(std::span<double> rows, const RunContext& run) const;

  private:
    std::vector<double> spearman_;
    std::vector<double> scores_;
    std::vector<std::string> names_;
    std::vector<MarginalPtr> laws_;
};

}  // namespace stipple::parameters
