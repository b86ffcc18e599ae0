// SPDX-License-Identifier: MIT
//
// Factors of L2 kernels for as many pairs of points as a vector V holds, each a double and a
// correction, their products and their sums. This is no header of its own: l2_meetings.cpp includes
// it in one namespace after the other, for STIPPLE_LANES lanes, with the instructions chosen there
// for all that follows. (What is inlined into functions that have instructions of their own was
// taken apart into single numbers before.)
//
// The factors are those of l2_carried.hpp, where parabolas stand on their vertices:
//
//     a + t (t - 1)             = (a - 1/4) + (t - 1/2)^2
//     h_x + h_y + t (t - 3/2)   = (h_x + h_y - 9/16) + (t - 3/4)^2
//
// so that with a coordinate as a multiple of 2^-53 and a rest, the square's root has no rounding.
// Where all weights are 1 and no coordinate has a rest, the two minima of the centered kernel are
//
//     1 + max(min(x - 1/2, y - 1/2), min(1/2 - x, 1/2 - y), 0)
//
// The numbers of a block's points follow each other in columns; `row` is one point of its block and
// `block` the first of as many as a vector holds. Where blocks lie on one side of each other, less
// is left to work out.

constexpr std::size_t lanes = STIPPLE_LANES;
using V [[gnu::vector_size(8 * lanes)]] = double;
using Bits [[gnu::vector_size(8 * lanes)]] = std::int64_t;

STIPPLE_INLINE V load(const double* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

/// A number in all lanes.
STIPPLE_INLINE V same(double x) { return x - V{}; }

/// x, its sign turned where the other is negative.
STIPPLE_INLINE V flipped(V x, V by) { return (V)((Bits)x ^ ((Bits)by & (std::int64_t{1} << 63))); }
STIPPLE_INLINE V where_less(V a, V b, V x, V y) { return a < b ? x : y; }

#if STIPPLE_LANES == 8
STIPPLE_INLINE V least(V a, V b) { return _mm512_maskz_min_pd(0xff, a, b); }
STIPPLE_INLINE V greatest(V a, V b) { return _mm512_maskz_max_pd(0xff, a, b); }
/// a b + c, rounded once.
STIPPLE_INLINE V fused(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
#elif defined(STIPPLE_FUSES)
STIPPLE_INLINE V least(V a, V b) { return _mm256_min_pd(a, b); }
STIPPLE_INLINE V greatest(V a, V b) { return _mm256_max_pd(a, b); }
STIPPLE_INLINE V fused(V a, V b, V c) { return _mm256_fmadd_pd(a, b, c); }
#else
STIPPLE_INLINE V least(V a, V b) { return a < b ? a : b; }
STIPPLE_INLINE V greatest(V a, V b) { return a > b ? a : b; }
STIPPLE_INLINE V fused(V a, V b, V c) {
    V r;
    for (std::size_t l = 0; l < lanes; ++l) r[l] = __builtin_fma(a[l], b[l], c[l]);
    return r;
}
#endif

/// A vector for each point of a group of rows. What is done to one is done to all before anything
/// else is, so that no instruction waits for the one before.
struct Group {
    V at[group];
};

STIPPLE_INLINE Group all(V a) { return {{a, a, a, a}}; }
STIPPLE_INLINE Group rows(const double* from) {
    return {{same(from[0]), same(from[1]), same(from[2]), same(from[3])}};
}
STIPPLE_INLINE Group columns(const double* from) { return all(load(from)); }

STIPPLE_INLINE Group operator+(const Group& a, const Group& b) {
    return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], a.at[3] + b.at[3]}};
}
STIPPLE_INLINE Group operator-(const Group& a, const Group& b) {
    return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], a.at[3] - b.at[3]}};
}
STIPPLE_INLINE Group operator-(const Group& a) {
    return {{-a.at[0], -a.at[1], -a.at[2], -a.at[3]}};
}
STIPPLE_INLINE Group operator*(const Group& a, const Group& b) {
    return {{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2], a.at[3] * b.at[3]}};
}
STIPPLE_INLINE Group fused(const Group& a, const Group& b, const Group& c) {
    return {{fused(a.at[0], b.at[0], c.at[0]), fused(a.at[1], b.at[1], c.at[1]),
             fused(a.at[2], b.at[2], c.at[2]), fused(a.at[3], b.at[3], c.at[3])}};
}
STIPPLE_INLINE Group least(const Group& a, const Group& b) {
    return {{least(a.at[0], b.at[0]), least(a.at[1], b.at[1]), least(a.at[2], b.at[2]),
             least(a.at[3], b.at[3])}};
}
STIPPLE_INLINE Group greatest(const Group& a, const Group& b) {
    return {{greatest(a.at[0], b.at[0]), greatest(a.at[1], b.at[1]), greatest(a.at[2], b.at[2]),
             greatest(a.at[3], b.at[3])}};
}
STIPPLE_INLINE Group flipped(const Group& x, const Group& by) {
    return {{flipped(x.at[0], by.at[0]), flipped(x.at[1], by.at[1]), flipped(x.at[2], by.at[2]),
             flipped(x.at[3], by.at[3])}};
}
STIPPLE_INLINE Group where_less(const Group& a, const Group& b, const Group& x, const Group& y) {
    return {{where_less(a.at[0], b.at[0], x.at[0], y.at[0]),
             where_less(a.at[1], b.at[1], x.at[1], y.at[1]),
             where_less(a.at[2], b.at[2], x.at[2], y.at[2]),
             where_less(a.at[3], b.at[3], x.at[3], y.at[3])}};
}

