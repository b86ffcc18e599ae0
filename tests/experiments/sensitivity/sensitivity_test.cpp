// SPDX-License-Identifier: MIT
//
// The unit: recognition of inputs and outputs, choice of the method, errors.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/text.hpp"
#include "experiments/sensitivity/models.hpp"
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
    // Some of the inputs, by name and number.
    const Report two =
        analyze(unit, outputs_of(rows, linear),
                {{"design", design.path()}, {"method", "rank"}, {"inputs", "load,1"}});
    EXPECT_EQ(two.find("y.width"), nullptr);
    EXPECT_NEAR(two.number("y.length.first"), 9. / 14, 0.1);
}

/// Notes of a call.
std::vector<std::string> notes_of(const PointSet& table, const Settings& settings) {
    std::vector<std::string> told;
    RunContext run;
    run.warn = [&](const std::string& sentence) { told.push_back(sentence); };
    analyze(unit, table, settings, run);
    return told;
}

// A copy of an input has its name and its numbers, up to rounding in the file.
TEST(Sensitivity, CopiesOfInputsAreNoOutputsButNoneVanishes) {
    Rows rows = points_in(make("sobol", points(64, 2, 1)));
    const TemporaryFile design(csv_of("a,b", rows), ".csv");
    for (auto& row : rows) row = {row[1], row[0] * (1 + 1e-7), row[0] + row[1], row[0]};
    PointSet table = points_of(rows);
    table.provenance.columns = {"other", "a", "sum", "first.one"};
    const Settings settings = {{"design", design.path()}, {"method", "rank"}};
    const Report report = analyze(unit, table, settings);
    ASSERT_EQ(report.entries().size(), 3U);
    EXPECT_NEAR(report.number("other.b.first"), 1, 0.1);
    EXPECT_NEAR(report.number("sum.a.first"), 0.5, 0.1);
    EXPECT_NEAR(report.number("first_one.a.first"), 1, 0.1);
    EXPECT_EQ(notes_of(table, settings),
              (std::vector<std::string>{"the output other is equal to the input b",
                                        "the output first.one is equal to the input a"}));
    const Report asked = analyze(
        unit, table, {{"design", design.path()}, {"method", "rank"}, {"response", "first.one,3"}});
    EXPECT_EQ(asked.entries().size(), 2U);

    table.provenance.columns = {"other", "b", "sum", "y"};
    EXPECT_THAT(refusal(table, settings),
                HasSubstr("the column b has the name of an input, but other numbers: "));
    table = points_of(points_in(make("sobol", points(64, 2, 1))));
    table.provenance.columns = {"a", "b"};
    EXPECT_EQ(
        refusal(table, settings),
        "input: all columns of the table are copies of inputs: a, b | --response selects outputs");
}

// Provenance of a design with an added column has the names of its own columns.
TEST(Sensitivity, ProvenanceNamesTheInputs) {
    PointSet table =
        with_outputs(points_in(make("sobol", points(64, 2))), [](auto u) { return u[0]; });
    table.provenance = make("sobol", points(64, 2)).provenance;
    table.provenance.columns = {"x", "load", "y"};
    for (std::size_t i = 0; i < 64; ++i) std::swap(table[i][1], table[i][2]);
    const Report report = analyze(unit, table, {{"method", "rank"}});
    ASSERT_EQ(report.entries().size(), 1U);
    EXPECT_NEAR(report.number("load.x.first"), 1, 0.1);
    EXPECT_NE(report.find("load.y.first"), nullptr);
    EXPECT_EQ(notes_of(table, {}), std::vector<std::string>{});
    // If one output is selected, the others are neither inputs nor outputs.
    table.provenance.columns = {"a", "load", "b"};
    EXPECT_THAT(refusal(table),
                HasSubstr("the table has no column x, y for the inputs of its design"));
    EXPECT_EQ(notes_of(table, {{"inputs", "b"}, {"response", "load"}}),
              (std::vector<std::string>{
                  "the table: columns that are neither input nor output: a",
                  "the table: some of x, y are missing, so that their distribution is ignored"}));
    EXPECT_THAT(refusal(make("sobol", points(64, 2))), HasSubstr("has no outputs"));
    PointSet words = with_outputs(points_in(make("sobol", points(8, 1))), [](auto) { return 1; });
    words.provenance.columns = {"a", "state"};
    words.provenance.levels = {{"state", {"good", "bad"}}};
    EXPECT_THAT(refusal(words), HasSubstr("the output state contains words, such as good"));
}

