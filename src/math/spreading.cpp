// SPDX-License-Identifier: MIT
#include "math/spreading.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "core/wide.hpp"

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

/// What is the same for all points of a tile.
struct Tile {
    double side;
    double shift;                         ///< 1/2 for odd windows, which centre on a grid point
    double lead;                          ///< grid points of the window before the point's cell
    std::size_t width;                    ///< of the window
    const double* coefficients;           ///< of its polynomials
    std::size_t numbers;                  ///< of a point: coordinates, and its strength
    std::size_t extent;                   ///< cells of a row of the buffer
    std::array<std::int64_t, 3> start{};  ///< its first cell, by coordinate
    std::array<std::size_t, 3> reach = {1, 1, 1};  ///< cells that its points touch
};

/// Finds side * x of four numbers without rounding it: the upper 26 bits of x make an exact
/// product. Gives the grid points at which their windows begin, and the places behind a grid point,
/// in [0, 1).
inline __attribute__((always_inline)) void locate(const Vector& x, const Tile& tile, Vector& first,
                                                  Vector& between) {
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
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < Dimension; ++k) axes[k][i] = points[i * numbers + k];
    for (std::size_t i = count; i < (count + 3) / 4 * 4; ++i)
        for (std::size_t k = 0; k < Dimension; ++k) axes[k][i] = 0;
}

template <std::size_t Dimension, std::size_t Padded>
struct Chunk {
    alignas(32) Coordinates<Dimension> axes;
    alignas(32) Coordinates<Dimension> t;  ///< place in the table's piece
    alignas(32) std::array<std::array<std::int32_t, chunk>, Dimension> piece;
    alignas(32) std::array<std::int32_t, chunk> corner;   ///< of the window in the buffer
    alignas(32) double values[chunk][Dimension][Padded];  ///< of the window along each axis
};

template <std::size_t Dimension, std::size_t Padded>
inline __attribute__((always_inline)) void locate_all(std::size_t count, const Tile& tile,
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
            const Vector scaled = between * static_cast<double>(WindowTable::pieces);
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
            auto* values = reinterpret_cast<LooseVector*>(work.values[i][k]);
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

template <std::size_t Width, std::size_t Padded>
inline __attribute__((always_inline)) void add_rows(double* row, std::size_t extent,
                                                    const double* weights, double factor,
                                                    const std::array<Vector, Padded / 4>& along) {
#pragma GCC unroll 16
    for (std::size_t j = 0; j < Width; ++j, row += extent) {
        // Else the compiler would hold sixteen addresses at once, and most of them in memory.
        asm volatile("" : "+r"(row));
        add_row<Padded>(row, weights[j] * factor, along);
    }
}

template <std::size_t Dimension, std::size_t Width, std::size_t Padded>
inline __attribute__((always_inline)) void add_window(const double (&values)[Dimension][Padded],
                                                      std::size_t extent, double* corner) {
    std::array<Vector, Padded / 4> along;
    for (std::size_t v = 0; v < Padded / 4; ++v)
        along[v] = reinterpret_cast<const LooseVector*>(values[0])[v];
    if constexpr (Dimension == 1) add_row<Padded>(corner, 1, along);
    if constexpr (Dimension == 2) add_rows<Width, Padded>(corner, extent, values[1], 1, along);
    if constexpr (Dimension == 3)
        for (std::size_t l = 0; l < Width; ++l)
            add_rows<Width, Padded>(corner + l * extent * extent, extent, values[1], values[2][l],
                                    along);
}

template <std::size_t Dimension, std::size_t Width>
inline __attribute__((always_inline)) void add_all(std::span<const double> rows, const Tile& tile,
                                                   double* buffer) {
    constexpr std::size_t padded = (Width + 3) / 4 * 4;
    Chunk<Dimension, padded> work;
    const std::size_t step = chunk * tile.numbers;
    for (std::size_t at = 0; at < rows.size(); at += step) {
        const double* points = rows.data() + at;
        const std::size_t count = std::min(step, rows.size() - at) / tile.numbers;
        by_axis<Dimension>(points, count, tile.numbers, work.axes);
        locate_all(count, tile, work);
        evaluate_all(tile.coefficients, count, work);
        if (tile.numbers > Dimension)
            for (std::size_t i = 0; i < count; ++i)
                for (double& value : work.values[i][Dimension - 1])
                    value *= points[i * tile.numbers + Dimension];
        for (std::size_t i = 0; i < count; ++i)
            add_window<Dimension, Width>(work.values[i], tile.extent, buffer + work.corner[i]);
    }
}

/// Even widths only: the last row of an odd one is 0.
template <std::size_t Dimension, std::size_t Width = KaiserBessel::max_width>
inline __attribute__((always_inline)) void add_wide(std::span<const double> rows, const Tile& tile,
                                                    double* buffer) {
    if constexpr (Width > KaiserBessel::min_width)
        if (tile.width + 2 <= Width) return add_wide<Dimension, Width - 2>(rows, tile, buffer);
    add_all<Dimension, Width>(rows, tile, buffer);
}

inline __attribute__((always_inline)) void add_points(std::span<const double> rows,
                                                      std::size_t dimension, const Tile& tile,
                                                      double* buffer) {
    if (dimension == 1) return add_wide<1>(rows, tile, buffer);
    if (dimension == 2) return add_wide<2>(rows, tile, buffer);
    return add_wide<3>(rows, tile, buffer);
}

using AddPoints = void (*)(std::span<const double>, std::size_t, const Tile&, double*);

void add_points_plain(std::span<const double> rows, std::size_t dimension, const Tile& tile,
                      double* buffer) {
    add_points(rows, dimension, tile, buffer);
}

#if defined(__x86_64__)
/// The same operations in the same order, four at a time; so the result has the same bits.
__attribute__((target("avx2,fma"))) void add_points_avx2(std::span<const double> rows,
                                                         std::size_t dimension, const Tile& tile,
                                                         double* buffer) {
    add_points(rows, dimension, tile, buffer);
}

AddPoints widest() {
    const bool wide = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    return wide ? add_points_avx2 : add_points_plain;
}
#else
AddPoints widest() { return add_points_plain; }
#endif

/// Replaces coordinates along one axis by the grid points at which their windows begin.
STIPPLE_WIDE void first_cells(std::array<double, chunk>& axis, std::size_t count,
                              const Tile& tile) {
    for (std::size_t i = 0; i < count; i += 4) {
        auto& x = *reinterpret_cast<LooseVector*>(&axis[i]);
        Vector first;
        Vector between;
        locate(x, tile, first, between);
        x = first;
    }
}

}  // namespace

