// SPDX-License-Identifier: MIT
#include "study/study_table.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "study/unit_runner.hpp"
#include "support/units.hpp"

namespace stipple::testing::study_table_test {
namespace {

StudyRow awkward() {
    StudyRow row;
    row.generator = "a:b=[1,2 3,4]";
    row.generator_options = "text=say \"hello\", twice;n=3";
    row.dimension = 3;
    row.count = 9007199254740993;
    row.points = 12;
    row.seed = 18446744073709551615U;
    row.measure = "moments";
    row.domain = "disk";
    row.key = "mean[0]";
    row.value = 0.1;
    row.status = "ok";
    row.reason = "none; \\ 'really'";
    row.study = "0123456789abcdef";
    row.generate_seconds = 0.25;
    row.seconds = 1.5e-05;
    return row;
}

}  // namespace

TEST(StudyTable, RowsReadBack) {
    for (const auto style : {TableStyle::csv, TableStyle::jsonl})
        for (const bool seconds : {true, false}) {
            const StudyTable table(style, seconds);
            const std::string line = table.line(awkward());
            ASSERT_TRUE(line.ends_with("\n"));
            const auto row = table.parse(std::string_view(line).substr(0, line.size() - 1));
            ASSERT_TRUE(row) << line;
            EXPECT_EQ(table.line(*row), line);
            EXPECT_TRUE(belongs(*row, awkward()));
            EXPECT_EQ(row->value, 0.1);
            EXPECT_EQ(row->seconds.has_value(), seconds);
        }
}

TEST(StudyTable, APartOfARowIsNone) {
    for (const auto style : {TableStyle::csv, TableStyle::jsonl}) {
        const StudyTable table(style, false);
        const std::string line = table.line(awkward());
        for (std::size_t cut = 0; cut + 8 < line.size(); ++cut)
            EXPECT_FALSE(table.parse(line.substr(0, cut))) << cut;
    }
}

TEST(StudyTable, ARowWhoseNumbersAreNoneIsNone) {
    const StudyTable table(TableStyle::csv, true);
    const std::string line = table.line(awkward());
    for (const char* number : {",3,", ",9007199254740993,", ",12,", ",0.1,", ",0.25,"}) {
        std::string broken = line.substr(0, line.size() - 1);
        broken.replace(broken.find(number), std::string_view(number).size(), ",1x,");
        EXPECT_FALSE(table.parse(broken)) << broken;
    }
}

TEST(StudyTable, InfiniteAndMissingValuesAreWritten) {
    StudyRow row = awkward();
    row.value = HUGE_VAL;
    const StudyTable csv(TableStyle::csv, false);
    const StudyTable jsonl(TableStyle::jsonl, false);
    const std::string line = csv.line(row);
    EXPECT_NE(line.find(",inf,"), std::string::npos);
    EXPECT_EQ(csv.parse(line.substr(0, line.size() - 1))->value, HUGE_VAL);
    EXPECT_NE(jsonl.line(row).find("\"value\":\"inf\""), std::string::npos);
    row.value.reset();
    row.points.reset();
    EXPECT_NE(jsonl.line(row).find("\"value\":null"), std::string::npos);
    EXPECT_FALSE(jsonl.parse(jsonl.line(row))->points);
}

TEST(NumbersOf, FlattensNumbersAndLeavesListsOutUnlessAsked) {
    Report inner;
    inner.add("corner", Report::Curve{0.5, 1});
    inner.add("points", std::int64_t{3});
    Report report;
    report.add("value", 0.25);
    report.add("exact", true);
    report.add("method", "sweep");
    report.add("box", inner);
    const auto keys_of = [](const std::vector<KeyedNumber>& numbers) {
        std::string keys;
        for (const auto& n : numbers) keys += n.key + " ";
        return keys;
    };
    EXPECT_EQ(keys_of(numbers_of(report, {}, false)), "value exact box.points ");
    EXPECT_EQ(keys_of(numbers_of(report, {}, true)),
              "value exact box.points box.corner[0] box.corner[1] ");
    EXPECT_EQ(keys_of(numbers_of(report, {"box.corner[1]", "value"}, false)),
              "value box.corner[1] ");
    EXPECT_EQ(keys_of(numbers_of(report, {"box"}, false)),
              "box.points box.corner[0] box.corner[1] ");
    EXPECT_EQ(keys_of(numbers_of(report, {"points"}, false)), "box.points ");
    EXPECT_EQ(keys_of(numbers_of(report, {"val"}, false)), "");
    Report lists;
    lists.add("mean", Report::Curve{1, 2});
    EXPECT_EQ(keys_of(numbers_of(lists, {}, false)), "mean[0] mean[1] ");
}

}  // namespace stipple::testing::study_table_test
