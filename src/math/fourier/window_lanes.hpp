// SPDX-License-Identifier: MIT
//
// Kernels of window_spreading.hpp for vectors V. Not a standalone header:
// core/machine/vector_widths.hpp includes it in window_spreading.cpp, once for every
// STIPPLE_VECTOR_BITS.

constexpr std::size_t lanes = STIPPLE_VECTOR_BITS == 512 ? 8 : 4;
using V [[gnu::vector_size(8 * lanes)]] = double;
using Words [[gnu::vector_size(8 * lanes)]] = std::uint64_t;
using Integers [[gnu::vector_size(4 * lanes)]] = std::int32_t;

template <class Vector, class Number>
STIPPLE_INLINE Vector load(const Number* from) {
    Vector v;
    std::memcpy(&v, from, sizeof v);
    return v;
}

template <class Vector, class Number>
STIPPLE_INLINE void store(const Vector& v, Number* to) {
    std::memcpy(to, &v, sizeof v);
}

/// a b + c, rounded once: the same bits on any machine, and a single instruction if available.
STIPPLE_INLINE V fused(const V& a, double b, const V& c) {
#if STIPPLE_VECTOR_BITS == 512
    return _mm512_fmadd_pd(a, _mm512_set1_pd(b), c);
#elif STIPPLE_VECTOR_BITS == 256
    return _mm256_fmadd_pd(a, _mm256_set1_pd(b), c);
#else
    V sum;
    for (std::size_t l = 0; l < lanes; ++l) sum[l] = __builtin_fma(a[l], b, c[l]);
    return sum;
#endif
}

/// Rounds towards zero.
STIPPLE_INLINE V truncated(const V& v) {
#if STIPPLE_VECTOR_BITS == 512
    constexpr int towards_zero = _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC;
    return _mm512_mask_roundscale_pd(v, 0xff, v, towards_zero);
#elif STIPPLE_VECTOR_BITS == 256
    return _mm256_round_pd(v, _MM_FROUND_TO_ZERO | _MM_FROUND_NO_EXC);
#else
    return __builtin_convertvector(__builtin_convertvector(v, Integers), V);
#endif
}

/// Computes side * x for several coordinates x without rounding: the upper 26 bits of x give an
/// exact product. Sets `first` to the grid points at which the windows begin, and `between` to the
/// positions between two grid points, in [0, 1).
STIPPLE_INLINE void locate(const V& x, const SpreadTile& tile, V& first, V& between) {
    constexpr std::uint64_t high_bits = ~((std::uint64_t{1} << 27) - 1);
    const V high = (V)((Words)x & high_bits);
    const V product = high * tile.side;
    const V zero = {};
    const V cell = truncated(product);
    between = product - cell + tile.shift + (x - high) * tile.side;
    const V next = between >= 1 ? zero + 1 : zero;
    between -= next;
    first = cell + next - tile.lead;
    first += first < 0 ? zero + tile.side : zero;
    if (tile.lead == 0) first -= first >= tile.side ? zero + tile.side : zero;
}

/// Elements First, First + 2, ... of two vectors.
template <std::size_t First, std::size_t... L>
STIPPLE_INLINE V every_second(const V& a, const V& b, std::index_sequence<L...> /*lanes*/) {
    return __builtin_shufflevector(a, b, (First + 2 * L)...);
}

/// Coordinates of up to `chunk` points, by axis; padded with 0.
template <std::size_t Dimension>
using Coordinates = std::array<std::array<double, chunk>, Dimension>;

template <std::size_t Dimension>
STIPPLE_INLINE void by_axis(const double* points, std::size_t count, std::size_t numbers,
                            Coordinates<Dimension>& axes) {
    std::size_t i = 0;
    if constexpr (Dimension == 2)
        for (; numbers == 2 && i + lanes <= count; i += lanes) {
            const V a = load<V>(points + 2 * i);
            const V b = load<V>(points + 2 * i + lanes);
            store(every_second<0>(a, b, std::make_index_sequence<lanes>()), &axes[0][i]);
            store(every_second<1>(a, b, std::make_index_sequence<lanes>()), &axes[1][i]);
        }
    for (; i < (count + lanes - 1) / lanes * lanes; ++i)
        for (std::size_t k = 0; k < Dimension; ++k)
            axes[k][i] = i < count ? points[i * numbers + k] : 0;
}

/// Number of zeros before a window's values, so that the values can be shifted along a row.
constexpr std::size_t margin = lanes;

/// Number of vectors for the values of a window of width 4 Fours - 3 to 4 Fours. Windows of these
/// widths need the same vectors, and differ in their number of rows.
constexpr std::size_t vectors_of(std::size_t fours) { return (4 * fours + lanes - 1) / lanes; }

