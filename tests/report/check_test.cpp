// SPDX-License-Identifier: MIT
#include "report/check.hpp"

#include <gtest/gtest.h>

#include "pipeline/chain.hpp"
#include "support/units.hpp"

namespace stipple::testing::check_test {
namespace {

/// A discrepancy with bounds 0.2 and 0.3.
Report between_bounds(bool exact) {
    Report report;
    report.add("value", 0.2);
    report.add("lower", 0.2);
    report.add("upper", exact ? 0.2 : 0.3);
    report.add("exact", exact);
    return report;
}

bool holds(const char* check, const Report& report) { return parse_check(check).holds(report); }

}  // namespace

TEST(Check, OfAValueBetweenBoundsHoldsForBoth) {
    EXPECT_TRUE(holds("value<0.25", between_bounds(true)));
    EXPECT_FALSE(holds("value<0.25", between_bounds(false)));
    EXPECT_TRUE(holds("value<=0.3", between_bounds(false)));
    EXPECT_TRUE(holds("value>0.19", between_bounds(false)));
    EXPECT_FALSE(holds("value>=0.25", between_bounds(false)));
    EXPECT_TRUE(holds("lower==0.2", between_bounds(false)));
    EXPECT_TRUE(holds("value==0.2", between_bounds(true)));
    EXPECT_EQ(error_of([] { holds("value==0.2", between_bounds(false)); }),
              "usage: --check: 'value' is only known to be between 0.2 and 0.3; compare it with <, "
              "<=, > or >=");
}

TEST(Check, KnowsTheOperatorsOfOtherLanguages) {
    const auto refusal = [](const char* text) { return error_of([&] { parse_check(text); }); };
    const std::string rule = " is not KEY<VALUE; expected one of <, <=, >, >=, == or !=";
    EXPECT_EQ(refusal("a=1"), "usage: --check: 'a=1'" + rule + " | did you mean '=='?");
    EXPECT_EQ(refusal("a=<1"), "usage: --check: 'a=<1'" + rule + " | did you mean '<='?");
    EXPECT_EQ(refusal("a<>1"), "usage: --check: 'a<>1'" + rule + " | did you mean '!='?");
    EXPECT_EQ(refusal("a!1"), "usage: --check: 'a!1'" + rule);
    EXPECT_EQ(refusal("<1"), "usage: --check: '<1'" + rule);
    EXPECT_EQ(refusal("a == 1"), "");
}

TEST(Check, OfAWordIsOneThatTheResultMayBe) {
    const auto refusal = [](const char* text) {
        const Check check = parse_check(text, "--fail-on");
        return error_of(
            [&] { require_sense(check, *find_result(find_analyzer("chi-square"), check.key)); });
    };
    EXPECT_EQ(refusal("verdict==stratified"), "");
    EXPECT_EQ(refusal("verdict!=uniform"), "");
    EXPECT_EQ(refusal("p_value<0.1"), "");
    EXPECT_EQ(refusal("verdict==foo"),
              "usage: --fail-on: 'verdict' cannot be 'foo'; possible values: uniform, non-uniform "
              "or stratified");
    EXPECT_EQ(refusal("verdict<1"),
              "usage: --fail-on: 'verdict' is uniform, non-uniform or stratified; compare it with "
              "== or !=");
    const Check flag = parse_check("exact==1");
    EXPECT_EQ(
        error_of([&] { require_sense(flag, *find_result(find_analyzer("dispersion"), flag.key)); }),
        "usage: --check: 'exact' cannot be '1'; possible values: true or false");
}

TEST(Check, NamesTheResultsThatThereAre) {
    EXPECT_EQ(error_of([] { holds("valeu<1", between_bounds(true)); }),
              "usage: --check: there is no result 'valeu' | did you mean 'value'?");
    EXPECT_EQ(error_of([] { holds("p<1", between_bounds(true)); }),
              "usage: --check: there is no result 'p' | known: value, lower, upper, exact");
}

TEST(Check, OfATablesValuesHoldsForBothBounds) {
    Report table;
    table.add("value", Report::Curve{0.1, 0.2});
    table.add("lower", Report::Curve{0.1, 0.2});
    table.add("upper", Report::Curve{0.1, 0.9});
    Report report;
    report.add("prefixes", table);
    EXPECT_TRUE(holds("prefixes.value[0]<0.5", report));
    EXPECT_FALSE(holds("prefixes.value[1]<0.5", report));
    EXPECT_TRUE(holds("prefixes.value[1]<0.95", report));
    EXPECT_EQ(
        error_of([&] { holds("prefixes.value<0.5", report); }),
        "usage: --check: 'prefixes.value' has 2 numbers; choose one, such as prefixes.value[0]");
}

}  // namespace stipple::testing::check_test
