// SPDX-License-Identifier: MIT
#include "core/spec.hpp"

#include <gtest/gtest.h>

#include "support/units.hpp"

namespace stipple::testing::spec_test {

using stipple::testing::error_of;
using Specs = std::vector<std::string>;

TEST(SplitSpecs, HonoursBracketsAndOptionsWithCommas) {
    EXPECT_EQ(split_specs("halton", "-g"), Specs{"halton"});
    EXPECT_EQ(split_specs("random, jittered ,halton", "-g"),
              (Specs{"random", "jittered", "halton"}));
    EXPECT_EQ(split_specs("sobol:scramble=owen,start=3,halton", "-g"),
              (Specs{"sobol:scramble=owen,start=3", "halton"}));
    EXPECT_EQ(split_specs("a:v=[0,0 1,0],b:w=[x:u=[1,2],y],c", "-g"),
              (Specs{"a:v=[0,0 1,0]", "b:w=[x:u=[1,2],y]", "c"}));
    EXPECT_EQ(split_specs("a:x=1,b:y=2,z=3", "-g"), (Specs{"a:x=1", "b:y=2,z=3"}));
    EXPECT_EQ(split_specs("a:x=1;b;c:y=2", "-g"), (Specs{"a:x=1", "b", "c:y=2"}));
}

TEST(ParseSpec, TakesNamesOfOptionsAsPythonHasThem) {
    EXPECT_EQ(
        parse_spec("cone:half_angle=3,axis=[a_b]").settings,
        (std::vector<std::pair<std::string, std::string>>{{"half-angle", "3"}, {"axis", "a_b"}}));
}

TEST(FormatSpec, KeepsOptionalOptionsThatAreGivenTheirEmptyValue) {
    const Schema schema(Param<std::int64_t>{.name = "decay", .optional = true},
                        Param<double>{.name = "radius", .fallback = 1});
    const auto formatted = [&](std::string_view spec) {
        return format_spec("unit", parse_spec(spec).values(schema), schema);
    };
    EXPECT_EQ(formatted("unit:decay=0"), "unit:decay=0");
    EXPECT_EQ(formatted("unit:radius=1"), "unit");
    EXPECT_EQ(formatted("unit"), "unit");
}

TEST(SplitSpecs, NamesTheColumnOfWhatIsUnbalancedOrMissing) {
    EXPECT_EQ(error_of([] { split_specs("random,a:v=[0,[1]", "--generators"); }),
              "usage: --generators, column 12: this '[' has no ']'");
    EXPECT_EQ(error_of([] { split_specs("random],halton", "--generators"); }),
              "usage: --generators, column 7: this ']' has no '['");
    EXPECT_EQ(error_of([] { split_specs("random,,halton", "--generators"); }),
              "usage: --generators, column 8: a name is expected");
    EXPECT_EQ(error_of([] { split_specs("", "--generators"); }),
              "usage: --generators, column 1: a name is expected");
}

}  // namespace stipple::testing::spec_test
