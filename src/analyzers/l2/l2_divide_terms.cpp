// SPDX-License-Identifier: MIT
#include "analyzers/l2/l2_divide_terms.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

#include "analyzers/l2/l2_numbers.hpp"
#include "analyzers/l2/l2_terms.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::l2 {
namespace {

__extension__ using Fixed = __int128;  ///< multiples of 2^-90
using Real = boost::multiprecision::cpp_bin_float_100;
using Integer = boost::multiprecision::cpp_int;

constexpr int behind = 90;
constexpr Fixed unity = Fixed{1} << behind;
constexpr std::size_t axes = 3;

/// a b, cut off; |a b| < 2^37.
inline Fixed times(Fixed a, Fixed b) {
    const auto a_high = static_cast<std::int64_t>(a >> 64);
    const auto b_high = static_cast<std::int64_t>(b >> 64);
    const auto a_low = static_cast<std::uint64_t>(a);
    const auto b_low = static_cast<std::uint64_t>(b);
    const auto both = static_cast<Fixed>(high(product(a_low, b_low)));
    const Fixed middle =
        static_cast<Fixed>(a_high) * b_low + static_cast<Fixed>(b_high) * a_low + both;
    return (static_cast<Fixed>(a_high) * b_high << (128 - behind)) + (middle >> (behind - 64));
}

Fixed fixed_of(const Quad& value) {
    const Quad scaled = ldexp(value, behind);
    const Quad upper = floor(ldexp(scaled, -64));
    return (static_cast<Fixed>(upper.convert_to<std::int64_t>()) << 64) +
           static_cast<Fixed>(Quad(scaled - ldexp(upper, 64)).convert_to<std::uint64_t>());
}

/// Sum of any number of fixed numbers.
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
    [[nodiscard]] Real value() const {
        const Integer carried = (Integer(high(low_)) << 64) + low(low_);
        const Integer upper = (Integer(static_cast<std::int64_t>(high_ >> 64)) << 64) +
                              static_cast<std::uint64_t>(high_);
        return ldexp(Real((upper << 64) + carried), -behind);
    }

  private:
    Wide low_ = 0;
    Fixed high_ = 0;
};

/// A polynomial of c = x - 1/2 and |c|.
struct Parabola {
    std::array<Quad, 4> quads;  ///< of 1, c, c^2, |c|
    std::array<Fixed, 4> of{};

    explicit Parabola(std::array<Quad, 4> coefficients) : quads(std::move(coefficients)) {
        std::ranges::transform(quads, of.begin(), fixed_of);
    }
    [[nodiscard]] Fixed at(Fixed c) const {
        return of[0] + times(of[1] + times(of[2], c), c) + times(of[3], c < 0 ? -c : c);
    }
    /// No value in the cube is larger.
    [[nodiscard]] double most() const {
        return static_cast<double>(abs(quads[0]) + abs(quads[1]) / 2 + abs(quads[2]) / 4 +
                                   abs(quads[3]) / 2);
    }
};

/// What the factor of an axis makes of a point.
struct Terms {
    Fixed p;
    Fixed q;
    Fixed g;
};

class Axis {
  public:
    Axis(Kind kind, double weight, bool alone)
        : Axis(record_of(kind), Quad(record_of(kind).scale) * weight / 48, alone ? 0 : 1) {}

    [[nodiscard]] Terms terms(Fixed c) const {
        const Fixed a = own_.at(c);
        const Fixed slope = times(sigma_, c);
        return {a - slope, a + slope, times(root_, c)};
    }
    [[nodiscard]] Fixed mean(Fixed c) const { return mean_.at(c); }
    [[nodiscard]] const Quad& total() const { return total_; }

    /// None of a point's terms is larger, nor is 1.
    [[nodiscard]] double most() const {
        const double steep =
            std::ldexp(static_cast<double>(sigma_ < 0 ? -sigma_ : sigma_), -behind);
        const double root = std::ldexp(static_cast<double>(root_), -behind);
        return std::max({1.0, own_.most() + steep / 2, root / 2});
    }

