// SPDX-License-Identifier: MIT
//
// Power cells of equal mass: for given sites, the weights w with
//
//     m_i(w) = integral of rho over cell i = total / n    for all i,
//
// which are those of the optimal transport from rho to the sites. They are found by Newton's
// method: the derivative of the masses is a Laplacian on the graph of neighbours,
//
//     dm_i / dw_j = -(integral of rho along the edge of i and j) / (2 |x_i - x_j|),
//
// whose systems are solved by conjugate gradients. A step is halved until every cell has at least
// half of the previous minimum mass, and the fraction t of the step reduces the masses' error by
// the factor 1 - t / 2 or more; then the method converges from any weights for which all masses are
// positive.
//
// Cost    a Newton step: 2 us a cell to cut it, and 50 ns a cell and iteration of the gradients,
//         about n^(1/2) iterations.
// Promise the same bits for any number of threads.
// Source  F. Aurenhammer, F. Hoffmann, B. Aronov, Algorithmica 20 (1998) 61-76 (the weights);
//         J. Kitagawa, Q. Merigot, B. Thibert, J. Eur. Math. Soc. 21 (2019) 2603-2651,
//         doi:10.4171/JEMS/889 (damping).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "generators/blue_noise/planar_start.hpp"
#include "math/neighbors/periodic_voronoi.hpp"
#include "media/density_moments.hpp"
#include "stipple/run.hpp"

namespace stipple {

class EqualCells {
  public:
    /// Two neighbours, and the flow of mass between them per difference of their weights.
    struct Bond {
        std::uint32_t a;
        std::uint32_t b;
        double conductance;
    };

    /// Cells of sites at `rows`. The density must outlive the cells; without a density, rho = 1.
    EqualCells(const Planar& planar, const std::optional<DensityMoments>& density,
               const std::vector<double>& rows, const RunContext& run);

    /// Finds the weights, starting from the current ones, or from 0 if a site has lost its cell.
    /// Sites that have no mass even then move to their rows of `rescue`. Returns the largest error
    /// |m_i n / total - 1|, which exceeds `tolerance` only after `steps` steps or by rounding.
    double equalize(double tolerance, std::span<const double> rescue, std::size_t steps = 1000);

    void move_to_centroids();
    void move(std::size_t i, Vec2 to) { sites_.move(i, sites_.inside(to)); }

    [[nodiscard]] std::size_t count() const { return sites_.count(); }
    [[nodiscard]] Vec2 operator[](std::size_t i) const { return sites_[i]; }
    [[nodiscard]] const PeriodicVoronoi& sites() const { return sites_; }
    [[nodiscard]] std::span<const double> weights() const { return weights_; }

    /// Moments of the cells about their sites, for the weights found last.
    [[nodiscard]] std::span<const CellMoments> moments() const { return moments_; }
    [[nodiscard]] std::span<const Bond> bonds() const { return bonds_; }

  private:
    void measure();
    void measure_cell(std::size_t i, VoronoiCell& cell, std::vector<Bond>& bonds);
    [[nodiscard]] double worst() const;
    [[nodiscard]] double error() const;
    [[nodiscard]] double least_mass() const;
    void revive(std::span<const double> rescue);
    [[nodiscard]] std::vector<double> newton_step() const;
    bool try_steps(const std::vector<double>& step);

    const std::optional<DensityMoments>& density_;
    RunContext run_;
    PeriodicVoronoi sites_;
    double share_;  ///< mass that each cell should have
    std::vector<double> weights_;
    std::vector<CellMoments> moments_;
    std::vector<Bond> bonds_;
};

}  // namespace stipple
