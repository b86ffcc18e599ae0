// SPDX-License-Identifier: MIT
//
// L2 discrepancies in three and four dimensions by divide and conquer, for kernels that are a sum
// of a few products on either side of the diagonal,
//
//     K(x, y) = sum_r L_r(x) U_r(y)   for x <= y.
//
// One product is enough for
//
//                L                        U
//     star       1                        1 - y
//     modified   1                        1 + w (1 - y)
//     extreme    x                        1 - y
//     centered   1 + w max(x - 1/2, 0)    1 + w max(1/2 - y, 0)
//
// All kernels of kinds.hpp are sums of three products. With c = x - 1/2, c' = y - 1/2, a linear
// combination a(c) of 1, c, c^2 and |c|, and g(c) = sqrt(-s11) c,
//
//     K = (a(c) - sigma c) 1 + 1 (a(c') + sigma c') - g(c) g(c')   for c <= c'.
//
// Points are halved along the last axis. A pair from different halves has the factors L(lower
// point) and U(upper point). With these factors as weights of the points, the problem has one axis
// less, and its pairs are between points of two colors, one color for each half. Halving such
// points along their next axis gives two problems, between lower points of one color and upper
// points of the other. On the last axis only running sums remain, computed while points are merged
// along it. Small sets are summed pair by pair.
//
// Numbers are fixed-point with 90 fractional bits.
//
// Cost    O(n log^(d-1) n) time: on one core 0.3 s for 65 536 points in three dimensions and 8 s
//         for 10^6 (all pairs: 0.6 s and 140 s), 8 s for 200 000 in four; with three products 7 s
//         for 131 072 points (all pairs: 18 s) and 80 s for 10^6 (20 minutes).
// Beware  in four dimensions three products per kernel would need 81 weights per point, so that the
//         sum over all pairs is faster.
// Promise the same result for any number of threads. `error` bounds the rounding errors, including
// those of coordinates that are not multiples of 2^-63, all of which are below 2^-11.
// Source  S. Heinrich, Math. Comp. 65 (1996) 1621-1633, doi:10.1090/S0025-5718-96-00756-4;
//         K. Frank, S. Heinrich, J. Complexity 12 (1996) 287-314.

#include "math/l2/squares.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>

#include "core/machine/int128.hpp"
#include "core/parallel.hpp"
#include "math/l2/axis_factor.hpp"

namespace stipple::l2 {
namespace {

constexpr std::size_t max_axes = 4;

using Fixed = Int128;  ///< in multiples of 2^-90

constexpr int behind = 90;
constexpr Fixed unity = Fixed{1} << behind;

/// a b, rounded. Requires |a b| < 2^37.
inline Fixed times(Fixed a, Fixed b) {
    const auto a_high = static_cast<std::int64_t>(a >> 64);
    const auto b_high = static_cast<std::int64_t>(b >> 64);
    const auto a_low = static_cast<std::uint64_t>(a);
    const auto b_low = static_cast<std::uint64_t>(b);
    constexpr Fixed half = Fixed{1} << (behind - 65);
    const Fixed middle = static_cast<Fixed>(a_high) * b_low + static_cast<Fixed>(b_high) * a_low +
                         static_cast<Fixed>(high_half(wide_product(a_low, b_low))) + half;
    return (static_cast<Fixed>(a_high) * b_high << (128 - behind)) + (middle >> (behind - 64));
}

Fixed fixed_of(const Quad& value) {
    const Quad scaled = ldexp(value, behind);
    const Quad upper = floor(ldexp(scaled, -64));
    return (static_cast<Fixed>(upper.convert_to<std::int64_t>()) << 64) +
           static_cast<Fixed>(Quad(scaled - ldexp(upper, 64)).convert_to<std::uint64_t>());
}

/// x - 1/2, from x in multiples of 2^-63.
inline Fixed from_middle(std::uint64_t x) {
    return (static_cast<Fixed>(x) - (Fixed{1} << (fraction_bits - 1))) *
           (Fixed{1} << (behind - fraction_bits));
}

/// Exact sum of any number of fixed-point numbers.
class FixedSum {
  public:
    void add(Fixed value) {
        low_ += static_cast<std::uint64_t>(value);
        high_ += value >> 64;
    }
    void add(const FixedSum& other) {
        low_ += other.low_;
        high_ += other.high_;
    }
    [[nodiscard]] Quad value() const {
        const Fixed upper = high_ + static_cast<Fixed>(high_half(low_));
        const Quad whole = ldexp(Quad(static_cast<std::int64_t>(upper >> 64)), 64) +
                           static_cast<std::uint64_t>(upper);
        return ldexp(ldexp(whole, 64) + low_half(low_), -behind);
    }

