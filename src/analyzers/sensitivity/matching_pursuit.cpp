// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/matching_pursuit.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

double dot(std::span<const double> a, std::span<const double> b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

void subtract(std::vector<double>& from, double factor, std::span<const double> b) {
    for (std::size_t i = 0; i < from.size(); ++i) from[i] -= factor * b[i];
}

/// One call: the fit grows column by column.
class Pursuit {
  public:
    Pursuit(const Candidates& candidates, std::span<const double> z, const RunContext& run)
        : candidates_(candidates),
          z_(z),
          run_(worth_threads(silent(run), 1e-9 * static_cast<double>(candidates.values.size()))),
          residual_(z.begin(), z.end()),
          leverage_(z.size(), 0.0),
          usable_(candidates.columns, true),
          norms_(column_sums([](double v, double) { return v * v; })) {
        const auto n = static_cast<double>(z.size());
        append(std::vector(z.size(), 1 / std::sqrt(n)), {}, std::sqrt(n));
        least_ = error();
    }

    SparseFit best() {
        const std::size_t most = std::min({candidates_.columns, z_.size() / 2, most_terms});
        constexpr std::size_t patience = 10;
        constexpr double exact = 1e-24;
        std::size_t best = 0;
        while (fit_.chosen.size() < most && take_next()) {
            const double now = error();
            if (now < least_) {
                least_ = now;
                best = fit_.chosen.size();
            }
            if (least_ < exact || fit_.chosen.size() > best + best / 4 + patience) break;
        }
        fit_.chosen.resize(best);
        fit_.q.resize(best + 1);
        fit_.back.resize(best + 1);
        fit_.along.resize(best + 1);
        fit_.error = least_;
        return std::move(fit_);
    }

  private:
    /// sum over the rows of term(value, residual), column by column.
    template <class Term>
    std::vector<double> column_sums(const Term& term) const {
        std::vector<double> sums(candidates_.columns, 0.0);
        for_each_block(run_, candidates_.columns, 64, [&](const Block& block) {
            for (std::size_t i = 0; i < z_.size(); ++i) {
                const double* row = candidates_.values.data() + i * candidates_.columns;
                const double rest = residual_[i];
                for (std::uint64_t j = block.first; j < block.last; ++j)
                    sums[j] += term(row[j], rest);
            }
        });
        return sums;
    }

    /// Takes in the column that correlates most with the residual; false: none is left.
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

    /// Takes in a column; false: it depends on those that are in.
    bool orthogonalized(std::size_t column) {
        std::vector<double> v(z_.size());
        for (std::size_t i = 0; i < v.size(); ++i)
            v[i] = candidates_.values[i * candidates_.columns + column];
        std::vector<double> r(fit_.q.size(), 0.0);
        for (int pass = 0; pass < 2; ++pass)  // twice is enough
            for (std::size_t s = 0; s < r.size(); ++s) {
                const double part = dot(fit_.q[s], v);
                r[s] += part;
                subtract(v, part, fit_.q[s]);
            }
        const double norm = std::sqrt(dot(v, v));
        constexpr double dependent = 1e-6;
        if (!(norm > dependent * std::sqrt(norms_[column]))) return false;
        for (double& value : v) value /= norm;
        fit_.chosen.push_back(column);
        append(std::move(v), r, norm);
        return true;
    }

    /// Appends a basis vector, and its column (r, norm) of R.
    void append(std::vector<double> q, std::span<const double> r, double norm) {
        std::vector<double> column(r.size() + 1, 0.0);
        for (std::size_t s = 0; s < r.size(); ++s)
            for (std::size_t row = 0; row <= s; ++row)
                column[row] -= fit_.back[s][row] * r[s] / norm;
        column.back() = 1 / norm;
        trace_ += dot(column, column);
        const double along = dot(q, residual_);
        subtract(residual_, along, q);
        for (std::size_t i = 0; i < q.size(); ++i) leverage_[i] += q[i] * q[i];
        fit_.q.push_back(std::move(q));
        fit_.back.push_back(std::move(column));
        fit_.along.push_back(along);
    }

    /// The corrected leave-one-out error of the fit as it is.
    [[nodiscard]] double error() const {
        const auto n = static_cast<double>(z_.size());
        double sum = 0;
        for (std::size_t i = 0; i < z_.size(); ++i) {
            const double left_out = residual_[i] / std::max(1 - leverage_[i], 1e-12);
            sum += left_out * left_out;
        }
        const auto terms = static_cast<double>(fit_.q.size());
        return sum / dot(z_, z_) * n / (n - terms) * (1 + trace_);
    }

    Candidates candidates_;
    std::span<const double> z_;
    RunContext run_;
    std::vector<double> residual_;
    std::vector<double> leverage_;
    std::vector<bool> usable_;
    std::vector<double> norms_;  ///< squared
    double trace_ = 0;           ///< of the inverse of the Gram matrix
    double least_ = 1;
    SparseFit fit_;
};

}  // namespace

std::vector<double> SparseFit::coefficients() const {
    std::vector<double> c(along.size(), 0.0);
    for (std::size_t s = 0; s < along.size(); ++s)
        for (std::size_t row = 0; row <= s; ++row) c[row] += back[s][row] * along[s];
    c.erase(c.begin());
    return c;
}

std::vector<double> SparseFit::residual(std::span<const double> z) const {
    std::vector<double> rest(z.begin(), z.end());
    for (std::size_t s = 0; s < q.size(); ++s) subtract(rest, along[s], q[s]);
    return rest;
}

SparseFit sparse_fit(const Candidates& candidates, std::span<const double> z,
                     const RunContext& run) {
    return Pursuit(candidates, z, run).best();
}

}  // namespace stipple::analyzers::sensitivity
