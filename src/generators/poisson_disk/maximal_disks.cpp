// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/maximal_disks.hpp"

#include <cmath>
#include <type_traits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/poisson_disk/disk_shower.hpp"
#include "generators/poisson_disk/disk_spots.hpp"
#include "generators/poisson_disk/disk_tiles.hpp"
#include "generators/poisson_disk/open_tiles.hpp"
#include "generators/poisson_disk/plane_disks.hpp"
#include "generators/poisson_disk/space_disks.hpp"
#include "generators/poisson_disk/space_tiles.hpp"
#include "math/functions/splitmix64.hpp"

namespace stipple {
namespace {

/// Volume of the ball of radius 1.
constexpr double unit_ball[] = {1,
                                2,
                                3.141592653589793,
                                4.188790204786391,
                                4.934802200544679,
                                5.263789013914325,
                                5.167712780049970};

/// Points to r^d in a large box, when no place is left: the densities of random sequential addition
/// (S. Torquato, O. U. Uche, F. H. Stillinger, Phys. Rev. E 74 (2006) 061308,
/// doi:10.1103/PhysRevE.74.061308), rounded up.
constexpr double jammed[] = {0, 0.75, 0.70, 0.74, 0.85, 1.05, 1.40};

/// How near to a rim arithmetic on coordinates can go wrong, in radii.
double double_slack(const BoxSpace& space, double radius) {
    return 0x1p-49 * (space.largest_coordinate() / radius + 8);
}

template <std::size_t D>
class Rain {
  public:
    using Grid = DiskGrid<D>;
    using Point = typename Grid::Point;
    using Index = typename Grid::Index;
    using Tile = DiskTile<D>;
    using Tiles = std::conditional_t<D <= 3, CellTiles<D>, FewTiles<D>>;

    Rain(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
         const RunContext& run)
        : grid_(space, radius, cell_radius),
          tiles_(grid_),
          keys_(seed),
          open_(grid_.tile_count, static_cast<std::uint64_t>(expected_disks(space, radius)),
                worth_threads(run, expected_disks(space, radius) * seconds_a_point)),
          slack_(double_slack(space, radius)) {
        if (D > 3) return;  // of the few points there, tiles have no typical number
        for (Tile& tile : tiles_.all()) tile.points.reserve(typical_points(tile) * D);
    }

    Rows fill() {
        rain_at_large();
        rain_on_the_open();
        return collect();
    }

  private:
    /// About, on one core; far more for D > 3.
    static constexpr double seconds_a_point = D == 2 ? 1e-6 : 1e-5;

    /// Windows of this level and beyond are too small for floats.
    static constexpr std::uint8_t deep = 7;

    static constexpr std::size_t all_parts = lines<D> * parts<D>;  ///< of a window

    /// Darts to a cell, when one falls on a ball of the radius.
    static double one_to_a_ball() {
        return 1 / (unit_ball[D] * std::sqrt(static_cast<double>(power(D, D))));
    }

    /// A little more points than a tile mostly has.
    [[nodiscard]] std::size_t typical_points(const Tile& tile) const {
        double places = jammed[D];
        for (std::size_t k = 0; k < D; ++k)
            places *= (tile.last[k] - tile.first[k]) * grid_.scales[k];
        return static_cast<std::size_t>(places + std::sqrt(places) / 2 + 1);
    }

    /// The first showers fall everywhere: most of their darts still find a place.
    void rain_at_large() {
        constexpr double enough = D == 2 ? 4 : D == 3 ? 2 : 8;  // darts to a ball
        double fallen = 0;
        while (fallen < enough) {
            const double density = std::max(1.25, fallen / 2);
            const Shower shower(density * one_to_a_ball(), together);
            const std::uint64_t key = keys_.bits(showers_++);
            rain(key, [&](Tile& tile, std::uint64_t own, Desk<D>& desk) {
                fall_at_large(tile, shower, own, desk, fallen > 0);
            });
            fallen += density;
        }
    }