  private:
    Axis(const KindRecord& record, const Quad& unit, int one)
        : own_(own_of(record.kernel, unit, one)),
          mean_(mean_of(record.kernel, unit, one)),
          sigma_(fixed_of(unit * record.kernel.sigma)),
          root_(fixed_of(sqrt(Quad(-unit * record.kernel.s11)))),
          total_(one + unit * record.kernel.total) {}

    static Parabola own_of(const AxisKernel& k, const Quad& unit, int one) {
        const Quad middle = Quad(k.s00) / 2 + Quad(k.s01) / 2 + Quad(k.s02) / 4 + Quad(k.s11) / 8;
        return Parabola({Quad(one) / 2 + unit * middle,
                         unit * (Quad(k.s01 + k.s02) + Quad(k.s11) / 2), unit * k.s02,
                         unit * k.s03});
    }
    static Parabola mean_of(const AxisKernel& k, const Quad& unit, int one) {
        const auto& m = k.mean;
        const Quad middle = Quad(m[0]) + Quad(m[1]) / 2 + Quad(m[2]) / 4;
        return Parabola({one + unit * middle, unit * (m[1] + m[2]), unit * m[2], unit * m[3]});
    }

    Parabola own_;
    Parabola mean_;
    Fixed sigma_;
    Fixed root_;
    Quad total_;
};

std::vector<Axis> axes_of(Kind kind, const std::vector<double>& weights) {
    std::vector<Axis> list;
    const bool alone = weights.empty() && !record_of(kind).projections;
    for (std::size_t k = 0; k < axes; ++k)
        list.emplace_back(kind, weights.empty() ? 1 : weights[k], alone);
    return list;
}

double most_of(const std::vector<Axis>& list) {
    double most = 1;
    for (const Axis& axis : list) most *= axis.most();
    return most;
}

using Point = std::array<Terms, axes>;

struct Item {
    std::uint32_t point;  ///< its number in order of z
    std::uint32_t y;      ///< and of y
    std::uint32_t x;
    bool upper;  ///< which half along z it is of
};

/// Products of a term of z and a term of y.
using Nine = std::array<Fixed, 9>;

/// The terms of a lower or an upper point, by p, q and g.
inline std::array<Fixed, 3> side_of(const Terms& t, bool upper) {
    return upper ? std::array<Fixed, 3>{unity, t.q, -t.g} : std::array<Fixed, 3>{t.p, unity, t.g};
}

inline Nine products(const Terms& z, bool z_upper, const Terms& y, bool y_upper) {
    const auto a = side_of(z, z_upper);
    const auto b = side_of(y, y_upper);
    const std::size_t one_a = z_upper ? 0 : 1;
    const std::size_t one_b = y_upper ? 0 : 1;
    Nine all;
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            all[3 * i + k] = i == one_a ? b[k] : k == one_b ? a[i] : times(a[i], b[k]);
    return all;
}

inline Fixed factor(const Terms& lower, const Terms& upper) {
    return lower.p + upper.q - times(lower.g, upper.g);
}

/// Sums over points that went by, of their products times p, 1 and g of x.
struct Passed {
    Nine p{};
    Nine one{};
    Nine g{};

    void add(const Nine& products, const Terms& x) {
        for (std::size_t i = 0; i < products.size(); ++i) {
            p[i] += times(products[i], x.p);
            one[i] += products[i];
            g[i] += times(products[i], x.g);
        }
    }
    /// Of these points and one whose x is not below theirs.
    [[nodiscard]] Fixed with(const Nine& products, const Terms& x) const {
        Fixed sum = 0;
        for (std::size_t i = 0; i < products.size(); ++i)
            sum += times(products[i], p[i] + times(one[i], x.q) - times(g[i], x.g));
        return sum;
    }
};

/// Sum of the products of all pairs of points, each pair once.
class Division {
  public:
    Division(std::vector<Point> points, std::vector<Item> items, const RunContext& run)
        : points_(std::move(points)),
          items_(std::move(items)),
          halves_(items_.size()),
          spare_(items_.size()),
          run_(run) {}

    FixedSum sum() {
        FixedSum sum;
        within_threads(run_, [&] { solve(0, items_.size(), sum); });
        return sum;
    }

  private:
    static constexpr std::size_t few = 128;
    static constexpr std::size_t many = std::size_t{1} << 12;

