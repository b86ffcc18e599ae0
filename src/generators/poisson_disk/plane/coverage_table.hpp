// SPDX-License-Identifier: MIT
//
// What a disk covers of the 5 x 5 cells about its own: a bit for each of 8 x 8 sub-cells, looked up
// by where in its cell the centre lies, to one of Q^2 places. What has its bit set is covered for
// every centre in that place. So whether a dart can stay is mostly known from one bit, and whether
// a cell is covered from one word.
//
// Shape   grids where a radius leads across two cells along both directions.
// Cost    25 words a disk; 200 kB for a table.
// Promise what has its bit set is covered by one disk alone, and not within float_slack of its rim.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "generators/poisson_disk/gaps.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple::poisson_disk {

class CoverageTable {
  public:
    using Place = std::array<float, 2>;
    using Row = std::array<SubcellBits, 5>;

    explicit CoverageTable(const Grid<2>& grid) : grid_(grid) {
        for (std::size_t k = 0; k < 2; ++k)
            sides_[k] = static_cast<float>(grid.scales[k] / double{subcells<2>});
        while (places_ * 2 <= most_places && places_ * places_ * worth < grid.cell_count)
            places_ *= 2, ++place_bits_;
        rows_.reserve(places_ * places_ * 5);
        for (std::size_t place = 0; place < places_ * places_; ++place)
            for (std::size_t row = 0; row < 5; ++row) rows_.push_back(row_of(place, row));
    }

    /// Five rows of five cells, from two before the one with the centre on, along both directions.
    /// @param digits of the place in the cell, 32 binary ones along each direction
    [[nodiscard]] const Row* about(const std::array<std::uint32_t, 2>& digits) const {
        const unsigned drop = 31 - place_bits_;
        const std::size_t place =
            std::size_t{digits[1] >> 1 >> drop} << place_bits_ | digits[0] >> 1 >> drop;
        return rows_.data() + 5 * place;
    }

  private:
    /// A table takes its time as well: cells for each place of a centre that make the next finer
    /// one worth it.
    static constexpr std::size_t worth = 128;
    static constexpr std::size_t most_places = 32;

    /// What a disk covers of five cells along the first direction, wherever in a place it lies.
    [[nodiscard]] Row row_of(std::size_t place, std::size_t row) const {
        const std::array<std::size_t, 2> at{place % places_, place / places_};
        const std::array<double, 2> there{-2, static_cast<double>(row) - 2};
        Place center;
        Place play;
        for (std::size_t k = 0; k < 2; ++k) {
            const double size = grid_.scales[k] / static_cast<double>(places_);
            center[k] = static_cast<float>((static_cast<double>(at[k]) + 0.5) * size -
                                           there[k] * grid_.scales[k]);
            play[k] = static_cast<float>(size / 2);
        }
        Row out;
        for (SubcellBits& bits : out) {
            bits = covered(center, play);
            center[0] -= static_cast<float>(grid_.scales[0]);
        }
        return out;
    }

    /// Sub-cells of a cell that a disk covers, whose centre is within `play` of `center` along each
    /// direction.
    [[nodiscard]] SubcellBits covered(const Place& center, const Place& play) const {
        constexpr std::size_t p = subcells<2>;
        SubcellBits bits = 0;
        for (std::size_t line = 0; line < p; ++line) {
            const float middle = (static_cast<float>(line) + 0.5F) * sides_[1];
            const float y = std::abs(center[1] - middle) + sides_[1] / 2 + play[1];
            const float left = 1 - float_slack - y * y;
            if (left <= 0) continue;
            const float half = std::sqrt(left) - play[0];
            const float begin = std::ceil((center[0] - half) / sides_[0]);
            const float end = std::floor((center[0] + half) / sides_[0]);
            const auto b = static_cast<unsigned>(std::clamp(begin, 0.0F, float{p}));
            const auto e = static_cast<unsigned>(std::clamp(end, 0.0F, float{p}));
            if (b < e) bits |= SubcellBits{(1U << e) - (1U << b)} << (line * p);
        }
        return bits;
    }

    const Grid<2>& grid_;
    Place sides_{};            ///< of a sub-cell, in radii
    std::size_t places_ = 4;   ///< of a centre along a direction
    unsigned place_bits_ = 2;  ///< their number's
    std::vector<Row> rows_;    ///< for each place of a centre
};

}  // namespace stipple::poisson_disk