  private:
    Uint128 low_ = 0;
    Fixed high_ = 0;
};

/// A polynomial of c = x - 1/2 and |c|.
class Parabola {
  public:
    explicit Parabola(const AxisFactor::Curve& of_x)
        : quads_{of_x[0] + of_x[1] / 2 + of_x[2] / 4, of_x[1] + of_x[2], of_x[2], of_x[3]} {
        std::ranges::transform(quads_, fixed_.begin(), fixed_of);
    }
    [[nodiscard]] Fixed at(Fixed c) const {
        return fixed_[0] + times(fixed_[1] + times(fixed_[2], c), c) +
               times(fixed_[3], c < 0 ? -c : c);
    }
    /// Upper bound on |at(x - 1/2)| for x in [0, 1].
    [[nodiscard]] double most() const {
        return static_cast<double>(abs(quads_[0]) + abs(quads_[1]) / 2 + abs(quads_[2]) / 4 +
                                   abs(quads_[3]) / 2);
    }

  private:
    AxisFactor::Curve quads_;
    std::array<Fixed, 4> fixed_{};
};

/// An axis whose kernel is one product on either side of the diagonal.
class OneProduct {
  public:
    static constexpr std::size_t rank = 1;
    static constexpr std::size_t few = 8;  ///< up to `few` points are summed pair by pair

    /// Data of a point from which its factors are computed.
    using Terms = Fixed;  ///< the coordinate minus 1/2
    using Side = std::array<Fixed, rank>;

    OneProduct(Kind kind, double weight, bool alone)
        : kind_(kind), weight_(fixed_of(Quad(weight))), alone_(alone) {}

    [[nodiscard]] Terms terms(Fixed c) const { return c; }
    [[nodiscard, gnu::always_inline]] Side side(Terms c, bool upper) const {
        constexpr Fixed half = unity / 2;
        const Fixed along = upper ? -c : c;
        if (kind_ == Kind::extreme) return {half + along};
        if (kind_ == Kind::centered) return {of(std::max(along, Fixed{0}))};
        return {upper ? of(half - c) : unity};
    }
    /// True if the i-th number of a side is 1, so that a multiplication can be saved.
    static bool is_one(const Side& side, std::size_t, bool upper) {
        return !upper && side[0] == unity;
    }

    [[nodiscard]] Fixed factor(Terms lower, Terms upper) const {
        return times(side(lower, false)[0], side(upper, true)[0]);
    }
    /// Upper bound on all terms of a point; at least 1.
    [[nodiscard]] double most() const {
        return alone_ ? 1 : 1 + std::ldexp(static_cast<double>(weight_), -behind);
    }

  private:
    [[nodiscard]] Fixed of(Fixed k) const {
        if (alone_) return k;
        return unity + (weight_ == unity ? k : times(weight_, k));
    }

    Kind kind_;
    Fixed weight_;
    bool alone_;
};

/// Axis with the kernel p(x) + q(y) - g(x) g(y) for x <= y, a sum of three products.
class ThreeProducts {
  public:
    static constexpr std::size_t rank = 3;
    static constexpr std::size_t few = 64;

    struct Terms {
        Fixed p;
        Fixed q;
        Fixed g;
    };
    using Side = std::array<Fixed, rank>;