    /// All pairs of the items [first, last), which come in order of z and leave in that of y.
    void solve(std::size_t first, std::size_t last, FixedSum& sum) {
        const std::size_t size = last - first;
        if (size <= few) return take_all(first, last, sum);
        in_halves(first, last, sum, [&](auto a, auto b, FixedSum& s) { solve(a, b, s); });
        const std::size_t middle = first + size / 2;
        std::size_t next = first;
        merge(items_, first, last, &Item::y, [&](const Item& item, bool) {
            halves_[next] = item;
            halves_[next++].upper = item.point >= middle;
        });
        solve_across(first, last, sum);
        if (size >= many) tell(size);
    }

    /// Pairs of a lower and an upper item, which come in order of y and leave in that of x.
    void solve_across(std::size_t first, std::size_t last, FixedSum& sum) {
        if (last - first <= few) return take_across(first, last, sum);
        in_halves(first, last, sum, [&](auto a, auto b, FixedSum& s) { solve_across(a, b, s); });
        std::array<std::array<Passed, 2>, 2> passed{};  // by their halves along z and y
        FixedSum mine;
        merge(halves_, first, last, &Item::x, [&](const Item& item, bool y_upper) {
            const Point& at = points_[item.point];
            const Nine both = products(at[2], item.upper, at[1], y_upper);
            mine.add(passed[!item.upper][!y_upper].with(both, at[0]));
            passed[item.upper][y_upper].add(both, at[0]);
        });
        sum.add(mine);
    }

    template <class Solve>
    void in_halves(std::size_t first, std::size_t last, FixedSum& sum, const Solve& solve) {
        const std::size_t middle = first + (last - first) / 2;
        if (last - first < many) {
            solve(first, middle, sum);
            return solve(middle, last, sum);
        }
        run_.check_stop();
        FixedSum left;
        FixedSum right;
        tbb::parallel_invoke([&] { solve(first, middle, left); },
                             [&] { solve(middle, last, right); });
        sum.add(left);
        sum.add(right);
    }

    void take_all(std::size_t first, std::size_t last, FixedSum& sum) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t k = first; k < i; ++k) take(items_[k], items_[i], sum);
        std::ranges::sort(items_.begin() + static_cast<std::ptrdiff_t>(first),
                          items_.begin() + static_cast<std::ptrdiff_t>(last), {}, &Item::y);
    }

    void take_across(std::size_t first, std::size_t last, FixedSum& sum) {
        for (std::size_t i = first; i < last; ++i)
            for (std::size_t k = first; k < i; ++k)
                if (halves_[i].upper != halves_[k].upper) take(halves_[i], halves_[k], sum);
        std::ranges::sort(halves_.begin() + static_cast<std::ptrdiff_t>(first),
                          halves_.begin() + static_cast<std::ptrdiff_t>(last), {}, &Item::x);
    }

    void take(const Item& a, const Item& b, FixedSum& sum) const {
        const Point& one = points_[a.point];
        const Point& other = points_[b.point];
        const auto along = [&](std::size_t k, bool before) {
            return before ? factor(one[k], other[k]) : factor(other[k], one[k]);
        };
        const Fixed plane = times(along(2, a.point < b.point), along(1, a.y < b.y));
        sum.add(times(plane, along(0, a.x < b.x)));
    }

    /// Calls take(item, whether it is from the second half) in the order of a key.
    template <class Take>
    void merge(std::vector<Item>& items, std::size_t first, std::size_t last,
               std::uint32_t Item::*key, const Take& take) {
        const std::size_t middle = first + (last - first) / 2;
        std::size_t low = first;
        std::size_t high = middle;
        for (std::size_t out = first; out < last; ++out) {
            if (out % many == 0) run_.check_stop();
            const bool second =
                low == middle || (high < last && items[high].*key < items[low].*key);
            spare_[out] = items[second ? high++ : low++];
            take(spare_[out], second);
        }
        std::copy(spare_.begin() + static_cast<std::ptrdiff_t>(first),
                  spare_.begin() + static_cast<std::ptrdiff_t>(last),
                  items.begin() + static_cast<std::ptrdiff_t>(first));
    }

    [[nodiscard]] static double work_of(std::size_t n) {
        return static_cast<double>(n) * std::max(1.0, std::log2(static_cast<double>(n) / few));
    }
    void tell(std::size_t n) {
        const std::lock_guard lock(telling_);
        done_ += work_of(n);
        double all = 0;
        for (std::size_t size = items_.size(); size >= many; size /= 2)
            all += work_of(size) * static_cast<double>(items_.size()) / static_cast<double>(size);
        run_.tick(static_cast<std::uint64_t>(std::min(done_, all)),
                  static_cast<std::uint64_t>(all) + 1);
    }

    std::vector<Point> points_;  ///< in order of z
    std::vector<Item> items_;
    std::vector<Item> halves_;
    std::vector<Item> spare_;
    const RunContext& run_;
    std::mutex telling_;
    double done_ = 0;
};

