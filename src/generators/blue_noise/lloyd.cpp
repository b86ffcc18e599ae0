// SPDX-License-Identifier: MIT
//
// Lloyd's relaxation: every point moves to the centroid of its Voronoi cell, again and again,
//
//     x_i  <-  integral of x rho(x)^2 dx / integral of rho(x)^2 dx,    both over the cell of x_i,
//
// which lowers the energy  E = sum over i of integral of |x - x_i|^2 rho(x)^2 dx over cell i  until
// every point is the centroid of its cell. rho is the density of --density, or constant. It is
// squared because points that minimise E have a density proportional to the root of the density
// that E integrates. Without a density, points settle into hexagons with defects between them: few
// iterations leave them irregular, many make crystals.
//
// Shape   d = 2; any rectangle, its opposite sides joined (torus) or walls.
// Cost    1.3 us a point and iteration on one core, with a density 2 us and more; 100 bytes a
//         point. A point whose whole cell has density 0 does not move.
// Promise E never rises; the same bits for any number of threads. Of points that coincide, all but
//         one are moved to random positions.
// Source  S. P. Lloyd, IEEE Trans. Inf. Theory 28 (1982) 129-137, doi:10.1109/TIT.1982.1056489.
//         Q. Du, V. Faber, M. Gunzburger, SIAM Review 41 (1999) 637-676,
//         doi:10.1137/S0036144599352836. Stippling: A. Secord, NPAR (2002) 37-43,
//         doi:10.1145/508530.508537 (rho itself, not squared).

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "generators/blue_noise/planar_start.hpp"
#include "generators/generator.hpp"
#include "math/neighbors/periodic_voronoi.hpp"

namespace stipple::generators::lloyd {
namespace {

using planar::from;

constexpr auto iterations = planar::iterations_option(50, "Number of moves of every point");

/// Centroid of a site's cell; nullopt if it has no cell.
std::optional<Vec2> centroid(const PeriodicVoronoi& sites, std::size_t i,
                             const std::optional<DensityMoments>& density, VoronoiCell& cell) {
    sites.cut_cell(i, cell);
    const CellMoments moments = density ? (*density)(cell, sites[i]) : cell.moments();
    if (cell.empty()) return {};
    if (!(moments.mass > 0)) return sites[i];
    return sites.inside(
        {sites[i].x + moments.first.x / moments.mass, sites[i].y + moments.first.y / moments.mass});
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    auto [planar, density, rows] = planar_start(plan, options, 100, "Lloyd's relaxation", run);
    const auto square = [](double value) { return value * value; };
    const auto moments = planar_moments(density, square, planar, run);
    const auto order = along_strips(rows, planar, run);  // site i is point order[i]
    const std::size_t n = order.size();
    PeriodicVoronoi sites(planar.sides, planar.torus, n, moments.has_value(), run);
    for (std::size_t i = 0; i < n; ++i)
        sites.insert(i, {rows[2 * order[i]], rows[2 * order[i] + 1]});
    std::vector<Vec2> next(n);
    const RunContext part = silent(worth_threads(run, 1.3e-6 * static_cast<double>(n)));
    const auto steps = static_cast<std::uint64_t>(options[iterations]);
    run.tick(0, 1);
    for (std::uint64_t step = 0; step < steps; ++step) {
        const Rng rng(plan.seed, 1 + step);
        for_each_block(part, n, 1024, [&, sides = planar.sides](const Block& block) {
            VoronoiCell cell;
            for (std::uint64_t i = block.first; i < block.last; ++i) {
                const std::uint64_t number = order[i];
                const auto middle = centroid(sites, i, moments, cell);
                next[i] = middle ? *middle
                                 : Vec2{sides.x * rng.uniform(2 * number),
                                        sides.y * rng.uniform(2 * number + 1)};
            }
        });
        for (std::size_t i = 0; i < n; ++i) sites.move(i, next[i]);
        run.tick(step + 1, steps);
    }
    run.tick(1, 1);
    return planar_points(plan, planar, sites, order);
}

}  // namespace

Generator unit() {
    return {
        .name = "lloyd",
        .summary = "Centroidal Voronoi relaxation: moves every point to the centroid of its cell",
        .source = "Lloyd 1982, doi:10.1109/TIT.1982.1056489",
        .related = {"voronoi-relaxation", "relaxation", "k-means"},
        .traits = planar_traits,
        .options = Schema(iterations, planar::initial, from, density_option, invert_option,
                          torus_option, bounded_option),
        .aliases = {"cvt", "centroidal-voronoi"},
        .plan = planar_plan,
        .set = make};
}

}  // namespace stipple::generators::lloyd
