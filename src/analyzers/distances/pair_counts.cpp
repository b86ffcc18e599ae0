// SPDX-License-Identifier: MIT
#include "analyzers/distances/pair_counts.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss.hpp>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>

#include "core/machine/wide.hpp"
#include "core/parallel.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/functions/radians.hpp"
#include "math/functions/roots.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::analyzers {
namespace {

/// Number of candidates whose distances are computed at a time.
constexpr std::size_t batch_size = 256;

/// A position, and points whose distances from it are computed; their coordinates axis by axis.
template <std::size_t D>
struct FromPlace {
    std::array<const double*, D> columns;  ///< coordinates of the points
    std::array<double, D> place;
    std::array<double, D> sides;  ///< periods; infinite for straight distances
};

/// places[i] is the distance of point i times `scale`, at most `last`; bins[i] its integer part.
template <std::size_t D>
STIPPLE_WIDE void find_places(const FromPlace<D>& from, std::size_t count, double scale,
                              double last, double* places, std::int32_t* bins) {
    const auto [columns, p, sides] = from;
    for (std::size_t i = 0; i < count; ++i) {
        double sum = 0;
        for (std::size_t k = 0; k < D; ++k) {
            double gap = std::abs(columns[k][i] - p[k]);
            gap = gap < sides[k] - gap ? gap : sides[k] - gap;
            sum += gap * gap;
        }
        const double place = std::sqrt(sum) * scale;
        places[i] = place < last ? place : last;
        bins[i] = static_cast<std::int32_t>(places[i]);
    }
}

void add_pairs(const double* places, const std::int32_t* bins, std::size_t count, PairCounts& to) {
    for (std::size_t i = 0; i < count; ++i) ++to.pairs[static_cast<std::size_t>(bins[i])];
    if (to.offsets.empty()) return;
    for (std::size_t i = 0; i < count; ++i) {
        const auto bin = static_cast<std::size_t>(bins[i]);
        const double offset = places[i] - (static_cast<double>(bin) + 0.5);
        to.offsets[bin] += offset;
        to.squared_offsets[bin] += offset * offset;
    }
}

/// Adds bins of `more` to those of `sums`; ignores bins that `sums` does not have.
template <class Number>
void add_bins(std::vector<Number>& sums, const std::vector<Number>& more) {
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += more[i];
}

template <std::size_t D>
class PairCounter {
  public:
    PairCounter(const PointSet& points, const Distances& distances, double width, std::size_t bins,
                bool with_offsets, const RunContext& run)
        : points_(GridFrame<D>(
                      *distances.box, distances.torus,
                      cell_side(*distances.box, points.count(), width * static_cast<double>(bins)),
                      static_cast<double>(points.count()) + 64),
                  points.flat(), run),
          scale_(1 / width),
          bins_(bins),
          with_offsets_(with_offsets),
          run_(run) {
        for (std::size_t k = 0; k < D; ++k) {
            sides_[k] =
                distances.torus ? points_.frame().side(k) : std::numeric_limits<double>::infinity();
            columns_[k].resize(points_.count());
            for (std::size_t s = 0; s < points_.count(); ++s) columns_[k][s] = points_[s][k];
        }
    }

    PairCounts count() const {
        constexpr std::uint64_t size = 8192;
        const double reach = static_cast<double>(bins_) / scale_;
        std::vector<PairCounts> parts(block_count(points_.count(), size));
        for_each_block(run_, points_.count(), size, [&](const Block& b) {
            PairCounts counts = none_in(bins_ + 1);  // one more, for larger distances
            points_.visit_pairs(b.first, b.last, reach, run_,
                                [&](std::size_t s, std::size_t first, std::size_t last) {
                                    for (std::size_t t = first; t < last; t += batch_size)
                                        measure(s, t, std::min(last - t, batch_size), counts);
                                });
            parts[b.index] = std::move(counts);
        });
        PairCounts all = none_in(bins_);
        for (const PairCounts& part : parts) {
            add_bins(all.pairs, part.pairs);
            add_bins(all.offsets, part.offsets);
            add_bins(all.squared_offsets, part.squared_offsets);
        }
        return all;
    }

  private:
    /// Side of grid cells: a fifth of `reach`, but with at least 4 points per cell on average.
    static double cell_side(const Box& box, std::size_t count, double reach) {
        return std::max(nth_root(4, D) * mean_distance(box, static_cast<double>(count)), reach / 5);
    }

