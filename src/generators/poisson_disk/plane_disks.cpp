// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/plane_disks.hpp"

#include <bit>
#include <cmath>

#include "core/large_pages.hpp"
#include "core/rng.hpp"
#include "core/wide.hpp"
#include "generators/poisson_disk/disk_lanes.hpp"
#include "generators/poisson_disk/disk_shower.hpp"
#include "generators/poisson_disk/open_tiles.hpp"
#include "generators/poisson_disk/plane_tiles.hpp"
#include "math/functions/splitmix64.hpp"

namespace stipple {
namespace {

using Grid = DiskGrid<2>;
using Point = Grid::Point;

constexpr double cell_unit = 0x1p26;  ///< of a dart's place

/// What one thread needs to work on a tile.
struct PlaneDesk {
    std::vector<Dart> darts;
    std::vector<std::uint64_t> order;  ///< of the darts in time
    std::vector<Point> places;         ///< of darts on windows, in cells from the tile's first
    std::vector<Undecided> undecided;
    std::array<std::uint64_t, Grid::tile_side + 4> waiting;  ///< cells with such; from two rows
                                                             ///< before the first on
    std::vector<Window<2>> windows;
    NearDisks<2, double> near;
    NearDisks<2, double> reaching;
};

/// Lists the darts in order of time, equal ones as they are.
void sort_by_time(PlaneDesk& desk) {
    const std::size_t n = desk.darts.size();
    constexpr unsigned most = 10;
    const unsigned bits = std::min(most, static_cast<unsigned>(std::bit_width(n)));
    const auto slot_of = [bits](std::uint32_t time) { return std::uint64_t{time} << bits >> 32; };
    std::array<std::uint32_t, (std::size_t{1} << most) + 1> slots;
    std::fill_n(slots.begin(), (std::size_t{1} << bits) + 1, 0);
    for (const Dart& d : desk.darts) ++slots[slot_of(d.time) + 1];
    for (std::size_t i = 1; i < std::size_t{1} << bits; ++i) slots[i] += slots[i - 1];
    desk.order.resize(n);
    std::uint64_t* const order = desk.order.data();  // times, and in the lower half indices
    const Dart* const darts = desk.darts.data();
    for (std::size_t i = 0; i < n; ++i)
        order[slots[slot_of(darts[i].time)]++] = std::uint64_t{darts[i].time} << 32 | i;
    for (std::size_t i = 1; i < n; ++i) {
        const std::uint64_t one = order[i];
        if (order[i - 1] < one) continue;
        std::size_t to = i;
        for (; to > 0 && order[to - 1] > one; --to) order[to] = order[to - 1];
        order[to] = one;
    }
}

/// What decides over darts, besides the points.
struct Rules {
    const Grid& grid;
    DiskStamps<2> stamps;
    std::int32_t sure;      ///< squared distance of spots that is below the radius for certain
    std::int32_t possible;  ///< and from which on it is not
};

/// Tries the darts of one tile, one after the other.
class Thrower {
  public:
    Thrower(const Rules& rules, PlaneTile& tile, PlaneDesk& desk, bool exact)
        : rules_(rules), tile_(tile), desk_(desk), exact_(exact) {}

    [[gnu::always_inline]] void fall(const Dart& d) {
        const auto column = static_cast<int>(d.x >> 26);
        const auto row = static_cast<int>(d.y >> 26);
        const std::size_t number = PlaneTile::spot_number(column, row);
        const unsigned part = (d.y >> 23 & 7) * 8 + (d.x >> 23 & 7);
        if ((*tile_.covered(number) >> part & 1) != 0) return;
        const DiskSpots& spots = tile_.spots();
        const Spot spot = spots.spot_of(d.x / cell_unit, d.y / cell_unit);
        const Hit hit =
            spots.hit(number - DiskSpots::number(2, 2), spot, rules_.sure, rules_.possible);
        if (hit != Hit::yes) land(d, column, row, spot, hit);
    }

