// SPDX-License-Identifier: MIT
#include "io/decimal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <clocale>
#include <cmath>
#include <limits>
#include <random>

#include "core/bytes/raw_numbers.hpp"

namespace stipple::testing::decimal_test {

using namespace stipple::io;

namespace {

std::string text(double value, std::optional<int> precision = std::nullopt) {
    std::string out = "<";
    append_number(out, value, precision);
    return out.substr(1);
}

double value_of(const std::string& text) {
    double value = -7;
    EXPECT_EQ(read_number(text.data(), text.data() + text.size(), value), text.data() + text.size())
        << text;
    return value;
}

/// Doubles of all sizes, and difficult ones: powers of two, subnormals, integers.
double interesting(std::mt19937_64& random, int kind) {
    const auto bits = random();
    switch (kind % 5) {
        case 0:
            return std::bit_cast<double>(bits);
        case 1:
            return static_cast<double>(bits >> 11) * 0x1p-53;
        case 2:
            return std::bit_cast<double>((bits % 2047) << 52 | (bits >> 60) % 3);
        case 3:
            return std::bit_cast<double>(bits >> (12 + bits % 50));
        default:
            return static_cast<double>(bits >> bits % 64) * std::pow(10.0, int(bits % 50) - 25);
    }
}

constexpr int rounds = 200'000;

}  // namespace

TEST(Decimal, ByHand) {
    EXPECT_EQ(text(0), "0");
    EXPECT_EQ(text(-0.0), "-0");
    EXPECT_EQ(text(1), "1");
    EXPECT_EQ(text(0.1), "0.1");
    EXPECT_EQ(text(1.0 / 3), "0.3333333333333333");
    EXPECT_EQ(text(-123456.75), "-123456.75");
    EXPECT_EQ(text(0.0001), "0.0001");
    EXPECT_EQ(text(0.00001), "1e-05");
    EXPECT_EQ(text(1e15), "1000000000000000");
    EXPECT_EQ(text(1e16), "1e+16");
    EXPECT_EQ(text(1.5e300), "1.5e+300");
    EXPECT_EQ(text(5e-324), "5e-324");
    EXPECT_EQ(text(std::numeric_limits<double>::max()), "1.7976931348623157e+308");
    EXPECT_EQ(text(std::numeric_limits<double>::min()), "2.2250738585072014e-308");
    EXPECT_EQ(text(1 - 0x1p-53), "0.9999999999999999");
    EXPECT_EQ(text(9007199254740993.0), "9007199254740992");
    EXPECT_EQ(text(2e22), "2e+22");
    EXPECT_EQ(text(std::numeric_limits<double>::infinity()), "inf");
    EXPECT_EQ(text(-std::numeric_limits<double>::infinity()), "-inf");
}

// Two independent programs agree on the shortest text.
TEST(Decimal, IsTheShortestTextThatReadsBack) {
    std::mt19937_64 random(1);
    for (int i = 0; i < rounds; ++i) {
        const double value = interesting(random, i);
        if (!std::isfinite(value) || value == 0) continue;
        ASSERT_EQ(text(value), fmt::format("{}", value));
    }
}

TEST(Decimal, EveryDoubleReadsBackToItsLastBit) {
    std::mt19937_64 random(2);
    for (int i = 0; i < rounds; ++i) {
        const double value = interesting(random, i);
        if (!std::isfinite(value)) continue;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(value_of(text(value))),
                  std::bit_cast<std::uint64_t>(value))
            << text(value);
    }
    EXPECT_TRUE(std::signbit(value_of(text(-0.0))));
}

// Text with any digits is rounded correctly, as by the standard library.
TEST(Decimal, ReadsAnyDigitsAsTheStandardLibraryDoes) {
    std::mt19937_64 random(3);
    for (int i = 0; i < rounds; ++i) {
        const auto digits = [&] { return random() >> random() % 64; };
        std::string number = fmt::format("{}{}", random() % 2 ? "-" : "", digits());
        if (i % 3 != 0) number += fmt::format(".{:0{}}", digits(), random() % 25);
        if (i % 2 != 0) number += fmt::format("e{}", static_cast<int>(random() % 700) - 350);
        double expected = 0;
        const auto result = std::from_chars(number.data(), number.data() + number.size(), expected);
        if (result.ec != std::errc()) continue;
        ASSERT_EQ(std::bit_cast<std::uint64_t>(value_of(number)),
                  std::bit_cast<std::uint64_t>(expected))
            << number;
    }
}

