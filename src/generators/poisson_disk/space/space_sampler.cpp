// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in space, for boxes of five cells or
// more along each direction.
//
// First darts are thrown at the sub-cells that no single ball covers (space/ball_lines.hpp). The
// open part of a sub-cell is mostly covered by several balls together, which shows when it is
// divided into 64 smaller ones. Sub-cells that stay open are gaps (space/ball_kernels.hpp), at
// which darts are thrown until no gap is left.
//
// Cost    O(n) time; on one core 2 us a point. Memory: 230 bytes a point.

#include <bit>
#include <cstring>

#include "core/machine/wide.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "generators/poisson_disk/space/space_tile.hpp"

namespace stipple::poisson_disk {
namespace {

using Cell = TileCell<3>;
using Point = Grid<3>::Point;
using Quad = SpaceRules::Quad;
using Counts = std::vector<PoissonCounts>;

/// A dart on a sub-cell, as drawn.
struct SubcellDart {
    using Digits [[gnu::vector_size(16)]] = std::int32_t;
    Digits digits;         ///< position in the cell, in 2^-23 of its sides
    std::uint64_t detail;  ///< seed of the dart's other random numbers
    std::uint16_t place;   ///< index of the cell in its tile
    std::uint8_t subcell;
};

/// Buffers for the work on a tile, one set per thread.
struct SpaceWorkspace : GapWorkspace<3> {
    std::vector<SubcellDart> drawn;  ///< darts on a layer of cells
    std::vector<Gap<3>> of_cell;
    std::vector<SubcellBits> open;  ///< open sub-cells of each gap
};

/// Number of sub-cells that share one Poisson draw for their darts: two lines of 32 in each of four
/// layers. If one sub-cell opens or closes, the darts of all change. The group is small so that
/// sets of similar radii stay nearly the same.
constexpr std::size_t together = 4 * 64;

/// Draws darts on those of `together` sub-cells that are open.
/// @param first indices of the first sub-cell in the tile, along each direction
[[gnu::always_inline]] inline void draw_on_lines(const SpaceTile& tile,
                                                 const std::array<std::size_t, 3>& first,
                                                 const PoissonCounts& counts, std::uint64_t key,
                                                 std::vector<SubcellDart>& drawn) {
    const std::uint32_t* lines = tile.lines() + BallLines::at(first[0] / 32, first[1], first[2]);
    std::array<SubcellBits, 4> open;
    std::array<std::size_t, 5> before{};
    for (std::size_t z = 0; z < 4; ++z, lines += BallLines::layer) {
        std::memcpy(&open[z], lines, sizeof open[z]);
        open[z] = ~open[z];
        before[z + 1] = before[z] + static_cast<std::size_t>(std::popcount(open[z]));
    }
    const std::size_t count = before.back();
    if (count == 0) return;
    SplitMix64 mixer(key + BallLines::at(first[0] / 32, first[1], first[2]));
    for (std::uint64_t left = counts.draw(count, mixer); left > 0; --left) {
        const std::uint64_t which = mixer.next();
        const std::uint64_t where = mixer.next();
        const std::size_t n = (which >> 32) * count >> 32;
        const std::size_t z =
            (n >= before[1] ? 1U : 0U) + (n >= before[2] ? 1U : 0U) + (n >= before[3] ? 1U : 0U);
        const std::size_t bit = nth_bit(open[z], n - before[z]);
        const std::array<std::size_t, 3> at{first[0] + bit % 32, first[1] + bit / 32, first[2] + z};
        const auto digits = [&](std::size_t k) {
            return static_cast<std::int32_t>(at[k] % 4 << 21 | (where >> (21 * k) & 0x1fffff));
        };
        const Cell cell{static_cast<int>(at[0] / 4), static_cast<int>(at[1] / 4),
                        static_cast<int>(at[2] / 4)};
        drawn.push_back({SubcellDart::Digits{digits(0), digits(1), digits(2), 0},
                         which << 32 ^ where, SpaceTile::place_of(cell),
                         static_cast<std::uint8_t>(at[0] % 4 + at[1] % 4 * 4 + at[2] % 4 * 16)});
    }
}

/// Makes a dart on a sub-cell pending, unless it hits a ball.
[[gnu::always_inline]] inline void try_dart(const SpaceRules& rules, const SpaceTile& tile,
                                            const SubcellDart& dart, Quad to_radii,
                                            std::vector<PendingDart<3>>& pending) {
    const Cell cell = SpaceTile::cell_at(dart.place);
    const Hit hit =
        tile.hit(cell, dart.subcell, __builtin_convertvector(dart.digits, Quad) * to_radii);
    if (hit == Hit::yes) return;
    SplitMix64 mixer(dart.detail);
    Point place;
    for (std::size_t k = 0; k < 3; ++k)
        place[k] = (dart.digits[k] + to_unit(mixer.next())) * SpaceRules::digit;
    add_pending(tile, rules.grid, cell, place, hit, mixer.next(), pending);
}

/// Throws darts at the sub-cells that no single ball covers.
STIPPLE_WIDE void throw_at_subcells(const SpaceRules& rules, const SpaceTile& tile,
                                    const PoissonCounts& counts, std::uint64_t key,
                                    SpaceWorkspace& work) {
    const Quad to_radii = Quad{rules.scales[0], rules.scales[1], rules.scales[2], 0} *
                          static_cast<float>(SpaceRules::digit);
    for (std::size_t column = 0; column < space_side * BallLines::words; ++column) {
        // Draws all darts of a layer before trying any: mispredicted branches would delay drawing.
        work.drawn.clear();
        for (std::size_t y = 0; y < BallLines::along; y += 2)
            draw_on_lines(tile, {column % BallLines::words * 32, y, column / BallLines::words * 4},
                          counts, key, work.drawn);
        for (const SubcellDart& dart : work.drawn)
            try_dart(rules, tile, dart, to_radii, work.pending);
    }
}

/// Index of the sub-cell that contains a point, given in cell sides from the cell's corner.
std::size_t subcell_at(const Point& place) {
    std::size_t subcell = 0;
    for (std::size_t k = 3; k-- > 0;)
        subcell = 4 * subcell + std::min(static_cast<std::size_t>(4 * place[k]), std::size_t{3});
    return subcell;
}

class SpaceSampler {
  public:
    SpaceSampler(const Task<3>& task, const RunContext& run)
        : grid_(task.grid), rules_(grid_), rounds_(task, run) {
        rounds_.make_tiles([&](std::uint32_t number) { return SpaceTile(rules_, number); });
    }

