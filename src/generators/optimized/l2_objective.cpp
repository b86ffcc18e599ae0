// SPDX-License-Identifier: MIT
//
// The square of an L2 discrepancy and its gradient. With the factors K_j of math/l2/kinds.hpp and
// their means f_j(x) = int K_j(x, y) dy,
//
//     d/dx_ij  =  -2/n f_j'(x_ij) prod_{l != j} f_l(x_il)
//                 + 2/n^2 sum_k d_1 K_j(x_ij, x_kj) prod_{l != j} K_l(x_il, x_kl),
//
// where the slope of |x - y| at x = y is 0. In an even order of points (in_even_order()), the first
// m points p are followed by the point x that minimizes
//
//     2 sum_p K(x, p) + K(x, x) - 2 (m + 1) int K(x, y) dy.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "generators/optimized/objective.hpp"
#include "math/l2/axis_factor.hpp"

namespace stipple::optimized {
namespace {

/// The function a[0] + a[1] x + a[2] x^2 + a[3] |x - 1/2|.
struct Curve {
    std::array<double, 4> a{};

    explicit Curve(const l2::AxisFactor::Curve& of) {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] = static_cast<double>(of[i]);
    }
    [[nodiscard]] double at(double x) const {
        return a[0] + (a[1] + a[2] * x) * x + a[3] * std::abs(x - 0.5);
    }
    [[nodiscard]] double slope(double x) const {
        return a[1] + 2 * a[2] * x + (x < 0.5 ? -a[3] : a[3]);
    }
};

/// The factor own(x) + own(y) + product x y + distance |x - y|.
struct Factor {
    explicit Factor(const l2::AxisFactor& of)
        : own(of.own),
          mean(of.mean),
          product(static_cast<double>(of.product)),
          distance(static_cast<double>(of.distance)),
          total(static_cast<double>(of.total)) {}

    [[nodiscard]] double at(double x, double y) const {
        return (own.at(x) + own.at(y)) + product * (x * y) + distance * std::abs(x - y);
    }

    Curve own;
    Curve mean;
    double product;
    double distance;
    double total;
};

std::vector<Factor> factors_of(l2::Kind kind, const l2::AxisWeights& weights,
                               std::size_t dimension) {
    const bool alone = l2::is_kernel_alone(kind, weights);
    std::vector<Factor> factors;
    for (std::size_t j = 0; j < dimension; ++j)
        factors.emplace_back(l2::AxisFactor(kind, alone, l2::weight_of(weights, j)));
    return factors;
}

constexpr std::size_t lanes = 64;  ///< points per block

/// Factors between one point and a block of others, axis by axis, and sums of their products.
struct Row {
    std::vector<double> factors;    ///< `lanes` factors for each axis
    std::vector<double> before;     ///< products of the factors of the preceding axes
    std::vector<double> slopes;     ///< by axis: sums of its slope times the other axes' factors
    std::array<double, lanes> sum;  ///< sums of the products of all factors
};

/// Multiplies the products so far by the factors of one axis between a point at x and a block of
/// other points; `own` is own(x).
STIPPLE_WIDE void multiply(double x, double own, const Factor& k, const double* __restrict others,
                           const double* __restrict owns, std::size_t size,
                           double* __restrict factors, double* __restrict before,
                           double* __restrict product) {
    for (std::size_t i = 0; i < size; ++i) {
        const double t = x - others[i];
        const double away = t < 0 ? -t : t;
        const double factor = (own + owns[i]) + k.product * (x * others[i]) + k.distance * away;
        factors[i] = factor;
        before[i] = product[i];
        product[i] *= factor;
    }
}

/// Adds to `slopes` the slopes along one axis times the factors of all other axes.
STIPPLE_WIDE void add_slopes(double x, double own_slope, const Factor& k,
                             const double* __restrict others, std::size_t size,
                             const double* __restrict factors, const double* __restrict before,
                             double* __restrict behind, double* __restrict slopes) {
    const double product = k.product;
    const double distance = k.distance;
    for (std::size_t i = 0; i < size; ++i) {
        const double t = x - others[i];
        const double turn = t < 0 ? -distance : t > 0 ? distance : 0;
        slopes[i] += before[i] * behind[i] * (own_slope + product * others[i] + turn);
        behind[i] *= factors[i];
    }
}

class L2Objective final : public Objective {
  public:
    L2Objective(l2::Kind kind, const l2::AxisWeights& weights, std::size_t count,
                std::size_t dimension)
        : n_(count), d_(dimension), factors_(factors_of(kind, weights, dimension)) {
        for (const Factor& factor : factors_) total_ *= factor.total;
    }

    double value(std::span<const double> rows, double /*sharpness*/, std::span<double> gradient,
                 const RunContext& run) override {
        put_columns(rows);
        std::vector<double> parts(block_count(n_, few));
        for_each_block(silent(worth_threads(run, steps() * 1e-9)), n_, few,
                       [&](const Block& block) {
                           Row row{std::vector<double>(d_ * lanes),
                                   std::vector<double>(d_ * lanes),
                                   std::vector<double>(d_ * lanes),
                                   {}};
                           for (std::size_t i = block.first; i < block.last; ++i) {
                               run.check_stop();
                               parts[block.index] += add_point(i, row, gradient);
                           }
                       });
        double sum = total_;
        for (const double part : parts) sum += part;
        return sum;
    }

    [[nodiscard]] double steps() const override {
        const auto n = static_cast<double>(n_);
        return n * (n * static_cast<double>(d_) / 3 + 200);
    }
    [[nodiscard]] double reported(double value) const override {
        return std::sqrt(std::max(value, 0.0));
    }

  private:
    static constexpr std::size_t few = 16;  ///< points per partial sum