// Halfway between two doubles, and next to it: truncated products do not decide these.
TEST(Decimal, ReadsTiesToEven) {
    EXPECT_EQ(value_of("9007199254740993"), 9007199254740992.0);
    EXPECT_EQ(value_of("9007199254740995"), 9007199254740996.0);
    EXPECT_EQ(value_of("9007199254740993.0000000000000000000001"), 9007199254740994.0);
    EXPECT_EQ(value_of("9007199254740992999999999999999999999e-21"), 9007199254740992.0);
    EXPECT_EQ(value_of("1.00000000000000011102230246251565404236316680908203125"), 1.0);
    EXPECT_EQ(value_of("1.00000000000000011102230246251565404236316680908203126"), 1 + 0x1p-52);
    EXPECT_EQ(value_of("2.4703282292062327208e-324"), 0.0);
    EXPECT_EQ(value_of("2.4703282292062327209e-324"), 5e-324);
    EXPECT_EQ(value_of("1.7976931348623158e308"), std::numeric_limits<double>::max());
}

TEST(Decimal, ReadsWhatPeopleWrite) {
    EXPECT_EQ(value_of("+.5"), 0.5);
    EXPECT_EQ(value_of("5."), 5);
    EXPECT_EQ(value_of("1E3"), 1000);
    EXPECT_EQ(value_of("000000000000000000000000000.000000000000000000000000000025"), 2.5e-29);
    EXPECT_EQ(value_of("100000000000000000000000000000"), 1e29);
    EXPECT_EQ(value_of("0.333333333333333333333333333333333333"), 1.0 / 3);
    EXPECT_EQ(value_of("1e-999"), 0);
    EXPECT_EQ(value_of("1e-99999999999999999999"), 0);
    EXPECT_EQ(value_of("0e999999999999999999999"), 0);
    EXPECT_TRUE(std::isinf(value_of("1e999")));
    EXPECT_TRUE(std::isinf(value_of("-1e99999999999999999999")));
    EXPECT_TRUE(std::isnan(value_of("nan")));
    EXPECT_TRUE(std::isinf(value_of("-Infinity")));
}

TEST(Decimal, ReadsNoMoreThanTheNumber) {
    const auto length = [](std::string_view text) {
        double value = 0;
        const char* end = read_number(text.data(), text.data() + text.size(), value);
        return end == nullptr ? -1 : static_cast<int>(end - text.data());
    };
    EXPECT_EQ(length("0.5,0.25"), 3);
    EXPECT_EQ(length("12e"), 2);
    EXPECT_EQ(length("12e+"), 2);
    EXPECT_EQ(length("1.2.3"), 3);
    EXPECT_EQ(length("0x10"), 1);
    EXPECT_EQ(length("--1"), -1);
    EXPECT_EQ(length("+-1"), -1);
    EXPECT_EQ(length("-"), -1);
    EXPECT_EQ(length("."), -1);
    EXPECT_EQ(length("e5"), -1);
    EXPECT_EQ(length(""), -1);
    EXPECT_EQ(length("word"), -1);
}

TEST(Decimal, PrecisionCutsTowardZero) {
    EXPECT_EQ(text(0.9999999, 3), "0.999");
    EXPECT_EQ(text(1 - 0x1p-53, 6), "0.999999");
    EXPECT_EQ(text(1 - 0x1p-53, 15), "0.999999999999999");
    EXPECT_EQ(text(-0.9996, 3), "-0.999");
    EXPECT_EQ(text(-0.0004, 3), "0.000");
    EXPECT_EQ(text(-0.0, 2), "0.00");
    EXPECT_EQ(text(0.5, 0), "0");
    EXPECT_EQ(text(-1.5, 0), "-1");
    EXPECT_EQ(text(12.375, 2), "12.37");
    EXPECT_EQ(text(0.1, 20), "0.10000000000000000000");
    EXPECT_EQ(text(0x1p60, 1), "1152921504606846976.0");
    EXPECT_EQ(text(5e-324, 4), "0.0000");
    EXPECT_EQ(text(0.5, 1100).size(), 1102U);
    EXPECT_EQ(text(1e300, 2).size(), 304U);
}

// 0.29 is a little less than 29 / 100 as a double, but reads back from this text.
TEST(Decimal, PrecisionCutsTheShortestText) {
    EXPECT_EQ(text(0.29, 2), "0.29");
    EXPECT_EQ(text(-0.57, 2), "-0.57");
    EXPECT_EQ(text(0.29, 1), "0.2");
    EXPECT_EQ(text(4.35, 2), "4.35");
    EXPECT_EQ(text(std::nextafter(0.29, 0), 2), "0.28");
    EXPECT_EQ(text(std::nextafter(0.29, 1), 2), "0.29");
    EXPECT_EQ(text(8.41, 17), "8.41000000000000000");
    EXPECT_EQ(text(1e-7, 7), "0.0000001");
    EXPECT_EQ(text(4503599627370495.5, 1), "4503599627370495.5");
    EXPECT_EQ(text(1234, 3), "1234.000");
    EXPECT_EQ(text(122540000000, 14), "122540000000.00000000000000");
}

