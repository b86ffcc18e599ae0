// SPDX-License-Identifier: MIT
#include "math/functions/normal_distribution.hpp"

#include <cstdint>
#include <numbers>

#include "core/machine/wide.hpp"
#include "math/arithmetic/double_double.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/horner.hpp"

namespace stipple {
namespace {

/// erf(x) / x as a function of xx = x^2, for x <= 15/32.
double central_ratio(double xx) {
    return horner(xx, 1.85777706184603153e-1, 3.16112374387056560e0, 1.13864154151050156e2,
                  3.77485237685302021e2, 3.20937758913846947e3) /
           horner(xx, 1.0, 2.36012909523441209e1, 2.44024637934444173e2, 1.28261652607737228e3,
                  2.84423683343917062e3);
}

/// erfc(x) exp(x^2) for x in [15/32, 4].
double middle_ratio(double x) {
    return horner(x, 2.15311535474403846e-8, 5.64188496988670089e-1, 8.88314979438837594e0,
                  6.61191906371416295e1, 2.98635138197400131e2, 8.81952221241769090e2,
                  1.71204761263407058e3, 2.05107837782607147e3, 1.23033935479799725e3) /
           horner(x, 1.0, 1.57449261107098347e1, 1.17693950891312499e2, 5.37181101862009858e2,
                  1.62138957456669019e3, 3.29079923573345963e3, 4.36261909014324716e3,
                  3.43936767414372164e3, 1.23033935480374942e3);
}

/// erfc(x) exp(x^2) for x >= 4.
double far_ratio(double x) {
    const double y = 1 / (x * x);
    const double ratio =
        horner(y, 1.63153871373020978e-2, 3.05326634961232344e-1, 3.60344899949804439e-1,
               1.25781726111229246e-1, 1.60837851487422766e-2, 6.58749161529837803e-4) /
        horner(y, 1.0, 2.56852019228982242e0, 1.87295284992346725e0, 5.27905102951428412e-1,
               6.05183413124413191e-2, 2.33520497626869185e-3);
    return (std::numbers::inv_sqrtpi - y * ratio) / x;
}

constexpr std::size_t numbers_at_once = 128;

/// Computes quantiles outside the far tails. Returns false if some p is in one; then the caller
/// computes the batch again. 16-bit marks, many in a vector, let many chains of operations run in
/// parallel; Clang needs a pragma for that.
STIPPLE_WIDE [[gnu::flatten]] bool quantiles(const double* p, double* x, std::size_t count) {
    constexpr double far = 1.4e-11;  // a little above exp(-25)
    std::array<std::uint16_t, numbers_at_once> marks;
#ifdef __clang__
#pragma clang loop interleave_count(8)
#endif
    for (std::size_t i = 0; i < count; ++i) {
        const double tail = detail::bounded_tail(p[i]);
        marks[i] = tail < far ? 1 : 0;
        x[i] = detail::near_normal_quantile(p[i] - 0.5, tail);
    }
    std::uint16_t left = 0;
    for (std::size_t i = 0; i < count; ++i) left = static_cast<std::uint16_t>(left | marks[i]);
    return left == 0;
}

}  // namespace

double normal_distribution(double z) {
    const double size = std::min(std::abs(z), 40.0);  // Phi is 0 or 1 beyond, up to rounding
    const double x = size * (std::numbers::sqrt2 / 2);
    if (x <= 15 / 32.0) return 0.5 + 0.5 * std::copysign(x, z) * central_ratio(0.5 * size * size);
    const auto [square, rest] = split_product(size, size);
    const double power = exponential(-0.5 * square);
    const double factor = 0.5 * (x <= 4 ? middle_ratio(x) : far_ratio(x));
    const double tail = factor * (power - power * (0.5 * rest));
    return z < 0 ? tail : 1 - tail;
}

double error_function(double x) {
    if (std::abs(x) <= 15 / 32.0) return x * central_ratio(x * x);
    return std::copysign(1 - 2 * normal_distribution(-std::numbers::sqrt2 * std::abs(x)), x);
}

void bounded_normal_quantiles(std::span<double> p) {
    std::array<double, numbers_at_once> x;
    for (std::size_t first = 0; first < p.size(); first += numbers_at_once) {
        const auto some = p.subspan(first, std::min(numbers_at_once, p.size() - first));
        const bool done = quantiles(some.data(), x.data(), some.size());
        for (std::size_t i = 0; i < some.size(); ++i)
            some[i] = done ? x[i] : bounded_normal_quantile(some[i]);
    }
}

}  // namespace stipple
