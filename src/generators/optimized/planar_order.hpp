// SPDX-License-Identifier: MIT
//
// The order of n points of the plane by x and by y, and the least star discrepancy of all points that
// lie in it.
//
// With x_1 <= ... <= x_n and y_1 <= ... <= y_n for the sorted coordinates, 1 for x_{n+1} and y_{n+1},
// and c(i, j) for the points among the first i by x and the first j by y, D* <= F / n means
//
//     open    x_i y_j <= (c(i-1, j-1) + F) / n      of the boxes [0, x_i) x [0, y_j)
//     closed  x_i y_j >= (c(i, j) - F) / n          of the boxes [0, x_i] x [0, y_j]
//
// In the logarithms of x and of 1 / y each of these bounds a difference, so that points exist exactly
// if no cycle of bounds contradicts itself. Bellman and Ford's method finds points or such a cycle,
// and the F at which the cycle does not contradict itself any more is a lower bound: raised to it
// until there are points, F is the least of the order, and the last cycle proves it.
//
// Cost    a solution takes some 30 n^2 steps (comparisons of a bound): 0.2 ms for n = 100, 20 ms for
//         n = 1000 on one core; 8 n^2 bytes. A swap takes much less.
// Promise the value is right to 1e-12 relatively, the same on any machine.
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
    /// For each point in the order of x its place, from 0, in the order of y.
    using Ranks = std::vector<std::uint32_t>;

    /// Neighbours in the order of x, or of y, that change places: those at `at` and at + 1, from 1.
    struct Swap {
        bool by_x;
        std::size_t at;
    };

    /// Solves the order. @throws Error(cancelled)
    PlanarOrder(const Ranks& ranks, const RunContext& run);

    [[nodiscard]] Ranks ranks() const;

    /// n times the least star discrepancy.
    [[nodiscard]] double level() const { return level_; }

    /// Points that have it, as rows in the order of x; in [0, 1).
    [[nodiscard]] std::vector<double> points() const;

    /// A swap that changes the count of a box on the critical cycle; nothing at the rim.
    std::optional<Swap> critical_swap(SplitMix64& draws) const;

    /// Swaps if the level is then at most `limit`; true if it did. Gives up what moves more than n
    /// coordinates. A critical swap must lower the level of the cycle that it is on.
    bool attempt(const Swap& swap, double limit, bool critical = false);

    /// Comparisons so far.
    [[nodiscard]] std::uint64_t steps() const { return steps_; }

  private:
    enum class Outcome { feasible, cycle, given_up };

    /// A coordinate, or the 1 that x_{n+1} and y_{n+1} are: 0; x_i is i, y_j is n + j.
    using Node = std::uint32_t;
    struct Bound {  ///< of the box with the count c(i, j)
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
    std::vector<std::size_t> rank_;   ///< of the i-th by x, both from 1
    std::vector<std::size_t> place_;  ///< by x of the j-th by y
    std::vector<float> counts_;       ///< rows i = 0, ..., n, each with j = 0, ..., n + 1
    std::vector<float> transposed_;
    std::vector<double> x_;
    std::vector<double> y_;
    double level_ = 0;
    std::vector<Bound> cycle_;  ///< that no lower level has
    std::vector<Bound> saved_;

    std::vector<Node> from_;              ///< what bounds a node that was moved in this era
    std::vector<std::uint8_t> by_order_;  ///< whether that is its neighbour
    std::vector<std::uint32_t> moved_in_;
    std::uint32_t era_ = 0;
    Node met_ = 0;  ///< where a cycle closed
    std::vector<Node> queue_;
    std::size_t first_ = 0;
    std::size_t last_ = 0;
    std::vector<std::uint8_t> queued_;
    std::vector<std::uint32_t> hits_;  ///< bounds of a row that do not hold

    struct Moved {
        Node node;
        double value;
    };
    std::vector<Moved> undo_;
    bool trying_ = false;  ///< moves are noted, and not too many
    std::uint64_t steps_ = 0;
    std::uint64_t turns_ = 0;
};

}  // namespace stipple
