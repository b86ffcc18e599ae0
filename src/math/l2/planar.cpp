// SPDX-License-Identifier: MIT
//
// Exact L2 discrepancies of points on a line or in the plane, in O(n log n).
//
// On each axis all kernels are of the form
//
//     k(x, y) = sum_pq s_pq phi_p(x) phi_q(y)  +  sigma |x - y|,
//     phi = 1, x, x^2, |x - 1/2|,
//
// so that the double sum over pairs of points splits into products of
//
//     moments            M_pq = sum_i phi_p(x_i) phi_q(y_i),
//     sums along an axis V_pq = sum_ik phi_p(y_i) phi_q(y_k) |x_i - x_k|,  from running sums of the
//                        points in order of x, and the same with x and y exchanged,
//     one planar sum     T    = sum_ik |x_i - x_k| |y_i - y_k|
//                             = 4 sum_i x_i h_i - 2 sum_ik x_k |y_i - y_k|,
//                        h_i  = sum |y_i - y_k| over the points before i in order of x.
//
// T is the only sum that needs the orders by x and by y at once. It is the same for every kernel,
// and is computed during a merge sort by y. When a point of the right half is output, the points of
// the left half that were output before are those to its lower left. Ties do not matter, because
// their terms are 0.
//
// Coordinates are integer multiples of 2^-63 (smaller parts are rounded away), sums are integers of
// any length, and only the final quotient is rounded.
//
// Cost    O(n log n) time, 48 bytes a point.
// Promise the same bits for any number of threads. Exact if coordinates are multiples of 2^-63, as
//         are all doubles of at least 2^-11.

#include "math/l2/squares.hpp"

#include <algorithm>
#include <bit>
#include <utility>
#include <vector>

#include "core/machine/int128.hpp"
#include "core/parallel.hpp"
#include "math/combinatorics/radix_sort.hpp"
#include "math/l2/axis_factor.hpp"

namespace stipple::l2 {
namespace {

using Integer = PlaneSums::Integer;

constexpr std::uint64_t half = std::uint64_t{1} << (fraction_bits - 1);

/// Sum of integers below 2^256; carries are deferred to the end.
class LongSum {
  public:
    void add(Uint128 value) {
        parts_[0] += low_half(value);
        parts_[1] += high_half(value);
    }
    void add_product(Uint128 a, std::uint64_t b) { add_product(a, b, 0); }
    void add_product(Uint128 a, Uint128 b) {
        add_product(a, low_half(b), 0);
        add_product(a, high_half(b), 1);
    }
    void add(const LongSum& other) {
        for (std::size_t i = 0; i < parts_.size(); ++i) parts_[i] += other.parts_[i];
    }
    [[nodiscard]] Integer value() const {
        Integer sum = 0;
        for (std::size_t i = parts_.size(); i-- > 0;)
            sum = (sum << 64) + (Integer(high_half(parts_[i])) << 64) + low_half(parts_[i]);
        return sum;
    }

  private:
    void add_product(Uint128 a, std::uint64_t b, std::size_t at) {
        const Uint128 lower = wide_product(low_half(a), b);
        const Uint128 upper = wide_product(high_half(a), b);
        parts_[at] += low_half(lower);
        parts_[at + 1] += high_half(lower);
        parts_[at + 1] += low_half(upper);
        parts_[at + 2] += high_half(upper);
    }
    std::array<Uint128, 4> parts_{};
};

/// A point: its coordinate t on the axis by which points are ordered, and w on the other axis.
struct Item {
    std::uint64_t t;
    std::uint64_t w;
};

/// phi_1, phi_2, phi_3 of a coordinate.
struct Features {
    explicit Features(std::uint64_t at)
        : x(at), square(wide_product(at, at)), from_middle(at < half ? half - at : at - half) {}
    std::uint64_t x;
    Uint128 square;
    std::uint64_t from_middle;
};

/// Adds a * phi_q to sums[q - 1] for q = 1, 2, 3.
void add_features(std::array<LongSum, 3>& sums, Uint128 a, const Features& phi) {
    sums[0].add_product(a, phi.x);
    sums[1].add_product(a, phi.square);
    sums[2].add_product(a, phi.from_middle);
}

/// Sums over points in order of t; T and W sum t and w over the i points before each.
struct AxisSums {
    std::array<std::array<LongSum, 3>, 4> moments;  ///< phi_p(t) phi_q(w), q > 0
    std::array<LongSum, 3> alone;                   ///< phi_p(t), p > 0
    LongSum ranked;                                 ///< t i
    std::array<LongSum, 3> ranked_by;               ///< t i phi_q(w)
    std::array<LongSum, 3> behind;                  ///< phi_q(w) T
    LongSum mixed;                                  ///< t w W

