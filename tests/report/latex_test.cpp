// SPDX-License-Identifier: MIT
#include "report/latex.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace stipple::testing::latex_test {

const double unknown = std::nan("");

TEST(Latex, EscapesItsSpecialCharacters) {
    EXPECT_EQ(latex_text("a_b & 50% #1 $x {y} ~^\\"),
              "a\\_b \\& 50\\% \\#1 \\$x \\{y\\} "
              "\\textasciitilde{}\\textasciicircum{}\\textbackslash{}");
    EXPECT_EQ(latex_text("rank1-lattice --x <1|2>"),
              "rank1-lattice -{}-x \\textless{}1\\textbar{}2\\textgreater{}");
}

// Half-widths have two digits, and their numbers as many decimals.
TEST(Latex, NumbersHaveTheDigitsThatTheirIntervalAllows) {
    EXPECT_EQ(latex_number(0.04301, 0.00214), "$0.0430 \\pm 0.0021$");
    EXPECT_EQ(latex_number(-12.345, 1.3), "$-12.3 \\pm 1.3$");
    EXPECT_EQ(latex_number(12345.6, 1234), "$12346 \\pm 1234$");
    EXPECT_EQ(latex_number(1.234e-7, 5.6e-9), "$(1.234 \\pm 0.056) \\times 10^{-7}$");
    EXPECT_EQ(latex_number(0, 0.5), "$0.00 \\pm 0.50$");
    EXPECT_EQ(latex_number(0.0123456, unknown), "$0.01235$");
    EXPECT_EQ(latex_number(1.5e-9, 0), "$1.500 \\times 10^{-9}$");
    EXPECT_EQ(latex_number(0.00099996, unknown), "$0.001000$");
    EXPECT_EQ(latex_number(0.000099996, unknown), "$1.000 \\times 10^{-4}$");
    EXPECT_EQ(latex_number(0.25, 0.000996), "$0.2500 \\pm 0.0010$");
    EXPECT_EQ(latex_number(9.996e-7, 9.96e-8), "$(1.00 \\pm 0.10) \\times 10^{-6}$");
    EXPECT_EQ(latex_number(5e-324, unknown), "$4.941 \\times 10^{-324}$");
    EXPECT_EQ(latex_number(1.7e308, unknown), "$1.700 \\times 10^{308}$");
    EXPECT_EQ(latex_number(9.9995e269, unknown), "$9.999 \\times 10^{269}$");  // below 9.9995
    EXPECT_EQ(latex_number(-0.001, 5), "$0.0 \\pm 5.0$");
    EXPECT_EQ(latex_number(-0.0, 0.5), "$0.00 \\pm 0.50$");
    EXPECT_EQ(latex_number(-8e8, 6.1e11), "$(0.0 \\pm 6.1) \\times 10^{11}$");
    EXPECT_EQ(latex_number(64, unknown), "$64$");
    EXPECT_EQ(latex_number(0, unknown), "$0$");
    EXPECT_EQ(latex_number(unknown, unknown), "--");
    EXPECT_EQ(latex_number(-INFINITY, unknown), "$-\\infty$");
}

TEST(Latex, TablesHaveTheRulesOfBooktabs) {
    const LatexTable table{.comments = {"100 %"},
                           .head = {"set", "$n$"},
                           .rows = {{"a", "1"}, {"b", "2"}},
                           .words = 1};
    EXPECT_EQ(table.text(),
              "% 100 %\n\\begin{tabular}{lr}\n\\toprule\nset & $n$ \\\\\n\\midrule\n"
              "a & 1 \\\\\nb & 2 \\\\\n\\bottomrule\n\\end{tabular}\n");
}

TEST(Latex, ReportsAreATableForEachAnalyzer) {
    Measurement one{.analyzer = "moments",
                    .source = "a_b.csv",
                    .set = 1,
                    .count = 8,
                    .dimension = 2,
                    .domain = "unit-cube"};
    one.results.add("mean", 0.5).add("curve", Report::Curve{1, 2}).add("word", "fine");
    Measurement two = one;
    two.source = "-";
    two.set.reset();
    two.results = Report().add("mean", 0.25).add("largest", std::int64_t{7});
    two.standard_error = Report().add("mean", 0.012);
    Measurement other = one;
    other.analyzer = "other";
    const std::string text = to_latex(std::vector{one, other, two});
    EXPECT_EQ(
        text,
        "% needs \\usepackage{booktabs}\n"
        "% moments\n% means +- standard errors\n"
        "\\begin{tabular}{lrrrrr}\n\\toprule\nset & $n$ & mean & curve[0] & curve[1] & largest "
        "\\\\\n\\midrule\n"
        "a\\_b.csv, set 1 & 8 & $0.5000$ & $1$ & $2$ & -- \\\\\n"
        "standard input & 8 & $0.250 \\pm 0.012$ & -- & -- & $7$ \\\\\n"
        "\\bottomrule\n\\end{tabular}\n"
        "% other\n\\begin{tabular}{lrrrr}\n\\toprule\nset & $n$ & mean & curve[0] & curve[1] "
        "\\\\\n\\midrule\n"
        "a\\_b.csv, set 1 & 8 & $0.5000$ & $1$ & $2$ \\\\\n\\bottomrule\n\\end{tabular}\n");
}

// More than six numbers would be too wide beside each other.
TEST(Latex, ManyNumbersAreTablesWithARowForEachGroup) {
    Measurement m{.analyzer = "sensitivity", .source = "y.csv", .count = 8, .domain = "unit-cube"};
    Report y;
    y.add("mean", 0.5).add("variance", 0.25);
    for (const char* input : {"a", "b"})
        y.add(input, Report()
                         .add("first", 0.5)
                         .add("first_low", 0.25)
                         .add("first_high", 0.75)
                         .add("total", 0.625));
    m.results.add("y", y).add("list", Report::Curve{1, 2}).add("used", std::int64_t{8});
    const std::string all = to_latex(std::vector{m});
    const auto has = [&](const std::string& text) { EXPECT_THAT(all, ::testing::HasSubstr(text)); };
    has("\\begin{tabular}{llrrr}");
    has("set & $n$ & used \\\\\n\\midrule\ny.csv & 8 & $8$ \\\\\n");
    has("set & part & $n$ & list \\\\\n\\midrule\n"
        "y.csv & [0] & 8 & $1$ \\\\\ny.csv & [1] & 8 & $2$ \\\\\n");
    has("set & part & $n$ & mean & variance \\\\\n\\midrule\n"
        "y.csv & y & 8 & $0.5000$ & $0.2500$ \\\\\n");
    has("set & part & $n$ & first & total \\\\\n\\midrule\n"
        "y.csv & y.a & 8 & $0.5000$ [$0.2500$, $0.7500$] & $0.6250$ \\\\\n"
        "y.csv & y.b & 8 & ");
}

}  // namespace stipple::testing::latex_test