    Rows sample() {
        for (const double density : {0.25, 0.25, 0.5, 2.0, 6.0, 18.0, 54.0, 160.0}) {
            const PoissonCounts counts(Rounds::to_a_subcell(density), together);
            rounds_.round([&](SpaceTile& tile, std::uint64_t key, SpaceWorkspace& work) {
                throw_at_subcells(rules_, tile, counts, key, work);
            });
        }
        constexpr double growth = 6;
        rounds_.close_gaps(480, growth,
                           [&](SpaceTile& tile, const Counts& counts, std::uint64_t key,
                               SpaceWorkspace& work, bool first) {
                               if (first)
                                   throw_at_first_gaps(tile, counts, key, work);
                               else
                                   throw_at_gaps(tile, counts, key, work);
                           });
        return rounds_.collect();
    }

  private:
    using Rounds = TileRounds<SpaceTile, SpaceWorkspace>;

    /// Gaps of this level and beyond are checked again in doubles.
    static constexpr std::uint8_t deep = 11;

    /// Throws darts at the first gaps: the sub-cells that no single ball covers.
    void throw_at_first_gaps(const SpaceTile& tile, const Counts& counts, std::uint64_t key,
                             SpaceWorkspace& work) const {
        work.open.resize(all_subcells<3>);
        for (std::uint16_t place = 0; place < power(std::size_t{space_side}, 3); ++place) {
            const Cell cell = SpaceTile::cell_at(place);
            SubcellBits some = ~subcells_of(tile.lines(), cell);
            if (some == 0 || tile.taken(cell)) continue;
            tile.gather(cell, some, work.near);
            open_subcells(work.near, rules_.scales, some, work.open.data());
            SplitMix64 mixer(key + place);
            for (std::size_t i = 0; some != 0; some &= some - 1, ++i) {
                if (work.open[i] == 0) continue;
                const int number = std::countr_zero(some);
                const Point corner{(number & 3) * 0.25, (number >> 2 & 3) * 0.25,
                                   (number >> 4) * 0.25};
                throw_at({corner, place, 2}, tile, cell, work.open[i], counts, mixer, work);
            }
        }
    }

