// SPDX-License-Identifier: MIT
#include "math/nufft.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.hpp"
#include "math/fftw.hpp"
#include "math/spreading.hpp"

namespace stipple {
namespace {

/// The smallest even product of 2, 3 and 5 that is at least `least`: what FFTW is quick at.
std::size_t quick_length(std::size_t least) {
    for (std::size_t length = least + least % 2;; length += 2) {
        std::size_t rest = length;
        for (const std::size_t prime : {2U, 3U, 5U})
            while (rest % prime == 0) rest /= prime;
        if (rest == 1) return length;
    }
}

double power(std::size_t base, std::size_t exponent) {
    return std::pow(static_cast<double>(base), static_cast<double>(exponent));
}

/// A transform of one length, in place, that any number of threads may execute; planned by
/// estimate, for measured plans differ from run to run.
class LineTransform {
  public:
    enum class Kind { real, complex };

    LineTransform(Kind kind, std::size_t length) : kind_(kind) {
        const auto n = static_cast<int>(length);
        const FftwReals line = fftw_reals(2 * length + 2);
        double* p = line.get();
        const std::lock_guard lock(fftw_planner());
        plan_ = kind == Kind::real
                    ? fftw_plan_dft_r2c_1d(n, p, as_fftw(p), FFTW_ESTIMATE)
                    : fftw_plan_dft_1d(n, as_fftw(p), as_fftw(p), FFTW_FORWARD, FFTW_ESTIMATE);
        if (plan_ == nullptr) throw std::bad_alloc();
    }
    LineTransform(const LineTransform&) = delete;
    LineTransform& operator=(const LineTransform&) = delete;
    ~LineTransform() {
        const std::lock_guard lock(fftw_planner());
        fftw_destroy_plan(plan_);
    }

    /// @param line aligned as fftw_reals() does, or a multiple of 8 numbers behind.
    void execute(double* line) const {
        if (kind_ == Kind::real)
            fftw_execute_dft_r2c(plan_, line, as_fftw(line));
        else
            fftw_execute_dft(plan_, as_fftw(line), as_fftw(line));
    }

