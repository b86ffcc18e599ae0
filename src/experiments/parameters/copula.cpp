// SPDX-License-Identifier: MIT
#include "experiments/parameters/copula.hpp"

#include <algorithm>
#include <cmath>

#include "math/distributions/laws.hpp"
#include "math/functions/cholesky.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/incomplete_functions.hpp"
#include "math/functions/jacobi_eigen.hpp"
#include "math/functions/normal_distribution.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple::parameters {
namespace {

/// The smaller probability, at least 1e-300; 2^-54 instead of 0, for which the score is infinite.
double tail(const Share& share) {
    const double m = std::min(share.below, share.above);
    return m > 0 ? std::max(m, 1e-300) : 0x1p-54;
}

/// The nearest symmetric matrix (Frobenius norm) whose eigenvalues are at least `least`.
std::vector<double> lifted(const std::vector<double>& matrix, std::size_t d, double least) {
    const auto [values, vectors] = jacobi_eigen(matrix, d);
    std::vector<double> out(d * d);
    for (std::size_t i = 0; i < d; ++i)
        for (std::size_t j = 0; j < d; ++j)
            for (std::size_t k = 0; k < d; ++k)
                out[i * d + j] +=
                    std::max(values[k], least) * vectors[i * d + k] * vectors[j * d + k];
    return out;
}

}  // namespace

Copula::Copula(const std::vector<double>& correlations, std::optional<double> degrees)
    : d_(static_cast<std::size_t>(std::lround(std::sqrt(correlations.size())))),
      factor_(cholesky(correlations, d_).factor),
      degrees_(degrees) {
    for (std::size_t i = 0; degrees && i < d_; ++i)
        laws_.push_back(student_t_law(*degrees + static_cast<double>(i), 0, 1));
}

double Copula::score(const Share& share, std::size_t given) const {
    const double m = tail(share);
    const bool low = share.below < share.above;
    if (!degrees_) return detail::normal_quantile(low ? share.below - 0.5 : 0.5 - share.above, m);
    return laws_[given]->quantile(m, low ? Tail::lower : Tail::upper);
}

Share Copula::share(double score, std::size_t given) const {
    if (!degrees_) return {normal_distribution(score), normal_distribution(-score)};
    const Marginal& law = *laws_[given];
    return {law.probability(score, Tail::lower), law.probability(score, Tail::upper)};
}

Copula::Place Copula::place(std::size_t i, std::span<const double> y, double squares) const {
    Place at{.middle = 0, .spread = 1};
    for (std::size_t j = 0; j < i; ++j) at.middle += factor_[i * d_ + j] * y[j];
    if (degrees_)
        at.spread = std::sqrt((*degrees_ + squares) / (*degrees_ + static_cast<double>(i)));
    return at;
}

void Copula::forward(std::span<Share> row) const {
    std::vector<double> y(d_);  // solution of L y = scores
    double squares = 0;
    for (std::size_t i = 0; i < d_; ++i) {
        const auto [middle, spread] = place(i, y, squares);
        y[i] = spread * score(row[i], i);
        squares += y[i] * y[i];
        row[i] = share(middle + factor_[i * d_ + i] * y[i], 0);
    }
}

bool Copula::leaves(std::size_t i) const {
    const auto preceding = std::span(factor_).subspan(i * d_, i);
    return std::ranges::all_of(preceding, [](double x) { return x == 0; }) && (!degrees_ || i == 0);
}

void Copula::inverse(std::span<Share> row) const {
    std::vector<double> y(d_);
    double squares = 0;
    for (std::size_t i = 0; i < d_; ++i) {
        const auto [middle, spread] = place(i, y, squares);
        y[i] = (score(row[i], 0) - middle) / factor_[i * d_ + i];
        squares += y[i] * y[i];
        row[i] = share(y[i] / spread, i);
    }
}

bool Copula::joins(std::size_t i) const {
    bool alone = !degrees_ && leaves(i);
    for (std::size_t j = i + 1; j < d_; ++j) alone = alone && factor_[j * d_ + i] == 0;
    return !alone;
}

double Copula::density(std::span<const Share> row) const {
    std::vector<double> y(d_);
    double log_density = 0;
    double squares = 0;
    const double nu = degrees_.value_or(0);
    for (std::size_t i = 0; i < d_; ++i) {
        const double at = score(row[i], 0);
        y[i] = (at - place(i, y, 0).middle) / factor_[i * d_ + i];
        squares += y[i] * y[i];
        log_density -= logarithm(factor_[i * d_ + i]);
        if (degrees_)
            log_density += (nu + 1) / 2 * log_1p(at * at / nu);
        else
            log_density += at * at / 2;
    }
    if (!degrees_) return exponential(log_density - squares / 2);
    const auto d = static_cast<double>(d_);
    log_density += log_gamma((nu + d) / 2) - log_gamma(nu / 2) -
                   d * (log_gamma((nu + 1) / 2) - log_gamma(nu / 2));
    return exponential(log_density - (nu + d) / 2 * log_1p(squares / nu));
}

double score_correlation(double spearman) {
    return std::copysign(2 * cos_sin_turns(std::abs(spearman) / 12).sin, spearman);
}

bool is_correlation(const std::vector<double>& matrix, std::size_t d) {
    return cholesky(matrix, d).failed == 0;
}

std::vector<double> nearest_correlation(std::vector<double> matrix, std::size_t d) {
    constexpr double least = 1e-6;
    // Dykstra's correction for the projection onto matrices with eigenvalues of at least `least`.
    std::vector<double> correction(d * d);
    for (int step = 0; step < 500; ++step) {
        std::vector<double> shifted(d * d);
        for (std::size_t i = 0; i < d * d; ++i) shifted[i] = matrix[i] - correction[i];
        std::vector<double> next = lifted(shifted, d, least);
        for (std::size_t i = 0; i < d * d; ++i) correction[i] = next[i] - shifted[i];
        double change = 0;
        for (std::size_t i = 0; i < d; ++i) next[i * d + i] = 1;
        for (std::size_t i = 0; i < d * d; ++i)
            change = std::max(change, std::abs(next[i] - matrix[i]));
        matrix = std::move(next);
        if (change < 1e-10) break;
    }
    // The last step set the diagonal to 1, which may have lowered the smallest eigenvalue slightly.
    while (!is_correlation(matrix, d))
        for (std::size_t i = 0; i < d * d; ++i)
            if (i % (d + 1) != 0) matrix[i] *= 1 - 1e-9;
    return matrix;
}

}  // namespace stipple::parameters
