// SPDX-License-Identifier: MIT
#include "core/options.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/domain.hpp"
#include "core/spec.hpp"
#include "support/units.hpp"

namespace stipple::testing::options_test {
namespace {

constexpr Param<std::int64_t> base{
    .name = "base", .fallback = 2, .low = 2, .high = 10, .help = "h"};
constexpr Param<double> radius{
    .name = "radius", .low = 0, .low_open = true, .optional = true, .help = "h"};
constexpr Param<bool> shift{.name = "shift", .help = "h"};
constexpr Param<Choice> method{
    .name = "method", .fallback = "polar", .choices = "polar|concentric", .help = "h"};
constexpr Param<Numbers> center{{.name = "center", .fallback = "0,0", .unit = {}, .help = "h"}};
constexpr Param<Points> vertices{
    {.name = "vertices", .fallback = "0,0 1,0 0,1", .unit = {}, .help = "h"}};
constexpr Param<Extents> shape{{.name = "shape", .fallback = {}, .unit = {}, .help = "h"}};

const Schema schema(base, radius, shift, method, center, vertices, shape);

Values with(const std::string& name, const std::string& text) {
    Values values = schema.defaults();
    schema.set(values, name, text);
    return values;
}

std::string refusal(const std::string& name, const std::string& text) {
    return error_of([&] { with(name, text); });
}

}  // namespace

TEST(Options, DefaultsAreThoseOfTheRecord) {
    const Values values = schema.defaults();
    EXPECT_EQ(values[base], 2);
    EXPECT_FALSE(values.given(radius));
    EXPECT_FALSE(values[shift]);
    EXPECT_EQ(values[method], "polar");
    EXPECT_EQ(values[center], (std::vector<double>{0, 0}));
    EXPECT_EQ(values[vertices], (Table{{0, 0}, {1, 0}, {0, 1}}));
}

TEST(Options, ValuesAreReadFromText) {
    EXPECT_EQ(with("base", "3")[base], 3);
    EXPECT_EQ(with("radius", "0.25")[radius], 0.25);
    EXPECT_TRUE(with("radius", "0.25").given(radius));
    EXPECT_TRUE(with("shift", "true")[shift]);
    EXPECT_EQ(with("center", "1, -2.5")[center], (std::vector<double>{1, -2.5}));
    EXPECT_EQ(with("center", "2,1  1,2 ")[center], (std::vector<double>{2, 1, 1, 2}));
    EXPECT_EQ(with("vertices", "0,0  2,0 0,2")[vertices], (Table{{0, 0}, {2, 0}, {0, 2}}));
    EXPECT_EQ(with("shape", "40x25")[shape], (std::vector<std::int64_t>{40, 25}));
}

TEST(Options, NumbersMayBeFormulas) {
    EXPECT_EQ(with("radius", "sqrt(2)/2")[radius], std::sqrt(2.0) / 2);
    EXPECT_EQ(with("radius", "pi")[radius], std::numbers::pi);
    EXPECT_EQ(with("radius", "1-0.25")[radius], 0.75);
    EXPECT_EQ(with("radius", "e")[radius], std::numbers::e);
    EXPECT_EQ(with("radius", "e-1")[radius], std::numbers::e - 1);
    EXPECT_EQ(with("radius", "1e1-2")[radius], 8);
    EXPECT_EQ(with("radius", "2.5e-1")[radius], 0.25);
    EXPECT_EQ(with("center", "-1/4,min(2,3)")[center], (std::vector<double>{-0.25, 2}));
    EXPECT_EQ(with("vertices", "0,0 1,0 1/2,sqrt(3)/2")[vertices],
              (Table{{0, 0}, {1, 0}, {0.5, std::sqrt(3.0) / 2}}));
    EXPECT_EQ(parse_box("0..2*pi,-1/2..max(1,2)", 2).high,
              (std::vector<double>{2 * std::numbers::pi, 2}));
    EXPECT_EQ(refusal("radius", "1/0"), "usage: --radius: '1/0' is not a finite number");
    EXPECT_EQ(refusal("radius", "0*2"), "usage: --radius: 0*2 is outside (0, inf)");
    EXPECT_EQ(refusal("radius", "two"), "usage: --radius: 'two' is not a finite number");
    EXPECT_THAT(refusal("radius", "2*x"), ::testing::HasSubstr("--radius: '2*x', column 3"));
    EXPECT_THAT(refusal("center", "1,(2"), ::testing::HasSubstr("the formula ends"));
    EXPECT_EQ(refusal("base", "4/2"), "usage: --base: '4/2' is not a whole number");
}

TEST(Options, RefusalsSayTheValueAndWhatIsAllowed) {
    EXPECT_EQ(refusal("base", "1"), "usage: --base: 1 is outside [2, 10]");
    EXPECT_EQ(refusal("base", "1e30"), "usage: --base: 1e30 is outside [2, 10]");
    EXPECT_EQ(refusal("base", "2.5"), "usage: --base: '2.5' is not a whole number");
    EXPECT_EQ(refusal("radius", "0"), "usage: --radius: 0 is outside (0, inf)");
    EXPECT_EQ(refusal("radius", "nan"), "usage: --radius: 'nan' is not a finite number");
    EXPECT_EQ(refusal("radius", "true"), "usage: --radius needs a value");
    EXPECT_EQ(refusal("method", "polr"),
              "usage: --method: 'polr' is not one of polar, concentric | did you mean 'polar'?");
    EXPECT_EQ(refusal("vertices", "0,0 1"),
              "usage: --vertices: '0,0 1' is not a list of points of one dimension");
    for (const char* gap : {"1,,2", "1,", ",1", " ", "1 x"})
        EXPECT_EQ(refusal("center", gap), "usage: --center: '" + std::string(gap) +
                                              "' is not a list of numbers such as 0.5,1");
    EXPECT_EQ(refusal("shape", "4x0"), "usage: --shape: '4x0' is not a shape such as 40x25");
    EXPECT_EQ(refusal("bsae", "3"), "usage: unknown option 'bsae' | did you mean 'base'?");
}

TEST(Spec, NamesAUnitWithCoordinatesAndOptions) {
    const Spec spec = parse_spec("disk@4,5:method=concentric,center=[1,-2],flag");
    EXPECT_EQ(spec.name, "disk");
    EXPECT_EQ(spec.coordinates, (std::vector<std::size_t>{3, 4}));
    EXPECT_EQ(spec.settings, (std::vector<std::pair<std::string, std::string>>{
                                 {"method", "concentric"}, {"center", "1,-2"}, {"flag", "true"}}));
}

TEST(Spec, SaysTheColumnWhereItStopsBeingOne) {
    const auto error = [](const char* text) { return error_of([&] { parse_spec(text); }); };
    EXPECT_EQ(error("disk:center=[1,2"),
              "usage: spec 'disk:center=[1,2', column 17: ']' is missing");
    EXPECT_EQ(error_of([] { parse_spec("expression-1d:density=max(0,x)"); }),
              "usage: spec 'expression-1d:density=max(0,x)', column 28: a value with commas is "
              "written in brackets, density=[...]");
    EXPECT_EQ(error("disk:"), "usage: spec 'disk:', column 6: an option's name is expected");
    EXPECT_EQ(error(""), "usage: spec '', column 1: a unit's name is expected");
    EXPECT_NE(error("disk@0,1"), "");
    EXPECT_NE(error("disk@2,2"), "");
    EXPECT_NE(error("a:b=c]d"), "");
}

TEST(Spec, WritesWhatDiffersAndReadsItBack) {
    EXPECT_EQ(format_spec("unit", schema.defaults(), schema), "unit");
    Values values = schema.defaults();
    schema.set(values, "center", "1,2");
    schema.set(values, "radius", "0.5");
    schema.set(values, "shift", "true");
    const std::string text = format_spec("unit", values, schema);
    EXPECT_EQ(text, "unit:radius=0.5,shift=true,center=[1,2]");
    const Values back = parse_spec(text).values(schema);
    EXPECT_EQ(back[center], values[center]);
    EXPECT_EQ(back[radius], values[radius]);
}

// -0 equals 0, but atan2 and 1/x distinguish them.
TEST(Spec, ZerosKeepTheirSigns) {
    const std::string fallback = format_value(schema.defaults().find("center").value);
    ASSERT_EQ(fallback, "0,0");
    Values values = schema.defaults();
    schema.set(values, "center", "-0,0");
    EXPECT_EQ(format_spec("unit", values, schema), "unit:center=[-0,0]");
}

// A value in brackets ends at the matching bracket, so that specs can contain specs.
TEST(Spec, BracketsNest) {
    const Spec spec = parse_spec("mixture:components=[cone:axis=[1,0,0]|disk],weights=[1,2]");
    ASSERT_EQ(spec.settings.size(), 2U);
    EXPECT_EQ(spec.settings[0].second, "cone:axis=[1,0,0]|disk");
    EXPECT_EQ(spec.settings[1].second, "1,2");
    EXPECT_THROW(parse_spec("mixture:components=[cone:axis=[1,0,0]"), Error);

    constexpr Param<Text> parts{{.name = "parts", .fallback = "none", .help = "Parts"}};
    const Schema of_parts(parts);
    Values values = of_parts.defaults();
    values.put("parts", std::string("a:b=[c]"));
    EXPECT_EQ(format_spec("unit", values, of_parts), "unit:parts=[a:b=[c]]");
    EXPECT_EQ(parse_spec("unit:parts=[a:b=[c]]").values(of_parts), values);
}

}  // namespace stipple::testing::options_test
