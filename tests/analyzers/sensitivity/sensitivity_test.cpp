// SPDX-License-Identifier: MIT
//
// The unit: which columns are inputs and outputs, which method is taken, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "analyzers/sensitivity/models.hpp"
#include "core/text.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::sensitivity_test {

using namespace sensitivity;

using ::testing::HasSubstr;

namespace {

constexpr const char* unit = "sensitivity";

std::string csv_of(const std::string& header, const Rows& rows) {
    std::string text = header + "\n";
    for (const auto& row : rows)
        for (std::size_t j = 0; j < row.size(); ++j)
            text += format_number(row[j]) + (j + 1 < row.size() ? "," : "\n");
    return text;
}

PointSet outputs_of(const Rows& rows, const Model& model, std::string name = {}) {
    PointSet table(rows.size(), 1);
    for (std::size_t i = 0; i < rows.size(); ++i) table[i][0] = model(rows[i]);
    if (!name.empty()) table.provenance.columns = {std::move(name)};
    return table;
}

std::string refusal(const PointSet& table, const Settings& settings = {}) {
    return error_of([&] { analyze(unit, table, settings); });
}

}  // namespace

TEST(Sensitivity, DesignNamesTheInputsAndTheTableTheOutputs) {
    const Rows rows = points_in(make("sobol", points(256, 3)));
    const TemporaryFile design(csv_of("length,width,load", rows), ".csv");
    const Report named = analyze(unit, outputs_of(rows, linear, "stress"),
                                 {{"design", design.path()}, {"method", "chaos"}});
    EXPECT_NEAR(named.number("stress.length.first"), 9. / 14, 1e-12);
    EXPECT_NEAR(named.number("stress.width.total"), 4. / 14, 1e-12);
    EXPECT_NEAR(named.number("stress.mean"), 3, 0.02);
    const Report nameless =
        analyze(unit, outputs_of(rows, linear), {{"design", design.path()}, {"method", "chaos"}});
    EXPECT_EQ(nameless.number("y.length.first"), named.number("stress.length.first"));
    // A part of the inputs, by name and number.
    const Report two =
        analyze(unit, outputs_of(rows, linear),
                {{"design", design.path()}, {"method", "rank"}, {"inputs", "load,1"}});
    EXPECT_EQ(two.find("y.width"), nullptr);
    EXPECT_NEAR(two.number("y.length.first"), 9. / 14, 0.1);
}

// The table may repeat inputs, by number or by name, and hold several outputs.
TEST(Sensitivity, CopiesOfInputsAreNoOutputs) {
    Rows rows = points_in(make("sobol", points(64, 2)));
    const TemporaryFile design(csv_of("a,b", rows), ".csv");
    for (auto& row : rows) row = {row[1], row[0] + 1e-7, row[0] + row[1], row[0]};
    PointSet table = points_of(rows);
    table.provenance.columns = {"other", "a", "sum", "first.one"};
    const Report report =
        analyze(unit, table, {{"design", design.path()}, {"method", "chaos"}, {"degree", "1"}});
    ASSERT_EQ(report.entries().size(), 1U);
    EXPECT_NEAR(report.number("sum.a.first"), 0.5, 1e-3);
    const Report asked = analyze(
        unit, table, {{"design", design.path()}, {"method", "rank"}, {"response", "first.one,3"}});
    ASSERT_EQ(asked.entries().size(), 2U);
    EXPECT_NEAR(asked.number("first_one.a.first"), 1, 0.1);
    EXPECT_NEAR(asked.number("sum.b.first"), 0.5, 0.1);
}

TEST(Sensitivity, WithoutADesignTheLastColumnIsTheOutput) {
    const PointSet table = with_outputs(points_in(make("sobol", points(128, 3))), linear);
    const Report report = analyze(unit, table, {{"method", "chaos"}});
    EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 1e-12);
    const Report picked =
        analyze(unit, table, {{"method", "rank"}, {"response", "x1"}, {"inputs", "x4,2"}});
    EXPECT_NE(picked.find("x1.x2.first"), nullptr);
    EXPECT_EQ(picked.find("x1.x3.first"), nullptr);
}

TEST(Sensitivity, NamesThatMeetOthersStayApart) {
    PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    table.provenance.columns = {"mean", "a", "a", "y"};
    const Report report = analyze(unit, table, {{"method", "rank"}});
    EXPECT_NEAR(report.number("y.mean"), 3, 0.1);
    EXPECT_NEAR(report.number("y.mean_.first"), 9. / 14, 0.1);
    EXPECT_NEAR(report.number("y.a.first"), 4. / 14, 0.15);
    EXPECT_NEAR(report.number("y.a_.first"), 1. / 14, 0.15);
}

