// SPDX-License-Identifier: MIT
//
// L2 discrepancies of points in any dimension from the sum over all pairs of points:
//
//     D^2 = C - 2/n sum_i prod_j f_j(x_ij) + n^-2 sum_ik prod_j K_j(x_ij, x_kj)
//
// with f_j the mean of K_j(x, .) and C the product of the means of f_j. Rounding errors are
// compensated: every factor and product is a double with an error term, and only the error terms
// are rounded. So all but a fraction of 2^-80 of the sum over pairs may cancel.
//
// On each axis K is one of these, times a constant, with t = |x - y|, a constant a, and numbers g_x
// and h_x of the point x:
//
//     min(g_x, g_y)                     star, modified; product of two: extreme, centered
//     a + t (t - 1)                     periodic, wraparound, diaphony
//     h_x + h_y + t (t - 3/2)           mixture
//     a - t                             average, symmetric
//     a + min(x, y) min(1 - x, 1 - y)   extreme with weights
//
// Coordinates that are not multiples of 2^-53 also have an error term. Factors are scaled by powers
// of two so that the largest product of a point with itself stays near 1 after each axis. No other
// product is larger, because these kernels are positive definite.
//
// Shape   n x d points in [0, 1].
// Cost    n^2 d / 2 factors, fewer if blocks of points are separated on an axis. On one core with
//         512-bit vectors each takes 0.25 ns for the star kernel, 0.2 for the centered one (1.5
//         times as long if coordinates are not multiples of 2^-53), 0.6 for the wraparound and 0.75
//         for the mixture one; with 256-bit vectors twice as long. Needs a fused multiply-add
//         instruction.
// Promise the same result for any number of threads and any vector width. `error` bounds the
//         rounding errors.
// Source  T. Ogita, S. M. Rump, S. Oishi, SIAM J. Sci. Comput. 26 (2005) 1955-1988,
//         doi:10.1137/030601818 (compensated sums); S. Graillat, IEEE Trans. Comput. 58 (2009)
//         994-1000 (products).

#include "math/l2/squares.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/l2/axis_factor.hpp"
#include "math/l2/block_pairs.hpp"

namespace stipple::l2 {
namespace {

/// Per-point terms of one axis factor.
struct PointNumbers {
    double position;  ///< on the axis; a multiple of 2^-53 if the factor depends on distances
    double rest;      ///< remainder of the position
    DoubleDouble value;
};

/// Nearest multiple of 2^-53.
double whole(double x) { return std::round(x * 0x1p53) * 0x1p-53; }

/// Moves digits into the low part, so that the high part is a multiple of `step`.
DoubleDouble on_grid(const DoubleDouble& a, double step) {
    const double high = std::round(a.high / step) * step;
    return {high, (a.high - high) + a.low};
}

/// Computes an axis factor, divided by a constant scale, from terms of both points.
class FactorForm {
  public:
    /// @param two_sided true if the two minima of the centered kernel form one factor
    FactorForm(Kind kind, bool alone, bool two_sided, double weight)
        : kind_(kind), alone_(alone), two_sided_(two_sided) {
        // A kernel that depends on the distance t is s00 + sigma t + ..., in units of 1/48.
        const AxisKernel& kernel = record_of(kind).kernel;
        const double steep = is_of_distance() ? -static_cast<double>(kernel.sigma) / 48 : 1;
        const Quad curve = scale_of(kind) * steep * weight;
        inverse_ = alone ? Quad(0) : Quad(1) / curve;
        scale_ = curve;
        if (kind == Kind::centered) scale_ *= curve;
        if (kind == Kind::mixture) scale_ /= 2;
        if (is_of_distance()) base_ = inverse_ + Quad(kernel.s00) / -kernel.sigma - reach();
        if (kind == Kind::extreme) base_ = inverse_;
        if (kind == Kind::mixture) {
            base_ = inverse_ + Quad(7) / 8 - Quad(9) / 32;
            const double twice = 2 * static_cast<double>(base_);
            step_ = std::ldexp(1.0, std::ilogb(twice) - 52);
        }
        top_ = to_double_double(kind == Kind::centered  ? Quad(inverse_ + 0.5)
                                : kind == Kind::mixture ? Quad(base_ + 0.25)
                                                        : Quad(inverse_ + 1));
        bottom_ = to_double_double(kind == Kind::mixture ? Quad(base_ - 0.25) : inverse_);
    }

