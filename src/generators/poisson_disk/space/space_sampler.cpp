// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space/space_sampler.hpp"

#include <bit>
#include <cmath>

#include "core/large_pages.hpp"
#include "generators/poisson_disk/space/space_tile.hpp"
#include "generators/poisson_disk/space/subcell_darts.hpp"

namespace stipple::poisson_disk {
namespace {

using Cell = TileCell<3>;
using Point = Grid<3>::Point;
using Counts = std::vector<PoissonCounts>;

/// What one thread needs to work on a tile.
struct SpaceWorkspace {
    std::vector<PendingDart<3>> pending;
    NearBalls near;
    std::vector<SubcellDart> subcell_darts;
    std::vector<DrawnDart> drawn;              ///< on a cell
    std::vector<std::array<float, 3>> places;  ///< the same, in radii
    std::vector<Hit> hits;
    std::vector<CubeGap> of_cell;
    std::vector<SubcellBits> open;
    std::vector<CubeGap> cubes;
    std::vector<Gap<3>> gaps;
    NearDisks<3, double> exactly_near;
    NearDisks<3, double> exactly_reaching;
};

class SpaceSampler {
  public:
    SpaceSampler(const Task<3>& task, const RunContext& run)
        : grid_(task.grid), rules_(grid_), slack_(task.slack), rounds_(task, run) {
        lines_ = unwritten_room<std::uint32_t>(BallLines::room * grid_.tile_count);
        numbers_ = unwritten_room<std::uint16_t>(SpaceTile::halo_cells * grid_.tile_count);
        rounds_.make_tiles([&](std::uint32_t t) {
            return SpaceTile(rules_, t, lines_.get() + BallLines::room * t,
                             numbers_.get() + SpaceTile::halo_cells * t);
        });
    }

    Rows sample() {
        for (const double density : {1.25, 1.25, 8.0, 24.0, 72.0, 216.0, 648.0})
            throw_at_subcells(density);
        // Gaps are split once a dart or so was thrown at each, into eight, so that more would be in
        // vain.
        constexpr double growth = 6;
        rounds_.close_gaps(1944, growth,
                           [&](SpaceTile& tile, const Counts& counts, std::uint64_t key,
                               SpaceWorkspace& work, bool first) {
                               work.gaps.clear();
                               work.cubes.clear();
                               if (first)
                                   throw_at_open_subcells(tile, counts, key, work);
                               else
                                   throw_at_cubes(tile, counts, key, work);
                               throw_at_gaps(tile, counts, key, work);
                               tile.cubes = std::vector(work.cubes.begin(), work.cubes.end());
                               tile.gaps = std::vector(work.gaps.begin(), work.gaps.end());
                           });
        lines_.reset();
        numbers_.reset();
        return rounds_.collect();
    }

  private:
    using Rounds = TileRounds<SpaceTile, SpaceWorkspace>;

    /// Gaps of this level and beyond are too small for floats.
    static constexpr std::uint8_t deep = 11;

    void throw_at_subcells(double density) {
        const PoissonCounts counts(Rounds::to_a_subcell(density), words_together * 64);
        rounds_.round([&](SpaceTile& tile, std::uint64_t key, SpaceWorkspace& work) {
            poisson_disk::throw_at_subcells(rules_, tile, counts, key, work.subcell_darts,
                                            work.pending);
        });
    }

    static void start_cell(SpaceWorkspace& work) {
        work.drawn.clear();
        work.places.clear();
    }

    /// Draws a dart on one of the open sub-cells of a gap.
    void draw(const Point& corner, double side, SubcellBits open, std::size_t count,
              SplitMix64& mixer, SpaceWorkspace& work) const {
        const std::uint64_t which = mixer.next();
        const std::uint64_t where = mixer.next();
        const std::size_t subcell = nth_bit(open, (which >> 32) * count >> 32);
        DrawnDart dart{{}, side * 0x1p-21, which << 32 ^ where};
        std::array<float, 3> place;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t digits =
                (subcell >> (2 * k) & 3) << 21 | (where >> (21 * k) & 0x1fffff);
            dart.place[k] = corner[k] + static_cast<double>(digits) * dart.grain;
            place[k] = static_cast<float>(dart.place[k]) * rules_.scales[k];
        }
        work.drawn.push_back(dart);
        work.places.push_back(place);
    }

