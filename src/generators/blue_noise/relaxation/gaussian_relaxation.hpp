// SPDX-License-Identifier: MIT
//
// Points of a torus that descend the energy of Gaussian kernels,
//
//     E = sum over pairs i < j of  exp(-|x_i - x_j|^2 / 2),     lengths in units of (V / n)^(1/d),
//
// where V is the volume of the torus, and the sum has all images of each pair nearer than 6 units.
// A step moves every point by s F + b (last step), F = sum_j (x_i - x_j) exp(-|x_i - x_j|^2 / 2);
// s = (2 pi)^(1 - d/2) / 4, for which the stiffest mode of an even set moves 1.16 times the
// distance to its equilibrium. b is Nesterov's 1 - 3 / (k + 2), restarted at k = 1 whenever the
// step is against the force. So the soft modes, whose wavelengths are near the distance of
// neighbours, take about a hundred steps, instead of ten thousand.
//
// Shape   d = 1 ... 4; sides of any proportions up to largest_proportion. If a side is shorter than
//         a unit, points are repelled most by their own images, and stay irregular.
// Cost    a step: O(n (14^d)), 1 microsecond a point and core in 2-D, 14 in 3-D; beyond 2-D, while
//         no side is longer than 6 units (216 points in 3-D, 1296 in 4-D), O(n^2 d).
// Promise the same bits on every machine and for any number of threads.
// Source  A. G. M. Ahmed, J. Ren, P. Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6), 260
//         (2022), doi:10.1145/3550454.3555519: the energy and the plain step.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

inline constexpr std::size_t relaxation_dimensions = 4;  ///< maximum

/// Number of partial sums in a sum over points, the same on every machine.
inline constexpr std::size_t sum_lanes = 8;

inline double sum_of_lanes(const double* parts) {
    return ((parts[0] + parts[4]) + (parts[1] + parts[5])) +
           ((parts[2] + parts[6]) + (parts[3] + parts[7]));
}

/// Accelerated gradient steps, s F + b (last step).
class Descent {
  public:
    explicit Descent(std::size_t coordinates) : ways_(coordinates) {}

    /// Next step of every coordinate. The caller may change it; the following step builds on the
    /// changed one.
    std::span<double> step(std::span<const double> forces, double length);

  private:
    std::vector<double> ways_;
    double k_ = 1;
};

/// Bytes that relax_gaussian needs besides the rows.
double relaxation_bytes(std::uint64_t count, std::size_t dimension);

/// Moves points of [0, 1)^d by `steps` steps. Distances are those of a torus with sides
/// proportional to `extents`, or of the unit torus if empty. @throws Error(cancelled)
void relax_gaussian(std::span<double> rows, std::size_t dimension, std::uint64_t steps,
                    const RunContext& run, std::span<const double> extents = {});

}  // namespace stipple
