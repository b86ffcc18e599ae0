// SPDX-License-Identifier: MIT
#include "math/fourier/transform.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/machine/large_pages.hpp"
#include "core/parallel.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

/// A complex number in memory, loaded and stored as one vector.
using PairInMemory = double __attribute__((vector_size(16), aligned(8), may_alias));

/// Number of lines whose transform takes about a quarter of a millisecond.
std::size_t lines_at_a_time(std::size_t side) { return std::max<std::size_t>(1, 65536 / side); }

constexpr std::size_t batch_size = 16;  // columns transformed together, as they share cache lines

/// Number of rows transformed before they are scaled, so that they are still in the cache.
constexpr std::size_t rows_at_a_time = 8;

/// Transforms the rows of the grid and scales the frequencies needed.
void transform_rows(const CellGrid& grid, std::span<const double> factors, Planning planning,
                    const RunContext& run) {
    const LineTransform line(LineTransform::Kind::real, grid.side, planning);
    std::size_t rows = 1;
    for (std::size_t k = 1; k < grid.dimension; ++k) rows *= grid.side;
    for_each_block(run, rows, lines_at_a_time(grid.side), [&](const Block& b) {
        for (std::size_t first = b.first; first < b.last; first += rows_at_a_time) {
            const std::size_t last = std::min(first + rows_at_a_time, b.last);
            line.execute(grid.cells + first * grid.stride, grid.stride, last - first);
            for (std::size_t i = first; i < last; ++i) {
                auto* row = reinterpret_cast<PairInMemory*>(grid.cells + i * grid.stride);
                for (std::size_t f = 0; f < factors.size(); ++f) row[f] *= factors[f];
            }
        }
    });
}

/// Columns to transform: `planes` planes of `side` rows with `width` complex numbers, and `stride`
/// complex numbers from the start of one row to the next.
struct Columns {
    const std::complex<double>* values;
    std::size_t planes;
    std::size_t side;
    std::size_t stride;
    std::size_t width;
};

/// Some columns of a plane, copied into contiguous lines.
class Gathered {
  public:
    explicit Gathered(std::size_t side)
        : side_(side), spacing_(stride_of(2 * side)), lines_(batch_size * spacing_) {}

    void take(const std::complex<double>* from, std::size_t stride, std::size_t count) {
        const auto* rows = reinterpret_cast<const PairInMemory*>(from);
        auto* lines = reinterpret_cast<PairInMemory*>(lines_.get());
        for (std::size_t i = 0; i < side_; ++i)
            for (std::size_t c = 0; c < count; ++c)
                lines[c * spacing_ / 2 + i] = rows[i * stride + c];
    }

    void transform(const LineTransform& line, std::size_t count) {
        line.execute(lines_.get(), spacing_, count);
    }

    /// Copies the frequencies -F..F, scaled, into rows with a distance of `width` numbers.
    void give(std::span<const double> factors, std::complex<double>* to, std::size_t width,
              std::size_t count) const {
        const auto* lines = reinterpret_cast<const PairInMemory*>(lines_.get());
        auto* rows = reinterpret_cast<PairInMemory*>(to);
        const std::size_t last = factors.size() - 1;
        for (std::size_t i = 0; i <= 2 * last; ++i) {
            const std::size_t at = i < last ? side_ + i - last : i - last;
            const double factor = factors[i < last ? last - i : i - last];
            for (std::size_t c = 0; c < count; ++c)
                rows[i * width + c] = lines[c * spacing_ / 2 + at] * factor;
        }
    }

  private:
    std::size_t side_;
    std::size_t spacing_;  ///< numbers between the starts of lines
    GridCells lines_;
};

/// Transforms all columns. Returns frequencies -F..F, scaled, as planes x (2F + 1) x width.
std::vector<std::complex<double>> transform_columns(const Columns& in,
                                                    std::span<const double> factors,
                                                    Planning planning, const RunContext& run) {
    const LineTransform line(LineTransform::Kind::complex, in.side, planning);
    const std::size_t span = 2 * factors.size() - 1;
    const std::size_t groups = (in.width + batch_size - 1) / batch_size;
    std::vector<std::complex<double>> out;
    fill_with_zeros(out, in.planes * span * in.width);
    const std::size_t size = std::max<std::size_t>(1, lines_at_a_time(in.side) / batch_size);
    for_each_block(run, in.planes * groups, size, [&](const Block& b) {
        Gathered lines(in.side);
        for (std::size_t i = b.first; i < b.last; ++i) {
            const std::size_t plane = i / groups;
            const std::size_t first = i % groups * batch_size;
            const std::size_t count = std::min(batch_size, in.width - first);
            lines.take(in.values + plane * in.side * in.stride + first, in.stride, count);
            lines.transform(line, count);
            lines.give(factors, out.data() + plane * span * in.width + first, in.width, count);
        }
    });
    return out;
}

}  // namespace

std::complex<double> FourierSums::at(std::array<std::int64_t, 3> f) const {
    const bool mirrored = f[0] < 0;
    const auto last = static_cast<std::int64_t>(max_frequency);
    std::int64_t index = 0;
    for (std::size_t k = dimension; k-- > 1;)
        index = index * (2 * last + 1) + (mirrored ? -f[k] : f[k]) + last;
    index = index * (last + 1) + std::abs(f[0]);
    const auto value = values[static_cast<std::size_t>(index)];
    return mirrored ? std::conj(value) : value;
}

double fourier_sums_size(std::size_t dimension, std::size_t max_frequency) {
    return real_power_of(2 * max_frequency + 1, dimension - 1) *
           static_cast<double>(max_frequency + 1);
}

std::size_t stride_of(std::size_t side) { return side / 8 * 8 + 16; }

std::size_t quick_length(std::size_t least) {
    for (std::size_t length = least + least % 2;; length += 2) {
        const std::size_t odd = length >> std::countr_zero(length);
        std::size_t rest = odd;
        for (const std::size_t prime : {3U, 5U})
            while (rest % prime == 0) rest /= prime;
        if (rest == 1 && (odd < 27 || length < 256)) return length;
    }
}

double transform_seconds(std::size_t dimension, std::size_t side) {
    // With estimated plans, FFTW is fastest for powers of two.
    const double a_cell = dimension == 3 ? 1e-8 : std::has_single_bit(side) ? 5e-9 : 6.5e-9;
    return real_power_of(side, dimension) * a_cell;
}

FourierSums transform_grid(GridCells cells, const CellGrid& grid, std::span<const double> factors,
                           Planning planning, const RunContext& run) {
    transform_rows(grid, factors, planning, run.stage(0, 0.5));
    const std::size_t last = factors.size() - 1;
    FourierSums sums{.dimension = grid.dimension, .max_frequency = last, .values = {}};
    const auto* transformed = reinterpret_cast<const std::complex<double>*>(grid.cells);
    Columns columns{transformed, 1, grid.side, grid.stride / 2, last + 1};
    if (grid.dimension == 1) sums.values.assign(transformed, transformed + last + 1);
    if (grid.dimension == 2)
        sums.values = transform_columns(columns, factors, planning, run.stage(0.5, 1));
    if (grid.dimension == 3) {
        columns.planes = grid.side;
        const auto between = transform_columns(columns, factors, planning, run.stage(0.5, 0.75));
        cells.reset();
        const std::size_t width = (2 * last + 1) * (last + 1);
        sums.values = transform_columns({between.data(), 1, grid.side, width, width}, factors,
                                        planning, run.stage(0.75, 1));
    }
    return sums;
}

}  // namespace stipple
