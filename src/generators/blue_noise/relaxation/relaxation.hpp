// SPDX-License-Identifier: MIT
//
// Points that descend the energy of Gaussian kernels. The kernels have one width
// (gaussian_relaxation.cpp), or widths that follow a density (density_relaxation.cpp). Both give
// the same bits on every machine and for any number of threads.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "media/density_map.hpp"
#include "stipple/run.hpp"

namespace stipple {

inline constexpr std::size_t relaxation_dimensions = 4;  ///< maximum dimension

/// Number of partial sums in a sum over points, the same on every machine.
inline constexpr std::size_t sum_lanes = 8;

inline double sum_of_lanes(const double* parts) {
    return ((parts[0] + parts[4]) + (parts[1] + parts[5])) +
           ((parts[2] + parts[6]) + (parts[3] + parts[7]));
}

/// Accelerated gradient steps s F + b (last step), with length s, forces F and Nesterov's factor b.
class Descent {
  public:
    explicit Descent(std::size_t coordinates) : ways_(coordinates) {}

    /// Next step of every coordinate. If the caller changes a step, later ones build on the change.
    std::span<double> step(std::span<const double> forces, double length);

  private:
    std::vector<double> ways_;
    double k_ = 1;
};

/// Bytes that relax_gaussian needs besides the rows.
double relaxation_bytes(std::uint64_t count, std::size_t dimension);

/// Moves points of [0, 1)^d by `steps` steps. Distances are those of a torus with sides
/// proportional to `extents`, or of the unit torus if that is empty. @throws Error(cancelled)
void relax_gaussian(std::span<double> rows, std::size_t dimension, std::uint64_t steps,
                    const RunContext& run, std::span<const double> extents = {});

/// Bytes that relax_to_density needs besides the rows and the map.
double density_relaxation_bytes(std::uint64_t count, const DensityMap& map);

/// Moves points of [0, 1)^2, all with a positive density, by `steps` steps. Distances are those of
/// a torus with sides proportional to `extents`, or of the unit torus if that is empty.
/// @throws Error(cancelled)
void relax_to_density(std::span<double> rows, const DensityMap& map, std::uint64_t steps,
                      const RunContext& run, std::span<const double> extents = {});

}  // namespace stipple
