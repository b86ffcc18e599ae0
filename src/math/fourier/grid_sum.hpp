// SPDX-License-Identifier: MIT
//
// Sums of grids, independent of the order of additions. Grids whose cells have similar magnitudes
// are added together: each cell is divided by a common power of two and split into integer
// multiples of 2^-21 and, for the remainder, of 2^-64. This rounds a cell once, by at most 2^-65 of
// the power of two. Sums of the integers are exact, so these grids can be added in any order and
// grouping. Sums for different powers of two are added in a fixed order. So the rounding errors are
// relative to the magnitude of each grid.
//
// Shape   16 bytes per cell and power of two in use. In units of this power, cells are below 2^29,
//         and sums of up to 2^20 grids below 2^42.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/bytes/packed.hpp"
#include "stipple/run.hpp"

namespace stipple {

class ScaledGridSum {
  public:
    [[nodiscard]] bool empty() const { return sums_.empty(); }

    /// Adds a grid; all must have the same number of cells.
    /// @param size magnitude of the cells, which selects the sum to add to
    void add(std::span<const double> cells, double size, const RunContext& run);

    void copy_to(std::span<double> cells, const RunContext& run) const;

    void pack(Packer& to) const;
    void merge(Unpacker& from);

  private:
    /// Sums of the two integers of each cell, modulo 2^64.
    struct Cells {
        std::vector<std::uint64_t> coarse;
        std::vector<std::uint64_t> fine;
    };
    std::map<int, Cells> sums_;  ///< sums of grids divided by 2^key
};

}  // namespace stipple