  private:
    void land(const Dart& d, int column, int row, Spot spot, Hit hit) {
        const Point place = place_of(d);
        const auto* stamp = rules_.stamps.about_digits({d.x << 6, d.y << 6});
        for (std::size_t line = 0; line < 4; ++line)
            __builtin_prefetch(reinterpret_cast<const char*>(stamp) + 64 * line);
        std::array<double, 2> at;
        for (std::size_t k = 0; k < 2; ++k) {
            const Grid& grid = rules_.grid;
            at[k] = grid.low[k] + (tile_.first()[k] + place[k]) * grid.widths[k];
            if (!(at[k] < grid.high[k])) return;  // rounded up to a face
        }
        if (hit == Hit::unsure && tile_.hits(column, row, at.data())) return;
        if (!waits(column, row, at)) return tile_.add(column, row, spot, at, stamp);
        desk_.waiting[static_cast<std::size_t>(row + 2)] |= std::uint64_t{1} << column;
        desk_.undecided.push_back({at, d.x, d.y, d.time});
    }

    /// In cells from the tile's first. Digits that a dart has no room for are made of the others.
    [[nodiscard]] Point place_of(const Dart& d) const {
        if (exact_) return desk_.places[d.detail];
        const std::uint64_t more = SplitMix64(std::uint64_t{d.x} << 32 | d.y).next();
        return {(d.x + static_cast<double>(more >> 32) * 0x1p-32) / cell_unit,
                (d.y + static_cast<double>(more & 0xffffffff) * 0x1p-32) / cell_unit};
    }

    /// Whether darts that are not known or decided yet have a say in this one.
    [[nodiscard]] bool waits(int column, int row, const std::array<double, 2>& at) const {
        if (column < 2 || row < 2) return true;
        if (column >= tile_.size(0) - 2 || row >= tile_.size(1) - 2) return true;
        std::uint64_t near = 0;
        for (int y = row; y < row + 5; ++y) near |= desk_.waiting[static_cast<std::size_t>(y)];
        if ((near >> (column - 2) & 0x1f) == 0) return false;
        for (const Undecided& u : desk_.undecided)
            if (std::abs(u.column() - column) <= 2 && std::abs(u.row() - row) <= 2 &&
                tile_.too_near(u.at.data(), at.data()))
                return true;
        return false;
    }

