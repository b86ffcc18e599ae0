// SPDX-License-Identifier: MIT
//
// Completions are requested by the shells themselves, if they are installed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/parsing/arguments.hpp"
#include "core/text.hpp"
#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::completions_test {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::IsSupersetOf;
using ::testing::Not;

namespace {

/// Completions by bash for the last of these words; as in bash, '=' is a separate word.
std::vector<std::string> offered(const Sandbox& box, const std::string& words) {
    const Outcome outcome = box.shell(
        "source <(stipple completions bash); COMP_WORDS=(" + words +
        "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _stipple; printf '%s\\n' \"${COMPREPLY[@]}\"");
    EXPECT_EQ(outcome.err, "");
    std::vector<std::string> lines;
    for (const auto line : stipple::split(outcome.out, '\n'))
        if (!line.empty()) lines.emplace_back(line);
    return lines;
}

bool installed(const Sandbox& box, const std::string& program) {
    return box.shell("command -v " + program).code == 0;
}

}  // namespace

TEST(Completions, OfBashKnowVerbsUnitsAndOptions) {
    const Sandbox box;
    EXPECT_THAT(offered(box, "stipple gen"), ElementsAre("generate"));
    EXPECT_THAT(offered(box, "stipple ''"), IsSupersetOf({"generate", "analyze", "reproduce"}));
    EXPECT_THAT(offered(box, "stipple generate ham"), ElementsAre("hammersley"));
    EXPECT_THAT(offered(box, "stipple generate -n 100 ham"), ElementsAre("hammersley"));
    EXPECT_THAT(offered(box, "stipple generate halton --scr"), ElementsAre("--scramble"));
    EXPECT_THAT(offered(box, "stipple generate random --scr"), IsEmpty());
    EXPECT_THAT(offered(box, "stipple generate lhs --cen"), ElementsAre("--centered"));
    EXPECT_THAT(offered(box, "stipple analyze star-discrepancy --"),
                IsSupersetOf({"--threads", "--method", "--check"}));
    EXPECT_THAT(offered(box, "stipple warp dis"), ElementsAre("discrete", "disk"));
    EXPECT_THAT(offered(box, "stipple list gen"), ElementsAre("generators"));
    EXPECT_THAT(offered(box, "stipple help spe"), ElementsAre("specs"));
    EXPECT_THAT(offered(box, "stipple completions ''"), ElementsAre("bash", "zsh", "fish"));
}

TEST(Completions, OfBashKnowWordsAndFiles) {
    const Sandbox box;
    box.write("points.csv", "");
    box.write("points of mine.csv", "");
    EXPECT_THAT(offered(box, "stipple warp disk --method pol"), ElementsAre("polar"));
    EXPECT_THAT(offered(box, "stipple warp disk --method = pol"), ElementsAre("polar"));
    EXPECT_THAT(offered(box, "stipple warp disk --method ="), Contains("concentric"));
    EXPECT_THAT(offered(box, "stipple generate halton --dtype ''"), ElementsAre("f64", "f32"));
    EXPECT_THAT(offered(box, "stipple generate halton -f np"), ElementsAre("npy"));
    EXPECT_THAT(offered(box, "stipple generate halton -w ow"), ElementsAre("owen"));
    EXPECT_THAT(offered(box, "stipple generate halton -n ''"), IsEmpty());
    EXPECT_THAT(offered(box, "stipple generate halton -o po"),
                ::testing::UnorderedElementsAre("points.csv", "points of mine.csv"));
    EXPECT_THAT(offered(box, "stipple analyze moments poi"), Contains("points.csv"));
    EXPECT_THAT(offered(box, "stipple reproduce poi"), Contains("points.csv"));
    EXPECT_THAT(offered(box, "stipple generate halton poi"), IsEmpty());
    EXPECT_THAT(offered(box, "stipple generate lloyd --density poi"), Contains("points.csv"));
    EXPECT_THAT(offered(box, "stipple nonsense ''"), IsEmpty());
}

TEST(Completions, OfBashKnowIntegrandsAndTheValuesInSpecs) {
    const Sandbox box;
    box.write("box.json", "");
    EXPECT_THAT(offered(box, "stipple analyze integration --integrand genz-c"),
                ElementsAre("genz-corner-peak", "genz-continuous"));
    EXPECT_THAT(offered(box, "stipple analyze integration --integrand genz-gaussian,zo"),
                ElementsAre("genz-gaussian,zone-plate"));
    EXPECT_THAT(offered(box, "stipple analyze integration : integrand = zo"),
                ElementsAre("zone-plate"));
    EXPECT_THAT(offered(box, "stipple study --analyze integration : integrand = zo"),
                ElementsAre("zone-plate"));
    EXPECT_THAT(offered(box, "stipple generate sobol : scramble ="),
                ElementsAre("none", "digital-shift", "matrix", "owen"));
    EXPECT_THAT(offered(box, "stipple generate halton :"), IsSupersetOf({"scramble=", "leap="}));
    EXPECT_THAT(offered(box, "stipple study random,sobol : scramble = ow"), ElementsAre("owen"));
    EXPECT_THAT(offered(box, "stipple generate halton --parameters bo"), ElementsAre("box.json"));
    EXPECT_THAT(offered(box, "stipple study --parameters = bo"), ElementsAre("box.json"));
    EXPECT_THAT(offered(box, "stipple list --q"), ElementsAre("--quiet"));
}

