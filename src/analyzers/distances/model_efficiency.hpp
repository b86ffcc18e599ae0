// SPDX-License-Identifier: MIT
//
// How well a design of n runs estimates the p coefficients of a polynomial model. With rows f(x) of
// its terms, x being coded to [-1, 1], and X the matrix of the runs' rows, M = X^T X,
//
//     D = det(M)^(1/p) / n,     A = p / (n trace(M^-1)),     G = p / (n max_x f(x)^T M^-1 f(x)),
//
// which are 1 for an orthogonal design with all coordinates at -1 and 1, if there is one. All are 0
// where M is singular. The terms are 1 and x_i (linear); x_i x_j besides (interaction); x_i^2 too
// (quadratic).
//
// Cost    O(n p^2 + p^3 + c p^2) for c places x of the maximum of G.
// Source  A. C. Atkinson, A. N. Donev, R. D. Tobias, "Optimum Experimental Designs, with SAS",
//         Oxford 2007, chapters 9 to 11.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "stipple/run.hpp"

namespace stipple::analyzers {

enum class Model { linear, interaction, quadratic };

std::size_t model_terms(Model model, std::size_t dimension);

struct Efficiency {
    double d = 0;
    double a = 0;
    double g = 0;

    /// Places of the maximum in G: corners of the cube, where it is for the first two models; the
    /// grid of -1, 0, 1; or, where either has too many, the design's own points.
    const char* places = "";
};

/// @param coded rows of coordinates in [-1, 1]
Efficiency model_efficiency(std::span<const double> coded, std::size_t dimension, Model model,
                            const RunContext& run);

}  // namespace stipple::analyzers