    const Rules& rules_;
    PlaneTile& tile_;
    PlaneDesk& desk_;
    bool exact_;  ///< places of darts are those of the desk
};

STIPPLE_WIDE void fall_in_order(const Rules& rules, PlaneTile& tile, PlaneDesk& desk, bool exact) {
    Thrower thrower(rules, tile, desk, exact);
    for (const std::uint64_t one : desk.order) thrower.fall(desk.darts[one & 0xffffffff]);
}

/// Adds a dart on one of the parts of a cell that are open.
[[gnu::always_inline]] inline void draw_in_cell(int column, int row, PartBits open,
                                                std::size_t count, SplitMix64& mixer,
                                                std::vector<Dart>& darts) {
    const std::uint64_t which = mixer.next();
    const std::uint64_t where = mixer.next();
    const std::size_t part = nth_bit(open, (which >> 32) * count >> 32);
    const auto x = static_cast<std::uint32_t>(column * 8) + part % 8;
    const auto y = static_cast<std::uint32_t>(row * 8) + part / 8;
    darts.push_back({static_cast<std::uint32_t>(x << 23 | where >> 41),
                     static_cast<std::uint32_t>(y << 23 | (where & 0x7fffff)),
                     static_cast<std::uint32_t>(which), 0});
}

/// Darts on the parts of cells that no disk covers alone.
STIPPLE_WIDE void draw_on_parts(const PlaneTile& tile, const Shower& shower, std::uint64_t key,
                                std::vector<Dart>& darts) {
    for (int row = 0; row < tile.size(1); ++row) {
        const PartBits* covered = tile.covered(PlaneTile::spot_number(0, row));
        std::array<std::uint8_t, Grid::tile_side> found;  // columns; listed without branches
        std::size_t some = 0;
        for (int column = 0; column < tile.size(0); ++column) {
            found[some] = static_cast<std::uint8_t>(column);
            some += covered[column] != ~PartBits{0} ? 1 : 0;
        }
        for (std::size_t i = 0; i < some; ++i) {
            const int column = found[i];
            const PartBits open = ~covered[column];
            const auto count = static_cast<std::size_t>(std::popcount(open));
            SplitMix64 mixer(key + static_cast<std::uint64_t>(row * 64 + column));
            for (std::uint64_t left = shower.on(count, mixer); left > 0; --left)
                draw_in_cell(column, row, open, count, mixer, darts);
        }
    }
}

/// Darts everywhere. @param shower for a row of cells of the tile
STIPPLE_WIDE void draw_at_large(const PlaneTile& tile, const Shower& shower, std::uint64_t key,
                                std::vector<Dart>& darts) {
    SplitMix64 mixer(key);
    const auto columns = static_cast<std::uint64_t>(tile.size(0));
    const auto rows = static_cast<std::uint64_t>(tile.size(1));
    std::uint64_t count = 0;
    for (std::uint64_t row = 0; row < rows; ++row) count += shower.on(columns, mixer);
    darts.resize(count);
    for (Dart& d : darts) {
        const std::uint64_t where = mixer.next();
        d = {static_cast<std::uint32_t>((where >> 32) * columns >> 6),
             static_cast<std::uint32_t>((where & 0xffffffff) * rows >> 6),
             static_cast<std::uint32_t>(mixer.next()), 0};
    }
}

/// Parts of a window that no disk covers alone, as far as spots tell.
STIPPLE_WIDE PartBits open_parts(const Rules& rules, const PlaneTile& tile,
                                 const Window<2>& window) {
    const int column = window.place % 64;
    const int row = window.place / 64;
    const double half = window.side() / 2;
    const DiskSpots& spots = tile.spots();
    const Spot corner = spots.spot_of(column + window.corner[0], row + window.corner[1]);
    const Spot middle =
        spots.spot_of(column + window.corner[0] + half, row + window.corner[1] + half);
    // Half the diagonal of a window is at most `half` of the radius.
    const double reach = spots_to_radius * (1 + half) + 2 * spot_slack;
    const auto part = [&](std::size_t k) {
        return static_cast<float>(window.part() * rules.grid.scales[k] * spots_to_radius);
    };
    const Lanes middles{0.5F, 1.5F, 2.5F, 3.5F, 4.5F, 5.5F, 6.5F, 7.5F};
    const Lanes along_x = middles * part(0);
    const Lanes along_y = middles * part(1);
    std::array<LaneBits, 8> covered{};
    spots.for_near(
        PlaneTile::spot_number(column - 2, row - 2), middle,
        static_cast<std::int32_t>(reach * reach), [&](Spot spot) __attribute__((always_inline)) {
            const Lanes x =
                along_x - static_cast<float>(static_cast<std::int16_t>(spot.x - corner.x));
            const Lanes y =
                along_y - static_cast<float>(static_cast<std::int16_t>(spot.y - corner.y));
            const Lanes far_x = (x < 0 ? -x : x) + part(0) / 2;
            const Lanes far_y = (y < 0 ? -y : y) + part(1) / 2;
            const Lanes squared = far_x * far_x;
            const Lanes left = static_cast<float>(rules.sure) - far_y * far_y;
            for (std::size_t line = 0; line < 8; ++line) covered[line] |= squared < left[line];
        });
    return unset(covered);
}

class PlaneRain {
  public:
    PlaneRain(const Grid& grid, double slack, std::uint64_t expected, std::uint64_t seed,
              const RunContext& run)
        : grid_(grid),
          rules_(rules_of(grid, slack)),
          slack_(slack),
          keys_(seed),
          open_(grid.tile_count, expected, run) {
        make_tiles();
    }

    Rows fill() {
        for (int time = 0; time < 2; ++time) rain_at_large(1.5);
        for (const double density : {6, 20, 60, 200}) rain_on_parts(density);
        double density = 600;
        for (bool first = true; !open_.empty(); first = false, density *= 4)
            rain_on_windows(density, first);
        return collect();
    }

  private:
    /// Windows of this level and beyond are too small for spots.
    static constexpr std::uint8_t deep = 7;
    static constexpr std::size_t levels = 56;

    /// Darts to a cell, when one falls on a disk, and cells are as large as they may be.
    static constexpr double one_to_a_disk = 0.15915494309189535;

    static Rules rules_of(const Grid& grid, double slack) {
        const double play = spot_slack + slack * spots_to_radius;
        const double sure = spots_to_radius - play;
        const double possible = spots_to_radius + play;
        return {grid, DiskStamps<2>(grid), static_cast<std::int32_t>(sure * sure),
                static_cast<std::int32_t>(possible * possible) + 1};
    }

