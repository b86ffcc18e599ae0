// SPDX-License-Identifier: MIT
#include "math/fourier/nufft.hpp"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/trigonometry.hpp"

namespace stipple {
namespace {

/// Approximate time on one core, in seconds.
double cost_of(std::uint64_t count, std::size_t dimension, std::size_t side,
               const KaiserBessel& window) {
    const auto width = static_cast<double>(window.width());
    // Mean over machines with vectors of four and of eight doubles, because the choice must not
    // depend on the machine. A vector of eight costs as much as two of four.
    const double vectors = std::ceil(width / 4) / 2 + std::ceil(width / 8);
    const double d = static_cast<double>(dimension);
    const double cells = real_power_of(side, dimension);
    const double adding = real_power_of(window.width(), dimension - 1) * vectors * 0.4e-9;
    const double evaluating = d * (2e-9 + vectors * 1.1e-9);
    const double n = static_cast<double>(count);
    const double passes = std::ceil(n / std::clamp(cells, 1048576.0, 4194304.0));
    constexpr double touching = 5e-9;  // seconds per cell for the first use of its memory
    const double spreading = n * (8e-9 + adding + evaluating) + passes * cells * 4e-9;
    return spreading + transform_seconds(dimension, side) + cells * touching;
}

/// Ratio of the tolerance to the sum of the window's errors on all axes. It leaves room for
/// rounding errors, and for positions at which the window's error was not computed.
constexpr double reserve = 1.2;

/// True if the division by the scaling factors keeps rounding errors small enough.
bool keeps_digits(const KaiserBessel& window, std::size_t dimension, double allowed) {
    // Limits found by trial: the first for errors of sums over coinciding points, the second for
    // errors of the window's polynomials on each axis. All errors are per point.
    const double times = window.magnification();
    return 1e-15 * std::pow(times, dimension) <= std::max(allowed / 8, 2e-14) &&
           6e-15 * times <= std::max(allowed / 16, 4e-14);
}

}  // namespace

double rounding_floor(std::size_t count) {
    const auto n = static_cast<double>(count);
    // The measured error per point was below 7e-14 for n up to 10^6. For larger n it comes from
    // adding up more and more buffers of the same tile.
    return (1.5e-13 + n * 0x1p-62) * std::sqrt(n);
}

Nufft::Nufft(std::uint64_t count, std::size_t dimension, std::size_t max_frequency,
             double tolerance, bool weighted)
    : count_(count),
      dimension_(dimension),
      frequency_(max_frequency),
      weighted_(weighted),
      window_(KaiserBessel::min_width, 0.25) {
    assert(dimension >= 1 && dimension <= 3 && max_frequency >= 1);
    // Allowed error per point and dimension, not below the rounding errors.
    const double allowed = std::max(tolerance / std::sqrt(static_cast<double>(count)), 3e-14) /
                           (reserve * static_cast<double>(dimension));
    const auto wanted = static_cast<double>(2 * frequency_ + 1);
    double cheapest = std::numeric_limits<double>::infinity();
    // If the number of points is unknown, `count` is usually much larger than the actual number.
    const std::uint64_t likely = std::min(count, std::uint64_t{1} << 23);
    // A finer grid allows a narrower window and magnifies rounding errors less.
    std::size_t side = std::max(static_cast<std::size_t>(1.25 * wanted), CellGrid::smallest_side);
    for (; static_cast<double>(side) < 4.5 * wanted || side_ == 0; side += 2) {
        side = quick_length(side);
        if (transform_seconds(dimension, side) >= cheapest) break;
        const double band = static_cast<double>(frequency_) / static_cast<double>(side);
        const KaiserBessel window = window_for(allowed, band);
        const double cost = cost_of(likely, dimension, side, window);
        const bool exact = window.error() <= allowed && keeps_digits(window, dimension, allowed);
        const bool finest = side_ == 0 && static_cast<double>(side) > 3.9 * wanted;
        if (cost >= cheapest || !(exact || finest)) continue;
        cheapest = cost;
        side_ = side;
        window_ = window;
    }
}

double Nufft::bytes() const {
    const double cells =
        real_power_of(side_, dimension_ - 1) * static_cast<double>(stride_of(side_));
    const CellGrid grid{.dimension = dimension_, .side = side_};
    const double batch = Spreader::bytes(static_cast<double>(count_), grid, weighted_);
    const double out = fourier_sums_size(dimension_, frequency_) * 16;
    const double between =
        dimension_ == 3 ? out * static_cast<double>(side_) / static_cast<double>(2 * frequency_ + 1)
                        : 0;
    return std::max({8 * cells + batch, 8 * cells + between, between + out, 8 * cells + out});
}

double Nufft::error(double count) const {
    return reserve * static_cast<double>(dimension_) * window_.error() * std::sqrt(count);
}

namespace {

std::size_t lines_of(const Nufft& nufft) {
    return static_cast<std::size_t>(real_power_of(nufft.side(), nufft.dimension() - 1));
}

/// Sets the cells to 0, for the next block of points.
void zero(std::span<double> cells, const RunContext& run) {
    constexpr std::uint64_t some = std::uint64_t{1} << 18;
    for_each_block(silent(run), cells.size(), some, [&](const Block& b) {
        std::ranges::fill(cells.subspan(b.first, b.last - b.first), 0.0);
    });
}

}  // namespace

FourierSummation::FourierSummation(const Nufft& nufft)
    : nufft_(nufft),
      cells_(lines_of(nufft) * stride_of(nufft.side())),
      grid_{.dimension = nufft.dimension(),
            .side = nufft.side(),
            .stride = stride_of(nufft.side()),
            .cells = cells_.get()},
      spreader_(std::in_place, nufft.window(), grid_, nufft.count(), nufft.weighted()),
      block_(block_of(nufft)) {}

std::uint64_t FourierSummation::block_of(const Nufft& nufft) {
    constexpr std::uint64_t least = std::uint64_t{1} << 24;
    constexpr std::uint64_t most = std::uint64_t{1} << 26;
    const double cells = real_power_of(nufft.side(), nufft.dimension());
    return std::clamp(std::bit_ceil(static_cast<std::uint64_t>(cells)), least, most);
}

std::span<double> FourierSummation::cells() const {
    return {cells_.get(), lines_of(nufft_) * grid_.stride};
}

void FourierSummation::add(std::span<const double> rows, const RunContext& run) {
    const std::size_t numbers = grid_.dimension + (nufft_.weighted() ? 1 : 0);
    while (!rows.empty()) {
        if (points_ == block_) {
            close_block(run);
            zero(cells(), run);
        }
        const std::uint64_t some = std::min<std::uint64_t>(rows.size() / numbers, block_ - points_);
        const auto here = rows.first(static_cast<std::size_t>(some) * numbers);
        spreader_->add(here, run);
        if (nufft_.weighted())
            for (std::size_t at = numbers - 1; at < here.size(); at += numbers)
                strongest_ = std::max(strongest_, std::abs(here[at]));
        else
            strongest_ = 1;
        points_ += some;
        rows = rows.subspan(here.size());
    }
}

void FourierSummation::close_block(const RunContext& run) {
    spreader_->finish(run);
    sum_.add(cells(), strongest_, run);
    points_ = 0;
    strongest_ = 0;
}

void FourierSummation::pack(Packer& to, const RunContext& run) {
    close_block(run);
    sum_.pack(to);
}

void FourierSummation::merge(Unpacker& from, const RunContext& run) {
    if (points_ > 0) close_block(run);
    sum_.merge(from);
}

FourierSums FourierSummation::finish(Planning planning, const RunContext& run) {
    const RunContext quiet = silent(run);
    spreader_->finish(quiet);
    spreader_.reset();  // frees memory for the transform
    if (!sum_.empty()) {
        if (points_ > 0) sum_.add(cells(), strongest_, quiet);
        sum_.copy_to(cells(), quiet);
        sum_ = {};
    }
    std::vector<double> factors;
    const auto side = static_cast<double>(nufft_.side());
    for (std::size_t f = 0; f <= nufft_.max_frequency(); ++f)
        factors.push_back(1 / nufft_.window().scaling(static_cast<double>(f) / side));
    return transform_grid(std::move(cells_), grid_, factors, planning, run);
}

namespace {

/// exp(-2 pi i f x) for f = 0..last. Splits f x to remove its integer part before rounding.
void phases(double x, std::size_t last, std::complex<double>* out) {
    const double high = static_cast<double>(static_cast<float>(x));
    for (std::size_t f = 0; f <= last; ++f) {
        const auto frequency = static_cast<double>(f);
        const double product = frequency * high;  // 24 + 20 bits: exact
        const double turn = (product - std::round(product)) + frequency * (x - high);
        const auto [cos, sin] = cos_sin_turns(std::abs(turn));
        out[f] = {cos, turn > 0 ? -sin : sin};
    }
}

/// Phases exp(-2 pi i f x_k) of some points for f = 0..F, indexed by [point][axis k][f]. Those of
/// the first axis are multiplied by the point's strength.
struct PhaseTable {
    std::size_t dimension;
    std::size_t last;
    std::vector<std::complex<double>> values = {};

