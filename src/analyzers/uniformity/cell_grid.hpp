// SPDX-License-Identifier: MIT
//
// Grids of cells on the cube of a domain: their size, the cell of a point, and the probability of
// each cell.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

using CellGrid = std::vector<std::size_t>;  ///< number of cells along each axis

/// Smallest expected number of points in a group of cells for the chi-square test.
inline constexpr std::uint64_t fewest_expected = 5;
inline constexpr std::uint64_t most_cells = 100'000'000;

/// A set uses the default grid of the largest of these numbers that is not above its number of
/// points; a set below the first of them uses the default grid of its own number.
inline constexpr std::uint64_t grid_counts[] = {1U << 20, 1U << 24, 1U << 28};

/// Largest number of axes that a default grid cuts.
inline constexpr std::size_t most_cut_axes = 8;

/// Default grid: odd primes, product near 2 n^(2/5), at most n / 5. @throws Error(input) if n < 15
CellGrid default_grid(std::uint64_t n, std::size_t axes);

/// Grid given by --cells. @throws Error(usage)
CellGrid asked_grid(const std::vector<std::int64_t>& extents, std::size_t axes);

std::uint64_t cell_count(const CellGrid& grid);

/// Index of the cell of a point of the closed cube; ignores coordinates after those of the grid. If
/// shifted, the first cell of each axis begins half a cell before 0, on the torus.
std::size_t cell_of(std::span<const double> cube, const CellGrid& grid, bool shifted);

/// Probabilities of all cells, whose sum is checked to be 1.
/// @throws Error(limit) if the domain's probabilities contradict each other
std::vector<Estimate> cell_masses(const Domain& domain, const CellGrid& grid, bool shifted,
                                  const RunContext& run);

}  // namespace stipple::analyzers
