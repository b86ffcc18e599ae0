// SPDX-License-Identifier: MIT
//
// Histogram of the distances from each point to its nearest neighbour, with the density for
// independent uniform points:
//
//     p(r) = d v_d rho r^(d-1) exp(-rho v_d r^d)
//
// where v_d is the volume of the unit ball and rho = n / V. On a logarithmic axis, the density is
// that of ln r, r p(r).
//
// Source  P. Hertz, Math. Ann. 67 (1909) 387-398, doi:10.1007/BF01450410.

#include "plot/points_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "analyzers/distances/distances.hpp"
#include "core/error.hpp"

namespace stipple::plot {
namespace {

std::vector<double> nearest_distances(const PointSet& set, bool& torus, const RunContext& run) {
    if (set.count() < 2) fail(ErrorKind::input, "a single point has no nearest neighbour");
    const auto distances = analyzers::distances_of(set, without_domain(set) ? "euclidean" : "");
    torus = distances.torus;
    std::vector<double> found;
    for (const Neighbor& neighbor : analyzers::nearest_neighbors(set, distances, run))
        found.push_back(std::sqrt(neighbor.squared));
    return found;
}

/// Density of the distances, or of their logarithms, for independent uniform points. Empty if
/// typical distances exceed half the shortest side of the domain's box, or if the domain is not
/// known.
Guide random_distances(const PointSet& set, double least, double largest, bool log) {
    const double volume = set.domain->measure();
    if (without_domain(set) || !std::isfinite(volume) || !(volume > 0)) return {};
    const auto d = static_cast<double>(set.dimension());
    const double ball = std::pow(std::numbers::pi, d / 2) / std::tgamma(d / 2 + 1);
    const double rate = ball * static_cast<double>(set.count()) / volume;
    const double usual = std::pow(1 / rate, 1 / d);
    if (2 * usual > analyzers::shortest_side(set.domain->bounding_box())) return {};
    constexpr int steps = 200;
    Guide guide{.name = "independent uniform points"};
    for (int k = 0; k <= steps; ++k) {
        const double along = static_cast<double>(k) / steps;
        const double r = log ? least * std::pow(largest / least, along) : largest * along;
        guide.x.push_back(r);
        guide.y.push_back(d * rate * std::pow(r, log ? d : d - 1) *
                          std::exp(-rate * std::pow(r, d)));
    }
    return guide;
}

}  // namespace

Chart distance_chart(std::span<const PointSet* const> sets, const std::vector<std::string>& names,
                     bool log, const RunContext& run) {
    std::vector<std::vector<double>> all;
    double largest = 0;
    bool torus = false;
    for (const PointSet* set : sets) {
        all.push_back(nearest_distances(*set, torus, run));
        largest = std::max(largest, *std::ranges::max_element(all.back()));
    }
    if (!(largest > least_shown))
        fail(ErrorKind::input,
             "all distances to the nearest neighbour are 0, or below {}: there is nothing to draw",
             least_shown);
    largest *= 1.08;
    ChartPanel panel{.x_name = torus ? "distance to the nearest neighbour (torus)"
                                     : "distance to the nearest neighbour",
                     .y_name = log ? "density of ln distance" : "density",
                     .log_x = log,
                     .from_zero = true};
    const double least = log ? keep_positive(all, panel).first : 0;
    for (std::size_t s = 0; s < sets.size(); ++s) {
        const double bins = std::ceil(2.5 * std::cbrt(static_cast<double>(sets[s]->count())));
        panel.bars.push_back(histogram_of(
            all[s], least, largest, static_cast<std::size_t>(std::clamp(bins, 5.0, 200.0)), log));
        panel.bars.back().name = names[s];
    }
    if (Guide guide = random_distances(*sets[0], least, largest, log); !guide.x.empty())
        panel.guides.push_back(std::move(guide));
    Chart chart{.title = "Nearest distances"};
    chart.panels.push_back(std::move(panel));
    return chart;
}

}  // namespace stipple::plot