/// The places of points in order of an axis.
std::vector<std::uint32_t> ranks_of(const PointSet& points, std::size_t axis) {
    std::vector<std::uint32_t> order(points.count());
    std::iota(order.begin(), order.end(), 0U);
    std::ranges::stable_sort(order, {}, [&](std::uint32_t i) { return points[i][axis]; });
    std::vector<std::uint32_t> ranks(order.size());
    for (std::size_t r = 0; r < order.size(); ++r) ranks[order[r]] = static_cast<std::uint32_t>(r);
    return ranks;
}

std::vector<Item> items_of(const PointSet& points) {
    const auto z = ranks_of(points, 2);
    const auto y = ranks_of(points, 1);
    const auto x = ranks_of(points, 0);
    std::vector<Item> items(points.count());
    for (std::size_t i = 0; i < items.size(); ++i) items[z[i]] = {z[i], y[i], x[i], false};
    return items;
}

/// A coordinate less 1/2.
Fixed centered(double x) {
    const auto whole = static_cast<Fixed>(fixed(x + 0.0));
    return (whole - (Fixed{1} << (place - 1))) * (Fixed{1} << (behind - place));
}

}  // namespace

bool terms_divide(Kind kind, const std::vector<double>& weights) {
    constexpr double room = 0x1p13;
    const auto& kernel = record_of(kind).kernel;
    return kernel.s11 <= 0 && most_of(axes_of(kind, weights)) <= room;
}

double divide_terms_memory(std::size_t count) {
    return static_cast<double>((sizeof(Point) + 3 * sizeof(Item) + 24) * count);
}

Square divide_terms_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                           const RunContext& run) {
    const std::size_t n = points.count();
    const auto list = axes_of(kind, weights);
    std::vector<Item> items = items_of(points);
    std::vector<Point> terms(n);
    FixedSum means;
    FixedSum own;
    std::size_t rounded = 0;  // coordinates
    for (std::size_t i = 0; i < n; ++i) {
        if (i % 4096 == 0) run.check_stop();
        Point& at = terms[i];
        Fixed mean = unity;
        Fixed itself = unity;
        for (std::size_t k = 0; k < axes; ++k) {
            const double x = points[i][k];
            const Fixed c = centered(x);
            rounded += static_cast<double>(fixed(x + 0.0)) != x * 0x1p63;
            at[k] = list[k].terms(c);
            mean = times(mean, list[k].mean(c));
            itself = times(itself, factor(at[k], at[k]));
        }
        means.add(mean);
        own.add(itself);
    }
    std::vector<Point> in_order(n);
    const auto z = ranks_of(points, 2);
    for (std::size_t i = 0; i < n; ++i) in_order[z[i]] = terms[i];
    terms = {};
    const Real pairs = Division(std::move(in_order), std::move(items), run).sum().value();
    run.tick(1, 1);
    Real total = 1;
    for (const Axis& axis : list) total *= Real(axis.total());
    const Real count = static_cast<double>(n);
    const Real squared =
        total - 2 * means.value() / count + (2 * pairs + own.value()) / (count * count);
    const auto value = squared.convert_to<double>();
    // Each of some ten steps of a pair is off by 2^-90 of its factors, and a coordinate's slope is
    // at most four times the largest product.
    const double most = most_of(list);
    const double moved = 0x1p-62 * most * static_cast<double>(rounded) / static_cast<double>(n);
    return {value, 0x1p-52 * std::abs(value) + 0x1p-85 * most + moved};
}

}  // namespace stipple::analyzers::l2
