// SPDX-License-Identifier: MIT
#include "math/fourier/interpolator.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <complex>
#include <numbers>

namespace stipple {
namespace {

constexpr std::size_t max_nodes = WeightTable::degree_of(Interpolator::max_width) + 1;
using Square = std::array<std::array<double, max_nodes>, max_nodes>;

/// The i-th of so many Chebyshev nodes.
double node(std::size_t i, std::size_t count) {
    return std::cos(std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(count));
}

/// [n][k]: the coefficient of t^k of T_n.
Square chebyshev_polynomials(std::size_t count) {
    Square c{};
    c[0][0] = 1;
    for (std::size_t n = 1; n < count; ++n)  // T_(n+1) = 2 t T_n - T_(n-1), and T_1 = t
        for (std::size_t k = 0; k < count; ++k)
            c[n][k] =
                (k == 0 ? 0 : (n == 1 ? 1 : 2) * c[n - 1][k - 1]) - (n == 1 ? 0 : c[n - 2][k]);
    return c;
}

/// [n][i]: what a value at the i-th Chebyshev node adds to the coefficient of T_n.
Square interpolation(std::size_t count) {
    Square shares{};
    for (std::size_t n = 0; n < count; ++n)
        for (std::size_t i = 0; i < count; ++i)
            shares[n][i] = (n == 0 ? 1 : 2) / static_cast<double>(count) *
                           std::cos(static_cast<double>(n) * std::acos(node(i, count)));
    return shares;
}

/// Distance from the middle of the weights to the first of an even or odd part's.
double first_distance(std::size_t width, bool odd) {
    return width % 2 == 0 ? 0.5 : odd ? 1.0 : 0.0;
}

}  // namespace

Interpolator::Interpolator(std::size_t width, double band, double shape)
    : width_(width),
      band_(band),
      beta_(shape * std::numbers::pi * static_cast<double>(width) * (1 - band)),
      scale_(1 / std::cyl_bessel_i(0.0, beta_)) {
    assert(width >= min_width && width <= max_width && band > 0 && band < 0.5);
    // As Chebyshev nodes of the whole band, so that errors at its ends are no larger.
    for (std::size_t i = 0; i < samples(); ++i)
        frequency_[i] = band * std::sin(std::numbers::pi / 2 * (static_cast<double>(i) + 0.5) /
                                        static_cast<double>(samples()));
    even_ = part(false);
    odd_ = part(true);
    error_ = largest_error();
}

double Interpolator::scaling(double xi) const {
    const double omega = std::numbers::pi * static_cast<double>(width_) * xi;
    const double square = (beta_ - omega) * (beta_ + omega);
    const double s = std::sqrt(std::abs(square));
    const double shape = square > 0 ? std::sinh(s) / s : std::sin(s) / s;
    return static_cast<double>(width_) * shape * scale_;
}

double Interpolator::expected_error(std::size_t width, double band) {
    return 3 * std::exp(-std::numbers::pi * static_cast<double>(width) * std::sqrt(1 - 2 * band));
}

/// The equations determine some weights worse than rounding lets, so that others hold weights back,
/// with a force that changes nothing else.
Interpolator::Part Interpolator::part(bool odd) const {
    Part part;
    part.terms = odd ? width_ / 2 : (width_ + 1) / 2;
    const double force = std::max(2e-15, 0.01 * expected_error(width_, band_));
    for (std::size_t k = 0; k < part.terms; ++k) {
        const double distance = first_distance(width_, odd) + static_cast<double>(k);
        for (std::size_t i = 0; i < samples(); ++i) {
            const double turn = 2 * std::numbers::pi * frequency_[i] * distance;
            part.q[k][i] = (odd ? std::sin(turn) : std::cos(turn)) / scaling(frequency_[i]);
        }
        part.q[k][samples() + k] = force;
    }
    part.factorise(samples() + part.terms);
    return part;
}

void Interpolator::Part::factorise(std::size_t used) {
    std::array<Column, max_terms> mirrors{};  // of length 1
    const auto reflect = [&](std::size_t k, Column& column) {
        double dot = 0;
        for (std::size_t i = k; i < used; ++i) dot += mirrors[k][i] * column[i];
        for (std::size_t i = k; i < used; ++i) column[i] -= 2 * dot * mirrors[k][i];
    };
    for (std::size_t k = 0; k < terms; ++k) {
        for (std::size_t l = 0; l < k; ++l) reflect(l, q[k]);
        for (std::size_t l = 0; l < k; ++l) r[l][k] = q[k][l];
        double square = 0;
        for (std::size_t i = k; i < used; ++i) square += q[k][i] * q[k][i];
        r[k][k] = -std::copysign(std::sqrt(square), q[k][k]);
        const double head = q[k][k] - r[k][k];
        const double length = std::sqrt(square - q[k][k] * q[k][k] + head * head);
        mirrors[k][k] = head / length;
        for (std::size_t i = k + 1; i < used; ++i) mirrors[k][i] = q[k][i] / length;
    }
    for (std::size_t k = 0; k < terms; ++k) {
        q[k] = {};
        q[k][k] = 1;
        for (std::size_t l = terms; l-- > 0;) reflect(l, q[k]);
    }
}

void Interpolator::Part::solve(const std::array<double, max_samples>& aim,
                               std::array<double, max_terms>& solution) const {
    for (std::size_t k = terms; k-- > 0;) {
        double rest = 0;
        for (std::size_t i = 0; i < max_samples; ++i) rest += q[k][i] * aim[i];
        for (std::size_t l = k + 1; l < terms; ++l) rest -= r[k][l] * solution[l];
        solution[k] = rest / r[k][k];
    }
}

std::array<double, Interpolator::max_width> Interpolator::weights(double u) const {
    std::array<double, max_samples> even_aim{};
    std::array<double, max_samples> odd_aim{};
    for (std::size_t i = 0; i < samples(); ++i) {
        const double turn = 2 * std::numbers::pi * frequency_[i] * (u - 0.5);
        even_aim[i] = std::cos(turn);
        odd_aim[i] = std::sin(turn);
    }
    std::array<double, max_terms> even{};
    std::array<double, max_terms> odd{};
    even_.solve(even_aim, even);
    odd_.solve(odd_aim, odd);
    std::array<double, max_width> weights{};
    const std::size_t half = width_ / 2;
    const std::size_t middle = width_ % 2;
    if (middle == 1) weights[half] = even[0];
    for (std::size_t k = 0; k < half; ++k) {
        weights[half + middle + k] = (even[middle + k] + odd[k]) / 2;
        weights[half - 1 - k] = (even[middle + k] - odd[k]) / 2;
    }
    return weights;
}

double Interpolator::largest_error() const {
    constexpr std::size_t places = 6;       // between two grid points; the error is smooth there
    const auto place = [](std::size_t p) {  // symmetric about 1/2
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

Interpolator interpolator_for(double tolerance, double band) {
    std::size_t width = Interpolator::min_width;
    while (Interpolator::expected_error(width, band) > 3 * tolerance &&
           width < Interpolator::max_width)
        ++width;
    // Which shape is best goes up and down with the band and the width.
    constexpr std::array shapes{0.965, 0.985, 0.95};
    constexpr double hopeless = 1.6;  // times the best shape's error, of any other one
    for (;; ++width) {
        Interpolator first(width, band, shapes[0]);
        if (first.error() <= tolerance || width == Interpolator::max_width) return first;
        if (first.error() > hopeless * tolerance) continue;
        for (std::size_t i = 1; i < shapes.size(); ++i) {
            Interpolator other(width, band, shapes[i]);
            if (other.error() <= tolerance) return other;
        }
    }
}

WeightTable::WeightTable(const Interpolator& interpolator)
    : width_(interpolator.width()), pieces_(2) {
    // The error of polynomials through the Chebyshev nodes of a piece for waves of the band, to
    // which that of the weights comes in the end.
    constexpr std::size_t most_pieces = 64;  // there is no gain beyond: values are rounded, too
    const double allowed = std::max(0.05 * interpolator.error(), 1e-15);
    const auto terms = static_cast<double>(degree() + 1);
    const auto error = [&] {
        const double turn = std::numbers::pi * interpolator.band() / static_cast<double>(pieces_);
        return 2 * std::pow(turn / 2, terms) / std::tgamma(terms + 1);
    };
    while (pieces_ < most_pieces && error() > allowed) pieces_ *= 2;
    rows_.assign(pieces_ * (degree() + 1) * row_of(width_) / 8, {});
    const std::size_t nodes = degree() + 1;
    const Square shares = interpolation(nodes);
    const Square chebyshev = chebyshev_polynomials(nodes);
    for (std::size_t piece = 0; piece < pieces_; ++piece) {
        std::array<std::array<double, Interpolator::max_width>, max_nodes> sums{};  // of T_n
        for (std::size_t i = 0; i < nodes; ++i) {
            const double place = static_cast<double>(piece) + (node(i, nodes) + 1) / 2;
            const auto weights = interpolator.weights(place / static_cast<double>(pieces_));
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
