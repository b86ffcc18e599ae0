// SPDX-License-Identifier: MIT
//
// Sums of grids of numbers of any size. A grid is added up with others of about its own size, each
// cell over a power of two as whole multiples of 2^-21 and, for what these leave, of 2^-64. Rounded
// once when they are added (by at most 2^-65 of that power), grids can be added in any order and in
// any parts: whole numbers forget where they came from. The sums for each size are added in a fixed
// order. So it is rounding relative to each grid that is lost, not more.
//
// Shape   16 bytes a cell and size; numbers below 2^29 sizes, and sums below 2^42 of up to 2^20
//         grids.
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

    /// Grids of one number of cells.
    /// @param size that decides what the grid is added to.
    void add(std::span<const double> cells, double size, const RunContext& run);

    void copy_to(std::span<double> cells, const RunContext& run) const;

    void pack(Packer& to) const;
    void merge(Unpacker& from);

  private:
    /// Modulo 2^64, both.
    struct Cells {
        std::vector<std::uint64_t> coarse;
        std::vector<std::uint64_t> fine;
    };
    std::map<int, Cells> sums_;  ///< of grids over 2^key
};

}  // namespace stipple
