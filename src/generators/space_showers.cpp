// SPDX-License-Identifier: MIT
#include "generators/space_showers.hpp"

#include <bit>
#include <cstring>

#include "core/rng.hpp"
#include "core/wide.hpp"
#include "math/mixer.hpp"

namespace stipple {

void land(const SpaceRules& rules, const SpaceTile& tile, const SpaceCell& cell, const Throw& dart,
          Hit hit, std::vector<SpaceDart>& darts) {
    if (hit == Hit::yes) return;
    SpaceDart d{};
    Mixer mixer(dart.detail);
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
            Mixer mixer(Mixer(key ^ static_cast<std::uint64_t>(row * space_side + x)).next());
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
    static constexpr std::size_t units =
        BallLines::along * BallLines::along * BallLines::words / (2 * words_together);

    [[gnu::always_inline]] OpenUnit(const SpaceTile& tile, std::size_t unit) {
        const std::size_t column = unit * 2 * pairs / BallLines::along;
        const std::size_t word = column % BallLines::words;
        first_ = {32 * word, unit * 2 * pairs % BallLines::along, column / BallLines::words * 4};
        const std::uint32_t* lines = tile.lines() + BallLines::at(word, first_[1], first_[2]);
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
    static constexpr std::size_t pairs = words_together / 4;  // of lines, in a layer

    std::array<std::size_t, 3> first_;
    std::array<PartBits, words_together> covered_;      ///< two lines in a word
    std::array<std::uint16_t, words_together> before_;  ///< open ones in the words before
    std::uint16_t count_ = 0;
};

}  // namespace

STIPPLE_WIDE void fall_on_parts(const SpaceRules& rules, const SpaceTile& tile,
                                const Shower& shower, std::uint64_t key,
                                std::vector<SpaceDart>& darts) {
    using Quad = SpaceRules::Quad;
    using Digits [[gnu::vector_size(16)]] = std::int32_t;
    constexpr double grain = 0x1p-23;
    const Quad to_radii =
        Quad{rules.scales[0], rules.scales[1], rules.scales[2], 0} * static_cast<float>(grain);
    for (std::size_t u = 0; u < OpenUnit::units; ++u) {
        const OpenUnit unit(tile, u);
        if (unit.count() == 0) continue;
        Mixer mixer(key + u);
        for (std::uint64_t left = shower.on(unit.count(), mixer); left > 0; --left) {
            const std::uint64_t which = mixer.next();
            const std::uint64_t where = mixer.next();
            const auto at =
                unit.place(static_cast<std::uint16_t>((which >> 32) * unit.count() >> 32));
            const std::size_t part = at[0] % 4 + at[1] % 4 * 4 + at[2] % 4 * 16;
            const auto digits = [&](std::size_t k) {
                return static_cast<std::int32_t>(at[k] % 4 << 21 | (where >> (21 * k) & 0x1fffff));
            };
            const Digits all{digits(0), digits(1), digits(2), 0};
            const SpaceCell cell{static_cast<int>(at[0] / 4), static_cast<int>(at[1] / 4),
                                 static_cast<int>(at[2] / 4)};
            const Hit hit = tile.hit(cell, part, __builtin_convertvector(all, Quad) * to_radii);
            if (hit == Hit::yes) continue;
            const Throw dart{
                {all[0] * grain, all[1] * grain, all[2] * grain}, grain, which << 32 ^ where};
            land(rules, tile, cell, dart, hit, darts);
        }
    }
}

}  // namespace stipple
