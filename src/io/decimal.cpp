// SPDX-License-Identifier: MIT
#include "io/decimal.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>
#include <langinfo.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/machine/int128.hpp"
#include "core/text.hpp"

namespace stipple::io {
namespace {

constexpr std::size_t longest = 25;  // the longest text, such as "-1.2345678901234567e-308", has 24

constexpr auto small_powers_of_10 = [] {
    std::array<std::uint64_t, 20> powers{1};
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * 10;
    return powers;
}();

/// Appends `size` >= 0 as its shortest text without an exponent, cut to `precision` digits after
/// the point. Works for any finite number and any precision.
void append_cut_slowly(std::string& out, double size, int precision) {
    std::array<char, 400> text;  // longest: 326 characters, of 2.2250738585072014e-308
    char* const begin = text.data();
    const bool plain = size >= 1e-4 && size < 1e15;  // then fmt writes no exponent, and is faster
    char* const end =
        plain ? fmt::format_to(begin, FMT_COMPILE("{}"), size)
              : std::to_chars(begin, begin + text.size(), size, std::chars_format::fixed).ptr;
    char* const point = std::find(begin, end, '.');
    out.append(begin, point);
    if (precision == 0) return;
    out += '.';
    const auto digits = std::min<std::ptrdiff_t>(precision, std::max(end - point - 1, {}));
    out.append(point + (digits > 0 ? 1 : 0), static_cast<std::size_t>(digits));
    out.append(static_cast<std::size_t>(precision - digits), '0');
}

/// As append_cut_slowly() for most numbers; for others returns false and appends nothing.
bool append_cut_fast(std::string& out, double size, int precision) {
    if (!(size < 0x1p53) || precision > 19) return false;
    const auto bits = std::bit_cast<std::uint64_t>(size);
    const int biased = static_cast<int>(bits >> 52);
    const std::uint64_t implicit = std::uint64_t{biased > 0} << 52;
    // size = c / 2^shift. If shift > 120, size < 2^-67, so that the first 19 digits are 0.
    const std::uint64_t c = (bits & ((std::uint64_t{1} << 52) - 1)) | implicit;
    const int shift = 1075 - std::max(biased, 1);
    const std::uint64_t whole = shift < 64 ? c >> shift : 0;
    std::uint64_t digits = 0;
    if (precision > 0 && shift <= 120) {
        const std::uint64_t power = small_powers_of_10[static_cast<std::size_t>(precision)];
        const Uint128 one = Uint128{1} << shift;
        const Uint128 fraction = Uint128{c} & (one - 1);
        // The product is below 2^53 * 10^19 < 2^117.
        const Uint128 product = fraction * power;
        digits = static_cast<std::uint64_t>(product >> shift);
        // Numbers within 1 / 2^(shift + 1) of `size` read back to it. If exactly one multiple of
        // 10^-precision is among them, it is the shortest text, perhaps with final zeros.
        const Uint128 twice_above = 2 * (one - (product & (one - 1)));
        if (fraction != 0 && (one <= power || twice_above == power)) return false;
        if (fraction != 0 && twice_above < power) ++digits;
    }
    fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"), whole);
    if (precision > 0)
        fmt::format_to(std::back_inserter(out), FMT_COMPILE(".{:0{}}"), digits, precision);
    return true;
}

void append_cut(std::string& out, double value, int precision) {
    const auto start = out.size();
    const double size = std::abs(value);
    if (std::signbit(value)) out += '-';
    if (!append_cut_fast(out, size, precision)) append_cut_slowly(out, size, precision);
    // Removes the sign if only zeros are left.
    if (std::signbit(value) && out.find_first_of("123456789in", start) == std::string::npos)
        out.erase(start, 1);
}

/// Parses a number that from_chars reports as out of range: infinity if too large, subnormal or
/// zero if too small.
double beyond_range(const char* first, const char* end) {
    std::string text(first, end);
    replace_all(text, ".", ::nl_langinfo(RADIXCHAR));  // as strtod() expects; safe in threads
    return std::strtod(text.c_str(), nullptr);
}

}  // namespace

void append_number(std::string& out, double value, std::optional<int> precision) {
    if (precision && std::isfinite(value)) return append_cut(out, value, *precision);
    // Formats into a buffer on the stack: appending to the string directly takes a third longer.
    std::array<char, longest> text;
    const char* const begin = text.data();
    const char* const end = fmt::format_to(text.data(), FMT_COMPILE("{}"), value);
    out.append(begin, end);
}

void append_rows(std::string& out, std::span<const double> rows, std::size_t width,
                 const RowStyle& style, std::optional<int> precision) {
    for (std::size_t i = 0; i < rows.size(); i += width) {
        for (std::size_t k = 0; k < width; ++k) {
            out += k == 0 ? style.open : style.between;
            append_number(out, rows[i + k], precision);
        }
        out += style.close;
    }
}

const char* read_number(const char* first, const char* last, double& value) {
    if (last - first > 1 && *first == '+' && first[1] != '-') ++first;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error == std::errc::invalid_argument) return nullptr;
    if (error == std::errc::result_out_of_range) value = beyond_range(first, end);
    return end;
}

}  // namespace stipple::io
