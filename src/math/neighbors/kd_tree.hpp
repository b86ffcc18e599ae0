// SPDX-License-Identifier: MIT
//
// Balanced k-d tree of n points in d dimensions: finds the nearest of them to a place.
//
//     distance^2 = sum_k d_k^2,    d_k = |p_k - q_k|,  on the torus min(d_k, side_k - d_k),
//
// or, in other norms, the square of sum_k d_k (Manhattan) or of max_k d_k (Chebyshev), of which the
// root is that sum or largest d_k again.
//
// Every node has the tightest box around its points, and their lowest index. Halves are split
// across the longest side of that box, so that clusters cost no more than even points do.
//
// Shape    n < 2^32 points, d >= 1 (1 to 4 are fastest; in hundreds of dimensions little can be
//          left out, and a question costs O(n d)). On the torus, points and places are in one box
//          of these sides, its upper faces too.
// Cost     O(n log n (log n + d)) to make; O(log n) a question in few dimensions. For 10^6 points
//          in 2-D on one core: 0.5 s to make, 0.4 s for the nearest neighbours of all; 32 bytes a
//          point to keep, 24 more while it is made.
// Promise  exact to the last pair: what is found is what comparing with all points, by the formula
//          above in float64 and its sum in the order of k, would find. Of equally near points those
//          of lowest index. The same for any number of threads. All that is const may be called
//          from many threads.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// A point of the set, and its squared distance from a place.
struct Neighbor {
    double squared;
    std::size_t index;

    auto operator<=>(const Neighbor&) const = default;

    /// Nearer, or as near and of lower index; the same as the default, in fewer steps.
    friend bool operator<(const Neighbor& a, const Neighbor& b) {
        return a.squared < b.squared || (a.squared == b.squared && a.index < b.index);
    }
};

/// How the distances along the axes make one.
enum class Norm { euclidean, manhattan, chebyshev };

/// The squared distance of two places, as above.
double squared_distance(std::span<const double> p, std::span<const double> q,
                        const std::vector<double>& sides, Norm norm);

class KdTree {
  public:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    /// Copies the rows of `dimension` numbers. `sides` are those of the box whose opposite faces
    /// are joined (torus); none for straight distances.
    /// @throws Error(limit, cancelled)
    KdTree(std::span<const double> rows, std::size_t dimension, std::vector<double> sides,
           const RunContext& run, Norm norm = Norm::euclidean);

    [[nodiscard]] std::size_t count() const { return indices_.size(); }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] bool torus() const { return !sides_.empty(); }

    /// The points again, and which they are, by rank: an order in which neighbours are near.
    [[nodiscard]] const double* row(std::size_t rank) const {
        return rows_.data() + rank * dimension_;
    }
    [[nodiscard]] std::size_t index(std::size_t rank) const { return indices_[rank]; }

    /// The point nearest to the place; index `none` and an infinite distance if there is no point.
    [[nodiscard]] Neighbor nearest(std::span<const double> place) const;

    /// The up to k nearest points, k >= 1, from the nearest on.
    [[nodiscard]] std::vector<Neighbor> nearest_several(std::span<const double> place,
                                                        std::size_t k) const;

    /// Number of points with distance^2 < squared; whole nodes are counted at once.
    [[nodiscard]] std::size_t count_nearer(std::span<const double> place, double squared) const;

    /// Groups of points, by their ranks; of a node it is the group of all its points, or `mixed`.
    struct Groups {
        static constexpr std::uint32_t mixed = 0xffff'ffff;
        std::vector<std::uint32_t> points;
        std::vector<std::uint32_t> nodes;
    };

    /// Works out the nodes' groups from those of the points.
    void spread(Groups& groups) const;

    /// The point nearest to the one of that rank of all those of other groups that have distance^2
    /// <= squared; index `none` if there is none.
    [[nodiscard]] Neighbor nearest_of_others(std::size_t rank, const Groups& groups,
                                             double squared) const;

    /// Every point's nearest other one, in parallel.
    [[nodiscard]] std::vector<Neighbor> all_nearest(const RunContext& run) const;

  private:
    struct Range {
        std::size_t first;
        std::size_t last;
    };

    /// Nodes are numbered as in a heap: the root is 1, the halves of i are 2 i and 2 i + 1, and
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
    std::size_t leaves_ = 1;              ///< a power of 2
    std::vector<double> rows_;            ///< in the order of the leaves
    std::vector<std::uint32_t> indices_;  ///< of those rows in the set
    std::vector<double> boxes_;           ///< per node, low then high
    std::vector<std::uint32_t> lowest_;   ///< per node
};

}  // namespace stipple