TEST(Completions, OfBashKnowListsKeysAndQuotes) {
    const Sandbox box;
    EXPECT_THAT(offered(box, "stipple analyze l2-discrepancy --kind star,ce"),
                ElementsAre("star,centered"));
    EXPECT_THAT(offered(box, "stipple analyze l2-discrepancy : kind = wr"),
                ElementsAre("wraparound"));
    EXPECT_THAT(offered(box, "stipple plot --draw ''"), ElementsAre("cells", "gap", "grid="));
    EXPECT_THAT(offered(box, "stipple plot --draw cells,g"),
                ElementsAre("cells,gap", "cells,grid="));
    EXPECT_THAT(offered(box, "stipple analyze l2-discrepancy --keys ''"),
                IsSupersetOf({"value", "squared"}));
    EXPECT_THAT(offered(box, "stipple analyze star-discrepancy --keys value,up"),
                ElementsAre("value,upper"));
    EXPECT_THAT(offered(box, "stipple study random --analyze moments,dispersion --keys low"),
                ElementsAre("lower"));
    EXPECT_THAT(offered(box, "stipple analyze moments --check cube.l"),
                ElementsAre("cube.largest_z"));
    EXPECT_THAT(offered(box, R"(stipple plot --generate \'sobol:scramble=ow)"),
                ElementsAre("sobol:scramble=owen"));
    EXPECT_THAT(offered(box, R"(stipple study '"rank1-lattice -w cran')"),
                ElementsAre("rank1-lattice -w cranley-patterson"));
    EXPECT_THAT(offered(box, R"(stipple analyze \'moments\' --keys cube.ax)"),
                ElementsAre("cube.axes"));
    const auto emitted = offered(box, "stipple emit ''");
    EXPECT_THAT(emitted, IsSupersetOf({"sobol", "halton", "jittered"}));
    EXPECT_THAT(emitted, Not(Contains("poisson-disk")));
}

// The requests of shells; one candidate per line, with its help after a tab.
TEST(Completions, NameAllThatThereIs) {
    const Sandbox box;
    const std::string all = good(box.run({"complete", ""}));
    for (const auto& info : stipple::cli::verbs())
        EXPECT_THAT(all, HasSubstr(info.name + "\t" + info.summary + "\n"));
    for (const auto& kind : stipple::catalog()) {
        const std::string verb = kind.verb.empty() ? "convert" : kind.verb;
        const std::string units =
            good(kind.verb.empty() ? box.run({"complete", verb, "--format", ""})
                                   : box.run({"complete", verb, ""}));
        for (const auto& unit : kind.units)
            EXPECT_THAT(units, HasSubstr(unit.name + "\t" + unit.summary + "\n"));
    }
    const std::string options = good(box.run({"complete", "generate", "halton", "--"}));
    EXPECT_THAT(options, HasSubstr("--max-memory\t"));
    EXPECT_THAT(options, HasSubstr("--scramble\t"));
    EXPECT_EQ(good(box.run({"complete", "generate", "halton", "--dtype=f3"})), "--dtype=f32\n");
    EXPECT_EQ(good(box.run({"complete", "generate", "halton", "-o", "x"})), "@files\n");
    EXPECT_EQ(good(box.run({"complete", "nonsense", ""})), "");
}

TEST(Completions, AreScriptsOfAllShells) {
    const Sandbox box;
    for (const char* shell : {"bash", "zsh", "fish"}) {
        const std::string script = good(box.run({"completions", shell}));
        EXPECT_THAT(script, Not(HasSubstr(STIPPLE_SOURCE_DIR)));
        if (!installed(box, shell)) continue;
        box.write("script", script);
        const Outcome checked = box.shell(std::string(shell) + " -n script");
        EXPECT_EQ(checked.code, 0) << checked.err;
        EXPECT_EQ(checked.err, "");
    }
    for (const auto& words : {std::vector<std::string>{"completions"},
                              {"completions", "tcsh"},
                              {"completions", "bash", "zsh"}})
        EXPECT_EQ(box.run(words).code, 2);
}

TEST(Completions, OfFishAnswer) {
    const Sandbox box;
    if (!installed(box, "fish")) GTEST_SKIP() << "fish is not installed";
    const auto ask = [&](const std::string& words) {
        return box
            .shell(
                "stipple completions fish > s.fish; HOME=$PWD fish -c 'source s.fish; complete "
                "-C \"" +
                words + "\"'")
            .out;
    };
    EXPECT_THAT(ask("stipple gen"), HasSubstr("generate\t"));
    EXPECT_THAT(ask("stipple generate hal"), HasSubstr("halton\t"));
    EXPECT_THAT(ask("stipple generate halton --scr"), HasSubstr("--scramble"));
    EXPECT_THAT(ask("stipple generate random --scr"), Not(HasSubstr("--scramble")));
    EXPECT_THAT(ask("stipple warp disk --method pol"), HasSubstr("polar"));
}

}  // namespace stipple::testing::completions_test
