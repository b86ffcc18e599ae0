// SPDX-License-Identifier: MIT
#include "generators/eliminator.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "math/point_grid.hpp"
#include "math/roots.hpp"

namespace stipple {
namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double beta = 0.65;
constexpr double unit = 0x1p40;  ///< weights count multiples of its inverse

/// Terms of the weights.
class Kernel {
  public:
    Kernel(double r_max, double kept_share)
        : inverse_(1 / (2 * r_max)), nearest_(beta * (1 - kept_share * std::sqrt(kept_share))) {}

    [[nodiscard]] std::uint64_t operator()(double squared_distance) const {
        const double t = 1 - std::max(std::sqrt(squared_distance) * inverse_, nearest_);
        const double t2 = t * t;
        const double t4 = t2 * t2;
        return t > 0 ? static_cast<std::uint64_t>(static_cast<std::int64_t>(t4 * t4 * unit)) : 0;
    }

  private:
    double inverse_;
    double nearest_;  ///< r_min / r_max: a distance below 2 r_min counts as that
};

/// A weight that a point once had.
struct Candidate {
    std::uint64_t weight;
    std::uint32_t original;
    std::uint32_t sorted;

    bool operator<(const Candidate& other) const {
        return weight != other.weight ? weight < other.weight : original > other.original;
    }
};

/// Moves the top of a heap, whose weight has fallen, down to its place. Four children a node: their
/// nodes fill a cache line.
void sift_down(std::vector<Candidate>& heap, std::size_t size, std::size_t at) {
    const Candidate moving = heap[at];
    for (;;) {
        const std::size_t first = 4 * at + 1;
        if (first >= size) break;
        std::size_t best = first;
        for (std::size_t c = first + 1; c < std::min(first + 4, size); ++c)
            if (heap[best] < heap[c]) best = c;
        if (!(moving < heap[best])) break;
        heap[at] = heap[best];
        at = best;
    }
    heap[at] = moving;
}

template <std::size_t D>
class Elimination {
  public:
    Elimination(std::span<const double> rows, const BoxSpace& space, double r_max,
                std::uint64_t kept, const RunContext& run)
        : reach_(2 * r_max),
          run_(run),
          kept_(kept),
          points_(GridFrame<D>(space.box, space.torus, reach_ / 2,
                               1024 + 0.5 * static_cast<double>(rows.size() / D)),
                  rows, run),
          kernel_(r_max, static_cast<double>(kept) / static_cast<double>(points_.count())),
          weights_(points_.count()) {}

    std::vector<std::uint32_t> go() {
        weigh();
        make_heap();
        std::vector<std::uint32_t> gone;
        const std::size_t wanted = points_.count() - kept_;
        gone.reserve(wanted);
        const RunContext run = run_.stage(0.3, 1);
        std::size_t size = heap_.size();
        for (std::uint64_t step = 0; gone.size() < wanted; ++step) {
            if (step % 1024 == 0) run.tick(gone.size(), wanted);
            Candidate& top = heap_.front();
            if (top.weight != weights_[top.sorted]) {
                top.weight = weights_[top.sorted];
                sift_down(heap_, size, 0);
                continue;
            }
            gone.push_back(top.original);
            remove(top.sorted);
            heap_.front() = heap_[--size];
            sift_down(heap_, size, 0);
        }
        return gone;
    }

  private:
    void weigh() {
        for_each_block(run_.stage(0, 0.3), points_.count(), 2048, [&](const Block& b) {
            for (std::size_t s = b.first; s < b.last; ++s) {
                std::uint64_t sum = 0;
                points_.visit(points_[s], reach_, [&](std::size_t t, double squared) {
                    if (t != s) sum += kernel_(squared);
                });
                weights_[s] = sum;
            }
        });
    }

    void make_heap() {
        heap_.reserve(points_.count());
        for (std::size_t s = 0; s < points_.count(); ++s)
            heap_.push_back({weights_[s], points_.original(s), static_cast<std::uint32_t>(s)});
        for (std::size_t i = heap_.size() / 4 + 1; i-- > 0;) {
            if (i % 65536 == 0) run_.check_stop();
            if (i < heap_.size()) sift_down(heap_, heap_.size(), i);
        }
    }

    /// Takes a point out, and its part of the others' weights.
    void remove(std::uint32_t s) {
        std::array<double, D> p;
        std::copy_n(points_[s], D, p.begin());
        points_.remove(s);
        points_.visit(p.data(), reach_,
                      [&](std::size_t t, double squared) { weights_[t] -= kernel_(squared); });
    }

    double reach_;
    const RunContext& run_;
    std::uint64_t kept_;
    SortedPoints<D> points_;
    Kernel kernel_;
    std::vector<std::uint64_t> weights_;  ///< by place in the grid
    std::vector<Candidate> heap_;
};

}  // namespace

double unit_ball_volume(std::size_t dimension) {
    double ball = dimension % 2 == 0 ? pi : 2;  // of 2 or 1 dimensions
    for (std::size_t d = dimension % 2 == 0 ? 4 : 3; d <= dimension; d += 2)
        ball *= 2 * pi / static_cast<double>(d);
    return ball;
}

double packing_radius(double count, std::size_t dimension, double measure) {
    const double share = measure / count;
    if (dimension == 1) return share / 2;
    if (dimension == 2) return std::sqrt(share / (2 * std::sqrt(3.0)));
    if (dimension == 3) return nth_root(share / (4 * std::sqrt(2.0)), 3);
    return nth_root(share / unit_ball_volume(dimension), dimension);
}

double elimination_memory(double points, std::size_t dimension) {
    return points * (8 * static_cast<double>(dimension) + 40);
}

std::vector<std::uint32_t> eliminate(std::span<const double> rows, const BoxSpace& space,
                                     double r_max, std::uint64_t kept, const RunContext& run) {
    return with_dimension(space.box.dimension(), [&]<std::size_t D>() {
        return Elimination<D>(rows, space, r_max, kept, run).go();
    });
}

}  // namespace stipple
