// SPDX-License-Identifier: MIT
//
// Kernels on the unit cube with a known mean, products over the axes. For t = |x - y| on one axis:
//
//     periodic   1 + 2 pi^2 (1/6 - t + t^2)                    mean 1
//     gaussian   exp(-t^2 / (2 h^2))      mean (erf(s x) + erf(s (1 - x))) sqrt(pi) / (2 s),
//                                              s = 1 / (h sqrt 2)
//     matern     p(a) exp(-a), a = c t    mean (I(c x) + I(c (1 - x))) / c
//     L2 kinds   k or 1 + k (math/l2/kinds.hpp)
//
// with the bandwidth h, c = sqrt(2 nu) / h, and I(A) the integral of p(a) exp(-a) from 0 to A,
// equal to g(0) - g(A) exp(-A) with the polynomial g = p + g'. The mean over both arguments is 2/c
// (g(0) - (f(0) - f(c) exp(-c)) / c) with f = g + f'. For small c, where this formula cancels, the
// mean is 2 sum_m q_m c^m / ((m + 1) (m + 2)), with the series p(a) exp(-a) = sum_m q_m a^m.
//
// Source  closed forms derived here; kernels: C. E. Rasmussen, C. K. I. Williams, "Gaussian
//         Processes for Machine Learning" (2006), section 4.2.

#include <array>
#include <cmath>
#include <numbers>

#include "core/machine/wide.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/powers.hpp"
#include "math/kernels/kernel.hpp"

namespace stipple::kernels {
namespace {

constexpr double unit_round = 0x1p-53;

constexpr double wave = 2 * std::numbers::pi * std::numbers::pi;
constexpr double crest = 1 + wave / 6;  ///< K(x, x) on an axis

STIPPLE_WIDE void multiply_periodic(const double* x, double y, std::size_t count, double* values) {
    for (std::size_t j = 0; j < count; ++j) {
        const double t = std::abs(x[j] - y);
        values[j] *= crest + wave * (t * (t - 1));
    }
}

class Periodic final : public Kernel {
  public:
    explicit Periodic(std::size_t dimension) : dimension_(dimension) {}

    void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
              double* values) const override {
        std::fill_n(values, count, 1.0);
        for (std::size_t k = 0; k < dimension_; ++k)
            multiply_periodic(x.axis(k) + first, y[k], count, values);
    }
    double diagonal(const double*) const override { return whole_power(crest, dimension_); }
    double mean(const double*) const override { return 1; }
    double total() const override { return 1; }
    double mean_diagonal() const override { return whole_power(crest, dimension_); }
    double rounding() const override { return 8 * unit_round * static_cast<double>(dimension_); }

  private:
    std::size_t dimension_;
};

STIPPLE_WIDE void add_squares(const double* x, double y, std::size_t count, double* sums) {
    for (std::size_t j = 0; j < count; ++j) sums[j] += (x[j] - y) * (x[j] - y);
}

STIPPLE_WIDE void exponentiate(double factor, std::size_t count, double* values) {
    for (std::size_t j = 0; j < count; ++j) values[j] = exponential(factor * values[j]);
}

class Gaussian final : public Kernel {
  public:
    Gaussian(std::size_t dimension, double bandwidth) : dimension_(dimension), h_(bandwidth) {}

    void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
              double* values) const override {
        std::fill_n(values, count, 0.0);
        for (std::size_t k = 0; k < dimension_; ++k)
            add_squares(x.axis(k) + first, y[k], count, values);
        exponentiate(-0.5 / (h_ * h_), count, values);
    }
    double diagonal(const double*) const override { return 1; }
    double mean(const double* x) const override {
        constexpr double half_root = std::numbers::sqrt2 / 2;
        const double scale = half_root / h_;
        double product = 1;
        for (std::size_t k = 0; k < dimension_; ++k)
            product *= (error_function(scale * x[k]) + error_function(scale * (1 - x[k]))) /
                       (scale * 2 * std::numbers::inv_sqrtpi);
        return product;
    }
    double total() const override {
        const double scale = std::numbers::sqrt2 / 2 / h_;
        const double root = error_function(scale) / (scale * std::numbers::inv_sqrtpi);
        return whole_power(root + exp_minus_1(-scale * scale) / (scale * scale), dimension_);
    }
    double mean_diagonal() const override { return 1; }
    double rounding() const override {
        return unit_round * (8 + 8 * static_cast<double>(dimension_));
    }

