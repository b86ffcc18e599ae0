// SPDX-License-Identifier: MIT
#include "analyzers/l2/l2_divide.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <mutex>

#include "analyzers/l2/l2_divide_terms.hpp"
#include "analyzers/l2/l2_numbers.hpp"
#include "core/parallel.hpp"

namespace stipple::analyzers::l2 {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Fraction = boost::multiprecision::cpp_rational;

constexpr std::size_t max_axes = 4;
constexpr unsigned behind = 96;  // bits of a weight behind the point
constexpr Wide unity = Wide{1} << behind;
constexpr std::uint64_t whole = std::uint64_t{1} << place;

/// a b for weights below 2^32, cut off.
Wide times(Wide a, Wide b) {
    const Wide middle = product(high(a), low(b)) + product(low(a), high(b)) +
                        high(product(low(a), low(b)));  // no overflow: high parts are small
    return (product(high(a), high(b)) << (128 - behind)) + (middle >> (behind - 64));
}

Wide weight_of(std::uint64_t coordinate) {
    return static_cast<Wide>(coordinate) << (behind - place);
}

/// An axis: 1 + w k, or k alone.
struct AxisWeight {
    bool alone;
    Wide weight;

    /// 1 + w k; k = 0 gives 1, too
    [[nodiscard]] Wide of(Wide k) const {
        return alone ? k : unity + (weight == unity ? k : times(weight, k));
    }
    [[nodiscard]] Fraction total(int part) const {
        const Integer scale = Integer(1) << behind;
        const Integer w = (Integer(high(weight)) << 64) + low(weight);
        return (alone ? Fraction(0) : Fraction(1)) + Fraction(w, scale * part);
    }
};

// Kernels: L, U, the mean f of K(x, .), and the mean C of f.
struct Falling : AxisWeight {
    static constexpr bool one_below = true;
    [[nodiscard]] Wide lower(std::uint64_t) const { return unity; }
    [[nodiscard]] Wide upper(std::uint64_t x) const { return of(weight_of(whole - x)); }
    [[nodiscard]] Wide mean(std::uint64_t x) const {
        return of((product(whole, whole) - product(x, x)) >> (2 * place + 1 - behind));
    }
    [[nodiscard]] Fraction total() const { return AxisWeight::total(3); }
};
struct Between : AxisWeight {
    static constexpr bool one_below = false;
    [[nodiscard]] Wide lower(std::uint64_t x) const { return weight_of(x); }
    [[nodiscard]] Wide upper(std::uint64_t x) const { return weight_of(whole - x); }
    [[nodiscard]] Wide mean(std::uint64_t x) const {
        return product(x, whole - x) >> (2 * place + 1 - behind);
    }
    [[nodiscard]] Fraction total() const { return AxisWeight::total(12); }
};
struct Centered : AxisWeight {
    static constexpr bool one_below = false;
    static constexpr std::uint64_t half = whole / 2;
    [[nodiscard]] Wide lower(std::uint64_t x) const {
        return x > half ? of(weight_of(x - half)) : unity;
    }
    [[nodiscard]] Wide upper(std::uint64_t x) const {
        return x < half ? of(weight_of(half - x)) : unity;
    }
    [[nodiscard]] Wide mean(std::uint64_t x) const {
        const std::uint64_t away = x < half ? half - x : x - half;
        return of(product(away, whole - away) >> (2 * place + 1 - behind));
    }
    [[nodiscard]] Fraction total() const { return AxisWeight::total(12); }
};

struct Item {
    Wide weight;
    std::array<std::uint64_t, max_axes> at;
    bool upper;  ///< along the axis that was last: its color
};

template <class Kernel>
class Division {
  public:
    Division(std::vector<Kernel> axes, std::vector<Item> items, const RunContext& run)
        : axes_(std::move(axes)), levels_(axes_.size() + 1), spare_(axes_.size() + 1), run_(run) {
        const std::size_t n = items.size();
        levels_[axes_.size()] = std::move(items);
        for (std::size_t r = 2; r <= axes_.size(); ++r) {
            levels_[r].resize(n);
            spare_[r].resize(n);
        }
        total_work_ = work_of(n) * std::max(1.0, std::log2(static_cast<double>(n)));
    }

    /// Sum of the products of all pairs, each pair once, in units of 2^-192.
    LongSum sum() {
        const std::size_t n = levels_[axes_.size()].size();
        const std::size_t last = axes_.size() - 1;
        std::ranges::sort(levels_[axes_.size()], {}, [&](const Item& i) { return i.at[last]; });
        LongSum sum;
        within_threads(run_, [&] { solve(axes_.size(), 0, n, sum); });
        return sum;
    }

  private:
    static constexpr std::size_t few = 8;
    static constexpr std::size_t many = std::size_t{1} << 12;

