// SPDX-License-Identifier: MIT
#include "io/decimal.hpp"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>

#include "core/machine/int128.hpp"

namespace stipple::io {
namespace {

constexpr std::size_t longest = 25;  // the longest text, such as "-1.2345678901234567e-308", has 24

constexpr auto small_powers_of_10 = [] {
    std::array<std::uint64_t, 20> powers{1};
    for (std::size_t i = 1; i < powers.size(); ++i) powers[i] = powers[i - 1] * 10;
    return powers;
}();

/// floor(fraction * 10^precision), exact, for `fraction` in [0, 1) and precision <= 19.
std::uint64_t cut_fraction(double fraction, int precision) {
    const auto bits = std::bit_cast<std::uint64_t>(fraction);
    const int biased = static_cast<int>(bits >> 52);
    const int shift = 1075 - std::max(biased, 1);
    if (biased == 0 || shift >= 128) return 0;
    const std::uint64_t c = (bits & ((std::uint64_t{1} << 52) - 1)) | std::uint64_t{1} << 52;
    // The product is below 2^53 * 10^19 < 2^117.
    const Uint128 product = Uint128{c} * small_powers_of_10[static_cast<std::size_t>(precision)];
    return static_cast<std::uint64_t>(product >> shift);
}

/// Appends |value|, truncated to `precision` digits after the point; for any value and precision.
void append_cut_slowly(std::string& out, double value, int precision) {
    constexpr int most_digits = 1074;  // no double has more after the point
    std::string text = fmt::format("{:.{}f}", value, std::max(precision, most_digits));
    const auto point = text.find('.');
    if (point != std::string::npos)
        text.resize(point + (precision == 0 ? 0 : 1 + static_cast<std::size_t>(precision)));
    out += text;
}

void append_cut(std::string& out, double value, int precision) {
    const auto start = out.size();
    const double size = std::abs(value);
    if (std::signbit(value)) out += '-';
    if (!(size < 0x1p53) || precision > 19) {
        append_cut_slowly(out, size, precision);
    } else {
        const double whole = std::trunc(size);
        fmt::format_to(std::back_inserter(out), FMT_COMPILE("{}"),
                       static_cast<std::uint64_t>(whole));
        if (precision > 0)
            fmt::format_to(std::back_inserter(out), FMT_COMPILE(".{:0{}}"),
                           cut_fraction(size - whole, precision), precision);
    }
    // Removes the sign if only zeros are left.
    if (std::signbit(value) && out.find_first_of("123456789in", start) == std::string::npos)
        out.erase(start, 1);
}

/// Parses a number that from_chars reports as out of range: infinity if too large, subnormal or
/// zero if too small.
double beyond_range(const char* first, const char* end) {
    return std::strtod(std::string(first, end).c_str(), nullptr);
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
