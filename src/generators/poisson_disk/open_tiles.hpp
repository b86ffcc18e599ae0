// SPDX-License-Identifier: MIT
//
// Which tiles of a domain have something open yet, while showers of darts fall on them; and the
// points of all tiles, one after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <vector>

#include "core/parallel.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

namespace stipple {

class OpenTiles {
  public:
    /// All of them. @param expected points in the end, by which progress is told
    OpenTiles(std::size_t count, std::uint64_t expected, const RunContext& run)
        : numbers_(count), expected_(expected), run_(run) {
        std::iota(numbers_.begin(), numbers_.end(), 0U);
    }

    [[nodiscard]] bool empty() const { return numbers_.empty(); }
    [[nodiscard]] const RunContext& run() const { return run_; }

    /// Calls work(tile, number) for each, on several threads.
    /// @throws Error(cancelled)
    template <class Tile, class Work>
    void for_each(std::vector<Tile>& tiles, const Work& work) const {
        for_each_block(silent(run_), numbers_.size(), 1,
                       [&](const Block& b) { work(tiles[numbers_[b.first]], numbers_[b.first]); });
    }

    /// Leaves out those that are closed(tile) now.
    template <class Tile, class Closed>
    void close(std::vector<Tile>& tiles, const Closed& closed) {
        std::erase_if(numbers_, [&](std::uint32_t number) { return closed(tiles[number]); });
    }

    /// Tells progress. @param points member of a tile: coordinates, point after point
    template <class Tile, class Points>
    void tick(std::vector<Tile>& tiles, Points points, std::size_t dimension) const {
        std::uint64_t count = 0;
        for (Tile& tile : tiles) count += std::invoke(points, tile).size() / dimension;
        run_.tick(std::min(count, expected_), expected_);
    }

  private:
    std::vector<std::uint32_t> numbers_;
    std::uint64_t expected_;
    RunContext run_;
};

/// @param points member of a tile: coordinates, point after point, whose memory goes meanwhile
/// @throws Error(cancelled)
template <class Tile, class Points>
Rows rows_of_tiles(std::vector<Tile>& tiles, Points points, const RunContext& run) {
    std::size_t numbers = 0;
    for (Tile& tile : tiles) numbers += std::invoke(points, tile).size();
    Rows rows = Rows::unwritten(numbers);
    auto out = rows.numbers().begin();
    for (Tile& tile : tiles) {
        run.check_stop();
        out = std::ranges::copy(std::invoke(points, tile), out).out;
        std::invoke(points, tile) = {};
    }
    return rows;
}

}  // namespace stipple