    void put_columns(std::span<const double> rows) {
        columns_.resize(n_ * d_);
        owns_.resize(n_ * d_);
        for (std::size_t j = 0; j < d_; ++j)
            for (std::size_t i = 0; i < n_; ++i) {
                columns_[j * n_ + i] = rows[i * d_ + j];
                owns_[j * n_ + i] = factors_[j].own.at(rows[i * d_ + j]);
            }
    }

    /// Returns the i-th point's term of the sum and sets its gradient.
    double add_point(std::size_t i, Row& row, std::span<double> gradient) const {
        row.sum.fill(0);
        std::ranges::fill(row.slopes, 0);
        for (std::size_t first = 0; first < n_; first += lanes)
            add_pairs(i, first, std::min(lanes, n_ - first), row);
        const auto n = static_cast<double>(n_);
        double mean = 1;
        for (std::size_t j = 0; j < d_; ++j) mean *= factors_[j].mean.at(columns_[j * n_ + i]);
        for (std::size_t j = 0; j < d_; ++j) {
            const double x = columns_[j * n_ + i];
            double others = factors_[j].mean.slope(x);
            for (std::size_t l = 0; l < d_; ++l)
                if (l != j) others *= factors_[l].mean.at(columns_[l * n_ + i]);
            double slope = 0;
            for (std::size_t k = 0; k < lanes; ++k) slope += row.slopes[j * lanes + k];
            gradient[i * d_ + j] = 2 / n * (slope / n - others);
        }
        double sum = 0;
        for (const double part : row.sum) sum += part;
        return (sum / n - 2 * mean) / n;
    }

    void add_pairs(std::size_t i, std::size_t first, std::size_t size, Row& row) const {
        std::array<double, lanes> product;
        product.fill(1);
        for (std::size_t j = 0; j < d_; ++j)
            multiply(columns_[j * n_ + i], owns_[j * n_ + i], factors_[j],
                     &columns_[j * n_ + first], &owns_[j * n_ + first], size,
                     &row.factors[j * lanes], &row.before[j * lanes], product.data());
        for (std::size_t k = 0; k < size; ++k) row.sum[k] += product[k];
        product.fill(1);
        for (std::size_t j = d_; j-- > 0;)
            add_slopes(columns_[j * n_ + i], factors_[j].own.slope(columns_[j * n_ + i]),
                       factors_[j], &columns_[j * n_ + first], size, &row.factors[j * lanes],
                       &row.before[j * lanes], product.data(), &row.slopes[j * lanes]);
    }

    std::size_t n_;
    std::size_t d_;
    std::vector<Factor> factors_;
    double total_ = 1;
    std::vector<double> columns_;  ///< coordinates, axis after axis
    std::vector<double> owns_;     ///< own() of each coordinate
};

/// Greedy choice of the next point: the remaining one that adds least to the discrepancy.
class Greedy {
  public:
    Greedy(const std::vector<double>& rows, std::size_t dimension, std::vector<Factor> factors)
        : rows_(rows),
          d_(dimension),
          factors_(std::move(factors)),
          sums_(rows.size() / dimension),
          taken_(sums_.size()) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            double mean = 1;
            for (std::size_t j = 0; j < d_; ++j) mean *= factors_[j].mean.at(rows[i * d_ + j]);
            means_.push_back(mean);
            own_.push_back(kernel(i, i));
        }
    }

    void take(std::size_t i) {
        taken_[i] = true;
        ++chosen_;
        for (std::size_t k = 0; k < sums_.size(); ++k)
            if (!taken_[k]) sums_[k] += kernel(i, k);
    }

    [[nodiscard]] std::size_t next() const {
        std::size_t best = sums_.size();
        for (std::size_t k = 0; k < sums_.size(); ++k)
            if (!taken_[k] && (best == sums_.size() || added(k) < added(best))) best = k;
        return best;
    }

  private:
    [[nodiscard]] double kernel(std::size_t i, std::size_t k) const {
        double product = 1;
        for (std::size_t j = 0; j < d_; ++j)
            product *= factors_[j].at(rows_[i * d_ + j], rows_[k * d_ + j]);
        return product;
    }
    [[nodiscard]] double added(std::size_t k) const {
        return 2 * sums_[k] + own_[k] - 2 * static_cast<double>(chosen_ + 1) * means_[k];
    }

    const std::vector<double>& rows_;
    std::size_t d_;
    std::vector<Factor> factors_;
    std::vector<double> sums_;  ///< sum of each point's kernels with the points taken so far
    std::vector<bool> taken_;
    std::vector<double> means_;
    std::vector<double> own_;
    std::size_t chosen_ = 0;
};

}  // namespace

std::unique_ptr<Objective> l2_objective(l2::Kind kind, const l2::AxisWeights& weights,
                                        std::size_t count, std::size_t dimension) {
    return std::make_unique<L2Objective>(kind, weights, count, dimension);
}

std::vector<double> in_even_order(const std::vector<double>& rows, std::size_t dimension,
                                  std::size_t kept, l2::Kind kind, const l2::AxisWeights& weights,
                                  const RunContext& run) {
    Greedy greedy(rows, dimension, factors_of(kind, weights, dimension));
    std::vector<double> ordered;
    const std::size_t n = rows.size() / dimension;
    for (std::size_t i = 0; i < n; ++i) {
        run.check_stop();
        const std::size_t next = i < kept ? i : greedy.next();
        greedy.take(next);
        const auto row = rows.begin() + static_cast<std::ptrdiff_t>(next * dimension);
        ordered.insert(ordered.end(), row, row + static_cast<std::ptrdiff_t>(dimension));
    }
    return ordered;
}

}  // namespace stipple::optimized