    void add(const Item& item, std::uint64_t before, Uint128 t_before, Uint128 w_before);
    void add_moments(const Item& item);
    void add(const AxisSums& other);
};

void AxisSums::add(const Item& item, std::uint64_t before, Uint128 t_before, Uint128 w_before) {
    const Features w(item.w);
    const Uint128 rank = wide_product(item.t, before);
    ranked.add(rank);
    add_features(ranked_by, rank, w);
    add_features(behind, t_before, w);
    mixed.add_product(wide_product(item.t, item.w), w_before);
}

void AxisSums::add_moments(const Item& item) {
    const Features t(item.t);
    const Features w(item.w);
    add_features(alone, 1, t);
    add_features(moments[0], 1, w);
    add_features(moments[1], t.x, w);
    add_features(moments[2], t.square, w);
    add_features(moments[3], t.from_middle, w);
}

void add_all(std::array<LongSum, 3>& sums, const std::array<LongSum, 3>& others) {
    for (std::size_t q = 0; q < sums.size(); ++q) sums[q].add(others[q]);
}

void AxisSums::add(const AxisSums& other) {
    for (std::size_t p = 0; p < moments.size(); ++p) add_all(moments[p], other.moments[p]);
    add_all(alone, other.alone);
    ranked.add(other.ranked);
    add_all(ranked_by, other.ranked_by);
    add_all(behind, other.behind);
    mixed.add(other.mixed);
}

constexpr std::size_t stretch = std::size_t{1} << 14;

/// Computes the sums of items sorted by t; those for moments only if requested.
AxisSums axis_sums(const std::vector<Item>& items, bool moments, const RunContext& run) {
    std::vector<std::pair<Uint128, Uint128>> before(block_count(items.size(), stretch));
    for_each_block(run.stage(0, 0.2), items.size(), stretch, [&](const Block& block) {
        auto& [t, w] = before[block.index];
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            t += items[i].t;
            w += items[i].w;
        }
    });
    std::pair<Uint128, Uint128> sum{};
    for (auto& block : before) {
        const auto [t, w] = block;
        block = sum;
        sum = {sum.first + t, sum.second + w};
    }
    std::vector<AxisSums> sums(before.size());
    for_each_block(run.stage(0.2, 1), items.size(), stretch, [&](const Block& block) {
        auto [t, w] = before[block.index];
        AxisSums mine;
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            mine.add(items[i], i, t, w);
            if (moments) mine.add_moments(items[i]);
            t += items[i].t;
            w += items[i].w;
        }
        sums[block.index] = mine;
    });
    AxisSums all;
    for (const AxisSums& block : sums) all.add(block);
    return all;
}

/// Merges the runs [0, left) and [left, n) of `items` by w into `out`, without branches that depend
/// on the data. Adds t_i (w_i - w_k) over items i of the right run and items k of the left run that
/// are output before i.
void merge(const Item* items, std::size_t left, std::size_t n, Item* out, LongSum& sum,
           const RunContext& run) {
    constexpr std::size_t between_looks = std::size_t{1} << 16;
    std::size_t low = 0;
    std::size_t high = left;
    Uint128 passed_w = 0;  // sum over the left run's items output so far
    for (std::size_t i = 0; i < n; ++i) {
        if (i % between_looks == 0) run.check_stop();
        const bool from_left = high == n || (low < left && items[low].w <= items[high].w);
        const Item item = items[from_left ? low : high];
        sum.add_product(wide_product(item.w, low) - passed_w, from_left ? 0 : item.t);
        passed_w += from_left ? item.w : 0;
        low += from_left;
        high += !from_left;
        out[i] = item;
    }
}

