// SPDX-License-Identifier: MIT
#include "math/functions/powers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stipple {

std::uint64_t saturating_power(std::uint64_t base, std::size_t exponent) {
    std::uint64_t value = 1;
    for (std::size_t i = 0; i < exponent && base > 1; ++i)
        if (__builtin_mul_overflow(value, base, &value))
            return std::numeric_limits<std::uint64_t>::max();
    return base == 0 && exponent > 0 ? 0 : value;
}

std::uint64_t floor_root(std::uint64_t value, std::size_t exponent) {
    if (exponent == 1) return value;
    std::uint64_t low = 1;
    std::uint64_t high = std::uint64_t{1} << 32;
    while (low < high) {
        const std::uint64_t middle = low + (high - low) / 2 + (high - low) % 2;
        // A saturated power exceeds every value, even the largest 64-bit number.
        const std::uint64_t power = saturating_power(middle, exponent);
        if (power <= value && power != std::numeric_limits<std::uint64_t>::max())
            low = middle;
        else
            high = middle - 1;
    }
    return low;
}

std::uint64_t nearest_power(std::uint64_t value, std::size_t exponent) {
    const std::uint64_t k = floor_root(value, exponent);
    const std::uint64_t below = saturating_power(k, exponent);
    const std::uint64_t above = saturating_power(k + 1, exponent);
    return value - below <= above - value ? below : above;
}

std::uint64_t rounded_root(std::uint64_t value) {
    const std::uint64_t k = floor_root(value, 2);
    return value - k * k > k ? k + 1 : k;  // rounds up if value > (k + 1/2)^2 = k^2 + k + 1/4
}

double unit_for(double size) {
    if (!(size > 0 && std::isfinite(size))) return 1;
    return std::ldexp(1.0, std::clamp(std::ilogb(size), -1022, 1022));
}

double unit_for(std::span<const double> numbers) {
    double largest = 0;
    for (const double x : numbers) largest = std::max(largest, std::abs(x));
    return unit_for(largest);
}

double real_power_of(std::size_t base, std::size_t exponent) {
    return whole_power(static_cast<double>(base), exponent);
}

}  // namespace stipple
