// SPDX-License-Identifier: MIT
#include "math/functions/radians.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <utility>

#include "core/machine/int128.hpp"

namespace stipple {
namespace {

/// The first 1280 binary digits of 1 / (2 pi) after the point.
constexpr std::array<std::uint64_t, 20> per_radian = {
    0x28be60db9391054a, 0x7f09d5f47d4d3770, 0x36d8a5664f10e410, 0x7f9458eaf7aef158,
    0x6dc91b8e909374b8, 0x01924bba82746487, 0x3f877ac72c4a69cf, 0xba208d7d4baed121,
    0x3a671c09ad17df90, 0x4e64758e60d4ce7d, 0x272117e2ef7e4a0e, 0xc7fe25fff7816603,
    0xfbcbc462d6829b47, 0xdb4d9fb3c9f2c26d, 0xd3d18fd9a797fa8b, 0x5d49eeb1faf97c5e,
    0xcf41ce7de294a4ba, 0x9afed7ec47e35742, 0x1580cc11bf1edaea, 0xfc33ef0826bd0d87};

/// 64 binary digits of 1 / (2 pi), from number `first` on; digits before the point are 0.
std::uint64_t digits_from(int first) {
    if (first <= -64) return 0;
    if (first < 0) return per_radian[0] >> -first;
    const auto at = static_cast<std::size_t>(first / 64);
    const int shift = first % 64;
    if (shift == 0) return per_radian[at];
    return per_radian[at] << shift | per_radian[at + 1] >> (64 - shift);
}

/// The part of size / (2 pi) after the point, in units of 2^-128; size >= 2^-11.
Uint128 turn_of(double size) {
    const auto bits = std::bit_cast<std::uint64_t>(size);
    const int exponent = static_cast<int>(bits >> 52) - 1075;
    const std::uint64_t whole = (bits & 0xfffffffffffffULL) | 0x10000000000000ULL;
    // size = whole 2^exponent. Digits of 1 / (2 pi) before number `exponent` give whole turns.
    const Uint128 low = wide_product(whole, digits_from(exponent + 128));
    const Uint128 middle = wide_product(whole, digits_from(exponent + 64));
    const Uint128 high = whole * digits_from(exponent);
    return (high << 64) + middle + high_half(low);
}

}  // namespace

CosSin precise_cos_sin(double angle) {
    const double size = std::abs(angle);
    double t = size / (2 * std::numbers::pi);
    unsigned quarter = 0;
    if (t > 0.125) {
        const Uint128 turn = turn_of(size);
        quarter = static_cast<unsigned>((turn + (Uint128{1} << 125)) >> 126);
        const auto rest = static_cast<Int128>(turn - (static_cast<Uint128>(quarter) << 126));
        t = static_cast<double>(rest) * 0x1p-128;
    }
    auto [cos, sin] = cos_sin_eighth(t);
    if ((quarter & 1) != 0) {
        std::swap(cos, sin);
        cos = -cos;
    }
    if ((quarter & 2) != 0) {
        cos = -cos;
        sin = -sin;
    }
    return {cos, angle < 0 ? -sin : sin};
}

}  // namespace stipple