    [[nodiscard]] const Quad& scale() const { return scale_; }
    [[nodiscard]] bool is_bernoulli() const {
        return kind_ == Kind::periodic || kind_ == Kind::wraparound || kind_ == Kind::diaphony;
    }
    [[nodiscard]] bool is_linear() const {
        return kind_ == Kind::average || kind_ == Kind::symmetric;
    }
    [[nodiscard]] bool is_of_distance() const { return is_bernoulli() || is_linear(); }
    [[nodiscard]] bool is_two_sided() const { return two_sided_; }
    [[nodiscard]] bool is_one_plus_minima() const { return kind_ == Kind::extreme && !alone_; }
    [[nodiscard]] bool is_from_vertex() const { return is_of_distance() || kind_ == Kind::mixture; }

    /// Number of factors on the axis.
    [[nodiscard]] std::size_t factors() const {
        const bool two = kind_ == Kind::centered || (kind_ == Kind::extreme && alone_);
        return two && !two_sided_ ? 2 : 1;
    }

    /// Upper bound on the factors divided by the scale.
    [[nodiscard]] double most() const {
        if (kind_ == Kind::mixture) return static_cast<double>(2 * inverse_ + Quad(7) / 4);
        if (is_of_distance()) return static_cast<double>(base_) + reach();
        const auto one = static_cast<double>(inverse_ + 1);
        return factors() == 2 ? one * one : one;
    }

    /// Number added to a factor and subtracted again, to keep intermediate sums away from 0.
    [[nodiscard]] double offset() const {
        const bool small =
            (is_of_distance() && base_ < reach()) || (is_one_plus_minima() && base_ < Quad(0.5));
        return small ? 1 : 0;
    }

    /// True if factors may come near 0: their errors are then relative to the largest factor.
    [[nodiscard]] bool may_vanish() const { return is_of_distance() && offset() != 0; }

    /// Bound on intermediate numbers relative to the factor; 0 if none can be much larger.
    [[nodiscard]] double cancellation() const {
        return is_one_plus_minima() ? static_cast<double>(1 / base_) : 0;
    }

    [[nodiscard]] AxisConstants constants() const {
        AxisConstants axis;
        axis.vertex = vertex();
        if (!is_of_distance() && !is_one_plus_minima()) return axis;
        const DoubleDouble base = to_double_double(base_ + offset());
        axis.base = base.high;
        axis.base_error = base.low;
        axis.offset = offset();
        return axis;
    }

    /// Writes the terms of a point for each factor of the axis; returns the end of the output.
    PointNumbers* put(double x, PointNumbers* to) const {
        const auto write = [&](double position, const DoubleDouble& value) {
            const double at = is_from_vertex() ? whole(position) : position;
            *to++ = {at, position - at, value};
        };
        if (two_sided_) {
            write(x, {x - 0.5, 0.5 - x});
        } else if (is_of_distance()) {
            write(x, {0, 0});
        } else if (kind_ == Kind::extreme) {
            if (alone_) write(x, {x, 0});
            write(alone_ ? -x : x, DoubleDouble{1, 0} + DoubleDouble{-x, 0});
        } else if (kind_ == Kind::centered) {
            write(x, bottom_ + DoubleDouble{std::max(x - 0.5, 0.0), 0});
            write(-x, x < 0.5 ? top_ + DoubleDouble{-x, 0} : bottom_);
        } else if (kind_ == Kind::mixture) {
            write(x, on_grid(x < 0.5 ? bottom_ + DoubleDouble{x / 2, 0}
                                     : top_ + DoubleDouble{-x / 2, 0},
                             step_));
        } else {
            write(-x, top_ + DoubleDouble{-x, 0});
        }
        return to;
    }

    /// Approximate factor of a point with itself.
    [[nodiscard]] double diagonal(const PointNumbers& point) const {
        if (two_sided_) return 1 + std::abs(point.value.high);
        if (is_of_distance()) return static_cast<double>(base_) + reach();
        if (kind_ == Kind::mixture) return 2 * point.value.high + 0.5625;
        if (!is_one_plus_minima()) return point.value.high;
        return static_cast<double>(base_) + point.position * point.value.high;
    }

  private:
    /// Maximum of |factor - base_| for factors that depend on the distance t.
    [[nodiscard]] double reach() const { return is_linear() ? 0.5 : 0.25; }
    [[nodiscard]] double vertex() const { return kind_ == Kind::mixture ? 0.75 : 0.5; }

