// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/space_disks.hpp"

#include <bit>
#include <cmath>

#include "core/large_pages.hpp"
#include "core/rng.hpp"
#include "generators/poisson_disk/disk_shower.hpp"
#include "generators/poisson_disk/open_tiles.hpp"
#include "generators/poisson_disk/space_showers.hpp"
#include "generators/poisson_disk/space_tiles.hpp"
#include "math/functions/splitmix64.hpp"

namespace stipple {
namespace {

using Grid = DiskGrid<3>;
using Point = Grid::Point;

/// What one thread needs to work on a tile.
struct SpaceDesk {
    NearBalls near;
    std::vector<PartThrow> part_throws;
    std::vector<Throw> throws;                 ///< of darts on a cell
    std::vector<std::array<float, 3>> places;  ///< the same, in radii
    std::vector<Hit> hits;
    std::vector<SpaceDart> darts;
    std::vector<PlacedBall> additions;
    std::vector<CubeWindow> some;  ///< of a cell
    std::vector<PartBits> open;
    std::vector<CubeWindow> cubes;
    std::vector<Window<3>> windows;
    NearDisks<3, double> exactly_near;
    NearDisks<3, double> exactly_reaching;
};

[[gnu::noinline]] SpaceDesk& desk_of_thread() {
    thread_local SpaceDesk desk;
    return desk;
}

class SpaceRain {
  public:
    SpaceRain(const Grid& grid, double slack, std::uint64_t expected, std::uint64_t seed,
              const RunContext& run)
        : grid_(grid),
          rules_(grid),
          slack_(slack),
          keys_(seed),
          open_(grid.tile_count, expected, run) {
        lines_ = unwritten_room<std::uint32_t>(BallLines::room * grid.tile_count);
        numbers_ = unwritten_room<std::uint16_t>(SpaceTile::halo_cells * grid.tile_count);
        tiles_.resize(grid.tile_count);
        open_.for_each(tiles_, [&](SpaceTile& tile, std::uint32_t t) {
            tile = SpaceTile(rules_, t, lines_.get() + BallLines::room * t,
                             numbers_.get() + SpaceTile::halo_cells * t);
        });
        open_.for_each(tiles_, [&](SpaceTile& tile, std::uint32_t t) { find_neighbours(tile, t); });
    }

    Rows fill() {
        for (int time = 0; time < 2; ++time) rain_at_large(1.25);
        double density = 8;
        for (int time = 0; time < 5; ++time, density *= 3) rain_on_parts(density);
        for (bool first = true; !open_.empty(); first = false, density *= growth)
            rain_on_windows(density, first);
        return collect();
    }

  private:
    /// Windows of this level and beyond are too small for floats.
    static constexpr std::uint8_t deep = 11;
    static constexpr std::size_t levels = 56;
    /// From one shower on windows to the next. They are split once a dart or so fell on each, into
    /// eight, so that more would fall in vain.
    static constexpr double growth = 6;

    /// Darts to a cell, when one falls on a ball, and cells are as large as they may be.
    static constexpr double one_to_a_ball = 0.045944074618482676;

    void find_neighbours(SpaceTile& tile, std::size_t number) {
        std::array<std::int64_t, 3> own;
        for (std::size_t k = 0; k < 3; number /= grid_.tiles[k], ++k)
            own[k] = static_cast<std::int64_t>(number % grid_.tiles[k]);
        for (std::size_t n = 0; n < 27; ++n) {
            std::array<std::int64_t, 3> there{own[0] + static_cast<int>(n % 3) - 1,
                                              own[1] + static_cast<int>(n / 3 % 3) - 1,
                                              own[2] + static_cast<int>(n / 9) - 1};
            SpaceCell steps{};
            bool outside = false;
            for (std::size_t k = 0; k < 3; ++k) {
                const std::int64_t all = grid_.tiles[k];
                const int around = there[k] < 0 ? -1 : there[k] >= all ? 1 : 0;
                outside = outside || (around != 0 && !grid_.torus);
                there[k] -= around * all;
                steps[k] = around * static_cast<int>(grid_.cells[k]);
            }
            if (outside || n == 13) continue;
            SpaceTile& other = tiles_[static_cast<std::size_t>(
                (there[2] * grid_.tiles[1] + there[1]) * grid_.tiles[0] + there[0])];
            for (std::size_t k = 0; k < 3; ++k)
                steps[k] += static_cast<int>(other.first()[k]) - static_cast<int>(tile.first()[k]);
            tile.neighbours[n] = {&other, steps};
        }
    }

