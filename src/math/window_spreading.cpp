// SPDX-License-Identifier: MIT
#include "math/window_spreading.hpp"

#include <algorithm>

namespace stipple {
namespace {

using Vector = double __attribute__((vector_size(32)));
using LooseVector = double __attribute__((vector_size(32), aligned(8), may_alias));
using Integers = std::int32_t __attribute__((vector_size(16)));
using LooseIntegers = std::int32_t __attribute__((vector_size(16), aligned(4), may_alias));

/// a b + c, rounded once: the same bits on any machine, and one step where it is an instruction.
inline __attribute__((always_inline)) void multiply_add(const Vector& a, double b, Vector& c) {
    for (std::size_t lane = 0; lane < 4; ++lane) c[lane] = __builtin_fma(a[lane], b, c[lane]);
}

/// Finds side * x of four numbers without rounding it: the upper 26 bits of x make an exact
/// product. Gives the grid points at which their windows begin, and the places behind a grid point,
/// in [0, 1).
inline __attribute__((always_inline)) void locate(const Vector& x, const SpreadTile& tile,
                                                  Vector& first, Vector& between) {
    using Bits = std::uint64_t __attribute__((vector_size(32)));
    constexpr std::uint64_t high_bits = ~((std::uint64_t{1} << 27) - 1);
    const Vector high = reinterpret_cast<Vector>(reinterpret_cast<Bits>(x) & high_bits);
    const Vector product = high * tile.side;
    const Vector zero = {};
    const Vector cell = __builtin_convertvector(__builtin_convertvector(product, Integers), Vector);
    between = product - cell + tile.shift + (x - high) * tile.side;
    const Vector next = between >= 1 ? zero + 1 : zero;
    between -= next;
    first = cell + next - tile.lead;
    first += first < 0 ? zero + tile.side : zero;
    first -= first >= tile.side ? zero + tile.side : zero;
}

/// Points that go through the steps together: each step is short enough for the processor to work
/// on several points at once, which it could not from one end to the other.
constexpr std::size_t chunk = 16;

/// Coordinates of up to so many points, axis after axis; the surplus is 0.
template <std::size_t Dimension>
using Coordinates = std::array<std::array<double, chunk>, Dimension>;

template <std::size_t Dimension>
inline __attribute__((always_inline)) void by_axis(const double* points, std::size_t count,
                                                   std::size_t numbers,
                                                   Coordinates<Dimension>& axes) {
    std::size_t i = 0;
    if constexpr (Dimension == 2)
        for (; numbers == 2 && i + 4 <= count; i += 4) {
            using Order = std::int64_t __attribute__((vector_size(32)));
            const Vector a = *reinterpret_cast<const LooseVector*>(points + 2 * i);
            const Vector b = *reinterpret_cast<const LooseVector*>(points + 2 * i + 4);
            *reinterpret_cast<LooseVector*>(&axes[0][i]) =
                __builtin_shuffle(a, b, Order{0, 2, 4, 6});
            *reinterpret_cast<LooseVector*>(&axes[1][i]) =
                __builtin_shuffle(a, b, Order{1, 3, 5, 7});
        }
    for (; i < (count + 3) / 4 * 4; ++i)
        for (std::size_t k = 0; k < Dimension; ++k)
            axes[k][i] = i < count ? points[i * numbers + k] : 0;
}

/// Numbers before a window's values: zeros, where the values are shifted along a row.
constexpr std::size_t margin = 4;

template <std::size_t Dimension, std::size_t Padded>
struct Chunk {
    alignas(32) Coordinates<Dimension> axes;
    alignas(32) Coordinates<Dimension> t;  ///< place in the table's piece
    alignas(32) std::array<std::array<std::int32_t, chunk>, Dimension> piece;
    alignas(32) std::array<std::int32_t, chunk> corner;            ///< of the window in the buffer
    alignas(32) double values[chunk][Dimension][margin + Padded];  ///< of the window, by axis
};

template <std::size_t Dimension, std::size_t Padded>
inline __attribute__((always_inline)) void locate_all(std::size_t count, const SpreadTile& tile,
                                                      Chunk<Dimension, Padded>& work) {
    for (std::size_t i = 0; i < count; i += 4) {
        Vector corner = {};
        double step = 1;
        for (std::size_t k = 0; k < Dimension; ++k) {
            const Vector x = *reinterpret_cast<const LooseVector*>(&work.axes[k][i]);
            Vector first;
            Vector between;
            locate(x, tile, first, between);
            corner += (first - static_cast<double>(tile.start[k])) * step;
            step *= static_cast<double>(tile.extent);
            const Vector scaled = between * tile.pieces;
            const Integers piece = __builtin_convertvector(scaled, Integers);
            *reinterpret_cast<LooseIntegers*>(&work.piece[k][i]) = piece;
            *reinterpret_cast<LooseVector*>(&work.t[k][i]) =
                2 * (scaled - __builtin_convertvector(piece, Vector)) - 1;
        }
        *reinterpret_cast<LooseIntegers*>(&work.corner[i]) =
            __builtin_convertvector(corner, Integers);
    }
}

/// Horner's rule for polynomials of the degree, beside each other; without a loop.
template <std::size_t Vectors, std::size_t Degree>
inline __attribute__((always_inline)) void raise(double t, const LooseVector* rows,
                                                 std::array<Vector, Vectors>& sums) {
    if constexpr (Degree > 1) raise<Vectors, Degree - 1>(t, rows, sums);
    for (std::size_t v = 0; v < Vectors; ++v) {
        Vector next = rows[Degree * Vectors + v];
        multiply_add(sums[v], t, next);
        sums[v] = next;
    }
}

/// The window's values at its grid points along each axis by Horner's rule.
template <std::size_t Dimension, std::size_t Padded>
inline __attribute__((always_inline)) void evaluate_all(const double* table, std::size_t count,
                                                        Chunk<Dimension, Padded>& work) {
    constexpr std::size_t vectors = Padded / 4;
    constexpr std::size_t size = (WindowTable::degree_of(Padded) + 1) * Padded;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < Dimension; ++k) {
            const auto* rows = reinterpret_cast<const LooseVector*>(
                table + static_cast<std::size_t>(work.piece[k][i]) * size);
            const double t = work.t[k][i];
            std::array<Vector, vectors> sums;
            for (std::size_t v = 0; v < vectors; ++v) sums[v] = rows[v];
            raise<vectors, WindowTable::degree_of(Padded)>(t, rows, sums);
            auto* values = reinterpret_cast<LooseVector*>(work.values[i][k] + margin);
            for (std::size_t v = 0; v < vectors; ++v) values[v] = sums[v];
        }
}

/// Adds weight * values to a row of the buffer.
template <std::size_t Padded>
inline __attribute__((always_inline)) void add_row(double* row, double weight,
                                                   const std::array<Vector, Padded / 4>& values) {
    auto* cells = reinterpret_cast<LooseVector*>(row);
    for (std::size_t v = 0; v < Padded / 4; ++v) {
        Vector sum = cells[v];
        multiply_add(values[v], weight, sum);
        cells[v] = sum;
    }
}

template <std::size_t Padded>
inline __attribute__((always_inline)) void add_rows(double* row, const SpreadTile& tile,
                                                    const double* weights, double factor,
                                                    const std::array<Vector, Padded / 4>& along) {
    for (std::size_t j = 0; j < tile.width; ++j, row += tile.extent)
        add_row<Padded>(row, weights[j] * factor, along);
}

/// Rows begin at a multiple of 4 cells, so that no vector lies in two cache lines, as far as the
/// window is narrower than its vectors.
template <std::size_t Dimension, std::size_t Padded, bool Wide>
inline __attribute__((always_inline)) void add_window(
    const double (&values)[Dimension][margin + Padded], const SpreadTile& tile, double* buffer,
    std::size_t corner) {
    const std::size_t back = std::min(corner % 4, Padded - tile.width);
    double* begin = buffer + (corner - back);
    std::array<Vector, Padded / 4> along;
    for (std::size_t v = 0; v < Padded / 4; ++v) {
        along[v] = reinterpret_cast<const LooseVector*>(values[0] + margin - back)[v];
        // Else the compiler would take some of them apart.
        if constexpr (Wide) asm("" : "+x"(along[v]));
    }
    if constexpr (Dimension == 1) add_row<Padded>(begin, 1, along);
    if constexpr (Dimension == 2) add_rows<Padded>(begin, tile, values[1] + margin, 1, along);
    if constexpr (Dimension == 3)
        for (std::size_t l = 0; l < tile.width; ++l)
            add_rows<Padded>(begin + l * tile.extent * tile.extent, tile, values[1] + margin,
                             values[2][margin + l], along);
}

template <std::size_t Dimension, std::size_t Padded, bool Wide>
inline __attribute__((always_inline)) void add_all(std::span<const double> rows,
                                                   const SpreadTile& tile, double* buffer) {
    Chunk<Dimension, Padded> work;
    for (auto& values : work.values) std::fill_n(values[0], margin, 0.0);
    const std::size_t step = chunk * tile.numbers;
    for (std::size_t at = 0; at < rows.size(); at += step) {
        const double* points = rows.data() + at;
        const std::size_t count = std::min(step, rows.size() - at) / tile.numbers;
        by_axis<Dimension>(points, count, tile.numbers, work.axes);
        locate_all(count, tile, work);
        evaluate_all(tile.coefficients, count, work);
        if (tile.numbers > Dimension)
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < Padded; ++j)
                    work.values[i][Dimension - 1][margin + j] *=
                        points[i * tile.numbers + Dimension];
        for (std::size_t i = 0; i < count; ++i)
            add_window<Dimension, Padded, Wide>(work.values[i], tile, buffer,
                                                static_cast<std::uint32_t>(work.corner[i]));
    }
}

