// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in the plane, for boxes of five cells
// or more along each direction.
//
// First darts are thrown at the sub-cells that no single disk covers; then at gaps, which are cut
// down to their open sub-cells round by round. The darts of a tile are sorted by time and tried one
// after the other: one that keeps its distance becomes a point at once. Only two kinds become
// pending: darts within two cells of the tile's edge, because an earlier dart of another tile may
// exclude them, and darts too near to a pending one.
//
// Cost    O(n) time; on one core 0.4 us a point. Memory: 75 bytes a point; more in boxes fewer
//         than 64 cells wide.

#include <bit>
#include <cmath>
#include <numbers>

#include "core/machine/large_pages.hpp"
#include "core/machine/wide.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "generators/poisson_disk/near_disks.hpp"
#include "generators/poisson_disk/plane/plane_tile.hpp"

namespace stipple::poisson_disk {

PlaneRules::PlaneRules(const Grid<2>& box_grid) : grid(box_grid), table(box_grid) {
    const double play = position_slack + grid.slack * units_per_radius;
    const double below = units_per_radius - play;
    const double above = units_per_radius + play;
    sure = static_cast<std::int32_t>(below * below);
    possible = static_cast<std::int32_t>(above * above) + 1;
}

namespace {

using Cell = TileCell<2>;
using Point = Grid<2>::Point;
using Counts = std::vector<PoissonCounts>;

/// A dart on a tile: its offset from the tile's first cell, in units of 2^-26 of a cell's sides.
struct Dart {
    std::uint32_t x;
    std::uint32_t y;
    std::uint32_t time;    ///< within its round
    std::uint32_t detail;  ///< for a dart on a gap: index of its position in `places`
};

/// Buffers for the work on a tile, one set per thread.
struct PlaneWorkspace : GapWorkspace<2> {
    std::vector<Dart> darts;
    std::vector<std::uint64_t> order;  ///< darts in order of time
    std::vector<Point> places;         ///< positions of darts on gaps, in cells, from the first one
    /// A bit for each cell, set if it has pending darts; row y of cells is word y + 2.
    std::array<std::uint64_t, plane_side + 4> waiting;
};

/// Sorts the indices of the darts by time; darts of equal times keep their order.
void sort_by_time(PlaneWorkspace& work) {
    const std::size_t n = work.darts.size();
    constexpr unsigned most = 10;
    const unsigned bits = std::min(most, static_cast<unsigned>(std::bit_width(n)));
    const auto bucket_of = [bits](std::uint32_t time) { return std::uint64_t{time} << bits >> 32; };
    std::array<std::uint32_t, (std::size_t{1} << most) + 1> buckets;
    std::fill_n(buckets.begin(), (std::size_t{1} << bits) + 1, 0);
    for (const Dart& d : work.darts) ++buckets[bucket_of(d.time) + 1];
    for (std::size_t i = 1; i < std::size_t{1} << bits; ++i) buckets[i] += buckets[i - 1];
    work.order.resize(n);
    std::uint64_t* const order = work.order.data();  // time << 32 | index
    const Dart* const darts = work.darts.data();
    for (std::size_t i = 0; i < n; ++i)
        order[buckets[bucket_of(darts[i].time)]++] = std::uint64_t{darts[i].time} << 32 | i;
    for (std::size_t i = 1; i < n; ++i) {
        const std::uint64_t one = order[i];
        if (order[i - 1] < one) continue;
        std::size_t to = i;
        for (; to > 0 && order[to - 1] > one; --to) order[to] = order[to - 1];
        order[to] = one;
    }
}

/// Tries the darts of one tile, one after the other.
class Thrower {
  public:
    Thrower(const PlaneRules& rules, PlaneTile& tile, PlaneWorkspace& work)
        : rules_(rules), tile_(tile), work_(work) {}