    void rain_at_large(double density) {
        const Shower shower(density * one_to_a_ball, cells_together);
        const bool any = showers_ > 0;
        rain([&](SpaceTile& tile, std::uint64_t key, SpaceDesk& desk) {
            fall_at_large(rules_, tile, shower, key, any, desk.darts);
        });
    }

    void rain_on_parts(double density) {
        const Shower shower(density * one_to_a_ball / parts_of_cell, words_together * 64);
        rain([&](SpaceTile& tile, std::uint64_t key, SpaceDesk& desk) {
            fall_on_parts(rules_, tile, shower, key, desk.part_throws, desk.darts);
        });
    }

    void rain_on_windows(double density, bool first) {
        std::vector<Shower> showers;  // for windows of each level
        double mean = density * one_to_a_ball / parts_of_cell;
        for (std::size_t level = 0; level < levels; ++level, mean /= 8)
            showers.emplace_back(mean, parts_of_cell);
        rain([&](SpaceTile& tile, std::uint64_t key, SpaceDesk& desk) {
            desk.windows.clear();
            desk.cubes.clear();
            if (first)
                fall_on_open_parts(tile, showers, key, desk);
            else
                fall_on_cubes(tile, showers, key, desk);
            fall_on_windows(tile, showers, key, desk);
            tile.cubes = std::vector(desk.cubes.begin(), desk.cubes.end());
            tile.windows = std::vector(desk.windows.begin(), desk.windows.end());
        });
        open_.close(tiles_, [](const SpaceTile& tile) {
            return tile.cubes.empty() && tile.windows.empty();
        });
    }

    /// One shower: fall(tile, key, desk) makes a tile's darts.
    template <class Fall>
    void rain(const Fall& fall) {
        const std::uint64_t key = keys_.bits(showers_++);
        open_.for_each(tiles_, [&](SpaceTile& tile, std::uint32_t number) {
            SpaceDesk& desk = desk_of_thread();
            take_over(tile, desk);
            desk.darts.clear();
            fall(tile, SplitMix64(key + number).next(), desk);
            of_shower(tile, showers_).renew(showers_, desk.darts);
        });
        open_.for_each(tiles_, [&](SpaceTile& tile, std::uint32_t) {
            SpaceDarts& darts = of_shower(tile, showers_);
            decide_all(tile, darts);
            for (std::size_t i = 0; i < darts.all().size(); ++i)
                if (const NearDart own{&darts, i}; own.fate().get() == stays)
                    tile.points().insert(tile.points().end(), own.get().at.begin(),
                                         own.get().at.end());
        });
        open_.tick(tiles_, &SpaceTile::points, 3);
    }

    static SpaceDarts& of_shower(SpaceTile& tile, std::uint64_t shower) {
        return tile.darts[shower % 2];
    }

    /// Adds what stayed of the last shower, in this tile and near the faces of others.
    void take_over(SpaceTile& tile, SpaceDesk& desk) {
        desk.additions.clear();
        constexpr std::size_t many = 50;  // less takes the time that they save
        if (of_shower(tile, showers_ - 1).all().size() > many) tile.fetch();
        take_from(tile, tile, {}, desk);
        for (const auto& n : tile.neighbours)
            if (n.tile != nullptr) take_from(tile, *n.tile, n.steps, desk);
        cover_lines(rules_.scales, desk.additions, tile.lines());
    }

    void take_from(SpaceTile& tile, SpaceTile& other, const SpaceCell& steps, SpaceDesk& desk) {
        const std::uint64_t last = showers_ - 1;
        SpaceDarts& darts = of_shower(other, last);
        if (!darts.of(last)) return;
        const bool itself = &tile == &other && steps == SpaceCell{};
        SpaceCell low;
        SpaceCell high;
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = -SpaceTile::halo - steps[k];
            high[k] = tile.size(k) + SpaceTile::halo - 1 - steps[k];
        }
        darts.for_runs(low, high, [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) {
                if (darts.fate(i).get() != stays) continue;
                const SpaceDart& d = darts.all()[i];
                SpaceCell cell = d.cell();
                SpaceCell own;
                bool in = true;
                for (std::size_t k = 0; k < 3; ++k) {
                    own[k] = cell[k] + static_cast<int>(other.first()[k]);
                    in = in && cell[k] >= low[k] && cell[k] <= high[k];
                    cell[k] += steps[k];
                }
                if (in) desk.additions.push_back(tile.add(cell, own, d, itself));
            }
        });
    }