TEST(Sensitivity, NamesWithCommasAreQuotedAsInCsv) {
    PointSet table = with_outputs(points_in(make("sobol", points(64, 2))), linear);
    table.provenance.columns = {"length, outer", "b", "result, y"};
    const Report report = analyze(
        unit, table,
        {{"method", "rank"}, {"inputs", "\"length, outer\", b"}, {"response", "\"result, y\""}});
    ASSERT_EQ(report.entries().size(), 1U);
    EXPECT_NE(report.find("result, y.length, outer.first"), nullptr);
    EXPECT_NE(report.find("result, y.b.first"), nullptr);
    EXPECT_THAT(refusal(table, {{"response", "\"result, y"}}),
                HasSubstr("--response: a quote is not closed in '\"result, y'"));
}

TEST(Sensitivity, WithoutADesignTheLastColumnIsTheOutput) {
    const PointSet table = with_outputs(points_in(make("sobol", points(128, 3))), linear);
    EXPECT_EQ(
        notes_of(table, {}),
        std::vector<std::string>{"the last column is used as the output, x4, and the others as "
                                 "inputs, x1, x2, x3; --response and --inputs select others"});
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

// Maps of single coordinates preserve equality of coordinates and the period of curves.
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

// Complete rows that fit no method, in any order, cause a note; so do dependent inputs.
TEST(Sensitivity, SaysThatADesignIsBroken) {
    Rows rows = pick_freeze_rows(make("sobol", points(64, 6)), false);
    std::rotate(rows.begin(), rows.begin() + 2, rows.end());
    PointSet table = with_outputs(rows, linear);
    const Settings settings = {{"response", "4"}};
    ASSERT_EQ(notes_of(table, settings).size(), 1U);
    EXPECT_THAT(notes_of(table, settings)[0],
                HasSubstr("83 % of the rows differ from another row in one input"));
    table.provenance = make("saltelli", points(320, 3)).provenance;
    table.provenance.columns = {"x", "y", "z", "out"};
    ASSERT_EQ(notes_of(table, {}).size(), 1U);
    EXPECT_THAT(
        notes_of(table, {})[0],
        HasSubstr("saltelli made the design, but its rows are not complete: in groups of 8, "));

    Rows dependent = points_in(make("sobol", points(256, 2)));
    for (auto& row : dependent) row[1] = 0.7 * row[0] + 0.3 * row[1];
    const PointSet plain = with_outputs(dependent, [](auto u) { return u[0]; });
    ASSERT_EQ(notes_of(plain, {{"response", "3"}}).size(), 1U);
    EXPECT_THAT(
        notes_of(plain, {{"response", "3"}})[0],
        HasSubstr("the inputs x and y depend on each other: their rank correlation is 0.9"));
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
        const auto free = points_in(make("random", points(50, 5), {}, {.seed = seed}));
        EXPECT_EQ(notes_of(with_outputs(free, linear), {{"response", "6"}, {"method", "auto"}}),
                  std::vector<std::string>{});
    }
}

// A 2^2 design in the order 00, 10, 01, 11 has the rows of pick-freeze only with A = 00 and B = 11.
TEST(Sensitivity, ReplicatedFactorialsAreNoPickFreeze) {
    Rows rows;
    for (int replicate = 0; replicate < 6; ++replicate)
        rows.insert(rows.end(), {{0, 0}, {1, 0}, {0, 1}, {1, 1}});
    int run = 0;
    const PointSet table =
        with_outputs(rows, [&](auto u) { return u[0] + 2 * u[1] + 0.01 * (run++ % 5); });
    EXPECT_NE(analyze(unit, table).text("z.method"), "saltelli");
    EXPECT_THAT(refusal(table, {{"method", "saltelli"}}),
                HasSubstr("like corners of a factorial design"));
    // Two-level inputs of real pick-freeze rows are equal in A and B half of the time.
    Rows levels = pick_freeze_rows(make("random", points(32, 4)), false);
    for (auto& row : levels)
        for (double& x : row) x = std::floor(2 * x);
    EXPECT_EQ(
        analyze(unit, with_outputs(levels, [](auto u) { return u[0] + u[1]; })).text("z.method"),
        "saltelli");
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
    EXPECT_THAT(refusal(table, {{"inputs", "x,x"}}), HasSubstr("--inputs: 'x' is given twice"));
    EXPECT_THAT(refusal(table, {{"inputs", "x,z"}}), HasSubstr("--inputs: 'z' is also an output"));
    EXPECT_THAT(refusal(points_of({{1}, {2}})),
                HasSubstr("a table of 1 column has no inputs besides the outputs | --design"));
}