  private:
    Kind kind_;
    fftw_plan plan_ = nullptr;
};

/// Numbers from one row of the grid to the next: room for the transform of a row in place, and no
/// power of two, which would put a column into few lines of the cache.
std::size_t stride_of(std::size_t side) { return side / 8 * 8 + 16; }

/// Lines whose transform takes about a millisecond.
std::size_t lines_at_a_time(std::size_t side) { return std::max<std::size_t>(1, 32768 / side); }

void clear(double* numbers, std::size_t count, const RunContext& run) {
    for_each_block(
        run, count, std::size_t{1} << 18,
        [&](const Block& b) { std::fill(numbers + b.first, numbers + b.last, 0.0); }, true);
}

/// Transforms the rows of the grid and scales what is wanted of them.
void transform_rows(const CellGrid& grid, std::span<const double> factors, const RunContext& run) {
    const LineTransform line(LineTransform::Kind::real, grid.side);
    std::size_t rows = 1;
    for (std::size_t k = 1; k < grid.dimension; ++k) rows *= grid.side;
    for_each_block(run, rows, lines_at_a_time(grid.side), [&](const Block& b) {
        for (std::size_t i = b.first; i < b.last; ++i) {
            double* row = grid.cells + i * grid.stride;
            line.execute(row);
            for (std::size_t f = 0; f < factors.size(); ++f) {
                row[2 * f] *= factors[f];
                row[2 * f + 1] *= factors[f];
            }
        }
    });
}

/// Lines across the memory: for each of `planes`, `side` rows of `width` complex numbers that
/// stand `stride` complex numbers apart.
struct Columns {
    const std::complex<double>* values;
    std::size_t planes;
    std::size_t side;
    std::size_t stride;
    std::size_t width;
};

/// Transforms all columns and keeps their frequencies -F..F, scaled: planes x (2F + 1) x width.
std::vector<std::complex<double>> transform_columns(const Columns& in,
                                                    std::span<const double> factors,
                                                    const RunContext& run) {
    constexpr std::size_t together = 8;  // columns share the cache lines that they are read from
    const LineTransform line(LineTransform::Kind::complex, in.side);
    const std::size_t last = factors.size() - 1;
    const std::size_t spacing = stride_of(2 * in.side);
    const std::size_t groups = (in.width + together - 1) / together;
    std::vector<std::complex<double>> out(in.planes * (2 * last + 1) * in.width);
    const auto transform_group = [&](std::size_t plane, std::size_t first, double* buffer) {
        const std::size_t count = std::min(together, in.width - first);
        const auto* from = in.values + plane * in.side * in.stride + first;
        for (std::size_t i = 0; i < in.side; ++i)
            for (std::size_t c = 0; c < count; ++c) {
                buffer[c * spacing + 2 * i] = from[i * in.stride + c].real();
                buffer[c * spacing + 2 * i + 1] = from[i * in.stride + c].imag();
            }
        for (std::size_t c = 0; c < count; ++c) line.execute(buffer + c * spacing);
        auto* to = out.data() + plane * (2 * last + 1) * in.width + first;
        for (std::size_t i = 0; i <= 2 * last; ++i) {
            const std::size_t at = i < last ? in.side + i - last : i - last;
            const double factor = factors[i < last ? last - i : i - last];
            for (std::size_t c = 0; c < count; ++c)
                to[i * in.width + c] = {buffer[c * spacing + 2 * at] * factor,
                                        buffer[c * spacing + 2 * at + 1] * factor};
        }
    };
    const std::size_t size = std::max<std::size_t>(1, lines_at_a_time(in.side) / together);
    for_each_block(run, in.planes * groups, size, [&](const Block& b) {
        const FftwReals buffer = fftw_reals(together * spacing);
        for (std::size_t i = b.first; i < b.last; ++i)
            transform_group(i / groups, i % groups * together, buffer.get());
    });
    return out;
}

/// Seconds, nearly, of one core.
struct Cost {
    double spreading;
    double transforming;
    [[nodiscard]] double total() const { return spreading + transforming; }
};

Cost cost_of(std::size_t count, std::size_t dimension, std::size_t side,
             const KaiserBessel& window) {
    const auto width = static_cast<double>(window.padded_width());
    const double d = static_cast<double>(dimension);
    const double adding = power(window.width(), dimension - 1) * width;
    const double evaluating = d * width * static_cast<double>(window.degree());
    const double cells = power(side, dimension);
    return {.spreading = static_cast<double>(count) * (2e-8 + 2e-10 * (adding + evaluating)),
            .transforming = cells * (3e-9 + 5e-10 * std::log2(cells))};
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
    return power(2 * max_frequency + 1, dimension - 1) * static_cast<double>(max_frequency + 1);
}

double rounding_floor(std::size_t count) {
    const auto n = static_cast<double>(count);
    // Measured below 7e-14 a point up to n = 10^6; beyond, the sums of ever more buffers of a tile.
    return (1e-13 + n * 0x1p-62) * std::sqrt(n);
}

Nufft::Nufft(std::size_t count, std::size_t dimension, std::size_t max_frequency, double tolerance)
    : count_(count),
      dimension_(dimension),
      frequency_(max_frequency),
      window_(KaiserBessel::min_width, 0.25) {
    assert(dimension >= 1 && dimension <= 3 && max_frequency >= 1);
    // Of each point, in each dimension; less than rounding errors would be of no use.
    const double allowed = std::max(tolerance / std::sqrt(static_cast<double>(count)), 3e-14) /
                           (1.1 * static_cast<double>(dimension));
    double cheapest = std::numeric_limits<double>::infinity();
    // A finer grid takes a narrower window, and magnifies rounding errors less.
    for (const double finer : {1.5, 2.0, 2.5, 3.0, 4.0}) {
        if (allowed < (finer < 2 ? 1e-10 : finer < 2.5 ? 1e-13 : 0)) continue;
        const auto least =
            static_cast<std::size_t>(finer * static_cast<double>(2 * frequency_ + 1));
        const std::size_t side = quick_length(std::max(least, CellGrid::smallest_side));
        const double band = static_cast<double>(frequency_) / static_cast<double>(side);
        const KaiserBessel window = window_for(allowed, band);
        const double cost = cost_of(count, dimension, side, window).total();
        if (cost >= cheapest) continue;
        cheapest = cost;
        side_ = side;
        window_ = window;
    }
}

double Nufft::bytes() const {
    const double cells = power(side_, dimension_ - 1) * static_cast<double>(stride_of(side_));
    const CellGrid grid{.dimension = dimension_, .side = side_};
    const double batch = static_cast<double>(spreading_batch(count_, grid)) *
                         static_cast<double>(8 * dimension_ + 8);
    const double out = fourier_sums_size(dimension_, frequency_) * 16;
    const double between =
        dimension_ == 3 ? out * static_cast<double>(side_) / static_cast<double>(2 * frequency_ + 1)
                        : 0;
    return std::max({8 * cells + batch, 8 * cells + between, between + out, 8 * cells + out});
}

FourierSums Nufft::transform(std::span<const double> rows, const RunContext& run) const {
    const std::size_t lines = dimension_ == 3 ? side_ * side_ : dimension_ == 2 ? side_ : 1;
    const std::size_t stride = stride_of(side_);
    FftwReals cells = fftw_reals(lines * stride);
    clear(cells.get(), lines * stride, run);
    const CellGrid grid{
        .dimension = dimension_, .side = side_, .stride = stride, .cells = cells.get()};
    const Cost cost = cost_of(count_, dimension_, side_, window_);
    const double spreading = cost.spreading / cost.total();
    spread(rows, window_, grid, run.stage(0, spreading));

    std::vector<double> factors;
    for (std::size_t f = 0; f <= frequency_; ++f)
        factors.push_back(1 /
                          window_.transform(static_cast<double>(f) / static_cast<double>(side_)));
    const double middle = (1 + spreading) / 2;
    transform_rows(grid, factors, run.stage(spreading, middle));

    FourierSums sums{.dimension = dimension_, .max_frequency = frequency_, .values = {}};
    const auto* transformed = reinterpret_cast<const std::complex<double>*>(cells.get());
    Columns columns{transformed, 1, side_, stride / 2, frequency_ + 1};
    const RunContext rest = run.stage(middle, 1);
    if (dimension_ == 1) sums.values.assign(transformed, transformed + frequency_ + 1);
    if (dimension_ == 2) sums.values = transform_columns(columns, factors, rest);
    if (dimension_ == 3) {
        columns.planes = side_;
        const auto between =
            transform_columns(columns, factors, run.stage(middle, (middle + 1) / 2));
        cells.reset();
        const std::size_t width = (2 * frequency_ + 1) * (frequency_ + 1);
        sums.values = transform_columns({between.data(), 1, side_, width, width}, factors,
                                        run.stage((middle + 1) / 2, 1));
    }
    return sums;
}

namespace {

/// exp(-2 pi i f x) for f = 0..last. The product f x is split, so that its whole part goes before
/// anything is rounded.
void phases(double x, std::size_t last, std::complex<double>* out) {
    const double high = static_cast<double>(static_cast<float>(x));
    for (std::size_t f = 0; f <= last; ++f) {
        const auto frequency = static_cast<double>(f);
        const double product = frequency * high;  // 24 + 20 bits: exact
        const double turn = (product - std::round(product)) + frequency * (x - high);
        out[f] = std::polar(1.0, -2 * std::numbers::pi * turn);
    }
}

/// Phases of a few points at a time, for each axis: [axis][point][0..F].
class PhaseTables {
  public:
    PhaseTables(std::size_t dimension, std::size_t last)
        : dimension_(dimension),
          last_(last),
          capacity_(std::clamp<std::size_t>((std::size_t{1} << 20) / (last + 1), 1, 64)),
          table_(dimension * capacity_ * (last + 1)) {}