    [[gnu::always_inline]] void try_dart(const Dart& d) {
        const Cell cell{static_cast<int>(d.x >> 26), static_cast<int>(d.y >> 26)};
        const std::size_t number = PlaneTile::number_of(cell);
        const unsigned subcell = (d.y >> 23 & 7) * 8 + (d.x >> 23 & 7);
        if ((*tile_.covered(number) >> subcell & 1) != 0) return;
        const FixedPositions& positions = tile_.positions();
        const FixedPosition position = positions.position_of(d.x / cell_unit, d.y / cell_unit);
        const Hit hit = positions.hit(number - FixedPositions::number(2, 2), position, rules_.sure,
                                      rules_.possible);
        if (hit != Hit::yes) insert(d, cell, position, hit);
    }

  private:
    void insert(const Dart& d, const Cell& cell, FixedPosition position, Hit hit) {
        PendingDart<2> dart{{}, d.time, PlaneTile::place_of(cell)};
        if (!tile_.locate(rules_.grid, {0, 0}, place_of(d), dart.at)) return;
        if (hit == Hit::unsure && hits_point(tile_, rules_.grid, cell, dart.at)) return;
        if (!waits(cell, dart.at))
            return tile_.add(cell, position, dart.at, rules_.table.about({d.x << 6, d.y << 6}));
        work_.waiting[static_cast<std::size_t>(cell[1] + 2)] |= std::uint64_t{1} << cell[0];
        work_.pending.push_back(dart);
    }

    /// Position of a dart from the tile's first cell, in cells. A dart on a sub-cell stores only
    /// the first digits of its position; a hash of them gives further digits.
    [[nodiscard]] Point place_of(const Dart& d) const {
        if (!work_.places.empty()) return work_.places[d.detail];
        const std::uint64_t more = SplitMix64(std::uint64_t{d.x} << 32 | d.y).next();
        return {(d.x + static_cast<double>(more >> 32) * 0x1p-32) / cell_unit,
                (d.y + static_cast<double>(more & 0xffffffff) * 0x1p-32) / cell_unit};
    }

    /// Whether a dart at `at` may be excluded by a pending dart, or by one of another tile.
    [[nodiscard]] bool waits(const Cell& cell, const Point& at) const {
        const auto [column, row] = cell;
        if (column < 2 || row < 2) return true;
        if (column >= tile_.size(0) - 2 || row >= tile_.size(1) - 2) return true;
        std::uint64_t near = 0;
        for (int y = row; y < row + 5; ++y) near |= work_.waiting[static_cast<std::size_t>(y)];
        if ((near >> (column - 2) & 0x1f) == 0) return false;
        for (const PendingDart<2>& other : work_.pending) {
            const auto [x, y] = PlaneTile::cell_at(other.place);
            if (std::abs(x - column) <= 2 && std::abs(y - row) <= 2 &&
                rules_.grid.too_near(other.at, at))
                return true;
        }
        return false;
    }