// Oracle: the digits of the shortest text, shifted by its exponent. Numbers from 2^53 on are whole,
// and have all their digits.
TEST(Decimal, PrecisionCutsEveryTextAndKeepsWhatItCut) {
    std::mt19937_64 random(4);
    for (int i = 0; i < rounds; ++i) {
        double value = interesting(random, i);
        if (!std::isfinite(value)) continue;
        const int precision = static_cast<int>(random() % 25);
        if (i % 3 == 0) value = value_of(text(value, precision));
        const double size = std::abs(value);
        std::string digits = size < 0x1p53 ? fmt::format("{}", size) : fmt::format("{:.0f}", size);
        const auto e = digits.find('e');
        int point = e == std::string::npos ? 0 : std::stoi(digits.substr(e + 1));
        digits.resize(std::min(e, digits.size()));
        point += static_cast<int>(std::min(digits.find('.'), digits.size()));
        std::erase(digits, '.');
        digits.insert(0, static_cast<std::size_t>(std::max(0, 1 - point)), '0');
        const auto whole = static_cast<std::size_t>(std::max(1, point));
        digits.resize(whole + std::size_t(precision), '0');
        const bool some = digits.find_first_not_of('0') != std::string::npos;
        if (precision > 0) digits.insert(whole, ".");
        if (std::signbit(value) && some) digits.insert(0, "-");
        const std::string cut = text(value, precision);
        ASSERT_EQ(cut, digits) << value << " with " << precision;
        ASSERT_EQ(text(value_of(cut), precision), cut) << value << " with " << precision;
    }
}

TEST(Decimal, RowsAreFramedAndSeparated) {
    std::string out = "head\n";
    append_rows(out, std::vector<double>{0, 0.5, -1, 1e-7}, 2, {"[", ", ", "]\n"});
    EXPECT_EQ(out, "head\n[0, 0.5]\n[-1, 1e-07]\n");
    out.clear();
    append_rows(out, std::vector<double>{0.999, 0.5}, 1, {"", ",", ";"}, 1);
    EXPECT_EQ(out, "0.9;0.5;");
    append_rows(out, {}, 3, {"(", ",", ")"});
    EXPECT_EQ(out, "0.9;0.5;");
}

TEST(Decimal, SingleNeverReachesOneFromBelow) {
    EXPECT_EQ(to_single(1 - 0x1p-53), 1 - 0x1p-24F);
    EXPECT_EQ(to_single(1 - 0x1p-25), 1 - 0x1p-24F);
    EXPECT_EQ(to_single(-1 + 0x1p-53), -1 + 0x1p-24F);
    EXPECT_EQ(to_single(0.1), std::nextafter(0.1F, 0.0F));
    EXPECT_EQ(to_single(0.5), 0.5F);
    EXPECT_EQ(to_single(1), 1.0F);
    EXPECT_EQ(to_single(1e300), std::numeric_limits<float>::max());
    EXPECT_EQ(to_single(1e-300), 0.0F);
    std::mt19937_64 random(5);
    for (int i = 0; i < rounds; ++i) {
        const double value = static_cast<double>(random() >> 11) * 0x1p-53;
        const float single = to_single(value);
        ASSERT_LE(single, value);
        ASSERT_GT(std::nextafter(single, 2.0F), value);
    }
}

// A program that the library is part of may have set its user's language.
TEST(Decimal, ReadsNumbersBeyondDoublesInAnyLanguage) {
    const std::string before = std::setlocale(LC_NUMERIC, nullptr);
    if (std::setlocale(LC_NUMERIC, "de_DE.UTF-8") == nullptr) GTEST_SKIP() << "no German";
    double tiny = 1;
    double huge = 1;
    const std::string texts[] = {"1.5e-400", "1.5e400"};
    io::read_number(texts[0].data(), texts[0].data() + texts[0].size(), tiny);
    io::read_number(texts[1].data(), texts[1].data() + texts[1].size(), huge);
    std::setlocale(LC_NUMERIC, before.c_str());
    EXPECT_EQ(tiny, 0);
    EXPECT_EQ(huge, std::numeric_limits<double>::infinity());
}

}  // namespace stipple::testing::decimal_test
