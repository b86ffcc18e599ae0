// SPDX-License-Identifier: MIT
//
// Uniform weights of a simplex, w_0, w_1, ... >= 0 with sum 1, split off one after another. If the
// previous weights leave r, and m weights follow, then the next weight leaves
//
//     r xi^(1 / m),
//
// so that large weights correspond to small xi, which have the finest resolution, and rounding
// errors are below 2^-52 everywhere.
//
// Cost    a square root for m = 2, otherwise a logarithm and an exponential: about 6 ns on one
//         core.
// Promise the same bits on every machine.
// Source  M. Rosenblatt, Annals of Mathematical Statistics 23 (1952) 470-472,
//         doi:10.1214/aoms/1177729394.
#pragma once

#include <cstddef>

namespace stipple {

/// Splits the next weight off each row's rest, and stores it in place of xi.
void break_off(double* xi, double* rest, std::size_t m, std::size_t rows);

/// Inverse: xi from the fraction of r that is left.
double unit_of_share(double share, std::size_t m);

}  // namespace stipple