    const PlaneRules& rules_;
    PlaneTile& tile_;
    PlaneWorkspace& work_;
};

STIPPLE_WIDE void try_in_order(const PlaneRules& rules, PlaneTile& tile, PlaneWorkspace& work) {
    Thrower thrower(rules, tile, work);
    for (const std::uint64_t one : work.order) thrower.try_dart(work.darts[one & 0xffffffff]);
}

/// Adds a random dart on one of the `count` open sub-cells of a cell.
[[gnu::always_inline]] inline void draw_in_cell(const Cell& cell, SubcellBits open,
                                                std::size_t count, SplitMix64& mixer,
                                                std::vector<Dart>& darts) {
    const std::uint64_t which = mixer.next();
    const std::uint64_t where = mixer.next();
    const std::size_t subcell = nth_bit(open, (which >> 32) * count >> 32);
    const auto x = static_cast<std::uint32_t>(cell[0] * 8) + subcell % 8;
    const auto y = static_cast<std::uint32_t>(cell[1] * 8) + subcell / 8;
    darts.push_back({static_cast<std::uint32_t>(x << 23 | where >> 41),
                     static_cast<std::uint32_t>(y << 23 | (where & 0x7fffff)),
                     static_cast<std::uint32_t>(which), 0});
}

/// Draws darts on the sub-cells that no single disk covers.
STIPPLE_WIDE void draw_on_subcells(const PlaneTile& tile, const PoissonCounts& counts,
                                   std::uint64_t key, std::vector<Dart>& darts) {
    for (int row = 0; row < tile.size(1); ++row) {
        const SubcellBits* covered = tile.covered(PlaneTile::number_of({0, row}));
        std::array<std::uint8_t, plane_side> found;  // columns of cells with open sub-cells
        std::size_t some = 0;
        for (int column = 0; column < tile.size(0); ++column) {
            found[some] = static_cast<std::uint8_t>(column);
            some += covered[column] != ~SubcellBits{0} ? 1 : 0;
        }
        for (std::size_t i = 0; i < some; ++i) {
            const Cell cell{found[i], row};
            const SubcellBits open = ~covered[found[i]];
            const auto count = static_cast<std::size_t>(std::popcount(open));
            SplitMix64 mixer(key + PlaneTile::place_of(cell));
            for (std::uint64_t left = counts.draw(count, mixer); left > 0; --left)
                draw_in_cell(cell, open, count, mixer, darts);
        }
    }
}

/// Collects the points whose disks may reach into a gap, relative to its lowest corner, in radii.
STIPPLE_WIDE void gather(const PlaneTile& tile, const Gap<2>& gap, NearDisks<2, float>& near) {
    const auto [column, row] = PlaneTile::cell_at(gap.place);
    const double half = gap.side() / 2;
    const FixedPositions& positions = tile.positions();
    const double x = column + gap.corner[0];
    const double y = row + gap.corner[1];
    const FixedPosition corner = positions.position_of(x, y);
    // Half the diagonal of a gap is at most `half` radii.
    const double reach = units_per_radius * (1 + half) + 2 * position_slack;
    near.clear();
    positions.for_near(
        PlaneTile::number_of({column - 2, row - 2}), positions.position_of(x + half, y + half),
        static_cast<std::int32_t>(reach * reach),
        [&](FixedPosition p) __attribute__((always_inline)) {
            constexpr auto unit = static_cast<float>(1 / units_per_radius);
            near.add({unit * static_cast<std::int16_t>(p.x - corner.x),
                      unit * static_cast<std::int16_t>(p.y - corner.y)});
        });
    near.close();
}

class PlaneSampler {
  public:
    PlaneSampler(const Task<2>& task, const RunContext& run)
        : grid_(task.grid), rules_(grid_), rounds_(task, run) {
        std::vector<std::size_t> before{0};
        for (std::size_t t = 0; t < grid_.tile_count; ++t) {
            const auto [first, last] = grid_.tile(t);
            before.push_back(before.back() + FixedPositions::needed(last[1] - first[1]));
        }
        positions_ = unwritten_room<FixedPosition>(before.back());
        covered_ = unwritten_room<SubcellBits>(before.back());
        indices_ = unwritten_room<std::uint16_t>(before.back());
        rounds_.make_tiles([&](std::uint32_t t) {
            return PlaneTile(rules_, t,
                             {positions_.get() + before[t], covered_.get() + before[t],
                              indices_.get() + before[t]});
        });
    }

    Rows sample() {
        constexpr double disk = std::numbers::pi;  // area for a radius of 1
        for (const double to_a_disk : {1.5, 1.5, 6.0, 20.0, 60.0, 200.0})
            throw_at_subcells(to_a_disk / disk);
        constexpr double growth = 4;
        rounds_.close_gaps(
            600 / disk, growth,
            [&](PlaneTile& tile, const Counts& counts, std::uint64_t key, PlaneWorkspace& work,
                bool first) { throw_at_gaps(tile, counts, key, work, first); });
        positions_.reset();
        covered_.reset();
        indices_.reset();
        return rounds_.collect();
    }

  private:
    using Rounds = TileRounds<PlaneTile, PlaneWorkspace>;

    /// Fixed positions are too coarse for gaps of this level and beyond.
    static constexpr std::uint8_t deep = 7;

