// SPDX-License-Identifier: MIT
//
// Points sorted into tiles as they come: each tile has a list of blocks, which stand wherever there
// was room, so that nobody has to count the points first. Within a tile they keep their order.
//
// Cost    O(1) a point. Memory of n points: at most that of n + 31 min(n, tiles).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stipple/points.hpp"

namespace stipple {

class TilePoints {
  public:
    static constexpr std::size_t block = 32;  ///< points: some cache lines

    /// @param numbers of a row, 1 to 4.
    /// @param capacity points that there is room for, at most 2^26.
    TilePoints(std::size_t tiles, std::size_t numbers, std::size_t capacity);

    /// Adds rows to their tiles.
    void add(const double* rows, const std::uint32_t* tile_of, std::size_t count);

    /// Calls visit(rows) for the tile's points, up to `block` of them at a time.
    template <class Visit>
    void visit(std::size_t tile, Visit&& visit) const {
        const List list = lists_[tile];
        if (list.end == 0) return;
        const std::uint32_t last = (list.end - 1) / block;
        for (std::uint32_t at = list.first;; at = next_[at]) {
            const double* rows = room_.numbers().data() + at * block * numbers_;
            if (at == last) return visit(std::span(rows, (list.end - at * block) * numbers_));
            visit(std::span(rows, block * numbers_));
        }
    }

    void clear();

    /// Memory that so many points may take.
    static double bytes(double count, double tiles, std::size_t numbers);

  private:
    struct List {
        std::uint32_t first = 0;  ///< block
        std::uint32_t end = 0;    ///< place for the next point; 0: there is no block yet
    };

    template <std::size_t Numbers>
    void append(const double* rows, const std::uint32_t* tile_of, std::size_t count);
    std::uint32_t next_block(List& list);

    std::size_t numbers_;
    Rows room_;
    std::vector<List> lists_;
    std::vector<std::uint32_t> next_;  ///< block after each
    std::uint32_t used_ = 1;           ///< blocks; the first stays empty, so that 0 means none
};

}  // namespace stipple