/// Sorts items, given in order of t, by w. Returns the sum of t_i (w_i - w_k) over all points k
/// before i with w_k <= w_i.
Integer dominance(std::vector<Item>& items, const RunContext& run) {
    const std::size_t n = items.size();
    std::vector<Item> other(n);
    const std::size_t blocks = block_count(n, stretch);
    std::vector<LongSum> sums(blocks);
    for_each_block(run.stage(0, 0.6), n, stretch, [&](const Block& block) {
        LongSum& sum = sums[block.index];
        Item* from = items.data() + block.first;
        Item* to = other.data() + block.first;
        const std::size_t size = block.last - block.first;
        for (std::size_t width = 1; width < stretch; width *= 2, std::swap(from, to))
            for (std::size_t i = 0; i < size; i += 2 * width)
                merge(from + i, std::min(width, size - i), std::min(2 * width, size - i), to + i,
                      sum, run);
    });
    static_assert(std::bit_width(stretch) % 2 == 1, "sorted blocks are back where they were");
    Integer total = 0;
    for (const LongSum& sum : sums) total += sum.value();

    for (std::size_t width = stretch; width < n; width *= 2) {
        std::vector<LongSum> merged(block_count(n, 2 * width));
        for_each_block(silent(run), n, 2 * width, [&](const Block& block) {
            merge(items.data() + block.first, std::min(width, block.last - block.first),
                  block.last - block.first, other.data() + block.first, merged[block.index], run);
        });
        for (const LongSum& sum : merged) total += sum.value();
        items.swap(other);
    }
    run.tick(1, 1);
    return total;
}

std::vector<Item> by_first_axis(const PointSet& points, const RunContext& run) {
    const std::size_t n = points.count();
    std::vector<Placed> order(n);
    for (std::size_t i = 0; i < n; ++i)  // + 0 changes -0 to 0
        order[i] = {points[i][0] + 0.0, static_cast<std::uint32_t>(i)};
    radix_sort(order, run);
    run.tick(1, 2);
    std::vector<Item> items(n);
    const bool flat = points.dimension() == 1;
    for (std::size_t i = 0; i < n; ++i)
        items[i] = {fixed(order[i].value), flat ? 0 : fixed(points[order[i].place][1])};
    run.tick(1, 1);
    return items;
}

/// Sums V of an axis with the coordinate t (see the top). `alone` has the moments of the other
/// coordinate w alone, `with_t` those multiplied by t.
PlaneSums::Symmetric along(const AxisSums& sums, const std::array<Integer, 4>& alone,
                           const std::array<Integer, 4>& with_t, const Integer& sum_t) {
    const Integer n = alone[0];
    PlaneSums::Symmetric v;
    v[0] = 4 * sums.ranked.value() + 2 * sum_t - 2 * n * sum_t;
    for (std::size_t q = 1; q < 4; ++q) {
        // Sum over i of t_i times the sum of phi_q(w_k) over the points k before i.
        const Integer running = sum_t * alone[q] - sums.behind[q - 1].value() - with_t[q];
        v[q] = 2 * running + 2 * sums.ranked_by[q - 1].value() + 2 * with_t[q] - alone[q] * sum_t -
               n * with_t[q];
    }
    const Integer& with_square = with_t[2];
    v[4] = 4 * sums.mixed.value() + 2 * with_square - 2 * alone[1] * with_t[1];
    return v;
}

void put_moments(PlaneSums& result, const AxisSums& sums) {
    result.moments[0][0] = result.count;
    for (std::size_t p = 0; p < 4; ++p) {
        if (p > 0) result.moments[p][0] = sums.alone[p - 1].value();
        for (std::size_t q = 1; q < 4; ++q) result.moments[p][q] = sums.moments[p][q - 1].value();
    }
}

std::array<Integer, 4> column(const PlaneSums& sums, std::size_t q) {
    std::array<Integer, 4> out;
    for (std::size_t p = 0; p < 4; ++p) out[p] = sums.moments[p][q];
    return out;
}

}  // namespace

PlaneSums plane_sums(const PointSet& points, const RunContext& run) {
    std::vector<Item> items = by_first_axis(points, run.stage(0, 0.3));
    PlaneSums result;
    result.count = points.count();
    const AxisSums first = axis_sums(items, true, run.stage(0.3, 0.5));
    put_moments(result, first);
    const auto& moments = result.moments;
    result.along[0] = along(first, moments[0], moments[1], moments[1][0]);
    if (points.dimension() == 1) {
        run.tick(1, 1);
        return result;
    }
    const Integer dominated = dominance(items, run.stage(0.5, 0.8));
    for (Item& item : items) std::swap(item.t, item.w);
    const AxisSums second = axis_sums(items, false, run.stage(0.8, 1));
    result.along[1] = along(second, column(result, 0), column(result, 1), moments[0][1]);

    // sum_i x_i h_i, h_i = sum over k before i of |y_i - y_k| = 2 (y_i - y_k)+ - y_i + y_k
    const Integer running = moments[1][0] * moments[0][1] - first.behind[0].value() - moments[1][1];
    const Integer before = 2 * dominated - first.ranked_by[0].value() + running;
    result.planar = 4 * before - 2 * result.along[1][1];
    return result;
}

