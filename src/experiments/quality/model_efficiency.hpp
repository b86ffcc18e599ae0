// SPDX-License-Identifier: MIT
//
// Efficiency of a design of n runs for estimating the p coefficients of a polynomial model. With
// f(x) the row of the model's terms at x, which is coded to [-1, 1], X the matrix of the rows of
// all runs, and M = X^T X,
//
//     D = det(M)^(1/p) / n,     A = p / (n trace(M^-1)),     G = p / (n max_x f(x)^T M^-1 f(x)),
//
// which are 1 for an orthogonal design with all coordinates at -1 and 1, if one exists. All are 0
// if M is singular. The terms are 1 and x_i (linear), with x_i x_j (interaction), and with x_i^2 as
// well (quadratic).
//
// Cost    O(n p^2 + p^3 + c p^2) for c candidate points x of the maximum in G.
// Source  A. C. Atkinson, A. N. Donev, R. D. Tobias, "Optimum Experimental Designs, with SAS",
//         Oxford 2007, chapters 9 to 11.
#pragma once

#include <cstddef>
#include <span>

#include "stipple/run.hpp"

namespace stipple::analyzers {

enum class Model { linear, interaction, quadratic };

std::size_t model_terms(Model model, std::size_t dimension);

struct Efficiency {
    double d = 0;
    double a = 0;
    double g = 0;

    /// Candidate points for the maximum in G: "corners" of the cube, which contain the maximum for
    /// the first two models; the "grid" of -1, 0, 1; or, if there are too many of either, the
    /// design's own "points".
    const char* places = "";
};

/// @param coded rows of coordinates in [-1, 1]
Efficiency model_efficiency(std::span<const double> coded, std::size_t dimension, Model model,
                            const RunContext& run);

}  // namespace stipple::analyzers