    /// Early ones first: those that stay tell the later ones near them to go, which need not look
    /// about themselves then.
    void decide_all(SpaceTile& tile, SpaceDarts& darts) {
        for (std::uint32_t quarter = 0; quarter < 4; ++quarter)
            for (std::size_t i = 0; i < darts.all().size(); ++i)
                if (darts.all()[i].time >> 30 == quarter) decide(tile, darts, i);
    }

    /// A dart of some tile.
    struct NearDart {
        SpaceDarts* darts;
        std::size_t number;

        [[nodiscard]] const SpaceDart& get() const { return darts->all()[number]; }
        [[nodiscard]] SharedFate& fate() const { return darts->fate(number); }
    };

    /// Stays, unless an earlier one that is too near to it stays. Several threads may ask; they all
    /// find the same.
    Fate decide(SpaceTile& tile, SpaceDarts& own_darts, std::size_t number) {
        const NearDart own{&own_darts, number};
        if (const Fate known = own.fate().get(); known != unknown) return known;
        const SpaceDart& d = own.get();
        std::array<NearDart, 32> later;  // there are hardly ever more
        std::size_t later_count = 0;
        const bool beaten = any_near(tile, d, [&](SpaceTile& there, const NearDart& near) {
            const SpaceDart& other = near.get();
            if (other.before(d))
                return tile.too_near(other.at.data(), d.at.data()) &&
                       decide(there, *near.darts, near.number) == stays;
            if (later_count < later.size() && d.before(other)) later[later_count++] = near;
            return false;
        });
        own.fate().set(beaten ? goes : stays);
        for (std::size_t i = 0; i < later_count && !beaten; ++i)
            if (tile.too_near(later[i].get().at.data(), d.at.data())) later[i].fate().set(goes);
        return beaten ? goes : stays;
    }

    /// Whether something is true of a dart that may be too near to one: is(tile, dart).
    template <class Is>
    bool any_near(SpaceTile& tile, const SpaceDart& d, const Is& is) {
        bool found_it = false;
        const SpaceCell own = d.cell();
        const auto look = [&](SpaceTile& there, const SpaceCell& steps) {
            SpaceDarts& darts = of_shower(there, showers_);
            if (!darts.of(showers_)) return;
            SpaceCell low;
            SpaceCell high;
            std::array<float, 3> off;
            for (std::size_t k = 0; k < 3; ++k) {
                low[k] = own[k] - steps[k] - 2;
                high[k] = own[k] - steps[k] + 2;
                off[k] = d.off[k] - static_cast<float>(steps[k]) * rules_.scales[k];
            }
            const std::array<const float*, 3> along{darts.along(0), darts.along(1), darts.along(2)};
            darts.for_runs(low, high, [&](std::size_t first, std::size_t last) {
                constexpr float near = 1.001F;
                std::array<std::uint16_t, 1024> found;
                while (first < last && !found_it) {
                    const std::size_t part = std::min(last, first + found.size());
                    const std::size_t count =
                        find_near(along, first, part, off, near, found.data());
                    for (std::size_t i = 0; i < count && !found_it; ++i)
                        found_it = is(there, NearDart{&darts, found[i]});
                    first = part;
                }
            });
        };
        look(tile, {});
        for_tiles_about(tile, own, [&](const SpaceTile::Neighbour& n) {
            if (!found_it) look(*n.tile, n.steps);
        });
        return found_it;
    }

    /// Calls visit(neighbour) for the other tiles that a radius leads to from a cell.
    template <class Visit>
    static void for_tiles_about(const SpaceTile& tile, const SpaceCell& cell, const Visit& visit) {
        SpaceCell to{};
        for (std::size_t k = 0; k < 3; ++k)
            to[k] = cell[k] < 2 ? -1 : cell[k] >= tile.size(k) - 2 ? 1 : 0;
        for (int z = std::min(to[2], 0); z <= std::max(to[2], 0); ++z)
            for (int y = std::min(to[1], 0); y <= std::max(to[1], 0); ++y)
                for (int x = std::min(to[0], 0); x <= std::max(to[0], 0); ++x) {
                    const auto& n =
                        tile.neighbours[static_cast<std::size_t>(13 + x + 3 * y + 9 * z)];
                    if (n.tile != nullptr) visit(n);
                }
    }

    static void start_throwing(SpaceDesk& desk) {
        desk.throws.clear();
        desk.places.clear();
    }

