// SPDX-License-Identifier: MIT
#include "math/neighbors/kd_tree.hpp"

#include <algorithm>

#include <cmath>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/neighbors/spaced_points.hpp"

namespace stipple {
namespace {

constexpr std::size_t leaf_size = 8;

/// Distances in D dimensions; for D = 0 the dimension and the norm are given at run time. Bounds
/// use the same operations as distances, and each of them rounds monotonically. So a bound is never
/// on the wrong side of a computed distance.
template <std::size_t D, bool Torus>
class Metric {
  public:
    Metric(std::size_t dimension, const double* sides, Norm norm)
        : dimension_(dimension), sides_(sides), norm_(norm) {}

    [[nodiscard]] double distance(const double* p, const double* q) const {
        return sum([&](std::size_t k) {
            const double d = std::abs(p[k] - q[k]);
            return Torus ? std::min(d, sides_[k] - d) : d;
        });
    }

    /// Lower bound on the distance of p from points in the box.
    [[nodiscard]] double nearest(const double* box, const double* p) const {
        return sum([&](std::size_t k) {
            const double gap = std::max({box[k] - p[k], p[k] - box[size() + k], 0.0});
            return Torus ? std::min(gap, sides_[k] - reach(box, p, k)) : gap;
        });
    }

    /// Upper bound on the distance of p from points in the box.
    [[nodiscard]] double farthest(const double* box, const double* p) const {
        return sum([&](std::size_t k) {
            const double far = reach(box, p, k);
            if (!Torus) return far;
            const double gap = std::max({box[k] - p[k], p[k] - box[size() + k], 0.0});
            return std::min(far, sides_[k] - gap);
        });
    }

  private:
    [[nodiscard]] std::size_t size() const { return D > 0 ? D : dimension_; }
    [[nodiscard]] double reach(const double* box, const double* p, std::size_t k) const {
        return std::max(p[k] - box[k], box[size() + k] - p[k]);
    }
    template <class Along>
    [[nodiscard]] double sum(const Along& along) const {
        double squared = 0;
        if (D > 0 || norm_ == Norm::euclidean) {
            for (std::size_t k = 0; k < size(); ++k) {
                const double d = along(k);
                squared += d * d;
            }
            return squared;
        }
        double distance = 0;
        for (std::size_t k = 0; k < size(); ++k)
            distance =
                norm_ == Norm::manhattan ? distance + along(k) : std::max(distance, along(k));
        return distance * distance;
    }

    std::size_t dimension_;
    const double* sides_;
    Norm norm_;
};

/// Extends a box to include another box; for a single row, low and high are equal.
void widen(double* box, const double* low, const double* high, std::size_t d) {
    for (std::size_t k = 0; k < d; ++k) {
        box[k] = std::min(box[k], low[k]);
        box[d + k] = std::max(box[d + k], high[k]);
    }
}

/// Query for the nearest point other than `except`.
struct NearestBut {
    std::size_t except;
    Neighbor best = {std::numeric_limits<double>::infinity(), KdTree::none};

    [[nodiscard]] static bool skips_node(std::size_t) { return false; }
    [[nodiscard]] bool wants(const Neighbor& bound) const { return bound < best; }
    void visit(std::size_t, const Neighbor& point) {
        if (point < best && point.index != except) best = point;
    }
};

/// Query for the nearest point of other groups.
struct NearestOfOthers {
    const KdTree::Groups& groups;
    std::uint32_t own;
    Neighbor best;  ///< initially at a finite distance, because skipped nodes have infinite bounds

    [[nodiscard]] bool skips_node(std::size_t node) const { return groups.nodes[node] == own; }
    [[nodiscard]] bool wants(const Neighbor& bound) const { return bound < best; }
    void visit(std::size_t rank, const Neighbor& point) {
        if (point < best && groups.points[rank] != own) best = point;
    }
};

/// Query for the k nearest points.
struct Several {
    std::size_t k;
    std::vector<Neighbor> heap = {};  ///< the farthest one is on top

    [[nodiscard]] static bool skips_node(std::size_t) { return false; }
    [[nodiscard]] bool wants(const Neighbor& bound) const {
        return heap.size() < k || bound < heap.front();
    }
    void visit(std::size_t, const Neighbor& point) {
        if (!wants(point)) return;
        heap.push_back(point);
        std::push_heap(heap.begin(), heap.end());
        if (heap.size() <= k) return;
        std::pop_heap(heap.begin(), heap.end());
        heap.pop_back();
    }
};

}  // namespace

double squared_distance(std::span<const double> p, std::span<const double> q,
                        const std::vector<double>& sides, Norm norm) {
    if (sides.empty())
        return Metric<0, false>(p.size(), nullptr, norm).distance(p.data(), q.data());
    return Metric<0, true>(p.size(), sides.data(), norm).distance(p.data(), q.data());
}

/// Sorts the points into the leaves, level by level.
class KdTree::Builder {
  public:
    Builder(KdTree& tree, std::span<const double> rows)
        : tree_(tree), rows_(rows), order_(tree.count()), keys_(tree.count()) {
        std::iota(order_.begin(), order_.end(), 0U);
    }

