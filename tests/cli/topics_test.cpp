// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

#include "cli/help/guide.hpp"
#include "cli/help/plain_page.hpp"
#include "cli/parsing/arguments.hpp"
#include "cli/terminal.hpp"
#include "core/text.hpp"
#include "math/densities/expression.hpp"
#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::topics_test {

using namespace stipple::cli;
using ::testing::HasSubstr;
using ::testing::Not;

// Every page is listed in the index, says how to go on, and fits a terminal.
TEST(Topics, LeadOn) {
    std::set<std::string> listed;
    for (const TopicGroup& group : topic_groups())
        for (const Topic* topic : group.topics) listed.insert(topic->name);
    for (const Topic& topic : topics()) {
        EXPECT_TRUE(listed.contains(topic.name))
            << topic.name << " is missing from data/guide/index.md";
        EXPECT_LE(topic.summary.size(), 60U) << topic.name;
        EXPECT_THAT(topic.text, HasSubstr("\nRead on: 'stipple help ")) << topic.name;
        const std::string page = filled_page(topic.text, 80);
        for (const auto line : split(page, '\n')) {
            const bool code = line.starts_with("    ");
            EXPECT_TRUE(code || code_points(line).size() <= 80) << topic.name << ": " << line;
            EXPECT_TRUE(code || line.find('`') == line.npos) << topic.name << ": " << line;
        }
    }
}

TEST(Topics, ArePlainText) {
    EXPECT_EQ(plain_page("The *unit\nsquare* of 2 * x * y. See\n[nets](concepts.md#nets).\n"),
              "The unit\nsquare of 2 * x * y. See\nnets ('stipple help concepts').\n");
    EXPECT_EQ(plain_page("# Head\n\n![a\npicture](x.svg)\n\nA **term** and\n[a `link`](x.md#a).\n"),
              "# Head\n\nA term and\na link.\n");
    EXPECT_EQ(plain_page("```sh\nstipple list\n\nb\n```\n\n`a b` in [0, 1) [x](y)\n"),
              "    stipple list\n\n    b\n\n'a b' in [0, 1) x\n");
    EXPECT_EQ(plain_page("A\n\n<!-- stipple list -->\n| a |\n<!-- end -->\n\nRead on: [A](a.md), "
                         "[B](b.md#c).\n"),
              "A\n\nRead on: 'stipple help a', 'stipple help b'.\n");
}

// A term of the glossary is found by each of its names; other words are suggested.
TEST(Topics, ExplainTerms) {
    const Sandbox box;
    EXPECT_GT(glossary_terms().size(), 60U);
    for (const std::string& term : glossary_terms()) EXPECT_NE(glossary_entry(term), "") << term;
    EXPECT_EQ(glossary_entry("NET"), glossary_entry("nets"));
    for (const char* term :
         {"grey", "gray", "lens", "runs", "mpi", "threads", "stdin", "genz", "R"})
        EXPECT_NE(glossary_entry(term), "") << term;
    EXPECT_EQ(good(box.run({"help", "elementary", "interval"})),
              good(box.run({"help", "elementary interval"})));
    const std::string strata = good(box.run({"help", "Strata"}));
    EXPECT_THAT(strata, HasSubstr("stratum"));
    EXPECT_EQ(good(box.run({"help", "stratum"})), strata);
    // A unit whose name is a term, too, comes after the term.
    const std::string both = good(box.run({"help", "stratified"}));
    EXPECT_THAT(both, HasSubstr("\njittered: "));
    EXPECT_THAT(both, ::testing::StartsWith("stratified"));
    // Blanks stand for hyphens of units and topics.
    EXPECT_THAT(good(box.run({"help", "star", "discrepancy"})),
                HasSubstr("\nstar-discrepancy: Star discrepancy, exact"));
    EXPECT_EQ(good(box.run({"help", "choosing a sampler"})),
              good(box.run({"help", "choosing-a-sampler"})));
    const Outcome typo = box.run({"help", "discrepency"});
    EXPECT_EQ(typo.code, 2);
    EXPECT_THAT(typo.err, HasSubstr("did you mean 'discrepancy'?"));
}

// Checks all stated values of formulas and functions, such as "mod(-0.3, 0.7) = -0.3".
TEST(Topics, FormulasHaveTheValuesThatAreSaid) {
    const auto topic = std::ranges::find(topics(), std::string("formulas"), &Topic::name);
    ASSERT_NE(topic, topics().end());
    std::istringstream lines(topic->text);
    int values = 0;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t equals = line.find(" = ");
        if (!line.starts_with("    ") || equals == std::string::npos) continue;
        const std::size_t begin = line.rfind("  ", equals) + 2;
        const std::string left = line.substr(begin, equals - begin);
        std::string right = line.substr(equals + 3);
        right = right.substr(0, right.find(". "));
        const double value = Expression("right", right, 0).at({});
        EXPECT_NEAR(Expression("left", left, 0).at({}), value, 1e-15 * std::abs(value)) << line;
        ++values;
    }
    EXPECT_EQ(values, 22);
    for (const FormulaOperation& operation : formula_operations())
        EXPECT_TRUE(operation.binding > 0 ||
                    topic->text.find(fmt::format(" {}(", operation.name)) != std::string::npos)
            << operation.name;
}