    ThreeProducts(Kind kind, double weight, bool alone)
        : ThreeProducts(AxisFactor(kind, alone, weight)) {}

    [[nodiscard]] Terms terms(Fixed c) const {
        const Fixed a = own_.at(c);
        const Fixed slope = times(distance_, c);
        return {a - slope, a + slope, times(root_, c)};
    }
    static Side side(const Terms& t, bool upper) {
        return upper ? Side{unity, t.q, -t.g} : Side{t.p, unity, t.g};
    }
    static bool is_one(const Side&, std::size_t i, bool upper) { return i == (upper ? 0 : 1); }
    static Fixed factor(const Terms& lower, const Terms& upper) {
        return lower.p + upper.q - times(lower.g, upper.g);
    }
    [[nodiscard]] double most() const {
        const double steep = std::ldexp(std::abs(static_cast<double>(distance_)), -behind);
        const double root = std::ldexp(static_cast<double>(root_), -behind);
        return std::max({1.0, own_.most() + steep / 2, root / 2});
    }

  private:
    explicit ThreeProducts(const AxisFactor& axis)
        : own_(own_of(axis)),
          distance_(fixed_of(axis.distance)),
          root_(fixed_of(sqrt(Quad(-axis.product)))) {}

    /// Own terms if c c' replaces x y = c c' + x / 2 + y / 2 - 1/4 in the factor.
    static AxisFactor::Curve own_of(const AxisFactor& axis) {
        AxisFactor::Curve own = axis.own;
        own[0] -= axis.product / 8;
        own[1] += axis.product / 2;
        return own;
    }

    Parabola own_;
    Fixed distance_;
    Fixed root_;
};

struct Item {
    std::array<std::uint64_t, max_axes> at;
    Fixed weight = unity;     ///< for OneProduct: product of factors on divided axes
    std::uint32_t point;      ///< index in the order of the last axis
    std::uint32_t upper = 0;  ///< bit set of the axes on which the point was in an upper half

    [[nodiscard]] bool is_upper(std::size_t axis) const { return (upper >> axis & 1) != 0; }
};

/// Sum of the products over all unordered pairs of points.
template <class Axis>
class Division {
  public:
    using Terms = typename Axis::Terms;

    Division(std::vector<Axis> axes, std::vector<Item> items, const RunContext& run)
        : axes_(std::move(axes)), spare_(items.size()), run_(run) {
        const std::size_t d = axes_.size();
        const std::size_t n = items.size();
        for (std::size_t r = 2; r < d; ++r) levels_[r].resize(n);
        std::ranges::sort(items, {}, [&](const Item& item) { return item.at[d - 1]; });
        for (std::size_t i = 0; rank > 1 && i < n; ++i) {
            items[i].point = static_cast<std::uint32_t>(i);
            for (std::size_t axis = 0; axis < d; ++axis)
                terms_.push_back(axes_[axis].terms(from_middle(items[i].at[axis])));
        }
        levels_[d] = std::move(items);
        total_work_ = work_of(n) * std::log2(static_cast<double>(n) + 1);
    }

    FixedSum sum() {
        FixedSum sum;
        within_threads(run_, [&] { solve(axes_.size(), 0, spare_.size(), sum); });
        return sum;
    }

  private:
    static constexpr std::size_t rank = Axis::rank;
    static constexpr std::size_t many = std::size_t{1} << 12;
    using Side = typename Axis::Side;
    /// Products of one term from each axis except the first.
    using Weights = std::array<Fixed, rank * rank>;
    /// Sums over the points passed so far, by the terms of the first axis.
    using Passed = std::array<Weights, rank>;

    /// Adds the products of the pairs of items in [first, last) of level r that are in different
    /// halves of axis r (on the highest level, of all pairs). Items are sorted by axis r - 1 before
    /// and by axis r - 2 afterwards.
    void solve(std::size_t r, std::size_t first, std::size_t last, FixedSum& sum) {
        const std::size_t size = last - first;
        if (size <= Axis::few) return take_pairs(r, first, last, sum);
        if (size >= many) run_.check_stop();
        solve_two(r, first, first + size / 2, last, sum);
        if (r == 2)
            merge_and_sum(first, last, sum);
        else
            halve(r, first, last, sum);
        if (r == axes_.size() && size >= many) tell(size);
    }