    /// Pairs of the items [first, last) of a level, of two colors (on the highest level: all), by
    /// the factors of the axes below r; they come in order of axis r - 1 and leave in that of r
    /// - 2.
    void solve(std::size_t r, std::size_t first, std::size_t last, LongSum& sum);
    void solve_two(std::size_t r, std::size_t first, std::size_t middle, std::size_t last,
                   LongSum& sum);
    void leaf(std::size_t r, std::size_t first, std::size_t last, LongSum& sum);
    /// Merges halves in order of axis r - 2, sharing them out to the level below.
    void halve(std::size_t r, std::size_t first, std::size_t last, LongSum& sum);
    /// The same where the axis is the last one, on which it is only summed.
    void merge_and_sum(std::size_t first, std::size_t last, LongSum& sum);

    [[nodiscard]] bool top(std::size_t r) const { return r == axes_.size(); }
    /// Merges the halves and calls take(item, whether it is from the upper half) on the way.
    template <class Take>
    void merge(std::size_t r, std::size_t first, std::size_t last, const Take& take);
    [[nodiscard]] Wide factor(std::size_t axis, const Item& a, const Item& b) const {
        const std::uint64_t x = a.at[axis];
        const std::uint64_t y = b.at[axis];
        return times(axes_[axis].lower(std::min(x, y)), axes_[axis].upper(std::max(x, y)));
    }
    [[nodiscard]] Wide side_factor(std::size_t axis, const Item& item, bool upper) const {
        return upper ? axes_[axis].upper(item.at[axis]) : axes_[axis].lower(item.at[axis]);
    }
    [[nodiscard]] double work_of(std::size_t n) const {
        const auto size = static_cast<double>(n);
        return size * std::pow(std::log2(size + 1), static_cast<double>(axes_.size()) - 2);
    }
    void tell(std::size_t n) {
        const std::lock_guard lock(telling_);
        done_ += work_of(n);
        run_.tick(static_cast<std::uint64_t>(done_), static_cast<std::uint64_t>(total_work_) + 1);
    }

    std::vector<Kernel> axes_;
    std::vector<std::vector<Item>> levels_;  ///< items of the problem on so many axes
    std::vector<std::vector<Item>> spare_;
    const RunContext& run_;
    std::mutex telling_;
    double done_ = 0;
    double total_work_ = 1;
};

template <class Kernel>
void Division<Kernel>::solve(std::size_t r, std::size_t first, std::size_t last, LongSum& sum) {
    const std::size_t size = last - first;
    if (size <= few) return leaf(r, first, last, sum);
    if (size >= many) run_.check_stop();
    solve_two(r, first, first + size / 2, last, sum);
    if (r == 2)
        merge_and_sum(first, last, sum);
    else
        halve(r, first, last, sum);
    if (top(r) && size >= many) tell(size);
}

template <class Kernel>
void Division<Kernel>::solve_two(std::size_t r, std::size_t first, std::size_t middle,
                                 std::size_t last, LongSum& sum) {
    if (last - first < many) {
        solve(r, first, middle, sum);
        solve(r, middle, last, sum);
        return;
    }
    LongSum left;
    LongSum right;
    tbb::parallel_invoke([&] { solve(r, first, middle, left); },
                         [&] { solve(r, middle, last, right); });
    sum.add(left);
    sum.add(right);
}

template <class Kernel>
void Division<Kernel>::leaf(std::size_t r, std::size_t first, std::size_t last, LongSum& sum) {
    const std::span items(levels_[r].data() + first, last - first);
    for (std::size_t i = 0; i < items.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            if (!top(r) && items[i].upper == items[k].upper) continue;
            Wide value = items[i].weight;
            for (std::size_t axis = 0; axis < r; ++axis)
                value = times(value, factor(axis, items[i], items[k]));
            sum.add_product(value, items[k].weight);
        }
    const std::size_t next = r - 2;
    for (std::size_t i = 1; i < items.size(); ++i)
        for (std::size_t k = i; k > 0 && items[k].at[next] < items[k - 1].at[next]; --k)
            std::swap(items[k], items[k - 1]);
}

template <class Kernel>
template <class Take>
void Division<Kernel>::merge(std::size_t r, std::size_t first, std::size_t last, const Take& take) {
    Item* const items = levels_[r].data();
    Item* out = spare_[r].data() + first;
    const std::size_t middle = first + (last - first) / 2;
    std::size_t low = first;
    std::size_t high = middle;
    for (std::size_t count = 0; low < middle || high < last; ++count) {
        if (count % (std::size_t{1} << 14) == 0) run_.check_stop();
        const bool upper =
            low == middle || (high < last && items[high].at[r - 2] < items[low].at[r - 2]);
        const Item& item = items[upper ? high++ : low++];
        take(item, upper);
        *out++ = item;
    }
    std::copy(spare_[r].data() + first, out, items + first);
}

template <class Kernel>
void Division<Kernel>::halve(std::size_t r, std::size_t first, std::size_t last, LongSum& sum) {
    Item* const below = levels_[r - 1].data();
    std::size_t next = first;  // one color below and the other above from here on,
    std::size_t rest = last;   // the other way round from here back
    merge(r, first, last, [&](const Item& item, bool upper) {
        Item share = item;
        share.weight = times(item.weight, side_factor(r - 1, item, upper));
        share.upper = upper;
        const bool crossed = !top(r) && item.upper != upper;
        below[crossed ? --rest : next++] = share;
    });
    std::reverse(below + rest, below + last);
    solve_two(r - 1, first, next, last, sum);
}

template <class Kernel>
void Division<Kernel>::merge_and_sum(std::size_t first, std::size_t last, LongSum& sum) {
    Wide passed[2][2] = {};  // L of what went by, by pairing and side
    const Kernel& last_axis = axes_[0];
    const bool all = top(2);
    LongSum mine;
    merge(2, first, last, [&](const Item& item, bool upper) {
        const bool crossed = !all && item.upper != upper;
        const bool plain = Kernel::one_below && !upper;
        const Wide weight = plain ? item.weight : times(item.weight, side_factor(1, item, upper));
        mine.add_product(times(weight, last_axis.upper(item.at[0])), passed[crossed][!upper]);
        passed[crossed][upper] +=
            Kernel::one_below ? weight : times(weight, last_axis.lower(item.at[0]));
    });
    sum.add(mine);
}

/// mean of means - 2/n sum of means + n^-2 sum of pairs
template <class Kernel>
Square square(const PointSet& points, const std::vector<Kernel>& axes, const RunContext& run) {
    const std::size_t n = points.count();
    std::vector<Item> items(n);
    LongSum means;
    LongSum own;
    std::size_t rounded = 0;  // coordinates
    for (std::size_t i = 0; i < n; ++i) {
        if (i % 4096 == 0) run.check_stop();
        Item& item = items[i];
        item = {unity, {}, false};
        Wide mean = unity;
        Wide itself = unity;
        for (std::size_t j = 0; j < axes.size(); ++j) {
            const std::uint64_t x = item.at[j] = fixed(points[i][j] + 0.0);
            rounded += static_cast<double>(x) != points[i][j] * 0x1p63;
            mean = times(mean, axes[j].mean(x));
            itself = times(itself, times(axes[j].lower(x), axes[j].upper(x)));
        }
        means.add(mean);
        own.add(itself);
    }
    Fraction total = 1;
    for (const Kernel& axis : axes) total *= axis.total();
    const Integer pairs =
        2 * Division<Kernel>(axes, std::move(items), run).sum().value() + (own.value() << behind);
    const Integer count = n;
    run.tick(1, 1);
    const Fraction squared = total - Fraction(2 * means.value(), count << behind) +
                             Fraction(pairs, (count * count) << (2 * behind));
    const auto value = squared.convert_to<double>();
    // A coordinate's slope is at most 4/n times the largest product, 16.
    const double moved = 0x1p-64 * 64 * static_cast<double>(rounded) / static_cast<double>(n);
    return {value, 0x1p-52 * value + 0x1p-80 + moved};
}

template <class Kernel>
Square square_of(const PointSet& points, const std::vector<double>& weights, bool alone,
                 const RunContext& run) {
    std::vector<Kernel> axes(points.dimension());
    for (std::size_t j = 0; j < axes.size(); ++j) {
        const double weight = weights.empty() ? 1 : weights[j];
        axes[j].alone = alone;
        axes[j].weight = static_cast<Wide>(std::ldexp(weight, behind));
    }
    return square(points, axes, run);
}

}  // namespace

