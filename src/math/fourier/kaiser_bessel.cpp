// SPDX-License-Identifier: MIT
#include "math/fourier/kaiser_bessel.hpp"

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace stipple {
namespace {

constexpr std::size_t max_nodes = WeightTable::degree_of(KaiserBessel::max_width) + 1;
using Square = std::array<std::array<double, max_nodes>, max_nodes>;

/// The i-th of `count` Chebyshev nodes.
double node(std::size_t i, std::size_t count) {
    return std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
}

/// c[n][k] is the coefficient of t^k in T_n.
Square chebyshev_polynomials(std::size_t count) {
    Square c{};
    c[0][0] = 1;
    for (std::size_t n = 1; n < count; ++n)  // T_(n+1) = 2 t T_n - T_(n-1), and T_1 = t
        for (std::size_t k = 0; k < count; ++k)
            c[n][k] =
                (k == 0 ? 0 : (n == 1 ? 1 : 2) * c[n - 1][k - 1]) - (n == 1 ? 0 : c[n - 2][k]);
    return c;
}

/// shares[n][i] is the weight of the value at the i-th Chebyshev node in the coefficient of T_n.
Square interpolation(std::size_t count) {
    Square shares{};
    for (std::size_t n = 0; n < count; ++n)
        for (std::size_t i = 0; i < count; ++i)
            shares[n][i] = (n == 0 ? 1 : 2) / static_cast<double>(count) *
                           std::cos(static_cast<double>(n) * std::acos(node(i, count)));
    return shares;
}

double bessel(double x) { return boost::math::cyl_bessel_i(0, x); }

}  // namespace

KaiserBessel::KaiserBessel(std::size_t width, double band) : width_(width), band_(band) {
    assert(width >= min_width && width <= max_width && band > 0 && band < 0.5);
    // The main lobe of the window's transform ends slightly below the band's nearest alias.
    beta_ = 0.98 * std::numbers::pi * static_cast<double>(width) * (1 - band);
    scale_ = 1 / bessel(beta_);
    error_ = largest_error();
}

double KaiserBessel::scaling(double xi) const {
    const double omega = std::numbers::pi * static_cast<double>(width_) * xi;
    const double square = (beta_ - omega) * (beta_ + omega);
    const double s = std::sqrt(std::abs(square));
    const double shape = square > 0 ? std::sinh(s) / s : std::sin(s) / s;
    return static_cast<double>(width_) * shape * scale_;
}

double KaiserBessel::expected_error(std::size_t width, double band) {
    return 12 * std::exp(-std::numbers::pi * static_cast<double>(width) * std::sqrt(1 - 2 * band));
}

std::array<double, KaiserBessel::max_width> KaiserBessel::weights(double u) const {
    std::array<double, max_width> weights{};
    const double half = static_cast<double>(width_) / 2;
    for (std::size_t j = 0; j < width_; ++j) {
        const double a = (u + half - 1 - static_cast<double>(j)) / half;
        weights[j] = bessel(beta_ * std::sqrt(std::max(0.0, (1 - a) * (1 + a)))) * scale_;
    }
    return weights;
}

double KaiserBessel::largest_error() const {
    constexpr std::size_t places = 8;       // positions tested between grid points
    const auto place = [](std::size_t p) {  // in [0, 1/2]: errors are symmetric
        return static_cast<double>(p) / (2 * (places - 1));
    };
    std::array<std::array<double, max_width>, places> weights{};
    for (std::size_t p = 0; p < places; ++p) weights[p] = this->weights(place(p));
    const std::size_t looks = 4 * width_;
    double worst = 0;
    for (std::size_t i = 0; i <= looks; ++i) {
        const double xi = band_ * std::sin(std::numbers::pi / 2 * static_cast<double>(i) /
                                           static_cast<double>(looks));
        const double omega = 2 * std::numbers::pi * xi;
        const std::complex<double> turn = std::polar(1.0, -omega);
        std::complex<double> phase = std::polar(1.0, omega * static_cast<double>(width_ - 1) / 2);
        std::array<std::complex<double>, places> sums{};
        for (std::size_t j = 0; j < width_; ++j, phase *= turn)
            for (std::size_t p = 0; p < places; ++p) sums[p] += weights[p][j] * phase;
        const double s = scaling(xi);
        for (std::size_t p = 0; p < places; ++p)
            worst =
                std::max(worst, std::abs(sums[p] / s - std::polar(1.0, -omega * (place(p) - 0.5))));
    }
    return worst;
}

KaiserBessel window_for(double tolerance, double band) {
    std::size_t width = KaiserBessel::min_width;
    while (KaiserBessel::expected_error(width, band) > 3 * tolerance &&
           width < KaiserBessel::max_width)
        ++width;
    for (;; ++width) {
        const KaiserBessel window(width, band);
        if (window.error() <= tolerance || width == KaiserBessel::max_width) return window;
    }
}

WeightTable::WeightTable(const KaiserBessel& window) : width_(window.width()), pieces_(2) {
    constexpr std::size_t most_pieces = 64;  // more give no gain, because values are rounded
    const double allowed = std::max(0.05 * window.error(), 1e-15);
    const auto terms = static_cast<double>(degree() + 1);
    // Error of interpolating a wave at the end of the band by a polynomial through a piece's
    // Chebyshev nodes; that of interpolating the weights is about as large.
    const auto error = [&] {
        const double turn = std::numbers::pi * window.band() / static_cast<double>(pieces_);
        return 2 * std::pow(turn / 2, terms) / std::tgamma(terms + 1);
    };
    while (pieces_ < most_pieces && error() > allowed) pieces_ *= 2;
    rows_.assign(pieces_ * (degree() + 1) * row_of(width_) / 8, {});
    const std::size_t nodes = degree() + 1;
    const Square shares = interpolation(nodes);
    const Square chebyshev = chebyshev_polynomials(nodes);
    for (std::size_t piece = 0; piece < pieces_; ++piece) {
        std::array<std::array<double, KaiserBessel::max_width>, max_nodes> sums{};  // by n of T_n
        for (std::size_t i = 0; i < nodes; ++i) {
            const double place = static_cast<double>(piece) + (node(i, nodes) + 1) / 2;
            const auto weights = window.weights(place / static_cast<double>(pieces_));
            for (std::size_t n = 0; n < nodes; ++n)
                for (std::size_t j = 0; j < width_; ++j) sums[n][j] += shares[n][i] * weights[j];
        }
        for (std::size_t n = 0; n < nodes; ++n)
            for (std::size_t k = 0; k <= n; ++k)
                for (std::size_t j = 0; j < width_; ++j)
                    coefficient(piece, degree() - k, j) += chebyshev[n][k] * sums[n][j];
    }
}

}  // namespace stipple