    void fill(std::span<const double> rows, std::size_t numbers, const RunContext& run) {
        values.resize(rows.size() / numbers * dimension * (last + 1));
        auto* out = values.data();
        for (std::size_t at = 0; at < rows.size(); at += numbers, run.check_stop())
            for (std::size_t k = 0; k < dimension; ++k, out += last + 1) {
                phases(rows[at + k], last, out);
                if (k == 0 && numbers > dimension)
                    for (std::size_t f = 0; f <= last; ++f) out[f] *= rows[at + dimension];
            }
    }

    /// Adds the terms of all points to a row of sums S(f), f_0 = 0..F.
    void add(const std::array<std::int64_t, 3>& f, std::span<std::complex<double>> row) const {
        for (std::size_t at = 0; at < values.size(); at += dimension * (last + 1)) {
            std::complex<double> factor = 1;
            for (std::size_t k = 1; k < dimension; ++k) {
                const auto along = static_cast<std::size_t>(std::abs(f[k]));
                const auto phase = values[at + k * (last + 1) + along];
                factor *= f[k] < 0 ? std::conj(phase) : phase;
            }
            for (std::size_t i = 0; i < row.size(); ++i) {
                const double re = values[at + i].real();
                const double im = values[at + i].imag();
                row[i] += std::complex<double>(re * factor.real() - im * factor.imag(),
                                               re * factor.imag() + im * factor.real());
            }
        }
    }
};

}  // namespace

DirectSummation::DirectSummation(std::size_t dimension, std::size_t max_frequency, bool weighted)
    : weighted_(weighted), sums_{dimension, max_frequency, {}} {
    sums_.values.resize(static_cast<std::size_t>(fourier_sums_size(dimension, max_frequency)));
}

void DirectSummation::add(std::span<const double> rows, const RunContext& run) {
    const std::size_t numbers = sums_.dimension + (weighted_ ? 1 : 0);
    const std::size_t width = sums_.max_frequency + 1;
    const std::size_t span = 2 * sums_.max_frequency + 1;
    const auto last = static_cast<std::int64_t>(sums_.max_frequency);
    PhaseTable table{sums_.dimension, sums_.max_frequency};
    const std::size_t portion =
        std::clamp<std::size_t>((std::size_t{1} << 20) / width, 1, 64) * numbers;
    for (std::size_t at = 0; at < rows.size(); at += portion) {
        table.fill(rows.subspan(at, std::min(portion, rows.size() - at)), numbers, run);
        const std::size_t some = std::max<std::size_t>(1, 4096 / width);
        for_each_block(silent(run), sums_.values.size() / width, some, [&](const Block& b) {
            for (std::size_t i = b.first; i < b.last; ++i) {
                // Summing a portion first keeps rounding errors of long sums small.
                std::vector<std::complex<double>> row(width);
                table.add({0, static_cast<std::int64_t>(i % span) - last,
                           static_cast<std::int64_t>(i / span) - last},
                          row);
                for (std::size_t f = 0; f < width; ++f) sums_.values[i * width + f] += row[f];
            }
        });
        run.tick(std::min(at + portion, rows.size()), rows.size());
    }
}

}  // namespace stipple
