// SPDX-License-Identifier: MIT
//
// Blue noise through optimal transport: points whose power cells all have the same mass, moved to
// lower the cost of carrying the density to them,
//
//     minimise over x  sum over i of integral of |y - x_i|^2 rho(y) dy over cell i,
//     with weights w such that  integral of rho over cell i = total / n  for all i.
//
// Two steps alternate, which both lower the cost: the weights are found for the current points
// (relaxation/equal_cells.hpp), and the points move to the centroids of their cells. Undisturbed,
// points form hexagonal crystals. So every tenth iteration, except the last nine, moves points in
// hexagonal regions at random by up to half a spacing. A point is in such a region if the bond
// order of its k neighbours at angles theta_j is high,
//
//     | sum_j exp(6 i theta_j) | / k  >  3/4    for the point and two of its neighbours or more.
//
// Points whose centroid has a density of 0 move to the nearest pixel of positive density before the
// last weights are found.
//
// Shape   d = 2; any rectangle, torus or bounded. So that every cell has mass, a density is raised
//         to at least 10^-3 of its mean, or less if that would add more than a tenth of a point's
//         mass.
// Cost    4 us a point and iteration at n = 4096 on one core, 7 us at 10^5; with a density of
//         strong contrasts up to ten times that. 300 bytes a point.
// Promise masses are equal within 10^-6 of their mean, or a note reports it; the same bits for any
//         number of threads.
// Source  F. de Goes, K. Breeden, V. Ostromoukhov, M. Desbrun, "Blue noise through optimal
//         transport", ACM Trans. Graph. 31, 6 (2012) 171, doi:10.1145/2366145.2366190. There,
//         regular regions are detected by their even costs of transport instead.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/blue_noise/planar_start.hpp"
#include "generators/blue_noise/relaxation/equal_cells.hpp"
#include "generators/generator.hpp"

namespace stipple::generators::capacity_constrained {
namespace {

using planar::from;

constexpr auto iterations = planar::iterations_option(60, "Number of moves of every point");
constexpr Param<bool> crystals{
    .name = "crystals",
    .help = "Keep hexagonal regions; by default their points are moved at random"};

constexpr double rough = 1e-2;   // relative tolerance of the masses while points still move
constexpr std::size_t few = 20;  // limit of Newton steps for `rough`; one or two usually suffice
constexpr double fine = 1e-8;    // tolerance at the end; the last Newton step reaches it anyway
constexpr double promised = 1e-6;
constexpr std::uint64_t rest = 10;  // iterations from one shake to the next

/// Unit vector at six times the angle of d: (x + iy)^6 / |x + iy|^6 as a complex number.
Vec2 sixfold(const Vec2& d) {
    const auto times = [](const Vec2& a, const Vec2& b) {
        return Vec2{a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x};
    };
    const double length = std::sqrt(d.x * d.x + d.y * d.y);
    const Vec2 unit{d.x / length, d.y / length};
    const Vec2 square = times(unit, unit);
    return times(times(square, square), square);
}

/// Marks points whose neighbours nearly form a hexagon, if those of two neighbours or more do, too.
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
        // The second moment per mass of a hexagon of area A about its centre is 0.16 A.
        const double spacing = 2.5 * std::sqrt(cell.second / cell.mass);
        const Vec2 at = cells[i];
        cells.move(i, {at.x + spacing * (rng.uniform(2 * i) - 0.5),
                       at.y + spacing * (rng.uniform(2 * i + 1) - 0.5)});
    }
}

/// Nearest position to `at` in the pixels of positive density without their margins. Margins are a
/// random 0.1 to 0.2 of a pixel's side, so that no two points coincide.
Vec2 nearest_dark(const DensityMap& density, const Planar& planar, Vec2 at, const Rng& rng,
                  std::uint64_t draw) {
    const auto columns = static_cast<std::int64_t>(density.width());
    const auto rows = static_cast<std::int64_t>(density.height());
    const Vec2 side{planar.sides.x / static_cast<double>(columns),
                    planar.sides.y / static_cast<double>(rows)};
    const auto column = std::min(static_cast<std::int64_t>(at.x / side.x), columns - 1);
    const auto row = std::min(static_cast<std::int64_t>(at.y / side.y), rows - 1);
    const auto inside = [&](double x, std::int64_t pixel, double width, std::uint64_t i) {
        const double low = static_cast<double>(pixel) * width;
        const double edge = width * (0.1 + 0.1 * rng.uniform(2 * draw + i));
        return std::clamp(x, low + edge, low + width - edge);
    };
    Vec2 best = at;
    double least = std::numeric_limits<double>::infinity();
    const auto look = [&](std::int64_t c, std::int64_t r) {
        if (c < 0 || r < 0 || c >= columns || r >= rows) return;
        if (!(density.values()[static_cast<std::size_t>(r * columns + c)] > 0)) return;
        const Vec2 to{inside(at.x, c, side.x, 0), inside(at.y, r, side.y, 1)};
        const Vec2 way{to.x - at.x, to.y - at.y};
        if (const double square = way.x * way.x + way.y * way.y; square < least) {
            least = square;
            best = to;
        }
    };
    // Searches rings of pixels around `at` until all other pixels are farther than the best.
    for (std::int64_t ring = 0; ring < std::max(columns, rows); ++ring) {
        const double reach = static_cast<double>(ring - 1) * std::min(side.x, side.y);
        if (reach > 0 && reach * reach > least) break;
        for (std::int64_t k = -ring; k <= ring; ++k) {
            look(column + k, row - ring);
            look(column + k, row + ring);
            look(column - ring, row + k);
            look(column + ring, row + k);
        }
    }
    return best;
}

/// Moves sites out of pixels of density 0; returns whether there were any.
bool leave_white(EqualCells& cells, const DensityMap& density, const Planar& planar,
                 const Rng& rng) {
    bool moved = false;
    for (std::size_t i = 0; i < cells.count(); ++i) {
        const Vec2 at = cells[i];
        const auto pixel = [](double x, double side, std::size_t pixels) {
            return std::min(static_cast<std::size_t>(x / side * static_cast<double>(pixels)),
                            pixels - 1);
        };
        const std::size_t row = pixel(at.y, planar.sides.y, density.height());
        const std::size_t column = pixel(at.x, planar.sides.x, density.width());
        if (density.values()[row * density.width() + column] > 0) continue;
        cells.move(i, nearest_dark(density, planar, at, rng, i));
        moved = true;
    }
    return moved;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    auto [planar, density, rows] = planar_start(plan, options, 300, "the transport", run);
    const double least = std::min(1e-3, 0.2 / static_cast<double>(rows.size()));
    const auto floor = [least](double value) { return std::max(value, least); };
    const auto moments = planar_moments(density, floor, planar, run);
    // Positions for points that lose their cells.
    const auto rescue = random_places(rows.size() / 2, planar, density, Rng(plan.seed, 1), run);
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
    const Rng nudges(plan.seed, 2 + steps);
    if (density) leave_white(cells, *density, planar, nudges);
    double off = cells.equalize(fine, rescue);
    // equalize() may have moved sites that had lost their cells.
    for (int i = 0; density && i < 8 && leave_white(cells, *density, planar, nudges); ++i)
        off = cells.equalize(fine, rescue);
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
            .stream_version = 2,
            .plan = planar_plan,
            .set = make};
}

}  // namespace stipple::generators::capacity_constrained
