// SPDX-License-Identifier: MIT
//
// Orthogonal matching pursuit: adds terms to a least squares fit one by one, each time the term
// that correlates most with the residual. It keeps the number of terms t that minimizes
//
//     (mean square of e_i / (1 - h_i)) n / (n - t - 1) (1 + trace of inverse Gram matrix) P^(2t/n)
//
// for terms chosen from P candidates, where e_i / (1 - h_i) are the leave-one-out errors. The last
// factor compensates for the choice, which reduces the error even for pure noise.
//
// Source  Y. C. Pati, R. Rezaiifar, P. S. Krishnaprasad, Asilomar Conf. 27 (1993) 40-44,
//         doi:10.1109/ACSSC.1993.342465; O. Chapelle, V. Vapnik, Y. Bengio, Mach. Learn. 48 (2002)
//         9-23, doi:10.1023/A:1013943418833 (trace); D. P. Foster, E. I. George, Ann. Statist. 22
//         (1994) 1947-1975, doi:10.1214/aos/1176325766 (2 log P for a term).
#include <algorithm>
#include <cmath>

#include "experiments/sensitivity/methods.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

void subtract(std::vector<double>& from, double factor, std::span<const double> b) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] -= factor * b[i];
}

/// A fit that grows column by column; q_ is an orthonormal basis of its columns.
class Pursuit {
  public:
    Pursuit(const Candidates& candidates, std::span<const double> z, const RunContext& run)
        : candidates_(candidates),
          n_(candidates.rows.size()),
          run_(run),
          leverage_(n_, 0.0),
          usable_(candidates.columns, true),
          norms_(column_sums([](double v, double) { return v * v; })) {
        for (const std::size_t i : candidates.rows) residual_.push_back(z[i]);
        const double root = std::sqrt(static_cast<double>(n_));
        append(std::vector(n_, 1 / root), {}, root);
        whole_ = dot(residual_, residual_);
        least_ = error();
    }

    SparseFit best() {
        const std::size_t most = std::min({candidates_.columns, n_ / 2, most_terms});
        constexpr std::size_t patience = 10;
        constexpr double exact = 1e-24;
        std::size_t best = 0;
        while (whole_ > 0 && chosen_.size() < most && take_next()) {
            const double now = error();
            if (now < least_) {
                least_ = now;
                best = chosen_.size();
            }
            if (least_ < exact || chosen_.size() > best + best / 4 + patience) break;
        }
        chosen_.resize(best);
        SparseFit fit{.error = least_, .chosen = std::move(chosen_)};
        std::vector<double> c(best + 1, 0.0);
        for (std::size_t s = 0; s <= best; ++s)
            for (std::size_t row = 0; row <= s; ++row) c[row] += back_[s][row] * along_[s];
        fit.constant = c.front();
        fit.coefficients.assign(c.begin() + 1, c.end());
        return fit;
    }

  private:
    [[nodiscard]] const double* row(std::size_t i) const {
        return candidates_.values.data() + candidates_.rows[i] * candidates_.columns;
    }

    /// Sums of term(value, residual) over the rows, one sum per column.
    template <class Term>
    std::vector<double> column_sums(const Term& term) const {
        std::vector<double> sums(candidates_.columns, 0.0);
        for (std::size_t i = 0; i < n_; ++i) {
            const double rest = residual_.empty() ? 0 : residual_[i];
            for (std::size_t j = 0; j < sums.size(); ++j) sums[j] += term(row(i)[j], rest);
        }
        return sums;
    }

    /// Adds the column that correlates most with the residual; false if no usable column is left.
    bool take_next() {
        run_.check_stop();
        const auto products = column_sums([](double v, double rest) { return v * rest; });
        for (;;) {
            std::size_t chosen = candidates_.columns;
            double most = 0;
            for (std::size_t j = 0; j < candidates_.columns; ++j) {
                if (!usable_[j] || !(products[j] * products[j] > most * norms_[j])) continue;
                most = products[j] * products[j] / norms_[j];
                chosen = j;
            }
            if (chosen == candidates_.columns) return false;
            usable_[chosen] = false;
            if (orthogonalized(chosen)) return true;
        }
    }

    /// Adds a column; false if it depends linearly on the columns of the fit.
    bool orthogonalized(std::size_t column) {
        std::vector<double> v(n_);
        for (std::size_t i = 0; i < n_; ++i) v[i] = row(i)[column];
        std::vector<double> r(q_.size(), 0.0);
        for (int pass = 0; pass < 2; ++pass)  // a second pass makes v orthogonal despite rounding
            for (std::size_t s = 0; s < r.size(); ++s) {
                const double part = dot(q_[s], v);
                r[s] += part;
                subtract(v, part, q_[s]);
            }
        const double norm = std::sqrt(dot(v, v));
        constexpr double dependent = 1e-6;
        if (!(norm > dependent * std::sqrt(norms_[column]))) return false;
        for (double& value : v) value /= norm;
        chosen_.push_back(column);
        append(std::move(v), r, norm);
        return true;
    }

    /// Appends the basis vector q; its column of R consists of r and, on the diagonal, norm.
    void append(std::vector<double> q, std::span<const double> r, double norm) {
        std::vector<double> column(r.size() + 1, 0.0);
        for (std::size_t s = 0; s < r.size(); ++s)
            for (std::size_t row = 0; row <= s; ++row) column[row] -= back_[s][row] * r[s] / norm;
        column.back() = 1 / norm;
        trace_ += dot(column, column);
        const double along = dot(q, residual_);
        subtract(residual_, along, q);
        for (std::size_t i = 0; i < q.size(); ++i) leverage_[i] += q[i] * q[i];
        q_.push_back(std::move(q));
        back_.push_back(std::move(column));
        along_.push_back(along);
    }

    /// Selection criterion of the current fit, relative to the variance; see the file's header.
    [[nodiscard]] double error() const {
        const auto n = static_cast<double>(n_);
        const auto terms = static_cast<double>(chosen_.size());
        const auto candidates = static_cast<double>(std::max<std::size_t>(candidates_.columns, 2));
        double sum = 0;
        for (std::size_t i = 0; i < n_; ++i) {
            const double left_out = residual_[i] / std::max(1 - leverage_[i], 1e-12);
            sum += left_out * left_out;
        }
        if (whole_ == 0) return sum;
        return sum / whole_ * n / (n - terms - 1) * (1 + trace_) *
               exponential(2 * terms * logarithm(candidates) / n);
    }

    Candidates candidates_;
    std::size_t n_;
    const RunContext& run_;
    std::vector<double> residual_;
    std::vector<double> leverage_;
    std::vector<bool> usable_;
    std::vector<double> norms_;  ///< squared norms of the columns
    double whole_ = 0;           ///< sum of squares of z about its mean
    double trace_ = 0;           ///< trace of the inverse of the Gram matrix
    double least_ = 1;
    std::vector<std::size_t> chosen_;
    std::vector<std::vector<double>> q_;  ///< orthonormal basis of the columns, the constant first
    std::vector<std::vector<double>> back_;  ///< columns of the upper triangular inverse of R
    std::vector<double> along_;              ///< products of z with the basis vectors
};

}  // namespace

SparseFit matching_pursuit(const Candidates& candidates, std::span<const double> z,
                           const RunContext& run) {
    return Pursuit(candidates, z, run).best();
}

}  // namespace stipple::analyzers::sensitivity