    void make_tiles() {
        const auto needed = [&](std::size_t t) {
            const auto [first, last] = plane_tile(grid_, t);
            return DiskSpots::needed(last[1] - first[1]);
        };
        std::vector<std::size_t> before{0};
        for (std::size_t t = 0; t < grid_.tile_count; ++t)
            before.push_back(before.back() + needed(t));
        spots_ = unwritten_room<Spot>(before.back());
        covered_ = unwritten_room<PartBits>(before.back());
        indices_ = unwritten_room<std::uint16_t>(before.back());
        tiles_.resize(grid_.tile_count);
        open_.for_each(tiles_, [&](PlaneTile& tile, std::uint32_t t) {
            const CellRoom room{spots_.get() + before[t], covered_.get() + before[t],
                                indices_.get() + before[t]};
            tile = PlaneTile(grid_, t, room);
        });
    }

    void rain_at_large(double density) {
        const Shower shower(density * one_to_a_disk, Grid::tile_side);
        rain(false, [&](PlaneTile& tile, std::uint64_t key, PlaneDesk& desk) {
            draw_at_large(tile, shower, key, desk.darts);
        });
    }

    void rain_on_parts(double density) {
        const Shower shower(density * one_to_a_disk / parts_of_cell, parts_of_cell);
        rain(false, [&](PlaneTile& tile, std::uint64_t key, PlaneDesk& desk) {
            draw_on_parts(tile, shower, key, desk.darts);
        });
    }

    void rain_on_windows(double density, bool first) {
        std::vector<Shower> showers;  // for windows of each level
        double mean = density * one_to_a_disk / parts_of_cell;
        for (std::size_t level = 0; level < levels; ++level, mean /= 4)
            showers.emplace_back(mean, parts_of_cell);
        rain(true, [&](PlaneTile& tile, std::uint64_t key, PlaneDesk& desk) {
            desk.windows.clear();
            desk.places.clear();
            if (first)
                open_windows(tile, showers, key, desk);
            else
                for (const Window<2>& window : tile.windows)
                    fall_on(tile, window, showers[window.level], key, desk);
            tile.windows.assign(desk.windows.begin(), desk.windows.end());
        });
        open_.close(tiles_, [](const PlaneTile& tile) { return tile.windows.empty(); });
    }

    /// One shower: draw(tile, key, desk) makes a tile's darts.
    template <class Draw>
    void rain(bool exact, const Draw& draw) {
        const std::uint64_t key = keys_.bits(showers_++);
        open_.for_each(tiles_, [&](PlaneTile& tile, std::uint32_t number) {
            thread_local PlaneDesk desk;
            tile.fetch();
            take_over(tile, number);
            desk.darts.clear();
            desk.undecided.clear();
            desk.waiting.fill(0);
            draw(tile, SplitMix64(key + number).next(), desk);
            sort_by_time(desk);
            fall_in_order(rules_, tile, desk, exact);
            of_shower(tile, showers_).renew(showers_, desk.undecided);
        });
        open_.for_each(tiles_, [&](PlaneTile& tile, std::uint32_t number) {
            for (Undecided& u : of_shower(tile, showers_).all())
                if (decide(tile, number, u) == stays)
                    tile.add(u.column(), u.row(),
                             tile.spots().spot_of(u.x / cell_unit, u.y / cell_unit), u.at,
                             rules_.stamps.about_digits(u.digits()));
        });
        open_.tick(tiles_, &PlaneTile::points, 2);
    }

    static UndecidedDarts& of_shower(PlaneTile& tile, std::uint64_t shower) {
        return tile.undecided[shower % 2];
    }

    /// Calls visit(tile, steps) for the tiles about another, with the cells from its first one to
    /// theirs; on a small torus more than once for the same, or for itself.
    template <class Visit>
    void for_neighbours(const PlaneTile& tile, std::uint32_t number, const Visit& visit) {
        const std::array<std::int64_t, 2> own{number % grid_.tiles[0], number / grid_.tiles[0]};
        for (int other = 0; other < 9; ++other) {
            if (other == 4) continue;
            std::array<std::int64_t, 2> there{own[0] + other % 3 - 1, own[1] + other / 3 - 1};
            std::array<int, 2> steps{};
            bool outside = false;
            for (std::size_t k = 0; k < 2; ++k) {
                const std::int64_t all = grid_.tiles[k];
                const int around = there[k] < 0 ? -1 : there[k] >= all ? 1 : 0;
                outside = outside || (around != 0 && !grid_.torus);
                there[k] -= around * all;
                steps[k] = around * static_cast<int>(grid_.cells[k]);
            }
            if (outside) continue;
            PlaneTile& neighbour =
                tiles_[static_cast<std::size_t>(there[1] * grid_.tiles[0] + there[0])];
            for (std::size_t k = 0; k < 2; ++k)
                steps[k] +=
                    static_cast<int>(neighbour.first()[k]) - static_cast<int>(tile.first()[k]);
            visit(neighbour, steps);
        }
    }