/// A number and its correction, of a vector or a group of them.
template <class T>
struct Carried {
    T value;
    T lost;
};

/// base + a b: the base is at least as large as |a b|.
STIPPLE_INLINE Carried<Group> raised(const Group& a, const Group& b, const Group& base) {
    const Group high = fused(a, b, base);
    return {high, fused(a, b, base - high)};
}

/// The same, less the shift.
STIPPLE_INLINE Carried<Group> raised(const Group& a, const Group& b, const AxisConstants& axis) {
    const auto [high, low] = raised(a, b, all(same(axis.base)));
    return {high - all(same(axis.shift)), low + all(same(axis.lost))};
}

/// |x - y| - c of places in column 0, place - c in column 1 and, if they are fine, rests in
/// column 2. Without rounding.
template <Lie lie, bool fine>
STIPPLE_INLINE Carried<Group> distance_from(double c, const double* row, const double* block) {
    Group rest = all(V{});
    if constexpr (fine) rest = columns(block + 2 * block_width) - rows(row + 2 * block_width);
    if constexpr (lie == Lie::below) return {columns(block + block_width) - rows(row), rest};
    if constexpr (lie == Lie::above) return {rows(row + block_width) - columns(block), -rest};
    const Group t = columns(block) - rows(row);
    if constexpr (!fine) return {flipped(t, t) - all(same(c)), rest};
    const Group whole = t + rest;
    return {flipped(t, whole) - all(same(c)), flipped(rest, whole)};
}

/// One minimum, of numbers without corrections.
struct Least {
    static constexpr std::size_t columns_of_factor = 1;
    static constexpr bool separates = true;
    static constexpr Factor takes = Factor::exact;
    template <Lie>
    STIPPLE_INLINE static Carried<Group> factor(const double* row, const double* block,
                                                const AxisConstants&) {
        return {least(columns(block), rows(row)), all(V{})};
    }
    /// Of the points of a block that come before the others.
    STIPPLE_INLINE static Carried<V> own(const double* block) { return {load(block), V{}}; }
};

/// One minimum: of the numbers of the point that comes first in the order of column 0.
struct LeastCarried {
    static constexpr std::size_t columns_of_factor = 3;
    static constexpr bool separates = true;
    static constexpr Factor takes = Factor::carried;
    template <Lie>
    STIPPLE_INLINE static Carried<Group> factor(const double* row, const double* block,
                                                const AxisConstants&) {
        const Group mine = rows(row);
        const Group other = columns(block);
        return {
            where_less(mine, other, rows(row + block_width), columns(block + block_width)),
            where_less(mine, other, rows(row + 2 * block_width), columns(block + 2 * block_width))};
    }
    STIPPLE_INLINE static Carried<V> own(const double* block) {
        return {load(block + block_width), load(block + 2 * block_width)};
    }
};

/// Two minima at once: x - 1/2 in column 0, 1/2 - x in column 1.
struct Around {
    static constexpr std::size_t columns_of_factor = 2;
    static constexpr bool separates = false;
    static constexpr Factor takes = Factor::over_one;
    template <Lie lie>
    STIPPLE_INLINE static Carried<Group> factor(const double* row, const double* block,
                                                const AxisConstants&) {
        const Group none = all(V{});
        const Group above = least(columns(block), rows(row));
        if constexpr (lie == Lie::above) return {above, none};
        const Group below = least(columns(block + block_width), rows(row + block_width));
        if constexpr (lie == Lie::below) return {below, none};
        return {greatest(greatest(above, below), none), none};
    }
};

