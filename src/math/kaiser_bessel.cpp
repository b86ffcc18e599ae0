// SPDX-License-Identifier: MIT
#include "math/kaiser_bessel.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace stipple {
namespace {

/// I0(2 sqrt(y)) by its series, all terms of which are positive for y >= 0.
double bessel_i0(double y) {
    double term = 1;
    double sum = 1;
    for (int k = 1; std::abs(term) > 1e-17 * sum; ++k) {
        term *= y / (k * k);
        sum += term;
    }
    return sum;
}

/// Coefficients c of sum_k c_k T_k(t) that agrees with `values` at the Chebyshev nodes.
std::vector<double> chebyshev_coefficients(const std::vector<double>& values) {
    const std::size_t n = values.size();
    std::vector<double> c(n, 0.0);
    for (std::size_t k = 0; k < n; ++k)
        for (std::size_t j = 0; j < n; ++j)
            c[k] += values[j] * (k == 0 ? 1 : 2) / static_cast<double>(n) *
                    std::cos(std::numbers::pi * static_cast<double>(k) *
                             (static_cast<double>(j) + 0.5) / static_cast<double>(n));
    return c;
}

/// The same polynomial in powers of t, lowest first.
std::vector<double> to_powers(const std::vector<double>& chebyshev) {
    const std::size_t n = chebyshev.size();
    std::vector<double> powers(n, 0.0);
    std::vector<double> before(n, 0.0);
    std::vector<double> current(n, 0.0);
    current[0] = 1;  // T_0
    for (std::size_t k = 0; k < n; ++k) {
        for (std::size_t i = 0; i <= k; ++i) powers[i] += chebyshev[k] * current[i];
        std::vector<double> next(n, 0.0);  // T_(k+1) = 2 t T_k - T_(k-1), and T_1 = t
        for (std::size_t i = 0; i + 1 < n; ++i) next[i + 1] = (k == 0 ? 1 : 2) * current[i];
        for (std::size_t i = 0; i < n; ++i) next[i] -= before[i];
        before = std::move(current);
        current = std::move(next);
    }
    return powers;
}

}  // namespace

KaiserBessel::KaiserBessel(std::size_t width, double band) : width_(width), band_(band) {
    assert(width >= min_width && width <= max_width && band > 0 && band < 0.5);
    // The window's transform ends where the nearest alias of the wanted band begins; a little less
    // than that is best for narrow and wide windows alike.
    beta_ = 0.985 * std::numbers::pi * static_cast<double>(width) * (1 - band);
    scale_ = 1 / bessel_i0(beta_ * beta_ / 4);
}

double KaiserBessel::operator()(double a) const {
    const double z = 2 * a / static_cast<double>(width_);
    if (std::abs(z) > 1) return 0;
    return bessel_i0((1 - z) * (1 + z) * beta_ * beta_ / 4) * scale_;
}

double KaiserBessel::transform(double xi) const {
    const double omega = std::numbers::pi * static_cast<double>(width_) * xi;
    const double square = (beta_ - omega) * (beta_ + omega);
    const double s = std::sqrt(std::abs(square));
    const double shape = square > 0 ? std::sinh(s) / s : std::sin(s) / s;
    return static_cast<double>(width_) * shape * scale_;
}

double KaiserBessel::error() const {
    constexpr int places = 8;  // of the point between two grid points; the error is smooth there
    double worst = 0;
    std::vector<double> values(width_);
    for (int i = 0; i <= places; ++i) {
        const double u = static_cast<double>(i) / places / 2;  // symmetric about 1/2
        const double first = u + static_cast<double>(width_) / 2 - 1;
        for (std::size_t j = 0; j < width_; ++j)
            values[j] = (*this)(first - static_cast<double>(j));
        // It has a lobe just below the end of the band.
        for (const double part : {0.0, 0.5, 0.75, 0.9, 0.925, 0.95, 0.9625, 0.975, 0.9875, 1.0}) {
            const double omega = 2 * std::numbers::pi * part * band_;
            const std::complex<double> turn = std::polar(1.0, -omega);
            std::complex<double> phase = std::polar(1.0, omega * first);
            std::complex<double> sum;
            for (const double value : values) {
                sum += value * phase;
                phase *= turn;
            }
            worst = std::max(worst, std::abs(sum / transform(part * band_) - 1.0));
        }
    }
    return worst;
}

KaiserBessel window_for(double tolerance, double band) {
    // The error falls as exp(-pi w sqrt(1 - 2 band)), nearly.
    const double guess = -std::log(tolerance) / (std::numbers::pi * std::sqrt(1 - 2 * band));
    const double first = std::clamp(std::floor(guess), 2.0, 16.0);
    auto width = static_cast<std::size_t>(first);
    KaiserBessel window(width, band);
    while (window.error() > tolerance && width < KaiserBessel::max_width)
        window = KaiserBessel(++width, band);
    return window;
}

WindowTable::WindowTable(const KaiserBessel& window) : width_(window.width()) {
    constexpr std::size_t most_pieces = 64;  // there is no gain beyond: values are rounded, too
    do {
        pieces_ *= 2;
        fill(window);
    } while (pieces_ < most_pieces && !agrees(window));
}

void WindowTable::fill(const KaiserBessel& window) {
    rows_.assign(pieces_ * (degree() + 1) * row_of(width_) / 8, {});
    std::vector<double> values(degree() + 1);
    for (std::size_t i = 0; i < pieces_ * width_; ++i) {
        const std::size_t piece = i / width_;
        const std::size_t j = i % width_;
        const double first = static_cast<double>(width_) / 2 - 1 - static_cast<double>(j);
        for (std::size_t k = 0; k <= degree(); ++k) {
            const double t = std::cos(std::numbers::pi * (static_cast<double>(k) + 0.5) /
                                      static_cast<double>(degree() + 1));
            values[k] = window(
                (static_cast<double>(piece) + (t + 1) / 2) / static_cast<double>(pieces_) + first);
        }
        const auto powers = to_powers(chebyshev_coefficients(values));
        for (std::size_t k = 0; k <= degree(); ++k) coefficient(piece, k, j) = powers[degree() - k];
    }
}

/// Whether the polynomials' errors, which are largest at the ends of pieces, are small beside the
/// window's own, or as small as roundings.
bool WindowTable::agrees(const KaiserBessel& window) const {
    const double allowed = std::max(0.005 * window.error(), 1e-14);
    for (std::size_t i = 0; i < pieces_ * width_; ++i) {
        const double u = static_cast<double>(i / width_) / static_cast<double>(pieces_);
        const std::size_t j = i % width_;
        const double at = u + static_cast<double>(width_) / 2 - 1 - static_cast<double>(j);
        if (std::abs(polynomial(i / width_, j, -1) - window(at)) > allowed) return false;
    }
    return true;
}

double WindowTable::polynomial(std::size_t piece, std::size_t j, double t) const {
    const double* row = coefficients() + piece * (degree() + 1) * row_of(width_) + j;
    double value = 0;
    for (std::size_t k = 0; k <= degree(); ++k, row += row_of(width_)) value = value * t + *row;
    return value;
}

double WindowTable::value(std::size_t j, double u) const {
    const double scaled = u * static_cast<double>(pieces_);
    const auto piece = static_cast<std::size_t>(scaled);
    return polynomial(piece, j, 2 * (scaled - static_cast<double>(piece)) - 1);
}

}  // namespace stipple