    Kind kind_;
    bool alone_;
    bool two_sided_;
    Quad inverse_;  ///< 1 / weight
    Quad scale_;
    Quad base_ = 0;
    double step_ = 0;
    DoubleDouble top_ = {};     ///< put() subtracts a coordinate or its half from it
    DoubleDouble bottom_ = {};  ///< put() adds a part of a coordinate to it
};

/// The axes whose weights count.
struct Axes {
    std::vector<std::size_t> places;
    std::vector<FactorForm> forms;
    std::vector<AxisFactor> terms;
};

/// Smaller weights change a square by less than its rounding error, but their inverses overflow.
constexpr double least_weight = 0x1p-1000;

Axes axes_of(std::size_t dimension, Kind kind, const AxisWeights& weights, bool two_sided) {
    const bool alone = is_kernel_alone(kind, weights);
    Axes axes;
    for (std::size_t j = 0; j < dimension; ++j) {
        const double weight = weight_of(weights, j);
        if (weight < least_weight) continue;
        axes.places.push_back(j);
        axes.forms.emplace_back(kind, alone, two_sided, weight);
        axes.terms.emplace_back(kind, alone, weight);
    }
    return axes;
}

/// True if the two minima of the centered kernel can be computed as one factor minus 1 without
/// rounding errors, and products need no scaling.
bool is_two_sided(const PointSet& points, Kind kind, const AxisWeights& weights) {
    constexpr std::size_t most_axes = 1500;  // 1.5^1500 is within the range of doubles
    if (kind != Kind::centered || points.dimension() > most_axes ||
        std::ranges::any_of(weights, [](double w) { return w != 1; }))
        return false;
    return std::ranges::all_of(points.flat(), [](double x) { return x == whole(x); });
}

/// A product that cannot overflow or underflow.
class LongProduct {
  public:
    void multiply(const DoubleDouble& factor) {
        constexpr int safe = 300;
        value_ = value_ * factor;
        const int exponent = value_.high == 0 ? 0 : std::ilogb(value_.high);
        if (std::abs(exponent) < safe) return;
        value_ = {std::ldexp(value_.high, -exponent), std::ldexp(value_.low, -exponent)};
        exponent_ += exponent;
    }
    [[nodiscard]] Quad value() const { return ldexp(Quad(value_.high) + value_.low, exponent_); }

  private:
    DoubleDouble value_{1, 0};
    int exponent_ = 0;
};

/// Mean of an axis's factor over one point, as a function of the other's coordinate.
class Mean {
  public:
    explicit Mean(const AxisFactor& axis) {
        std::ranges::transform(axis.mean, of_.begin(), to_double_double);
    }

    [[nodiscard]] DoubleDouble at(double x) const {
        DoubleDouble mean = of_[0];
        if (of_[2].high != 0)
            mean = mean + (of_[1] + of_[2] * DoubleDouble{x, 0}) * DoubleDouble{x, 0};
        else if (of_[1].high != 0)
            mean = mean + of_[1] * DoubleDouble{x, 0};
        const DoubleDouble place = exact_sum(x, -0.5);
        const double sign = place.high < 0 ? -1 : 1;
        if (of_[3].high != 0)
            mean = mean + of_[3] * DoubleDouble{sign * place.high, sign * place.low};
        return mean;
    }