    /// What is open after a time t is of size 1/t, so that showers grow like powers: first those on
    /// the parts of cells that no disk covers alone, where these are known, then those on windows.
    void rain_on_the_open() {
        double density = (Tiles::knows_parts ? 8 : 32) * one_to_a_ball();
        if constexpr (Tiles::knows_parts)
            for (int time = 0; time < 4; ++time, density *= 3) rain_on_parts(density);
        constexpr double growth = D == 3 ? 6 : 4;
        for (bool first = true; !open_.empty(); first = false, density *= growth)
            rain_on_windows(density, first);
    }

    /// @param density of darts, to a cell
    void rain_on_parts(double density) {
        const Shower shower(density / parts_of_cell, parts_of_cell);
        rain(keys_.bits(showers_++), [&](Tile& tile, std::uint64_t own, Desk<D>& desk) {
            fall_on_parts(tile, shower, own, desk);
        });
    }

    void rain_on_windows(double density, bool first) {
        std::vector<Shower> showers;  // for windows of each level
        double mean = density / static_cast<double>(all_parts);
        for (std::size_t level = 0; level < levels; ++level) {
            showers.emplace_back(mean, all_parts);
            mean /= static_cast<double>(std::size_t{1} << D);
        }
        rain(keys_.bits(showers_++), [&](Tile& tile, std::uint64_t own, Desk<D>& desk) {
            desk.windows.clear();
            if (first)
                fall_on_cells(tile, showers, own, desk);
            else
                fall_on_windows(tile, showers, own, desk);
            tile.windows = std::vector(desk.windows.begin(), desk.windows.end());
        });
        open_.close(tiles_.all(), [](Tile& tile) {
            if (tile.windows.empty()) tile.candidates = {};
            return tile.windows.empty();
        });
    }

    /// One shower: fall(tile, key, desk) makes a tile's candidates, of which some become points.
    template <class Fall>
    void rain(std::uint64_t key, const Fall& fall) {
        tiles_.start_over();
        open_.for_each(tiles_.all(), [&](Tile& tile, std::uint32_t number) {
            thread_local Desk<D> desk;
            tiles_.prepare(tile, desk);
            tile.candidates.swap(desk.candidates);  // has room
            tiles_.start_over(tile);
            fall(tile, SplitMix64(key + number).next(), desk);
            tile.candidates.swap(desk.candidates);
            tile.candidates = std::vector(desk.candidates.begin(), desk.candidates.end());
            tile.fates.assign(tile.candidates.size(), {});
        });
        open_.for_each(tiles_.all(), [&](Tile& tile, std::uint32_t) {
            for (std::size_t i = 0; i < tile.candidates.size(); ++i) decide(tile, i);
        });
        open_.for_each(tiles_.all(),
                       [&](Tile& tile, std::uint32_t) { tiles_.settle(tile, shared_); });
        open_.tick(tiles_.all(), &Tile::points, D);
    }

    /// Numbers that belong to a piece of a cell, whoever asks for them.
    static SplitMix64 stream(std::uint64_t key, std::uint64_t place, const Point& corner,
                             std::uint64_t level) {
        std::uint64_t state = SplitMix64(key ^ (place << 8 | level)).next();
        for (const double x : corner)
            state = SplitMix64(state ^ std::bit_cast<std::uint64_t>(x)).next();
        return SplitMix64(state);
    }

    /// Calls visit(cell, count) for runs of up to `most` cells along the first direction.
    template <class Visit>
    static void for_runs(const Tile& tile, std::uint32_t most, const Visit& visit) {
        Index cell = tile.first;
        while (true) {
            for (cell[0] = tile.first[0]; cell[0] < tile.last[0]; cell[0] += most)
                visit(cell, std::min(most, tile.last[0] - cell[0]));
            std::size_t k = 1;
            for (; k < D && ++cell[k] == tile.last[k]; ++k) cell[k] = tile.first[k];
            if (k == D) return;
        }
    }

    static constexpr std::uint32_t together = 8;  ///< cells that share a Poisson number

