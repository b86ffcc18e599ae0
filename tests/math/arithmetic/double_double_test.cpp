// SPDX-License-Identifier: MIT
#include "math/arithmetic/double_double.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include "core/rng.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::testing::double_double_test {

namespace stipple {
namespace {

using Rational = boost::multiprecision::cpp_rational;

Rational exact(const DoubleDouble& x) { return Rational(x.high) + Rational(x.low); }

double off(const DoubleDouble& found, const Rational& right) {
    return static_cast<double>(abs(Rational((exact(found) - right) / right)));
}

TEST(DoubleDouble, SumsAndProductsOfDoublesAreExact) {
    const DoubleDouble sum = exact_sum(1e16, 0.1);
    EXPECT_EQ(exact(sum), Rational(1e16) + Rational(0.1));
    EXPECT_EQ(sum.high, 1e16);
    EXPECT_EQ(exact(exact_sum(0x1p-60, -1.0)), Rational(0x1p-60) - 1);
    const DoubleDouble product = exact_product(0.1, 0.3);
    EXPECT_EQ(exact(product), Rational(0.1) * Rational(0.3));
    EXPECT_NE(product.low, 0);
}

TEST(DoubleDouble, TheShorterWaysAreExactToo) {
    const Rng rng(4);
    for (std::uint64_t i = 0; i < 1000; ++i) {
        const double a = rng.uniform(2 * i) - 0.5;
        const double b = rng.uniform(2 * i + 1) * 1e9;
        ASSERT_EQ(exact(split_product(a, b)), Rational(a) * Rational(b));
        ASSERT_EQ(split_product(a, b).high, a * b);
        ASSERT_EQ(exact(ordered_sum(b, a)), Rational(a) + Rational(b));
    }
}

// Names must be unique: of an inline function defined twice, the linker keeps whichever it sees
// first.
TEST(DoubleDouble, SumsInAnyOrderAreExact) {
    const double small = 0x1p-60;
    EXPECT_EQ(exact(exact_sum(small, 1.0)), Rational(small) + 1);
    EXPECT_EQ(logarithm_parts(1 + 0x1p-40).low != 0, true);
}

TEST(DoubleDouble, CarriesAHundredBits) {
    const Rng rng(1);
    DoubleDouble sum = {rng.uniform(0), 0};
    DoubleDouble product = {1, 0};
    Rational right = exact(sum);
    Rational power = 1;
    for (unsigned i = 1; i <= 100; ++i) {
        const DoubleDouble next = exact_sum(rng.uniform(2 * i), 0x1p-54 * rng.uniform(2 * i + 1));
        right += exact(next);
        sum = sum + next;
        const Rational factor = exact(next) + 1;
        product = product * (next + DoubleDouble{1, 0});
        power *= factor;
        ASSERT_LE(off(sum, right), i * 0x1p-100);
        ASSERT_LE(off(product, power), 2 * i * 0x1p-100);
        ASSERT_EQ(product.high + product.low, product.high);
    }
}

}  // namespace
}  // namespace stipple

}  // namespace stipple::testing::double_double_test