/// The grid cut into an even number of tiles along each axis.
class Tiling {
  public:
    Tiling(const CellGrid& grid, const WindowTable& window, bool weighted) : grid_(grid) {
        constexpr std::array<std::size_t, 4> target = {0, 1024, 32, 16};
        const std::size_t smallest = std::max(target[grid.dimension], window.padded_width());
        pairs_ = std::max<std::size_t>(1, grid.side / (2 * smallest));
        along_ = 2 * pairs_;
        for (std::size_t t = 0; t <= along_; ++t) starts_.push_back(t * grid.side / along_);
        tile_of_.resize(grid.side);
        for (std::size_t t = 0; t < along_; ++t) {
            std::fill(tile_of_.begin() + static_cast<std::ptrdiff_t>(starts_[t]),
                      tile_of_.begin() + static_cast<std::ptrdiff_t>(starts_[t + 1]),
                      static_cast<std::uint32_t>(t));
            widest_ = std::max(widest_, starts_[t + 1] - starts_[t]);
        }
        common_ = {.side = static_cast<double>(grid.side),
                   .shift = window.width() % 2 == 1 ? 0.5 : 0.0,
                   .lead = static_cast<double>((window.width() - 1) / 2),
                   .width = window.width(),
                   .coefficients = window.coefficients().data(),
                   .numbers = grid.dimension + (weighted ? 1 : 0),
                   .extent = widest_ + window.padded_width()};
    }

    [[nodiscard]] std::size_t count() const { return power(along_); }
    [[nodiscard]] std::size_t colours() const { return power(2); }
    [[nodiscard]] std::size_t count_of_colour() const { return power(pairs_); }
    [[nodiscard]] std::size_t buffer_size() const { return power(common_.extent); }

