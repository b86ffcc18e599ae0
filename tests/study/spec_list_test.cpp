// SPDX-License-Identifier: MIT
#include "study/study_config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/units.hpp"

namespace stipple::testing::spec_list_test {

using stipple::testing::error_of;
using ::testing::HasSubstr;

namespace {

using Counts = std::vector<std::uint64_t>;

Counts counts(std::string_view text) { return parse_counts(text, "--count", 1, 1'000'000'000); }

}  // namespace

TEST(ParseCounts, TakesListsAndRanges) {
    EXPECT_EQ(counts("16,64,256"), (Counts{16, 64, 256}));
    EXPECT_EQ(counts("1e3"), (Counts{1000}));
    EXPECT_EQ(counts("2^4..2^8"), (Counts{16, 32, 64, 128, 256}));
    EXPECT_EQ(counts("16 .. 2^8"), (Counts{16, 32, 64, 128, 256}));
    EXPECT_EQ(counts("3^1..81"), (Counts{3, 9, 27, 81}));
    EXPECT_EQ(counts("4^2..4^4"), (Counts{16, 64, 256}));
    EXPECT_EQ(counts("1..2^3"), (Counts{1, 2, 4, 8}));
    EXPECT_EQ(counts("1..6+1"), (Counts{1, 2, 3, 4, 5, 6}));
    EXPECT_EQ(counts("16..1000*4"), (Counts{16, 64, 256}));
    EXPECT_EQ(counts("10..35+10"), (Counts{10, 20, 30}));
    EXPECT_EQ(counts("7..7"), (Counts{7}));
    EXPECT_EQ(counts("5, 2^3..2^4"), (Counts{5, 8, 16}));
}

TEST(ParseCounts, RefusesWhatIsNoRangeAndSaysWhatIs) {
    EXPECT_EQ(error_of([] { counts("64..16"); }),
              "usage: --count: the range '64..16' is empty: 64 is above 16");
    EXPECT_EQ(error_of([] { counts("1..6"); }),
              "usage: --count: '1..6' does not say which numbers lie between its ends | 1..6*2 "
              "goes by a factor, "
              "1..6+1 by a step, 2^4..2^16 by powers");
    for (const char* unclear : {"16..256", "2^4..1000", "1^1..8", "2^3..3^3", "16..100"})
        EXPECT_THAT(error_of([&] { counts(unclear); }),
                    HasSubstr("does not say which numbers lie between its ends"));
    EXPECT_EQ(error_of([] { counts(" "); }), "usage: --count: there are no numbers");
    EXPECT_EQ(error_of([] { counts("16,32,16"); }),
              "usage: --count: 16 is given twice in '16,32,16'");
    EXPECT_EQ(error_of([] { counts("16..64*1"); }),
              "usage: --count: '1' in '16..64*1' is not a factor of 2 or more");
    EXPECT_EQ(error_of([] { counts("16..64+0"); }),
              "usage: --count: '0' in '16..64+0' is not a step of 1 or more");
    EXPECT_EQ(error_of([] { counts("0"); }), "usage: --count: 0 is outside [1, 1000000000]");
    EXPECT_TRUE(error_of([] { counts("16..x"); }).starts_with("usage: --count: 'x' is not a"));
    EXPECT_EQ(error_of([] { counts("16,,32"); }), "usage: --count: a number is missing");
    EXPECT_EQ(error_of([] { counts("16.."); }), "usage: --count: a number is missing in '16..'");
    EXPECT_TRUE(error_of([] { counts("1..1e9+1"); }).ends_with("has more than 1000000 numbers"));
}

}  // namespace stipple::testing::spec_list_test