// Constant outputs have no indices, with a reason; rounding errors are not variance. Other outputs
// have indices.
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
                        HasSubstr("in all runs, up to rounding"))
                << method << ' ' << key;
            EXPECT_EQ(report.find(std::string(key) + ".x1"), nullptr) << method << ' ' << key;
        }
        EXPECT_EQ(report.text("x6.missing"), "all runs failed") << method;
        EXPECT_EQ(report.number("x6.failed"), static_cast<double>(rows.size()));
        EXPECT_NEAR(report.number("x7.x1.first"), 1, 0.3) << method;
    }
    const PointSet trajectories = with_outputs(morris_rows(4, 2, 1), [](auto) { return 0.1; });
    EXPECT_EQ(measure(unit, "z.x.mu_star", trajectories), 0);  // no effect at all
}

TEST(Sensitivity, AnOutputWithTooFewRunsDoesNotHideOthers) {
    PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    for (std::size_t i = 3; i < 64; ++i) table[i][2] = std::nan("");
    const Report report =
        analyze(unit, table, {{"inputs", "1,2"}, {"response", "3,4"}, {"method", "rank"}});
    EXPECT_EQ(report.text("x3.missing"),
              "the output x3 has 3 successful runs; rank indices need 4");
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
              "input: --method saltelli: the rows are not such a design: in groups of 5, point 1 "
              "is not the expected mix of the first and last points of its group | --method rank "
              "and chaos accept any design");
    EXPECT_THAT(refusal(table, {{"method", "morris"}}),
                HasSubstr("points 0 and 1 do not differ in exactly one coordinate"));
    EXPECT_THAT(refusal(table, {{"method", "fast"}}),
                HasSubstr("coordinate 1 oscillates too fast on curve 1, or not at all"));
    EXPECT_THAT(refusal(table, {{"method", "fast"}, {"harmonics", "1"}}),
                HasSubstr("coordinate 1 oscillates too fast on curve 1"));
    const PointSet odd = with_outputs(points_in(make("sobol", points(61, 3))), linear);
    EXPECT_THAT(refusal(odd, {{"method", "saltelli"}}),
                HasSubstr("61 rows are not a multiple of 5 or 8"));
    EXPECT_THAT(refusal(odd, {{"method", "morris"}}), HasSubstr("61 rows are not a multiple of 4"));
    EXPECT_THAT(refusal(odd, {{"method", "fast"}}), HasSubstr("61 rows are not a multiple of 3"));
}

TEST(Sensitivity, RefusesTooFewRuns) {
    const auto some = [](std::size_t n) {
        return with_outputs(points_in(make("sobol", points(n, 2))), [](auto u) { return u[0]; });
    };
    EXPECT_EQ(refusal(some(3), {{"method", "rank"}}),
              "input: the output z has 3 successful runs; rank indices need 4");
    EXPECT_EQ(refusal(some(7), {{"method", "chaos"}}),
              "input: the output z has 7 successful runs; polynomial chaos needs 8");
    EXPECT_EQ(refusal(some(4)), "");
    EXPECT_THAT(refusal(with_outputs(pick_freeze_rows(make("sobol", points(1, 4, 2)), false),
                                     [](auto u) { return u[0]; }),
                        {{"method", "saltelli"}}),
                HasSubstr("has 1 base rows without failed runs; expected at least 2"));
    EXPECT_THAT(refusal(with_outputs(morris_rows(1, 2, 1), [](auto u) { return u[0]; })),
                HasSubstr("has 1 trajectories without failed runs; expected at least 2"));
}

TEST(Sensitivity, RefusesOptionsOfOtherMethods) {
    const PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    for (const auto& [option, value] :
         {std::pair{"bootstrap", "10"}, {"bootstrap-seed", "2"}, {"harmonics", "4"}})
        EXPECT_THAT(refusal(table, {{option, value}}), HasSubstr("this is chaos")) << option;
    EXPECT_EQ(refusal(table, {{"degree", "2"}, {"method", "rank"}}),
              "usage: --degree applies to --method chaos; this is rank");
}

TEST(Sensitivity, NamesRunsThatFailed) {
    PointSet table = with_outputs(points_in(make("sobol", points(64, 3))), linear);
    for (const std::size_t i : {3, 7, 8, 20, 30, 31}) table[i][3] = std::nan("");
    const Settings settings = {{"method", "chaos"}, {"response", "x4"}};
    const Report report = analyze(unit, table, settings);
    EXPECT_EQ(notes_of(table, settings),
              std::vector<std::string>{
                  "x4: 6 of 64 runs failed, points 3, 7, 8, 20, 30, ...; 58 runs are used"});
    EXPECT_EQ(report.number("x4.failed"), 6);
    EXPECT_EQ(report.number("x4.used"), 58);
    EXPECT_NEAR(report.number("x4.x1.first"), 9. / 14, 1e-12);
    table[5][0] = std::nan("");
    EXPECT_EQ(refusal(table),
              "input: the input x1 of point 5 is missing; only outputs may be missing");
}

}  // namespace stipple::testing::sensitivity_test
