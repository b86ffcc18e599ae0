// SPDX-License-Identifier: MIT
#include "analyzers/uniformity/kolmogorov.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/machine/wide.hpp"
#include "math/functions/distributions.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"

namespace stipple::analyzers {
namespace {

using std::numbers::pi;

/// A square matrix times 2^exponent.
struct Scaled {
    std::size_t size = 0;
    std::vector<double> at;  ///< elements, row by row
    double exponent = 0;
};

/// Scales the numbers by a power of two so that the largest is near 1.
void rescale(std::vector<double>& numbers, double& exponent) {
    int power = 0;
    std::frexp(*std::ranges::max_element(numbers), &power);
    for (double& x : numbers) x = std::ldexp(x, -power);
    exponent += power;
}

STIPPLE_WIDE void add_multiple(double* row, double factor, const double* other, std::size_t size) {
    for (std::size_t j = 0; j < size; ++j) row[j] += factor * other[j];
}

Scaled squared(const Scaled& a, const RunContext& run) {
    const std::size_t m = a.size;
    Scaled out{m, std::vector<double>(m * m), 2 * a.exponent};
    for (std::size_t i = 0; i < m; ++i) {
        run.check_stop();
        for (std::size_t k = 0; k < m; ++k)
            add_multiple(&out.at[i * m], a.at[i * m + k], &a.at[k * m], m);
    }
    rescale(out.at, out.exponent);
    return out;
}

std::vector<double> times(const std::vector<double>& row, const Scaled& a) {
    std::vector<double> out(a.size);
    for (std::size_t k = 0; k < a.size; ++k)
        add_multiple(out.data(), row[k], &a.at[k * a.size], a.size);
    return out;
}

/// Transition matrix of Marsaglia, Tsang and Wang for n D = k - h, k an integer, 0 < h <= 1.
Scaled transitions(std::size_t k, double h) {
    const std::size_t m = 2 * k - 1;
    Scaled a{m, std::vector<double>(m * m), 0};
    std::vector<double> inverse(m + 1, 1);  // 1 / r!
    for (std::size_t r = 1; r <= m; ++r) inverse[r] = inverse[r - 1] / static_cast<double>(r);
    for (std::size_t i = 0; i < m; ++i)
        for (std::size_t j = 0; j <= std::min(i + 1, m - 1); ++j)
            a.at[i * m + j] = inverse[i + 1 - j];
    double power = 1;
    for (std::size_t i = 0; i < m; ++i) {
        power *= h;  // h^(i + 1)
        a.at[i * m] -= power * inverse[i + 1];
        a.at[(m - 1) * m + (m - 1 - i)] -= power * inverse[i + 1];
    }
    if (2 * h > 1) a.at[(m - 1) * m] += whole_power(2 * h - 1, m) * inverse[m];
    return a;
}

/// Sum over all integers k of term(q^2) exp(-q^2 / (2 z^2)), where q = pi (k + offset).
template <class F>
double theta_sum(double z, double offset, const F& term) {
    double sum = 0;
    for (int k = 0; k < 1000; ++k) {
        const double q = pi * (k + offset);
        const double weight = exponential(-q * q / (2 * z * z));
        if (weight == 0) break;
        // The terms for k and -k - 1 (offset 1/2), or for k and -k (offset 0), are equal.
        sum += (offset > 0 || k > 0 ? 2 : 1) * weight * term(q * q);
    }
    return sum;
}

}  // namespace

double kolmogorov_exact(std::uint64_t n, double x, const RunContext& run) {
    const auto count = static_cast<double>(n);
    const double reach = count * x;
    if (2 * reach <= 1) return 0;
    if (x >= 1) return 1;
    const auto k = static_cast<std::size_t>(reach) + 1;
    Scaled power = transitions(k, static_cast<double>(k) - reach);
    std::vector<double> row(power.size);
    row[k - 1] = 1;
    double exponent = 0;
    for (std::uint64_t bits = n;;) {
        if (bits & 1) {
            row = times(row, power);
            exponent += power.exponent;
            rescale(row, exponent);
        }
        bits >>= 1;
        if (bits == 0) break;
        power = squared(power, run);
    }
    const double factor = log_excess(count) - count;  // ln(n! / n^n)
    return std::min(1.0, row[k - 1] * exponential(exponent * std::numbers::ln2 + factor));
}

double kolmogorov_expansion(std::uint64_t n, double x) {
    const double root = std::sqrt(static_cast<double>(n));
    const double z = root * x;
    const double z2 = z * z;
    const double z4 = z2 * z2;
    const double z6 = z4 * z2;
    const double scale = std::sqrt(pi / 2);
    const double k0 = std::sqrt(2 * pi) / z * theta_sum(z, 0.5, [](double) { return 0.5; });
    const double k1 = scale / (6 * z4) * theta_sum(z, 0.5, [&](double q) { return q - z2; });
    const double k2 =
        scale / (72 * z6 * z) *
            theta_sum(z, 0.5,
                      [&](double q) {
                          return 6 * z6 + 2 * z4 + q * (2 * z4 - 5 * z2) + q * q * (1 - 2 * z2);
                      }) -
        scale / (36 * z2 * z) * theta_sum(z, 0, [](double q) { return q; });
    const double k3 =
        scale / (6480 * z6 * z4) *
            theta_sum(z, 0.5,
                      [&](double q) {
                          return q * q * q * (5 - 30 * z2) + q * q * (-60 * z2 + 212 * z4) +
                                 q * (135 * z4 - 96 * z6) - 30 * z6 - 90 * z4 * z4;
                      }) +
        scale / (216 * z6) * theta_sum(z, 0, [&](double q) { return -q * q + 3 * q * z2; });
    return std::clamp(k0 + (k1 + (k2 + k3 / root) / root) / root, 0.0, 1.0);
}

double smirnov_upper(std::uint64_t n, double x) {
    const auto count = static_cast<double>(n);
    if (x <= 0) return 1;
    if (x >= 1) return 0;
    constexpr std::uint64_t most_terms = 1'000'000;
    if (n > most_terms) {
        const double t = 6 * count * x + 1;
        return exponential(-t * t / (18 * count));
    }
    const double whole = log_factorial(count);
    double sum = 0;
    for (double j = 0; j < count * (1 - x); ++j) {
        const double above = x + j / count;
        const double below = 1 - above;
        if (below <= 0) break;
        sum += exponential(whole - log_factorial(j) - log_factorial(count - j) +
                           (j - 1) * logarithm(above) + (count - j) * logarithm(below));
    }
    return std::min(1.0, x * sum);
}

Tails kolmogorov_tails(std::uint64_t n, double statistic, const RunContext& run) {
    const auto count = static_cast<double>(n);
    if (count * statistic * statistic > 4) {
        const double upper = std::min(1.0, 2 * smirnov_upper(n, statistic));
        return {.upper = upper, .lower = 1 - upper};
    }
    constexpr double widest = 200;
    const double lower = count * statistic <= widest ? kolmogorov_exact(n, statistic, run)
                                                     : kolmogorov_expansion(n, statistic);
    return {.upper = 1 - lower, .lower = lower};
}

}  // namespace stipple::analyzers
