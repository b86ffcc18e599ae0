// SPDX-License-Identifier: MIT
//
// Upper bound on the distance from any point of a box to the nearest of some given points:
//
//     max over x in the box of  min over i of  |x - q_i|^2
//         <=  min over w >= 0, sum w_i = 1  of  max over x of  sum_i w_i |x - q_i|^2
//          =  min over w of  sum_k h_k^2 + sum_i w_i |q_i|^2 + 2 sum_k h_k |sum_i w_i q_ik|,
//
// with the box's centre as the origin and h_k half of its sides. The sum is convex in x, so its
// maximum is at a corner. The best w comes from the simplex method, with a basis of D + 1 columns
// for points and for the two signs of terms in the last sum.
//
// Shape    D dimensions, or for D = 0 up to 32, given at run time; at least one point.
// Cost     about 2 D steps of O(D^2 + points D).
// Promise  never below the maximum, except by rounding. Exceeds it (as a squared distance) by at
//          most the sum of h_k^2 plus the tolerance. So the excess is quadratic in the box's size.
//          A bound by the farthest corner from a single point has a linear excess.
// Source   the bound is the Lagrange dual; G. B. Dantzig, "Linear Programming and Extensions", 1963
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
    static constexpr std::size_t most = D > 0 ? D : 32;

  public:
    using Point = std::array<double, most>;  ///< only the first D coordinates are used

    /// @param tolerance relative tolerance of the squared distance
    explicit CoveringBound(std::size_t dimension = D, double tolerance = 1e-3)
        : dimension_(dimension), tolerance_(tolerance) {}

    void clear() { points_.clear(); }
    [[nodiscard]] bool empty() const { return points_.empty(); }

    /// Adds a point, relative to the centre of the box.
    void add(const Point& q) {
        double norm = 0;
        for (std::size_t k = 0; k < d(); ++k) norm += q[k] * q[k];
        points_.push_back({q, norm});
    }

    /// Bound on the squared distance for the box with half sides h_k = half[k].
    double squared(const Point& half) {
        begin(half);
        for (std::size_t step = 0; step < 20 * rows(); ++step)
            if (!improve(half)) break;
        return value(half);
    }

    /// Point of the box, relative to its centre, where the squared distance is at least the last
    /// bound minus the sum of h_k^2.
    [[nodiscard]] Point place(const Point& half) const {
        Point place{};
        for (std::size_t k = 0; k < d(); ++k)
            place[k] = std::clamp(prices_[k] / 2, -half[k], half[k]);
        return place;
    }

    /// Calls visit(q) for the points that determine the last bound, at most D + 1.
    template <class Visit>
    void visit_basis(const Visit& visit) const {
        for (std::size_t i = 0; i < rows(); ++i)
            if (is_point(basis_[i])) visit(points_[basis_[i] - 2 * d()].q);
    }

  private:
    struct Candidate {
        Point q;
        double norm;
    };
    using Row = std::array<double, most + 1>;

    [[nodiscard]] std::size_t d() const { return D > 0 ? D : dimension_; }
    [[nodiscard]] std::size_t rows() const { return d() + 1; }

    /// True for columns of points. Columns 2 k and 2 k + 1, k < D, are the slacks +k and -k.
    [[nodiscard]] bool is_point(std::size_t id) const { return id >= 2 * d(); }
    static std::size_t slack(std::size_t k, bool negative) { return 2 * k + (negative ? 1 : 0); }

    /// Starts with all weight on the nearest point; slacks of its coordinates complete the basis.
    void begin(const Point& half) {
        const auto by_norm = [](const Candidate& a, const Candidate& b) { return a.norm < b.norm; };
        const auto nearest = std::ranges::min_element(points_, by_norm);
        for (std::size_t i = 0; i < rows(); ++i) std::fill_n(inverse_[i].begin(), rows(), 0.0);
        for (std::size_t k = 0; k < d(); ++k) {
            const bool negative = nearest->q[k] < 0;
            const double sign = negative ? 1 : -1;
            basis_[k] = slack(k, negative);
            inverse_[k][k] = sign;
            inverse_[k][d()] = -sign * nearest->q[k];
            prices_[k] = 2 * half[k] * sign;
        }
        basis_[d()] = 2 * d() + static_cast<std::size_t>(nearest - points_.begin());
        inverse_[d()][d()] = 1;
        prices_[d()] = nearest->norm;
        for (std::size_t k = 0; k < d(); ++k) prices_[d()] += 2 * half[k] * std::abs(nearest->q[k]);
    }

    /// Takes a step of the simplex method; returns false if no step improves the bound.
    bool improve(const Point& half) {
        double least = -tolerance_ * prices_[d()];
        std::size_t entering = none;
        const auto offer = [&](double reduced, std::size_t column) {
            if (reduced >= least) return;
            least = reduced;
            entering = column;
        };
        for (std::size_t k = 0; k < d(); ++k) {
            offer(2 * half[k] + prices_[k], slack(k, false));
            offer(2 * half[k] - prices_[k], slack(k, true));
        }
        for (std::size_t i = 0; i < points_.size(); ++i) {
            double reduced = points_[i].norm - prices_[d()];
            for (std::size_t k = 0; k < d(); ++k) reduced -= prices_[k] * points_[i].q[k];
            offer(reduced, 2 * d() + i);
        }
        return entering != none && exchange(entering, least);
    }

    /// Brings the column `entering`, whose reduced cost is `reduced`, into the basis.
    bool exchange(std::size_t entering, double reduced) {
        const Row column = column_of(entering);
        std::size_t leaving = none;
        double shortest = 0;
        for (std::size_t i = 0; i < rows(); ++i) {
            if (!(column[i] > 1e-12)) continue;
            const double ratio = inverse_[i][d()] / column[i];
            if (leaving != none && ratio >= shortest) continue;
            leaving = i;
            shortest = ratio;
        }
        if (leaving == none) return false;
        Row& pivot = inverse_[leaving];
        for (std::size_t k = 0; k < rows(); ++k) pivot[k] /= column[leaving];
        for (std::size_t i = 0; i < rows(); ++i)
            for (std::size_t k = 0; k < rows() && i != leaving; ++k)
                inverse_[i][k] -= column[i] * pivot[k];
        for (std::size_t k = 0; k < rows(); ++k) prices_[k] += reduced * pivot[k];
        basis_[leaving] = entering;
        return true;
    }

    /// Expresses a column in the basis.
    [[nodiscard]] Row column_of(std::size_t id) const {
        Row column;
        for (std::size_t i = 0; i < rows(); ++i) {
            if (!is_point(id)) {
                column[i] = id % 2 == 1 ? inverse_[i][id / 2] : -inverse_[i][id / 2];
                continue;
            }
            column[i] = inverse_[i][d()];
            for (std::size_t k = 0; k < d(); ++k)
                column[i] += inverse_[i][k] * points_[id - 2 * d()].q[k];
        }
        return column;
    }

    /// The bound for the current weights, by the formula at the top. It holds for any weights.
    [[nodiscard]] double value(const Point& half) const {
        double total = 0;
        double norms = 0;
        Point mean{};
        for (std::size_t i = 0; i < rows(); ++i) {
            if (!is_point(basis_[i])) continue;
            const Candidate& point = points_[basis_[i] - 2 * d()];
            const double weight = std::max(0.0, inverse_[i][d()]);
            total += weight;
            norms += weight * point.norm;
            for (std::size_t k = 0; k < d(); ++k) mean[k] += weight * point.q[k];
        }
        double squared = norms / total;
        for (std::size_t k = 0; k < d(); ++k)
            squared += half[k] * half[k] + 2 * half[k] * std::abs(mean[k]) / total;
        return squared;
    }

    static constexpr std::size_t none = static_cast<std::size_t>(-1);

    std::size_t dimension_;
    double tolerance_;
    std::vector<Candidate> points_;
    std::array<std::size_t, most + 1> basis_{};
    std::array<Row, most + 1> inverse_{};  ///< inverse of the basis; last column: basic solution
    Row prices_{};                         ///< dual variables; the last one is the bound
};

}  // namespace stipple
