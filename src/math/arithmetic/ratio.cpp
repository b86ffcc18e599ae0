// SPDX-License-Identifier: MIT
#include "math/arithmetic/ratio.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/machine/wide.hpp"
#include "core/rng.hpp"

namespace stipple {
namespace {

int bit_width(Wide x) {
    const auto high = static_cast<std::uint64_t>(x >> 64);
    return high != 0 ? 64 + static_cast<int>(std::bit_width(high))
                     : static_cast<int>(std::bit_width(static_cast<std::uint64_t>(x)));
}

/// Number of quotients computed in a buffer before they are copied: strided stores would keep
/// compilers from vectorising the divisions.
constexpr std::size_t side_by_side = 128;

STIPPLE_WIDE void divide(const double* numbers, double factor, double term, double whole,
                         std::size_t count, double* quotients) {
    for (std::size_t j = 0; j < count; ++j) quotients[j] = (numbers[j] * factor + term) / whole;
}

constexpr std::array<double, side_by_side> from_0() {
    std::array<double, side_by_side> numbers{};
    for (std::size_t j = 1; j < side_by_side; ++j) numbers[j] = numbers[j - 1] + 1;
    return numbers;
}

}  // namespace

double detail::wide_ratio(Wide numerator, Wide denominator) {
    if (numerator == 0) return 0;
    // The quotient has 55 or 56 bits, at least two more than a double. The remainder becomes a
    // sticky bit below them, so that only the conversion to double rounds.
    const int shift = bit_width(denominator) - bit_width(numerator) + 55;
    const Wide scaled = numerator << shift;
    const auto quotient = static_cast<std::uint64_t>(scaled / denominator);
    const std::uint64_t sticky = scaled % denominator != 0;
    const double rounded = std::ldexp(static_cast<double>(quotient << 1 | sticky), -(shift + 1));
    return std::min(rounded, one_minus_ulp);
}

void fill_quotients(std::span<const double> numbers, double factor, double term, double whole,
                    double* x, std::size_t stride) {
    if (stride == 1) return divide(numbers.data(), factor, term, whole, numbers.size(), x);
    std::array<double, side_by_side> quotients;
    for (std::size_t at = 0; at < numbers.size(); at += side_by_side) {
        const auto part = numbers.subspan(at, std::min(side_by_side, numbers.size() - at));
        divide(part.data(), factor, term, whole, part.size(), quotients.data());
        for (std::size_t j = 0; j < part.size(); ++j) x[(at + j) * stride] = quotients[j];
    }
}

void fill_ratios(Wide first, Wide step, Wide whole, std::size_t count, double* x,
                 std::size_t stride) {
    if (whole > exact_limit) {
        for (std::size_t j = 0; j < count; ++j) x[j * stride] = ratio(first + step * j, whole);
        return;
    }
    // Numerators and denominator are integers of at most 2^53: only the division rounds.
    const auto number = [](Wide y) { return static_cast<double>(static_cast<std::uint64_t>(y)); };
    static constexpr auto counted = from_0();
    for (std::size_t at = 0; at < count; at += side_by_side)
        fill_quotients(std::span(counted).first(std::min(side_by_side, count - at)), number(step),
                       number(first + step * at), number(whole), x + at * stride, stride);
}

}  // namespace stipple