    /// Points that fit.
    [[nodiscard]] std::size_t capacity() const { return capacity_; }

    void fill(std::span<const double> rows, const RunContext& run) {
        count_ = rows.size() / dimension_;
        for (std::size_t i = 0; i < count_; ++i, run.check_stop())
            for (std::size_t k = 0; k < dimension_; ++k)
                phases(rows[i * dimension_ + k], last_, at(k, i));
    }

    /// Adds exp(-2 pi i f.x) of all points, f_0 = 0..F, to a row of sums with the given f_1, f_2.
    void add(std::int64_t f1, std::int64_t f2, std::complex<double>* row) {
        for (std::size_t i = 0; i < count_; ++i) {
            const std::complex<double> factor = value(1, i, f1) * value(2, i, f2);
            const std::complex<double>* along = at(0, i);
            for (std::size_t f = 0; f <= last_; ++f) {
                const double re = along[f].real();
                const double im = along[f].imag();
                row[f] += std::complex<double>(re * factor.real() - im * factor.imag(),
                                               re * factor.imag() + im * factor.real());
            }
        }
    }

  private:
    std::complex<double>* at(std::size_t k, std::size_t i) {
        return table_.data() + (k * capacity_ + i) * (last_ + 1);
    }
    std::complex<double> value(std::size_t k, std::size_t i, std::int64_t f) {
        if (k >= dimension_) return 1;
        const auto v = at(k, i)[std::abs(f)];
        return f < 0 ? std::conj(v) : v;
    }

    std::size_t dimension_;
    std::size_t last_;
    std::size_t capacity_;
    std::size_t count_ = 0;
    std::vector<std::complex<double>> table_;
};

}  // namespace

FourierSums fourier_sums_directly(std::span<const double> rows, std::size_t dimension,
                                  std::size_t max_frequency, const RunContext& run) {
    const std::size_t width = max_frequency + 1;
    const std::size_t span = 2 * max_frequency + 1;
    const std::size_t lines = dimension == 3 ? span * span : dimension == 2 ? span : 1;
    FourierSums sums{dimension, max_frequency, std::vector<std::complex<double>>(lines * width)};
    PhaseTables tables(dimension, max_frequency);
    const std::size_t portion = tables.capacity() * dimension;
    const auto last = static_cast<std::int64_t>(max_frequency);
    for (std::size_t at = 0; at < rows.size(); at += portion) {
        tables.fill(rows.subspan(at, std::min(portion, rows.size() - at)), run);
        for_each_block(
            run, lines, std::max<std::size_t>(1, 4096 / width),
            [&](const Block& b) {
                for (std::size_t i = b.first; i < b.last; ++i) {
                    // Sums of a portion first: rounding errors of long sums stay small.
                    std::vector<std::complex<double>> row(width);
                    const auto f1 = dimension > 1 ? static_cast<std::int64_t>(i % span) - last : 0;
                    const auto f2 = static_cast<std::int64_t>(i / span) - last;
                    tables.add(f1, f2, row.data());
                    for (std::size_t f = 0; f < width; ++f) sums.values[i * width + f] += row[f];
                }
            },
            true);
        run.tick(at + portion, rows.size());
    }
    return sums;
}

}  // namespace stipple