TEST(Sensitivity, TheDesignShowsItsMethod) {
    const auto method = [](const Rows& rows, const Model& model = ishigami) {
        return analyze(unit, with_outputs(rows, model)).text("x4.method");
    };
    const PointSet base = make("sobol", points(64, 6));
    EXPECT_EQ(method(pick_freeze_rows(base, false)), "saltelli");
    EXPECT_EQ(method(pick_freeze_rows(base, true)), "saltelli");
    EXPECT_EQ(method(morris_rows(20, 3, 1)), "morris");
    EXPECT_EQ(method(fast_rows(129, 3, 1)), "fast");
    EXPECT_EQ(method(points_in(make("sobol", points(512, 3)))), "chaos");
    const Rng rng(5);
    const auto noise = [&](std::span<const double> u) {
        return u[0] + rng.uniform(static_cast<std::uint64_t>(u[1] * 0x1p40));
    };
    EXPECT_EQ(method(points_in(make("sobol", points(512, 3))), noise), "rank");
}

// Equal coordinates stay equal under maps of single coordinates, and curves keep their period.
TEST(Sensitivity, WarpedDesignsKeepTheirMethod) {
    const auto method = [](Rows rows) {
        for (auto& row : rows)
            for (double& x : row) x = 20 + std::exp(x);
        return analyze(unit, with_outputs(rows, linear)).text("x4.method");
    };
    EXPECT_EQ(method(pick_freeze_rows(make("sobol", points(64, 6)), true)), "saltelli");
    EXPECT_EQ(method(morris_rows(20, 3, 1)), "morris");
    EXPECT_EQ(method(fast_rows(129, 3, 1)), "fast");
}

TEST(Sensitivity, RefusesAnotherNumberOfRows) {
    const TemporaryFile design("a,b\n0.1,0.2\n0.3,0.4\n0.5,0.6\n", ".csv");
    EXPECT_EQ(refusal(points_of({{1}, {2}}), {{"design", design.path()}}),
              "input: " + design.path() + ": 3 rows; the outputs have 2");
}

TEST(Sensitivity, RefusesColumnsThatAreNotThere) {
    const PointSet table =
        with_outputs(points_in(make("sobol", points(16, 2))), [](auto u) { return u[0]; });
    EXPECT_THAT(
        refusal(table, {{"response", "w"}}),
        HasSubstr("usage: --response: the table has no column 'w'; its columns are 1 to 3"));
    EXPECT_THAT(refusal(table, {{"inputs", "x,x"}}), HasSubstr("--inputs: 'x' is named twice"));
    EXPECT_THAT(refusal(table, {{"inputs", "x,z"}}), HasSubstr("--inputs: 'z' is an output, too"));
    EXPECT_THAT(refusal(points_of({{1}, {2}})),
                HasSubstr("a table of 1 column holds no inputs beside the outputs | --design"));
}

// Shares of no variance are missing, with the reason; rounding is no variance. Other outputs have theirs.
TEST(Sensitivity, ConstantOutputsHaveNoIndices) {
    const std::vector<std::pair<std::string, Rows>> designs = {
        {"rank", points_in(make("sobol", points(64, 2)))},
        {"chaos", points_in(make("sobol", points(64, 2)))},
        {"saltelli", pick_freeze_rows(make("sobol", points(64, 4)), false)},
        {"fast", fast_rows(129, 2, 1)}};
    for (const auto& [method, rows] : designs) {
        PointSet table(rows.size(), 7);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const double step = static_cast<double>(i % 3) * 0x1p-50;
            const double values[] = {rows[i][0],           rows[i][1],        5.3,
                                     5.3 * (1 + step),     1e15 * (1 + step), std::nan(""),
                                     1e15 + 8 * rows[i][0]};
            std::ranges::copy(values, table[i].begin());
        }
        const Report report = analyze(
            unit, table, {{"method", method}, {"inputs", "1,2"}, {"response", "3,4,5,6,7"}});
        for (const char* key : {"x3", "x4", "x5"}) {
            EXPECT_THAT(report.text(std::string(key) + ".missing"),
                        HasSubstr("in all runs, but for rounding at most"))
                << method << ' ' << key;
            EXPECT_EQ(report.find(std::string(key) + ".x1"), nullptr) << method << ' ' << key;
        }
        EXPECT_EQ(report.text("x6.missing"), "all runs failed") << method;
        EXPECT_EQ(report.number("x6.failed"), static_cast<double>(rows.size()));
        EXPECT_NEAR(report.number("x7.x1.first"), 1, 0.3) << method;
    }
    const PointSet trajectories = with_outputs(morris_rows(4, 2, 1), [](auto) { return 0.1; });
    EXPECT_EQ(measure(unit, "z.x.mu_star", trajectories), 0);  // no share of anything
}

TEST(Sensitivity, AnOutputWithTooFewRunsDoesNotHideOthers) {
    PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    for (std::size_t i = 3; i < 64; ++i) table[i][2] = std::nan("");
    const Report report =
        analyze(unit, table, {{"inputs", "1,2"}, {"response", "3,4"}, {"method", "rank"}});
    EXPECT_EQ(report.text("x3.missing"), "the output x3 has 3 runs; ranks need 4");
    EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 0.1);
}