    /// Tiles of some points, up to `chunk`.
    template <std::size_t Dimension>
    void tiles_of(const double* points, std::size_t count, std::uint32_t* tiles) const {
        alignas(32) Coordinates<Dimension> axes;
        by_axis<Dimension>(points, count, common_.numbers, axes);
        for (std::size_t k = 0; k < Dimension; ++k) first_cells(axes[k], count, common_);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint32_t tile = 0;
            for (std::size_t k = Dimension; k-- > 0;)
                tile = tile * static_cast<std::uint32_t>(along_) +
                       tile_of_[static_cast<std::size_t>(axes[k][i])];
            tiles[i] = tile;
        }
    }

    /// Number of the i-th tile of a colour; bit k of the colour is the parity along axis k.
    [[nodiscard]] std::size_t tile(std::size_t colour, std::size_t i) const {
        std::size_t tile = 0;
        std::size_t step = 1;
        for (std::size_t k = 0; k < grid_.dimension; ++k, step *= along_, i /= pairs_)
            tile += (2 * (i % pairs_) + (colour >> k & 1)) * step;
        return tile;
    }

    [[nodiscard]] Tile describe(std::size_t tile) const {
        Tile description = common_;
        for (std::size_t k = 0; k < grid_.dimension; ++k, tile /= along_) {
            const std::size_t start = starts_[tile % along_];
            description.start[k] = static_cast<std::int64_t>(start);
            description.reach[k] = starts_[tile % along_ + 1] - start + common_.width - 1;
        }
        return description;
    }

    /// Adds a tile's buffer to the grid, around its ends; no cell beyond the tile's reach, for
    /// another thread may be at the next tile of the colour.
    STIPPLE_WIDE void add_back(const Tile& tile, const double* buffer) const {
        const std::size_t x = wrapped(tile.start[0], 0);
        const std::size_t before_end = std::min(tile.reach[0], grid_.side - x);
        for (std::size_t z = 0; z < tile.reach[2]; ++z)
            for (std::size_t y = 0; y < tile.reach[1]; ++y) {
                const std::size_t line =
                    wrapped(tile.start[2], z) * grid_.side + wrapped(tile.start[1], y);
                double* row = grid_.cells + line * grid_.stride;
                const double* from = buffer + (z * tile.extent + y) * tile.extent;
                for (std::size_t i = 0; i < before_end; ++i) row[x + i] += from[i];
                for (std::size_t i = before_end; i < tile.reach[0]; ++i)
                    row[i - before_end] += from[i];
            }
    }

  private:
    [[nodiscard]] std::size_t power(std::size_t base) const {
        std::size_t value = 1;
        for (std::size_t k = 0; k < grid_.dimension; ++k) value *= base;
        return value;
    }
    [[nodiscard]] std::size_t wrapped(std::int64_t start, std::size_t offset) const {
        const std::size_t i = static_cast<std::size_t>(start) + offset;
        return i < grid_.side ? i : i - grid_.side;
    }

    CellGrid grid_;
    std::size_t pairs_ = 1;
    std::size_t along_ = 2;
    std::size_t widest_ = 0;
    std::vector<std::size_t> starts_;
    std::vector<std::uint32_t> tile_of_;
    Tile common_{};
};

namespace {

/// Turns the counts of each tile in each block, [block][tile], into the places where its points go.
/// Finds where each tile's numbers begin, and the end.
void counts_to_places(std::vector<std::uint32_t>& counts, std::size_t tiles, std::size_t numbers,
                      std::vector<std::size_t>& begins) {
    begins.clear();
    std::uint32_t total = 0;
    for (std::size_t t = 0; t < tiles; ++t) {
        begins.push_back(total * numbers);
        for (std::size_t i = t; i < counts.size(); i += tiles)
            total += std::exchange(counts[i], total);
    }
    begins.push_back(total * numbers);
}

/// Blocks of points no smaller than the number of tiles, lest the counters outgrow the points.
std::size_t sorting_block(std::size_t tiles) {
    return std::max<std::size_t>(std::size_t{1} << 17, tiles);
}

/// Rows of Numbers numbers to the places of their tiles.
template <std::size_t Numbers>
void scatter(const double* rows, const Block& block, const std::uint32_t* tile_of,
             std::uint32_t* places, double* sorted) {
    for (std::size_t i = block.first; i < block.last; ++i)
        std::copy_n(rows + i * Numbers, Numbers, sorted + places[tile_of[i]]++ * Numbers);
}

}  // namespace

std::size_t spreading_batch(const CellGrid& grid) {
    constexpr std::size_t most = std::size_t{1} << 30;  // counters of 32 bits are enough for it
    std::size_t cells = 1;
    for (std::size_t k = 0; k < grid.dimension; ++k) cells = std::min(most, cells * grid.side);
    // Fewer points than cells would pass over the grid too often.
    return std::clamp(cells, std::size_t{1} << 20, std::size_t{1} << 22);
}

Spreader::Spreader(const KaiserBessel& window, const CellGrid& grid, bool weighted)
    : table_(window),
      tiling_(std::make_unique<Tiling>(grid, table_, weighted)),
      dimension_(grid.dimension),
      width_(grid.dimension + (weighted ? 1 : 0)),
      batch_(spreading_batch(grid) * width_) {
    assert(grid.side % 2 == 0 && grid.side >= CellGrid::smallest_side && grid.side < 1U << 24);
}

