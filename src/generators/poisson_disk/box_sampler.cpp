// SPDX-License-Identifier: MIT
//
// maximal_disks (generators/poisson_disk/maximal_disks.hpp) in any dimension and any box, including
// boxes of fewer than five cells along a direction.
//
// Each tile stores all points whose disks overlap it, and visits all of them for each cell. Gaps
// are whole cells at first, and are cut down round by round (generators/poisson_disk/gaps.hpp).
//
// Shape   D = 2 ... 6.
// Cost    O(n) time; see maximal_disks.hpp. The samplers of plane and space are 2.6 and 4.6 times
//         as fast, which is why they exist.

#include <type_traits>

#include "core/machine/memory.hpp"
#include "generators/box_space.hpp"
#include "generators/poisson_disk/grid.hpp"
#include "generators/poisson_disk/near_disks.hpp"
#include "generators/poisson_disk/tile_rounds.hpp"
#include "math/geometry/ball_volume.hpp"

namespace stipple::poisson_disk {
namespace {

template <std::size_t D>
class BoxTile : public Tile<D, box_tile_bits<D>, 1> {
    using Base = Tile<D, box_tile_bits<D>, 1>;

  public:
    using typename Base::Cell;
    using typename Base::Point;

    BoxTile() = default;
    BoxTile(const Grid<D>& grid, std::size_t number) : Base(grid, number), grid_(&grid) {}

    void take(std::span<const Addition<D>> additions) {
        for (const Addition<D>& a : additions) {
            Near p{this->in_cell(*grid_, a.at, a.cell), a.at, a.cell};
            double squared = 0;  // squared distance from the tile, in radii
            for (std::size_t k = 0; k < D; ++k) {
                p.place[k] += a.cell[k];
                const double out = std::max({-p.place[k], p.place[k] - this->size(k), 0.0});
                squared += out * out * grid_->scales[k] * grid_->scales[k];
            }
            if (squared < reaching()) near_.push_back(p);
        }
    }

    void drop() {
        release(near_);
        this->pending = {};
    }

    /// Collects the points whose disks overlap a cell, relative to the cell's corner, in radii.
    template <class Real>
    void gather(const Cell& cell, NearDisks<D, Real>& near) const {
        near.clear();
        for (const Near& p : near_) {
            std::array<Real, D> off;
            double squared = 0;
            for (std::size_t k = 0; k < D; ++k) {
                const double x = (p.place[k] - cell[k]) * grid_->scales[k];
                const double out = std::max({-x, x - grid_->scales[k], 0.0});
                squared += out * out;
                off[k] = static_cast<Real>(x);
            }
            if (squared < reaching()) near.add(off);
        }
        near.close();
    }

    /// Calls visit(point, its cell) for all points until a call returns false.
    template <class Visit>
    void for_about(const Cell&, const Visit& visit) const {
        for (const Near& p : near_)
            if (!visit(p.at, p.cell)) return;
    }

  private:
    /// Squared radius with a margin for rounding.
    [[nodiscard]] double reaching() const { return 1 + std::max(1e-9, 3 * grid_->slack); }

    /// A point whose disk overlaps the tile.
    struct Near {
        Point place;  ///< offset from the tile's first cell, in cell sides
        Point at;
        Cell cell;
    };

    const Grid<D>* grid_ = nullptr;
    std::vector<Near> near_;
};

template <std::size_t D>
class BoxSampler {
    using T = BoxTile<D>;
    using Cell = typename T::Cell;
    using Point = typename T::Point;
    using Workspace = GapWorkspace<D>;
    using Counts = std::vector<PoissonCounts>;

  public:
    BoxSampler(const Task<D>& task, const RunContext& run) : grid_(task.grid), rounds_(task, run) {
        rounds_.make_tiles([&](std::uint32_t number) { return T(grid_, number); });
    }

    Rows sample() {
        constexpr double growth = D == 3 ? 6 : 4;
        rounds_.close_gaps(
            1.25 / unit_ball_volume(D), growth,
            [&](T& tile, const Counts& counts, std::uint64_t key, Workspace& work, bool first) {
                if (first) make_gaps(tile);
                throw_at_gaps(tile, counts, key, work);
            });
        return rounds_.collect();
    }

  private:
    /// Floats are too coarse for gaps of this level and beyond.
    static constexpr std::uint8_t deep = 7;

    /// Makes every cell a gap.
    static void make_gaps(T& tile) {
        Cell cell{};
        while (true) {
            tile.gaps.push_back({{}, T::place_of(cell), 0});
            std::size_t k = 0;
            for (; k < D && ++cell[k] == tile.size(k); ++k) cell[k] = 0;
            if (k == D) return;
        }
    }

    void throw_at_gaps(T& tile, const Counts& counts, std::uint64_t key, Workspace& work) const {
        const auto& gaps = tile.gaps;
        for (std::size_t i = 0; i < gaps.size();) {
            const std::uint16_t place = gaps[i].place;
            const std::size_t first = i;
            bool small = false;
            for (; i < gaps.size() && gaps[i].place == place; ++i)
                small = small || gaps[i].level >= deep;
            tile.gather(T::cell_at(place), work.near);
            if (small) tile.gather(T::cell_at(place), work.exactly_near);
            for (std::size_t g = first; g < i; ++g) {
                const PoissonCounts& count = counts[gaps[g].level];
                if (gaps[g].level < deep)
                    throw_at<float>(tile, gaps[g], count, key, work, work.near, work.reaching);
                else
                    throw_at<double>(tile, gaps[g], count, key, work, work.exactly_near,
                                     work.exactly_reaching);
            }
        }
    }

    /// Throws darts at a gap's open sub-cells; adds gaps around these sub-cells to the workspace.
    template <class Real>
    void throw_at(const T& tile, const Gap<D>& gap, const PoissonCounts& counts, std::uint64_t key,
                  Workspace& work, const NearDisks<D, Real>& near,
                  NearDisks<D, Real>& reaching) const {
        if (rounds_.too_small(gap)) return;
        const Real slack = std::is_same_v<Real, float> ? Real{float_slack_beside(grid_.slack)}
                                                       : static_cast<Real>(grid_.slack);
        const SubcellBits open =
            uncovered<D, Real>(near, SubcellGrid<D, Real>(gap, grid_.scales), slack, reaching);
        if (open == 0) return;
        SplitMix64 mixer = stream_of(key, gap);
        throw_at_gap(gap, open, counts, mixer, work.gaps, [&](const Point& place) {
            std::array<Real, D> off;
            for (std::size_t k = 0; k < D; ++k)
                off[k] = static_cast<Real>(place[k] * grid_.scales[k]);
            add_pending(tile, grid_, T::cell_at(gap.place), place,
                        hits<D, Real>(reaching, off, slack), mixer.next(), work.pending);
        });
    }

    const Grid<D>& grid_;
    TileRounds<T, Workspace> rounds_;
};

}  // namespace

template <std::size_t D>
Rows box_sample(const Task<D>& task, const RunContext& run) {
    return BoxSampler<D>(task, run).sample();
}

template Rows box_sample(const Task<2>&, const RunContext&);
template Rows box_sample(const Task<3>&, const RunContext&);
template Rows box_sample(const Task<4>&, const RunContext&);
template Rows box_sample(const Task<5>&, const RunContext&);
template Rows box_sample(const Task<6>&, const RunContext&);

}  // namespace stipple::poisson_disk