    void solve_two(std::size_t r, std::size_t first, std::size_t middle, std::size_t last,
                   FixedSum& sum) {
        if (last - first < many || run_.thread_count() == 1) {
            solve(r, first, middle, sum);
            return solve(r, middle, last, sum);
        }
        FixedSum left;
        FixedSum right;
        tbb::parallel_invoke([&] { solve(r, first, middle, left); },
                             [&] { solve(r, middle, last, right); });
        sum.add(left);
        sum.add(right);
    }

    void take_pairs(std::size_t r, std::size_t first, std::size_t last, FixedSum& sum) {
        const std::span items(levels_[r].data() + first, last - first);
        for (std::size_t i = 0; i < items.size(); ++i)
            for (std::size_t k = 0; k < i; ++k)
                if (r == axes_.size() || items[i].is_upper(r) != items[k].is_upper(r))
                    sum.add(product(r, items[i], items[k]));
        std::ranges::sort(items, {}, [&](const Item& item) { return item.at[r - 2]; });
    }

    [[nodiscard]] decltype(auto) terms_of(const Item& item, std::size_t axis) const {
        if constexpr (rank == 1)
            return axes_[axis].terms(from_middle(item.at[axis]));
        else
            return (terms_[item.point * axes_.size() + axis]);
    }

    [[nodiscard]] Fixed factor(const Item& a, const Item& b, std::size_t axis) const {
        const Terms& one = terms_of(a, axis);
        const Terms& other = terms_of(b, axis);
        const bool ordered = a.at[axis] < b.at[axis];
        return axes_[axis].factor(ordered ? one : other, ordered ? other : one);
    }

    [[nodiscard]] Fixed product(std::size_t r, const Item& a, const Item& b) const {
        std::size_t axis = rank == 1 ? r : axes_.size() - 1;
        Fixed all = rank == 1 ? times(a.weight, b.weight) : factor(a, b, axis);
        while (axis-- > 0) all = times(all, factor(a, b, axis));
        return all;
    }

    /// Merges two halves in order of axis r - 2 and calls take(item, whether from the upper half).
    template <class Take>
    void merge(std::size_t r, std::size_t first, std::size_t last, const Take& take) {
        Item* const items = levels_[r].data();
        const std::size_t middle = first + (last - first) / 2;
        std::size_t low = first;
        std::size_t high = middle;
        for (std::size_t out = first; out < last; ++out) {
            if (out % many == 0) run_.check_stop();
            const bool upper =
                low == middle || (high < last && items[high].at[r - 2] < items[low].at[r - 2]);
            spare_[out] = items[upper ? high++ : low++];
            take(spare_[out], upper);
        }
        std::copy(spare_.data() + first, spare_.data() + last, items + first);
    }

    /// Merges two halves in order of axis r - 2, and distributes the items for the next level.
    void halve(std::size_t r, std::size_t first, std::size_t last, FixedSum& sum) {
        Item* const below = levels_[r - 1].data();
        std::size_t next = first;  // end of the items that are in the same half of axes r - 1 and r
        std::size_t rest = last;   // begin of the items in different halves, in reverse order
        merge(r, first, last, [&](const Item& item, bool upper) {
            const bool crossed = r != axes_.size() && item.is_upper(r) != upper;
            Item& share = below[crossed ? --rest : next++];
            share = item;
            if constexpr (rank == 1)
                share.weight = times(item.weight, side_of(item, r - 1, upper)[0]);
            share.upper |= static_cast<std::uint32_t>(upper) << (r - 1);
        });
        std::reverse(below + rest, below + last);
        solve_two(r - 1, first, next, last, sum);
    }