Spreader::~Spreader() = default;

double Spreader::bytes(double count, const CellGrid& grid, bool weighted) {
    const double points = std::min(count, static_cast<double>(spreading_batch(grid)));
    return points * static_cast<double>(16 * (grid.dimension + (weighted ? 1 : 0)) + 8);
}

void Spreader::add(std::span<const double> rows, const RunContext& run) {
    while (!rows.empty()) {
        const std::size_t some = std::min(rows.size(), batch_ - waits_);
        if (some == batch_) {
            spread(rows.first(some), run);
        } else {
            if (waiting_.numbers().empty()) waiting_ = Rows::unwritten(batch_);
            std::ranges::copy(rows.first(some),
                              waiting_.numbers().begin() + static_cast<std::ptrdiff_t>(waits_));
            waits_ += some;
            if (waits_ == batch_) finish(run);
        }
        rows = rows.subspan(some);
    }
}

void Spreader::finish(const RunContext& run) {
    if (waits_ > 0) spread(std::as_const(waiting_).numbers().first(waits_), run);
    waits_ = 0;
}

void Spreader::spread(std::span<const double> rows, const RunContext& run) {
    sort(rows, run);
    for (std::size_t colour = 0; colour < tiling_->colours(); ++colour)
        spread_colour(colour, rows.size() / width_, run);
}

/// Brings the points into the order of their tiles; within a tile they keep their own.
void Spreader::sort(std::span<const double> rows, const RunContext& run) {
    const std::size_t count = rows.size() / width_;
    const std::size_t tiles = tiling_->count();
    const std::size_t block = sorting_block(tiles);
    if (room_ < rows.size()) sorted_ = Rows::unwritten(room_ = rows.size());
    tile_of_.resize(count);
    next_.assign(block_count(count, block) * tiles, 0);
    const auto tiles_of = dimension_ == 1   ? &Tiling::tiles_of<1>
                          : dimension_ == 2 ? &Tiling::tiles_of<2>
                                            : &Tiling::tiles_of<3>;
    for_each_block(
        run, count, block,
        [&](const Block& b) {
            std::uint32_t* counters = next_.data() + b.index * tiles;
            for (std::size_t i = b.first; i < b.last; i += chunk) {
                const std::size_t some = std::min<std::size_t>(chunk, b.last - i);
                (tiling_.get()->*tiles_of)(&rows[i * width_], some, &tile_of_[i]);
                for (std::size_t j = i; j < i + some; ++j) ++counters[tile_of_[j]];
            }
        },
        true);
    counts_to_places(next_, tiles, width_, begins_);
    constexpr std::array scatters = {scatter<1>, scatter<2>, scatter<3>, scatter<4>};
    for_each_block(
        run, count, block,
        [&](const Block& b) {
            scatters[width_ - 1](rows.data(), b, tile_of_.data(), next_.data() + b.index * tiles,
                                 sorted_.numbers().data());
        },
        true);
}

/// Spreads the sorted points of the tiles of one colour.
void Spreader::spread_colour(std::size_t colour, std::size_t points, const RunContext& run) {
    static const AddPoints spread_points = widest();
    const std::size_t tiles = tiling_->count_of_colour();
    // Enough blocks for all threads, but none with less work than handing it over is.
    const std::size_t block = std::max(1 + tiles / 128, 1024 * tiling_->count() / (points + 1));
    // A buffer takes so many points: rounding errors of long sums stay small, and a stop is heeded
    // where all points are in one tile.
    const std::size_t portion = 512 * width_;
    const double* sorted = sorted_.numbers().data();
    for_each_block(
        run, tiles, block,
        [&](const Block& b) {
            std::vector<double> buffer;
            for (std::size_t i = b.first; i < b.last; ++i) {
                const std::size_t number = tiling_->tile(colour, i);
                const std::size_t begin = begins_[number];
                const std::size_t end = begins_[number + 1];
                if (begin == end) continue;
                const Tile tile = tiling_->describe(number);
                for (std::size_t at = begin; at < end; at += portion) {
                    run.check_stop();
                    buffer.assign(tiling_->buffer_size(), 0.0);
                    const std::span some(sorted + at, std::min(portion, end - at));
                    spread_points(some, dimension_, tile, buffer.data());
                    tiling_->add_back(tile, buffer.data());
                }
            }
        },
        true);
}

}  // namespace stipple
