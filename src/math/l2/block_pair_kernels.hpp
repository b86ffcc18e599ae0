// SPDX-License-Identifier: MIT
//
// Factors of L2 kernels, their products and sums, for as many pairs of points as a vector V holds.
// Each of these numbers is a double and an error term. Not a standalone header:
// core/machine/vector_widths.hpp includes it in block_pairs.cpp, once for every
// STIPPLE_VECTOR_BITS.
//
// The factors are those of pair_sums.cpp, with parabolas about their vertices:
//
//     a + t (t - 1)             = (a - 1/4) + (t - 1/2)^2
//     h_x + h_y + t (t - 3/2)   = (h_x + h_y - 9/16) + (t - 3/4)^2
//     a - t                     = (a - 1/2) - (t - 1/2)
//
// so that t - 1/2 and t - 3/4 are exact if a coordinate is stored as a multiple of 2^-53 and a
// remainder. If all weights are 1 and no coordinate has a remainder, the two minima of the centered
// kernel are
//
//     1 + max(min(x - 1/2, y - 1/2), min(1/2 - x, 1/2 - y), 0)
//
// One point of a pair is in a block of rows, the other in a block of columns; the numbers of a
// block's points are stored by column. `row` points to the first of a group of points in the block
// of rows, `block` to the first of a vector of points in the block of columns.

constexpr std::size_t lanes = STIPPLE_VECTOR_BITS / 64;
using V [[gnu::vector_size(8 * lanes)]] = double;
using Bits [[gnu::vector_size(8 * lanes)]] = std::int64_t;