  private:
    std::size_t dimension_;
    double h_;
};

/// Coefficients of a polynomial p(a) of degree 2.
using Parabola = std::array<double, 3>;

double value_at(const Parabola& p, double a) { return p[0] + a * (p[1] + a * p[2]); }

/// Returns the g with g = p + g'.
Parabola with_derivatives(const Parabola& p) {
    const double linear = p[1] + 2 * p[2];
    return {p[0] + linear, linear, p[2]};
}

constexpr std::array<Parabola, 3> matern_parabolas = {{{1, 0, 0}, {1, 1, 0}, {1, 1, 1.0 / 3}}};

STIPPLE_WIDE void multiply_matern(const double* x, double y, double c, const Parabola& p,
                                  std::size_t count, double* sums, double* products) {
    for (std::size_t j = 0; j < count; ++j) {
        const double a = c * std::abs(x[j] - y);
        sums[j] += a;
        products[j] *= p[0] + a * (p[1] + a * p[2]);
    }
}

STIPPLE_WIDE void multiply_decay(const double* sums, std::size_t count, double* products) {
    for (std::size_t j = 0; j < count; ++j)
        products[j] = sums[j] < 708 ? products[j] * exponential(-sums[j]) : 0;
}

/// Multiplies by the decay so far where it is strong: over many axes the exponential of a whole sum
/// would underflow, and the product of parabolas overflow.
STIPPLE_WIDE void take_decay(double* sums, std::size_t count, double* products) {
    for (std::size_t j = 0; j < count; ++j) {
        const double taken = sums[j] > 128 ? sums[j] : 0;
        products[j] = taken < 708 ? products[j] * exponential(-taken) : 0;
        sums[j] -= taken;
    }
}

class Matern final : public Kernel {
  public:
    Matern(std::size_t dimension, double bandwidth, unsigned order)
        : dimension_(dimension),
          c_(std::sqrt(2.0 * order + 1) / bandwidth),
          p_(matern_parabolas[order]),
          g_(with_derivatives(p_)) {}

    void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
              double* values) const override {
        std::array<double, tile> sums;
        std::fill_n(sums.data(), count, 0.0);
        std::fill_n(values, count, 1.0);
        for (std::size_t k = 0; k < dimension_; ++k) {
            if (k % 64 == 0 && k > 0) take_decay(sums.data(), count, values);
            multiply_matern(x.axis(k) + first, y[k], c_, p_, count, sums.data(), values);
        }
        multiply_decay(sums.data(), count, values);
    }
    double diagonal(const double*) const override { return 1; }
    double mean(const double* x) const override {
        double product = 1;
        for (std::size_t k = 0; k < dimension_; ++k)
            product *= (integral(c_ * x[k]) + integral(c_ * (1 - x[k]))) / c_;
        return product;
    }
    double total() const override {
        if (c_ <= 1) return whole_power(series(), dimension_);
        const Parabola f = with_derivatives(g_);
        const double inner = (f[0] - value_at(f, c_) * exponential(-c_)) / c_;
        return whole_power(2 / c_ * (g_[0] - inner), dimension_);
    }
    double mean_diagonal() const override { return 1; }
    double rounding() const override {
        return unit_round * (8 + 8 * static_cast<double>(dimension_));
    }

  private:
    /// Integral of p(a) exp(-a) from 0 to `end`.
    [[nodiscard]] double integral(double end) const {
        return -g_[0] * exp_minus_1(-end) - end * (g_[1] + end * g_[2]) * exponential(-end);
    }

    /// Mean over both arguments on one axis, for c <= 1.
    [[nodiscard]] double series() const {
        std::array<double, 3> term = {1, 0, 0};  // (-1)^m / m! for m, m - 1 and m - 2
        double sum = 0;
        double c_power = 1;
        for (int m = 0; m < 30; ++m) {
            const double q = p_[0] * term[0] + p_[1] * term[1] + p_[2] * term[2];
            sum += 2 * q * c_power / ((m + 1) * (m + 2));
            term = {-term[0] / (m + 1), term[0], term[1]};
            c_power *= c_;
        }
        return sum;
    }

    std::size_t dimension_;
    double c_;
    Parabola p_;
    Parabola g_;
};

/// Kernel on one axis for fixed y: at[0] + at[1] x + at[2] x^2 + at[3] |x - 1/2| + sigma |x - y|.
struct AxisCurve {
    std::array<double, 4> at;
    double sigma;
};