    /// Makes the darts on a cell pending that hit no ball.
    void insert_all(const SpaceTile& tile, const Cell& cell, SpaceWorkspace& work) const {
        work.hits.resize(work.places.size());
        find_hits(work.near, work.places, work.hits.data());
        for (std::size_t i = 0; i < work.hits.size(); ++i)
            insert(rules_, tile, cell, work.drawn[i], work.hits[i], work.pending);
    }

    /// The first gaps are the sub-cells that no ball covers alone.
    void throw_at_open_subcells(const SpaceTile& tile, const Counts& counts, std::uint64_t key,
                                SpaceWorkspace& work) const {
        std::array<SubcellBits, 8> eight;
        for (std::uint16_t place = 0; place < power(std::size_t{space_side}, 3); ++place) {
            const Cell cell = SpaceTile::cell_at(place);
            if (place % 8 == 0) eight = subcells_of_eight(tile.lines(), cell);
            const SubcellBits open = ~eight[place % 8U];
            if (open == 0) continue;
            tile.gather(cell, open, work.near);
            std::array<OpenSubcell, 65> found;
            const std::size_t count = open_subcells(work.near, rules_.scales, open, found.data());
            start_cell(work);
            SplitMix64 mixer(key + place);
            for (std::size_t i = 0; i < count; ++i) {
                const unsigned number = found[i].number;
                const CubeGap gap{{static_cast<std::uint16_t>((number & 3) << 14),
                                   static_cast<std::uint16_t>((number >> 2 & 3) << 14),
                                   static_cast<std::uint16_t>(number >> 4 << 14)},
                                  place,
                                  2};
                throw_at_cube(gap, found[i].open, counts, mixer, work);
            }
            if (!work.places.empty()) insert_all(tile, cell, work);
        }
    }

    void throw_at_cubes(const SpaceTile& tile, const Counts& counts, std::uint64_t key,
                        SpaceWorkspace& work) const {
        const auto& all = tile.cubes;
        for (std::size_t i = 0; i < all.size();) {
            const std::uint16_t place = all[i].place;
            const Cell cell = SpaceTile::cell_at(place);
            const SubcellBits covered = subcells_of(tile.lines(), cell);
            SubcellBits some = 0;
            work.of_cell.clear();
            for (; i < all.size() && all[i].place == place; ++i) {
                const auto& c = all[i].corner;
                const SubcellBits its = SubcellBits{1}
                                        << (c[0] >> 14 | c[1] >> 14 << 2 | c[2] >> 14 << 4);
                if ((covered & its) != 0) continue;
                some |= its;
                work.of_cell.push_back(all[i]);
            }
            if (some != 0 && !tile.taken(cell)) throw_at_cell(tile, cell, some, counts, key, work);
        }
    }

    /// Darts on what is open of gaps of a cell; what is left of them goes to the workspace.
    void throw_at_cell(const SpaceTile& tile, const Cell& cell, SubcellBits some,
                       const Counts& counts, std::uint64_t key, SpaceWorkspace& work) const {
        tile.gather(cell, some, work.near);
        work.open.resize(work.of_cell.size());
        open_gaps(work.near, rules_.scales, work.of_cell, work.open.data());
        start_cell(work);
        SplitMix64 mixer(key + work.of_cell[0].place);
        for (std::size_t i = 0; i < work.of_cell.size(); ++i)
            if (work.open[i] != 0)
                throw_at_cube(work.of_cell[i], work.open[i], counts, mixer, work);
        if (!work.places.empty()) insert_all(tile, cell, work);
    }

