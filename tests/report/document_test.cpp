// SPDX-License-Identifier: MIT
#include "report/document.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "report/check.hpp"
#include "support/units.hpp"

namespace stipple::testing::document_test {
namespace {

Measurement sample() {
    Measurement m;
    m.analyzer = "unit";
    m.source = "a,b.csv";
    m.count = 3;
    m.dimension = 2;
    m.domain = "unit-cube";
    m.options = {
        {"flag", "true"}, {"count", "12"}, {"x", "0.5"}, {"word", "polar"}, {"list", "1,2"}};
    m.results.add("value", 0.1, "cells").add("flag", true).add("word", "fine");
    m.results.add("huge", std::numeric_limits<double>::infinity());
    m.results.add("curves",
                  Report().add("f", Report::Curve{1, 2}).add("n", Report::Integers{8, 16}));
    m.results.add("grid", Grid{1, 1, {7}});
    return m;
}

}  // namespace

TEST(Document, JsonHasTypesAndNoGridsOrInfinities) {
    const Measurement m = sample();
    const auto json = nlohmann::json::parse(to_json({&m, 1}));
    EXPECT_EQ(
        json["options"],
        nlohmann::json::parse(R"({"flag":true,"count":12,"x":0.5,"word":"polar","list":"1,2"})"));
    EXPECT_EQ(json["results"]["value"], 0.1);
    EXPECT_TRUE(json["results"]["huge"].is_null());
    EXPECT_EQ(json["results"]["curves"]["n"], (std::vector<int>{8, 16}));
    EXPECT_FALSE(json["results"].contains("grid"));
    const std::vector<Measurement> two = {m, m};
    EXPECT_EQ(nlohmann::json::parse(to_json(two)).size(), 2U);
}

// Text is read by people, JSON and CSV by programs.
TEST(Document, OnlyTextIsRounded) {
    const std::vector<std::pair<double, const char*>> cases = {{1.0 / 3, "0.333333"},
                                                               {-0.0, "0"},
                                                               {0.00012345678, "0.000123457"},
                                                               {12345.6789, "12345.7"},
                                                               {999999.7, "1000000"},
                                                               {123456789.25, "123456789"},
                                                               {999999999999999, "999999999999999"},
                                                               {1e15, "1e+15"},
                                                               {1.5e-5, "1.5e-05"},
                                                               {2.5e9 + 0.5, "2.5e+09"},
                                                               {1048576, "1048576"}};
    for (const auto& [x, text] : cases) {
        EXPECT_EQ(text_of(x), text);
        EXPECT_EQ(text_of(Report::Curve{x, x}), std::string(text) + " " + text);
    }
    Measurement m = sample();
    m.results.add("value", 1.0 / 3);
    EXPECT_THAT(to_json({&m, 1}), ::testing::HasSubstr("0.3333333333333333"));
    EXPECT_THAT(to_csv({&m, 1}), ::testing::HasSubstr("0.3333333333333333"));
}

TEST(Document, TextShortensALongDomain) {
    Measurement m = sample();
    m.domain = "parameters:json=[" + std::string(100, 'x') + "]";
    EXPECT_THAT(to_text({&m, 1}), ::testing::HasSubstr("dimension 2, parameters)\n"));
}

TEST(Document, CsvIsATidyTableOfItsCurves) {
    Measurement m = sample();
    m.dimension = 1;
    EXPECT_EQ(to_csv({&m, 1}),
              "analyzer,source,set,count,dimension,domain,value,flag,word,huge,curves.f,curves.n\n"
              "unit,\"a,b.csv\",,3,1,unit-cube,0.1,true,fine,inf,1,8\n"
              "unit,\"a,b.csv\",,3,1,unit-cube,0.1,true,fine,inf,2,16\n");
}

// Lists that are not curves: the coordinates of a corner, and one number for each axis.
TEST(Document, CsvHasOneRowForAResultWithoutCurves) {
    Measurement m = sample();
    m.results = Report();
    m.results.add(
        "box", Report().add("corner", Report::Curve{0.5, 0.25, 1}).add("points", std::int64_t{7}));
    m.results.add("mean", Report::Curve{1, 2}).add("variance", Report::Curve{3, 4});
    EXPECT_EQ(to_csv({&m, 1}),
              "analyzer,source,set,count,dimension,domain,box.corner.0,box.corner.1,box.corner.2,"
              "box.points,mean.0,mean.1,variance.0,variance.1\n"
              "unit,\"a,b.csv\",,3,2,unit-cube,0.5,0.25,1,7,1,2,3,4\n");
}

// Keys may contain names of columns.
TEST(Document, CsvQuotesTheNamesOfColumns) {
    Measurement m = sample();
    m.results = Report().add("length, \"outer\"", 0.5);
    EXPECT_EQ(to_csv({&m, 1}),
              "analyzer,source,set,count,dimension,domain,\"length, \"\"outer\"\"\"\n"
              "unit,\"a,b.csv\",,3,2,unit-cube,0.5\n");
}

TEST(Document, CsvTablesOfOneReportFollowEachOther) {
    Measurement m = sample();
    m.dimension = 1;
    m.results = Report();
    m.results.add("value", std::int64_t{5})
        .add("prefixes",
             Report().add("n", Report::Integers{1, 2, 4}).add("t", Report::Curve{7, 8, 9}));
    m.results.add("pairs",
                  Report().add("axis", Report::Integers{1, 2}).add("t", Report::Curve{0, 1}));
    const std::string same = "unit,\"a,b.csv\",,3,1,unit-cube,5,";
    EXPECT_EQ(to_csv({&m, 1}),
              "analyzer,source,set,count,dimension,domain,value,prefixes.n,prefixes.t,pairs.axis,"
              "pairs.t\n" +
                  same + "1,7,,\n" + same + "2,8,,\n" + same + "4,9,,\n" + same + ",,1,0\n" + same +
                  ",,2,1\n");
}

// Reports with different keys, or fewer numbers in a list, keep their own columns.
TEST(Document, CsvColumnsAreThoseOfAllResults) {
    Measurement one = sample();
    Measurement two = sample();
    one.results = Report().add("a", std::int64_t{1}).add("corner", Report::Curve{0.5, 0.25});
    two.results = Report().add("corner", Report::Curve{1}).add("b", std::int64_t{2});
    const std::string same = "unit,\"a,b.csv\",,3,2,unit-cube,";
    EXPECT_EQ(to_csv(std::vector{one, two}),
              "analyzer,source,set,count,dimension,domain,a,corner.0,corner.1,b\n" + same +
                  "1,0.5,0.25,\n" + same + ",1,,2\n");
}

TEST(Document, TextNamesUnits) {
    const Measurement m = sample();
    const std::string text = to_text({&m, 1});
    EXPECT_NE(text.find("  value     0.1 cells\n"), std::string::npos) << text;
    EXPECT_NE(text.find("  flag      yes\n"), std::string::npos) << text;
}

TEST(Check, ComparesNumbersWordsAndFlags) {
    const Report report = sample().results;
    for (const char* text : {"value<0.2", "value <= 0.1", "value==0.1", "value!=1", "value>-1",
                             "flag==true", "word==fine", "word!=bad", "flag!=false"})
        EXPECT_TRUE(parse_check(text).holds(report)) << text;
    for (const char* text : {"value<0.1", "value>=0.2", "word==bad"})
        EXPECT_FALSE(parse_check(text).holds(report)) << text;
    for (const char* text : {"value", "value<", "<1", "value=<1", "value<<1"})
        EXPECT_TRUE(error_of([&] { parse_check(text); }).starts_with("usage: --check")) << text;
    for (const char* text : {"vlaue<1", "word<1", "value<one", "curves.f<1"})
        EXPECT_TRUE(error_of([&] { (void)parse_check(text).holds(report); }).starts_with("usage: "))
            << text;
}

TEST(Check, TakesOneOfSeveralNumbers) {
    Report report;
    report.add("mean", Report::Curve{0.25, 0.5}).add("grid", Report::Integers{3, 5});
    for (const char* text : {"mean[0]==0.25", "mean[1]>0.4", "grid[1]==5"})
        EXPECT_TRUE(parse_check(text).holds(report)) << text;
    EXPECT_FALSE(parse_check("mean[1]<0.5").holds(report));
    for (const char* text : {"mean[2]<1", "mean[-1]<1", "mean[]<1", "mean<1", "mena[0]<1"})
        EXPECT_TRUE(error_of([&] { (void)parse_check(text).holds(report); }).starts_with("usage: "))
            << text;
}

// Names may come from any program or file.
TEST(Document, NamesMayHoldDots) {
    Report inner;
    inner.add("b.c", 2, "points").add("d", 3);
    Report report;
    report.add("a.b", 1, "seconds").add("a", inner).add("a.b.d", 4);
    EXPECT_EQ(report.keys(), (std::vector<std::string>{"a.b", "a.b.c", "a.d", "a.b.d"}));
    EXPECT_EQ(report.number("a.b"), 1);
    EXPECT_EQ(report.number("a.b.c"), 2);
    EXPECT_EQ(report.number("a.d"), 3);
    EXPECT_EQ(report.number("a.b.d"), 4);
    EXPECT_EQ(report.find("a.c"), nullptr);
    EXPECT_THAT(to_text(report), ::testing::HasSubstr("a.b.c  2 points\n"));
}

// Standard errors of a mean are separate columns, after the results.
TEST(Document, CsvOfAMeanHasItsStandardErrors) {
    Measurement m{.analyzer = "a", .source = "p", .count = 4, .dimension = 2, .domain = "disk"};
    m.results.add("value", 0.5).add("curve", Report::Curve{1, 2});
    m.standard_error.emplace();
    m.standard_error->add("value", 0.25).add("curve", Report::Curve{0.5, 0.125});
    EXPECT_EQ(to_csv(std::vector{m}),
              "analyzer,source,set,count,dimension,domain,value,curve.0,curve.1,"
              "standard_error.value,standard_error.curve.0,standard_error.curve.1\n"
              "a,p,,4,2,disk,0.5,1,2,0.25,0.5,0.125\n");
}

TEST(Document, CsvHasErrorsOfCurvesOnTheirRows) {
    Measurement m{.analyzer = "a", .source = "p", .count = 4, .dimension = 1, .domain = "disk"};
    m.results.add("x", Report::Curve{1, 2}).add("y", Report::Curve{3, 4});
    m.standard_error.emplace();
    m.standard_error->add("x", Report::Curve{0.5, 0.25}).add("y", Report::Curve{0, 0.125});
    EXPECT_EQ(to_csv(std::vector{m}),
              "analyzer,source,set,count,dimension,domain,x,y,standard_error.x,standard_error.y\n"
              "a,p,,4,1,disk,1,3,0.5,0\n"
              "a,p,,4,1,disk,2,4,0.25,0.125\n");
}

}  // namespace stipple::testing::document_test
