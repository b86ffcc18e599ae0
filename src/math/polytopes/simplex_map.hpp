// SPDX-License-Identifier: MIT
//
// Uniform weights of a simplex: w_0, w_1, ... >= 0 that sum to 1, broken off one after the other. Of
// what those before leave, r, with m weights still to come behind it, a weight leaves
//
//     r xi^(1 / m),
//
// so that small xi are near its vertex, where numbers are as fine as they get, and rounding is below
// 2^-52 everywhere.
//
// Cost    a square root for m = 2, else one logarithm and one exponential: about 6 ns on one core.
// Promise the same bits on every machine.
// Source  M. Rosenblatt, Annals of Mathematical Statistics 23 (1952) 470-472,
//         doi:10.1214/aoms/1177729394.
#pragma once

#include <cstddef>

namespace stipple {

/// Takes from what is left of each row its weight, in the place of xi.
void break_off(double* xi, double* rest, std::size_t m, std::size_t rows);

/// The way back: xi of the share of r that is left.
double unit_of_share(double share, std::size_t m);

}  // namespace stipple