    void throw_at_subcells(double density) {
        const PoissonCounts counts(Rounds::to_a_subcell(density), all_subcells<2>);
        rounds_.round([&](PlaneTile& tile, std::uint64_t key, PlaneWorkspace& work) {
            start(work);
            draw_on_subcells(tile, counts, key, work.darts);
            try_all(tile, work);
        });
    }

    static void start(PlaneWorkspace& work) {
        work.darts.clear();
        work.places.clear();
        work.waiting.fill(0);
    }

    void try_all(PlaneTile& tile, PlaneWorkspace& work) const {
        sort_by_time(work);
        try_in_order(rules_, tile, work);
    }

    void throw_at_gaps(PlaneTile& tile, const Counts& counts, std::uint64_t key,
                       PlaneWorkspace& work, bool first) const {
        start(work);
        if (first) make_gaps(tile);
        for (const Gap<2>& gap : tile.gaps) draw_on_gap(tile, gap, counts[gap.level], key, work);
        try_all(tile, work);
    }

    /// Makes the first gaps: squares around the sub-cells that no single disk covers.
    static void make_gaps(PlaneTile& tile) {
        for (int row = 0; row < tile.size(1); ++row) {
            const SubcellBits* covered = tile.covered(PlaneTile::number_of({0, row}));
            for (int column = 0; column < tile.size(0); ++column)
                if (covered[column] != ~SubcellBits{0})
                    narrow<2>({{}, PlaneTile::place_of({column, row}), 0}, ~covered[column], false,
                              tile.gaps);
        }
    }

    /// Draws darts on a gap's open sub-cells; adds gaps around these sub-cells to the workspace.
    void draw_on_gap(const PlaneTile& tile, const Gap<2>& gap, const PoissonCounts& counts,
                     std::uint64_t key, PlaneWorkspace& work) const {
        const Cell cell = PlaneTile::cell_at(gap.place);
        if (tile.taken(PlaneTile::number_of(cell)) || rounds_.too_small(gap)) return;
        const SubcellBits open = gap.level < deep ? roughly_open(tile, gap, work)
                                                  : rounds_.exactly_open(tile, gap, work);
        if (open == 0) return;
        SplitMix64 mixer = stream_of(key, gap);
        throw_at_gap(gap, open, counts, mixer, work.gaps, [&](Point place) {
            if (!(place[0] < 1 && place[1] < 1)) return;  // rounded up to a face
            for (std::size_t k = 0; k < 2; ++k) place[k] += cell[k];
            work.darts.push_back({static_cast<std::uint32_t>(place[0] * cell_unit),
                                  static_cast<std::uint32_t>(place[1] * cell_unit),
                                  static_cast<std::uint32_t>(mixer.next() >> 32),
                                  static_cast<std::uint32_t>(work.places.size())});
            work.places.push_back(place);
        });
    }

    /// Sub-cells of a gap that no single disk covers, to the accuracy of fixed positions.
    SubcellBits roughly_open(const PlaneTile& tile, const Gap<2>& gap, PlaneWorkspace& work) const {
        gather(tile, gap, work.near);
        SubcellGrid<2, float> from_corner(gap, grid_.scales);
        from_corner.corner = {0, 0};
        constexpr auto slack = static_cast<float>(4 * position_slack / units_per_radius);
        return uncovered<2, float>(work.near, from_corner, slack, work.reaching);
    }

    const Grid<2>& grid_;
    PlaneRules rules_;
    std::unique_ptr<FixedPosition[]> positions_;  ///< for the cells of all tiles, like the next two
    std::unique_ptr<SubcellBits[]> covered_;
    std::unique_ptr<std::uint16_t[]> indices_;
    Rounds rounds_;
};

}  // namespace

Rows plane_sample(const Task<2>& task, const RunContext& run) {
    return PlaneSampler(task, run).sample();
}

const double plane_tile_bytes =
    FixedPositions::needed(plane_side) *
    (sizeof(FixedPosition) + sizeof(SubcellBits) + sizeof(std::uint16_t));

}  // namespace stipple::poisson_disk