    void fall_at_large(Tile& tile, const Shower& shower, std::uint64_t key, Desk<D>& desk,
                       bool any_points) {
        desk.near.clear();
        desk.near.close();
        for_runs(tile, together, [&](const Index& run, std::uint32_t count) {
            SplitMix64 mixer = stream(key, Grid::place_of(run), {}, 0);
            for (std::uint64_t left = shower.on(count, mixer); left > 0; --left) {
                Index cell = run;
                Point place;
                for (double& x : place) x = to_unit(mixer.next());
                place[0] *= count;
                const auto step = static_cast<std::uint32_t>(place[0]);
                place[0] -= step;
                cell[0] += step;
                if constexpr (Tiles::knows_parts) {
                    if (tiles_.covers(cell, place)) continue;
                }
                if (any_points) tiles_.gather(tile, cell, desk, desk.near);
                fall<float>(tile, cell, place, desk.near, mixer);
            }
        });
    }

    /// A dart falls at `place` of a cell (in cells), where these points are near.
    template <class Real>
    void fall(Tile& tile, const Index& cell, const Point& place, const NearDisks<D, Real>& near,
              SplitMix64& mixer) {
        std::array<Real, D> off;
        for (std::size_t k = 0; k < D; ++k) off[k] = static_cast<Real>(place[k] * grid_.scales[k]);
        land(tile, cell, place, hits<D, Real>(near, off, slack<Real>()), mixer);
    }

    /// Makes a dart a candidate, unless it hit.
    void land(Tile& tile, const Index& cell, const Point& place, Hit hit, SplitMix64& mixer) {
        if (hit == Hit::yes) return;
        Candidate<D> c{};
        for (std::size_t k = 0; k < D; ++k) {
            c.at[k] = grid_.low[k] + (cell[k] + place[k]) * grid_.widths[k];
            c.off[k] = static_cast<float>(place[k] * grid_.scales[k]);
            if (!(c.at[k] < grid_.high[k])) return;  // rounded up to a face
        }
        if (hit == Hit::unsure && (tiles_.taken(cell) || tiles_.hits(tile, cell, c.at.data())))
            return;
        c.time = static_cast<std::uint32_t>(mixer.next() >> 32);
        c.place = Grid::place_of(cell);
        tiles_.add(tile, cell, c);
    }

    /// Darts fall on the parts of cells that no point covers alone.
    void fall_on_parts(Tile& tile, const Shower& shower, std::uint64_t key, Desk<D>& desk) {
        for_open_cells(tile, [&](const Index& cell, PartBits open) {
            const std::size_t count = ones_of(open);
            SplitMix64 mixer(SplitMix64(key ^ Grid::place_of(cell)).next());
            bool gathered = false;
            for (std::uint64_t left = shower.on(count, mixer); left > 0; --left) {
                Point place = nth_part<D>(open, mixer.below(count));
                for (double& x : place) x += to_unit(mixer.next()) / double{cell_parts<D>};
                if (!gathered) tiles_.gather(tile, cell, desk, desk.near);
                gathered = true;
                fall<float>(tile, cell, place, desk.near, mixer);
            }
        });
    }

    /// Calls visit(cell, open) for cells with parts that no point covers alone.
    template <class Visit>
    void for_open_cells(const Tile& tile, const Visit& visit) const {
        for_runs(tile, Grid::tile_side, [&](const Index& row, std::uint32_t length) {
            const PartBits* covered = tiles_.covered(row);
            for (Index cell = row; cell[0] < row[0] + length; ++cell[0], ++covered)
                if (const PartBits open = ~*covered; open != 0) visit(cell, open);
        });
    }

    /// The first windows: about what is open of cells as far as that is known, or the cells.
    void fall_on_cells(Tile& tile, const std::vector<Shower>& showers, std::uint64_t key,
                       Desk<D>& desk) {
        const auto fall_in = [&](const Index& cell, const Window<D>& window) {
            tiles_.gather(tile, cell, desk, desk.near);
            fall_on<float>(tile, cell, window, showers[window.level], key, desk);
        };
        if constexpr (Tiles::knows_parts)
            for_open_cells(tile, [&](const Index& cell, PartBits open) {
                fall_in(cell, window_around<D>(open, Grid::place_of(cell)));
            });
        else
            for_runs(tile, 1, [&](const Index& cell, std::uint32_t) {
                fall_in(cell, {{}, Grid::place_of(cell), 0});
            });
    }

