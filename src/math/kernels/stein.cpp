// SPDX-License-Identifier: MIT
//
// Langevin Stein kernel of a density p, from its scores s(x) = grad log p(x), for which p need not
// be normalized. With u = x - y, q = 1 + |u|^2 / h^2 and the base kernel k = q^(-1/2), the inverse
// multiquadric,
//
//     K(x, y) = s(x).s(y) k + s(x).grad_y k + s(y).grad_x k + div_x grad_y k
//             = q^(-1/2) s(x).s(y) + q^(-3/2) ((s(x) - s(y)).u + d) / h^2
//               - 3 q^(-5/2) |u|^2 / h^4.
//
// Its mean over y with density p is 0 for every x. K(x, x) = |s(x)|^2 + d / h^2.
//
// Source  J. Gorham, L. Mackey, "Measuring sample quality with kernels", ICML 2017,
//         arXiv:1703.01717 (this base kernel); Q. Liu, J. D. Lee, M. Jordan, ICML 2016,
//         arXiv:1602.03253.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/machine/wide.hpp"
#include "core/text.hpp"
#include "math/kernels/kernel.hpp"

namespace stipple::kernels {
namespace {

/// Sums over the axes, for each point of a tile.
struct SteinSums {
    std::array<double, tile> distance;  ///< |u|^2
    std::array<double, tile> scores;    ///< s(x).s(y)
    std::array<double, tile> cross;     ///< (s(x) - s(y)).u
};

STIPPLE_WIDE void add_axis(const double* x, const double* score, double y, double y_score,
                           std::size_t count, SteinSums& sums) {
    double* const distance = sums.distance.data();
    double* const scores = sums.scores.data();
    double* const cross = sums.cross.data();
    for (std::size_t j = 0; j < count; ++j) {
        const double u = x[j] - y;
        distance[j] += u * u;
        scores[j] += score[j] * y_score;
        cross[j] += (score[j] - y_score) * u;
    }
}

STIPPLE_WIDE void combine(const SteinSums& sums, double inverse, double dimension,
                          std::size_t count, double* values) {
    const double* const distance = sums.distance.data();
    const double* const scores = sums.scores.data();
    const double* const cross = sums.cross.data();
    for (std::size_t j = 0; j < count; ++j) {
        const double r = distance[j] * inverse;
        const double share = 1 / (1 + r);
        const double k = std::sqrt(share);
        values[j] = k * (scores[j] + share * inverse * (cross[j] + dimension - 3 * (r * share)));
    }
}

class Stein final : public Kernel {
  public:
    Stein(std::size_t dimension, double bandwidth)
        : dimension_(dimension), inverse_(1 / (bandwidth * bandwidth)) {}

    void fill(const double* y, const Columns& x, std::size_t first, std::size_t count,
              double* values) const override {
        SteinSums sums;
        std::fill_n(sums.distance.data(), count, 0.0);
        std::fill_n(sums.scores.data(), count, 0.0);
        std::fill_n(sums.cross.data(), count, 0.0);
        for (std::size_t k = 0; k < dimension_; ++k)
            add_axis(x.axis(k) + first, x.axis(dimension_ + k) + first, y[k], y[dimension_ + k],
                     count, sums);
        combine(sums, inverse_, static_cast<double>(dimension_), count, values);
    }
    double diagonal(const double* x) const override {
        double sum = 0;
        for (std::size_t k = 0; k < dimension_; ++k) sum += x[dimension_ + k] * x[dimension_ + k];
        return sum + inverse_ * static_cast<double>(dimension_);
    }
    double mean(const double*) const override { return 0; }
    double total() const override { return 0; }
    double mean_diagonal() const override { return 0; }
    double rounding() const override {
        return 0x1p-53 * (24 + 8 * static_cast<double>(dimension_));
    }

  private:
    std::size_t dimension_;
    double inverse_;
};

}  // namespace

void require_stein(const Columns& points, std::size_t dimension, double bandwidth) {
    double squares = 0;
    double products = 0;
    for (std::size_t k = 0; k < dimension; ++k) {
        const auto range = [&](std::size_t axis) {
            const std::span numbers(points.axis(axis), points.count());
            return std::ranges::max(numbers) - std::ranges::min(numbers);
        };
        squares += range(k) * range(k);
        products += range(k) * range(dimension + k);
    }
    if (!std::isfinite(squares / bandwidth / bandwidth) || !std::isfinite(products))
        fail(ErrorKind::input,
             "the points are too far apart for the kernel stein in float64, with --bandwidth {}",
             format_number(bandwidth));
}

KernelPtr stein(std::size_t dimension, double bandwidth) {
    return std::make_unique<Stein>(dimension, bandwidth);
}

}  // namespace stipple::kernels