namespace {

/// Whether a kind is one product on either side of the diagonal.
bool is_one_product(Kind kind, const std::vector<double>& weights) {
    double most = 1;  // room for sums above the point
    for (const double weight : weights) most *= 1 + weight;
    switch (kind) {
        case Kind::star:
        case Kind::modified:
        case Kind::centered:
            return most <= 16;
        case Kind::extreme:
            return weights.empty();
        default:
            return false;
    }
}

}  // namespace

bool divides(std::size_t dimension, Kind kind, const std::vector<double>& weights) {
    if (dimension < 3 || dimension > max_axes) return false;
    return is_one_product(kind, weights) || (dimension == 3 && terms_divide(kind, weights));
}

bool divide_wins(std::size_t count, std::size_t dimension, Kind kind) {
    // Measured; the pairs of star and modified have half the factors.
    if (!is_one_product(kind, {})) return count >= 50'000 && count <= std::size_t{1} << 23;
    if (count >= std::size_t{1} << 27) return false;  // no room for sums
    const bool simple = kind == Kind::star || kind == Kind::modified;
    if (dimension == 3) return count >= (simple ? 28'000U : 17'000U);
    return count >= (simple ? 200'000U : 100'000U);
}

double divide_memory(std::size_t count, std::size_t dimension, Kind kind) {
    if (!is_one_product(kind, {})) return divide_terms_memory(count);
    return 2 * static_cast<double>(sizeof(Item) * count * (dimension - 1));
}

Square divide_square(const PointSet& points, Kind kind, const std::vector<double>& weights,
                     const RunContext& run) {
    if (!is_one_product(kind, weights)) return divide_terms_square(points, kind, weights, run);
    const bool alone = weights.empty() && !record_of(kind).projections;
    if (kind == Kind::extreme) return square_of<Between>(points, weights, alone, run);
    if (kind == Kind::centered) return square_of<Centered>(points, weights, alone, run);
    return square_of<Falling>(points, weights, alone, run);
}

}  // namespace stipple::analyzers::l2
