// SPDX-License-Identifier: MIT
#include "experiments/quality/design_criteria.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyzers/distances/distances.hpp"
#include "core/parallel.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::analyzers {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

Distances straight_in_cube(std::size_t dimension) {
    return {.torus = false, .box = unit_cube(dimension)->bounding_box()};
}

/// Projection of points to some axes.
PointSet projected(const PointSet& points, const std::vector<std::size_t>& axes) {
    PointSet image(points.count(), axes.size());
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < axes.size(); ++k) image[i][k] = points[i][axes[k]];
    return image;
}

/// Sums over pairs of points.
struct PairSums {
    double powers = 0;       ///< terms (minimum / distance)^p
    double reciprocals = 0;  ///< terms 1 / distance^2
    /// Terms 1 / prod (4 difference)^2; the factor 4 keeps the product in range.
    double products = 0;

    PairSums& operator+=(const PairSums& other) {
        powers += other.powers;
        reciprocals += other.reciprocals;
        products += other.products;
        return *this;
    }
};

}  // namespace

Separation separation_of(const PointSet& points, const RunContext& run) {
    const auto neighbors = nearest_neighbors(points, straight_in_cube(points.dimension()), run);
    const auto n = static_cast<double>(neighbors.size());
    double mean = 0;
    for (const Neighbor& near : neighbors) mean += std::sqrt(near.squared) / n;
    double squares = 0;
    for (const Neighbor& near : neighbors) {
        const double deviation = std::sqrt(near.squared) - mean;
        squares += deviation * deviation / n;
    }
    return {std::sqrt(closest_pair(neighbors).second.squared),
            mean > 0 ? std::sqrt(squares) / mean : 0};
}

PairCriteria pair_criteria(const PointSet& points, double p, double minimum,
                           const RunContext& run) {
    constexpr std::uint64_t size = 16;
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    const double* x = points.flat().data();
    std::vector<PairSums> parts(block_count(n, size));
    for_each_block(run, n, size, [&](const Block& block) {
        PairSums sums;
        for (std::size_t i = block.first; i < block.last; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                double squared = 0;
                double product = 1;
                for (std::size_t k = 0; k < d; ++k) {
                    const double difference = x[i * d + k] - x[j * d + k];
                    squared += difference * difference;
                    product *= 4 * difference;
                }
                const double ratio = minimum * minimum / squared;
                sums += {real_power(ratio, p / 2), 1 / squared, 1 / (product * product)};
            }
        parts[block.index] = sums;
    });
    PairSums all;
    for (const PairSums& part : parts) all += part;
    const auto pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    return {minimum > 0 ? real_power(all.powers, 1 / p) / minimum : infinite,
            minimum > 0 ? all.reciprocals : infinite,
            std::isfinite(all.products)
                ? 16 * real_power(all.products / pairs, 1 / static_cast<double>(d))
                : infinite};
}

std::optional<Correlation> correlation_of(const PointSet& points) {
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    std::vector<std::size_t> axes;
    std::vector<std::vector<double>> columns;  // centred and of length 1
    for (std::size_t k = 0; k < d; ++k) {
        std::vector<double> column(n);
        double mean = 0;
        for (std::size_t i = 0; i < n; ++i)
            mean += (column[i] = points[i][k]) / static_cast<double>(n);
        const auto [low, high] = std::ranges::minmax(column);
        if (low == high) continue;
        double squares = 0;
        for (double& c : column) squares += (c - mean) * (c - mean);
        for (double& c : column) c = (c - mean) / std::sqrt(squares);
        axes.push_back(k);
        columns.push_back(std::move(column));
    }
    if (axes.size() < 2) return std::nullopt;
    Correlation found{.largest = {-1, {}}};
    double squares = 0;
    for (std::size_t a = 1; a < axes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) sum += columns[a][i] * columns[b][i];
            squares += sum * sum;
            if (std::abs(sum) > found.largest.value)
                found.largest = {std::abs(sum), {axes[b], axes[a]}};
        }
    found.rms = std::sqrt(squares / (0.5 * static_cast<double>(axes.size() * (axes.size() - 1))));
    return found;
}

AtAxes closest_on_axis(const PointSet& points) {
    AtAxes closest{infinite, {}};
    std::vector<double> column(points.count());
    for (std::size_t k = 0; k < points.dimension(); ++k) {
        for (std::size_t i = 0; i < column.size(); ++i) column[i] = points[i][k];
        std::ranges::sort(column);
        for (std::size_t i = 1; i < column.size(); ++i)
            if (column[i] - column[i - 1] < closest.value)
                closest = {column[i] - column[i - 1], {k}};
    }
    return closest;
}

AtAxes closest_on_plane(const PointSet& points, const RunContext& run) {
    AtAxes closest{infinite, {}};
    for (std::size_t a = 1; a < points.dimension(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            run.check_stop();
            const auto neighbors =
                nearest_neighbors(projected(points, {b, a}), straight_in_cube(2), silent(run));
            const double distance = std::sqrt(closest_pair(neighbors).second.squared);
            if (distance < closest.value) closest = {distance, {b, a}};
        }
    return closest;
}

}  // namespace stipple::analyzers
