// SPDX-License-Identifier: MIT
//
// The points of all tiles, one after the other.
#pragma once

#include <algorithm>

#include "core/rows.hpp"
#include "core/run_context.hpp"

namespace stipple {

/// @param points_of(tile) a vector of coordinates, point after point, whose memory goes meanwhile.
/// @throws Error(cancelled)
template <class Tiles, class PointsOf>
Rows rows_of_tiles(Tiles& tiles, const PointsOf& points_of, const RunContext& run) {
    std::size_t numbers = 0;
    for (auto& tile : tiles) numbers += points_of(tile).size();
    Rows rows = Rows::unwritten(numbers);
    auto out = rows.numbers().begin();
    for (auto& tile : tiles) {
        run.check_stop();
        out = std::ranges::copy(points_of(tile), out).out;
        points_of(tile) = {};
    }
    return rows;
}

}  // namespace stipple