    void build(const RunContext& run) {
        for (std::size_t level = 1; level < tree_.leaves_; level *= 2)
            for_nodes(level, silent(run), [&](std::size_t node) { split(node); });
        for_nodes(tree_.leaves_, run, [&](std::size_t leaf) { fill(leaf); });
        for (std::size_t node = tree_.leaves_ - 1; node > 0; --node) join(node);
    }

  private:
    /// Calls visit(node) for all nodes of the level that begins with node `first`.
    template <class Visit>
    static void for_nodes(std::size_t first, const RunContext& run, const Visit& visit) {
        for_each_block(run, first, 1 + first / 256, [&](const Block& b) {
            for (std::uint64_t i = b.first; i < b.last; ++i) visit(first + i);
        });
    }

    struct Key {
        double value;
        std::uint32_t index;
        friend bool operator<(const Key& a, const Key& b) {
            return a.value < b.value || (a.value == b.value && a.index < b.index);
        }
    };

    [[nodiscard]] std::size_t widest(std::span<const std::uint32_t> own) const {
        const std::size_t d = tree_.dimension_;
        std::size_t axis = 0;
        double widest = -1;
        for (std::size_t k = 0; k < d && d > 1; ++k) {
            double low = rows_[own[0] * d + k];
            double high = low;
            for (const std::uint32_t i : own) {
                low = std::min(low, rows_[i * d + k]);
                high = std::max(high, rows_[i * d + k]);
            }
            if (high - low > widest) axis = k;
            widest = std::max(widest, high - low);
        }
        return axis;
    }

    void split(std::size_t node) {
        const auto [first, last] = tree_.range_of(node);
        const std::size_t middle = tree_.range_of(2 * node).last;
        const auto own = std::span(order_).subspan(first, last - first);
        const std::size_t axis = widest(own);
        const auto keys = std::span(keys_).subspan(first, own.size());
        for (std::size_t i = 0; i < own.size(); ++i)
            keys[i] = {rows_[own[i] * tree_.dimension_ + axis], own[i]};
        std::nth_element(keys.begin(), keys.begin() + static_cast<std::ptrdiff_t>(middle - first),
                         keys.end());
        for (std::size_t i = 0; i < own.size(); ++i) own[i] = keys[i].index;
    }

    [[nodiscard]] double* box_of(std::size_t node) {
        return tree_.boxes_.data() + node * 2 * tree_.dimension_;
    }

    /// Sets the rows and the box of a nonempty leaf.
    void fill(std::size_t leaf) {
        const std::size_t d = tree_.dimension_;
        const auto [first, last] = tree_.range_of(leaf);
        std::ranges::sort(std::span(order_).subspan(first, last - first));
        for (std::size_t i = first; i < last; ++i) {
            tree_.indices_[i] = order_[i];
            std::copy_n(rows_.data() + order_[i] * d, d, tree_.rows_.data() + i * d);
        }
        std::copy_n(tree_.row(first), d, box_of(leaf));
        std::copy_n(tree_.row(first), d, box_of(leaf) + d);
        for (std::size_t i = first + 1; i < last; ++i)
            widen(box_of(leaf), tree_.row(i), tree_.row(i), d);
        tree_.lowest_[leaf] = tree_.indices_[first];
    }

    /// Computes the box of a node from those of its halves.
    void join(std::size_t node) {
        const std::size_t d = tree_.dimension_;
        std::copy_n(box_of(2 * node), 2 * d, box_of(node));
        widen(box_of(node), box_of(2 * node + 1), box_of(2 * node + 1) + d, d);
        tree_.lowest_[node] = std::min(tree_.lowest_[2 * node], tree_.lowest_[2 * node + 1]);
    }

