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

#include "core/error.hpp"
#include "generators/generator.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/ratio.hpp"
#include "math/geometry/lattice.hpp"

namespace stipple::generators::grid {
namespace {

constexpr Param<Extents> shape{{.name = "shape",
                                .unit = "points",
                                .help = "Points in each direction, such as 40x25; gives count and "
                                        "dimension. Without it: count = k^dimension"}};
constexpr Param<Choice> cell{.name = "cell",
                             .fallback = "center",
                             .choices = "center|corner",
                             .help = "Where in its cell a point is"};

class Grid final : public Sequence {
  public:
    Grid(std::vector<std::uint64_t> sides, bool centered)
        : shape_(std::move(sides)), centered_(centered) {}

    void fill(std::uint64_t first, std::span<double> rows) override {
        const std::size_t d = shape_.size();
        for_each_lattice_row(shape_, first, rows.size() / d,
                             [&](auto start, std::size_t offset, std::size_t length) {
                                 double* row = rows.data() + offset * d;
                                 place(row, start[0], length, 1, shape_[0]);
                                 for (std::size_t k = 1; k < d; ++k)
                                     place(row + k, start[k], length, 0, shape_[k]);
                             });
    }

  private:
    /// One coordinate of a row: cells first, first + step, ... of k.
    void place(double* x, std::uint64_t first, std::size_t length, int step,
               std::uint64_t k) const {
        const std::uint64_t numerator = centered_ ? 2 * first + 1 : first;
        const std::uint64_t denominator = centered_ ? 2 * k : k;
        const int stride = centered_ ? 2 * step : step;
        const std::size_t d = shape_.size();
        if (step == 0) {
            const double value = ratio(numerator, denominator);
            for (std::size_t j = 0; j < length; ++j) x[j * d] = value;
        } else if (denominator > exact_limit) {
            for (std::size_t j = 0; j < length; ++j)
                x[j * d] = ratio(numerator + static_cast<std::uint64_t>(stride) * j, denominator);
        } else {
            const auto begin = static_cast<double>(numerator);
            const auto whole = static_cast<double>(denominator);
            for (std::size_t j = 0; j < length; ++j)
                x[j * d] = (begin + stride * static_cast<double>(j)) / whole;
        }
    }

    std::vector<std::uint64_t> shape_;
    bool centered_;
};

/// The plan that a given shape implies; count and dimension may say the same again.
Plan plan_shape(const Request& request, const std::vector<std::int64_t>& sides) {
    std::uint64_t count = 1;
    for (const std::int64_t k : sides)
        if (__builtin_mul_overflow(count, static_cast<std::uint64_t>(k), &count))
            fail(ErrorKind::usage, "--shape: {} has more than 2^64 points",
                 format_value(Value(sides)));
    if (request.count.value_or(count) != count)
        fail(ErrorKind::usage, "--count: {} contradicts --shape {}, which has {} points",
             *request.count, format_value(Value(sides)), count);
    if (request.dimension.value_or(sides.size()) != sides.size())
        fail(ErrorKind::usage, "--dimension: {} contradicts --shape {}, which has {} directions",
             *request.dimension, format_value(Value(sides)), sides.size());
    return default_plan(request, count, sides.size());
}

Plan plan(const Request& request, const Values& options) {
    if (options.given(shape)) return plan_shape(request, options[shape]);
    const std::size_t dimension = request.dimension.value_or(2);
    const Plan plan = default_plan(request, nearest_power(1024, dimension), dimension);
    exact_root(plan.count, dimension, "grid");
    return plan;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    std::vector<std::uint64_t> sides;
    if (options.given(shape))
        for (const std::int64_t k : options[shape]) sides.push_back(static_cast<std::uint64_t>(k));
    else
        sides.assign(plan.dimension, exact_root(plan.count, plan.dimension, "grid"));
    return std::make_unique<Grid>(std::move(sides), options[cell] == "center");
}

}  // namespace

Generator unit() {
    return {.name = "grid",
            .summary = "Regular grid of k^d points, or of any shape",
            .source = "Standard construction",
            .traits = {.prefix = false, .seeded = false},
            .options = Schema(shape, cell),
            .aliases = {"regular", "regular-grid"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::grid
