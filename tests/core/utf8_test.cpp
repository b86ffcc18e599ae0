// SPDX-License-Identifier: MIT
#include "core/text.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::utf8_test {

TEST(Utf8, GoesApartAndTogether) {
    const std::string text = "xé−…😀";
    EXPECT_EQ(code_points(text), U"xé−…😀");
    EXPECT_EQ(utf8_of(code_points(text)), text);
    // Overlong, a surrogate, a truncated letter: all invalid.
    EXPECT_EQ(code_points("\xC0\xAF\xED\xA0\x80\xE2\x88"), std::u32string(7, U'\uFFFD'));
}

// Control sequences for terminals are removed, letters of all languages are kept.
TEST(Utf8, PrintableTextObeysNobody) {
    EXPECT_EQ(printable("größe ≤ 3 点"), "größe ≤ 3 点");
    EXPECT_EQ(printable("\x1b[31mred\x1b]0;title\x07"), "\\x1b[31mred\\x1b]0;title\\x07");
    EXPECT_EQ(printable("a\nstipple: identical\r\tb\x7F"), "a\\nstipple: identical\\r\\tb\\x7f");
    EXPECT_EQ(printable("\xFFz\xC3"), "\\xffz\\xc3");
    EXPECT_EQ(printable("\u009b31m\u202egnp.x\u2028"), "\\u009b31m\\u202egnp.x\\u2028");
    EXPECT_EQ(printable(std::string_view("\0", 1)), "\\x00");
}

TEST(Utf8, ShowsTheFrontOfLongText) {
    EXPECT_EQ(shown("x\ty"), "'x\\ty'");
    EXPECT_EQ(shown(std::string(80, 'a')), "'" + std::string(80, 'a') + "'");
    EXPECT_EQ(shown(std::string(100'000, 'a')), "'" + std::string(80, 'a') + "...' (100000 bytes)");
    std::string letters;
    for (int i = 0; i < 81; ++i) letters += "é";
    EXPECT_EQ(shown(letters), "'" + letters.substr(0, 160) + "...' (162 bytes)");
}

// Words from users appear in messages; words of usual length, and many of them, are not truncated.
TEST(Utf8, MessagesOfLongWordsAreCutShort) {
    const std::string usual = "no 'generator': known are " + std::string(900, 'b') + " and c";
    EXPECT_EQ(cut_short(usual), usual);
    EXPECT_EQ(cut_short("no '" + std::string(100'000, 'a') + "' here"),
              "no '" + std::string(79, 'a') + "... (100003 bytes) here");
    std::string many;
    for (int i = 0; i < 50'000; ++i) many += "é ";
    EXPECT_LT(cut_short(many).size(), 8100U);
    EXPECT_TRUE(cut_short(many).ends_with("... (150000 bytes)"));
}

}  // namespace stipple::testing::utf8_test