    /// Merges two halves along the first axis, summing instead of distributing the items.
    void merge_and_sum(std::size_t first, std::size_t last, FixedSum& sum) {
        Passed passed[2][2] = {};  // by halves of the third and second axes
        FixedSum mine;
        merge(2, first, last, [&](const Item& item, bool upper) {
            const bool color = item.is_upper(2);
            const Weights weights = weights_of(item, upper);
            mine.add(sum_with(passed[!color][!upper], weights, side_of(item, 0, true)));
            add(passed[color][upper], weights, side_of(item, 0, false));
        });
        sum.add(mine);
    }

    [[nodiscard]] Side side_of(const Item& item, std::size_t axis, bool upper) const {
        return axes_[axis].side(terms_of(item, axis), upper);
    }

    [[nodiscard]] Weights weights_of(const Item& item, bool upper) const {
        const Side b = side_of(item, 1, upper);
        if constexpr (rank == 1) return {times(item.weight, b[0])};
        const bool last_upper = item.is_upper(2);
        const Side a = side_of(item, 2, last_upper);
        Weights weights;
        for (std::size_t i = 0; i < rank; ++i)
            for (std::size_t k = 0; k < rank; ++k)
                weights[rank * i + k] = Axis::is_one(a, i, last_upper) ? b[k]
                                        : Axis::is_one(b, k, upper)    ? a[i]
                                                                       : times(a[i], b[k]);
        return weights;
    }

    static void add(Passed& passed, const Weights& weights, const Side& lower) {
        for (std::size_t t = 0; t < rank; ++t)
            for (std::size_t i = 0; i < weights.size(); ++i)
                passed[t][i] +=
                    Axis::is_one(lower, t, false) ? weights[i] : times(weights[i], lower[t]);
    }

    /// Sum of the products of a point with those passed before.
    static Fixed sum_with(const Passed& passed, const Weights& weights, const Side& upper) {
        Fixed sum = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            Fixed of_weight = 0;
            for (std::size_t t = 0; t < rank; ++t)
                of_weight +=
                    Axis::is_one(upper, t, true) ? passed[t][i] : times(passed[t][i], upper[t]);
            sum += times(weights[i], of_weight);
        }
        return sum;
    }

    [[nodiscard]] double work_of(std::size_t n) const {
        const auto size = static_cast<double>(n);
        return size * std::pow(std::log2(size + 1), static_cast<double>(axes_.size()) - 2);
    }
    void tell(std::size_t n) {
        const std::lock_guard lock(telling_);
        done_ += work_of(n);
        run_.tick(static_cast<std::uint64_t>(std::min(done_, total_work_)),
                  static_cast<std::uint64_t>(total_work_) + 1);
    }