STIPPLE_WIDE void multiply_curve(const double* x, double y, const AxisCurve& curve,
                                 std::size_t count, double* values) {
    const auto [c, sigma] = curve;
    for (std::size_t j = 0; j < count; ++j)
        values[j] *= c[0] + x[j] * (c[1] + x[j] * c[2]) + c[3] * std::abs(x[j] - 0.5) +
                     sigma * std::abs(x[j] - y);
}

/// Multiplies by a curve with at[2] = at[3] = 0.
STIPPLE_WIDE void multiply_bent_line(const double* x, double y, const AxisCurve& curve,
                                     std::size_t count, double* values) {
    const auto [c, sigma] = curve;
    for (std::size_t j = 0; j < count; ++j)
        values[j] *= c[0] + x[j] * c[1] + sigma * std::abs(x[j] - y);
}

class OfL2 final : public Kernel {
  public:
    OfL2(std::size_t dimension, l2::Kind kind)
        : dimension_(dimension),
          of_(l2::record_of(kind).kernel),
          times_(l2::record_of(kind).scale / 48),
          one_(l2::is_kernel_alone(kind, {}) ? 0 : 1),
          straight_(of_.s02 == 0 && of_.s03 == 0) {}

    void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
              double* values) const override {
        std::fill_n(values, count, 1.0);
        for (std::size_t k = 0; k < dimension_; ++k)
            (straight_ ? multiply_bent_line : multiply_curve)(x.axis(k) + first, y[k],
                                                              curve_at(y[k]), count, values);
    }
    double diagonal(const double* x) const override {
        double product = 1;
        for (std::size_t k = 0; k < dimension_; ++k) {
            const AxisCurve c = curve_at(x[k]);
            product *= c.at[0] + x[k] * (c.at[1] + x[k] * c.at[2]) + c.at[3] * std::abs(x[k] - 0.5);
        }
        return product;
    }
    double mean(const double* x) const override {
        double product = 1;
        for (std::size_t k = 0; k < dimension_; ++k)
            product *= one_ + times_ * (number(of_.mean[0]) +
                                        x[k] * (number(of_.mean[1]) + x[k] * number(of_.mean[2])) +
                                        number(of_.mean[3]) * std::abs(x[k] - 0.5));
        return product;
    }
    double total() const override {
        return whole_power(one_ + times_ * number(of_.total), dimension_);
    }
    double mean_diagonal() const override {
        // int k(x, x) dx = s00 + s01 + 2/3 s02 + 1/2 s03 + 1/3 s11
        const double axis = number(of_.s00) + number(of_.s01) + number(of_.s02) * 2 / 3 +
                            number(of_.s03) / 2 + number(of_.s11) / 3;
        return whole_power(one_ + times_ * axis, dimension_);
    }
    double rounding() const override { return 16 * unit_round * static_cast<double>(dimension_); }

  private:
    static double number(std::int64_t coefficient) { return static_cast<double>(coefficient); }

    [[nodiscard]] AxisCurve curve_at(double y) const {
        const double bend = std::abs(y - 0.5);
        AxisCurve curve{
            {number(of_.s00) + y * (number(of_.s01) + y * number(of_.s02)) + bend * number(of_.s03),
             number(of_.s01) + y * number(of_.s11), number(of_.s02), number(of_.s03)},
            times_ * number(of_.sigma)};
        for (double& c : curve.at) c *= times_;
        curve.at[0] += one_;
        return curve;
    }

    std::size_t dimension_;
    const l2::AxisKernel& of_;
    double times_;
    double one_;
    bool straight_;
};

}  // namespace

Columns::Columns(std::span<const double> rows, std::size_t width)
    : count_(rows.size() / width), width_(width), numbers_(rows.size()) {
    for (std::size_t i = 0; i < count_; ++i)
        for (std::size_t k = 0; k < width; ++k) numbers_[k * count_ + i] = rows[i * width + k];
}

KernelPtr periodic(std::size_t dimension) { return std::make_unique<Periodic>(dimension); }

KernelPtr gaussian(std::size_t dimension, double bandwidth) {
    return std::make_unique<Gaussian>(dimension, bandwidth);
}

KernelPtr matern(std::size_t dimension, double bandwidth, unsigned order) {
    return std::make_unique<Matern>(dimension, bandwidth, order);
}

KernelPtr of_l2(std::size_t dimension, l2::Kind kind) {
    return std::make_unique<OfL2>(dimension, kind);
}

}  // namespace stipple::kernels