    /// Adds to the halo what stayed of the last shower near the edges of other tiles.
    void take_over(PlaneTile& tile, std::uint32_t number) {
        const std::uint64_t last = showers_ - 1;
        for_neighbours(tile, number, [&](PlaneTile& other, const std::array<int, 2>& steps) {
            UndecidedDarts& darts = of_shower(other, last);
            if (!darts.of(last)) return;
            darts.for_some({-2 - steps[0], -2 - steps[1]},
                           {tile.size(0) + 1 - steps[0], tile.size(1) + 1 - steps[1]},
                           [&](const Undecided& u) {
                               if (u.fate.get() != stays) return true;
                               tile.add_beyond(u.column() + steps[0], u.row() + steps[1],
                                               tile.spots().spot_of(u.x / cell_unit + steps[0],
                                                                    u.y / cell_unit + steps[1]),
                                               u.at, rules_.stamps.about_digits(u.digits()));
                               return true;
                           });
        });
    }

    /// Stays, unless an earlier one that is too near to it stays. Several threads may ask; they all
    /// find the same.
    Fate decide(PlaneTile& tile, std::uint32_t number, Undecided& u) {
        if (const Fate known = u.fate.get(); known != unknown) return known;
        bool beaten = false;
        const auto look = [&](PlaneTile& there, const std::array<int, 2>& steps) {
            const std::array<int, 2> cell{u.column() - steps[0], u.row() - steps[1]};
            if (beaten) return;
            UndecidedDarts& darts = of_shower(there, showers_);
            if (!darts.of(showers_)) return;
            darts.for_some({cell[0] - 2, cell[1] - 2}, {cell[0] + 2, cell[1] + 2},
                           [&](Undecided& other) {
                               if (!other.before(u)) return true;
                               if (!tile.too_near(other.at.data(), u.at.data())) return true;
                               beaten = decide(there, number_of(there), other) == stays;
                               return !beaten;
                           });
        };
        look(tile, {0, 0});
        if (!beaten && at_edge(tile, u)) for_neighbours(tile, number, look);
        u.fate.set(beaten ? goes : stays);
        return beaten ? goes : stays;
    }

    [[nodiscard]] static bool at_edge(const PlaneTile& tile, const Undecided& u) {
        return u.column() < 2 || u.row() < 2 || u.column() >= tile.size(0) - 2 ||
               u.row() >= tile.size(1) - 2;
    }

    [[nodiscard]] std::uint32_t number_of(const PlaneTile& tile) const {
        return static_cast<std::uint32_t>(&tile - tiles_.data());
    }

    /// The first windows: about what is open of cells as far as that is known.
    void open_windows(const PlaneTile& tile, const std::vector<Shower>& showers, std::uint64_t key,
                      PlaneDesk& desk) {
        for (int row = 0; row < tile.size(1); ++row) {
            const PartBits* covered = tile.covered(PlaneTile::spot_number(0, row));
            for (int column = 0; column < tile.size(0); ++column) {
                const PartBits open = ~covered[column];
                if (open == 0) continue;
                const auto window =
                    window_around<2>(open, static_cast<std::uint16_t>(row * 64 + column));
                fall_on(tile, window, showers[window.level], key, desk);
            }
        }
    }

