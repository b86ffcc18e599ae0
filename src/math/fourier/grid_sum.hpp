// SPDX-License-Identifier: MIT
//
// Sums of grids of numbers, each cell as whole multiples of 2^-21 and, for what these leave, of
// 2^-64. Rounded once when they are added (by at most 2^-65), grids can be added in any order and
// in any parts: whole numbers forget where they came from.
//
// Shape   16 bytes a cell; numbers below 2^29, and sums below 2^42 of up to 2^20 grids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "core/bytes/packed.hpp"
#include "stipple/run.hpp"

namespace stipple {

class GridSum {
  public:
    /// Grids of one number of cells, over 2^exponent.
    void add(std::span<const double> cells, int exponent, const RunContext& run);

    /// The sum times 2^exponent, rounded.
    void copy_to(std::span<double> cells, int exponent, const RunContext& run) const;

    void pack(Packer& to) const;
    void merge(Unpacker& from);

  private:
    std::vector<std::uint64_t> coarse_;  ///< modulo 2^64, as are the fine ones
    std::vector<std::uint64_t> fine_;
};

/// The same for numbers of any size: grids are added up with others of about their own size, and
/// these sums in a fixed order. So it is rounding relative to each grid that is lost, not more.
class ScaledGridSum {
  public:
    [[nodiscard]] bool empty() const { return sums_.empty(); }

    /// @param size that decides what the grid is added to: its numbers are below 2^29 times that.
    /// 1 for those that GridSum takes.
    void add(std::span<const double> cells, double size, const RunContext& run);

    void copy_to(std::span<double> cells, const RunContext& run) const;

    void pack(Packer& to) const;
    void merge(Unpacker& from);

  private:
    std::map<int, GridSum> sums_;  ///< of grids over 2^key
};

}  // namespace stipple
