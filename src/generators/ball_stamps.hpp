// SPDX-License-Identifier: MIT
//
// What a ball covers of the parts of the cells about its own, looked up by where in its cell the
// centre is: what is set is covered for every centre within one of n^3 places. For cells with a
// diagonal of about the radius.
//
// Of 21 rows of cells along the first direction: nine, at most one step from the centre's along
// each other direction, have five cells; twelve, two steps away along one of them, have three. No
// part of others is covered where cells are cubes with a diagonal of the radius.
//
// Shape   4 x 4 x 4 parts of a cell, bit x + 4 y + 16 z.
// Cost    93 words a place, n^3 places; some 0.6 us for each.
// Promise what has its bit set is covered, and not within float_slack of the rim.
#pragma once

#include <algorithm>
#include <array>
#include <memory>

#include "core/large_pages.hpp"
#include "generators/cube_windows.hpp"
#include "generators/disk_grid.hpp"

namespace stipple {

class BallStamps {
  public:
    struct Row {
        int y;  ///< steps to it
        int z;
        std::size_t first;  ///< word
    };
    static constexpr std::size_t long_rows = 9;  ///< of five cells, from two before the centre's
    static constexpr std::size_t short_rows =
        12;                                   ///< of four words, from one before; the last is 0
    static constexpr std::size_t words = 96;  ///< a multiple of a cache line

    /// The long ones, then the short ones.
    static constexpr auto rows = [] {
        std::array<Row, long_rows + short_rows> all{};
        std::size_t n = 0;
        for (int z = -1; z <= 1; ++z)
            for (int y = -1; y <= 1; ++y, ++n) all[n] = {y, z, 5 * n};
        for (int z = -2; z <= 2; ++z)
            for (int y = -2; y <= 2; ++y)
                if ((z * z == 4) != (y * y == 4)) {
                    all[n] = {y, z, 5 * long_rows + 4 * (n - long_rows)};
                    ++n;
                }
        return all;
    }();

    explicit BallStamps(const DiskGrid<3>& grid) {
        while (places_ * 2 <= most_places && power(places_ * 2, 3) * worth <= grid.cell_count)
            places_ *= 2;
        std::array<float, 3> scales;
        std::array<float, 3> play;
        for (std::size_t k = 0; k < 3; ++k) {
            to_places_[k] = static_cast<float>(static_cast<double>(places_) / grid.scales[k]);
            scales[k] = static_cast<float>(grid.scales[k]);
            play[k] = scales[k] / static_cast<float>(2 * places_);
        }
        stamps_ = unwritten_room<PartBits>(power(places_, 3) * words);
        std::array<float, 3> center;
        PartBits* to = stamps_.get();
        for (std::size_t place = 0; place < power(places_, 3); ++place, to += words) {
            for (std::size_t k = 0, rest = place; k < 3; ++k, rest /= places_)
                center[k] = static_cast<float>(2 * (rest % places_) + 1) * play[k];
            std::fill_n(to, words, PartBits{0});
            for (std::size_t r = 0; r < rows.size(); ++r) {
                const bool is_long = r < long_rows;
                cover_row(scales, play,
                          {center[0], center[1] - static_cast<float>(rows[r].y) * scales[1],
                           center[2] - static_cast<float>(rows[r].z) * scales[2]},
                          is_long ? 2 : 1, to + rows[r].first);
            }
        }
    }

    /// @param off of the centre from the corner of its cell, in radii
    [[nodiscard]] const PartBits* about(const std::array<float, 3>& off) const {
        std::size_t place = 0;
        for (std::size_t k = 3; k-- > 0;) {
            const auto q = static_cast<std::size_t>(off[k] * to_places_[k]);
            place = place * places_ + std::min(q, places_ - 1);
        }
        return stamps_.get() + words * place;
    }

  private:
    static constexpr std::size_t most_places = 32;
    /// Cells for each place of a centre that make a table worth its time.
    static constexpr std::size_t worth = 40;

    std::size_t places_ = 4;  ///< of a centre along a direction
    std::array<float, 3> to_places_{};
    std::unique_ptr<PartBits[]> stamps_;  ///< for each place
};

}  // namespace stipple
