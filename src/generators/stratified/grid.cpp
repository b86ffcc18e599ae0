// SPDX-License-Identifier: MIT
//
// Regular grid of k_1 x ... x k_d points, the first coordinate fastest. In a direction of k points
// the j-th (j = 0, ..., k - 1) is at
//
//     (2 j + 1) / (2 k)    the centre of its cell, or    j / k    its lower corner.
//
// Shape   n = k^d, or any shape k_1 x ... x k_d whose product is n <= 2^53.
// Cost    O(n d).
// Promise every coordinate is correctly rounded, and below 1.

#include "generators/generator.hpp"
#include "generators/stratified/stratified.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/geometry/lattice.hpp"

namespace stipple::generators::grid {
namespace {

constexpr Param<Extents> shape{
    {.name = "shape",
     .unit = "points",
     .help = "Number of points in each direction, such as 40x25; gives count and dimension. "
             "Without it, the count is k^dimension"}};
constexpr Param<Choice> cell{.name = "cell",
                             .fallback = "center",
                             .choices = "center|corner",
                             .help = "Position of a point in its cell"};

/// Fills one coordinate of `length` points: of cells first, first + step, ... of k cells.
void place(double* x, std::size_t stride, bool centered, std::uint64_t first, std::size_t length,
           std::uint64_t step, std::uint64_t k) {
    const std::uint64_t scale = centered ? 2 : 1;
    const std::uint64_t numerator = scale * first + (centered ? 1 : 0);
    if (step > 0) return fill_ratios(numerator, scale * step, scale * k, length, x, stride);
    const double value = ratio(numerator, scale * k);
    for (std::size_t j = 0; j < length; ++j) x[j * stride] = value;
}

Plan plan(const Request& request, const Values& options) {
    if (options.given(shape)) return plan_of_shape(request, options[shape], "points");
    return plan_of_cubes(request, "grid");
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const auto sides = sides_of(plan, options[shape], "grid");
    return sequence_of([sides, centered = options[cell] == "center"](std::uint64_t first,
                                                                     std::span<double> rows) {
        const std::size_t d = sides.size();
        for_each_lattice_row(
            sides, first, rows.size() / d, [&](auto start, std::size_t offset, std::size_t length) {
                double* row = rows.data() + offset * d;
                for (std::size_t k = 0; k < d; ++k)
                    place(row + k, d, centered, start[k], length, k == 0 ? 1 : 0, sides[k]);
            });
    });
}

}  // namespace

Generator unit() {
    return {.name = "grid",
            .summary = "Regular grid: k^d points, or another number along each axis",
            .source = "Standard construction",
            .related = {"uniform-grid"},
            .traits = {.prefix = false, .seeded = false},
            .options = Schema(shape, cell),
            .aliases = {"regular", "regular-grid"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::grid
