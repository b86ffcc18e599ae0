// SPDX-License-Identifier: MIT
#include "generators/space_showers.hpp"

#include <bit>

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
    d.place = SpaceTile::place_of(cell);
    darts.push_back(d);
}

void fall_at_large(const SpaceRules& rules, const SpaceTile& tile, const Shower& shower,
                   std::uint64_t key, bool any, std::vector<SpaceDart>& darts) {
    for (int row = 0; row < SpaceTile::side * tile.size(2); ++row) {
        if (row % SpaceTile::side >= tile.size(1)) continue;
        for (int x = 0; x < tile.size(0); x += cells_together) {
            const int count = std::min(cells_together, tile.size(0) - x);
            Mixer mixer(Mixer(key ^ static_cast<std::uint64_t>(row * SpaceTile::side + x)).next());
            for (std::uint64_t left = shower.on(static_cast<std::size_t>(count), mixer); left > 0;
                 --left) {
                std::array<double, 3> place;
                for (double& along : place) along = to_unit(mixer.next());
                place[0] *= count;
                const int step = static_cast<int>(place[0]);
                place[0] -= step;
                const SpaceCell cell{x + step, row % SpaceTile::side, row / SpaceTile::side};
                std::size_t part = 0;
                for (std::size_t k = 3; k-- > 0;)
                    part = part * 4 + static_cast<std::size_t>(place[k] * 4);
                if ((*tile.covered(cell) >> part & 1) != 0) continue;
                SpaceRules::Quad off{};
                for (std::size_t k = 0; k < 3; ++k)
                    off[k] = static_cast<float>(place[k] * rules.grid.scales[k]);
                const Hit hit = any ? tile.hit(cell, part, off) : Hit::no;
                land(rules, tile, cell, {place, 0, mixer.next()}, hit, darts);
            }
        }
    }
}

STIPPLE_WIDE void fall_on_parts(const SpaceRules& rules, const SpaceTile& tile,
                                const Shower& shower, std::uint64_t key,
                                std::vector<SpaceDart>& darts) {
    using Quad = SpaceRules::Quad;
    using Digits [[gnu::vector_size(16)]] = std::int32_t;
    constexpr int side = SpaceTile::side;
    constexpr double grain = 0x1p-23;
    const Quad to_radii =
        Quad{rules.scales[0], rules.scales[1], rules.scales[2], 0} * static_cast<float>(grain);
    for (int row = 0; row < side * side; ++row) {
        const SpaceCell first{0, row % side, row / side};
        if (first[1] >= tile.size(1) || first[2] >= tile.size(2)) continue;
        const PartBits* covered = tile.covered(first);
        std::array<std::uint16_t, side> before;  // parts in the cells before
        std::uint16_t count = 0;
        for (std::size_t x = 0; x < side; ++x) {
            before[x] = count;
            count = static_cast<std::uint16_t>(count + std::popcount(~covered[x]));
        }
        if (count == 0) continue;
        Mixer mixer(key + static_cast<std::uint64_t>(row));
        for (std::uint64_t left = shower.on(count, mixer); left > 0; --left) {
            const std::uint64_t which = mixer.next();
            const std::uint64_t where = mixer.next();
            const auto n = static_cast<std::uint16_t>((which >> 32) * count >> 32);
            std::size_t x = 0;  // the last cell with so many parts before it
            for (std::size_t i = 1; i < side; ++i) x += before[i] <= n ? 1 : 0;
            const std::size_t part = nth_bit(~covered[x], n - std::size_t{before[x]});
            const auto digits = [&](std::size_t k) {
                return static_cast<std::int32_t>((part >> (2 * k) & 3) << 21 |
                                                 (where >> (21 * k) & 0x1fffff));
            };
            const Digits all{digits(0), digits(1), digits(2), 0};
            const SpaceCell cell{static_cast<int>(x), first[1], first[2]};
            const Hit hit = tile.hit(cell, part, __builtin_convertvector(all, Quad) * to_radii);
            if (hit == Hit::yes) continue;
            const Throw dart{
                {all[0] * grain, all[1] * grain, all[2] * grain}, grain, which << 32 ^ where};
            land(rules, tile, cell, dart, hit, darts);
        }
    }
}

STIPPLE_WIDE void cover_all(const SpaceRules& rules, SpaceTile& tile,
                            std::vector<SpaceTile::Addition>& all) {
    constexpr std::size_t ahead = 3;
    for (std::size_t i = 0; i < all.size() + ahead; ++i) {
        if (i < all.size()) {
            all[i].stamp = rules.stamps.about(all[i].off);
            const char* bytes = reinterpret_cast<const char*>(all[i].stamp);
            for (std::size_t b = 0; b < BallStamps::words * sizeof(PartBits); b += 64)
                __builtin_prefetch(bytes + b);
        }
        if (i >= ahead) tile.cover(all[i - ahead]);
    }
}

}  // namespace stipple
