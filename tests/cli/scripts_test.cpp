// SPDX-License-Identifier: MIT
//
// The plotting scripts: real output of the program in, from files and pipes; pictures out.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::scripts_test {

using ::testing::HasSubstr;

namespace {

/// A line of bash with the scripts, too, on the PATH.
Outcome run(const Sandbox& box, const std::string& line, const std::string& input = {}) {
    return box.shell("PATH=" STIPPLE_SOURCE_DIR "/scripts:$PATH; " + line, input);
}

void expect_quiet(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

/// A file that starts as its format does and is longer than an empty picture.
void expect_picture(const Sandbox& box, const std::string& name) {
    const std::string extension = name.substr(name.rfind('.'));
    const std::string bytes = box.read(name);
    const std::string magic = extension == ".png"   ? "\x89PNG\r\n\x1a\n"
                              : extension == ".pdf" ? "%PDF-1."
                                                    : "<?xml";
    EXPECT_TRUE(bytes.starts_with(magic)) << name;
    EXPECT_TRUE(extension != ".svg" || bytes.ends_with("</svg>\n")) << name;
    EXPECT_GT(bytes.size(), 5000U) << name;
}

/// Texts of an SVG picture, a line each, without the markup inside.
std::string texts(const std::string& svg) {
    static const std::regex text("<text[^>]*>([^]*?)</text>");
    static const std::regex markup("<[^>]*>|\n *");
    static const std::regex no_break_space("\xC2\xA0");
    std::string found;
    for (std::sregex_iterator it(svg.begin(), svg.end(), text), end; it != end; ++it)
        found += std::regex_replace((*it)[1].str(), markup, "") + "\n";
    return std::regex_replace(found, no_break_space, " ");
}

}  // namespace

TEST(PlotDiscrepancy, DrawsACurveForEachGenerator) {
    const Sandbox box;
    expect_quiet(run(box,
                     "for n in 16 64 256; do stipple generate halton -n $n -o halton_$n.csv && "
                     "stipple generate random -n $n -m 3 -o random_$n.csv; done; "
                     "for g in halton random; do stipple analyze star-discrepancy "
                     "${g}_*.csv -o $g.json && stipple analyze star-discrepancy ${g}_*.csv -o "
                     "$g.csv; done"));
    for (const std::string extension : {".png", ".svg", ".pdf"}) {
        expect_quiet(run(box, "plot_discrepancy.py halton.json random.json -o a" + extension));
        expect_picture(box, "a" + extension);
    }
    expect_quiet(run(box, "cat halton.csv random.csv | plot_discrepancy.py -o b.svg"));
    EXPECT_EQ(box.read("a.svg"), box.read("b.svg"));
    expect_quiet(run(box,
                     "stipple analyze star-discrepancy halton_*.csv random_*.csv | "
                     "plot_discrepancy.py - -o c.svg"));
    EXPECT_EQ(box.read("a.svg"), box.read("c.svg"));
    const std::string words = texts(box.read("a.svg"));
    for (const char* word : {"Star discrepancy\n", "halton\n", "random\n", "number of points n\n",
                             "star discrepancy D*\n"})
        EXPECT_THAT(words, HasSubstr(word));
    expect_quiet(run(box,
                     "for n in 8 32; do stipple generate grid -n $((n * n)) | stipple analyze "
                     "star-discrepancy; done | plot_discrepancy.py --label 'a $ grid' --title "
                     "'$x & y$' -o d.svg"));
    EXPECT_THAT(texts(box.read("d.svg")), HasSubstr("$x &amp; y$\n"));
}

TEST(PlotDiscrepancy, RefusesBadInputInOneLine) {
    const Sandbox box;
    expect_quiet(run(box,
                     "stipple generate random -n 50 -o p.csv && stipple analyze "
                     "star-discrepancy p.csv -o a.json && stipple analyze chi-square p.csv -o "
                     "b.json"));
    const auto refuse = [&](int code, const std::string& words, const std::string& line) {
        expect_refusal(run(box, "plot_discrepancy.py " + line), code, words, "plot_discrepancy.py");
    };
    refuse(2, "-o: is needed", "a.json a.json");
    refuse(2, "--label: 2 for 1 files", "a.json --label x --label y");
    refuse(2, "once", "- - -o d.png");
    refuse(3, "star-discrepancy and chi-square", "a.json b.json -o d.png");
    refuse(3, "has no 'value'", "b.json");
    refuse(3, "has no number 'valeu'", "a.json --key valeu");
    refuse(3, "is not a report", "p.csv");
    refuse(4, "none.json", "none.json");
    EXPECT_EQ(box.files(), (std::vector<std::string>{"a.json", "b.json", "p.csv"}));
}

TEST(PlotConvergence, DrawsACurveForEachGeneratorWithItsSlope) {
    const Sandbox box;
    expect_quiet(run(box,
                     "for n in 16 64 256; do stipple generate sobol --scramble owen -n $n -m 3 -o "
                     "sobol_$n.csv && stipple generate random -n $n -m 3 -o random_$n.csv; done; "
                     "for f in json csv; do stipple analyze integration --integrand "
                     "disk-indicator,owen sobol_*.csv random_*.csv -o all.$f; done"));
    for (const std::string extension : {".png", ".svg", ".pdf"}) {
        expect_quiet(run(box, "plot_convergence.py all.json -o a" + extension));
        expect_picture(box, "a" + extension);
    }
    expect_quiet(run(box, "cat all.csv | plot_convergence.py -o b.svg"));
    EXPECT_EQ(box.read("a.svg"), box.read("b.svg"));
    const std::string words = texts(box.read("a.svg"));
    for (const char* word : {"Integration of disk-indicator\n", "sobol, ", "random, ",
                             "number of points n\n", "RMS error of 3 sets\n"})
        EXPECT_THAT(words, HasSubstr(word));
    // Means over sets tell the same root mean square, of all sets.
    expect_quiet(run(box,
                     "for n in 16 64 256; do stipple analyze integration --integrand "
                     "owen,disk-indicator --average random_$n.csv; done | plot_convergence.py "
                     "--integrand disk-indicator --label random --title '$x & y$' -o c.svg"));
    EXPECT_THAT(texts(box.read("c.svg")), HasSubstr("RMS error of 3 sets\n"));
    EXPECT_THAT(texts(box.read("c.svg")), HasSubstr("$x &amp; y$\n"));
}

// The table of a study has all that reports have.
TEST(PlotConvergence, DrawsStudies) {
    const Sandbox box;
    expect_quiet(run(box,
                     "stipple study --generators 'random;pmj02' -n 16..256*4 --seeds 3 --analyze "
                     "'integration:integrand=owen;moments' --no-seconds -o s.csv && "
                     "plot_convergence.py s.csv -o s.svg"));
    const std::string words = texts(box.read("s.svg"));
    for (const char* word :
         {"Integration of owen\n", "pmj02, ", "random, ", "RMS error of 3 sets\n"})
        EXPECT_THAT(words, HasSubstr(word));
    expect_quiet(run(box, "grep -v integration s.csv > m.csv"));
    expect_refusal(run(box, "plot_convergence.py m.csv -o m.svg"), 3,
                   "the study does not measure integration", "plot_convergence.py");
    expect_quiet(run(box, "(head -n 1 s.csv; echo nonsense) > n.csv"));
    expect_refusal(run(box, "plot_convergence.py n.csv -o n.svg"), 3,
                   "n.csv:2: is no row of a study", "plot_convergence.py");
}

TEST(PlotConvergence, RefusesBadInputInOneLine) {
    const Sandbox box;
    expect_quiet(run(box,
                     "stipple generate grid -n 49 -o p.csv && stipple analyze integration p.csv -o "
                     "a.json && stipple analyze chi-square p.csv -o b.json && stipple analyze "
                     "integration p.csv --expression x*y -o c.json"));
    const auto refuse = [&](int code, const std::string& words, const std::string& line) {
        expect_refusal(run(box, "plot_convergence.py " + line), code, words, "plot_convergence.py");
    };
    refuse(2, "-o: is needed", "a.json a.json");
    refuse(2, "--label: 2 for 1 files", "a.json --label x --label y");
    refuse(3, "b.json: reports chi-square; expected integration", "b.json");
    refuse(3, "has no error of any integrand", "c.json");
    refuse(3, "has no error of 'oven'", "a.json --integrand oven");
    refuse(3, "all errors are 0", "a.json --integrand measure");
    refuse(3, "is not a report", "p.csv");
    refuse(4, "none.json", "none.json");
    EXPECT_EQ(box.files(), (std::vector<std::string>{"a.json", "b.json", "c.json", "p.csv"}));
}

TEST(Overview, IsDrawnFromTheProgram) {
    const Sandbox box;
    expect_quiet(run(box, "overview.py -o overview.png && overview.py -o overview.svg"));
    expect_picture(box, "overview.png");
    EXPECT_LT(box.read("overview.png").size(), 150'000U);
    EXPECT_THAT(texts(box.read("overview.svg")), HasSubstr("stratified, more even than random"));
    expect_refusal(run(box, "PATH=/usr/bin:" STIPPLE_SOURCE_DIR "/scripts overview.py -o no.png"),
                   4, "PATH", "overview.py");
    EXPECT_FALSE(box.exists("no.png"));
}

// 64 points of a square grid: 1/8 apart, sqrt(sqrt(3) / 2) of hexagons, and circles of sqrt(1/2) /
// 8 are empty, sqrt(3 sqrt(3) / 4) times those of hexagons.
TEST(BlueNoiseTable, HasARowForEachGenerator) {
    const Sandbox box;
    const std::string table = STIPPLE_SOURCE_DIR "/tests/bench/blue_noise_table.py ";
    const Outcome outcome =
        run(box, table + "$(command -v stipple) --sets 2 --count 64 grid random");
    expect_quiet(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("| generator |"));
    EXPECT_THAT(outcome.out, HasSubstr("| grid      | 0.931    | 0.931    | 1.140 "));
    EXPECT_THAT(outcome.out, HasSubstr("\n| random    | 0.0"));
    EXPECT_THAT(outcome.out, HasSubstr("| published "));
    EXPECT_EQ(run(box, table).code, 1);
    EXPECT_EQ(run(box, table + "no/such/stipple").code, 1);
}

TEST(PublishedTable, HasOursBesideTheirs) {
    const Sandbox box;
    const std::string table = STIPPLE_SOURCE_DIR "/tests/bench/published_table.py ";
    const Outcome outcome = run(box, table + "$(command -v stipple) --sets 2 random jittered");
    expect_quiet(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("| published | ours "));
    EXPECT_THAT(outcome.out, HasSubstr("| `random -n 4096`   | mean       | 0.464     | 0.4"));
    EXPECT_THAT(outcome.out, HasSubstr("| `jittered -n 4096` | bond order | 0.363     | 0.3"));
    EXPECT_EQ(run(box, table).code, 1);
    EXPECT_EQ(run(box, table + "no/such/stipple").code, 1);
    EXPECT_EQ(run(box, table + "stipple nobody").code, 1);
}

TEST(Scripts, ExplainThemselves) {
    const Sandbox box;
    for (const char* name : {"plot_discrepancy.py", "plot_convergence.py", "overview.py"}) {
        const Outcome outcome = run(box, std::string(name) + " --help");
        expect_quiet(outcome);
        EXPECT_THAT(outcome.out, HasSubstr("usage: " + std::string(name)));
        EXPECT_THAT(outcome.out, HasSubstr("--output"));
    }
    // Importing draws nothing and reads nothing.
    expect_quiet(run(box, "PYTHONDONTWRITEBYTECODE=1 PYTHONPATH=" STIPPLE_SOURCE_DIR
                          "/scripts /usr/bin/python3 -c 'import plot_discrepancy, "
                          "plot_convergence, overview'"));
    EXPECT_EQ(box.files(), std::vector<std::string>{});
}

}  // namespace stipple::testing::scripts_test
