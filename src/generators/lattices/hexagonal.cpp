// SPDX-License-Identifier: MIT
//
// Hexagonal (triangular) lattice of exactly n points in the unit square or in a box: of all
// lattices of n points the one with the largest minimum distance on the torus (opposite edges
// joined). Points that do not form a lattice may be farther apart: in the square this is so for
// n = 3, 4, 6, 7 and 8.
//
// No lattice of the square torus is perfectly hexagonal, which would give the minimum distance
// sqrt(2 / (sqrt(3) n)). The distance here is smaller by a fraction that depends on n: 24 % for
// n = 3, on average 6 % below 100 points and 2 % below 1000, and at most 7.3 % from 100 points on,
// 3.2 % from 2000, 0.4 % from 10^5; always less than 2.1 / sqrt(n). Rows of the lattice are not
// along the axes in general.
//
// Shape   2 dimensions, n <= 2^40.
// Cost    O(n), and O(sqrt(n) log n) once, to find the lattice (math/geometry/torus_packing.hpp).
// Promise points are distinct, and closed under addition modulo 1; the origin is the first, and y
//         does not fall from point to point. Coordinates are correctly rounded, and below 1.
// Source  the bound: J. L. Lagrange 1773; A. Thue 1910 (for any points in the plane).

#include "generators/box_space.hpp"
#include "generators/generator.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/geometry/torus_packing.hpp"

namespace stipple::generators::hexagonal {
namespace {

Plan plan(const Request& request, const Values&) { return plan_in_proportion(request); }

TorusPacking packing_of(const Plan& plan) {
    const auto sides = proportions_of(plan);
    return sides.empty() ? densest_torus_packing(plan.count)
                         : densest_torus_packing(plan.count, sides[0] / sides[1]);
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values&, const RunContext&) {
    const TorusPacking packing = packing_of(plan);
    const std::uint64_t gap = plan.count / packing.row_points;  // spacing within a row, in 1/n
    return sequence_of([packing, gap, box = plan.bounds, n = static_cast<double>(plan.count)](
                           std::uint64_t first, std::span<double> rows) {
        std::uint64_t row = first / packing.row_points;
        std::uint64_t column = first % packing.row_points;
        auto start = static_cast<std::uint64_t>(Wide{row} * packing.shift % gap);
        for (std::size_t k = 0; k < rows.size(); k += 2) {
            rows[k] = static_cast<double>(start + column * gap) / n;
            rows[k + 1] = static_cast<double>(row * packing.row_points) / n;
            if (++column < packing.row_points) continue;
            column = 0;
            ++row;
            start += packing.shift;
            if (start >= gap) start -= gap;
        }
        if (box) scale_into(*box, rows);
    });
}

}  // namespace

Generator unit() {
    return {.name = "hexagonal",
            .summary =
                "Hexagonal lattice: the lattice of n points with the largest minimum distance on "
                "the torus, also in a box",
            .source = "Standard construction; the densest lattice of n points, by search",
            .related = {"honeycomb"},
            .traits = {.min_dimension = 2,
                       .max_dimension = 2,
                       .prefix = false,
                       .seeded = false,
                       .boxed = true,
                       .max_index = std::uint64_t{1} << 40},
            .options = Schema(),
            .aliases = {"hex", "triangular"},
            .stream_version = 2,
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::hexagonal