template <std::size_t Dimension, bool Wide, std::size_t Padded = KaiserBessel::max_width>
inline __attribute__((always_inline)) void add_wide(std::span<const double> rows,
                                                    const SpreadTile& tile, double* buffer) {
    if constexpr (Padded > 4)
        if (tile.width + 4 <= Padded)
            return add_wide<Dimension, Wide, Padded - 4>(rows, tile, buffer);
    add_all<Dimension, Padded, Wide>(rows, tile, buffer);
}

template <bool Wide>
inline __attribute__((always_inline)) void add_points(std::span<const double> rows,
                                                      std::size_t dimension, const SpreadTile& tile,
                                                      double* buffer) {
    if (dimension == 1) return add_wide<1, Wide>(rows, tile, buffer);
    if (dimension == 2) return add_wide<2, Wide>(rows, tile, buffer);
    return add_wide<3, Wide>(rows, tile, buffer);
}

template <std::size_t Dimension>
inline __attribute__((always_inline)) void find_all(std::span<const double> rows,
                                                    const SpreadTile& common,
                                                    const std::uint32_t* tiles,
                                                    std::uint32_t* tile_of) {
    alignas(32) Coordinates<Dimension> axes;
    alignas(32) std::array<std::array<std::int32_t, chunk>, Dimension> cells;
    const std::size_t side = static_cast<std::size_t>(common.side);
    const std::size_t step = chunk * common.numbers;
    for (std::size_t at = 0; at < rows.size(); at += step, tile_of += chunk) {
        const std::size_t count = std::min(step, rows.size() - at) / common.numbers;
        by_axis<Dimension>(rows.data() + at, count, common.numbers, axes);
        for (std::size_t k = 0; k < Dimension; ++k)
            for (std::size_t i = 0; i < count; i += 4) {
                Vector first;
                Vector between;
                locate(*reinterpret_cast<const LooseVector*>(&axes[k][i]), common, first, between);
                *reinterpret_cast<LooseIntegers*>(&cells[k][i]) =
                    __builtin_convertvector(first, Integers);
            }
        for (std::size_t i = 0; i < count; ++i) {
            tile_of[i] = 0;
            for (std::size_t k = 0; k < Dimension; ++k)
                tile_of[i] += tiles[k * side + static_cast<std::uint32_t>(cells[k][i])];
        }
    }
}