    /// Darts fall on what is open of a window; what is left of it goes to the desk.
    void fall_on(const PlaneTile& tile, const Window<2>& window, const Shower& shower,
                 std::uint64_t key, PlaneDesk& desk) {
        const int column = window.place % 64;
        const int row = window.place / 64;
        if (tile.taken(PlaneTile::spot_number(column, row)) || too_small(window)) return;
        const PartBits open = window.level < deep ? open_parts(rules_, tile, window)
                                                  : exactly_open(tile, window, desk);
        if (open == 0) return;
        const std::size_t count = ones_of(open);
        SplitMix64 mixer = stream(key, window);
        for (std::uint64_t left = shower.on(count, mixer); left > 0; --left) {
            const std::size_t part = nth_bit(open, mixer.below(count));
            Point place{static_cast<double>(part % 8), static_cast<double>(part / 8)};
            for (std::size_t k = 0; k < 2; ++k)
                place[k] = window.corner[k] + (place[k] + to_unit(mixer.next())) * window.part();
            if (!(place[0] < 1 && place[1] < 1)) continue;  // rounded up
            place[0] += column;
            place[1] += row;
            desk.darts.push_back({static_cast<std::uint32_t>(place[0] * cell_unit),
                                  static_cast<std::uint32_t>(place[1] * cell_unit),
                                  static_cast<std::uint32_t>(mixer.next() >> 32),
                                  static_cast<std::uint32_t>(desk.places.size())});
            desk.places.push_back(place);
        }
        OpenParts<2> lines;
        for (std::size_t i = 0; i < lines.size(); ++i)
            lines[i] = static_cast<std::uint8_t>(open >> (8 * i));
        narrow<2>(window, lines, shower.mean(count), desk.windows);
    }

    /// The same as open_parts, for small windows.
    PartBits exactly_open(const PlaneTile& tile, const Window<2>& window, PlaneDesk& desk) const {
        gather(tile, window, desk.near);
        Raster<2, double> raster;
        for (std::size_t k = 0; k < 2; ++k) {
            raster.corner[k] = window.corner[k] * grid_.scales[k];
            raster.part[k] = window.part() * grid_.scales[k];
        }
        OpenParts<2> open;
        if (!uncovered<2, double>(desk.near, raster, slack_, desk.reaching, open)) return 0;
        PartBits bits = 0;
        for (std::size_t i = 0; i < open.size(); ++i) bits |= PartBits{open[i]} << (8 * i);
        return bits;
    }

    /// Numbers that belong to a window, whoever asks for them.
    static SplitMix64 stream(std::uint64_t key, const Window<2>& window) {
        const std::uint64_t place = std::uint64_t{window.place} << 8 | window.level;
        const auto x = std::bit_cast<std::uint64_t>(window.corner[0]);
        const auto y = std::bit_cast<std::uint64_t>(window.corner[1]);
        return SplitMix64(SplitMix64(key + place + x).next() ^ y);
    }

    /// Whether no arithmetic could tell a gap of this size from none.
    [[nodiscard]] bool too_small(const Window<2>& window) const {
        bool small = window.level + 1U >= levels;
        for (const double scale : grid_.scales) small |= window.side() * scale < 2 * slack_;
        return small;
    }

    /// Points about a window.
    void gather(const PlaneTile& tile, const Window<2>& window, NearDisks<2, double>& near) const {
        const int column = window.place % 64;
        const int row = window.place / 64;
        near.clear();
        for (int y = row - 2; y <= row + 2; ++y)
            for (int x = column - 2; x <= column + 2; ++x) {
                const std::size_t number = PlaneTile::spot_number(x, y);
                if (!tile.taken(number)) continue;
                const double* p = tile.point(number);
                const std::array<int, 2> cell{x, y};
                Point off;
                for (std::size_t k = 0; k < 2; ++k) {
                    double along = (p[k] - grid_.low[k]) / grid_.widths[k] - tile.first()[k];
                    if (std::abs(along - cell[k]) > 2)  // around the torus
                        along +=
                            along < cell[k] ? grid_.cells[k] : -static_cast<double>(grid_.cells[k]);
                    off[k] = (along - (k == 0 ? column : row)) * grid_.scales[k];
                }
                near.add(off);
            }
        near.close();
    }

    Rows collect() {
        spots_.reset();
        covered_.reset();
        indices_.reset();
        for (PlaneTile& tile : tiles_) tile.drop();
        return rows_of_tiles(tiles_, &PlaneTile::points, open_.run());
    }

    const Grid& grid_;
    Rules rules_;
    double slack_;
    Rng keys_;
    OpenTiles open_;
    std::unique_ptr<Spot[]> spots_;  ///< of all tiles' cells, as the next two
    std::unique_ptr<PartBits[]> covered_;
    std::unique_ptr<std::uint16_t[]> indices_;
    std::vector<PlaneTile> tiles_;
    std::uint64_t showers_ = 0;
};

}  // namespace

Rows plane_disks(const DiskGrid<2>& grid, double slack, std::uint64_t expected, std::uint64_t seed,
                 const RunContext& run) {
    return PlaneRain(grid, slack, expected, seed, run).fill();
}

}  // namespace stipple
