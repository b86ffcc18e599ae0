// SPDX-License-Identifier: MIT
#include "math/densities/expression.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <tuple>

#include "core/rng.hpp"
#include "support/units.hpp"

namespace stipple::testing::expression_test {
namespace {

double value(const std::string& text, const std::vector<double>& point = {0.25, 0.5}) {
    return Expression("density", text, point.size()).at(point);
}

std::string refused(const std::string& text) {
    return error_of([&] { Expression("density", text, 2); });
}

}  // namespace

TEST(Expression, FollowsTheRulesOfArithmetic) {
    EXPECT_EQ(value("1 + 2 * 3 - 8 / 4"), 5);
    EXPECT_EQ(value("-2^2"), -4);
    EXPECT_EQ(value("2^3^2"), 512);
    EXPECT_EQ(value("2^-1"), 0.5);
    EXPECT_EQ(value("2^-1^2*3 - -4"), 5.5);
    EXPECT_EQ(value("-x^2/-y + +2"), 2.125);
    EXPECT_EQ(value("0 ? 1 : 2 ? 0 ? 3 : 4 : 5"), 4);
    EXPECT_EQ(value("1 || 0 && 0"), 1);
    EXPECT_EQ(value("(x + y) * 4"), 3);
    EXPECT_EQ(value("x1 + x2"), 0.75);
    EXPECT_EQ(value("x < y ? 7 : 8"), 7);
    EXPECT_EQ(value("x == 0.25 && y != 0.5 || x >= 1"), 0);
    EXPECT_EQ(value("1e-3 + .5 + 2. + 1.5E+1"), 1e-3 + .5 + 2. + 1.5E+1);
    EXPECT_EQ(value("min(3, x, 2) + max(x, y)"), 0.75);
    EXPECT_EQ(value("x3 + x4", {1, 2, 3, 4}), 7);
    EXPECT_EQ(value("z", {1, 2, 3}), 3);
}

// Compared with the C library, which is accurate within one unit in the last place.
TEST(Expression, FunctionsAreRight) {
    const std::vector<std::pair<std::string, std::function<double(double)>>> functions = {
        {"sin(x)", [](double x) { return std::sin(x); }},
        {"cos(x)", [](double x) { return std::cos(x); }},
        {"tan(x)", [](double x) { return std::tan(x); }},
        {"asin(x/5)", [](double x) { return std::asin(x / 5); }},
        {"acos(x/5)", [](double x) { return std::acos(x / 5); }},
        {"atan(x)", [](double x) { return std::atan(x); }},
        {"atan2(x, -0.3)", [](double x) { return std::atan2(x, -0.3); }},
        {"sinh(x)", [](double x) { return std::sinh(x); }},
        {"cosh(x)", [](double x) { return std::cosh(x); }},
        {"tanh(x)", [](double x) { return std::tanh(x); }},
        {"exp(x)", [](double x) { return std::exp(x); }},
        {"log(abs(x))", [](double x) { return std::log(std::abs(x)); }},
        {"ln(abs(x))", [](double x) { return std::log(std::abs(x)); }},
        {"log2(abs(x))", [](double x) { return std::log2(std::abs(x)); }},
        {"log10(abs(x))", [](double x) { return std::log10(std::abs(x)); }},
        {"sqrt(abs(x))", [](double x) { return std::sqrt(std::abs(x)); }},
        {"cbrt(x)", [](double x) { return std::cbrt(x); }},
        {"pow(abs(x), 1.7)", [](double x) { return std::pow(std::abs(x), 1.7); }},
        {"x^3", [](double x) { return x * x * x; }},
        {"x^17", [](double x) { return std::pow(x, 17); }},
        {"abs(x)^-0.3", [](double x) { return std::pow(std::abs(x), -0.3); }},
        {"sign(x)", [](double x) { return x > 0 ? 1 : -1; }},
        {"floor(x)", [](double x) { return std::floor(x); }},
        {"ceil(x)", [](double x) { return std::ceil(x); }},
        {"round(x)", [](double x) { return std::round(x); }},
        {"mod(x, 0.7)", [](double x) { return std::fmod(x, 0.7); }},
        {"hypot(x, 2)", [](double x) { return std::hypot(x, 2); }},
        {"pi * e", [](double) { return M_PI * M_E; }}};
    for (const auto& [text, expected] : functions) {
        const Expression f("density", text, 1);
        for (std::uint64_t i = 0; i < 400; ++i) {
            const double x = 10 * Rng(1).uniform(i) - 5;
            const double right = expected(x);
            EXPECT_NEAR(f.at({&x, 1}), right, 2e-15 * (1 + right * right)) << text << " " << x;
        }
    }
}

TEST(Expression, FunctionsAtTheirEdges) {
    EXPECT_EQ(value("exp(-1000)"), 0);
    EXPECT_EQ(value("exp(1000)"), INFINITY);
    EXPECT_EQ(value("log(0)"), -INFINITY);
    EXPECT_TRUE(std::isnan(value("log(-1)")));
    EXPECT_TRUE(std::isnan(value("(-8)^(1/3)")));
    EXPECT_EQ(value("(-2)^3"), -8);
    EXPECT_EQ(value("0^0"), 1);
    EXPECT_EQ(value("0^0.3"), 0);
    EXPECT_EQ(value("1/0"), INFINITY);
    EXPECT_EQ(value("asin(1)*2"), M_PI);
    EXPECT_EQ(value("acos(-1)"), M_PI);
    EXPECT_TRUE(std::isnan(value("asin(1.1)")));
    EXPECT_EQ(value("tanh(1000) + tanh(-1000)"), 0);
    EXPECT_EQ(value("sinh(-1000)"), -INFINITY);
    EXPECT_TRUE(std::isnan(value("tanh(log(-1))")));
    EXPECT_TRUE(std::isnan(value("sinh(-log(-1))")));
    EXPECT_EQ(value("log(-1) ? 1 : 2"), 1);
    EXPECT_EQ(value("min(1, log(-1)) + max(2, log(-1))"), 3);
    EXPECT_TRUE(std::isnan(value("min(log(-1), 1)")));
    EXPECT_EQ(value("sin(0)"), 0);
}

TEST(Expression, WholeResultsAreExact) {
    for (int k = -307; k <= 308; ++k) EXPECT_EQ(value(fmt::format("log10(1e{})", k)), k) << k;
    for (int k = -1074; k <= 1023; ++k) EXPECT_EQ(value("log2(x)", {std::ldexp(1, k)}), k) << k;
    for (int k = -1074; k <= 1023; ++k)
        EXPECT_EQ(value(fmt::format("2^({})", k)), std::ldexp(1, k)) << k;
    EXPECT_EQ(value("3^33 - 5559060566555523"), 0);
    EXPECT_EQ(value("(-7)^18 - 1628413597910449"), 0);
    EXPECT_EQ(value("(-3)^33 + 5559060566555523"), 0);
    EXPECT_EQ(value("hypot(3, 4)"), 5);
}

// Expected values from mpmath.
TEST(Expression, HugeAndTinyArgumentsAndResults) {
    EXPECT_DOUBLE_EQ(value("sin(1e22)"), -0.8522008497671888);
    EXPECT_DOUBLE_EQ(value("sin(-1e15)"), -0.8582727931702359);
    EXPECT_DOUBLE_EQ(value("tan(1e6)"), -0.373624453987599);
    EXPECT_DOUBLE_EQ(value("exp(709.7)"), 1.6549840276802644e308);
    EXPECT_DOUBLE_EQ(value("cosh(-710)"), 1.1169973830808557e308);
    EXPECT_DOUBLE_EQ(value("sinh(-710)"), -1.1169973830808557e308);
    EXPECT_DOUBLE_EQ(value("hypot(3e200, 4e200)"), 5e200);
    EXPECT_DOUBLE_EQ(value("hypot(3e-200, -4e-200)"), 5e-200);
    EXPECT_DOUBLE_EQ(value("1.1^100"), 13780.61233982238);
    EXPECT_DOUBLE_EQ(value("10^307.9"), 7.943282347242399e307);
    EXPECT_NEAR(value("exp(-720)"), 2.0322308e-313, 1e-320);
    EXPECT_NEAR(value("10^(-310)"), 1e-310, 1e-320);
}

// Conditions that differ from point to point divide a block.
TEST(Expression, BlocksAreTheSameAsSinglePoints) {
    std::vector<double> points(2000);
    Rng(4).fill(0, points);
    std::vector<double> values(1000);
    for (const char* text :
         {"exp(-x*y) + x", "3", "y", "x^2 - x^y + sin(9*x)", "x < y ? x : -y",
          "x < 0.2 ? 1 : x < 0.5 ? (y < 0.3 ? sin(x) : x/y) : y < 2 ? x - y : 1/0",
          "max(x < y ? x < 0.5 ? 1 : 2 : 3, 2*y, (x < y ? 2 : y)) + (y > 2 ? 1 : x)"}) {
        const Expression f("density", text, 2);
        f.evaluate(points, values);
        for (std::size_t i = 0; i < values.size(); ++i)
            ASSERT_EQ(values[i], f.at({&points[2 * i], 2})) << text << " " << i;
    }
}

// They take linear time, and a stack that does not depend on their length.
TEST(Expression, ReadsLongFormulas) {
    std::string sum = "x", steps, all = "max(0";
    for (std::size_t i = 0; i < 100'000; ++i) {
        sum += " + x";
        steps += fmt::format("x < {} ? {} : ", i, 2 * i);
        all += fmt::format(", x*{}", i);
    }
    EXPECT_EQ(value(sum, {0.5}), 50'000.5);
    EXPECT_EQ(value(steps + "7", {500.5}), 1002);
    EXPECT_EQ(value(all + ")", {2}), 199'998);
    const Expression f("density", steps + "7", 1);
    const std::vector<double> points = {99'999.5, 0.5, 3, -1, 7.5, 99'998.5};
    std::vector<double> values(points.size());
    f.evaluate(points, values);
    EXPECT_EQ(values, (std::vector<double>{7, 2, 8, 0, 16, 199'998}));
}

TEST(Expression, RefusesDeeplyNestedFormulas) {
    for (const auto& [open, close] :
         {std::pair{"(", ")"}, {"sin(", ")"}, {"x ? ", " : 1"}, {"2^", ""}}) {
        std::string left, right;
        for (std::size_t i = 0; i < 500; ++i) {
            left += open;
            right += close;
        }
        EXPECT_EQ(refused(left + "x" + right), "") << open;
        for (std::size_t i = 0; i < 100'000; ++i) left += open;
        EXPECT_THAT(refused(left), ::testing::EndsWith("expected at most 500 nested formulas"));
    }
}

TEST(Expression, IsSafeToUseFromThreads) {
    const Expression f("density", "sin(x) + 2", 1);
    std::vector<std::thread> threads;
    std::vector<double> sums(4);
    for (std::size_t t = 0; t < 4; ++t)
        threads.emplace_back([&, t] {
            for (int i = 0; i < 5000; ++i) {
                const double x = i * 1e-3;
                sums[t] += f.at({&x, 1});
            }
        });
    for (auto& thread : threads) thread.join();
    for (const double sum : sums) EXPECT_EQ(sum, sums[0]);
}

TEST(Expression, SaysWhereItEndsTooEarly) {
    const std::string value = "a number, a variable, a function or '('";
    const std::vector<std::tuple<std::string, int, std::string>> cases = {
        {"((x)", 5, "')'"}, {"((x) + 2  ", 9, "')'"}, {"sin(x", 6, "')'"},
        {"2*x+", 5, value}, {"(-", 3, value},         {"(x ? 1", 7, "')'"},
        {"x ^ ", 4, value}, {"x &&", 5, value},       {"-", 2, value},
        {"sin(", 5, value}, {"max(x,", 7, value},     {"x ? 1", 6, "':' and the value otherwise"}};
    for (const auto& [text, column, wanted] : cases)
        EXPECT_EQ(refused(text),
                  fmt::format("usage: --density: '{}': the formula ends at column {}, where {} was "
                              "expected",
                              text, column, wanted));
}

TEST(Expression, SaysAtWhichColumnWhatIsExpected) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"x+q",
         "column 3: 'q': expected a number, an operator, x, y, pi, e or a function such as "
         "exp"},
        {"foo(x)",
         "column 1: 'foo': expected a number, an operator, x, y, pi, e or a function "
         "such as exp"},
        {"sin(x))", "column 7: ')': expected a '(' before it, and a formula between them"},
        {"x y", "column 3: 'y': expected an operator before it"},
        {"2x", "column 2: 'x': expected an operator before it"},
        {"", "column 1: expected a formula"},
        {"x,y",
         "column 2: ',': expected one formula; commas only separate arguments of a function"},
        {"pow(x)", "column 6: 'pow': expected more arguments"},
        {"pow(x,y,x)", "column 10: 'pow': expected fewer arguments"},
        {"x = 3", "column 3: '=': expected == to compare"},
        {"3 +* x", "column 4: '*': expected a number, a variable, a function or '(' before it"},
        {"%2 ",
         "column 1: '%': expected a number, an operator, x, y, pi, e or a function such as exp"},
        {"x \u00d7 y",
         "column 3: '\u00d7': expected a number, an operator, x, y, pi, e or a function such as "
         "exp"},
        {"sin x", "column 1: 'sin': expected '(' after it"},
        {"x~y", "column 2: '~': expected a number, a variable or an operator"},
        {"--x", "column 2: '-': expected a number, a variable, a function or '(' before it"},
        {"x ^^ 2",
         "column 4: '^': expected a number, an operator, x, y, pi, e or a function such as exp"},
        {"1 + (x,y)",
         "column 7: ',': expected one formula; commas only separate arguments of a function"},
        {"(x ? 1)", "column 7: ')': expected ':' and the value otherwise before it"},
        {"x : 1", "column 3: ':': expected a '?' before it"},
        {"max()", "column 5: 'max': expected more arguments"}};
    for (const auto& [text, message] : cases)
        EXPECT_EQ(refused(text), "usage: --density: '" + text + "', " + message);
    for (const char* text : {"1e400", "\"abc\"", "(x+", "max()", "sin", "x**2", "!x", "2e", "z",
                             "\xc3\xa9", "x..y", ")", "?", "((((("})
        EXPECT_NE(refused(text), "") << text;
}

// They would compare 0 or 1 with the third number.
TEST(Expression, RefusesChainsOfComparisons) {
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"0.2 < x < 0.5", "column 9: '<': comparisons cannot be chained; write 0.2 < x && x < 0.5"},
        {"(x + 1 >= 2*y >= 3) ? 1 : 2",
         "column 15: '>=': comparisons cannot be chained; write x + 1 >= 2*y && 2*y >= 3"},
        {"x == y == 1 && y > 0",
         "column 8: '==': comparisons cannot be chained; write x == y && y == 1"},
        {"max(x, x < y <= (1 + 1))",
         "column 14: '<=': comparisons cannot be chained; write x < y && y <= (1 + 1)"}};
    for (const auto& [text, message] : cases)
        EXPECT_EQ(refused(text), "usage: --density: '" + text + "', " + message);
    EXPECT_EQ(value("(x < y) < 2"), 1);  // explicit, so allowed
    EXPECT_EQ(value("x < y && y < 1 || x > 2 ? 1 > 0 : 3 < 2"), 1);
    EXPECT_EQ(value("max(x < y, y < x)"), 1);
}

namespace {

FormulaNames experiment() {
    FormulaNames names;
    names.add("cross section");
    names.add("material", {"oak", "steel", "oak & ash"});
    names.add("load");
    names.add("log", {"on", "off"});
    return names;
}

double named_value(const std::string& text, const std::vector<double>& point) {
    return Expression("", text, experiment()).at(point);
}

std::string named_error(const std::string& text) {
    return error_of([&] { Expression("", text, experiment()); });
}

}  // namespace

TEST(Expression, NamesAndWordsInQuotes) {
    EXPECT_EQ(named_value("\"cross section\" * 2 + load", {3, 0, 5, 0}), 11);
    EXPECT_EQ(named_value("'cross section'^2", {3, 0, 5, 0}), 9);
    for (const double k : {0.0, 1.0, 2.0}) {
        EXPECT_EQ(named_value("material == \"steel\"", {0, k, 0, 0}), k == 1);
        EXPECT_EQ(named_value("'oak & ash'!=material", {0, k, 0, 0}), k != 2);
        EXPECT_EQ(named_value("\"material\" == \"oak\" ? 7 : 8", {0, k, 0, 0}), k == 0 ? 7 : 8);
    }
    EXPECT_EQ(named_value("\"log\" == 'off' && log(1) == 0", {0, 0, 0, 1}), 1);
    EXPECT_EQ(Expression("", "'cross section' < 3", experiment()).text(), "'cross section'<3");
}

TEST(Expression, SaysWhichNamesAndWordsThereAre) {
    EXPECT_EQ(named_error("material == 'stele'"),
              "usage: --: 'material == 'stele'', column 13: 'stele': expected a level of material "
              "| did you mean 'steel'?");
    EXPECT_EQ(named_error("load < 'steel'"),
              "usage: --: 'load < 'steel'', column 8: 'steel': expected a name, or a level next to "
              "== or != | known: cross section, material, load, log");
    EXPECT_EQ(named_error("load < \"steel"),
              "usage: --: 'load < \"steel', column 8: '\"': expected a closing quote");
    EXPECT_EQ(named_error("load 'cross section'"),
              "usage: --: 'load 'cross section'', column 6: ''cross section'': expected an "
              "operator before it");
    EXPECT_NE(named_error("@0 < 1"), "");
    EXPECT_NE(named_error("material == steel").find("\"cross section\", material, load"),
              std::string::npos);
}

TEST(Expression, QuotesTheWholeWordThatItDoesNotKnow) {
    for (const std::string word : {"foo0bar", "f9", "Az_0", "zZ"})
        EXPECT_NE(refused("x + " + word + " * y").find("'" + word + "'"), std::string::npos)
            << word;
}

TEST(Expression, DropsBlanksFromItsText) {
    EXPECT_EQ(Expression("density", "1 - x * x", 1).text(), "1-x*x");
}

}  // namespace stipple::testing::expression_test