    std::vector<Axis> axes_;
    std::vector<Terms> terms_;  ///< terms of all points on all axes; only for three products
    std::array<std::vector<Item>, max_axes + 1> levels_;  ///< items, by number of axes left
    std::vector<Item> spare_;
    const RunContext& run_;
    std::mutex telling_;
    double done_ = 0;
    double total_work_ = 1;
};

template <class Axis>
std::vector<Axis> axes_for(std::size_t dimension, Kind kind, const AxisWeights& weights) {
    std::vector<Axis> axes;
    for (std::size_t j = 0; j < dimension; ++j)
        axes.emplace_back(kind, weight_of(weights, j), is_kernel_alone(kind, weights));
    return axes;
}

template <class Axis>
double most_of(const std::vector<Axis>& axes) {
    double most = 1;
    for (const Axis& axis : axes) most *= axis.most();
    return most;
}

/// Squared discrepancy: mean over both points - 2/n sum of means + n^-2 sum over pairs.
template <class Axis>
Square square_of(const PointSet& points, Kind kind, const AxisWeights& weights,
                 const RunContext& run) {
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    const auto axes = axes_for<Axis>(d, kind, weights);
    std::vector<Parabola> mean_curves;
    Quad total = 1;
    for (std::size_t j = 0; j < d; ++j) {
        const AxisFactor factor(kind, is_kernel_alone(kind, weights), weight_of(weights, j));
        mean_curves.emplace_back(factor.mean);
        total *= factor.total;
    }
    std::vector<Item> items(n);
    FixedSum means;
    FixedSum own;
    std::size_t rounded = 0;  // number of rounded coordinates
    for (std::size_t i = 0; i < n; ++i) {
        if (i % 4096 == 0) run.check_stop();
        Fixed mean = unity;
        Fixed itself = unity;
        for (std::size_t j = 0; j < d; ++j) {
            const std::uint64_t x = items[i].at[j] = fixed(points[i][j] + 0.0);
            rounded += static_cast<double>(x) != points[i][j] * 0x1p63;
            const auto terms = axes[j].terms(from_middle(x));
            mean = times(mean, mean_curves[j].at(from_middle(x)));
            itself = times(itself, axes[j].factor(terms, terms));
        }
        means.add(mean);
        own.add(itself);
    }
    const Quad pairs = 2 * Division<Axis>(axes, std::move(items), run).sum().value() + own.value();
    run.tick(1, 1);
    const Quad count = n;
    const Quad squared = total - 2 * means.value() / count + pairs / (count * count);
    const auto value = squared.convert_to<double>();
    // A pair takes about ten roundings, each by up to 2^-91 times its factors. The derivative of a
    // product by a coordinate is at most six times the largest product, and a rounded coordinate is
    // off by 2^-64: 2/n times both in the means, and again in the pairs.
    const double most = most_of(axes);
    const double moved =
        24 * 0x1p-64 * most * static_cast<double>(rounded) / static_cast<double>(n);
    return {value, 0x1p-52 * std::abs(value) + 0x1p-85 * most + moved};
}

/// True if the kernel is one product on either side of the diagonal, and sums cannot overflow.
bool is_one_product(std::size_t dimension, Kind kind, const AxisWeights& weights) {
    constexpr double room = 16;
    if (kind == Kind::extreme) return weights.empty();
    if (kind != Kind::star && kind != Kind::modified && kind != Kind::centered) return false;
    return most_of(axes_for<OneProduct>(dimension, kind, weights)) <= room;
}

/// True if sums of three products on three axes cannot overflow.
bool is_three_products(Kind kind, const AxisWeights& weights) {
    constexpr double room = 0x1p13;
    return record_of(kind).kernel.s11 <= 0 &&
           most_of(axes_for<ThreeProducts>(3, kind, weights)) <= room;
}

}  // namespace

bool divides(std::size_t dimension, Kind kind, const AxisWeights& weights) {
    if (dimension < 3 || dimension > max_axes) return false;
    return is_one_product(dimension, kind, weights) ||
           (dimension == 3 && is_three_products(kind, weights));
}

bool divide_wins(std::size_t count, std::size_t dimension, Kind kind, const AxisWeights& weights) {
    // Measured counts. star and modified have half as many factors per pair in pair_square().
    if (!is_one_product(dimension, kind, weights))
        return count >= 50'000 && count <= std::size_t{1} << 23;
    if (count >= std::size_t{1} << 27) return false;  // sums could overflow
    const bool simple = kind == Kind::star || kind == Kind::modified;
    if (dimension == 3) return count >= (simple ? 28'000U : 17'000U);
    return count >= (simple ? 200'000U : 100'000U);
}

double divide_memory(std::size_t count, std::size_t dimension, Kind kind,
                     const AxisWeights& weights) {
    const std::size_t terms =
        is_one_product(dimension, kind, weights) ? 0 : dimension * sizeof(ThreeProducts::Terms);
    return static_cast<double>((terms + dimension * sizeof(Item)) * count);
}

Square divide_square(const PointSet& points, Kind kind, const AxisWeights& weights,
                     const RunContext& run) {
    return is_one_product(points.dimension(), kind, weights)
               ? square_of<OneProduct>(points, kind, weights, run)
               : square_of<ThreeProducts>(points, kind, weights, run);
}

}  // namespace stipple::l2
