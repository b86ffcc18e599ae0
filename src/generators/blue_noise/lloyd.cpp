// SPDX-License-Identifier: MIT
//
// Lloyd's relaxation: every point moves to the centroid of its Voronoi cell, again and again,
//
//     x_i  <-  integral of x rho(x)^2 dx / integral of rho(x)^2 dx,    both over the cell of x_i,
//
// which lowers the energy  E = sum over i of integral of |x - x_i|^2 rho(x)^2 dx over cell i  until
// every point is the centroid of its cell. rho is the number of points per area that --density asks
// for, else constant; it is squared since sets of least energy have points per area in proportion
// to the root of the density that is integrated. Without a density the points settle into hexagons
// with defects between them: few iterations leave them irregular, many make crystals.
//
// Shape   d = 2; any rectangle, its opposite sides joined (torus) or walls.
// Cost    1.3 us a point and iteration on one core, with a density 2 us and more; 100 bytes a
//         point. Points where the density is 0 all around stay where they are.
// Promise E never rises; the same bits for any number of threads. Of points in one place all but
//         one are moved to random places.
// Source  S. P. Lloyd, IEEE Trans. Inf. Theory 28 (1982) 129-137, doi:10.1109/TIT.1982.1056489.
//         Q. Du, V. Faber, M. Gunzburger, SIAM Review 41 (1999) 637-676,
//         doi:10.1137/S0036144599352836. Stippling: A. Secord, NPAR (2002) 37-43,
//         doi:10.1145/508530.508537 (rho itself, not squared).

#include <algorithm>

#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "generators/blue_noise/planar_start.hpp"
#include "generators/generator.hpp"
#include "math/neighbors/periodic_voronoi.hpp"

namespace stipple::generators::lloyd {
namespace {

using planar::from;

constexpr auto iterations = planar::iterations_option(50, "How often every point moves");

class Lloyd {
  public:
    Lloyd(const Planar& planar, const std::vector<double>& rows,
          const std::optional<DensityMoments>& density, std::uint64_t seed, const RunContext& run)
        : planar_(planar),
          density_(density),
          seed_(seed),
          run_(run),
          order_(along_strips(rows, planar, run)),
          next_(order_.size()),
          sites_(planar.sides, planar.torus, order_.size(), density.has_value()) {
        for (std::size_t i = 0; i < order_.size(); ++i)
            sites_.insert(i, {rows[2 * order_[i]], rows[2 * order_[i] + 1]});
    }

    void iterate(std::uint64_t iteration) {
        const std::size_t n = order_.size();
        const RunContext part = worth_threads(run_, 1.3e-6 * static_cast<double>(n));
        for_each_block(silent(part), n, 1024, [&](const Block& block) {
            VoronoiCell cell;
            for (std::uint64_t i = block.first; i < block.last; ++i)
                next_[i] = better_place(i, iteration, cell);
        });
        for (std::size_t i = 0; i < n; ++i) sites_.move(i, next_[i]);
    }

    /// In the order of the points to start from.
    [[nodiscard]] std::vector<double> rows() const {
        std::vector<double> rows(2 * order_.size());
        for (std::size_t i = 0; i < order_.size(); ++i) {
            rows[2 * order_[i]] = sites_[i].x;
            rows[2 * order_[i] + 1] = sites_[i].y;
        }
        return rows;
    }

  private:
    [[nodiscard]] Vec2 better_place(std::size_t i, std::uint64_t iteration,
                                    VoronoiCell& cell) const {
        sites_.cut_cell(i, cell);
        const CellMoments moments = density_ ? (*density_)(cell, sites_[i]) : cell.moments();
        if (cell.empty()) {
            const Rng rng(seed_, 1 + iteration);
            const double x = rng.uniform(2 * std::uint64_t{order_[i]});
            const double y = rng.uniform(2 * std::uint64_t{order_[i]} + 1);
            return {planar_.sides.x * x, planar_.sides.y * y};
        }
        if (!(moments.mass > 0)) return sites_[i];
        const Vec2 at{sites_[i].x + moments.first.x / moments.mass,
                      sites_[i].y + moments.first.y / moments.mass};
        return sites_.inside(at);
    }

    const Planar& planar_;
    const std::optional<DensityMoments>& density_;
    std::uint64_t seed_;
    const RunContext& run_;
    std::vector<std::uint32_t> order_;  ///< site i is point order_[i]
    std::vector<Vec2> next_;
    PeriodicVoronoi sites_;
};

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    const PlanarStart start = planar_start(plan, options, 100, "Lloyd's relaxation", run);
    const auto square = [](double value) { return value * value; };
    const auto moments = planar_moments(start.density, square, start.planar, run);
    Lloyd lloyd(start.planar, start.rows, moments, plan.seed, run);
    const auto steps = static_cast<std::uint64_t>(options[iterations]);
    run.tick(0, 1);
    for (std::uint64_t i = 0; i < steps; ++i) {
        lloyd.iterate(i);
        run.tick(i + 1, steps);
    }
    run.tick(1, 1);
    return planar_points(plan, start.planar, lloyd.rows());
}

}  // namespace

Generator unit() {
    return {.name = "lloyd",
            .summary = "Centroidal Voronoi relaxation: every point in the middle of its cell",
            .source = "Lloyd 1982, doi:10.1109/TIT.1982.1056489",
            .traits = planar_traits,
            .options = Schema(iterations, planar::initial, from, density_option, invert_option,
                              torus_option, bounded_option),
            .aliases = {"cvt", "centroidal-voronoi"},
            .plan = planar_plan,
            .set = make,
            .uses_seed = planar::uses_seed};
}

}  // namespace stipple::generators::lloyd
