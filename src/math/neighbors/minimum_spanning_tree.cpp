// SPDX-License-Identifier: MIT
#include "math/neighbors/minimum_spanning_tree.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>

#include "core/parallel.hpp"

namespace stipple {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Dimension from which on a k-d tree skips too little.
constexpr std::size_t many_dimensions = 8;

/// Connected parts of the points (union-find).
class Parts {
  public:
    explicit Parts(std::size_t n) : parents_(n) { std::iota(parents_.begin(), parents_.end(), 0U); }

    std::uint32_t root(std::uint32_t i) {
        while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
        return i;
    }
    /// Joins the parts of two points; returns false if they are the same. The lower root remains.
    bool join(std::uint32_t i, std::uint32_t j) {
        const std::uint32_t a = root(i);
        const std::uint32_t b = root(j);
        parents_[std::max(a, b)] = std::min(a, b);
        return a != b;
    }

  private:
    std::vector<std::uint32_t> parents_;
};

/// Grows all parts at once. For each point, keeps the nearest point outside its part until that
/// joins the part: as parts only grow, no nearer one can appear.
class Growth {
  public:
    Growth(const KdTree& tree, const RunContext& run)
        : tree_(tree),
          run_(run),
          parts_(tree.count()),
          nearest_(tree.count(), Neighbor{0, KdTree::none}),
          best_(tree.count()),
          bounds_(tree.count()) {
        groups_.points.resize(tree.count());
    }

    std::vector<double> edges() {
        const std::size_t all = tree_.count() - 1;
        std::vector<double> found;
        found.reserve(all);
        while (found.size() < all) {
            name_parts();
            search();
            choose();
            join(found);
            run_.tick(found.size(), all);
        }
        std::ranges::sort(found);
        return found;
    }

  private:
    struct Candidate {
        double squared = infinity;
        std::uint32_t low = 0;
        std::uint32_t high = 0;
        auto operator<=>(const Candidate&) const = default;
    };

    [[nodiscard]] std::uint32_t own(std::size_t rank) const {
        return static_cast<std::uint32_t>(tree_.index(rank));
    }

    void name_parts() {
        for (std::size_t s = 0; s < tree_.count(); ++s) groups_.points[s] = parts_.root(own(s));
        tree_.spread(groups_);
        for (auto& bound : bounds_) bound.store(infinity, std::memory_order_relaxed);
        for (std::size_t s = 0; s < tree_.count(); ++s) {
            Neighbor& nearest = nearest_[s];
            if (nearest.index == KdTree::none) continue;
            const auto index = static_cast<std::uint32_t>(nearest.index);
            if (parts_.root(index) == groups_.points[s])
                nearest.index = KdTree::none;  // keep the distance as a lower bound
            else
                lower(groups_.points[s], nearest.squared);
        }
    }

    /// Lowers the bound of a part. Bounds only serve to skip work, so they may be outdated.
    void lower(std::uint32_t part, double squared) {
        std::atomic<double>& bound = bounds_[part];
        double now = bound.load(std::memory_order_relaxed);
        while (squared < now && !bound.compare_exchange_weak(now, squared)) {
        }
    }

    void search() {
        for_each_block(silent(run_), tree_.count(), 1024, [&](const Block& b) {
            for (auto s = static_cast<std::size_t>(b.first); s < b.last; ++s) {
                if (s % 64 == 0) run_.check_stop();
                Neighbor& nearest = nearest_[s];
                if (nearest.index != KdTree::none) continue;
                const double bound = bounds_[groups_.points[s]].load(std::memory_order_relaxed);
                if (nearest.squared > bound) continue;
                nearest = tree_.nearest_of_others(s, groups_, bound);
                if (nearest.index != KdTree::none) lower(groups_.points[s], nearest.squared);
            }
        });
    }

    void choose() {
        std::ranges::fill(best_, Candidate{});
        for (std::size_t s = 0; s < tree_.count(); ++s) {
            if (nearest_[s].index == KdTree::none) continue;
            const auto other = static_cast<std::uint32_t>(nearest_[s].index);
            const Candidate edge{nearest_[s].squared, std::min(own(s), other),
                                 std::max(own(s), other)};
            best_[groups_.points[s]] = std::min(best_[groups_.points[s]], edge);
        }
    }

    void join(std::vector<double>& found) {
        for (const Candidate& edge : best_)
            if (edge.squared < infinity && parts_.join(edge.low, edge.high))
                found.push_back(edge.squared);
    }

    const KdTree& tree_;
    const RunContext& run_;
    Parts parts_;
    KdTree::Groups groups_;
    std::vector<Neighbor> nearest_;  ///< by rank; with index `none`, a lower bound on the distance
    std::vector<Candidate> best_;    ///< by root of the part
    std::vector<std::atomic<double>> bounds_;
};

}  // namespace

std::vector<double> near_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                       const std::vector<double>& sides, const RunContext& run,
                                       Norm norm) {
    const KdTree tree(rows, dimension, sides, run.stage(0, 0.1), norm);
    if (tree.count() < 2) return {};
    run.need_memory(72.0 * static_cast<double>(tree.count()), "the spanning tree");
    return Growth(tree, run.stage(0.1, 1)).edges();
}

std::vector<double> plain_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                        const std::vector<double>& sides, const RunContext& run,
                                        Norm norm) {
    const std::size_t n = rows.size() / dimension;
    std::vector<double> least(n, infinity);
    std::vector<std::uint32_t> outside(n);
    std::iota(outside.begin(), outside.end(), 0U);
    std::vector<double> tree;
    std::uint32_t latest = 0;
    for (std::size_t left = n; left > 1; --left) {
        run.tick(n - left + 1, n - 1);
        outside.erase(std::ranges::find(outside, latest));
        const auto row = [&](std::size_t i) { return rows.subspan(i * dimension, dimension); };
        for (const std::uint32_t i : outside)
            least[i] = std::min(least[i], squared_distance(row(latest), row(i), sides, norm));
        latest = *std::ranges::min_element(outside, {}, [&](std::uint32_t i) { return least[i]; });
        tree.push_back(least[latest]);
    }
    std::ranges::sort(tree);
    return tree;
}

std::vector<double> minimum_spanning_tree(std::span<const double> rows, std::size_t dimension,
                                          const std::vector<double>& sides, const RunContext& run,
                                          Norm norm) {
    if (dimension < many_dimensions) return near_spanning_tree(rows, dimension, sides, run, norm);
    return plain_spanning_tree(rows, dimension, sides, run, norm);
}

}  // namespace stipple
