// SPDX-License-Identifier: MIT
//
// Order of n points of the plane by x and by y, and the least star discrepancy of all points in
// that order.
//
// Let x_1 <= ... <= x_n and y_1 <= ... <= y_n be the sorted coordinates, x_{n+1} = y_{n+1} = 1, and
// c(i, j) the number of points among the first i by x and the first j by y. Then D* <= F / n means
//
//     open    x_i y_j <= (c(i-1, j-1) + F) / n      of the boxes [0, x_i) x [0, y_j)
//     closed  x_i y_j >= (c(i, j) - F) / n          of the boxes [0, x_i] x [0, y_j]
//
// In the logarithms of x and of 1 / y each of these bounds a difference, so a solution exists
// exactly if no cycle of bounds is contradictory. The Bellman-Ford method finds a solution or such
// a cycle. The F at which the cycle becomes consistent is a lower bound. F is raised to that bound,
// until a solution exists: then F is the least value of the order, as the last cycle proves.
//
// Cost    a first solution takes some 30 n^2 steps (comparisons of a bound): 0.2 ms for n = 100, 20
//         ms for n = 1000 on one core; 8 n^2 bytes. The solution after a swap takes much less.
// Promise the relative error of the value is at most 1e-12, and the value the same on any machine.
// Source  the constraints are those of F. Clement, C. Doerr, K. Klamroth, L. Paquete,
//         arXiv:2311.17463; R. Bellman, Quart. Appl. Math. 16 (1958) 87-90.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/combinatorics/splitmix64.hpp"
#include "stipple/run.hpp"

namespace stipple {

class PlanarOrder {
  public:
    /// For each point in the order of x, its rank by y, from 0.
    using Ranks = std::vector<std::uint32_t>;

    /// Exchange of the neighbours with ranks `at` and at + 1 (from 1) in the order of x or of y.
    struct Swap {
        bool by_x;
        std::size_t at;
    };

    /// Finds the level of the order by a first solution. @throws Error(cancelled)
    PlanarOrder(const Ranks& ranks, const RunContext& run);

    [[nodiscard]] Ranks ranks() const;

    /// n times the least star discrepancy.
    [[nodiscard]] double level() const { return level_; }

    /// Points that attain the level, as rows in the order of x; in [0, 1).
    [[nodiscard]] std::vector<double> points() const;

    /// A random swap that may change the count of a box on the critical cycle; nullopt if the side
    /// of that box is not between two points.
    std::optional<Swap> critical_swap(SplitMix64& draws) const;

    /// Makes the swap if the level is then at most `limit`; returns whether it was made. Gives up
    /// if more than n coordinates move. If `critical`, the swap must also lower the level at which
    /// the current cycle becomes consistent.
    bool attempt(const Swap& swap, double limit, bool critical = false);

    /// Number of comparisons of bounds so far.
    [[nodiscard]] std::uint64_t steps() const { return steps_; }

  private:
    enum class Outcome { feasible, cycle, given_up };

    /// Index of a coordinate: i for x_i, n + j for y_j, 0 for x_{n+1} = 1 and y_{n+1} = 1.
    using Node = std::uint32_t;
    struct Bound {  ///< bound set by the box with the count c(i, j)
        bool open;
        std::size_t i;
        std::size_t j;
    };

    [[nodiscard]] float count(std::size_t i, std::size_t j) const {
        return counts_[i * stride_ + j];
    }
    void change(std::size_t i, std::size_t j, float by);
    void exchange(const Swap& swap);
    [[nodiscard]] bool is_critical(const Swap& swap) const;

    [[nodiscard]] double value(Node node) const;
    void put(Node node, double value);
    bool move(Node node, Node from, bool by_order, double value);
    void push(Node node);
    void push_all();
    Node pop();
    void begin();

    bool relax_x(std::size_t i, Node node);
    bool relax_y(std::size_t j, Node node);
    Outcome relax();
    void take_cycle();
    [[nodiscard]] double level_of_cycle() const;
    void raise();
    bool settle(double limit);
    void lower();
    void tighten(const Swap& swap, bool more);
    void restore();
    void normalise();

    RunContext run_;
    std::size_t n_;
    std::size_t stride_;
    std::vector<std::size_t> rank_;   ///< rank by y of the i-th point by x, both from 1
    std::vector<std::size_t> place_;  ///< rank by x of the j-th point by y
    std::vector<float> counts_;       ///< c(i, j): rows i = 0, ..., n, each with j = 0, ..., n + 1
    std::vector<float> transposed_;
    std::vector<double> x_;
    std::vector<double> y_;
    double level_ = 0;
    std::vector<Bound> cycle_;  ///< critical cycle: proves that no lower level is possible
    std::vector<Bound> saved_;

    std::vector<Node> from_;  ///< for a node moved since begin(): the node that bounds it
    std::vector<std::uint8_t> by_order_;  ///< whether that node is the neighbour in the order
    std::vector<std::uint32_t> moved_in_;
    std::uint32_t era_ = 0;
    Node met_ = 0;  ///< node at which a cycle closed
    std::vector<Node> queue_;
    std::size_t first_ = 0;
    std::size_t last_ = 0;
    std::vector<std::uint8_t> queued_;
    std::vector<std::uint32_t> hits_;  ///< indices of the violated bounds of a row

    struct Moved {
        Node node;
        double value;
    };
    std::vector<Moved> undo_;
    bool trying_ = false;  ///< whether moves are recorded for undo and limited in number
    std::uint64_t steps_ = 0;
    std::uint64_t turns_ = 0;
};

}  // namespace stipple