    /// Counts the pairs of point s with the points from, ..., from + size - 1.
    void measure(std::size_t s, std::size_t from, std::size_t size, PairCounts& to) const {
        FromPlace<D> here{{}, {}, sides_};
        for (std::size_t k = 0; k < D; ++k) {
            here.columns[k] = columns_[k].data() + from;
            here.place[k] = columns_[k][s];
        }
        std::array<double, batch_size> places;
        std::array<std::int32_t, batch_size> bins;
        find_places(here, size, scale_, static_cast<double>(bins_), places.data(), bins.data());
        add_pairs(places.data(), bins.data(), size, to);
    }

    [[nodiscard]] PairCounts none_in(std::size_t bins) const {
        const std::vector<double> offsets(with_offsets_ ? bins : 0);
        return {std::vector<std::uint64_t>(bins), offsets, offsets};
    }

    SortedPoints<D> points_;
    std::array<double, D> sides_{};
    double scale_;
    std::size_t bins_;
    bool with_offsets_;
    const RunContext& run_;
    std::array<std::vector<double>, D> columns_;  ///< coordinates by axis, ordered by cell
};

}  // namespace

PairCounts count_pairs(const PointSet& points, const Distances& distances, double width,
                       std::size_t bins, bool with_offsets, const RunContext& run) {
    const auto n = static_cast<double>(points.count());
    const double tallies = n / 8192 + 1;
    run.need_memory(n * (16 * static_cast<double>(points.dimension()) + 12) +
                        tallies * static_cast<double>(bins + 1) * (with_offsets ? 48 : 32),
                    "the counts of pairs");
    return with_dimension<3>(points.dimension(), [&]<std::size_t D>() {
        return PairCounter<D>(points, distances, width, bins, with_offsets, run).count();
    });
}

namespace {

/// One axis of a box, of side L. The absolute displacement x of two uniform points along it has the
/// density 2 (1 - slope x / L) / L on [0, reach()].
struct Axis {
    double side;
    double slope;  ///< 0 on the torus, 1 for straight distances

    [[nodiscard]] double reach() const { return slope > 0 ? side : side / 2; }

    /// Integral of 2 (1 - slope x / L) / L over x in [0, h], or in [0, reach()] if h is larger.
    [[nodiscard]] double within(double h) const {
        const double t = std::min(h, reach()) / side;
        return t * (2 - slope * t);
    }
};

double squared(double x) { return x * x; }

/// Integral over x in [low, high] of a's density at x times b.within(sqrt(r^2 - x^2)). Requires
/// that the root is at most b.reach().
double under_arc(const Axis& a, const Axis& b, double r, double low, double high) {
    const auto root = [&](double x) { return std::sqrt(std::max(0.0, (r - x) * (r + x))); };
    const auto arc = [&](double x) {  // antiderivative of sqrt(r^2 - x^2)
        return (x * root(x) + r * r * arc_sine(std::min(1.0, x / r))) / 2;
    };
    // Integral of x sqrt(r^2 - x^2): a difference of cubes of roots, which cancel if a is short.
    const double one = root(low);
    const double other = root(high);
    const double slanted = one + other > 0
                               ? (high - low) * (high + low) *
                                     (one * one + one * other + other * other) / (3 * (one + other))
                               : 0;
    const auto parabola = [&](double x) {  // antiderivative of (r^2 - x^2) (1 - slope x / L)
        return r * r * x - x * x * x / 3 - a.slope / a.side * squared(x) * (r * r / 2 - x * x / 4);
    };
    const double roots = arc(high) - arc(low) - a.slope / a.side * slanted;
    const double squares = b.slope > 0 ? parabola(high) - parabola(low) : 0;
    return 2 / a.side * (2 * roots / b.side - squares / squared(b.side));
}

double within_disk(const Axis& a, const Axis& b, double r) {
    if (a.side > b.side) return within_disk(b, a, r);  // along the longer axis terms would cancel
    const double high = std::min(r, a.reach());
    const double flat = r > b.reach() ? std::sqrt((r - b.reach()) * (r + b.reach())) : 0;
    if (flat >= high) return a.within(high) * b.within(b.reach());
    return a.within(flat) * b.within(b.reach()) + under_arc(a, b, r, flat, high);
}

/// Probability of distances up to r in space: integral over the height r sin(angle) along the axis
/// c, split where the rim of the disk at that height meets a side or a corner.
double within_ball(const Axis& a, const Axis& b, const Axis& c, double r) {
    const double top = r > c.reach() ? arc_sine(c.reach() / r) : std::numbers::pi / 2;
    std::array<double, 5> cuts{0, top, top, top, top};
    std::size_t count = 2;
    for (const double rim :
         {a.reach(), b.reach(), std::sqrt(squared(a.reach()) + squared(b.reach()))})
        if (rim < r) cuts[count++] = std::min(top, arc_cosine(rim / r));
    std::ranges::sort(cuts);
    const auto slice = [&](double angle) {
        const auto [cos, sin] = cos_sin_radians(angle);
        const double z = r * sin;
        const double across = r * cos;
        return 2 / c.side * (1 - c.slope * z / c.side) * across * within_disk(a, b, across);
    };
    // Near `cuts` the integrand has fractional powers, which tanh-sinh quadrature handles well.
    thread_local boost::math::quadrature::tanh_sinh<double> rule;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double width = cuts[i + 1] - cuts[i];
        const auto part = [&](double share) { return slice(cuts[i] + share * width); };
        if (width > 0) sum += width * rule.integrate(part, 0.0, 1.0, 1e-13);
    }
    return sum;
}