    /// A dart on one of the open parts of a window.
    void throw_at(const Point& corner, double part_side, PartBits open, std::size_t count,
                  SplitMix64& mixer, SpaceDesk& desk) const {
        const std::uint64_t which = mixer.next();
        const std::uint64_t where = mixer.next();
        const std::size_t part = nth_bit(open, (which >> 32) * count >> 32);
        Throw dart{{}, part_side * 0x1p-21, which << 32 ^ where};
        std::array<float, 3> place;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint64_t digits =
                (part >> (2 * k) & 3) << 21 | (where >> (21 * k) & 0x1fffff);
            dart.place[k] = corner[k] + static_cast<double>(digits) * dart.grain;
            place[k] = static_cast<float>(dart.place[k]) * rules_.scales[k];
        }
        desk.throws.push_back(dart);
        desk.places.push_back(place);
    }

    /// Makes darts that hit no ball ones that may stay.
    void land_all(const SpaceTile& tile, const SpaceCell& cell, SpaceDesk& desk) const {
        desk.hits.resize(desk.places.size());
        find_hits(desk.near, desk.places, desk.hits.data());
        for (std::size_t i = 0; i < desk.hits.size(); ++i)
            land(rules_, tile, cell, desk.throws[i], desk.hits[i], desk.darts);
    }

    /// The first windows are the parts of cells that no ball covers alone.
    void fall_on_open_parts(SpaceTile& tile, const std::vector<Shower>& showers, std::uint64_t key,
                            SpaceDesk& desk) const {
        std::array<PartBits, 8> eight;
        for (std::uint16_t place = 0; place < power(std::size_t{space_side}, 3); ++place) {
            const SpaceCell cell = space_cell(place);
            if (place % 8 == 0) eight = parts_of_eight(tile.lines(), cell);
            const PartBits open = ~eight[place % 8U];
            if (open == 0) continue;
            tile.gather(cell, open, desk.near);
            std::array<OpenPart, 65> parts;
            const std::size_t count = open_parts(desk.near, rules_.scales, open, parts.data());
            start_throwing(desk);
            SplitMix64 mixer(key + place);
            for (std::size_t i = 0; i < count; ++i) {
                const unsigned part = parts[i].part;
                const CubeWindow window{{static_cast<std::uint16_t>((part & 3) << 14),
                                         static_cast<std::uint16_t>((part >> 2 & 3) << 14),
                                         static_cast<std::uint16_t>(part >> 4 << 14)},
                                        place,
                                        2};
                fall_in_window(window, parts[i].open, showers, mixer, desk);
            }
            if (!desk.places.empty()) land_all(tile, cell, desk);
        }
    }

    void fall_on_cubes(SpaceTile& tile, const std::vector<Shower>& showers, std::uint64_t key,
                       SpaceDesk& desk) const {
        const auto& all = tile.cubes;
        for (std::size_t i = 0; i < all.size();) {
            const std::uint16_t place = all[i].place;
            const SpaceCell cell = space_cell(place);
            const PartBits covered = parts_of(tile.lines(), cell);
            PartBits some = 0;
            desk.some.clear();
            for (; i < all.size() && all[i].place == place; ++i) {
                const auto& c = all[i].corner;
                const PartBits part = PartBits{1}
                                      << (c[0] >> 14 | c[1] >> 14 << 2 | c[2] >> 14 << 4);
                if ((covered & part) != 0) continue;
                some |= part;
                desk.some.push_back(all[i]);
            }
            if (some != 0 && !tile.taken().has(cell))
                fall_on_cell(tile, desk.some, some, showers, key, desk);
        }
    }

    /// Darts fall on what is open of windows of a cell; what is left of them goes to the desk.
    void fall_on_cell(SpaceTile& tile, std::span<const CubeWindow> windows, PartBits some,
                      const std::vector<Shower>& showers, std::uint64_t key,
                      SpaceDesk& desk) const {
        const SpaceCell cell = space_cell(windows[0].place);
        tile.gather(cell, some, desk.near);
        desk.open.resize(windows.size());
        open_cubes(desk.near, rules_.scales, windows, desk.open.data());
        start_throwing(desk);
        SplitMix64 mixer(key + windows[0].place);
        for (std::size_t i = 0; i < windows.size(); ++i) {
            const PartBits open = desk.open[i];
            if (open == 0) continue;
            fall_in_window(windows[i], open, showers, mixer, desk);
        }
        if (!desk.places.empty()) land_all(tile, cell, desk);
    }

    void fall_in_window(const CubeWindow& window, PartBits open, const std::vector<Shower>& showers,
                        SplitMix64& mixer, SpaceDesk& desk) const {
        const Shower& shower = showers[window.level];
        const std::size_t count = ones_of(open);
        Point corner;
        for (std::size_t k = 0; k < 3; ++k) corner[k] = window.corner[k] * 0x1p-16;
        const double part_side = 0.25 / static_cast<double>(1U << window.level);
        for (std::uint64_t left = shower.on(count, mixer); left > 0; --left)
            throw_at(corner, part_side, open, count, mixer, desk);
        narrow_cube(window, open, shower.mean(count), desk.cubes);
        while (!desk.cubes.empty() && desk.cubes.back().level >= deep) {
            const CubeWindow& w = desk.cubes.back();
            desk.windows.push_back(
                {{w.corner[0] * 0x1p-16, w.corner[1] * 0x1p-16, w.corner[2] * 0x1p-16},
                 w.place,
                 w.level});
            desk.cubes.pop_back();
        }
    }

    /// The same for windows that are small.
    void fall_on_windows(SpaceTile& tile, const std::vector<Shower>& showers, std::uint64_t key,
                         SpaceDesk& desk) const {
        const auto& all = tile.windows;
        for (std::size_t i = 0; i < all.size();) {
            const std::uint16_t place = all[i].place;
            const SpaceCell cell = space_cell(place);
            const bool taken = tile.taken().has(cell);
            if (!taken) gather_exactly(tile, cell, desk.exactly_near);
            for (; i < all.size() && all[i].place == place; ++i)
                if (!taken) fall_on_window(tile, cell, all[i], showers[all[i].level], key, desk);
        }
    }

    void fall_on_window(SpaceTile& tile, const SpaceCell& cell, const Window<3>& window,
                        const Shower& shower, std::uint64_t key, SpaceDesk& desk) const {
        if (too_small(window)) return;
        Raster<3, double> raster;
        for (std::size_t k = 0; k < 3; ++k) {
            raster.corner[k] = window.corner[k] * grid_.scales[k];
            raster.part[k] = window.part() * grid_.scales[k];
        }
        OpenParts<3> open;
        if (!uncovered<3, double>(desk.exactly_near, raster, slack_, desk.exactly_reaching, open))
            return;
        const std::size_t count = count_open<3>(open);
        SplitMix64 mixer = stream(key, window);
        for (std::uint64_t left = shower.on(count, mixer); left > 0; --left) {
            Point place = open_part<3>(open, mixer.below(count));
            Point off;
            for (std::size_t k = 0; k < 3; ++k) {
                place[k] = window.corner[k] + (place[k] + to_unit(mixer.next())) * window.part();
                off[k] = place[k] * grid_.scales[k];
            }
            const Hit hit = hits<3, double>(desk.exactly_reaching, off, slack_);
            land(rules_, tile, cell, {place, 0, mixer.next()}, hit, desk.darts);
        }
        narrow<3>(window, open, shower.mean(count), desk.windows);
    }

    /// Numbers that belong to a window, whoever asks for them.
    static SplitMix64 stream(std::uint64_t key, const Window<3>& window) {
        std::uint64_t state =
            SplitMix64(key + (std::uint64_t{window.place} << 8 | window.level)).next();
        for (const double x : window.corner)
            state = SplitMix64(state ^ std::bit_cast<std::uint64_t>(x)).next();
        return SplitMix64(state);
    }

    /// Whether no arithmetic could tell a gap of this size from none.
    [[nodiscard]] bool too_small(const Window<3>& window) const {
        bool small = window.level + 1U >= levels;
        for (const double scale : grid_.scales) small |= window.side() * scale < 2 * slack_;
        return small;
    }

    /// Points about a cell, from its corner.
    void gather_exactly(const SpaceTile& tile, const SpaceCell& cell,
                        NearDisks<3, double>& near) const {
        near.clear();
        tile.for_about(cell, [&](const double* p, const SpaceCell& steps) {
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

    Rows collect() {
        lines_.reset();
        numbers_.reset();
        for (SpaceTile& tile : tiles_) tile.drop();
        return rows_of_tiles(tiles_, &SpaceTile::points, open_.run());
    }

    const Grid& grid_;
    SpaceRules rules_;
    double slack_;
    Rng keys_;
    OpenTiles open_;
    std::unique_ptr<std::uint32_t[]> lines_;  ///< of all tiles, as the next
    std::unique_ptr<std::uint16_t[]> numbers_;
    std::vector<SpaceTile> tiles_;
    std::uint64_t showers_ = 0;
};

}  // namespace

Rows space_disks(const DiskGrid<3>& grid, double slack, std::uint64_t expected, std::uint64_t seed,
                 const RunContext& run) {
    return SpaceRain(grid, slack, expected, seed, run).fill();
}

}  // namespace stipple