/// A parabola of the distance; on plain axes neither shift nor base.lost is anything but 0.
template <bool fine, bool plain>
struct Bend {
    static constexpr std::size_t columns_of_factor = fine ? 3 : 2;
    static constexpr bool separates = false;
    static constexpr Factor takes = Factor::carried;
    template <Lie lie>
    STIPPLE_INLINE static Carried<Group> factor(const double* row, const double* block,
                                                const AxisConstants& axis) {
        const auto [u, rest] = distance_from<lie, fine>(corner_of_bend, row, block);
        Carried<Group> out;
        if constexpr (plain)
            out = raised(u, u, all(same(axis.base)));
        else
            out = raised(u, u, axis);
        if constexpr (fine) out.lost = fused(u + u, rest, out.lost);
        return out;
    }
};

template <bool fine>
struct Mixture {
    static constexpr std::size_t columns_of_factor = fine ? 5 : 4;
    static constexpr bool separates = false;
    static constexpr Factor takes = Factor::carried;
    template <Lie lie>
    STIPPLE_INLINE static Carried<Group> factor(const double* row, const double* block,
                                                const AxisConstants&) {
        constexpr std::size_t h = (columns_of_factor - 2) * block_width;
        const auto [u, rest] = distance_from<lie, fine>(corner_of_mixture, row, block);
        const Group base = columns(block + h) + rows(row + h);  // exact
        Carried<Group> out = raised(u, u, base);
        out.lost = out.lost + (columns(block + h + block_width) + rows(row + h + block_width));
        if constexpr (fine) out.lost = fused(u + u, rest, out.lost);
        return out;
    }
};

struct Excess {
    static constexpr std::size_t columns_of_factor = 3;
    static constexpr bool separates = false;
    static constexpr Factor takes = Factor::carried;
    template <Lie>
    STIPPLE_INLINE static Carried<Group> factor(const double* row, const double* block,
                                                const AxisConstants& axis) {
        const Group x = rows(row);
        const Group y = columns(block);
        const Group lower = least(x, y);
        const Group room = where_less(x, y, columns(block + block_width), rows(row + block_width));
        const Group lost =
            where_less(x, y, columns(block + 2 * block_width), rows(row + 2 * block_width));
        Carried<Group> out = raised(lower, room, axis);
        out.lost = fused(lower, lost, out.lost);
        return out;
    }
};

/// A product's first factor.
template <class Kernel>
STIPPLE_INLINE Carried<Group> product_of(const Carried<Group>& first) {
    if constexpr (Kernel::takes != Factor::over_one) return first;
    const Group one = all(same(1));
    const Group value = first.value + one;
    return {value, first.value - (value - one)};
}

template <class Kernel, class T>
STIPPLE_INLINE void multiply(Carried<T>& product, const Carried<T>& by) {
    if constexpr (Kernel::takes == Factor::over_one) {
        const T next = fused(product.value, by.value, product.value);
        const T rounded = fused(product.value, by.value, product.value - next);
        product.lost = fused(product.lost, by.value, product.lost + rounded);
        product.value = next;
    } else {
        const T next = product.value * by.value;
        T rounded = fused(product.value, by.value, -next);
        if constexpr (Kernel::takes == Factor::carried)
            rounded = fused(product.value, by.lost, rounded);
        product.lost = fused(product.lost, by.value, rounded);
        product.value = next;
    }
}

STIPPLE_INLINE void add(Carried<V>& total, const Carried<V>& product) {
    const V next = total.value + product.value;
    const V part = next - total.value;
    total.lost += ((total.value - (next - part)) + (product.value - part)) + product.lost;
    total.value = next;
}

/// A group of points, some of which may be no more than places, and a block.
struct Meeting {
    const Table& table;
    const Pair& pair;
    std::size_t first;  ///< of the group in its block
};

template <class Kernel, Lie lie>
STIPPLE_INLINE Carried<Group> factor_of(const Meeting& m, std::size_t factor, std::size_t k) {
    const std::size_t column = factor * Kernel::columns_of_factor * block_width;
    return Kernel::template factor<lie>(m.pair.rows + column + m.first, m.pair.columns + column + k,
                                        m.table.factors()[factor]);
}

/// What the products begin with: the weights of the columns, or their first factor.
template <class Kernel>
STIPPLE_INLINE Carried<Group> beginning(const Meeting& m, std::size_t k) {
    if constexpr (Kernel::separates)
        return {columns(m.pair.column_weights.value + k), columns(m.pair.column_weights.lost + k)};
    else
        return product_of<Kernel>(factor_of<Kernel, Lie::mixed>(m, m.pair.steps.front().factor, k));
}