  private:
    std::array<DoubleDouble, 4> of_;
};

struct Numbers {
    std::vector<PointNumbers> of;
    std::size_t factors = 0;
    Quad means = 0;  ///< mean over the points of the product of the factors' means
};

Numbers numbers_of(const PointSet& points, const Axes& axes, const RunContext& run) {
    const std::vector<Mean> means(axes.terms.begin(), axes.terms.end());
    Numbers numbers;
    for (const FactorForm& form : axes.forms) numbers.factors += form.factors();
    numbers.of.resize(points.count() * numbers.factors);
    PointNumbers* to = numbers.of.data();
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (i % 256 == 0) run.check_stop();
        LongProduct mean;
        for (std::size_t j = 0; j < axes.places.size(); ++j) {
            const double x = points[i][axes.places[j]] + 0.0;
            to = axes.forms[j].put(x, to);
            mean.multiply(means[j].at(x));
        }
        numbers.means += mean.value();
    }
    numbers.means /= points.count();
    return numbers;
}

/// Powers of two that divide the factors, so that the largest product of a point with itself, and
/// hence every product, is at most about 1 after each factor.
struct Scaling {
    std::vector<int> exponents;  ///< even numbers, by factor
    double any_order = 0;        ///< any product of some of the factors is at most 2^any_order
    double growth = 0;           ///< product of the last k factors is at most 2^growth, for any k
};

Scaling scaling_of(const Numbers& numbers, const std::vector<const FactorForm*>& forms) {
    Scaling scaling;
    const std::size_t n = numbers.of.size() / numbers.factors;
    std::vector<double> sizes(n, 0);     // binary logarithms of scaled products
    std::vector<double> smallest(n, 0);  // minima of `sizes` so far
    for (std::size_t f = 0; f < numbers.factors; ++f) {
        double most = -std::numeric_limits<double>::infinity();
        double largest = most;
        for (std::size_t i = 0; i < n; ++i) {
            const double size = std::log2(forms[f]->diagonal(numbers.of[i * numbers.factors + f]));
            most = std::max(most, size);
            sizes[i] += size;
            largest = std::max(largest, sizes[i]);
        }
        const bool scaled = !forms[f]->is_two_sided() && std::isfinite(largest);
        const int exponent = scaled ? 2 * static_cast<int>(std::lround(largest / 2)) : 0;
        scaling.exponents.push_back(exponent);
        scaling.any_order += std::max(most - exponent, 0.0);
        for (std::size_t i = 0; i < n; ++i) {
            sizes[i] -= exponent;
            smallest[i] = std::min(smallest[i], sizes[i]);
        }
    }
    for (std::size_t i = 0; i < n; ++i)
        if (std::isfinite(sizes[i]))
            scaling.growth = std::max(scaling.growth, sizes[i] - smallest[i]);
    return scaling;
}

/// Halves points along an axis, and each half along the next, until they fit one block.
void halve(std::span<std::size_t> order, const PointSet& points, const Axes& axes, bool sides,
           std::size_t depth) {
    if (order.size() <= block_width) {
        std::ranges::sort(order);
        return;
    }
    const std::size_t axis = axes.places[depth % axes.places.size()];
    const auto at = [&](std::size_t i) { return points[i][axis]; };
    std::size_t middle = block_count(order.size(), block_width) / 2 * block_width;
    if (sides && depth < axes.places.size()) {
        const auto upper =
            std::partition(order.begin(), order.end(), [&](std::size_t i) { return at(i) < 0.5; });
        middle = static_cast<std::size_t>(upper - order.begin());
    } else {
        std::ranges::nth_element(
            order, order.begin() + static_cast<std::ptrdiff_t>(middle),
            [&](std::size_t i, std::size_t j) { return at(i) != at(j) ? at(i) < at(j) : i < j; });
    }
    halve(order.first(middle), points, axes, sides, depth + 1);
    halve(order.subspan(middle), points, axes, sides, depth + 1);
}

/// Order of the points in which blocks are separated on as many axes as possible. Sets are halved
/// along one axis after the other; if `sides`, the first cut on each axis is at 1/2.
std::vector<std::size_t> block_order(const PointSet& points, const Axes& axes, bool sides) {
    std::vector<std::size_t> order(points.count());
    std::iota(order.begin(), order.end(), std::size_t{0});
    halve(order, points, axes, sides, 0);
    return order;
}

PairForm form_of(const FactorForm& form, Kind kind) {
    if (form.is_two_sided()) return PairForm::two_sided;
    if (form.is_one_plus_minima()) return PairForm::one_plus_minima;
    if (kind == Kind::mixture) return PairForm::mixture;
    if (form.is_linear()) return PairForm::linear;
    return form.is_bernoulli() ? PairForm::bernoulli : PairForm::minimum;
}

/// Factor by which positions are multiplied so that the form's factors are multiplied by root^2.
double scale_of_distance(PairForm form, double root) {
    return form == PairForm::linear ? root * root : root;
}

/// Columns of a point in a form's kernel; unused ones are at the end.
std::array<double, 4> columns_of(PairForm form, const PointNumbers& point, double root) {
    const double value = root * root * point.value.high;
    const double error = root * root * point.value.low;
    if (form == PairForm::two_sided) return {value, error};
    if (form == PairForm::minimum || form == PairForm::one_plus_minima)
        return {point.position, value, error};
    const double along = scale_of_distance(form, root);
    return {along * point.position, along * point.rest, value, error};
}

struct Factors {
    std::vector<const FactorForm*> forms;
    std::vector<AxisConstants> constants;
};

Factors factors_of(const Axes& axes) {
    Factors factors;
    for (const FactorForm& form : axes.forms) {
        factors.forms.insert(factors.forms.end(), form.factors(), &form);
        factors.constants.insert(factors.constants.end(), form.factors(), form.constants());
    }
    return factors;
}

/// Products up to 2^safe_digits cannot overflow, and hardly magnify digits lost by underflow.
constexpr double safe_digits = 850;

BlockTable table_of(PairForm form, const Numbers& numbers, const Scaling& scaling,
                    std::vector<AxisConstants> constants, const std::vector<std::size_t>& order) {
    std::vector<double> roots;
    for (std::size_t f = 0; f < numbers.factors; ++f) {
        const double root = std::ldexp(1.0, -scaling.exponents[f] / 2);
        AxisConstants& axis = constants[f];
        axis = {root * root * axis.base, root * root * axis.base_error, root * root * axis.offset,
                scale_of_distance(form, root) * axis.vertex};
        roots.push_back(root);
    }
    BlockTable table(form, order.size(), std::move(constants), scaling.any_order <= safe_digits);
    for (std::size_t i = 0; i < order.size(); ++i)
        for (std::size_t f = 0; f < numbers.factors; ++f) {
            const PointNumbers& point = numbers.of[order[i] * numbers.factors + f];
            table.put(i, f, columns_of(form, point, roots[f]).data(), point.position + point.rest);
        }
    return table;
}

/// Combined data of the axes' factors.
struct AxisProducts {
    Quad total = 1;  ///< mean over both points of the products
    Quad scale = 1;  ///< multiplies the sum over pairs of scaled products
    Quad most = 1;   ///< upper bound on all products
    double cancellation = 0;
    bool may_vanish = false;
};

AxisProducts products_of(const Axes& axes, const Scaling& scaling) {
    AxisProducts of;
    for (std::size_t j = 0, f = 0; j < axes.places.size(); ++j) {
        const FactorForm& axis = axes.forms[j];
        of.total *= axes.terms[j].total;
        of.most *= axis.scale() * axis.most();
        of.scale *= axis.scale();
        for (const std::size_t end = f + axis.factors(); f < end; ++f)
            of.scale = ldexp(of.scale, scaling.exponents[f]);
        of.cancellation += axis.cancellation();
        of.may_vanish = of.may_vanish || axis.may_vanish();
    }
    return of;
}

}  // namespace

