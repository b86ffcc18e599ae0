// SPDX-License-Identifier: MIT
//
// First-order indices from any independent sample, by ranks. With the runs in the order of input i,
// cyclically, z the centred output and V its variance,
//
//     S_i = 1/n sum_j z_(j) z_(j+1) / V:
//
// neighbors in that order have nearly the same x_i, and other inputs that are independent. Runs of
// equal x_i count with the mean over all their orders. The standard error takes the products
// w_j = z_(j) z_(j+1) - S_i (z_(j)^2 + z_(j+1)^2) / 2 as a sequence that depends on neighbors alone,
// given the inputs: n se^2 V^2 = Var w + 2 (mean w_j w_(j+1) - mean w_j w_(j+2)).
//
// Shape   four runs or more, with independent inputs.
// Cost    O(k n log n).
// Beware  too small by about the variance of f(x_i) between neighbors, O(1/n^2) where it is smooth;
//         small samples have large errors, and a small index may come out below 0. Runs of
//         structured designs share coordinates: the products then mix in other inputs' effects.
//         The bootstrap is of no use here: a resample holds runs twice, as their own neighbors.
// Source  F. Gamboa, P. Gremaud, T. Klein, A. Lagnoux, Bernoulli 28 (2022) 2345-2374,
//         doi:10.3150/21-BEJ1421; S. Chatterjee, J. Am. Stat. Assoc. 116 (2021) 2009-2022,
//         doi:10.1080/01621459.2020.1758115.
#pragma once

#include "analyzers/sensitivity/effects.hpp"

namespace stipple::analyzers::sensitivity {

/// Failed runs are left out. @throws Error(input) where too few remain
Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run);

}  // namespace stipple::analyzers::sensitivity