/// The products of a group of points with as many of a block's as a vector holds, from the k-th.
template <class Kernel>
STIPPLE_INLINE Carried<Group> products(const Meeting& m, std::size_t k) {
    Carried<Group> p = beginning<Kernel>(m, k);
    const Step* step = m.pair.steps.data() + (Kernel::separates ? 0 : 1);
    for (const Step* const end = m.pair.steps.data() + m.pair.steps.size(); step < end; ++step) {
        if (Kernel::separates || step->lie == Lie::mixed)
            multiply<Kernel>(p, factor_of<Kernel, Lie::mixed>(m, step->factor, k));
        else if (step->lie == Lie::below)
            multiply<Kernel>(p, factor_of<Kernel, Lie::below>(m, step->factor, k));
        else
            multiply<Kernel>(p, factor_of<Kernel, Lie::above>(m, step->factor, k));
    }
    if (Kernel::separates || m.pair.full) return p;
    const std::size_t last = (m.table.height() - 1) * block_width;
    const Group there = columns(m.pair.columns + last + k) * rows(m.pair.rows + last + m.first);
    return {p.value * there, p.lost * there};
}

/// Adds the products of a group of points with those of a block, lane by lane the same in vectors
/// of any width. Rows that have weights are summed one by one.
template <class Kernel>
STIPPLE_INLINE void meet_group(const Meeting& m, Sums& sums) {
    constexpr std::size_t parts = spread / lanes;
    constexpr std::size_t kept = Kernel::separates ? group : 1;
    Carried<V> totals[parts][kept];
#pragma GCC unroll 8
    for (std::size_t q = 0; q < parts * kept; ++q) totals[q / kept][q % kept] = {V{}, V{}};
    for (std::size_t k = 0; k < block_width; k += spread)
#pragma GCC unroll 4
        for (std::size_t q = 0; q < parts; ++q) {
            const Carried<Group> p = products<Kernel>(m, k + q * lanes);
#pragma GCC unroll 4
            for (std::size_t r = 0; r < group; ++r)
                add(totals[q][r % kept], {p.value.at[r], p.lost.at[r]});
        }
    for (std::size_t q = 0; q < parts; ++q) {
        double* const sum = sums.sum + q * lanes;
        double* const lost = sums.lost + q * lanes;
        Carried<V> total = {load(sum), load(lost)};
        for (std::size_t r = 0; r < kept; ++r) {
            if constexpr (Kernel::separates) {
                const Weights& weights = m.pair.row_weights;
                multiply<LeastCarried, V>(totals[q][r], {same(weights.value[m.first + r]),
                                                         same(weights.lost[m.first + r])});
            }
            add(total, totals[q][r]);
        }
        std::memcpy(sum, &total.value, sizeof(V));
        std::memcpy(lost, &total.lost, sizeof(V));
    }
}

/// The same of two blocks.
template <class Kernel>
void meet(const Table& table, const Pair& pair, Sums& sums) {
    for (std::size_t i = 0; i < block_width; i += group) meet_group<Kernel>({table, pair, i}, sums);
}

/// The product of the factors of a block's points that are their own.
template <class Kernel>
void weigh(const Table& table, const double* block, const std::vector<std::size_t>& own,
           Weights& weights) {
    for (std::size_t k = 0; k < block_width; k += lanes) {
        Carried<V> p = {load(block + (table.height() - 1) * block_width + k), V{}};
        if constexpr (Kernel::separates)
            for (const std::size_t factor : own)
                multiply<Kernel>(
                    p, Kernel::own(block + factor * Kernel::columns_of_factor * block_width + k));
        std::memcpy(weights.value + k, &p.value, sizeof(V));
        std::memcpy(weights.lost + k, &p.lost, sizeof(V));
    }
}

template <class Kernel>
Work work_of() {
    return {meet<Kernel>, weigh<Kernel>, Kernel::columns_of_factor, Kernel::separates};
}

inline Work work_of(Form form) {
    switch (form) {
        case Form::least:
            return work_of<Least>();
        case Form::least_carried:
            return work_of<LeastCarried>();
        case Form::around:
            return work_of<Around>();
        case Form::bend:
            return work_of<Bend<false, true>>();
        case Form::bend_fine:
            return work_of<Bend<true, true>>();
        case Form::bend_shifted:
            return work_of<Bend<false, false>>();
        case Form::bend_shifted_fine:
            return work_of<Bend<true, false>>();
        case Form::mixture:
            return work_of<Mixture<false>>();
        case Form::mixture_fine:
            return work_of<Mixture<true>>();
        default:
            return work_of<Excess>();
    }
}
