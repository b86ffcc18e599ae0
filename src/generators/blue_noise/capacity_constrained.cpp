// SPDX-License-Identifier: MIT
//
// Blue noise through optimal transport: points whose power cells all have the same mass, moved to
// lower the cost of carrying the density to them,
//
//     minimise over x  sum over i of integral of |y - x_i|^2 rho(y) dy over cell i,
//     with weights w such that  integral of rho over cell i = total / n  for all i.
//
// In turn, the weights are found for the points where they are (equal_cells.hpp), and
// the points move to the centroids of their cells, both of which lower the cost. Left alone the
// points become crystals of hexagons: so every tenth iteration, but for the last nine, hexagons
// beside hexagons are shaken by up to half a spacing. Hexagons are told by the bond order of a
// point's k neighbours at angles theta_j,
//
//     | sum_j exp(6 i theta_j) | / k  >  3/4    for the point and two of its neighbours or more.
//
// Shape   d = 2; any rectangle, torus or bounded. A density is raised to at least 10^-3 of its
//         mean, so that no cell is without mass.
// Cost    4 us a point and iteration at n = 4096 on one core, 7 us at 10^5; with a density of
//         strong contrasts up to ten times that. 300 bytes a point.
// Promise masses are equal within 10^-6 of them, or the user is told; the same bits for any number
//         of threads.
// Source  F. de Goes, K. Breeden, V. Ostromoukhov, M. Desbrun, "Blue noise through optimal
//         transport", ACM Trans. Graph. 31, 6 (2012) 171, doi:10.1145/2366145.2366190. There
//         regular regions are told by their even costs of transport instead.

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/blue_noise/planar_start.hpp"
#include "generators/blue_noise/relaxation/equal_cells.hpp"
#include "generators/generator.hpp"

namespace stipple::generators::capacity_constrained {
namespace {

using planar::from;

constexpr auto iterations = planar::iterations_option(60, "How often every point moves");
constexpr Param<bool> crystals{.name = "crystals",
                               .help = "Leave hexagons that form as they are; do not shake them"};

constexpr double rough = 1e-2;   // equal enough for points that go on moving
constexpr std::size_t few = 20;  // Newton steps for them; mostly one or two do
constexpr double fine = 1e-8;    // what Newton's last step reaches anyway
constexpr double promised = 1e-6;
constexpr std::uint64_t rest = 10;  // iterations between shakes

/// (x + iy)^6 / |x + iy|^6.
Vec2 sixfold(const Vec2& d) {
    const auto times = [](const Vec2& a, const Vec2& b) {
        return Vec2{a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
    };
    const double length = std::sqrt(d.x * d.x + d.y * d.y);
    const Vec2 unit{d.x / length, d.y / length};
    const Vec2 square = times(unit, unit);
    return times(times(square, square), square);
}

/// Points with six neighbours nearly as hexagons have them, two of which are such points, too.
std::vector<bool> hexagons(const EqualCells& cells) {
    struct Order {
        Vec2 sum;
        double bonds = 0;
    };
    std::vector<Order> orders(cells.count());
    for (const auto& [a, b, conductance] : cells.bonds()) {
        const Vec2 turned = sixfold(cells.sites().shortest(cells[a], cells[b]));
        for (const std::uint32_t i : {a, b}) {
            orders[i].sum.x += turned.x;
            orders[i].sum.y += turned.y;
            orders[i].bonds += 1;
        }
    }
    const auto regular = [&](std::size_t i) {
        const auto& [sum, bonds] = orders[i];
        return sum.x * sum.x + sum.y * sum.y > 0.75 * 0.75 * bonds * bonds;
    };
    std::vector<int> beside(cells.count());
    for (const auto& [a, b, conductance] : cells.bonds()) {
        beside[a] += regular(b);
        beside[b] += regular(a);
    }
    std::vector<bool> found(cells.count());
    for (std::size_t i = 0; i < found.size(); ++i) found[i] = regular(i) && beside[i] >= 2;
    return found;
}

void shake(EqualCells& cells, const Rng& rng) {
    const auto regular = hexagons(cells);
    for (std::size_t i = 0; i < cells.count(); ++i) {
        const CellMoments& cell = cells.moments()[i];
        if (!regular[i] || !(cell.mass > 0)) continue;
        // A hexagon of area A has a second moment of 0.16 A about its centre, per mass.
        const double spacing = 2.5 * std::sqrt(cell.second / cell.mass);
        const Vec2 at = cells[i];
        cells.move(i, {at.x + spacing * (rng.uniform(2 * i) - 0.5),
                       at.y + spacing * (rng.uniform(2 * i + 1) - 0.5)});
    }
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    auto [planar, density, rows] = planar_start(plan, options, 300, "the transport", run);
    const auto floor = [](double value) { return std::max(value, 1e-3); };
    const auto moments = planar_moments(density, floor, planar, run);
    // For points that have lost their cells.
    const auto rescue = random_places(rows.size() / 2, planar, density, Rng(plan.seed, 1));
    run.tick(0, 1);
    EqualCells cells(planar, moments, rows, run);
    const auto steps = static_cast<std::uint64_t>(options[iterations]);
    for (std::uint64_t i = 0; i < steps; ++i) {
        cells.equalize(rough, rescue, few);
        if (i > 0 && i % rest == 0 && i + rest <= steps && !options[crystals])
            shake(cells, Rng(plan.seed, 1 + i));
        else
            cells.move_to_centroids();
        run.tick(i + 1, steps + 1);
    }
    const double off = cells.equalize(fine, rescue);
    if (off > promised)
        run.notify("the cells' masses differ by up to " + format_number(off) + " of their mean");
    run.tick(1, 1);
    return planar_points(plan, planar, cells.sites());
}

}  // namespace

Generator unit() {
    return {.name = "capacity-constrained",
            .summary = "Points with cells of equal mass, by optimal transport (blue noise)",
            .source = "de Goes, Breeden, Ostromoukhov, Desbrun 2012, doi:10.1145/2366145.2366190",
            .related = {"power-diagram"},
            .traits = planar_traits,
            .options = Schema(iterations, crystals, planar::initial, from, density_option,
                              invert_option, torus_option, bounded_option),
            .aliases = {"bnot", "optimal-transport", "ccvt"},
            .plan = planar_plan,
            .set = make};
}

}  // namespace stipple::generators::capacity_constrained