/// The e with e (2 reach - e) = square, at most `reach`.
double depth_of(double square, double reach) {
    const double rest = reach * reach - square;
    return rest > 0 ? square / (reach + std::sqrt(rest)) : reach;
}

/// Probability of displacements x along the axes, the longest first, with sum x^2 > sum reach()^2 -
/// square: near the corner of the reaches. In terms of e = reach() - x nothing cancels.
double in_corner(std::span<const Axis> axes, double square) {
    if (square <= 0) return 0;
    const Axis& a = axes.front();
    const double reach = a.reach();
    const double end = depth_of(square, reach);
    if (axes.size() == 1) return (a.slope > 0 ? end / a.side : 2) * end / a.side;
    const auto rest = axes.subspan(1);
    std::vector<double> cuts{0, end};  // between them the integrand is smooth, but for square roots
    double all = 0;
    for (const Axis& axis : rest) all += squared(axis.reach());
    for (const double rim : {squared(rest.front().reach()), squared(rest.back().reach()), all})
        if (square > rim) cuts.push_back(std::min(end, depth_of(square - rim, reach)));
    std::ranges::sort(cuts);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double width = cuts[i + 1] - cuts[i];
        const auto part = [&](double t) {
            const double e = cuts[i] + width * (t * t * (3 - 2 * t));
            const double density = a.slope > 0 ? e / a.side : 1;
            return t * (1 - t) * density * in_corner(rest, square - e * (2 * reach - e));
        };
        using Rule = boost::math::quadrature::gauss<double, 30>;
        if (width > 0) sum += 6 * width * Rule::integrate(part, 0.0, 1.0);
    }
    return 2 / a.side * sum;
}

std::vector<Axis> axes_of(const Box& box, bool torus) {
    std::vector<Axis> axes;
    for (std::size_t k = 0; k < box.dimension(); ++k)
        axes.push_back({box.extent(k), torus ? 0.0 : 1.0});
    return axes;
}

}  // namespace

std::optional<double> pair_probability_beyond(const Box& box, bool torus, double r) {
    std::vector<Axis> axes = axes_of(box, torus);
    std::ranges::sort(axes, std::greater(), &Axis::side);
    DoubleDouble square = exact_product(-r, r);
    for (const Axis& axis : axes) square = square + exact_product(axis.reach(), axis.reach());
    if (axes.size() == 1 || square.high > squared(axes[0].reach()) / 4) return std::nullopt;
    return in_corner(axes, square.high);
}

double pair_probability(const Box& box, bool torus, double r) {
    if (r <= 0) return 0;
    if (r >= longest_distance(box, torus)) return 1;
    const std::vector<Axis> axes = axes_of(box, torus);
    if (axes.size() == 1) return axes[0].within(r);
    if (axes.size() == 2) return within_disk(axes[0], axes[1], r);
    return within_ball(axes[0], axes[1], axes[2], r);
}

double longest_distance(const Box& box, bool torus) {
    double sum = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) sum += squared(box.extent(k));
    return std::sqrt(sum) / (torus ? 2 : 1);
}

}  // namespace stipple::analyzers
