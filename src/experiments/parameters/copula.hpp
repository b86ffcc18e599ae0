// SPDX-License-Identifier: MIT
//
// Copulas: the dependence between coordinates that are uniform individually. With L L^T = R, a
// correlation matrix, and independent uniform u,
//
//     Gaussian   z_i = Phi^-1(u_i),    v_i = Phi((L z)_i)
//     Student    v_i = T_nu(t_i),      t_i = m_i + s_i T_(nu+i)^-1(u_i),
//
// where m_i and s_i^2 = L_ii^2 (nu + q_i) / (nu + i) are the parameters of Student's distribution
// given the i preceding coordinates, and q_i is the sum of y_j^2 over these, where L y = t.
// Both are Rosenblatt's transformation: strata of the first coordinate are preserved, and an
// inverse exists.
//
// Shape   d coordinates. Each is stored as two probabilities, p below and q = 1 - p above it, so
//         that both tails keep all digits.
// Cost    d^2 / 2 multiplications and d quantiles per point.
// Promise the same bits on every machine.
// Source  M. Rosenblatt, Ann. Math. Statist. 23 (1952) 470-472, doi:10.1214/aoms/1177729394;
//         P. Ding, Amer. Statist. 70 (2016) 293-295, doi:10.1080/00031305.2016.1164756 (Student's
//         distribution given some coordinates).
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "math/distributions/marginal.hpp"

namespace stipple::parameters {

struct Share {
    double below = 0.5;
    double above = 0.5;
};

class Copula {
  public:
    /// @param correlations d x d in row-major order; a valid matrix
    /// @param degrees degrees of freedom of Student's copula; nullopt: Gaussian
    Copula(const std::vector<double>& correlations, std::optional<double> degrees);

    /// Maps independent coordinates to dependent ones, in place.
    void forward(std::span<Share> row) const;
    void inverse(std::span<Share> row) const;
    /// Whether forward() does not change coordinate i.
    [[nodiscard]] bool leaves(std::size_t i) const;
    /// Whether coordinate i depends on other coordinates.
    [[nodiscard]] bool joins(std::size_t i) const;
    /// Density with respect to the uniform distribution on the cube.
    [[nodiscard]] double density(std::span<const Share> row) const;

  private:
    /// Distribution of score i, given the preceding ones: score i is middle + L_ii y_i, and y_i /
    /// spread is normal or, for Student's copula, has the distribution laws_[i].
    struct Place {
        double middle;
        double spread;
    };
    [[nodiscard]] Place place(std::size_t i, std::span<const double> y, double squares) const;
    /// Converts probabilities to scores and back; `given` coordinates precede and are known.
    [[nodiscard]] double score(const Share& share, std::size_t given) const;
    [[nodiscard]] Share share(double score, std::size_t given) const;

    std::size_t d_;
    std::vector<double> factor_;  ///< L, in row-major order
    std::optional<double> degrees_;
    /// Student's distributions for 0, 1, ... preceding coordinates.
    std::vector<MarginalPtr> laws_;
};

/// Correlation 2 sin(pi r / 6) of normal scores with Spearman's rank correlation r.
double score_correlation(double spearman);

/// Whether a symmetric matrix with ones on its diagonal has a Cholesky factor.
bool is_correlation(const std::vector<double>& matrix, std::size_t d);

/// The nearest correlation matrix (Frobenius norm) with eigenvalues of at least about 1e-6, so that
/// it has a Cholesky factor.
///
/// Source  N. J. Higham, IMA J. Numer. Anal. 22 (2002) 329-343, doi:10.1093/imanum/22.3.329.
std::vector<double> nearest_correlation(std::vector<double> matrix, std::size_t d);

}  // namespace stipple::parameters
