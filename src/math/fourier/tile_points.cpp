// SPDX-License-Identifier: MIT
#include "math/fourier/tile_points.hpp"

#include <algorithm>
#include <cassert>

namespace stipple {
namespace {

std::size_t blocks_for(std::size_t points, std::size_t tiles) {
    return points / TilePoints::block + std::min(points, tiles) + 1;
}

}  // namespace

TilePoints::TilePoints(std::size_t tiles, std::size_t numbers, std::size_t capacity)
    : numbers_(numbers),
      room_(Rows::unwritten(blocks_for(capacity, tiles) * block, numbers)),
      lists_(tiles),
      next_(blocks_for(capacity, tiles)) {
    assert(numbers >= 1 && numbers <= 4 && capacity <= std::size_t{1} << 26);
}

std::uint32_t TilePoints::next_block(List& list) {
    const std::uint32_t fresh = used_++;
    (list.end == 0 ? list.first : next_[list.end / block - 1]) = fresh;
    return fresh * static_cast<std::uint32_t>(block);
}

template <std::size_t Numbers>
void TilePoints::append(const double* rows, const std::uint32_t* tile_of, std::size_t count) {
    double* room = room_.numbers().data();
    for (std::size_t i = 0; i < count; ++i) {
        List& list = lists_[tile_of[i]];
        if (list.end % block == 0) list.end = next_block(list);
        std::copy_n(rows + i * Numbers, Numbers, room + std::size_t{list.end++} * Numbers);
    }
}

void TilePoints::add(const double* rows, const std::uint32_t* tile_of, std::size_t count) {
    if (numbers_ == 1) return append<1>(rows, tile_of, count);
    if (numbers_ == 2) return append<2>(rows, tile_of, count);
    if (numbers_ == 3) return append<3>(rows, tile_of, count);
    append<4>(rows, tile_of, count);
}

void TilePoints::clear() {
    std::ranges::fill(lists_, List{});
    used_ = 1;
}

double TilePoints::bytes(double count, double tiles, std::size_t numbers) {
    const double blocks = count / static_cast<double>(block) + std::min(count, tiles) + 1;
    return blocks * static_cast<double>(block * numbers * sizeof(double)) + 12 * tiles;
}

}  // namespace stipple