    void fall_on_windows(Tile& tile, const std::vector<Shower>& showers, std::uint64_t key,
                         Desk<D>& desk) {
        const auto& windows = tile.windows;
        for (std::size_t i = 0; i < windows.size();) {
            const std::uint16_t place = windows[i].place;
            const Index cell = Grid::cell_at(tile.first, place);
            const bool taken = tiles_.taken(cell);
            const std::size_t first = i;
            bool fine = false;
            for (; i < windows.size() && windows[i].place == place; ++i) {
                fine = fine || windows[i].level >= deep;
            }
            if (taken) continue;
            tiles_.gather(tile, cell, desk, desk.near);
            if (fine) tiles_.gather(tile, cell, desk, desk.exactly_near);
            for (std::size_t w = first; w < i; ++w) {
                const Shower& shower = showers[windows[w].level];
                if (windows[w].level < deep)
                    fall_on<float>(tile, cell, windows[w], shower, key, desk);
                else
                    fall_on<double>(tile, cell, windows[w], shower, key, desk);
            }
        }
    }

    /// Darts fall on what is open of a window; what is left of it goes to the desk.
    template <class Real>
    void fall_on(Tile& tile, const Index& cell, const Window<D>& window, const Shower& shower,
                 std::uint64_t key, Desk<D>& desk) {
        if (too_small(window)) return;
        Raster<D, Real> raster;
        for (std::size_t k = 0; k < D; ++k) {
            raster.corner[k] = static_cast<Real>(window.corner[k] * grid_.scales[k]);
            raster.part[k] = static_cast<Real>(window.part() * grid_.scales[k]);
        }
        const auto [near, reaching] = lists<Real>(desk);
        OpenParts<D> open;
        if (!uncovered<D, Real>(near, raster, slack<Real>(), reaching, open)) return;
        const std::size_t count = count_open<D>(open);
        SplitMix64 mixer = stream(key, window.place, window.corner, window.level);
        for (std::uint64_t left = shower.on(count, mixer); left > 0; --left) {
            Point place = open_part<D>(open, mixer.below(count));
            for (std::size_t k = 0; k < D; ++k)
                place[k] = window.corner[k] + (place[k] + to_unit(mixer.next())) * window.part();
            fall<Real>(tile, cell, place, reaching, mixer);
        }
        narrow<D>(window, open, shower.mean(count), desk.windows);
    }

    /// Whether no arithmetic could tell a gap of this size from none.
    [[nodiscard]] bool too_small(const Window<D>& window) const {
        bool small = window.level + 1U >= levels;
        for (const double scale : grid_.scales) small |= window.side() * scale < 2 * slack_;
        return small;
    }

    static constexpr std::size_t levels = 56;

    template <class Real>
    static auto lists(Desk<D>& desk) {
        if constexpr (std::is_same_v<Real, float>)
            return std::pair<NearDisks<D, float>&, NearDisks<D, float>&>(desk.near, desk.reaching);
        else
            return std::pair<NearDisks<D, double>&, NearDisks<D, double>&>(desk.exactly_near,
                                                                           desk.exactly_reaching);
    }

    template <class Real>
    [[nodiscard]] Real slack() const {
        if constexpr (std::is_same_v<Real, float>)
            return float_slack;
        else
            return slack_;
    }

    /// Stays, unless an earlier one that is too near stays. Several threads may ask; they all find
    /// the same.
    Fate decide(Tile& tile, std::size_t i) {
        if (const Fate known = tile.fates[i].get(); known != unknown) return known;
        const bool beaten = tiles_.any_before(
            tile, tile.candidates[i],
            [&](Tile& there, std::size_t earlier) { return decide(there, earlier) == stays; });
        tile.fates[i].set(beaten ? goes : stays);
        return beaten ? goes : stays;
    }

    Rows collect() {
        tiles_.clear_cells();
        return rows_of_tiles(tiles_.all(), &Tile::points, open_.run());
    }

