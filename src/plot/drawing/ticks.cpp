// SPDX-License-Identifier: MIT
#include "plot/drawing/ticks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::plot {
namespace {

double size_of(double low, double high) { return std::max(std::abs(low), std::abs(high)); }

std::string with_minus(std::string text) {
    replace_all(text, "-", "−");
    return text;
}

std::string raised(int exponent) {
    constexpr std::array<const char*, 10> digits = {"⁰", "¹", "²", "³", "⁴",
                                                    "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text;
    for (const char c : std::to_string(exponent))
        text += c == '-' ? "⁻" : digits[static_cast<std::size_t>(c - '0')];
    return text;
}

/// 10^exponent, rounded to the nearest double.
double ten_to(int exponent) {
    return exponent >= 0 ? std::pow(10.0, exponent) : 1 / std::pow(10.0, -exponent);
}

/// A step of 1, 2 or 5 times a power of ten, by its number: 0 is 1, 1 is 2, 2 is 5, 3 is 10.
struct Step {
    int number;
    [[nodiscard]] int exponent() const { return static_cast<int>(std::floor(number / 3.0)); }
    [[nodiscard]] double value() const {
        constexpr std::array digits = {1, 2, 5};
        return digits[static_cast<std::size_t>(number - 3 * exponent())] * ten_to(exponent());
    }
};

Step step_at_least(double least) {
    Step step{3 * static_cast<int>(std::floor(std::log10(least)))};
    while (step.value() < least * (1 - 1e-9)) ++step.number;
    return step;
}

/// First and last multiple of the step in [low, high], in units of the step.
std::pair<double, double> multiples(double low, double high, double step) {
    constexpr double slack = 1e-9;
    return {std::ceil(low / step - slack), std::floor(high / step + slack)};
}

/// Selects the integers that get labels.
struct Numbered {
    double from;
    double stride;
    [[nodiscard]] bool operator()(double k) const { return std::fmod(k - from, stride) == 0; }
};

/// Selects at most `most` of the integers first..last, but at least two if possible: multiples of a
/// stride if there are two such multiples, otherwise `first` and every stride from it.
Numbered spread(double first, double last, std::size_t most) {
    const double stride = std::floor((last - first) / static_cast<double>(most)) + 1;
    const double from = std::ceil(first / stride) * stride;
    return {from + stride <= last ? from : first, stride};
}

/// Adds ticks at powers of ten; if there are more than `most`, only every 2nd, 3rd, ... has a
/// number.
void add_decades(double low, double high, std::size_t most, Ticks& ticks) {
    const int first = static_cast<int>(std::ceil(std::log10(low) - 1e-9));
    const int last = static_cast<int>(std::floor(std::log10(high) + 1e-9));
    if (first >= last) return;
    const Numbered numbered = spread(first, last, most);
    const bool plain = first >= -3 && last <= 4;
    for (int k = first; k <= last; ++k) {
        if (!numbered(k))
            ticks.minor.push_back(ten_to(k));
        else
            ticks.numbers.push_back(
                {ten_to(k), plain ? printed(ten_to(k), std::max(0, -k)) : power_of_ten(k)});
    }
    if (numbered.stride > 1) return;
    for (int k = first - 1; k <= last; ++k)
        for (int digit = 2; digit < 10; ++digit) {
            const double value = digit * ten_to(k);
            if (value >= low && value <= high) ticks.minor.push_back(value);
        }
}

/// Replaces the ticks by digits times powers of ten, for ranges with few powers of ten.
void add_digits(double low, double high, std::size_t most, Ticks& ticks) {
    ticks.minor.clear();
    const auto digits =
        high / low > 6 ? std::vector<int>{1, 2, 5} : std::vector<int>{1, 2, 3, 4, 5, 6, 7, 8, 9};
    std::vector<Tick> numbers;
    const int first = static_cast<int>(std::floor(std::log10(low)));
    for (int k = first; ten_to(k) <= high; ++k)
        for (int digit = 1; digit < 10; ++digit) {
            const double value = digit * ten_to(k);
            if (value < low * (1 - 1e-9) || value > high * (1 + 1e-9)) continue;
            if (std::ranges::find(digits, digit) == digits.end()) {
                ticks.minor.push_back(value);
                continue;
            }
            const bool plain = k >= -3 && k <= 4;
            const std::string power = power_of_ten(k);
            numbers.push_back({value, plain        ? printed(value, std::max(0, -k))
                                      : digit == 1 ? power
                                                   : fmt::format("{}×{}", digit, power)});
        }
    if (numbers.size() <= most) ticks.numbers = std::move(numbers);
}

}  // namespace

void require_shown(double low, double high) {
    if (!std::isfinite(low) || !std::isfinite(high) || size_of(low, high) <= most_shown) return;
    fail(ErrorKind::input, "the numbers range from {} to {}; an axis can show {} to {}",
         format_number(low), format_number(high), format_number(-most_shown),
         format_number(most_shown));
}

std::string flaw_of_range(double low, double high, int digits) {
    if (!(low < high)) return {};
    if (high - low < least_shown) return fmt::format("differs by less than {}", least_shown);
    if (high - low < size_of(low, high) * ten_to(-digits))
        return fmt::format("all the same to {} digits", digits);
    return {};
}

std::pair<double, double> visible_range(double low, double high, int digits) {
    if (low < high && flaw_of_range(low, high, digits).empty()) return {low, high};
    const double size = size_of(low, high);
    const double reach = size < least_shown ? 0.5 : 0.5 * size;
    return {low - reach, high + reach};
}

std::string printed(double value, int digits_after_point) {
    const std::string text = fmt::format("{:.{}f}", value, digits_after_point);
    const bool zero = text.find_first_not_of("-0.") == std::string::npos;
    return with_minus(zero && text[0] == '-' ? text.substr(1) : text);
}

std::string rounded(double value, int digits) {
    return with_minus(fmt::format("{:.{}g}", value + 0.0, digits));  // 0 for -0
}

std::pair<std::string, std::string> rounded_ends(double low, double high, int digits) {
    const double ratio = size_of(low, high) / (high - low);
    const int more = ratio > 1 ? static_cast<int>(std::log10(ratio)) : 0;
    const int all = std::min(digits + more, 17);
    return {rounded(low, all), rounded(high, all)};
}

std::string power_of_ten(int exponent) { return "10" + raised(exponent); }

Ticks linear_ticks(double low, double high, std::size_t most, bool whole) {
    if (!(low < high) || !flaw_of_range(low, high).empty()) return {};
    most = std::max<std::size_t>(most, 2);
    Step step = step_at_least((high - low) / static_cast<double>(most));
    if (whole && step.number < 0) step.number = 0;
    auto [first, last] = multiples(low, high, step.value());
    while (last - first + 1 > static_cast<double>(most)) {
        ++step.number;
        std::tie(first, last) = multiples(low, high, step.value());
    }
    // A single number shows no scale: uses the next finer step.
    if (first >= last && !(whole && step.value() <= 1)) {
        --step.number;
        std::tie(first, last) = multiples(low, high, step.value());
    }
    const Numbered numbered = spread(first, last, most);
    Ticks ticks;
    const double largest = size_of(low, high);
    if (largest >= 1e5 || largest < 1e-2)
        ticks.exponent = static_cast<int>(std::floor(std::log10(largest)));
    const int digits = std::max(0, ticks.exponent - step.exponent());
    for (double k = first; k <= last; ++k) {
        const double value = k * step.value();
        if (numbered(k))
            ticks.numbers.push_back({value, printed(value / ten_to(ticks.exponent), digits)});
    }
    return ticks;
}

Ticks binary_ticks(double low, double high, std::size_t most) {
    constexpr int plain = 16;  // up to 2^16, numbers are written out
    const double first = std::ceil(std::log2(low) - 1e-9);
    const double last = std::floor(std::log2(high) + 1e-9);
    const Numbered numbered = spread(first, last, most);
    Ticks ticks;
    for (double k = first; k <= last; ++k) {
        const int exponent = static_cast<int>(k);
        if (!numbered(k))
            ticks.minor.push_back(std::exp2(k));
        else
            ticks.numbers.push_back({std::exp2(k), k >= 0 && last <= plain
                                                       ? printed(std::exp2(k), 0)
                                                       : "2" + raised(exponent)});
    }
    return ticks;
}

Ticks log_ticks(double low, double high, std::size_t most) {
    Ticks ticks;
    add_decades(low, high, most, ticks);
    if (ticks.numbers.size() < 3 && high / low < 200) add_digits(low, high, most, ticks);
    if (ticks.numbers.size() < 2) return linear_ticks(low, high, most);
    return ticks;
}

}  // namespace stipple::plot