    void throw_at_cube(const CubeGap& gap, SubcellBits open, const Counts& counts,
                       SplitMix64& mixer, SpaceWorkspace& work) const {
        constexpr double enough = 1;  // darts after which a gap is better split
        const auto count = static_cast<std::size_t>(std::popcount(open));
        const PoissonCounts& of_level = counts[gap.level];
        const double side = gap.subcell_side() * 0x1p-16;
        for (std::uint64_t left = of_level.draw(count, mixer); left > 0; --left)
            draw(corner_of(gap), side, open, count, mixer, work);
        narrow(gap, open, of_level.mean(count) >= enough, work.cubes);
        while (!work.cubes.empty() && work.cubes.back().level >= deep) {
            const CubeGap& small = work.cubes.back();
            work.gaps.push_back({corner_of(small), small.place, small.level});
            work.cubes.pop_back();
        }
    }

    /// In cells.
    static Point corner_of(const CubeGap& gap) {
        return {gap.corner[0] * 0x1p-16, gap.corner[1] * 0x1p-16, gap.corner[2] * 0x1p-16};
    }

    /// The same for gaps that are small.
    void throw_at_gaps(const SpaceTile& tile, const Counts& counts, std::uint64_t key,
                       SpaceWorkspace& work) const {
        const auto& all = tile.gaps;
        for (std::size_t i = 0; i < all.size();) {
            const std::uint16_t place = all[i].place;
            const Cell cell = SpaceTile::cell_at(place);
            const bool taken = tile.taken(cell);
            if (!taken) gather_exactly(tile, cell, work.exactly_near);
            for (; i < all.size() && all[i].place == place; ++i)
                if (!taken) throw_at_gap(tile, cell, all[i], counts[all[i].level], key, work);
        }
    }

    void throw_at_gap(const SpaceTile& tile, const Cell& cell, const Gap<3>& gap,
                      const PoissonCounts& counts, std::uint64_t key, SpaceWorkspace& work) const {
        constexpr double enough = 2;
        if (rounds_.too_small(gap)) return;
        const SubcellBits open = uncovered<3, double>(work.exactly_near, {gap, grid_.scales},
                                                      slack_, work.exactly_reaching);
        if (open == 0) return;
        const auto count = static_cast<std::size_t>(std::popcount(open));
        SplitMix64 mixer = stream_of(key, gap);
        for (std::uint64_t left = counts.draw(count, mixer); left > 0; --left) {
            const Point place = place_in(gap, open, count, mixer);
            Point off;
            for (std::size_t k = 0; k < 3; ++k) off[k] = place[k] * grid_.scales[k];
            const Hit hit = hits<3, double>(work.exactly_reaching, off, slack_);
            insert(rules_, tile, cell, {place, 0, mixer.next()}, hit, work.pending);
        }
        narrow(gap, open, counts.mean(count) >= enough, work.gaps);
    }

    /// Points about a cell, from its corner.
    void gather_exactly(const SpaceTile& tile, const Cell& cell, NearDisks<3, double>& near) const {
        near.clear();
        tile.for_about(cell, [&](const Point& p, const Cell& steps) {
            Point off;
            for (std::size_t k = 0; k < 3; ++k) {
                const double own = static_cast<double>(tile.first()[k]) + cell[k];
                double along = (p[k] - grid_.low[k]) / grid_.widths[k] - own;
                if (std::abs(along - steps[k]) > 2)  // around the torus
                    along +=
                        along < steps[k] ? grid_.cells[k] : -static_cast<double>(grid_.cells[k]);
                off[k] = along * grid_.scales[k];
            }
            near.add(off);
            return true;
        });
        near.close();
    }

    const Grid<3>& grid_;
    SpaceRules rules_;
    double slack_;
    std::unique_ptr<std::uint32_t[]> lines_;  ///< of all tiles, as the next
    std::unique_ptr<std::uint16_t[]> numbers_;
    Rounds rounds_;
};

}  // namespace

Rows space_sample(const Task<3>& task, const RunContext& run) {
    return SpaceSampler(task, run).sample();
}

double space_tile_memory(double tiles) {
    return static_cast<double>(SpaceTile::bytes + sizeof(SpaceTile)) * tiles;
}

}  // namespace stipple::poisson_disk