template <std::size_t Dimension, std::size_t Fours>
struct Chunk {
    alignas(64) Coordinates<Dimension> axes;
    alignas(64) Coordinates<Dimension> t;  ///< position in a piece of the window's table
    alignas(64) std::array<std::array<std::int32_t, chunk>, Dimension> piece;
    alignas(64) std::array<std::int32_t, chunk> corner;  ///< first cell in the buffer
    /// Window values for each point and axis, after `margin` zeros.
    alignas(64) double values[chunk][Dimension][margin + vectors_of(Fours) * lanes];

    Chunk() {
        for (auto& point : values)
            for (auto& along : point) std::fill_n(along, margin, 0.0);
    }
};

/// Mask of the lower 52 bits: the position between two grid points in a word of find_places(), or
/// the mantissa of a double.
constexpr std::uint64_t fraction = (std::uint64_t{1} << 52) - 1;
STIPPLE_INLINE Words word_of(const V& cell, const V& between) {
    const V zero = {};
    const V below = between < 1 - 0x1p-52 ? between : zero + (1 - 0x1p-52);  // 1 + below < 2
    return (Words)(cell + 0x1p52) << 52 | ((Words)(below + 1) & fraction);
}
STIPPLE_INLINE V cell_of(const Words& word) {
    const V zero = {};
    return (V)(word >> 52 | (Words)(zero + 0x1p52)) - 0x1p52;
}

template <std::size_t Dimension, std::size_t Fours>
STIPPLE_INLINE void locate_all(std::size_t count, const SpreadTile& tile,
                               Chunk<Dimension, Fours>& work) {
    const V zero = {};
    const unsigned bits = tile.piece_bits;
    for (std::size_t i = 0; i < count; i += lanes) {
        V corner = {};
        const auto extent = static_cast<double>(tile.extent);
        const double steps[] = {1, extent, extent * extent};
        for (std::size_t k = 0; k < Dimension; ++k) {
            const Words word = load<Words>(&work.axes[k][i]);
            corner += cell_of(word) * steps[k];
            const Words piece = (word & fraction) >> (52 - bits);
            store(__builtin_convertvector(piece, Integers), &work.piece[k][i]);
            const Words rest = (word << bits & fraction) | (Words)(zero + 2);
            store((V)rest - 3, &work.t[k][i]);
        }
        store(__builtin_convertvector(corner, Integers), &work.corner[i]);
    }
}

/// Evaluates the window at its grid points along each axis, by Horner's rule.
template <std::size_t Dimension, std::size_t Fours>
STIPPLE_INLINE void evaluate_all(const SpreadTile& tile, std::size_t count,
                                 Chunk<Dimension, Fours>& work) {
    constexpr std::size_t degree = WeightTable::degree_of(4 * Fours);
    constexpr std::size_t row = WeightTable::row_of(4 * Fours);
    constexpr std::size_t size = (degree + 1) * row;
    constexpr std::size_t vectors = vectors_of(Fours);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < Dimension; ++k) {
            const double* rows =
                tile.coefficients + static_cast<std::size_t>(work.piece[k][i]) * size;
            double* values = work.values[i][k] + margin;
            const double t = work.t[k][i];
            V sums[vectors];
            for (std::size_t v = 0; v < vectors; ++v) sums[v] = load<V>(rows + v * lanes);
            for (std::size_t term = 1; term <= degree; ++term)
                for (std::size_t v = 0; v < vectors; ++v)
                    sums[v] = fused(sums[v], t, load<V>(rows + term * row + v * lanes));
            for (std::size_t v = 0; v < vectors; ++v) store(sums[v], values + v * lanes);
        }
}

template <std::size_t Count>
STIPPLE_INLINE void add_row(double* row, double weight, const V (&values)[Count]) {
    for (std::size_t v = 0; v < Count; ++v) {
        double* cells = row + v * lanes;
        store(fused(values[v], weight, load<V>(cells)), cells);
    }
}

/// Adds weights[i] * factor * along to each row i of the buffer.
template <std::size_t Count>
STIPPLE_INLINE void add_rows(double* row, std::size_t extent, const double* weights,
                             std::size_t rows, double factor, const V (&along)[Count]) {
#pragma GCC unroll 4
    for (std::size_t i = 0; i < rows; ++i) add_row(row + i * extent, weights[i] * factor, along);
}

/// Adds a window to the buffer. If the window leaves enough elements of its vectors unused, its
/// rows are shifted to a vector boundary, so that no vector spans two cache lines.
template <std::size_t Dimension, std::size_t Fours>
STIPPLE_INLINE void add_window(
    const double (&values)[Dimension][margin + vectors_of(Fours) * lanes], const SpreadTile& tile,
    double* begin) {
    constexpr std::size_t vectors = vectors_of(Fours);
    const std::size_t extent = tile.extent;  // a copy, as stores might alias the tile's
    const std::size_t width = tile.width;
    const std::size_t behind = reinterpret_cast<std::uintptr_t>(begin) / sizeof(double) % lanes;
    const std::size_t back = std::min(behind, vectors * lanes - width);
    begin -= back;
    V along[vectors];
    for (std::size_t v = 0; v < vectors; ++v)
        along[v] = load<V>(values[0] + margin - back + v * lanes);
    if constexpr (Dimension == 1) add_row(begin, 1, along);
    if constexpr (Dimension == 2) add_rows(begin, extent, values[1] + margin, width, 1, along);
    if constexpr (Dimension == 3)
        for (std::size_t l = 0; l < width; ++l)
            add_rows(begin + l * extent * extent, extent, values[1] + margin, width,
                     values[2][margin + l], along);
}

