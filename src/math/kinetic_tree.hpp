// SPDX-License-Identifier: MIT
//
// The highest of m lines at a time x that only grows, while counts are added to suffixes of them.
// With slopes s_0 < s_1 < ... in [0, 1] and integer counts c_j, line j is
//
//     steeper lines win late:   x s_j - c_j / n           (SteepWins::late)
//     steeper lines win early:  c_j / n - x s_j           (SteepWins::early)
//
// A node of a binary tree over the lines keeps the best line below it and the next x at which a
// winner below it changes, so that only the paths to changed winners are walked.
//
// Shape   m lines, x in [0, 1], at most n additions, n <= 2^29.
// Cost    O(m) memory (about 70 bytes a line), O(log m) for an addition; an advance costs O(log m)
//         for each winner that changes, in practice O(log^2 m) in all for each addition.
// Promise `highest` is below the true maximum by at most `tolerance`, from rounding in comparisons
//         of nearly equal lines; `visit_above` misses no line that exceeds its level by that.
// Source  J. Basch, L. J. Guibas, J. Hershberger, J. Algorithms 31 (1999) 1-28 (kinetic
//         tournaments).
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/run_context.hpp"

namespace stipple {

enum class SteepWins { late, early };

template <SteepWins steep>
class KineticTree {
  public:
    /// Largest n.
    static constexpr std::uint32_t max_count = std::uint32_t{1} << 29;

    /// Each comparison errs by a few units of 2^-53, once for each level of the tree.
    static constexpr double tolerance = 0x1p-44;

    /// All counts start at 0, and x at 0. @param slopes ascending, kept by reference.
    /// @throws Error(cancelled)
    KineticTree(std::span<const double> slopes, double n, const RunContext& run)
        : slopes_(slopes), inverse_(1 / n), leaves_(std::bit_ceil(slopes.size())) {
        constexpr std::size_t checks_apart = 1 << 16;
        nodes_.resize(2 * leaves_);
        for (std::size_t u = 2 * leaves_; --u > 0;) {
            if (u % checks_apart == 0) run.check_stop();
            if (u >= leaves_)
                nodes_[u] = leaf(u - leaves_);
            else
                pull(u, 0);
        }
    }

    /// Bytes for `lines` lines.
    static double memory(std::size_t lines) {
        return static_cast<double>(2 * std::bit_ceil(lines) * sizeof(Node));
    }

    /// Adds 1 to the counts of lines first, first + 1, ...
    void add_from(std::size_t first, double x) {
        if (first >= slopes_.size()) return;
        std::size_t u = leaves_ + first;
        ++nodes_[u].count;
        for (; u > 1; u /= 2) {
            if (u % 2 == 0) {
                ++nodes_[u + 1].count;
                ++nodes_[u + 1].added;
            }
            pull(u / 2, x);
        }
    }

    /// Moves on to x, which is not below any earlier one.
    void advance(double x) {
        if (nodes_[1].change <= x) refresh(1, x);
    }

    /// The maximum at x, after advance(x).
    [[nodiscard]] double highest(double x) const { return value(nodes_[1], 0, x); }

    /// Calls visit(j, count) for every line that is at least level() high at x, after advance(x);
    /// the highest comes first, so that a level that rises with what is visited ends it early.
    template <class Level, class Visit>
    void visit_above(const Level& level, double x, Visit&& visit) const {
        descend(1, 0, level, x, visit);
    }

  private:
    struct Node {
        double slope;        ///< of the winner
        double change;       ///< next x at which a winner in here changes
        std::int32_t count;  ///< of the winner, without what was added to ancestors
        std::int32_t added;  ///< to all lines in here
    };

    /// Leaves behind the last line never win at x <= 1: they lie 2 or more below all others, or 1
    /// or more after additions to them alone.
    Node leaf(std::size_t j) const {
        constexpr double never = std::numeric_limits<double>::infinity();
        constexpr auto far = static_cast<std::int32_t>(2 * max_count);
        if (j < slopes_.size()) return {slopes_[j], never, 0, 0};
        return {1.5, never, steep == SteepWins::late ? far : -far, 0};
    }

    double value(const Node& node, std::int32_t above, double x) const {
        const double share = static_cast<double>(node.count + above) * inverse_;
        return steep == SteepWins::late ? x * node.slope - share : share - x * node.slope;
    }

    /// Works out the winner of u from its children.
    void pull(std::size_t u, double x) {
        const Node& left = nodes_[2 * u];
        const Node& right = nodes_[2 * u + 1];
        const double gain = static_cast<double>(right.count - left.count) * inverse_;
        const double crossing = gain / (right.slope - left.slope);
        const bool crossed = crossing <= x;
        const Node& winner = crossed == (steep == SteepWins::late) ? right : left;
        Node& node = nodes_[u];
        node.slope = winner.slope;
        node.count = winner.count + node.added;
        node.change = std::min(left.change, right.change);
        if (!crossed) node.change = std::min(node.change, crossing);
    }

    void refresh(std::size_t u, double x) {
        for (const std::size_t child : {2 * u, 2 * u + 1})
            if (nodes_[child].change <= x) refresh(child, x);
        pull(u, x);
    }

    template <class Level, class Visit>
    void descend(std::size_t u, std::int32_t above, const Level& level, double x,
                 Visit& visit) const {
        const Node& node = nodes_[u];
        if (value(node, above, x) < level() - tolerance) return;
        if (u >= leaves_) {
            visit(u - leaves_, node.count + above);
            return;
        }
        above += node.added;
        const bool right = value(nodes_[2 * u + 1], above, x) > value(nodes_[2 * u], above, x);
        descend(2 * u + (right ? 1 : 0), above, level, x, visit);
        descend(2 * u + (right ? 0 : 1), above, level, x, visit);
    }

    std::span<const double> slopes_;
    double inverse_;
    std::size_t leaves_;
    std::vector<Node> nodes_;
};

}  // namespace stipple
