// SPDX-License-Identifier: MIT
#include "math/neighbors/grid_nearest.hpp"

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple {
namespace {

constexpr double points_in_cell = 2;

/// Limit of the mean number of points in a point's own cell, including itself. This mean is 3 for
/// random points; a tree becomes faster if it is about 30.
constexpr double crowded = 24;

/// Side of cubes such that `cells` of them fill the box. Flat directions have one layer.
double side_of_cells(const Box& box, double cells) {
    std::vector<double> sides;
    for (std::size_t k = 0; k < box.dimension(); ++k) sides.push_back(box.extent(k));
    std::ranges::sort(sides);
    double side = 0;
    for (std::size_t flat = 0; flat < sides.size(); ++flat) {
        double logarithm = -stipple::logarithm(cells);
        for (std::size_t k = flat; k < sides.size(); ++k) logarithm += stipple::logarithm(sides[k]);
        side = exponential(logarithm / static_cast<double>(sides.size() - flat));
        if (side > 0 && side <= sides[flat]) break;
    }
    return side;
}

template <std::size_t D>
Neighbor nearest_of(const SortedPoints<D>& points, std::size_t s, double radius) {
    Neighbor best{std::numeric_limits<double>::infinity(), KdTree::none};
    for (; best.index == KdTree::none; radius *= 2)
        points.visit(points[s], radius, [&](std::size_t other, double squared) {
            const Neighbor found{squared, points.original(other)};
            if (found < best && other != s) best = found;
        });
    return best;
}

template <std::size_t D>
std::optional<std::vector<Neighbor>> find_all(std::span<const double> rows, const Box& box,
                                              bool torus, const RunContext& run) {
    const auto n = static_cast<double>(rows.size() / D);
    const double side = side_of_cells(box, n / points_in_cell);
    if (!(side > 0 && side < std::numeric_limits<double>::infinity())) return std::nullopt;
    const SortedPoints<D> points(GridFrame<D>(box, torus, side, n), rows, run);
    if (points.mean_occupancy() > crowded) return std::nullopt;
    std::vector<Neighbor> found(points.count());
    const double guess = 0.75 * side;
    for_each_block(run, points.count(), 4096, [&](const Block& b) {
        for (std::size_t s = b.first; s < b.last; ++s)
            found[points.original(s)] = nearest_of(points, s, guess);
    });
    return found;
}

}  // namespace

std::optional<std::vector<Neighbor>> all_nearest_by_grid(std::span<const double> rows,
                                                         const Box& box, bool torus,
                                                         const RunContext& run) {
    const std::size_t d = box.dimension();
    if (d > 3 || rows.size() / d >= std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
    for (std::size_t k = 0; k < d; ++k)  // refuses sides whose squares would vanish or overflow
        if (const double x = box.extent(k); x != 0 && !(x > 1e-140 && x < 1e140))
            return std::nullopt;
    return with_dimension<3>(d,
                             [&]<std::size_t D>() { return find_all<D>(rows, box, torus, run); });
}

}  // namespace stipple