STIPPLE_INLINE V load(const double* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

/// Vector with x in all lanes.
STIPPLE_INLINE V same(double x) { return x - V{}; }

/// x with its sign changed if `by` is negative.
STIPPLE_INLINE V flipped(V x, V by) { return (V)((Bits)x ^ ((Bits)by & (std::int64_t{1} << 63))); }
STIPPLE_INLINE V where_less(V a, V b, V x, V y) { return a < b ? x : y; }

#if STIPPLE_VECTOR_BITS == 512
STIPPLE_INLINE V least(V a, V b) { return _mm512_maskz_min_pd(0xff, a, b); }
STIPPLE_INLINE V greatest(V a, V b) { return _mm512_maskz_max_pd(0xff, a, b); }
/// a b + c, rounded once.
STIPPLE_INLINE V fused(V a, V b, V c) { return _mm512_fmadd_pd(a, b, c); }
#elif STIPPLE_VECTOR_BITS == 256
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

/// A vector for each point of a group of rows. Each operation is done for all these vectors before
/// the next operation, so that no instruction waits for the one before.
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

/// A number and its error term, for a vector or a group. For groups assign the members, not the
/// whole: GCC copies a structure by halves of vectors, and loads then wait for the stores.
template <class T>
struct Compensated {
    T value;
    T error;
};

/// base + a b, with its error term; the base must be at least as large as |a b|.
STIPPLE_INLINE Compensated<Group> raised(const Group& a, const Group& b, const Group& base) {
    const Group high = fused(a, b, base);
    return {high, fused(a, b, base - high)};
}

/// axis.base + a b - axis.offset, with its error term.
STIPPLE_INLINE Compensated<Group> raised(const Group& a, const Group& b,
                                         const AxisConstants& axis) {
    Compensated<Group> out = raised(a, b, all(same(axis.base)));
    out.value = out.value - all(same(axis.offset));
    out.error = out.error + all(same(axis.base_error));
    return out;
}

/// |x - y| - vertex without rounding, from positions in column 0 and remainders in column 1.
STIPPLE_INLINE Compensated<Group> from_vertex(const double* row, const double* block,
                                              const AxisConstants& axis) {
    const Group t = columns(block) - rows(row);
    const Group rest = columns(block + block_width) - rows(row + block_width);
    const Group whole = t + rest;
    return {flipped(t, whole) - all(same(axis.vertex)), flipped(rest, whole)};
}

/// The factor min(g_x, g_y): selects the term of the point whose number in column 0 is smaller.
struct Minimum {
    static constexpr std::size_t columns_of_factor = 3;
    static constexpr bool separates = true;
    static constexpr bool above_one = false;
    STIPPLE_INLINE static Compensated<Group> factor(const double* row, const double* block,
                                                    const AxisConstants&) {
        const Group mine = rows(row);
        const Group other = columns(block);
        return {
            where_less(mine, other, rows(row + block_width), columns(block + block_width)),
            where_less(mine, other, rows(row + 2 * block_width), columns(block + 2 * block_width))};
    }
    /// The factor of a point of this block if all its points precede those of the other block.
    STIPPLE_INLINE static Compensated<V> own(const double* block) {
        return {load(block + block_width), load(block + 2 * block_width)};
    }
};

/// Both minima of the centered kernel, from x - 1/2 in column 0 and 1/2 - x in column 1.
struct TwoSided {
    static constexpr std::size_t columns_of_factor = 2;
    static constexpr bool separates = false;
    static constexpr bool above_one = true;  ///< factor() returns the factor minus 1
    STIPPLE_INLINE static Compensated<Group> factor(const double* row, const double* block,
                                                    const AxisConstants&) {
        const Group none = all(V{});
        const Group above = least(columns(block), rows(row));
        const Group below = least(columns(block + block_width), rows(row + block_width));
        return {greatest(greatest(above, below), none), none};
    }
};

/// A parabola in |x - y|.
struct Bernoulli {
    static constexpr std::size_t columns_of_factor = 2;
    static constexpr bool separates = false;
    static constexpr bool above_one = false;
    STIPPLE_INLINE static Compensated<Group> factor(const double* row, const double* block,
                                                    const AxisConstants& axis) {
        const auto [u, rest] = from_vertex(row, block, axis);
        Compensated<Group> out = raised(u, u, axis);
        out.error = fused(u + u, rest, out.error);
        return out;
    }
};

/// A function that decreases linearly with |x - y|.
struct Linear {
    static constexpr std::size_t columns_of_factor = 2;
    static constexpr bool separates = false;
    static constexpr bool above_one = false;
    STIPPLE_INLINE static Compensated<Group> factor(const double* row, const double* block,
                                                    const AxisConstants& axis) {
        const auto [u, rest] = from_vertex(row, block, axis);
        Compensated<Group> out = raised(u, all(same(-1)), axis);
        out.error = out.error - rest;
        return out;
    }
};

/// Mixture kernel: a parabola in |x - y| plus one number for each of the two points; the sum of the
/// two numbers has no rounding error.
struct Mixture {
    static constexpr std::size_t columns_of_factor = 4;
    static constexpr bool separates = false;
    static constexpr bool above_one = false;
    STIPPLE_INLINE static Compensated<Group> factor(const double* row, const double* block,
                                                    const AxisConstants& axis) {
        constexpr std::size_t height = 2 * block_width;
        constexpr std::size_t error = 3 * block_width;
        const auto [u, rest] = from_vertex(row, block, axis);
        Compensated<Group> out = raised(u, u, columns(block + height) + rows(row + height));
        out.error = out.error + (columns(block + error) + rows(row + error));
        out.error = fused(u + u, rest, out.error);
        return out;
    }
};

/// The factor a + min(x, y) min(1 - x, 1 - y).
struct OnePlusMinima {
    static constexpr std::size_t columns_of_factor = 3;
    static constexpr bool separates = false;
    static constexpr bool above_one = false;
    STIPPLE_INLINE static Compensated<Group> factor(const double* row, const double* block,
                                                    const AxisConstants& axis) {
        const Group x = rows(row);
        const Group y = columns(block);
        const Group lower = least(x, y);
        const Group room = where_less(x, y, columns(block + block_width), rows(row + block_width));
        const Group room_error =
            where_less(x, y, columns(block + 2 * block_width), rows(row + 2 * block_width));
        Compensated<Group> out = raised(lower, room, axis);
        out.error = fused(lower, room_error, out.error);
        return out;
    }
};

template <class Kernel, class T>
STIPPLE_INLINE void multiply(Compensated<T>& product, const Compensated<T>& by) {
    if constexpr (Kernel::above_one) {
        const T next = fused(product.value, by.value, product.value);
        const T rounded = fused(product.value, by.value, product.value - next);
        product.error = fused(product.error, by.value, product.error + rounded);
        product.value = next;
    } else {
        const T next = product.value * by.value;
        const T rounded = fused(product.value, by.error, fused(product.value, by.value, -next));
        product.error = fused(product.error, by.value, rounded);
        product.value = next;
    }
}

STIPPLE_INLINE void add(Compensated<V>& total, const Compensated<V>& product) {
    const V next = total.value + product.value;
    const V part = next - total.value;
    total.error += ((total.value - (next - part)) + (product.value - part)) + product.error;
    total.value = next;
}

/// A group of rows, some of which may be padding, and a block.
struct GroupPair {
    const BlockTable& table;
    const BlockPair& pair;
    std::size_t first;  ///< index of the group in its block
};

template <class Kernel>
STIPPLE_INLINE Compensated<Group> factor_of(const GroupPair& g, std::size_t factor, std::size_t k) {
    const std::size_t column = factor * Kernel::columns_of_factor * block_width;
    return Kernel::factor(g.pair.rows + column + g.first, g.pair.columns + column + k,
                          g.table.factors()[factor]);
}

/// Start of products(): the columns' own products if Kernel::separates, else the first factor.
template <class Kernel>
STIPPLE_INLINE Compensated<Group> first_factor(const GroupPair& g, std::size_t k) {
    const PointProducts& own = g.pair.column_products;
    if constexpr (Kernel::separates) return {columns(own.value + k), columns(own.error + k)};
    const std::size_t factor = g.pair.factors.front();
    if constexpr (!Kernel::above_one) return factor_of<Kernel>(g, factor, k);
    const Group more = factor_of<Kernel>(g, factor, k).value;
    const Group one = all(same(1));
    const Group value = more + one;
    return {value, more - (value - one)};
}

/// Products of the factors of a group of rows with a vector of points, from the block's k-th on.
template <class Kernel>
STIPPLE_INLINE Compensated<Group> products(const GroupPair& g, std::size_t k) {
    Compensated<Group> p = first_factor<Kernel>(g, k);
    const auto rest = std::span(g.pair.factors).subspan(Kernel::separates ? 0 : 1);
    for (const std::size_t factor : rest) multiply<Kernel>(p, factor_of<Kernel>(g, factor, k));
    if (Kernel::separates || g.pair.full) return p;
    const std::size_t last = (g.table.height() - 1) * block_width;
    const Group there = columns(g.pair.columns + last + k) * rows(g.pair.rows + last + g.first);
    return {p.value * there, p.error * there};
}

/// Adds the products of a group of rows with a block to the sums from `lane` on. Each lane has the
/// same sum for vectors of any width. If Kernel::separates, each row is summed separately and
/// multiplied by its own product.
template <class Kernel>
STIPPLE_INLINE void add_lanes(const GroupPair& g, std::size_t lane, LaneSums& sums) {
    constexpr std::size_t apart = Kernel::separates ? group : 1;
    Compensated<V> totals[apart];
#pragma GCC unroll 4
    for (std::size_t r = 0; r < apart; ++r) totals[r] = {V{}, V{}};
    for (std::size_t k = lane; k < block_width; k += max_lanes) {
        const Compensated<Group> p = products<Kernel>(g, k);
#pragma GCC unroll 4
        for (std::size_t r = 0; r < group; ++r)
            add(totals[r % apart], {p.value.at[r], p.error.at[r]});
    }
    Compensated<V> total = {load(sums.sum + lane), load(sums.error + lane)};
    for (std::size_t r = 0; r < apart; ++r) {
        const PointProducts& own = g.pair.row_products;
        if constexpr (Kernel::separates)
            multiply<Minimum, V>(totals[r],
                                 {same(own.value[g.first + r]), same(own.error[g.first + r])});
        add(total, totals[r]);
    }
    std::memcpy(sums.sum + lane, &total.value, sizeof(V));
    std::memcpy(sums.error + lane, &total.error, sizeof(V));
}

/// Adds the products over all pairs of points of two blocks.
template <class Kernel>
void add_pairs(const BlockTable& table, const BlockPair& pair, LaneSums& sums) {
    for (std::size_t i = 0; i < block_width; i += group)
        for (std::size_t lane = 0; lane < max_lanes; lane += lanes)
            add_lanes<Kernel>({table, pair, i}, lane, sums);
}

/// Sets `products`, for each point of a block, to the product of the factors that depend on this
/// point alone, not on a pair; 0 for padding.
template <class Kernel>
void multiply_own(const BlockTable& table, const double* block,
                  const std::vector<std::size_t>& factors, PointProducts& products) {
    for (std::size_t k = 0; k < block_width; k += lanes) {
        Compensated<V> p = {load(block + (table.height() - 1) * block_width + k), V{}};
        if constexpr (Kernel::separates)
            for (const std::size_t factor : factors)
                multiply<Kernel>(
                    p, Kernel::own(block + factor * Kernel::columns_of_factor * block_width + k));
        std::memcpy(products.value + k, &p.value, sizeof(V));
        std::memcpy(products.error + k, &p.error, sizeof(V));
    }
}

template <class Kernel>
PairKernel kernel_of() {
    return {add_pairs<Kernel>, multiply_own<Kernel>, Kernel::columns_of_factor, Kernel::separates};
}

inline PairKernel kernel_for(PairForm form) {
    switch (form) {
        case PairForm::minimum:
            return kernel_of<Minimum>();
        case PairForm::two_sided:
            return kernel_of<TwoSided>();
        case PairForm::bernoulli:
            return kernel_of<Bernoulli>();
        case PairForm::linear:
            return kernel_of<Linear>();
        case PairForm::mixture:
            return kernel_of<Mixture>();
        default:
            return kernel_of<OnePlusMinima>();
    }
}
