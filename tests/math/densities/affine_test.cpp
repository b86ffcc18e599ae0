// SPDX-License-Identifier: MIT
#include "math/densities/affine.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stipple::testing::affine_test {
namespace {

using ::testing::ElementsAre;

std::optional<std::vector<HalfSpace>> read(std::string_view text) {
    return affine_inequalities(Expression("", text, 2));
}

struct Case {
    const char* text;
    double x, y, bound;
};

}  // namespace

// Worked by hand: a x + b y <= c.
TEST(Affine, InequalitiesByHand) {
    const Case cases[] = {
        {"x<1", 1, 0, 1},
        {"x <= 1", 1, 0, 1},
        {"x > 1", -1, 0, -1},
        {"1 >= y", 0, 1, 1},
        {"2*x + 3*y < 4", 2, 3, 4},
        {"2*(x - y)/4 + 1 < x", -0.5, -0.5, -1},
        {"-x - -y < +3", -1, 1, 3},
        {"-(x + 2*y)*3 >= 1 - 7", 3, 6, 6},
        {"x*2*3 < 2^3^2", 6, 0, 512},
        {"sqrt(4)*x + max(1, 2, 3)*y < min(5, 6)/2", 2, 3, 2.5},
        {"2^-1*x < -2^2", 0.5, 0, -4},
        {"x + x + x1 < y + x2", 3, -2, 0},
        {".5e1*x<1e-3", 5, 0, 1e-3},
        {"((x)) < (((1)))", 1, 0, 1},
        {"(x + 1 < 2)", 1, 0, 1},
        {"0*x + 1 < 2", 0, 0, 1},
        {"x - x < 0", 0, 0, -1},
        {"x - x <= 0", 0, 0, 1},
        {"(1 < 2)*x < (2 > 3 ? 4 : 5)", 1, 0, 5},
        {"max(1 < 2, 0)*x < 1/(1/0) + 3", 1, 0, 3},
    };
    for (const auto& [text, x, y, bound] : cases) {
        const auto all = read(text);
        ASSERT_TRUE(all.has_value()) << text;
        ASSERT_EQ(all->size(), 1U) << text;
        EXPECT_THAT((*all)[0].normal, ElementsAre(x, y)) << text;
        EXPECT_EQ((*all)[0].bound, bound) << text;
        EXPECT_EQ((*all)[0].text, Expression("", text, 2).text());
    }
    EXPECT_NEAR((*read("x < pi - e"))[0].bound, 0.42331082513074800, 1e-15);
}

TEST(Affine, SeveralAreJoinedByAnd) {
    for (const char* text :
         {"x<1 && y<2 && x+y<2.5", "(x<1 && y<2) && x+y<2.5", "x<1 && ((y<2) && (x+y<2.5))"}) {
        const auto all = read(text);
        ASSERT_TRUE(all.has_value()) << text;
        ASSERT_EQ(all->size(), 3U) << text;
        EXPECT_EQ((*all)[1].bound, 2);
        EXPECT_THAT((*all)[2].normal, ElementsAre(1, 1));
    }
}

TEST(Affine, OtherFormulasAreNot) {
    for (const char* text : {"x*y<1",
                             "x^2<1",
                             "x^1<1",
                             "1/x<1",
                             "x/y<1",
                             "x",
                             "1",
                             "x==1",
                             "x!=1",
                             "x<1 || y<1",
                             "sin(x)<1",
                             "abs(x)<1",
                             "min(x, y)<1",
                             "x<1 ? 1 : 0",
                             "(x<1)+1<2",
                             "(x<1)*y<1",
                             "x<1 && x*y<1",
                             "x/0<1",
                             "1e300*1e300*x<1",
                             "2^x<1",
                             "(x<1)==1",
                             "floor(1e-9*x)<1"})
        EXPECT_FALSE(read(text).has_value()) << text;
}

}  // namespace stipple::testing::affine_test
