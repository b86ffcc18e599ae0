// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space_showers.hpp"

#include <bit>
#include <cstring>

#include "core/rng.hpp"
#include "core/wide.hpp"
#include "math/functions/splitmix64.hpp"

namespace stipple {

void land(const SpaceRules& rules, const SpaceTile& tile, const SpaceCell& cell, const Throw& dart,
          Hit hit, std::vector<SpaceDart>& darts) {
    if (hit == Hit::yes) return;
    SpaceDart d{};
    SplitMix64 mixer(dart.detail);
    for (std::size_t k = 0; k < 3; ++k) {
        const double along = cell[k] + dart.place[k] + dart.grain * to_unit(mixer.next());
        d.at[k] = rules.grid.low[k] + (tile.first()[k] + along) * rules.grid.widths[k];
        d.off[k] = static_cast<float>(along * rules.grid.scales[k]);
        if (!(d.at[k] < rules.grid.high[k])) return;  // rounded up to a face
    }
    if (hit == Hit::unsure && tile.hits(cell, d.at.data())) return;
    d.time = static_cast<std::uint32_t>(mixer.next());
    d.place = space_place(cell);
    darts.push_back(d);
}

void fall_at_large(const SpaceRules& rules, const SpaceTile& tile, const Shower& shower,
                   std::uint64_t key, bool any, std::vector<SpaceDart>& darts) {
    for (int row = 0; row < space_side * tile.size(2); ++row) {
        if (row % space_side >= tile.size(1)) continue;
        for (int x = 0; x < tile.size(0); x += cells_together) {
            const int count = std::min(cells_together, tile.size(0) - x);
            SplitMix64 mixer(
                SplitMix64(key ^ static_cast<std::uint64_t>(row * space_side + x)).next());
            for (std::uint64_t left = shower.on(static_cast<std::size_t>(count), mixer); left > 0;
                 --left) {
                std::array<double, 3> place;
                for (double& along : place) along = to_unit(mixer.next());
                place[0] *= count;
                const int step = static_cast<int>(place[0]);
                place[0] -= step;
                const SpaceCell cell{x + step, row % space_side, row / space_side};
                std::size_t part = 0;
                for (std::size_t k = 3; k-- > 0;)
                    part = part * 4 + static_cast<std::size_t>(place[k] * 4);
                if (has_part(tile.lines(), cell, part)) continue;
                SpaceRules::Quad off{};
                for (std::size_t k = 0; k < 3; ++k)
                    off[k] = static_cast<float>(place[k] * rules.grid.scales[k]);
                const Hit hit = any ? tile.hit(cell, part, off) : Hit::no;
                land(rules, tile, cell, {place, 0, mixer.next()}, hit, darts);
            }
        }
    }
}

namespace {

/// Open parts of some lines beside each other, in the four layers of a row of cells.
class OpenUnit {
  public:
    static constexpr std::size_t pairs = words_together / 4;  ///< of lines, in a layer
    static constexpr std::size_t in_column = BallLines::along / (2 * pairs);
    static constexpr std::size_t columns = space_side * BallLines::words;

    /// @param number in the column
    [[gnu::always_inline]] OpenUnit(const SpaceTile& tile, std::size_t column, std::size_t number)
        : first_{32 * (column % BallLines::words), number * 2 * pairs,
                 column / BallLines::words * 4} {
        const std::uint32_t* lines =
            tile.lines() + BallLines::at(column % BallLines::words, first_[1], first_[2]);
        for (std::size_t z = 0; z < 4; ++z, lines += BallLines::layer)
            std::memcpy(&covered_[z * pairs], lines, pairs * sizeof(PartBits));
        for (std::size_t i = 0; i < words_together; ++i) {
            before_[i] = count_;
            count_ = static_cast<std::uint16_t>(count_ + std::popcount(~covered_[i]));
        }
    }

    [[nodiscard]] std::size_t count() const { return count_; }

    /// The place of one of them in the tile, in parts.
    [[nodiscard, gnu::always_inline]] std::array<std::size_t, 3> place(std::uint16_t n) const {
        std::size_t word = 0;  // the last one with so many parts before it
        for (std::size_t i = 1; i < words_together; ++i) word += before_[i] <= n ? 1 : 0;
        const std::size_t bit = nth_bit(~covered_[word], n - std::size_t{before_[word]});
        return {first_[0] + bit % 32, first_[1] + 2 * (word % pairs) + bit / 32,
                first_[2] + word / pairs};
    }

  private:
    std::array<std::size_t, 3> first_;
    std::array<PartBits, words_together> covered_;      ///< two lines in a word
    std::array<std::uint16_t, words_together> before_;  ///< open ones in the words before
    std::uint16_t count_ = 0;
};

/// Adds the darts on a unit.
[[gnu::always_inline]] inline void throw_on_unit(const OpenUnit& unit, const Shower& shower,
                                                 std::uint64_t key,
                                                 std::vector<PartThrow>& throws) {
    SplitMix64 mixer(key);
    for (std::uint64_t left = shower.on(unit.count(), mixer); left > 0; --left) {
        const std::uint64_t which = mixer.next();
        const std::uint64_t where = mixer.next();
        const auto at = unit.place(static_cast<std::uint16_t>((which >> 32) * unit.count() >> 32));
        const auto digits = [&](std::size_t k) {
            return static_cast<std::int32_t>(at[k] % 4 << 21 | (where >> (21 * k) & 0x1fffff));
        };
        const PartThrow::Digits all{digits(0), digits(1), digits(2), 0};
        const SpaceCell cell{static_cast<int>(at[0] / 4), static_cast<int>(at[1] / 4),
                             static_cast<int>(at[2] / 4)};
        throws.push_back(
            PartThrow{all, which << 32 ^ where, space_place(cell),
                      static_cast<std::uint8_t>(at[0] % 4 + at[1] % 4 * 4 + at[2] % 4 * 16)});
    }
}

}  // namespace

STIPPLE_WIDE void fall_on_parts(const SpaceRules& rules, const SpaceTile& tile,
                                const Shower& shower, std::uint64_t key,
                                std::vector<PartThrow>& throws, std::vector<SpaceDart>& darts) {
    using Quad = SpaceRules::Quad;
    constexpr double grain = 0x1p-23;
    const Quad to_radii =
        Quad{rules.scales[0], rules.scales[1], rules.scales[2], 0} * static_cast<float>(grain);
    for (std::size_t column = 0; column < OpenUnit::columns; ++column) {
        // What a dart hits is hard to foresee; where the next ones fall does not wait for that.
        throws.clear();
        for (std::size_t i = 0; i < OpenUnit::in_column; ++i)
            if (const OpenUnit unit(tile, column, i); unit.count() > 0)
                throw_on_unit(unit, shower, key + column * OpenUnit::in_column + i, throws);
        for (const PartThrow& t : throws) {
            const SpaceCell cell = space_cell(t.place);
            const Hit hit =
                tile.hit(cell, t.part, __builtin_convertvector(t.digits, Quad) * to_radii);
            if (hit == Hit::yes) continue;
            land(rules, tile, cell,
                 {{t.digits[0] * grain, t.digits[1] * grain, t.digits[2] * grain}, grain, t.detail},
                 hit, darts);
        }
    }
}

}  // namespace stipple