    void throw_at_gaps(const SpaceTile& tile, const Counts& counts, std::uint64_t key,
                       SpaceWorkspace& work) const {
        const auto& all = tile.gaps;
        for (std::size_t i = 0; i < all.size();) {
            const std::uint16_t place = all[i].place;
            const Cell cell = SpaceTile::cell_at(place);
            const SubcellBits covered = subcells_of(tile.lines(), cell);
            SubcellBits some = 0;
            work.of_cell.clear();
            for (; i < all.size() && all[i].place == place; ++i) {
                const SubcellBits its = SubcellBits{1} << subcell_at(all[i].corner);
                if ((covered & its) != 0) continue;
                some |= its;
                work.of_cell.push_back(all[i]);
            }
            if (some != 0 && !tile.taken(cell)) throw_at_cell(tile, cell, some, counts, key, work);
        }
    }

    /// Throws darts at open sub-cells of a cell's gaps; adds gaps around these sub-cells to `work`.
    void throw_at_cell(const SpaceTile& tile, const Cell& cell, SubcellBits some,
                       const Counts& counts, std::uint64_t key, SpaceWorkspace& work) const {
        tile.gather(cell, some, work.near);
        work.open.resize(work.of_cell.size());
        open_gaps(work.near, rules_.scales, work.of_cell, work.open.data());
        SplitMix64 mixer(key + work.of_cell[0].place);
        for (std::size_t i = 0; i < work.of_cell.size(); ++i) {
            const Gap<3>& gap = work.of_cell[i];
            SubcellBits open = work.open[i];
            if (open != 0 && gap.level >= deep) open = rounds_.exactly_open(tile, gap, work);
            if (open != 0 && !rounds_.too_small(gap))
                throw_at(gap, tile, cell, open, counts, mixer, work);
        }
    }

    void throw_at(const Gap<3>& gap, const SpaceTile& tile, const Cell& cell, SubcellBits open,
                  const Counts& counts, SplitMix64& mixer, SpaceWorkspace& work) const {
        throw_at_gap(gap, open, counts[gap.level], mixer, work.gaps, [&](const Point& place) {
            std::array<float, 3> off;
            for (std::size_t k = 0; k < 3; ++k)
                off[k] = static_cast<float>(place[k]) * rules_.scales[k];
            add_pending(tile, grid_, cell, place, hits<3, float>(work.near, off, rules_.slack),
                        mixer.next(), work.pending);
        });
    }

    const Grid<3>& grid_;
    SpaceRules rules_;
    Rounds rounds_;
};

}  // namespace

Rows space_sample(const Task<3>& task, const RunContext& run) {
    return SpaceSampler(task, run).sample();
}

const double space_tile_bytes = BallLines::room * sizeof(std::uint32_t) +
                                SpaceTile::halo_cells * sizeof(std::uint16_t) + sizeof(SpaceTile);

}  // namespace stipple::poisson_disk
