// SPDX-License-Identifier: MIT
//
// Factors of L2 kernels for as many pairs of points as a vector V holds, each a double and a
// correction. They are those of l2_carried.hpp, where parabolas stand on their vertices:
//
//     a + t (t - 1)             = (a - 1/4) + (t - 1/2)^2
//     h_x + h_y + t (t - 3/2)   = (h_x + h_y - 9/16) + (t - 3/4)^2
//
// so that with a coordinate as a multiple of 2^-53 and a rest, the square's root has no rounding.
//
// A point's numbers stand `spread` times each in `row`; those of a block's points follow each other
// in columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

// The vectors never leave a function that is not inlined.
#pragma GCC diagnostic ignored "-Wpsabi"

#define STIPPLE_INLINE [[gnu::always_inline]] inline

namespace stipple::analyzers::l2 {

constexpr std::size_t block_width = 64;  ///< points of a block
constexpr std::size_t spread = 8;        ///< lanes of the widest vector

template <std::size_t lanes>
struct VectorOf {
    using Doubles [[gnu::vector_size(8 * lanes)]] = double;
    using Integers [[gnu::vector_size(8 * lanes)]] = std::int64_t;
};
using Four = VectorOf<4>::Doubles;
using Eight = VectorOf<8>::Doubles;

template <class V>
constexpr std::size_t lanes_of = sizeof(V) / sizeof(double);
template <class V>
using BitsOf = typename VectorOf<lanes_of<V>>::Integers;

template <class V>
STIPPLE_INLINE V load(const double* from) {
    V v;
    std::memcpy(&v, from, sizeof v);
    return v;
}
template <class V>
STIPPLE_INLINE V least(V a, V b) {
    return a < b ? a : b;
}
template <class V>
STIPPLE_INLINE BitsOf<V> sign(V a) {
    return (BitsOf<V>)a & (std::int64_t{1} << 63);
}
template <class V>
STIPPLE_INLINE V flipped(V a, BitsOf<V> by) {
    return (V)((BitsOf<V>)a ^ by);
}

/// a b + c, rounded once.
template <class V>
STIPPLE_INLINE V fused(V a, V b, V c) {
    V r;
    for (std::size_t l = 0; l < lanes_of<V>; ++l) r[l] = __builtin_fma(a[l], b[l], c[l]);
    return r;
}

/// A number and its correction.
template <class V>
struct Carried {
    V value;
    V lost;
};

/// Doubles in one line of the cache, so that no vector lies across two.
struct alignas(64) Line {
    double at[spread] = {};
};

/// What is the same for all points on an axis: base = a + shift, where a factor may come near 0.
struct AxisConstants {
    Line base;
    Line shift;
    Line lost;  ///< of base
};

/// base + a b: the base is at least as large as |a b|.
template <class V>
STIPPLE_INLINE Carried<V> raised(V a, V b, V base) {
    const V high = fused(a, b, base);
    return {high, fused(a, b, base - high)};
}

/// The same, less the shift.
template <class V>
STIPPLE_INLINE Carried<V> raised(V a, V b, const AxisConstants& axis) {
    const auto [high, low] = raised(a, b, load<V>(axis.base.at));
    return {high - load<V>(axis.shift.at), low + load<V>(axis.lost.at)};
}

/// |x - y| of coordinates in column 0 and, if they are fine, their rests in column 1.
template <class V, bool fine>
STIPPLE_INLINE Carried<V> distance(const double* row, const double* block) {
    const V t = load<V>(row) - load<V>(block);
    if constexpr (fine) {
        const V rest = load<V>(row + spread) - load<V>(block + block_width);
        const BitsOf<V> negative = sign(t + rest);
        return {flipped(t, negative), flipped(rest, negative)};
    } else {
        return {flipped(t, sign(t)), V{}};
    }
}

/// One minimum, of numbers without corrections.
struct Least {
    static constexpr std::size_t columns = 1;
    static constexpr bool exact = true;
    template <class V>
    STIPPLE_INLINE static Carried<V> factor(const double* row, const double* block,
                                            const AxisConstants&) {
        return {least(load<V>(row), load<V>(block)), V{}};
    }
};

/// One minimum: of the numbers of the point that comes first in the order of column 0.
struct LeastCarried {
    static constexpr std::size_t columns = 3;
    static constexpr bool exact = false;
    template <class V>
    STIPPLE_INLINE static Carried<V> factor(const double* row, const double* block,
                                            const AxisConstants&) {
        const auto mine = load<V>(row) < load<V>(block);
        return {mine ? load<V>(row + spread) : load<V>(block + block_width),
                mine ? load<V>(row + 2 * spread) : load<V>(block + 2 * block_width)};
    }
};

/// A parabola of the distance; on plain axes neither shift nor base.lost is anything but 0.
template <bool fine, bool plain>
struct Bend {
    static constexpr std::size_t columns = fine ? 2 : 1;
    static constexpr bool exact = false;
    template <class V>
    STIPPLE_INLINE static Carried<V> factor(const double* row, const double* block,
                                            const AxisConstants& axis) {
        const auto [t, rest] = distance<V, fine>(row, block);
        const V u = t - 0.5;
        Carried<V> out;
        if constexpr (plain)
            out = raised(u, u, load<V>(axis.base.at));
        else
            out = raised(u, u, axis);
        if constexpr (fine) out.lost = fused(u + u, rest, out.lost);
        return out;
    }
};

template <bool fine>
struct Mixture {
    static constexpr std::size_t columns = fine ? 4 : 3;
    static constexpr bool exact = false;
    template <class V>
    STIPPLE_INLINE static Carried<V> factor(const double* row, const double* block,
                                            const AxisConstants&) {
        constexpr std::size_t h = columns - 2;
        const auto [t, rest] = distance<V, fine>(row, block);
        const V u = t - 0.75;
        const V base = load<V>(row + h * spread) + load<V>(block + h * block_width);  // exact
        Carried<V> out = raised(u, u, base);
        out.lost += load<V>(row + (h + 1) * spread) + load<V>(block + (h + 1) * block_width);
        if constexpr (fine) out.lost = fused(u + u, rest, out.lost);
        return out;
    }
};

struct Excess {
    static constexpr std::size_t columns = 3;
    static constexpr bool exact = false;
    template <class V>
    STIPPLE_INLINE static Carried<V> factor(const double* row, const double* block,
                                            const AxisConstants& axis) {
        const V x = load<V>(row);
        const V y = load<V>(block);
        const auto below = x < y;
        const V lower = below ? x : y;
        const V room = below ? load<V>(block + block_width) : load<V>(row + spread);
        const V lost = below ? load<V>(block + 2 * block_width) : load<V>(row + 2 * spread);
        Carried<V> out = raised(lower, room, axis);
        out.lost = fused(lower, lost, out.lost);
        return out;
    }
};

template <class Kernel, class V>
STIPPLE_INLINE void multiply(Carried<V>& product, const Carried<V>& by) {
    const V next = product.value * by.value;
    V rounded = fused(product.value, by.value, -next);
    if constexpr (!Kernel::exact) rounded = fused(product.value, by.lost, rounded);
    product.lost = fused(product.lost, by.value, rounded);
    product.value = next;
}

}  // namespace stipple::analyzers::l2