template <std::size_t Dimension, std::size_t Fours>
void add_all(std::span<const double> rows, const SpreadTile& tile, double* buffer) {
    // Allocated at its first use in a thread: as a thread-local object it would take memory in
    // every thread of the program, and time when a thread starts. Its margins stay 0.
    thread_local const auto allocated = std::make_unique<Chunk<Dimension, Fours>>();
    Chunk<Dimension, Fours>& work = *allocated;
    const std::size_t numbers = tile.numbers;
    const std::size_t all = rows.size() / numbers;
    for (std::size_t first = 0; first < all; first += chunk) {
        const double* points = rows.data() + first * numbers;
        const std::size_t count = std::min(chunk, all - first);
        by_axis<Dimension>(points, count, numbers, work.axes);
        locate_all(count, tile, work);
        evaluate_all(tile, count, work);
        if (numbers > Dimension)
            for (std::size_t i = 0; i < count; ++i)
                for (std::size_t j = 0; j < tile.width; ++j)
                    work.values[i][Dimension - 1][margin + j] *= points[i * numbers + Dimension];
        for (std::size_t i = 0; i < count; ++i)
            add_window<Dimension, Fours>(work.values[i], tile,
                                         buffer + static_cast<std::uint32_t>(work.corner[i]));
    }
}

template <std::size_t Dimension, std::size_t Fours = KaiserBessel::max_width / 4>
void add_wide(std::span<const double> rows, const SpreadTile& tile, double* buffer) {
    if constexpr (Fours > 1)
        if (tile.width <= 4 * (Fours - 1))
            return add_wide<Dimension, Fours - 1>(rows, tile, buffer);
    add_all<Dimension, Fours>(rows, tile, buffer);
}

void add_points(std::span<const double> rows, std::size_t dimension, const SpreadTile& tile,
                double* buffer) {
    if (dimension == 1) return add_wide<1>(rows, tile, buffer);
    if (dimension == 2) return add_wide<2>(rows, tile, buffer);
    add_wide<3>(rows, tile, buffer);
}

/// Writes coordinates point by point, each followed by its strength, if any.
template <std::size_t Dimension>
STIPPLE_INLINE void by_point(const Coordinates<Dimension>& axes, const double* points,
                             std::size_t count, std::size_t numbers, double* out) {
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t k = 0; k < Dimension; ++k) out[i * numbers + k] = axes[k][i];
        if (numbers > Dimension) out[i * numbers + Dimension] = points[i * numbers + Dimension];
    }
}

template <std::size_t Dimension>
void find_all(std::span<const double> rows, const SpreadTile& common, std::uint32_t* tile_of,
              double* places) {
    alignas(64) Coordinates<Dimension> axes;
    const std::size_t numbers = common.numbers;
    const std::size_t all = rows.size() / numbers;
    const double tiles_a_cell = common.tiles / common.side;
    const double past_tile = (common.tiles - 0.5) / common.side;
    const double cells_a_tile = common.side / common.tiles;
    const double past_cell = 0.5 / common.tiles;
    for (std::size_t at = 0; at < all; at += chunk) {
        const double* points = rows.data() + at * numbers;
        const std::size_t count = std::min(chunk, all - at);
        by_axis<Dimension>(points, count, numbers, axes);
        for (std::size_t i = 0; i < count; i += lanes) {
            V sum = {};
            double step_k = 1;
            for (std::size_t k = 0; k < Dimension; ++k, step_k *= common.tiles) {
                V first;
                V between;
                locate(load<V>(&axes[k][i]), common, first, between);
                // The last tile t with t side / tiles < first + 1, and the first grid point of that
                // tile. Truncation is safe, because the truncated values are far from integers.
                const V tile = truncated(first * tiles_a_cell + past_tile);
                const V start = truncated(tile * cells_a_tile + past_cell);
                sum += step_k * tile;
                store(word_of(first - start, between), &axes[k][i]);
            }
            const Integers found = __builtin_convertvector(sum, Integers);
            if (i + lanes <= count)
                store(found, tile_of + at + i);
            else
                for (std::size_t l = 0; i + l < count; ++l)
                    tile_of[at + i + l] = static_cast<std::uint32_t>(found[l]);
        }
        by_point<Dimension>(axes, points, count, numbers, places + at * numbers);
    }
}

void find(std::span<const double> rows, std::size_t dimension, const SpreadTile& common,
          std::uint32_t* tile_of, double* places) {
    if (dimension == 1) return find_all<1>(rows, common, tile_of, places);
    if (dimension == 2) return find_all<2>(rows, common, tile_of, places);
    find_all<3>(rows, common, tile_of, places);
}
