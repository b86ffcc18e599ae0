// SPDX-License-Identifier: MIT
#include "analyzers/distances/simplex_bound.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace stipple::analyzers {
namespace {

/// The dual in standard form: a column for each weight, then for each axis one for the positive and
/// one for the negative part of -m_k; rows say that weights sum to 1 and that m_k plus those parts
/// is 0. Row 0 holds reduced costs. The last column is the right side.
class Tableau {
  public:
    Tableau(Neighborhood& near, std::span<const double> half)
        : near_(near),
          half_(half),
          points_(near.count()),
          d_(half.size()),
          width_(points_ + 2 * d_ + 1),
          basis_(d_ + 1) {
        near.table.assign((d_ + 2) * width_, 0.0);
        fill();
    }

    /// Steps until no column is better, or as often as would be odd to be needed.
    void solve() {
        const std::size_t most = 20 * (d_ + 2);
        for (std::size_t step = 0; step < most; ++step) {
            const std::size_t column = best_column();
            if (column == width_) return;
            const std::size_t row = limiting_row(column);
            if (row > d_ + 1) return;
            pivot(row, column);
        }
    }

    /// Bound and place from the weights that were found.
    [[nodiscard]] SimplexBound result() const {
        SimplexBound found{0, std::vector<double>(d_, 0.0)};
        std::vector<double>& mean = found.place;
        double sum = 0;
        for (std::size_t r = 0; r <= d_; ++r) {
            if (basis_[r] >= points_) continue;
            const double weight = std::max(0.0, at(r + 1, width_ - 1));
            const double* u = near_[basis_[r]];
            sum += weight;
            for (std::size_t k = 0; k < d_; ++k) {
                mean[k] += weight * u[k];
                found.squared += weight * u[k] * u[k];
            }
        }
        found.squared /= sum;
        for (std::size_t k = 0; k < d_; ++k)
            found.squared += half_[k] * (half_[k] + 2 * std::abs(mean[k] / sum));
        for (std::size_t k = 0; k < d_; ++k)
            found.place[k] = std::clamp(half_[k] - at(0, points_ + k) / 2, -half_[k], half_[k]);
        return found;
    }

  private:
    double& at(std::size_t row, std::size_t column) { return near_.table[row * width_ + column]; }
    [[nodiscard]] double at(std::size_t row, std::size_t column) const {
        return near_.table[row * width_ + column];
    }

    [[nodiscard]] double squared(std::size_t i) const {
        double sum = 0;
        for (std::size_t k = 0; k < d_; ++k) sum += near_[i][k] * near_[i][k];
        return sum;
    }

    /// All weight on the nearest point; row 1 is the sum, row 2 + k axis k.
    void fill() {
        for (std::size_t i = 0; i < points_; ++i) {
            at(0, i) = squared(i);
            at(1, i) = 1;
        }
        at(1, width_ - 1) = 1;
        basis_[0] = 0;
        const double* nearest = near_[0];
        for (std::size_t k = 0; k < d_; ++k) {
            const double sign = nearest[k] > 0 ? -1 : 1;
            for (std::size_t i = 0; i < points_; ++i)
                at(2 + k, i) = sign * (near_[i][k] - nearest[k]);
            at(2 + k, points_ + k) = sign;
            at(2 + k, points_ + d_ + k) = -sign;
            at(2 + k, width_ - 1) = std::abs(nearest[k]);
            at(0, points_ + k) = at(0, points_ + d_ + k) = 2 * half_[k];
            basis_[1 + k] = points_ + k + (sign > 0 ? 0 : d_);
        }
        for (std::size_t r = 0; r <= d_; ++r) clear_cost(r);
    }

    /// Makes the reduced cost of a row's basic column 0.
    void clear_cost(std::size_t r) {
        const double cost = at(0, basis_[r]);
        for (std::size_t j = 0; j < width_; ++j) at(0, j) -= cost * at(r + 1, j);
    }

    [[nodiscard]] std::size_t best_column() const {
        std::size_t best = width_;
        double least = -1e-13;
        for (std::size_t j = 0; j + 1 < width_; ++j) {
            if (at(0, j) >= least) continue;
            least = at(0, j);
            best = j;
        }
        return best;
    }

    [[nodiscard]] std::size_t limiting_row(std::size_t column) const {
        std::size_t best = d_ + 2;
        double least = 0;
        for (std::size_t r = 1; r <= d_ + 1; ++r) {
            if (at(r, column) <= 1e-12) continue;
            const double ratio = at(r, width_ - 1) / at(r, column);
            if (best <= d_ + 1 && ratio >= least) continue;
            least = ratio;
            best = r;
        }
        return best;
    }

    void pivot(std::size_t row, std::size_t column) {
        const double divisor = at(row, column);
        for (std::size_t j = 0; j < width_; ++j) at(row, j) /= divisor;
        for (std::size_t r = 0; r <= d_ + 1; ++r) {
            const double factor = at(r, column);
            if (r == row || factor == 0) continue;
            for (std::size_t j = 0; j < width_; ++j) at(r, j) -= factor * at(row, j);
            at(r, column) = 0;
        }
        basis_[row - 1] = column;
    }

    Neighborhood& near_;
    std::span<const double> half_;
    std::size_t points_;
    std::size_t d_;
    std::size_t width_;
    std::vector<std::size_t> basis_;  ///< the column of each row but the costs'
};

}  // namespace

SimplexBound bound_in_box(Neighborhood& near, std::span<const double> half) {
    // In units of the largest length, so that what is negligible can be said in numbers.
    double unit = 0;
    for (const double u : near.offsets) unit = std::max(unit, std::abs(u));
    for (const double h : half) unit = std::max(unit, h);
    if (!(unit > 0)) return {0, std::vector<double>(half.size(), 0.0)};
    for (double& u : near.offsets) u /= unit;
    std::vector<double> sides(half.begin(), half.end());
    for (double& h : sides) h /= unit;
    Tableau tableau(near, sides);
    tableau.solve();
    SimplexBound found = tableau.result();
    found.squared *= unit * unit;
    for (double& y : found.place) y *= unit;
    return found;
}

}  // namespace stipple::analyzers
