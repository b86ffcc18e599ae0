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

namespace stipple {
namespace {

using Vector = double __attribute__((vector_size(32)));
using LooseVector = double __attribute__((vector_size(32), aligned(8), may_alias));

/// What is the same for all points of a tile.
struct Tile {
    double side;
    double shift;                         ///< 1/2 for odd windows, which centre on a grid point
    std::int64_t lead;                    ///< grid points of the window before the point's cell
    std::size_t width;                    ///< of the window
    std::size_t degree;                   ///< of its polynomials
    const double* coefficients;           ///< of its polynomials
    std::size_t extent;                   ///< cells of a row of the buffer
    std::array<std::int64_t, 3> start{};  ///< its first cell, by coordinate
    std::array<std::size_t, 3> reach = {1, 1, 1};  ///< cells that its points touch
};

struct Place {
    std::int64_t first;  ///< grid point at which the window begins
    double between;      ///< place behind a grid point, in [0, 1)
};

/// Finds side * x without rounding it: the upper 26 bits of x make an exact product.
inline __attribute__((always_inline)) Place locate(double x, const Tile& tile) {
    constexpr std::uint64_t low_bits = (std::uint64_t{1} << 27) - 1;
    const double high = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & ~low_bits);
    const double product = high * tile.side;
    auto cell = static_cast<std::int64_t>(product);
    double between = product - static_cast<double>(cell) + tile.shift + (x - high) * tile.side;
    const bool next = between >= 1;
    between -= next ? 1 : 0;
    cell += next ? 1 : 0;
    std::int64_t first = cell - tile.lead;
    const auto side = static_cast<std::int64_t>(tile.side);
    first += first < 0 ? side : 0;
    first -= first >= side ? side : 0;
    return {first, between};
}

/// The window's values at its grid points along each axis, Padded of them, by Horner's rule; for
/// all axes at once, since one alone would wait for each step's result.
template <std::size_t Dimension, std::size_t Padded>
inline __attribute__((always_inline)) void evaluate(
    const std::array<double, Dimension>& between, const Tile& tile,
    std::array<std::array<Vector, Padded / 4>, Dimension>& values) {
    constexpr std::size_t vectors = Padded / 4;
    const auto* rows = reinterpret_cast<const LooseVector*>(tile.coefficients);
    for (std::size_t k = 0; k < Dimension; ++k)
        for (std::size_t v = 0; v < vectors; ++v) values[k][v] = rows[v];
    for (std::size_t power = 1; power <= tile.degree; ++power) {
        rows += vectors;
        for (std::size_t v = 0; v < vectors; ++v)
            for (std::size_t k = 0; k < Dimension; ++k)
                values[k][v] = values[k][v] * (2 * between[k] - 1) + rows[v];
    }
}

/// Adds weight * values to a row of the buffer.
template <std::size_t Padded>
inline __attribute__((always_inline)) void add_row(double* row, double weight,
                                                   const Vector* values) {
    auto* cells = reinterpret_cast<LooseVector*>(row);
    for (std::size_t v = 0; v < Padded / 4; ++v) cells[v] += values[v] * weight;
}

template <std::size_t Dimension, std::size_t Padded>
inline __attribute__((always_inline)) void add_point(const double* point, const Tile& tile,
                                                     double* buffer) {
    alignas(32) std::array<std::array<Vector, Padded / 4>, Dimension> values;
    std::array<double, Dimension> between;
    double* corner = buffer;
    std::size_t step = 1;
    for (std::size_t k = 0; k < Dimension; ++k) {
        const Place place = locate(point[k], tile);
        corner += static_cast<std::size_t>(place.first - tile.start[k]) * step;
        step *= tile.extent;
        between[k] = place.between;
    }
    evaluate<Dimension, Padded>(between, tile, values);
    const auto value = [&](std::size_t k, std::size_t j) { return values[k][j / 4][j % 4]; };
    const Vector* along = values[0].data();
    if constexpr (Dimension == 1) add_row<Padded>(corner, 1, along);
    if constexpr (Dimension == 2)
        for (std::size_t j = 0; j < tile.width; ++j)
            add_row<Padded>(corner + j * tile.extent, value(1, j), along);
    if constexpr (Dimension == 3)
        for (std::size_t l = 0; l < tile.width; ++l)
            for (std::size_t j = 0; j < tile.width; ++j)
                add_row<Padded>(corner + (l * tile.extent + j) * tile.extent,
                                value(2, l) * value(1, j), along);
}

template <std::size_t Dimension, std::size_t Padded>
inline __attribute__((always_inline)) void add_all(std::span<const double> rows, const Tile& tile,
                                                   double* buffer) {
    for (std::size_t i = 0; i + Dimension <= rows.size(); i += Dimension)
        add_point<Dimension, Padded>(rows.data() + i, tile, buffer);
}

template <std::size_t Dimension>
inline __attribute__((always_inline)) void add_padded(std::span<const double> rows,
                                                      const Tile& tile, double* buffer) {
    switch ((tile.width + 3) / 4) {
        case 1:
            return add_all<Dimension, 4>(rows, tile, buffer);
        case 2:
            return add_all<Dimension, 8>(rows, tile, buffer);
        case 3:
            return add_all<Dimension, 12>(rows, tile, buffer);
        default:
            return add_all<Dimension, 16>(rows, tile, buffer);
    }
}

inline __attribute__((always_inline)) void add_points(std::span<const double> rows,
                                                      std::size_t dimension, const Tile& tile,
                                                      double* buffer) {
    if (dimension == 1) return add_padded<1>(rows, tile, buffer);
    if (dimension == 2) return add_padded<2>(rows, tile, buffer);
    return add_padded<3>(rows, tile, buffer);
}

using AddPoints = void (*)(std::span<const double>, std::size_t, const Tile&, double*);

void add_points_plain(std::span<const double> rows, std::size_t dimension, const Tile& tile,
                      double* buffer) {
    add_points(rows, dimension, tile, buffer);
}

#if defined(__x86_64__)
/// The same operations in the same order, four at a time; so the result has the same bits.
__attribute__((target("avx2"))) void add_points_avx2(std::span<const double> rows,
                                                     std::size_t dimension, const Tile& tile,
                                                     double* buffer) {
    add_points(rows, dimension, tile, buffer);
}

AddPoints widest() { return __builtin_cpu_supports("avx2") ? add_points_avx2 : add_points_plain; }
#else
AddPoints widest() { return add_points_plain; }
#endif

/// The grid cut into an even number of tiles along each axis.
class Tiling {
  public:
    Tiling(const CellGrid& grid, const KaiserBessel& window) : grid_(grid) {
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
                   .lead = static_cast<std::int64_t>((window.width() - 1) / 2),
                   .width = window.width(),
                   .degree = window.degree(),
                   .coefficients = window.coefficients().data(),
                   .extent = widest_ + window.padded_width()};
    }

