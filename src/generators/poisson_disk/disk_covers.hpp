// SPDX-License-Identifier: MIT
//
// Which parts of the cells of a grid lie under a disk: a bit for each of 64 parts of a cell, kept
// as the disks come, so that whether a dart can stay is mostly known from one bit, and whether a
// cell is covered from one word.
//
// A new disk sets bits in up to 5^D cells about its own. Which ones, is looked up by where in its
// cell the centre lies, to one of Q^D places: what is set is covered for every centre in that
// place. On grids where a radius leads across more than two cells, bits are worked out one disk at
// a time.
//
// Shape   D = 2: 8 x 8 parts of a cell; D = 3: 4 x 4 x 4. Bit x + P y + P^2 z.
// Cost    5^D words a disk; 8 bytes a cell, and 200 kB (D = 2) or up to 4 MB (3) for a table.
// Promise what has its bit set is covered by one disk alone, and not within float_slack of its rim.
#pragma once

#include <atomic>
#include <bit>
#include <cmath>
#include <vector>

#include "core/large_pages.hpp"
#include "generators/poisson_disk/disk_grid.hpp"
#include "generators/poisson_disk/disk_window.hpp"
#include "generators/poisson_disk/near_disks.hpp"

namespace stipple {

/// A cell's parts that one disk covers, or those left open by all.
using PartBits = std::uint64_t;
inline constexpr std::size_t parts_of_cell = 8 * sizeof(PartBits);

/// Number of ones; the instruction is not everywhere.
inline std::size_t ones_of(PartBits bits) {
    bits -= bits >> 1 & 0x5555555555555555U;
    bits = (bits & 0x3333333333333333U) + (bits >> 2 & 0x3333333333333333U);
    return ((bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fU) * 0x0101010101010101U >> 56;
}

/// Parts of a cell along each direction, which its bits are of.
template <std::size_t D>
inline constexpr std::size_t cell_parts = D == 2 ? 8 : 4;

/// Where in a byte its n-th one is, at 8 byte + n.
inline constexpr auto nth_in_byte = [] {
    std::array<std::uint8_t, 2048> table{};
    for (std::size_t byte = 0; byte < 256; ++byte)
        for (std::size_t bit = 0, n = 0; bit < 8; ++bit)
            if ((byte >> bit & 1) != 0) table[8 * byte + n++] = static_cast<std::uint8_t>(bit);
    return table;
}();

/// The number of the n-th one among the bits; there are more than n.
inline std::size_t nth_bit(PartBits bits, std::size_t n) {
    constexpr PartBits each = 0x0101010101010101U;  // byte
    constexpr PartBits high = 0x8080808080808080U;
    PartBits counts = bits - (bits >> 1 & 0x5555555555555555U);
    counts = (counts & 0x3333333333333333U) + (counts >> 2 & 0x3333333333333333U);
    const PartBits up_to = ((counts + (counts >> 4)) & 0x0f0f0f0f0f0f0f0fU) * each;
    const PartBits passed = ((n * each | high) - up_to) & high;  // bytes before the one with it
    const std::size_t shift = (passed >> 7) * each >> 56 << 3;
    const std::size_t before = (up_to << 8) >> shift & 0xff;
    return shift + nth_in_byte[(bits >> shift & 0xff) * 8 + n - before];
}

/// The lowest corner of the n-th part with a bit, in cells.
template <std::size_t D>
std::array<double, D> nth_part(PartBits bits, std::size_t n) {
    std::size_t bit = nth_bit(bits, n);
    std::array<double, D> corner;
    for (std::size_t k = 0; k < D; ++k, bit /= cell_parts<D>)
        corner[k] = static_cast<double>(bit % cell_parts<D>) / double{cell_parts<D>};
    return corner;
}

/// The smallest window of a cell around all parts with a bit.
template <std::size_t D>
Window<D> window_around(PartBits bits, std::uint16_t place) {
    constexpr std::size_t p = cell_parts<D>;
    std::array<std::size_t, D> low;
    std::size_t longest = 0;
    for (std::size_t k = 0, stride = 1; k < D; ++k, stride *= p) {
        PartBits fold = bits;  // onto direction k
        for (std::size_t other = 0, by = 1; other < D; ++other, by *= p)
            for (std::size_t half = p / 2; other != k && half > 0; half /= 2)
                fold |= fold >> (half * by);
        PartBits along = 0;
        for (std::size_t i = 0; i < p; ++i) along |= (fold >> (i * stride) & 1) << i;
        low[k] = static_cast<std::size_t>(std::countr_zero(along));
        longest = std::max(longest, static_cast<std::size_t>(std::bit_width(along)) - low[k]);
    }
    Window<D> window{{}, place, 0};
    std::size_t fit = p;
    for (; fit > 1 && fit / 2 >= longest; fit /= 2) ++window.level;
    for (std::size_t k = 0; k < D; ++k)
        window.corner[k] = static_cast<double>(std::min(low[k], p - fit)) / double{p};
    return window;
}

/// What a disk covers of the 5^D cells about its own, looked up by where in its cell the centre is;
/// for grids where a radius leads across two cells along all directions, and else parts of any
/// cell.
template <std::size_t D>
class DiskStamps {
  public:
    using Grid = DiskGrid<D>;
    using Place = std::array<float, D>;
    using Row = std::array<PartBits, 5>;

    static constexpr std::size_t rows = power(5, D - 1);

    explicit DiskStamps(const Grid& grid) : grid_(grid) {
        for (std::size_t k = 0; k < D; ++k)
            parts_[k] = static_cast<float>(grid.scales[k] / static_cast<double>(cell_parts<D>));
        while (places_ * 2 <= most_places && power(places_, D) * worth < grid.cell_count)
            places_ *= 2, ++place_bits_;
        for (std::size_t k = 0; k < D; ++k)
            to_places_[k] = static_cast<float>(static_cast<double>(places_) / grid.scales[k]);
        stamps_.reserve(power(places_, D) * rows);
        ask_for_large_pages(stamps_.data(), stamps_.capacity() * sizeof(Row));
        for (std::size_t place = 0; place < power(places_, D); ++place)
            for (std::size_t row = 0; row < rows; ++row) stamps_.push_back(stamp(place, row));
    }

    /// Rows of five cells, from two before the one with the centre on, along every direction.
    /// @param off of the centre from the corner of its cell, in radii
    [[nodiscard]] const Row* about(const Place& off) const {
        return stamps_.data() + rows * place_of(off);
    }

    /// The same, by the place in the cell as 32 binary digits along each direction.
    [[nodiscard]] const Row* about_digits(const std::array<std::uint32_t, D>& digits) const {
        std::size_t place = 0;
        for (std::size_t k = D; k-- > 0;)
            place = place << place_bits_ | digits[k] >> 1 >> (31 - place_bits_);
        return stamps_.data() + rows * place;
    }

    /// Parts of a cell that a disk covers, whose centre is within `play` of `center` along each
    /// direction.
    [[nodiscard]] PartBits covered_parts(const Place& center, const Place& play) const {
        PartBits bits = 0;
        for (std::size_t line = 0; line < power(cell_parts<D>, D - 1); ++line) {
            float left = 1 - float_slack;
            for (std::size_t k = 1, rest = line; k < D; ++k, rest /= cell_parts<D>) {
                const float middle = (static_cast<float>(rest % cell_parts<D>) + 0.5F) * parts_[k];
                const float y = std::abs(center[k] - middle) + parts_[k] / 2 + play[k];
                left -= y * y;
            }
            if (left <= 0) continue;
            const float half = std::sqrt(left) - play[0];
            const float begin = std::ceil((center[0] - half) / parts_[0]);
            const float end = std::floor((center[0] + half) / parts_[0]);
            const auto b = static_cast<unsigned>(std::clamp(begin, 0.0F, float{cell_parts<D>}));
            const auto e = static_cast<unsigned>(std::clamp(end, 0.0F, float{cell_parts<D>}));
            if (b < e) bits |= PartBits{(1U << e) - (1U << b)} << (line * cell_parts<D>);
        }
        return bits;
    }

  private:
    /// A table takes its time as well: cells for each place of a centre that make the next finer
    /// one worth it.
    static constexpr std::size_t worth = D == 2 ? 128 : 2048;
    static constexpr std::size_t most_places = D == 2 ? 32 : 16;

    [[nodiscard]] std::size_t place_of(const Place& off) const {
        std::size_t place = 0;
        for (std::size_t k = D; k-- > 0;) {
            const auto q = static_cast<std::size_t>(off[k] * to_places_[k]);
            place = place * places_ + std::min(q, places_ - 1);
        }
        return place;
    }

    /// What a disk covers of five cells along the first direction, wherever in a place it lies.
    [[nodiscard]] Row stamp(std::size_t place, std::size_t row) const {
        Place center;
        Place play;
        for (std::size_t k = 0, rest = place, there = 5 * row; k < D;
             ++k, rest /= places_, there /= 5) {
            const double size = grid_.scales[k] / static_cast<double>(places_);
            const double at = (static_cast<double>(rest % places_) + 0.5) * size;
            const double corner = (static_cast<double>(there % 5) - 2) * grid_.scales[k];
            center[k] = static_cast<float>(at - corner);
            play[k] = static_cast<float>(size / 2);
        }
        Row out;
        for (PartBits& bits : out) {
            bits = covered_parts(center, play);
            center[0] -= static_cast<float>(grid_.scales[0]);
        }
        return out;
    }

    const Grid& grid_;
    Place parts_{};            ///< sides of a part, in radii
    Place to_places_{};        ///< from radii
    std::size_t places_ = 4;   ///< of a centre along a direction
    unsigned place_bits_ = 2;  ///< their number's
    std::vector<Row> stamps_;  ///< for each place of a centre
};

template <std::size_t D>
class DiskCovers {
  public:
    using Grid = DiskGrid<D>;
    using Index = typename Grid::Index;
    using Point = typename Grid::Point;
    using Place = std::array<float, D>;

    explicit DiskCovers(const Grid& grid) : grid_(grid), stamps_(grid) {
        fill_with_zeros(covered_, grid.spots);
        for (std::size_t k = 0; k < D; ++k) plain_ = plain_ && grid.reach[k] == 2;
        for (std::size_t row = 0; row < steps_.size(); ++row) {
            steps_[row] = -2;
            for (std::size_t k = 1, rest = row; k < D; ++k, rest /= 5)
                steps_[row] += (static_cast<std::ptrdiff_t>(rest % 5) - 2) *
                               static_cast<std::ptrdiff_t>(grid_.strides[k]);
        }
    }

    /// Gives back the memory.
    void clear() { covered_ = {}; }

    /// Parts that a disk covers alone, of a cell and those behind it.
    [[nodiscard]] const PartBits* row(std::size_t cell) const { return &covered_[cell]; }

    /// Whether the part of a cell with this place, in cells, is covered.
    [[nodiscard]] bool covers(std::size_t cell, const Point& place) const {
        std::size_t bit = 0;
        for (std::size_t k = D; k-- > 0;)
            bit = bit * cell_parts<D> + static_cast<std::size_t>(place[k] * double{cell_parts<D>});
        return (covered_[cell] >> bit & 1) != 0;
    }

    /// Covers what a disk about a place of a cell covers, from its corner in radii.
    /// @param shared whether other threads may be about the same cells
    void add(const Index& cell, const Place& off, bool shared) {
        if (grid_.interior(cell)) {
            const auto* stamp = stamps_.about(off);
            const std::size_t number = grid_.spot_of(cell);
            for (const std::ptrdiff_t step : steps_) {
                const std::size_t to = number + static_cast<std::size_t>(step);
                if (shared)
                    for (std::size_t i = 0; i < 5; ++i) set_shared(to + i, (*stamp)[i]);
                else
                    for (std::size_t i = 0; i < 5; ++i) covered_[to + i] |= (*stamp)[i];
                ++stamp;
            }
        } else if (plain_) {
            const auto* stamp = stamps_.about(off);
            grid_.around(cell, [&](const Index& there, const Point& steps) {
                std::size_t row = 0;
                for (std::size_t k = D; k-- > 1;)
                    row = 5 * row + static_cast<std::size_t>(steps[k] + 2);
                const PartBits bits = stamp[row][static_cast<std::size_t>(steps[0] + 2)];
                if (bits != 0) set_shared(grid_.spot_of(there), bits);
            });
        } else {
            grid_.around(cell, [&](const Index& there, const Point& steps) {
                Place center;
                for (std::size_t k = 0; k < D; ++k)
                    center[k] = off[k] - static_cast<float>(steps[k] * grid_.scales[k]);
                set_shared(grid_.spot_of(there), stamps_.covered_parts(center, {}));
            });
        }
    }

  private:
    void set_shared(std::size_t cell, PartBits bits) {
        if (bits == 0) return;
        std::atomic_ref<PartBits>(covered_[cell]).fetch_or(bits, std::memory_order_relaxed);
    }

    const Grid& grid_;
    std::vector<PartBits> covered_;
    DiskStamps<D> stamps_;
    bool plain_ = true;  ///< a radius leads across two cells, along all directions
    std::array<std::ptrdiff_t, DiskStamps<D>::rows> steps_{};  ///< from a cell to the first of each
                                                               ///< five about it
};

}  // namespace stipple