TEST(Sensitivity, SaysWhyItTookChaosOrRanks) {
    const auto reason = [](std::size_t n, const Model& model) {
        return analyze(unit, with_outputs(points_in(make("sobol", points(n, 2))), model))
            .text("z.reason");
    };
    const Model sum = [](auto u) { return u[0] + u[1]; };
    EXPECT_EQ(reason(64, sum), "q2 of chaos is 1, at least 0.8");
    EXPECT_EQ(reason(7, sum), "fewer than 8 runs, which chaos needs");
    const Rng rng(2);
    EXPECT_THAT(reason(256,
                       [&](auto u) {
                           return u[0] + rng.uniform(static_cast<std::uint64_t>(u[1] * 0x1p40));
                       }),
                HasSubstr("below 0.8"));
}

TEST(Sensitivity, RefusesAMethodThatTheDesignIsNotFor) {
    const PointSet table = with_outputs(points_in(make("sobol", points(60, 3))), linear);
    EXPECT_EQ(refusal(table, {{"method", "saltelli"}}),
              "input: --method saltelli: the design has not its rows: in groups of 5, point 1 is "
              "not the mix of the first and the last of its group that it should be | --method "
              "rank and chaos take any design");
    EXPECT_THAT(refusal(table, {{"method", "morris"}}),
                HasSubstr("points 0 and 1 do not differ in one coordinate"));
    EXPECT_THAT(refusal(table, {{"method", "fast"}}),
                HasSubstr("curves of 20 rows; 4 harmonics need 65"));
    EXPECT_THAT(refusal(table, {{"method", "fast"}, {"harmonics", "1"}}),
                HasSubstr("of the variance of coordinate 1 is at the curve's frequency"));
    const PointSet odd = with_outputs(points_in(make("sobol", points(61, 3))), linear);
    EXPECT_THAT(refusal(odd, {{"method", "saltelli"}}),
                HasSubstr("61 rows are no multiple of 5 or 8"));
    EXPECT_THAT(refusal(odd, {{"method", "morris"}}), HasSubstr("61 rows are no multiple of 4"));
    EXPECT_THAT(refusal(odd, {{"method", "fast"}}), HasSubstr("61 rows are no multiple of 3"));
}

TEST(Sensitivity, RefusesTooFewRuns) {
    const auto some = [](std::size_t n) {
        return with_outputs(points_in(make("sobol", points(n, 2))), [](auto u) { return u[0]; });
    };
    EXPECT_EQ(refusal(some(3), {{"method", "rank"}}),
              "input: the output z has 3 runs; ranks need 4");
    EXPECT_EQ(refusal(some(7), {{"method", "chaos"}}),
              "input: the output z has 7 runs; polynomial chaos needs 8");
    EXPECT_EQ(refusal(some(4)), "");
    EXPECT_THAT(refusal(with_outputs(pick_freeze_rows(make("sobol", points(1, 4, 2)), false),
                                     [](auto u) { return u[0]; }),
                        {{"method", "saltelli"}}),
                HasSubstr("has 1 base rows without failed runs; two are needed"));
    EXPECT_THAT(refusal(with_outputs(morris_rows(1, 2, 1), [](auto u) { return u[0]; })),
                HasSubstr("has 1 trajectories without failed runs; two are needed"));
}

TEST(Sensitivity, RefusesOptionsOfOtherMethods) {
    const PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    for (const auto& [option, value] :
         {std::pair{"bootstrap", "10"}, {"bootstrap-seed", "2"}, {"harmonics", "4"}})
        EXPECT_THAT(refusal(table, {{option, value}}), HasSubstr("this is chaos")) << option;
    EXPECT_EQ(refusal(table, {{"degree", "2"}, {"method", "rank"}}),
              "usage: --degree is of --method chaos; this is rank");
}

TEST(Sensitivity, NamesRunsThatFailed) {
    PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    for (const std::size_t i : {3, 7, 8, 20, 30, 31}) table[i][3] = std::nan("");
    std::vector<std::string> told;
    RunContext run;
    run.warn = [&](const std::string& sentence) { told.push_back(sentence); };
    const Report report = analyze(unit, table, {{"method", "chaos"}}, run);
    EXPECT_EQ(told, std::vector<std::string>{
                        "x4: 6 of 64 runs failed, points 3, 7, 8, 20, 30, ...; 58 runs are used"});
    EXPECT_EQ(report.number("x4.failed"), 6);
    EXPECT_EQ(report.number("x4.used"), 58);
    EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 1e-12);
    table[5][0] = std::nan("");
    EXPECT_EQ(refusal(table), "input: the input x1 of point 5 is missing; only outputs may be");
}

}  // namespace stipple::testing::sensitivity_test
