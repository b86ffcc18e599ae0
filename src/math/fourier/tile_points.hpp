// SPDX-License-Identifier: MIT
//
// Points sorted into tiles on arrival. Each tile has a linked list of blocks from a common pool, so
// that points need not be counted first. Points keep their order within a tile.
//
// Cost    O(1) per point. Memory for n points: at most that of n + 31 min(n, tiles) points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stipple/points.hpp"

namespace stipple {

class TilePoints {
  public:
    static constexpr std::size_t block = 32;  ///< points per block: a few cache lines

    /// @param numbers per row, 1 to 4.
    /// @param capacity maximum number of points, at most 2^26.
    TilePoints(std::size_t tiles, std::size_t numbers, std::size_t capacity);

    void add(const double* rows, const std::uint32_t* tile_of, std::size_t count);

    /// Calls visit(rows) for the tile's points, at most `block` of them at a time.
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

    /// Bytes for `count` points.
    static double bytes(double count, double tiles, std::size_t numbers);

  private:
    struct List {
        std::uint32_t first = 0;  ///< first block
        std::uint32_t end = 0;    ///< index for the next point; 0 if there is no block yet
    };

    template <std::size_t Numbers>
    void append(const double* rows, const std::uint32_t* tile_of, std::size_t count);
    std::uint32_t next_block(List& list);

    std::size_t numbers_;
    Rows room_;
    std::vector<List> lists_;
    std::vector<std::uint32_t> next_;  ///< by block: the next block in its list
    std::uint32_t used_ = 1;  ///< blocks in use; block 0 is never used, so that 0 means none
};

}  // namespace stipple
