// SPDX-License-Identifier: MIT
//
// Balanced k-d tree of n points in d dimensions: finds the nearest ones to a position.
//
//     distance^2 = sum_k d_k^2,    d_k = |p_k - q_k|,  on the torus min(d_k, side_k - d_k),
//
// or, in other norms, the square of sum_k d_k (Manhattan) or of max_k d_k (Chebyshev).
//
// Every node stores the tightest box around its points, and their lowest index. It is split across
// the longest side of that box, so that clustered points cost no more than even ones.
//
// Shape    n < 2^32 points, d >= 1 (1 to 4 are fastest; in hundreds of dimensions little can be
//          skipped, and a query costs O(n d)). On the torus, points and positions are in one box
//          with the sides `sides`, including its upper faces.
// Cost     O(n log n (log n + d)) to build; O(log n) per query in few dimensions. For 10^6 points
//          in 2-D on one core: 0.5 s to build, 0.4 s for the nearest neighbours of all; 32 bytes
//          per point, and 24 more while building.
// Promise  exact: the same result as comparing all points by the formula above in float64, summed
//          in the order of k. Of equally near points those with the lowest indices. The same for
//          any number of threads. const functions are thread-safe.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// A point of the set, and its squared distance from a position.
struct Neighbor {
    double squared;
    std::size_t index;

    auto operator<=>(const Neighbor&) const = default;

    /// True if nearer, or equally near with a lower index; equivalent to the default, but faster.
    friend bool operator<(const Neighbor& a, const Neighbor& b) {
        return a.squared < b.squared || (a.squared == b.squared && a.index < b.index);
    }
};

/// Rule by which the distances along the axes are combined.
enum class Norm { euclidean, manhattan, chebyshev };

/// Squared distance of two positions, by the formula at the top.
double squared_distance(std::span<const double> p, std::span<const double> q,
                        const std::vector<double>& sides, Norm norm);

class KdTree {
  public:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// Copies the rows of `dimension` numbers. `sides` are those of the box on the torus, whose
    /// opposite faces are joined; empty for no torus.
    /// @throws Error(limit, cancelled)
    KdTree(std::span<const double> rows, std::size_t dimension, std::vector<double> sides,
           const RunContext& run, Norm norm = Norm::euclidean);

    [[nodiscard]] std::size_t count() const { return indices_.size(); }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] bool torus() const { return !sides_.empty(); }

    /// Coordinates and index of a point by rank, its position in the order of the leaves.
    /// Neighbours mostly have close ranks.
    [[nodiscard]] const double* row(std::size_t rank) const {
        return rows_.data() + rank * dimension_;
    }
    [[nodiscard]] std::size_t index(std::size_t rank) const { return indices_[rank]; }

    /// The nearest point; index `none` and an infinite distance if there are no points.
    [[nodiscard]] Neighbor nearest(std::span<const double> place) const;

    /// The k nearest points, fewer if there are fewer, nearest first. k must be at least 1.
    [[nodiscard]] std::vector<Neighbor> nearest_several(std::span<const double> place,
                                                        std::size_t k) const;

    /// Number of points with distance^2 < squared; counts whole nodes at once if possible.
    [[nodiscard]] std::size_t count_nearer(std::span<const double> place, double squared) const;

    /// Groups of points by rank, and of nodes: the common group of a node's points, or `mixed`.
    struct Groups {
        static constexpr std::uint32_t mixed = 0xffff'ffff;
        std::vector<std::uint32_t> points;
        std::vector<std::uint32_t> nodes;
    };

    /// Computes the groups of nodes from those of points.
    void spread(Groups& groups) const;

    /// The nearest point in another group than the point of this rank, if its distance^2 <=
    /// squared; otherwise index `none`.
    [[nodiscard]] Neighbor nearest_of_others(std::size_t rank, const Groups& groups,
                                             double squared) const;

    /// Nearest other point of every point, in parallel.
    [[nodiscard]] std::vector<Neighbor> all_nearest(const RunContext& run) const;

  private:
    struct Range {
        std::size_t first;
        std::size_t last;
    };

    /// Nodes are numbered as in a heap: the root is 1, the halves of i are 2 i and 2 i + 1, and the
    /// leaves are leaves_ to 2 leaves_ - 1.
    [[nodiscard]] Range range_of(std::size_t node) const {
        const auto level = static_cast<unsigned>(std::bit_width(node)) - 1;
        const std::size_t nth = node - (std::size_t{1} << level);
        return {count() * nth >> level, count() * (nth + 1) >> level};
    }
    [[nodiscard]] const double* box_of(std::size_t node) const {
        return boxes_.data() + node * 2 * dimension_;
    }
    class Builder;
    template <class Work>
    auto with_metric(const Work& work) const;
    template <class Metric, class Query>
    void search(const Metric& metric, const double* place, Query& query) const;
    template <class Metric>
    std::size_t count_nearer(const Metric& metric, const double* place, double squared,
                             std::size_t node) const;

    std::size_t dimension_;
    std::vector<double> sides_;
    Norm norm_;
    std::size_t leaves_ = 1;              ///< number of leaves, a power of 2
    std::vector<double> rows_;            ///< points in the order of the leaves
    std::vector<std::uint32_t> indices_;  ///< original indices of the rows
    std::vector<double> boxes_;           ///< by node, low then high corner
    std::vector<std::uint32_t> lowest_;   ///< by node, lowest index of its points
};

}  // namespace stipple