    Grid grid_;
    Tiles tiles_;
    Rng keys_;
    OpenTiles open_;
    bool shared_ = open_.run().thread_count() > 1;  ///< several threads work on the tiles
    double slack_;                                  ///< of distances that doubles hold, in radii
    std::uint64_t showers_ = 0;
};

/// Tile by tile, unless there are few cells.
template <std::size_t D>
Rows tiles_or_few(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
                  const RunContext& run) {
    const DiskGrid<D> grid(space, radius, cell_radius);
    if (!grid.fine()) return Rain<D>(space, radius, cell_radius, seed, run).fill();
    constexpr double seconds_a_point = D == 2 ? 6e-7 : 2.5e-6;
    constexpr auto by_tiles = [] {
        if constexpr (D == 2)
            return plane_disks;
        else
            return space_disks;
    }();
    const double expected = expected_disks(space, radius);
    return by_tiles(grid, double_slack(space, radius), static_cast<std::uint64_t>(expected), seed,
                    worth_threads(run, expected * seconds_a_point));
}

/// Bytes that so many points take, in so many cells along each direction, which may all be fine.
double memory_for(const std::vector<double>& along, bool fine, double points) {
    const double d = static_cast<double>(along.size());
    double cells = 1;
    for (const double count : along) cells *= count;
    if (along.size() <= 3 && !fine) {  // a point, its copies, darts; what tiles know of cells
        double spots = 1;
        for (const double count : along) spots *= count + 4;
        return d * (50 * points + 8 * spots);
    }
    if (along.size() == 2) {  // what each tile knows; a point, its copy, undecided darts; windows
        const auto known = static_cast<double>(DiskSpots::stride);
        const double rows = along[1] + 4 * std::ceil(along[1] / 64);
        return 14 * known * std::ceil(along[0] / 64) * rows + 45 * points + 4 * cells;
    }
    if (along.size() == 3) {  // what tiles know; a point, its copy, what others know of it; windows
        double tiles = 1;
        for (const double count : along) tiles *= std::ceil(count / space_side);
        return static_cast<double>(SpaceTile::bytes) * tiles + 140 * points;
    }
    // A point, its copy and the candidates of a shower; windows.
    return points * (2 * 8 * d + 0.6 * (8 * d + 9)) + 1.5 * cells * (8 * d + 8);
}

/// @throws Error(limit) when the points for this radius do not fit the memory, or the indices.
void check_size(const BoxSpace& space, double radius, const RunContext& run) {
    const std::vector<double> along = cells_along(space.box, radius);
    double cells = 1;
    for (const double count : along) cells *= count;
    const double points = expected_disks(space, radius);
    bool fine = true;
    for (std::size_t k = 0; k < along.size(); ++k)
        fine = fine && fine_cells(along[k], space.box.extent(k), radius);
    run.need_memory(
        memory_for(along, fine, points),
        fmt::format("a radius of {}, with about {:.3g} points,", format_number(radius), points));
    if (cells >= 0xffff'fffe)
        fail(ErrorKind::limit,
             "a radius of {} makes about {:.3g} points, and {:.3g} cells to find them by; at most "
             "2^32 cells are possible",
             format_number(radius), points, cells);
}

}  // namespace

double expected_disks(const BoxSpace& space, double radius) {
    return space.expected_points(jammed[space.box.dimension()], radius);
}

Rows maximal_disks(const BoxSpace& space, double radius, double cell_radius, std::uint64_t seed,
                   const RunContext& run) {
    space.check_resolution(radius, "a radius");
    check_size(space, radius, run);
    switch (space.box.dimension()) {
        case 2:
            return tiles_or_few<2>(space, radius, cell_radius, seed, run);
        case 3:
            return tiles_or_few<3>(space, radius, cell_radius, seed, run);
        case 4:
            return Rain<4>(space, radius, cell_radius, seed, run).fill();
        case 5:
            return Rain<5>(space, radius, cell_radius, seed, run).fill();
        default:
            return Rain<6>(space, radius, cell_radius, seed, run).fill();
    }
}

}  // namespace stipple
