// SPDX-License-Identifier: MIT
#include "pipeline/units.hpp"

#include <gtest/gtest.h>

#include "support/units.hpp"

namespace stipple::testing::units_test {

using Settings = std::vector<std::pair<std::string, std::string>>;
using Words = std::vector<std::string>;

TEST(GeneratorSpec, IsASpecWithOptionsAndWarpsBehindIt) {
    const auto plain = parse_generator("sobol:scramble=owen");
    EXPECT_EQ(plain.unit.name, "sobol");
    EXPECT_EQ(plain.unit.settings, (Settings{{"scramble", "owen"}}));
    EXPECT_EQ(parse_generator(" sobol  --scramble owen ").unit.settings, plain.unit.settings);
    EXPECT_EQ(parse_generator("sobol --scramble=owen").unit.settings, plain.unit.settings);
    EXPECT_EQ(parse_generator("lhs --centered -w owen").unit.settings,
              (Settings{{"centered", "true"}}));
    const auto warped =
        parse_generator("halton:leap=3 -w disk@1,2 --scramble faure --warp [x=-1 -w] -w=owen");
    EXPECT_EQ(warped.unit.settings, (Settings{{"leap", "3"}, {"scramble", "faure"}}));
    EXPECT_EQ(warped.warps, (Words{"disk@1,2", "[x=-1 -w]", "owen"}));
    EXPECT_EQ(format_own_warps(warped.warps), " -w disk@1,2 -w [x=-1 -w] -w owen");
}

TEST(GeneratorSpec, NegativeNumbersAndBracketsAreValues) {
    EXPECT_EQ(
        parse_generator("g --range -1,1 --at -.5 --v [0,0 1,0 0,1] --p 0,0 1,1").unit.settings,
        (Settings{{"range", "-1,1"}, {"at", "-.5"}, {"v", "0,0 1,0 0,1"}, {"p", "0,0 1,1"}}));
}

TEST(GeneratorSpec, ListsAreSplitBetweenGenerators) {
    EXPECT_EQ(split_specs("rank1-lattice -w cranley-patterson,sobol --scramble owen;halton", "x"),
              (Words{"rank1-lattice -w cranley-patterson", "sobol --scramble owen", "halton"}));
    EXPECT_EQ(split_specs("halton -w disk@2,1 -w beta:alpha=2,beta=3,random", "x"),
              (Words{"halton -w disk@2,1 -w beta:alpha=2,beta=3", "random"}));
}

TEST(GeneratorSpec, OtherOptionsAreRefused) {
    const auto error = [](const char* text) { return error_of([&] { parse_generator(text); }); };
    EXPECT_EQ(error("sobol -n 64"),
              "usage: 'sobol -n 64': -n is not understood | only -w WARP and the generator's "
              "--OPTIONs may follow it");
    EXPECT_EQ(error("sobol -w --scramble owen"),
              "usage: 'sobol -w --scramble owen': -w needs a warp");
}

}  // namespace stipple::testing::units_test