TEST(Topics, TellTheTruthAboutTheSameBytes) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 1000 --seed 7 --threads 1 -o one.csv && stipple "
        "generate random -n 1000 --seed 7 --threads 2 -o two.csv && cmp one.csv two.csv"));
    good(
        box.shell("stipple generate random -m 4 --no-header -n 5 | tail -n 5 | cut -d, -f2- > a && "
                  "stipple generate random --seed 4 --no-header -n 5 > b && cmp a b"));
}

TEST(Topics, AreListedAndFound) {
    const Sandbox box;
    const std::string list = good(box.run({"help"}));
    EXPECT_THAT(list, HasSubstr("\n  stipple generate sobol -n 256 -o points.csv "));
    EXPECT_EQ(list, good(box.run({"--help"})));
    for (const Topic& topic : topics()) {
        EXPECT_THAT(list, HasSubstr(std::string("  ") + topic.name));
        EXPECT_EQ(good(box.run({"help", topic.name})), filled_page(topic.text, 80)) << topic.name;
    }
    EXPECT_EQ(good(box.run({"help", "generate"})), good(box.run({"generate", "--help"})));
    EXPECT_EQ(good(box.run({"help", "generate", "halton"})),
              good(box.run({"generate", "halton", "--help"})));
    EXPECT_EQ(good(box.run({"help", "disc"})), good(box.run({"warp", "disk", "--help"})));
    const Outcome typo = box.run({"help", "format"});
    EXPECT_EQ(typo.code, 2);
    EXPECT_THAT(
        typo.err,
        HasSubstr(
            "help: unknown word 'format': no topic, verb, unit or term; did you mean 'formats'?"));
}

TEST(Topics, FindWhatOtherPackagesCallSomething) {
    const Sandbox box;
    const std::string halton = good(box.run({"help", "qmc.Halton"}));
    EXPECT_THAT(halton, HasSubstr("SciPy\n    Halton(3, scramble=False).random(5)\n"
                                  "        stipple generate halton -d 3 -n 5\n"));
    EXPECT_THAT(halton, HasSubstr("QMCPy\n"));
    EXPECT_THAT(halton, Not(HasSubstr("HaltonSequence")));
    EXPECT_EQ(good(box.run({"help", "HALTON"})), halton);
    const std::string disk = good(box.run({"help", "square_to_uniform_disk"}));
    EXPECT_THAT(disk, HasSubstr("' | stipple warp disk --orientation 2,1\n"));
    EXPECT_THAT(disk, Not(HasSubstr("concentric")));
    const std::string package = good(box.run({"help", "scipy"}));
    EXPECT_TRUE(package.starts_with("SciPy\n"));
    EXPECT_THAT(package, HasSubstr("   # centered.squared\n"));
    EXPECT_THAT(package, Not(HasSubstr("QMCPy")));
    EXPECT_THAT(package,
                HasSubstr("\n        SciPy needs a radius and stops at the number of points,"));
    EXPECT_THAT(package, HasSubstr("For MultivariateNormalQMC, use the warp normal"));
    EXPECT_THAT(good(box.run({"help", "coming-from"})), HasSubstr(package));
    for (const char* none : {"square_to", "", "x", "2", "|", "`", ".", "utk."})
        EXPECT_EQ(box.run({"help", none}).code, 2) << none;
}

// Every exit code of the program is in the topic.
TEST(Topics, NameAllExitCodes) {
    const Sandbox box;
    const std::string text = good(box.run({"help", "exit-codes"}));
    for (const char* code : {"\n    0  ", "\n    1  ", "\n    2  ", "\n    3  ", "\n    4  ",
                             "\n    5  ", "\n    130  "})
        EXPECT_THAT(text, HasSubstr(code));
}

TEST(Manual, PagesAreWholeAndWithoutFaults) {
    const Sandbox box;
    good(box.run({"help", "--man", "-o", box.path().string()}));
    EXPECT_EQ(box.files().size(), 1 + verbs().size() + topics().size());
    const bool groff = box.shell("command -v groff").code == 0;
    for (const std::string& file : box.files()) {
        const std::string page = box.read(file);
        EXPECT_TRUE(page.starts_with(".TH STIPPLE")) << file;
        for (const char* section : {".SH NAME\n", ".SH SEE ALSO\n"})
            EXPECT_THAT(page, HasSubstr(section)) << file;
        if (!groff) continue;
        const Outcome set = box.shell("groff -k -man -Tutf8 -ww -z " + file);
        EXPECT_EQ(set.err, "") << file;
        EXPECT_EQ(set.code, 0);
    }
    for (const VerbInfo& info : verbs())
        EXPECT_TRUE(box.exists(std::string("stipple-") + info.name + ".1")) << info.name;
}

TEST(Manual, ShowsUnitsOptionsAndExamplesAsTheyAre) {
    const Sandbox box;
    const std::string page = good(box.run({"help", "--man", "generate"}));
    EXPECT_THAT(page, HasSubstr(".SS poisson\\-disk\n"));
    if (box.shell("command -v groff").code != 0) GTEST_SKIP() << "groff is not installed";
    box.write("page.1", page);
    const std::string shown = box.shell("groff -man -Tascii -P-c page.1 | col -b").out;
    EXPECT_THAT(shown,
                HasSubstr("stipple generate halton -n 4096 --start 1 -w disk -o points.csv"));
    EXPECT_THAT(shown, HasSubstr("stipple generate jittered -m 10 -o 'set{set}.csv'"));
    EXPECT_THAT(shown, HasSubstr("--scramble"));
    EXPECT_EQ(box.run({"help", "--man", "nonsense"}).code, 2);
}

}  // namespace stipple::testing::topics_test