double pair_memory(std::size_t count, std::size_t dimension) {
    constexpr std::size_t numbers = 2 * (sizeof(PointNumbers) / sizeof(double) + 3);
    return static_cast<double>(numbers * dimension + 3) * static_cast<double>(count) * 8;
}

Square pair_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                   const RunContext& run, Vectors widest) {
    const bool two_sided = is_two_sided(points, kind, weights);
    const Axes axes = axes_of(points.dimension(), kind, weights, two_sided);
    if (axes.places.empty()) {  // all weights are 0 or nearly
        run.tick(1, 1);
        return {0, 20 * std::accumulate(weights.begin(), weights.end(), 0.0)};
    }
    const Numbers numbers = numbers_of(points, axes, run);
    const Factors factors = factors_of(axes);
    const Scaling scaling = scaling_of(numbers, factors.forms);
    const PairForm form = form_of(axes.forms[0], kind);
    const BlockTable table = table_of(form, numbers, scaling, factors.constants,
                                      block_order(points, axes, kind == Kind::centered));
    const DoubleDouble sum = sum_over_pairs(table, widest, run);

    const AxisProducts of = products_of(axes, scaling);
    const Quad n = points.count();
    const Quad pairs = of.scale * (Quad(sum.high) + sum.low) / (n * n);
    const Quad squared = of.total - 2 * numbers.means + pairs;
    // Digits lost below the smallest double may be magnified by later factors.
    const auto chain = static_cast<double>(numbers.factors + 8);
    const double growth = table.any_order() ? scaling.any_order : scaling.growth;
    const double relative = 0x1p-80 + 0x1p-98 * chain * chain + 0x1p-102 * of.cancellation;
    const Quad error = relative * (of.may_vanish ? of.most : pairs) +
                       of.scale * chain * std::exp2(growth - 1070) +
                       0x1p-88 * (of.total + numbers.means) + 0x1p-53 * abs(squared);
    return {static_cast<double>(squared), static_cast<double>(error)};
}

}  // namespace stipple::l2