    [[nodiscard]] std::size_t count() const { return power(along_); }
    [[nodiscard]] std::size_t colours() const { return power(2); }
    [[nodiscard]] std::size_t count_of_colour() const { return power(pairs_); }
    [[nodiscard]] std::size_t buffer_size() const { return power(common_.extent); }

    [[nodiscard]] std::size_t tile_of(const double* point) const {
        std::size_t tile = 0;
        for (std::size_t k = grid_.dimension; k-- > 0;)
            tile =
                tile * along_ + tile_of_[static_cast<std::size_t>(locate(point[k], common_).first)];
        return tile;
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
    void add_back(const Tile& tile, const double* buffer) const {
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

/// Points in the order of their tiles; within a tile in their own order.
struct Sorted {
    std::vector<double> rows;
    std::vector<std::size_t> begins;  ///< of each tile's numbers, and the end
};

/// Turns the counts of each tile in each block, [block][tile], into the places where its points go.
/// Returns where each tile's numbers begin, and the end.
std::vector<std::size_t> counts_to_places(std::vector<std::uint32_t>& counts, std::size_t tiles,
                                          std::size_t dimension) {
    std::vector<std::size_t> begins;
    std::uint32_t total = 0;
    for (std::size_t t = 0; t < tiles; ++t) {
        begins.push_back(total * dimension);
        for (std::size_t i = t; i < counts.size(); i += tiles)
            total += std::exchange(counts[i], total);
    }
    begins.push_back(total * dimension);
    return begins;
}

Sorted sort_into_tiles(std::span<const double> rows, std::size_t dimension, const Tiling& tiling,
                       const RunContext& run) {
    const std::size_t count = rows.size() / dimension;
    const std::size_t tiles = tiling.count();
    // Blocks no smaller than the number of tiles, lest the counters outgrow the points.
    const std::size_t block = std::max<std::size_t>(std::size_t{1} << 15, tiles);
    const std::size_t blocks = block_count(count, block);
    std::vector<std::uint32_t> tile_of(count);
    std::vector<std::uint32_t> next(blocks * tiles, 0);
    for_each_block(
        run, count, block,
        [&](const Block& b) {
            std::uint32_t* counters = next.data() + b.index * tiles;
            for (std::size_t i = b.first; i < b.last; ++i) {
                tile_of[i] = static_cast<std::uint32_t>(tiling.tile_of(&rows[i * dimension]));
                ++counters[tile_of[i]];
            }
        },
        true);
    Sorted sorted{.rows = std::vector<double>(rows.size()),
                  .begins = counts_to_places(next, tiles, dimension)};
    for_each_block(
        run, count, block,
        [&](const Block& b) {
            std::uint32_t* places = next.data() + b.index * tiles;
            for (std::size_t i = b.first; i < b.last; ++i) {
                double* to = &sorted.rows[places[tile_of[i]]++ * dimension];
                for (std::size_t k = 0; k < dimension; ++k) to[k] = rows[i * dimension + k];
            }
        },
        true);
    return sorted;
}

/// Spreads the sorted points of the tiles of one colour.
void spread_colour(const Sorted& sorted, std::size_t colour, std::size_t dimension,
                   const Tiling& tiling, const RunContext& run) {
    static const AddPoints add = widest();
    const std::size_t tiles = tiling.count_of_colour();
    // Enough blocks for all threads, but none with less work than handing it over is.
    const std::size_t points = 1 + sorted.rows.size() / dimension;
    const std::size_t block = std::max(1 + tiles / 128, 1024 * tiling.count() / points);
    // A buffer takes so many points: rounding errors of long sums stay small, and a stop is heeded
    // where all points are in one tile.
    const std::size_t portion = 512 * dimension;
    for_each_block(
        run, tiles, block,
        [&](const Block& b) {
            std::vector<double> buffer;
            for (std::size_t i = b.first; i < b.last; ++i) {
                const std::size_t number = tiling.tile(colour, i);
                const std::size_t begin = sorted.begins[number];
                const std::size_t end = sorted.begins[number + 1];
                if (begin == end) continue;
                const Tile tile = tiling.describe(number);
                for (std::size_t at = begin; at < end; at += portion) {
                    run.check_stop();
                    buffer.assign(tiling.buffer_size(), 0.0);
                    const std::span some(&sorted.rows[at], std::min(portion, end - at));
                    add(some, dimension, tile, buffer.data());
                    tiling.add_back(tile, buffer.data());
                }
            }
        },
        true);
}

}  // namespace

std::size_t spreading_batch(std::size_t count, const CellGrid& grid) {
    constexpr std::size_t most = std::size_t{1} << 30;  // counters of 32 bits are enough for it
    std::size_t cells = 1;
    for (std::size_t k = 0; k < grid.dimension; ++k) cells = std::min(most, cells * grid.side);
    // Fewer points than cells would pass over the grid too often.
    const std::size_t batch = std::max(cells, std::size_t{1} << 20);
    return std::min(count, batch);
}

void spread(std::span<const double> rows, const KaiserBessel& window, const CellGrid& grid,
            const RunContext& run) {
    assert(grid.side % 2 == 0 && grid.side >= CellGrid::smallest_side && grid.side < 1U << 24);
    const Tiling tiling(grid, window);
    const std::size_t d = grid.dimension;
    const std::size_t batch = std::max<std::size_t>(1, spreading_batch(rows.size() / d, grid)) * d;
    for (std::size_t at = 0; at < rows.size(); at += batch) {
        const auto some = rows.subspan(at, std::min(batch, rows.size() - at));
        const Sorted sorted = sort_into_tiles(some, d, tiling, run);
        for (std::size_t colour = 0; colour < tiling.colours(); ++colour) {
            spread_colour(sorted, colour, d, tiling, run);
            const std::size_t done = at + some.size() * (colour + 1) / tiling.colours();
            run.tick(done, rows.size());
        }
    }
}

}  // namespace stipple
