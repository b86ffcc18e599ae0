// SPDX-License-Identifier: MIT
#include "media/token_file.hpp"

#include <gtest/gtest.h>

#include "support/units.hpp"

namespace stipple::testing::token_file_test {

TEST(TokenFile, GivesWordsWithTheirPlaces) {
    TokenFile file("\xEF\xBB\xBF one  two# not this\r\n#nor this\n\n\tthree", "f");
    EXPECT_TRUE(file.at_line_end());
    for (const auto& [text, line, column, last_of_line] :
         {std::tuple{"one", 1U, 2U, false}, {"two", 1U, 7U, true}, {"three", 4U, 2U, true}}) {
        EXPECT_FALSE(file.at_end());
        const Token token = file.next("a word");
        EXPECT_EQ(token.text, text);
        EXPECT_EQ(token.line, line);
        EXPECT_EQ(token.column, column);
        EXPECT_EQ(file.at_line_end(), last_of_line) << text;
    }
    EXPECT_TRUE(file.at_end());
    EXPECT_EQ(error_of([&] { file.next("a word"); }),
              "input: f:4:7: the file ends here; expected a word");
}

TEST(TokenFile, NumbersAreWholeAndInTheirRange) {
    TokenFile file("7 18446744073709551615 18446744073709551616 -1 1.5 x\x01 8 9", "f");
    EXPECT_EQ(file.number("n"), 7U);
    EXPECT_EQ(file.number("n"), ~std::uint64_t{0});
    EXPECT_EQ(error_of([&] { file.number("n"); }),
              "input: f:1:24: '18446744073709551616' is out of range; expected n");
    EXPECT_EQ(error_of([&] { file.number("n", 1); }),
              "input: f:1:45: '-1' is not a whole number; expected n, at least 1");
    EXPECT_EQ(error_of([&] { file.number("n", 0, 1); }),
              "input: f:1:48: '1.5' is not a whole number; expected n in [0, 1]");
    EXPECT_EQ(error_of([&] { file.number("n"); }),
              "input: f:1:52: 'x\\x01' is not a whole number; expected n");
    EXPECT_EQ(error_of([&] { file.number("n", 9, 12); }),
              "input: f:1:55: '8' is out of range; expected n in [9, 12]");
    EXPECT_EQ(error_of([&] { file.number("n", 8, 8); }),
              "input: f:1:57: '9' is out of range; expected n, 8");
}

TEST(TokenFile, KnowsWhatBelongsToALine) {
    TokenFile file("head er\n1 2  # two\n3 4 5\n", "f");
    file.skip_line();
    EXPECT_EQ(file.number("a"), 1U);
    EXPECT_EQ(error_of([&] { file.expect_line_end(); }),
              "input: f:2:3: unexpected '2'; expected the end of the line");
    EXPECT_EQ(file.number_on_line("b"), 2U);
    file.expect_line_end();
    EXPECT_EQ(error_of([&] { file.number_on_line("c", 1, 9); }),
              "input: f:2:4: the line ends here; expected c in [1, 9]");
    EXPECT_EQ(file.number("d"), 3U);
    file.skip_line();
    EXPECT_TRUE(file.at_end());
}

TEST(TokenFile, KnowsTheCommentOfTheNextTokensLine) {
    TokenFile file("# title\n2 # dimensions\n3\n# k =\n4 5 # both\n", "f");
    EXPECT_TRUE(file.comment_has("dimensions"));
    EXPECT_FALSE(file.comment_has("title"));
    file.number("two");
    EXPECT_FALSE(file.comment_has("#"));
    file.number("three");
    file.number("four");
    EXPECT_TRUE(file.comment_has("both"));
    EXPECT_FALSE(file.comment_has("5"));
    file.number("five");
    EXPECT_FALSE(file.comment_has("#"));
}

TEST(TokenFile, SaysWhichFileCannotBeRead) {
    EXPECT_EQ(error_of([] { TokenFile file("/no/such/file"); }), "io: /no/such/file: no such file");
    EXPECT_EQ(error_of([] { TokenFile file("/"); }), "io: /: is a folder, not a file");
}

}  // namespace stipple::testing::token_file_test
