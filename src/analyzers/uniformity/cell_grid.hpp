// SPDX-License-Identifier: MIT
//
// Grids of cells on the cube of a domain: how many, which one a point is in, and how probable each
// is.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/domain.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

using CellGrid = std::vector<std::size_t>;  ///< cells along each axis

inline constexpr std::uint64_t fewest_expected = 5;  ///< points in a group of cells
inline constexpr std::uint64_t most_cells = 100'000'000;

/// Beyond the first of these the default grid is the one of the largest of them that is not above
/// the count.
inline constexpr std::uint64_t grid_counts[] = {1U << 20, 1U << 24, 1U << 28};

/// Axes that a default grid cuts at most.
inline constexpr std::size_t most_cut_axes = 8;

/// Odd primes with a product near 2 n^(2/5), at most n / 5. @throws Error(input) for n < 15
CellGrid default_grid(std::uint64_t n, std::size_t axes);

/// The grid that --cells asks for. @throws Error(usage)
CellGrid asked_grid(const std::vector<std::int64_t>& extents, std::size_t axes);

std::uint64_t cell_count(const CellGrid& grid);

/// The cell of a point of the closed cube; coordinates beyond the grid's are not looked at. A
/// shifted grid is so by half a cell along every axis it cuts, on the torus: cell 0 begins half a
/// cell before 0.
std::size_t cell_of(std::span<const double> cube, const CellGrid& grid, bool shifted);

/// The probabilities of all cells. Their sum is checked to be 1.
/// @throws Error(limit) when the domain's masses contradict each other
std::vector<Estimate> cell_masses(const Domain& domain, const CellGrid& grid, bool shifted,
                                  const RunContext& run);

}  // namespace stipple::analyzers