namespace {

constexpr std::array<unsigned, 4> degree{0, 1, 2, 1};
constexpr std::int64_t unit = 48;

struct Term {
    std::size_t p;
    std::size_t q;
    std::int64_t weight;
    std::size_t place;  ///< index in PlaneSums::Symmetric
    [[nodiscard]] unsigned degrees() const { return degree[p] + degree[q]; }
};

/// Nonzero terms s_pq phi_p phi_q.
std::vector<Term> terms_of(const AxisKernel& k) {
    const Term all[] = {{0, 0, k.s00, 0}, {0, 1, k.s01, 1}, {1, 0, k.s01, 1}, {0, 2, k.s02, 2},
                        {2, 0, k.s02, 2}, {0, 3, k.s03, 3}, {3, 0, k.s03, 3}, {1, 1, k.s11, 4}};
    std::vector<Term> terms;
    std::ranges::copy_if(all, std::back_inserter(terms), [](const Term& t) { return t.weight; });
    return terms;
}

/// Returns value / (n^2 48^axes 2^(126 axes)).
double quotient(const Integer& value, std::size_t n, unsigned axes) {
    using Fraction = boost::multiprecision::cpp_rational;
    Integer below = (Integer(n) * n) << (2 * fraction_bits * axes);
    for (unsigned j = 0; j < axes; ++j) below *= unit;
    return Fraction(value, below).convert_to<double>();
}

/// Scales a value of degree `degrees` in the coordinates to degree 2 on each axis, for additions.
Integer scaled(const Integer& value, unsigned degrees, unsigned axes) {
    return value << (fraction_bits * (2 * axes - degrees));
}

/// Squared discrepancy on one axis, from the moments and from `spread`, the sum V_00.
double axis_square(const std::array<Integer, 4>& moments, const Integer& spread,
                   const AxisKernel& kernel) {
    const Integer& n = moments[0];
    Integer sum = scaled(n * n * kernel.total, 0, 1);
    for (std::size_t p = 0; p < 4; ++p)
        sum -= 2 * n * scaled(moments[p] * kernel.mean[p], degree[p], 1);
    for (const Term& t : terms_of(kernel))
        sum += scaled(moments[t.p] * moments[t.q] * t.weight, t.degrees(), 1);
    sum += scaled(spread * kernel.sigma, 1, 1);
    return quotient(sum, static_cast<std::size_t>(n), 1);
}

double planar_square(const PlaneSums& sums, const AxisKernel& kernel) {
    const auto& m = sums.moments;
    const Integer n = sums.count;
    Integer sum = scaled(n * n * kernel.total * kernel.total, 0, 2);
    for (std::size_t p = 0; p < 4; ++p)
        for (std::size_t q = 0; q < 4; ++q)
            sum -=
                2 * n * scaled(m[p][q] * kernel.mean[p] * kernel.mean[q], degree[p] + degree[q], 2);
    const std::vector<Term> terms = terms_of(kernel);
    for (const Term& a : terms)
        for (const Term& b : terms)
            sum += scaled(m[a.p][b.p] * m[a.q][b.q] * a.weight * b.weight,
                          a.degrees() + b.degrees(), 2);
    for (const Term& t : terms)
        sum += scaled((sums.along[0][t.place] + sums.along[1][t.place]) * t.weight * kernel.sigma,
                      t.degrees() + 1, 2);
    sum += scaled(sums.planar * kernel.sigma * kernel.sigma, 2, 2);
    return quotient(sum, sums.count, 2);
}

}  // namespace

double plane_square(const PlaneSums& sums, std::size_t dimension, Kind kind,
                    const AxisWeights& weights) {
    const KindRecord& record = record_of(kind);
    const bool alone = is_kernel_alone(kind, weights);
    const auto weight = [&](std::size_t j) { return record.scale * weight_of(weights, j); };
    const auto along = [&](std::size_t j) {
        return axis_square(j == 0 ? column(sums, 0) : sums.moments[0], sums.along[j][0],
                           record.kernel);
    };
    if (dimension == 1) return alone ? along(0) : weight(0) * along(0);
    const double both = planar_square(sums, record.kernel);
    if (alone) return both;
    return weight(0) * along(0) + weight(1) * along(1) + weight(0) * weight(1) * both;
}

}  // namespace stipple::l2