    KdTree& tree_;
    std::span<const double> rows_;
    std::vector<std::uint32_t> order_;  ///< point indices, node by node
    std::vector<Key> keys_;
};

KdTree::KdTree(std::span<const double> rows, std::size_t dimension, std::vector<double> sides,
               const RunContext& run, Norm norm)
    : dimension_(dimension), sides_(std::move(sides)), norm_(norm) {
    const std::size_t n = rows.size() / dimension;
    if (n >= std::numeric_limits<std::uint32_t>::max())
        fail(ErrorKind::limit, "a search tree takes up to 2^32 - 2 points; these are {}", n);
    while (n / leaves_ > leaf_size) leaves_ *= 2;
    run.need_memory(
        static_cast<double>(n) * (8.0 * static_cast<double>(dimension) + 24) +
            static_cast<double>(leaves_) * 2 * (16.0 * static_cast<double>(dimension) + 4),
        "a search tree");
    if (n == 0) return;
    rows_.resize(n * dimension);
    indices_.resize(n);
    boxes_.resize(2 * leaves_ * 2 * dimension);
    lowest_.resize(2 * leaves_);
    Builder(*this, rows).build(run);
}

template <class Work>
auto KdTree::with_metric(const Work& work) const {
    const auto with = [&]<std::size_t D>() {
        if (torus()) return work(Metric<D, true>(dimension_, sides_.data(), norm_));
        return work(Metric<D, false>(dimension_, nullptr, norm_));
    };
    constexpr std::size_t most = 4;
    return dimension_ > most || norm_ != Norm::euclidean ? with.template operator()<0>()
                                                         : with_dimension<most>(dimension_, with);
}

/// Visits the leaves that the query wants, the nearest first. The query wants a node if a point as
/// near as the node's bound, and with its lowest index, could change the query's result.
template <class Metric, class Query>
void KdTree::search(const Metric& metric, const double* place, Query& query) const {
    struct Entry {
        std::size_t node;
        Neighbor bound;
    };
    const auto entry = [&](std::size_t node) {
        const double bound = query.skips_node(node) ? std::numeric_limits<double>::infinity()
                                                    : metric.nearest(box_of(node), place);
        return Entry{node, {bound, lowest_[node]}};
    };
    std::array<Entry, 66> stack;
    std::size_t size = 0;
    if (count() > 0) stack[size++] = entry(1);
    while (size > 0) {
        Entry now = stack[--size];
        if (!query.wants(now.bound)) continue;
        while (now.node < leaves_) {
            Entry other = entry(2 * now.node + 1);
            now = entry(2 * now.node);
            if (other.bound < now.bound) std::swap(now, other);
            if (query.wants(other.bound)) stack[size++] = other;
        }
        const auto [first, last] = range_of(now.node);
        for (std::size_t i = first; i < last; ++i)
            query.visit(i, {metric.distance(place, row(i)), indices_[i]});
    }
}

Neighbor KdTree::nearest(std::span<const double> place) const {
    return with_metric([&](const auto metric) {
        NearestBut query{none};
        search(metric, place.data(), query);
        return query.best;
    });
}

void KdTree::spread(Groups& groups) const {
    groups.nodes.resize(2 * leaves_);
    for (std::size_t node = 2 * leaves_ - 1; node > 0; --node) {
        if (node < leaves_) {
            const std::uint32_t left = groups.nodes[2 * node];
            groups.nodes[node] = left == groups.nodes[2 * node + 1] ? left : Groups::mixed;
            continue;
        }
        const auto [first, last] = range_of(node);
        groups.nodes[node] = groups.points[first];
        for (std::size_t i = first + 1; i < last; ++i)
            if (groups.points[i] != groups.points[first]) groups.nodes[node] = Groups::mixed;
    }
}

Neighbor KdTree::nearest_of_others(std::size_t rank, const Groups& groups, double squared) const {
    return with_metric([&](const auto metric) {
        const double farthest = std::min(squared, std::numeric_limits<double>::max());
        NearestOfOthers query{groups, groups.points[rank], {farthest, none}};
        search(metric, row(rank), query);
        return query.best;
    });
}

std::vector<Neighbor> KdTree::nearest_several(std::span<const double> place, std::size_t k) const {
    return with_metric([&](const auto metric) {
        Several query{k};
        search(metric, place.data(), query);
        std::sort_heap(query.heap.begin(), query.heap.end());
        return std::move(query.heap);
    });
}

template <class Metric>
std::size_t KdTree::count_nearer(const Metric& metric, const double* place, double squared,
                                 std::size_t node) const {
    if (!(metric.nearest(box_of(node), place) < squared)) return 0;
    const auto [first, last] = range_of(node);
    if (metric.farthest(box_of(node), place) < squared) return last - first;
    if (node < leaves_)
        return count_nearer(metric, place, squared, 2 * node) +
               count_nearer(metric, place, squared, 2 * node + 1);
    std::size_t found = 0;
    for (std::size_t i = first; i < last; ++i)
        found += metric.distance(place, row(i)) < squared ? 1 : 0;
    return found;
}

std::size_t KdTree::count_nearer(std::span<const double> place, double squared) const {
    if (count() == 0) return 0;
    return with_metric(
        [&](const auto& metric) { return count_nearer(metric, place.data(), squared, 1); });
}

std::vector<Neighbor> KdTree::all_nearest(const RunContext& run) const {
    std::vector<Neighbor> found(count());
    const std::size_t block = dimension_ <= 4 ? 4096 : dimension_ <= 8 ? 128 : 8;
    for_each_block(run, count(), block, [&](const Block& b) {
        with_metric([&](const auto metric) {
            for (std::size_t i = b.first; i < b.last; ++i) {
                NearestBut query{indices_[i]};
                search(metric, row(i), query);
                found[indices_[i]] = query.best;
            }
        });
    });
    return found;
}

}  // namespace stipple
