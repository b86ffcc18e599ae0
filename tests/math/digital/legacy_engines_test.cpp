// SPDX-License-Identifier: MIT
#include "math/digital/legacy_engines.hpp"

#include <gtest/gtest.h>

#include <cstdlib>

namespace stipple::testing::legacy_engines_test {
namespace {

constexpr std::uint64_t seeds[] = {0,          1,          2,          42,
                                   123456789,  2147483646, 2147483647, 2147483648,
                                   2147483649, 3000000000, 4294967294, 4294967295};

template <class Engine>
double nth(Engine engine, std::size_t n) {
    for (std::size_t i = 1; i < n; ++i) engine.next();
    return engine.next();
}

}  // namespace

// Numbers of the C library's own function.
TEST(Drand48, PublishedFirstNumbers) {
    Drand48 one(1);
    EXPECT_EQ(one.next(), 0.041630344771878214);
    EXPECT_EQ(one.next(), 0.45449244472862915);
    EXPECT_EQ(one.next(), 0.8348172181669149);
    EXPECT_EQ(Drand48(0).next(), 0.17082803610628972);
}

TEST(Drand48, DiscardLeavesOutThatMany) {
    for (const std::uint64_t count : {0, 1, 2, 3, 7, 1000, 123457}) {
        Drand48 walked(9);
        for (std::uint64_t i = 0; i < count; ++i) walked.next();
        Drand48 jumped(9);
        jumped.discard(count);
        EXPECT_EQ(jumped.next(), walked.next()) << count;
    }
    Drand48 round(9);  // the period is 2^48
    round.discard(std::uint64_t{1} << 48);
    EXPECT_EQ(round.next(), Drand48(9).next());
}

#ifdef __GLIBC__
// Oracle: the C library.
TEST(Drand48, AgreesWithTheCLibrary) {
    for (const std::uint64_t seed : seeds) {
        drand48_data library{};
        srand48_r(static_cast<long>(seed), &library);
        Drand48 ours(seed);
        for (int i = 0; i < 1000; ++i) {
            double theirs = 0;
            drand48_r(&library, &theirs);
            ASSERT_EQ(ours.next(), theirs) << "seed " << seed << ", number " << i;
        }
    }
}

TEST(AdditiveFeedback, AgreesWithTheCLibrary) {
    for (const std::uint64_t seed : seeds) {
        random_data library{};
        char state[128];
        initstate_r(static_cast<unsigned>(seed), state, sizeof state, &library);
        AdditiveFeedback ours(seed);
        for (int i = 0; i < 1000; ++i) {
            std::int32_t theirs = 0;
            random_r(&library, &theirs);
            ASSERT_EQ(ours.next() * 0x1p31, theirs) << "seed " << seed << ", number " << i;
        }
    }
}
#endif

// First numbers of rand() in a C program without srand: 1804289383, 846930886, 1681692777.
TEST(AdditiveFeedback, KnownFirstNumbers) {
    AdditiveFeedback numbers(1);
    EXPECT_EQ(numbers.next(), 1804289383 * 0x1p-31);
    EXPECT_EQ(numbers.next(), 846930886 * 0x1p-31);
    EXPECT_EQ(numbers.next(), 1681692777 * 0x1p-31);
}

// The check published by James.
TEST(Ranmar, PublishedNumbersAfter20000) {
    Ranmar numbers(1802, 9373);
    for (int i = 0; i < 20000; ++i) numbers.next();
    for (const int expected : {6533892, 14220222, 7275067, 6172232, 8354498, 10633180})
        EXPECT_EQ(numbers.next() * 4096 * 4096, expected);
}

TEST(Ranmar, SeedCountsKlFastest) {
    EXPECT_EQ(nth(Ranmar(1802 * 30082 + 9373), 100), nth(Ranmar(1802, 9373), 100));
    EXPECT_EQ(nth(Ranmar(Ranmar::max_seed), 100), nth(Ranmar(31328, 30081), 100));
}

// The 10 000th numbers required by the C++ standard, [rand.predef].
TEST(MersenneTwister, TenThousandthNumberOfTheStandard) {
    EXPECT_EQ(nth(MersenneTwister(5489), 10000), to_unit(9981545732273789042U));
}

TEST(Ranlux48, TenThousandthNumberOfTheStandard) {
    EXPECT_EQ(nth(Ranlux48(19780503), 10000) * 0x1p48, 249142670248501.);
    EXPECT_EQ(Ranlux48(0).next(), Ranlux48(19780503).next());
}

}  // namespace stipple::testing::legacy_engines_test