inline __attribute__((always_inline)) void find(std::span<const double> rows, std::size_t dimension,
                                                const SpreadTile& common,
                                                const std::uint32_t* tiles,
                                                std::uint32_t* tile_of) {
    if (dimension == 1) return find_all<1>(rows, common, tiles, tile_of);
    if (dimension == 2) return find_all<2>(rows, common, tiles, tile_of);
    return find_all<3>(rows, common, tiles, tile_of);
}

void add_points_plain(std::span<const double> rows, std::size_t dimension, const SpreadTile& tile,
                      double* buffer) {
    add_points<false>(rows, dimension, tile, buffer);
}

void find_plain(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                const std::uint32_t* tiles, std::uint32_t* tile_of) {
    find(rows, dimension, common, tiles, tile_of);
}

#if defined(__x86_64__)
#define STIPPLE_AVX2 __attribute__((target("avx2,fma")))

/// The same operations in the same order, four at a time; so the result has the same bits.
STIPPLE_AVX2 void add_points_avx2(std::span<const double> rows, std::size_t dimension,
                                  const SpreadTile& tile, double* buffer) {
    add_points<true>(rows, dimension, tile, buffer);
}

STIPPLE_AVX2 void find_avx2(std::span<const double> rows, std::size_t dimension,
                            const SpreadTile& common, const std::uint32_t* tiles,
                            std::uint32_t* tile_of) {
    find(rows, dimension, common, tiles, tile_of);
}

bool is_wide() { return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"); }
#else
constexpr auto add_points_avx2 = add_points_plain;
constexpr auto find_avx2 = find_plain;

bool is_wide() { return false; }
#endif

}  // namespace

void spread_points(std::span<const double> rows, std::size_t dimension, const SpreadTile& tile,
                   double* buffer) {
    static const auto best = is_wide() ? add_points_avx2 : add_points_plain;
    best(rows, dimension, tile, buffer);
}

void find_tiles(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
                const std::uint32_t* tiles, std::uint32_t* tile_of) {
    static const auto best = is_wide() ? find_avx2 : find_plain;
    best(rows, dimension, common, tiles, tile_of);
}

}  // namespace stipple
