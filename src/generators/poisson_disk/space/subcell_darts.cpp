// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/subcell_darts.hpp"

#include <bit>
#include <cstring>

#include "core/rng.hpp"
#include "core/wide.hpp"
#include "math/functions/splitmix64.hpp"

namespace stipple::poisson_disk {

void insert(const SpaceRules& rules, const SpaceTile& tile, const TileCell<3>& cell,
            const DrawnDart& drawn, Hit hit, std::vector<PendingDart<3>>& darts) {
    if (hit == Hit::yes) return;
    PendingDart<3> dart{};
    SplitMix64 mixer(drawn.detail);
    std::array<double, 3> place;
    for (std::size_t k = 0; k < 3; ++k)
        place[k] = drawn.place[k] + drawn.grain * to_unit(mixer.next());
    if (!tile.locate(rules.grid, cell, place, dart.at)) return;
    if (hit == Hit::unsure && tile.hits(cell, dart.at)) return;
    dart.time = static_cast<std::uint32_t>(mixer.next());
    dart.place = SpaceTile::place_of(cell);
    darts.push_back(dart);
}

namespace {

/// Open sub-cells of some lines beside each other, in the four layers of a row of cells.
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
            std::memcpy(&covered_[z * pairs], lines, pairs * sizeof(SubcellBits));
        for (std::size_t i = 0; i < words_together; ++i) {
            before_[i] = count_;
            count_ = static_cast<std::uint16_t>(count_ + std::popcount(~covered_[i]));
        }
    }

    [[nodiscard]] std::size_t count() const { return count_; }

    /// Which one in the tile the n-th of them is, along each direction.
    [[nodiscard, gnu::always_inline]] std::array<std::size_t, 3> place(std::uint16_t n) const {
        std::size_t word = 0;  // the last one with so many parts before it
        for (std::size_t i = 1; i < words_together; ++i) word += before_[i] <= n ? 1 : 0;
        const std::size_t bit = nth_bit(~covered_[word], n - std::size_t{before_[word]});
        return {first_[0] + bit % 32, first_[1] + 2 * (word % pairs) + bit / 32,
                first_[2] + word / pairs};
    }

  private:
    std::array<std::size_t, 3> first_;
    std::array<SubcellBits, words_together> covered_;   ///< two lines in a word
    std::array<std::uint16_t, words_together> before_;  ///< open ones in the words before
    std::uint16_t count_ = 0;
};

/// Draws the darts on a unit.
[[gnu::always_inline]] inline void draw_on_unit(const OpenUnit& unit, const PoissonCounts& counts,
                                                std::uint64_t key,
                                                std::vector<SubcellDart>& drawn) {
    SplitMix64 mixer(key);
    for (std::uint64_t left = counts.draw(unit.count(), mixer); left > 0; --left) {
        const std::uint64_t which = mixer.next();
        const std::uint64_t where = mixer.next();
        const auto at = unit.place(static_cast<std::uint16_t>((which >> 32) * unit.count() >> 32));
        const auto digits = [&](std::size_t k) {
            return static_cast<std::int32_t>(at[k] % 4 << 21 | (where >> (21 * k) & 0x1fffff));
        };
        const SubcellDart::Digits all{digits(0), digits(1), digits(2), 0};
        const TileCell<3> cell{static_cast<int>(at[0] / 4), static_cast<int>(at[1] / 4),
                               static_cast<int>(at[2] / 4)};
        drawn.push_back(
            SubcellDart{all, which << 32 ^ where, SpaceTile::place_of(cell),
                        static_cast<std::uint8_t>(at[0] % 4 + at[1] % 4 * 4 + at[2] % 4 * 16)});
    }
}

}  // namespace

STIPPLE_WIDE void throw_at_subcells(const SpaceRules& rules, const SpaceTile& tile,
                                    const PoissonCounts& counts, std::uint64_t key,
                                    std::vector<SubcellDart>& drawn,
                                    std::vector<PendingDart<3>>& darts) {
    using Quad = SpaceRules::Quad;
    constexpr double grain = 0x1p-23;
    const Quad to_radii =
        Quad{rules.scales[0], rules.scales[1], rules.scales[2], 0} * static_cast<float>(grain);
    for (std::size_t column = 0; column < OpenUnit::columns; ++column) {
        // What a dart hits is hard to foresee; where the next ones fall does not wait for that.
        drawn.clear();
        for (std::size_t i = 0; i < OpenUnit::in_column; ++i)
            if (const OpenUnit unit(tile, column, i); unit.count() > 0)
                draw_on_unit(unit, counts, key + column * OpenUnit::in_column + i, drawn);
        for (const SubcellDart& t : drawn) {
            const TileCell<3> cell = SpaceTile::cell_at(t.place);
            const Hit hit =
                tile.hit(cell, t.subcell, __builtin_convertvector(t.digits, Quad) * to_radii);
            if (hit == Hit::yes) continue;
            insert(
                rules, tile, cell,
                {{t.digits[0] * grain, t.digits[1] * grain, t.digits[2] * grain}, grain, t.detail},
                hit, darts);
        }
    }
}

}  // namespace stipple::poisson_disk
