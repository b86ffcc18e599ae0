// SPDX-License-Identifier: MIT
//
// How far a place of a box can be from the nearest of some points, from above:
//
//     max over x in the box of  min over i of  |x - q_i|^2
//         <=  min over w >= 0, sum w_i = 1  of  max over x of  sum_i w_i |x - q_i|^2
//          =  min over w of  sum_k h_k^2 + sum_i w_i |q_i|^2 + 2 sum_k h_k |sum_i w_i q_ik|,
//
// with the box's centre as the origin and h_k half of its sides: the sum is convex in x, and has
// its maximum in a corner. The best w is found by the simplex method, in a basis of D + 1 columns:
// points, and the two signs of the last sum's terms.
//
// Shape    D directions, at least one point.
// Cost     about 2 D steps of O(D^2 + points D).
// Promise  never below the maximum but by rounding. Above it by the sum of h_k^2 at most (squared
//          distances), and a thousandth: its excess falls with the square of the box's size, where
//          the distance of one point to the farthest corner would be off by the size itself.
// Source   the bound is Lagrange's dual; G. B. Dantzig, "Linear Programming and Extensions", 1963
//          (simplex method).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stipple {

template <std::size_t D>
class CoveringBound {
  public:
    using Point = std::array<double, D>;

    void clear() { points_.clear(); }
    [[nodiscard]] bool empty() const { return points_.empty(); }

    /// A point, as seen from the centre of the box.
    void add(const Point& q) {
        double norm = 0;
        for (const double x : q) norm += x * x;
        points_.push_back({q, norm});
    }

    /// The bound of the squared distance, for a box of these half sides.
    double squared(const Point& half) {
        begin(half);
        for (std::size_t step = 0; step < 4 * (D + 1); ++step)
            if (!improve(half)) break;
        return value(half);
    }

    /// Calls visit(q) for the points that the last bound rests on, D + 1 at most.
    template <class Visit>
    void visit_basis(const Visit& visit) const {
        for (const std::size_t id : basis_)
            if (id >= 2 * D) visit(points_[id - 2 * D].q);
    }

  private:
    static constexpr std::size_t rows = D + 1;
    static constexpr double tolerance = 1e-3;  ///< of the squared distance

    struct Candidate {
        Point q;
        double norm;
    };
    using Row = std::array<double, rows>;

    /// Columns below 2 D are slacks, +k and -k in turn; others are points.
    static std::size_t slack(std::size_t k, bool negative) { return 2 * k + (negative ? 1 : 0); }

    /// All weight on the nearest point, and slacks that take up its coordinates.
    void begin(const Point& half) {
        const auto by_norm = [](const Candidate& a, const Candidate& b) { return a.norm < b.norm; };
        const auto nearest = std::ranges::min_element(points_, by_norm);
        inverse_ = {};
        prices_ = {};
        for (std::size_t k = 0; k < D; ++k) {
            const bool negative = nearest->q[k] < 0;
            const double sign = negative ? 1 : -1;
            basis_[k] = slack(k, negative);
            inverse_[k][k] = sign;
            inverse_[k][D] = -sign * nearest->q[k];
            prices_[k] = 2 * half[k] * sign;
        }
        basis_[D] = 2 * D + static_cast<std::size_t>(nearest - points_.begin());
        inverse_[D][D] = 1;
        prices_[D] = nearest->norm;
        for (std::size_t k = 0; k < D; ++k) prices_[D] += 2 * half[k] * std::abs(nearest->q[k]);
    }

    /// One step of the simplex method; whether there was one to take.
    bool improve(const Point& half) {
        double least = -tolerance * prices_[D];
        std::size_t entering = none;
        const auto offer = [&](double reduced, std::size_t column) {
            if (reduced >= least) return;
            least = reduced;
            entering = column;
        };
        for (std::size_t k = 0; k < D; ++k) {
            offer(2 * half[k] + prices_[k], slack(k, false));
            offer(2 * half[k] - prices_[k], slack(k, true));
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            double reduced = points_[i].norm - prices_[D];
            for (std::size_t k = 0; k < D; ++k) reduced -= prices_[k] * points_[i].q[k];
            offer(reduced, 2 * D + i);
        }
        return entering != none && exchange(entering, least);
    }

    /// Takes a column of that reduced cost into the basis.
    bool exchange(std::size_t entering, double reduced) {
        const Row column = column_of(entering);
        std::size_t leaving = none;
        double shortest = 0;
        for (std::size_t i = 0; i < rows; ++i) {
            if (!(column[i] > 1e-12)) continue;
            const double ratio = inverse_[i][D] / column[i];
            if (leaving != none && ratio >= shortest) continue;
            leaving = i;
            shortest = ratio;
        }
        if (leaving == none) return false;
        Row& pivot = inverse_[leaving];
        for (double& x : pivot) x /= column[leaving];
        for (std::size_t i = 0; i < rows; ++i)
            for (std::size_t k = 0; k < rows && i != leaving; ++k)
                inverse_[i][k] -= column[i] * pivot[k];
        for (std::size_t k = 0; k < rows; ++k) prices_[k] += reduced * pivot[k];
        basis_[leaving] = entering;
        return true;
    }

    /// A column in terms of the basis.
    [[nodiscard]] Row column_of(std::size_t id) const {
        Row column;
        for (std::size_t i = 0; i < rows; ++i) {
            if (id < 2 * D) {
                column[i] = id % 2 == 1 ? inverse_[i][id / 2] : -inverse_[i][id / 2];
                continue;
            }
            column[i] = inverse_[i][D];
            for (std::size_t k = 0; k < D; ++k)
                column[i] += inverse_[i][k] * points_[id - 2 * D].q[k];
        }
        return column;
    }

    /// The bound with the weights found, from the formula: it holds for any weights.
    [[nodiscard]] double value(const Point& half) const {
        double total = 0;
        double norms = 0;
        Point mean{};
        for (std::size_t i = 0; i < rows; ++i) {
            if (basis_[i] < 2 * D) continue;
            const Candidate& point = points_[basis_[i] - 2 * D];
            const double weight = std::max(0.0, inverse_[i][D]);
            total += weight;
            norms += weight * point.norm;
            for (std::size_t k = 0; k < D; ++k) mean[k] += weight * point.q[k];
        }
        double squared = norms / total;
        for (std::size_t k = 0; k < D; ++k)
            squared += half[k] * half[k] + 2 * half[k] * std::abs(mean[k]) / total;
        return squared;
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::vector<Candidate> points_;
    std::array<std::size_t, rows> basis_{};
    std::array<Row, rows> inverse_{};  ///< of the basis; its last column is the basic solution
    Row prices_{};                     ///< dual; the last is the bound
};

}  // namespace stipple
