// SPDX-License-Identifier: MIT
#include "core/text.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace stipple::testing::text_test {

using ::testing::ElementsAre, ::testing::IsEmpty;

TEST(Text, WholeNumbersInManyWays) {
    EXPECT_EQ(parse_integer("1000"), 1000);
    EXPECT_EQ(parse_integer("-7"), -7);
    EXPECT_EQ(parse_integer("1e6"), 1'000'000);
    EXPECT_EQ(parse_integer("1.5e3"), 1500);
    EXPECT_EQ(parse_integer("2^20"), 1'048'576);
    EXPECT_EQ(parse_integer("3^0"), 1);
    EXPECT_EQ(parse_integer("1^2147483647"), 1);  // fast
    EXPECT_EQ(parse_integer("0^2147483647"), 0);
    EXPECT_EQ(parse_integer("0^0"), 1);
    EXPECT_EQ(parse_integer("64k"), 65'536);
    EXPECT_EQ(parse_integer("2M"), 2'097'152);
    EXPECT_EQ(parse_integer("0.5k"), 512);
    EXPECT_EQ(parse_integer("9223372036854775807"), std::numeric_limits<std::int64_t>::max());
}

TEST(Text, RefusesWhatIsNoWholeNumberOrDoesNotFit) {
    for (const char* text : {"",     "x",    "1.5",  "1e",  "2^",   "^2",
                             "2^-1", "2^64", "1e30", "k",   "0.3k", "9223372036854775808",
                             "1 ",   " 1",   "nan",  "inf", "0x10", "-2^2",
                             "+-2",  "-+2",  "--2",  "2^63"})
        EXPECT_FALSE(parse_integer(text)) << text;
}

TEST(Text, SeedsUseAll64Bits) {
    EXPECT_EQ(parse_unsigned("18446744073709551615"), ~std::uint64_t{0});
    EXPECT_EQ(parse_unsigned("0xff"), 255U);
    EXPECT_EQ(parse_unsigned("2^63"), std::uint64_t{1} << 63);
    EXPECT_EQ(parse_unsigned("1e19"), 10'000'000'000'000'000'000U);
    EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
    EXPECT_FALSE(parse_unsigned("-1"));
    EXPECT_FALSE(parse_unsigned("18446744073709551616"));
}

TEST(Text, NumbersAreFiniteAndWhole) {
    EXPECT_EQ(parse_number("-1.5e-3"), -0.0015);
    EXPECT_EQ(parse_number("+2"), 2.0);
    for (const char* text : {"", "nan", "inf", "1e999", "1,5", "1x", "--1", "+-1"})
        EXPECT_FALSE(parse_number(text)) << text;
}

TEST(Text, SizesInBytes) {
    EXPECT_EQ(parse_bytes("500"), 500U);
    EXPECT_EQ(parse_bytes("1.5k"), 1536U);
    EXPECT_EQ(parse_bytes("2GiB"), 2'147'483'648U);
    EXPECT_FALSE(parse_bytes("many"));
    EXPECT_FALSE(parse_bytes("-1k"));
    EXPECT_EQ(format_bytes(1536), "1.5 KiB");
    EXPECT_EQ(format_bytes(100), "100 bytes");
    EXPECT_EQ(format_bytes(1023), "1023 bytes");
    EXPECT_EQ(format_bytes(999 * 0x1p20), "999 MiB");
    EXPECT_EQ(format_bytes(1000 * 0x1p20), "0.977 GiB");
}

TEST(Text, NearestWordsAreThoseThatCouldBeMeant) {
    const std::vector<std::string> known = {"halton", "hammersley", "random"};
    EXPECT_THAT(nearest_words("haltom", known), ElementsAre("halton"));
    EXPECT_THAT(nearest_words("Halton", known), ElementsAre("halton"));
    EXPECT_THAT(nearest_words("hamm", known), ElementsAre("hammersley"));
    EXPECT_THAT(nearest_words("xyz", known), IsEmpty());
    // Two swapped letters count as one error.
    EXPECT_THAT(nearest_words("owne", std::vector<std::string>{"none", "owen"}),
                ElementsAre("owen"));
    EXPECT_THAT(nearest_words("sedes", std::vector<std::string>{"seed", "seeds"}),
                ElementsAre("seeds"));
    // At most three words, all equally near.
    EXPECT_THAT(nearest_words("ab", std::vector<std::string>{"axe", "abd", "abc", "abe", "abf"}),
                ElementsAre("abd", "abc", "abe"));
    EXPECT_EQ(suggest("hal", known), "did you mean 'halton'?");
    EXPECT_EQ(suggest("xyz", known), "known: halton, hammersley, random");
    EXPECT_EQ(quoted_list({"a"}, "or"), "'a'");
    EXPECT_EQ(quoted_list({"a", "b", "c"}, "and"), "'a', 'b' and 'c'");
}

TEST(Text, JoinsWordsAndNumbers) {
    EXPECT_EQ(join(std::vector<std::string>{"", "a", ""}, ","), ",a,");
    EXPECT_EQ(join(std::vector<double>{0.1, -2, 1e300}, ", "), "0.1, -2, 1e+300");
    EXPECT_EQ(join(std::vector<std::uint32_t>{7}, "x"), "7");
    EXPECT_EQ(join(std::vector<std::int64_t>{-1, 2}, "x"), "-1x2");
    EXPECT_EQ(join(std::vector<std::int64_t>{}, "x"), "");
}

TEST(Text, SplitsKeepEmptyParts) {
    EXPECT_EQ(split("a,b", ','), (std::vector<std::string_view>{"a", "b"}));
    EXPECT_EQ(split("a,,", ','), (std::vector<std::string_view>{"a", "", ""}));
    EXPECT_TRUE(split("", ',').empty());
}

}  // namespace stipple::testing::text_test
