// SPDX-License-Identifier: MIT
//
// The verb plot: points and reports in; complete pictures out, or none.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <sstream>

#include "support/program.hpp"

namespace stipple::testing::plot_test {

using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// Parses an SVG file; prints the number of elements of a kind, or all texts.
std::string xml(const Sandbox& box, const std::string& file, const std::string& what) {
    box.write("look.py",
              "import sys, xml.etree.ElementTree as tree\n"
              "root = tree.parse(sys.argv[1]).getroot()\n"
              "found = list(root.iter('{http://www.w3.org/2000/svg}' + sys.argv[2]))\n"
              "print(len(found) if sys.argv[2] != 'text' else '|'.join(e.text for e in found))\n");
    return good(box.shell("/usr/bin/python3 look.py " + file + " " + what));
}

/// Parses a PNG file; prints its size, and its text chunks.
std::string png(const Sandbox& box, const std::string& file) {
    box.write("png.py",
              "import struct, sys, zlib\n"
              "data = open(sys.argv[1], 'rb').read()\n"
              "assert data[:8] == b'\\x89PNG\\r\\n\\x1a\\n'\n"
              "at, pixels = 8, b''\n"
              "while at < len(data):\n"
              "    size, kind = struct.unpack('>I4s', data[at:at + 8])\n"
              "    body = data[at + 8:at + 8 + size]\n"
              "    crc, = struct.unpack('>I', data[at + 8 + size:at + 12 + size])\n"
              "    assert zlib.crc32(kind + body) == crc\n"
              "    if kind == b'IHDR':\n"
              "        width, height = struct.unpack('>II', body[:8])\n"
              "        print(width, height)\n"
              "    if kind == b'IDAT': pixels += body\n"
              "    if kind == b'iTXt':\n"
              "        print(body.replace(b'\\0', b' ').decode())\n"
              "    at += 12 + size\n"
              "assert len(zlib.decompress(pixels)) == height * (3 * width + 1)\n");
    return good(box.shell("/usr/bin/python3 png.py " + file));
}

}  // namespace

TEST(Plot, WritesSvgToAPipeWithAMarkForEachPoint) {
    const Sandbox box;
    box.write("p.svg",
              good(box.shell("stipple generate random -n 200 --seed 5 -f json | stipple plot")));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "200\n");
    EXPECT_THAT(xml(box, "p.svg", "text"), HasSubstr("random|200 points, seed 5|"));
    EXPECT_THAT(box.read("p.svg"), HasSubstr("\"command\":\"stipple generate random --count 200"));
}

// The table as CSV and as JSON lines, from a pipe followed by the summary, and the summary alone.
TEST(Plot, DrawsStudies) {
    const Sandbox box;
    const std::string study =
        "stipple study --generators 'random;halton' -n 16..256*4 --seeds 4 --analyze "
        "star-discrepancy "
        "--no-seconds --keys value ";
    good(box.shell(study + "--summary -o s.csv && stipple plot s.csv -o s.svg"));
    good(box.shell(study + "-o s.jsonl && stipple plot s.jsonl -o j.svg"));
    good(box.shell(study + "--summary | stipple plot -o p.svg"));
    good(box.shell("stipple plot s.summary.csv -o m.svg && stipple plot s.csv -o s.png"));
    const std::string texts = xml(box, "s.svg", "text");
    EXPECT_THAT(texts, HasSubstr("Star discrepancy|d = 2 · means of 4 sets, with 95 % intervals|"));
    EXPECT_THAT(texts, HasSubstr("|64|"));
    EXPECT_THAT(texts, ::testing::ContainsRegex("random .slope −0\\.[34567]"));
    EXPECT_THAT(texts, ::testing::ContainsRegex("halton .slope −0\\.[789]"));
    for (const char* same : {"j.svg", "p.svg", "m.svg"}) EXPECT_EQ(xml(box, same, "text"), texts);
    EXPECT_EQ(xml(box, "s.svg", "circle"), "6\n");
    EXPECT_TRUE(png(box, "s.png").starts_with("1440 "));
    EXPECT_THAT(good(box.shell("stipple plot s.csv -f text")), HasSubstr("Star discrepancy"));
    // Two studies.
    good(box.shell("cp s.csv t.csv && stipple plot s.csv t.csv -o two.svg"));
    EXPECT_THAT(xml(box, "two.svg", "text"), HasSubstr("t.csv: halton (slope"));
}

TEST(Plot, DrawsGeneratedPoints) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 50 -s 4 -o a.json && stipple plot a.json -o a.svg"));
    good(box.shell("stipple plot --generate random -n 50 -s 4 -o b.svg"));
    const auto marks = [&](const char* file) {
        const std::string svg = box.read(file);
        return svg.substr(svg.find("</metadata>"));
    };
    EXPECT_TRUE(marks("a.svg") == marks("b.svg"));
    EXPECT_THAT(box.read("b.svg"), HasSubstr("plot --generate random --count 50 --seed 4"));
    expect_refusal(box.shell("stipple plot --generate random --column 1"), 2,
                   "--column: applies to points from files, not to --generate");
    expect_refusal(box.shell("stipple plot a.json -n 3"), 2, "--count: requires --generate");
}

TEST(Plot, RefusesStudiesThatItCannotDraw) {
    const Sandbox box;
    good(box.shell(
        "stipple study --generators random -n 16 --analyze moments --no-seconds -o s.csv"));
    expect_refusal(box.shell("stipple plot s.csv --key nonsense"), 2,
                   "--key: the study has no result 'nonsense'");
    expect_refusal(box.shell("stipple plot s.csv --chart radial"), 2,
                   "--chart: does not apply to the table");
    expect_refusal(box.shell("head -n 1 s.csv | stipple plot"), 3, "the study has no rows");
    expect_refusal(box.shell("(cat s.csv; echo nonsense) | stipple plot"), 3,
                   "this is not a row of a study");
}

TEST(Plot, NotesTheCommandAsAShellTakesIt) {
    const Sandbox box;
    box.write("my points.csv", "0.5,0.25\n");
    const std::string svg = good(box.run({"plot", "my points.csv", "--title", "A b"}));
    EXPECT_THAT(svg, HasSubstr("stipple plot 'my points.csv' --title 'A b'"));
}

TEST(Plot, TakesEveryFormatThatIsRead) {
    const Sandbox box;
    for (const std::string format : {"csv", "txt", "json", "jsonl", "npy"}) {
        good(box.shell("stipple generate halton -n 50 -f " + format + " -o p." + format +
                       " && stipple plot p." + format + " --title '' -o " + format + ".svg"));
        EXPECT_EQ(xml(box, format + ".svg", "circle"), "50\n") << format;
    }
    const std::string piped =
        good(box.shell("stipple generate halton -n 50 -f npy | stipple plot --title ''"));
    EXPECT_EQ(piped.substr(piped.find("</metadata>")),
              box.read("npy.svg").substr(box.read("npy.svg").find("</metadata>")));
}

TEST(Plot, AnEmptyTitleIsNone) {
    const Sandbox box;
    good(box.shell(
        "stipple generate halton -n 64 -o a.csv; stipple analyze periodogram a.csv -o p.json"));
    for (const char* input : {"a.csv", "p.json"}) {
        const std::string told = good(box.run({"plot", input, "-f", "svg"}));
        const std::string untold = good(box.run({"plot", input, "-f", "svg", "--title", ""}));
        const char* subtitle = input[0] == 'a' ? ">64 points" : ">n = 64, d = 2";
        EXPECT_THAT(told, HasSubstr(subtitle)) << input;
        EXPECT_THAT(untold, ::testing::Not(HasSubstr(subtitle))) << input;
    }
}

TEST(Plot, PngHasTheSizeAskedForAndSaysWhereItComesFrom) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 100 -f json -o p.json && "
                  "stipple plot p.json -o p.png --width 300 --height 200 --theme dark && "
                  "stipple plot p.json -o q.png --width 300 --height 200 --theme dark"));
    const std::string found = png(box, "p.png");
    EXPECT_TRUE(found.starts_with("300 200\n")) << found;
    EXPECT_THAT(found, HasSubstr("\"generator\":\"random\""));
    EXPECT_THAT(found, HasSubstr("stipple plot p.json"));
    EXPECT_EQ(box.read("p.png"), box.read("q.png"));
}

TEST(Plot, DrawsReportsOfAnalyzers) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 64 -m 3 -f json -o j.json"));
    good(box.shell("stipple analyze periodogram j.json --average | stipple plot -o power.svg"));
    EXPECT_THAT(xml(box, "power.svg", "text"),
                HasSubstr("Power spectrum of 3 sets: j.json|n = 64, d = 2 · effective Nyquist"));
    good(box.shell("stipple analyze pair-correlation j.json | stipple plot -o g.svg"));
    EXPECT_THAT(xml(box, "g.svg", "text"), HasSubstr("j.json, set 2"));
    good(box.shell("stipple analyze star-discrepancy j.json --every 8 | stipple plot -o d.svg"));
    EXPECT_THAT(xml(box, "d.svg", "text"), HasSubstr("points n"));
    good(box.shell("stipple analyze star-discrepancy j.json | stipple plot -o h.svg"));
    EXPECT_THAT(xml(box, "h.svg", "text"), HasSubstr("3 sets"));
    good(box.shell("stipple analyze nearest-neighbor j.json | stipple plot --key mean -o m.svg"));
    EXPECT_THAT(xml(box, "m.svg", "text"), HasSubstr("mean"));
}

TEST(Plot, DrawsWhatIsAnalyzedOnTheWay) {
    const Sandbox box;
    good(box.shell("stipple generate jittered -n 64 -m 3 -f json -o j.json"));
    for (const std::string chart :
         {"points", "density", "histogram", "distances", "radial", "pair-correlation"}) {
        good(box.run({"plot", "j.json", "--chart", chart, "-o", chart + ".svg"}));
        EXPECT_THAT(xml(box, chart + ".svg", "text"), HasSubstr("jittered")) << chart;
    }
    good(box.run({"plot", "j.json", "--chart", "spectrum", "-o", "s.svg"}));
    EXPECT_EQ(xml(box, "s.svg", "image"), "2\n");
    // Same numbers as the analyzer's, apart from the name of the input.
    good(box.shell(
        "stipple analyze periodogram j.json --average | stipple plot -o a.svg --title t"));
    good(box.shell("stipple plot j.json --chart radial -o b.svg --title t"));
    const auto shapes = [&](const char* file) {
        return box.read(file).substr(box.read(file).find("</metadata>"));
    };
    EXPECT_EQ(shapes("a.svg"), shapes("b.svg"));
}

// The value is the analyzer's; a file, a pipe and a generator give the same picture.
TEST(Plot, DrawsTheLocalDiscrepancy) {
    const Sandbox box;
    const std::string plot = "stipple plot --chart local-discrepancy ";
    good(box.shell("stipple generate sobol -n 64 -f json -o p.json"));
    good(box.shell("stipple analyze star-discrepancy p.json --check value==0.0537109375"));
    good(box.shell(
        plot + "p.json -o a.svg && stipple plot --chart local-discrepancy < p.json > b.svg && " +
        plot + "--generate sobol -n 64 -o c.svg"));
    const std::string texts = xml(box, "a.svg", "text");
    EXPECT_THAT(texts,
                HasSubstr("Local discrepancy of sobol|star discrepancy 0.0537109 · 64 points|"
                          "too few: [0, 0.7031) × [0, 0.7031): −0.02563|"
                          "too many: [0, 0.8438] × [0, 0.8438]: 0.05371|"));
    EXPECT_EQ(xml(box, "a.svg", "image"), "2\n");
    EXPECT_EQ(xml(box, "a.svg", "circle"), "64\n");
    const auto shapes = [&](const char* file) {
        return box.read(file).substr(box.read(file).find("</metadata>"));
    };
    EXPECT_TRUE(shapes("a.svg") == shapes("b.svg") && shapes("a.svg") == shapes("c.svg"));
    good(box.shell(plot + "p.json -o a.png --width 300 --height 350 && " + plot +
                   "p.json -o a.pdf"));
    EXPECT_TRUE(png(box, "a.png").starts_with("300 350\n"));
    EXPECT_TRUE(box.read("a.pdf").starts_with("%PDF"));
    EXPECT_LT(box.read("a.pdf").size(), 1'000'000U);
    EXPECT_THAT(good(box.shell(plot + "p.json -f text --title T")),
                ::testing::AllOf(HasSubstr("T\n┌"), HasSubstr("star discrepancy 0.0537109\n")));
    // One bar of colours for all frames of a row.
    good(box.shell(plot + "--generate sobol --generate random --generate halton -n 64 -o s.svg"));
    EXPECT_EQ(xml(box, "s.svg", "image"), "4\n");
    EXPECT_THAT(good(box.shell(plot + "--generate sobol --generate random -n 8 -f text")),
                HasSubstr("random"));
}

TEST(Plot, RefusesALocalDiscrepancyOfOtherPoints) {
    const Sandbox box;
    const std::string plot = "stipple plot --chart local-discrepancy -o p.svg ";
    box.write("far.csv", "0.5,0.5\n0.5,1.5\n");
    box.write("empty.csv", "x,y\n");
    for (const char* d : {"1", "3"})
        expect_refusal(
            box.shell(plot + "--generate random -n 9 -d " + d), 3,
            std::string(
                "the local discrepancy can be drawn for points of 2 coordinates; these have ") +
                d);
    expect_refusal(
        box.shell(plot + "far.csv"), 3,
        "far.csv: 1 of 2 points are outside the unit cube [0, 1]^2; the first is point 1");
    expect_refusal(box.shell(plot + "empty.csv"), 3, "empty.csv");
    expect_refusal(box.shell(plot + "--generate random --overlay"), 2,
                   "--overlay: does not apply to");
    expect_refusal(box.shell(plot + "--generate random --draw cells"), 2,
                   "--draw: does not apply to");
    expect_refusal(box.shell(plot + "--generate random --width 300 --height 100"), 2,
                   "--width: 300 and --height: 100 leave no room for the picture; at least ");
    good(box.shell(plot + "far.csv --rescale"));
    EXPECT_EQ(box.shell("stipple generate random -n 5 -m 13 -f json | " + plot).code, 0);
}

TEST(Plot, DrawsTheTableThatGridSaves) {
    const Sandbox box;
    good(
        box.shell("stipple generate halton -n 64 | "
                  "stipple analyze periodogram --grid g.npy -o r.json && "
                  "stipple plot g.npy -o g.svg"));
    EXPECT_THAT(xml(box, "g.svg", "text"), HasSubstr("frequency fx"));
    EXPECT_EQ(xml(box, "g.svg", "circle"), "0\n");
    good(
        box.shell("stipple generate halton -n 64 -d 3 | stipple analyze periodogram --grid g3.npy "
                  "-o r.json && stipple plot g3.npy -o g3.svg && "
                  "stipple generate halton -n 64 -d 1 | stipple analyze periodogram --grid g1.npy "
                  "-o r.json && stipple plot g1.npy -o g1.svg && "
                  "stipple generate halton -n 64 | stipple analyze differential --grid d.npy "
                  "-o r.json && stipple plot d.npy -o d.svg"));
    EXPECT_THAT(xml(box, "g3.svg", "text"), HasSubstr("plane fz = 0"));
    EXPECT_THAT(xml(box, "g1.svg", "text"), HasSubstr("white noise"));
    EXPECT_THAT(xml(box, "d.svg", "text"), HasSubstr("Δx (pixels)"));
}

// Only an NPY file can be a table saved by --grid; text is points, even if symmetric.
TEST(Plot, DrawsEqualAndMirroredPointsAsPoints) {
    const Sandbox box;
    box.write("equal.csv", "1\n1\n1\n1\n1\n1\n1\n1\n1\n");
    box.write("mirrored.csv", "1\n2\n3\n4\n5\n4\n3\n2\n1\n");
    std::string rows;
    for (int i = 0; i < 9; ++i) {
        for (int j = 0; j < 9; ++j) rows += std::string(j > 0 ? "," : "") + (i == j ? "1" : "0");
        rows += '\n';
    }
    box.write("identity.csv", rows);
    for (const std::string name : {"equal", "mirrored", "identity"}) {
        EXPECT_EQ(box.run({"plot", name + ".csv", "-o", name + ".svg"}).code, 0);
        EXPECT_THAT(xml(box, name + ".svg", "text"), Not(HasSubstr("frequency"))) << name;
    }
    EXPECT_EQ(
        box.shell("stipple convert identity.csv -o i.npy && stipple plot i.npy -o i.svg").code, 0);
    EXPECT_THAT(xml(box, "i.svg", "text"), Not(HasSubstr("frequency")));
}

TEST(Plot, DrawsInLetters) {
    const Sandbox box;
    const std::string text = good(
        box.shell("printf '0,0\\n1,1\\n' | stipple plot -f text --width 20 --height 12 --title T"));
    EXPECT_TRUE(text.starts_with("T\n")) << text;
    EXPECT_THAT(text, HasSubstr("⠈│"));
    EXPECT_THAT(text, HasSubstr("│⡀"));
    const std::string curve = good(
        box.shell("stipple generate halton -n 64 | stipple analyze periodogram | stipple plot -f "
                  "text --width 60 --height 20"));
    EXPECT_THAT(curve, HasSubstr("frequency"));
}

TEST(Plot, AMillionPointsAreASmallPicture) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 1e6 -f npy | stipple plot -o p.svg"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "0\n");
    EXPECT_EQ(xml(box, "p.svg", "image"), "2\n");
    EXPECT_LT(box.read("p.svg").size(), 500'000U);
}

TEST(Plot, DarkIsDark) {
    const Sandbox box;
    const std::string points = "printf '0.5,0.5\\n' | stipple plot --theme ";
    EXPECT_THAT(good(box.shell(points + "light")), HasSubstr("fill=\"#ffffff\""));
    EXPECT_THAT(good(box.shell(points + "dark")), HasSubstr("fill=\"#16181c\""));
}

TEST(Plot, RefusesLogarithmicAxesOfWhatHasNone) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 100 -o p.csv"));
    box.write("positive.csv", "0.1,30\n1,20\n100,10\n");
    good(box.shell("stipple analyze periodogram p.csv --max-frequency 4 --grid g.npy"));
    for (const std::string axis : {"--x-scale", "--y-scale"}) {
        for (const std::string chart : {"spectrum", "differential", "local-discrepancy"})
            for (const std::string format : {"svg", "text"})
                expect_refusal(
                    box.run({"plot", "p.csv", "--chart", chart, "-f", format, axis, "log"}), 2,
                    axis + ": a picture of");
        expect_refusal(box.run({"plot", "--generate", "random", "-d", "3", axis, "log"}), 2,
                       axis + ": a picture of such points");
        expect_refusal(box.run({"plot", "--generate", "halton", axis, "log"}), 3,
                       axis + ": a logarithmic axis cannot show this coordinate");
        expect_refusal(box.run({"plot", "g.npy", axis, "log"}), 2, axis + ": a picture of a table");
        for (const std::string chart : {"histogram", "distances", "radial", "pair-correlation"})
            good(box.run({"plot", "p.csv", "--chart", chart, axis, "log"}));
        for (const std::string chart : {"points", "density"}) {
            good(box.run({"plot", "positive.csv", "--chart", chart, axis, "log"}));
            // The picture shows the whole unit square, with zero.
            expect_refusal(box.run({"plot", "p.csv", "--chart", chart, axis, "log"}), 3,
                           axis + ": a logarithmic axis cannot show this coordinate");
        }
        good(box.run({"plot", "p.csv", axis, "linear"}));
    }
}

TEST(Plot, NotesValuesThatALogarithmicHistogramLeavesOut) {
    const Sandbox box;
    std::string values;
    for (int i = -11; i < 189; ++i) values += std::to_string(0.5 * i) + "\n";
    box.write("v.csv", values);
    const Outcome some = box.run({"plot", "v.csv", "--chart", "histogram", "--x-scale", "log"});
    EXPECT_EQ(some.code, 0);
    EXPECT_THAT(some.err, HasSubstr("12 of 200 values are 0 or less, and not on the logarithmic"));
    box.write("n.csv", "-1\n-2\n0\n");
    expect_refusal(box.run({"plot", "n.csv", "--chart", "histogram", "--x-scale", "log"}), 3,
                   "no value is above 0");
    good(
        box.shell("stipple study --generators 'random;jittered' --count 64,256 --sets 2 --analyze "
                  "periodogram --keys radial.anisotropy_db -o s.csv"));
    const std::string drawn = good(box.run({"plot", "s.csv", "-q"}));
    EXPECT_THAT(drawn, Not(HasSubstr("RMS of")));
    expect_refusal(box.run({"plot", "s.csv", "--y-scale", "log"}), 3, "which has negative means");
}

TEST(Plot, RefusesWhatIsNoPictureAndLeavesNoFile) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 100 -o p.csv"));
    box.write("bad.csv", "x,y\n0.1,zero\n");
    box.write("empty.json", "[]");
    box.write("none.json", "");
    good(
        box.shell("stipple analyze chi-square p.csv -o chi.json; stipple analyze moments p.csv -o "
                  "moments.json; stipple analyze nearest-neighbor p.csv -o nearest.json"));
    const auto before = box.files();
    expect_refusal(box.run({"plot", "p.csv", "-o", "p.eps"}), 2, "p.eps has no extension");
    expect_refusal(box.run({"plot", "p.csv", "-o", "p"}), 2, "expected .svg, .pdf, .png or .txt");
    expect_refusal(box.run({"plot", "p.csv", "-f", "gif"}), 2, "not one of svg, pdf, png, text");
    expect_refusal(box.run({"plot", "p.csv", "--theme", "blue"}), 2, "light, dark");
    expect_refusal(box.run({"plot", "p.csv", "--chart", "pie"}), 2, "histogram");
    expect_refusal(box.run({"plot", "p.csv", "--width", "0"}), 2, "outside [120, 20000]");
    expect_refusal(box.run({"plot", "p.csv", "-f", "text", "--width", "0"}), 2,
                   "outside [20, 1000]");
    expect_refusal(box.run({"plot", "p.csv", "--chart", "radial", "-f", "svg", "--height", "100"}),
                   2, "--height: 100 leaves no room for the picture; at least 1");
    expect_refusal(box.run({"plot", "p.csv", "--set", "1"}), 2, "outside [0, 0]");
    expect_refusal(box.run({"plot", "p.csv", "--key", "value"}), 2, "--key");
    expect_refusal(box.run({"plot", "p.csv", "--y-scale", "cubic"}), 2, "linear, log");
    expect_refusal(box.run({"plot", "bad.csv", "-o", "bad.svg"}), 3, "bad.csv:2");
    expect_refusal(box.run({"plot", "empty.json", "-o", "e.svg"}), 3, "contains no report");
    expect_refusal(box.run({"plot", "none.json", "-o", "e.svg"}), 3, "none.json");
    expect_refusal(box.run({"plot", "chi.json", "-o", "c.svg"}), 3, "nothing to draw");
    expect_refusal(box.run({"plot", "moments.json", "-o", "c.svg"}), 3, "nothing to draw");
    expect_refusal(box.run({"plot", "chi.json", "nearest.json", "-o", "c.svg"}), 3,
                   "a single report of chi-square has only numbers");
    expect_refusal(box.run({"plot", "chi.json", "p.csv", "--labels", "a"}), 2,
                   "--labels: applies to inputs of a single kind");
    expect_refusal(box.run({"plot", "chi.json", "--chart", "points"}), 2, "--chart");
    expect_refusal(box.run({"plot", "missing.csv"}), 4, "no such file");
    expect_refusal(box.run({"plot", "p.csv", "-o", "no/where.svg"}), 4, "no folder");
    box.write("far.csv", "5,5\n6,6\n");
    expect_refusal(box.run({"plot", "far.csv", "--chart", "radial", "-o", "f.svg"}), 3,
                   "far.csv: 2 of 2 points are outside");
    std::filesystem::remove(box.path() / "far.csv");
    expect_refusal(box.run({"plot", "p.csv", "-o", "big.png", "--width", "20000"}), 5, "picture");
    EXPECT_EQ(box.files(), before);
}

TEST(Plot, DrawsOnePointAndEqualPoints) {
    const Sandbox box;
    for (const std::string points : {"0.5,0.5", "7,7", "3,3\\n3,3", "0.5", "1,2,3", "1,2,3,4"})
        for (const std::string format : {"svg", "png", "text"}) {
            const Outcome outcome =
                box.shell("printf '" + points + "\\n' | stipple plot -f " + format);
            EXPECT_EQ(outcome.code, 0) << points << " " << outcome.err;
            EXPECT_GT(outcome.out.size(), 100U) << points << " " << format;
        }
    expect_refusal(box.shell("printf '3,3\\n' | stipple plot --chart distances"), 3,
                   "no nearest neighbour");
}

// Columns with different units have separate axes.
TEST(Plot, UnlikeSidesAreNotCompared) {
    const Sandbox box;
    box.write(
        "g.csv",
        "Alter;Einkommen;Groesse\n23;1500,5;1,62\n35;2400;1,75\n45;3100,25;1,8\n52;4200;1,5\n");
    box.write("u.csv", "0.1,0.1,0.2\n0.4,0.3,0.5\n0.75,0.6,0.6\n0.9,0.9,0.1\n");
    const auto width_of_dots = [&](const char* file, const char* column) {
        good(box.shell(std::string("stipple plot ") + file + column + " -o g.svg"));
        const std::string svg = box.read("g.svg");
        double low = 1e9;
        double high = -1e9;
        for (auto at = svg.find("cx=\""); at != std::string::npos; at = svg.find("cx=\"", at + 1)) {
            low = std::min(low, std::stod(svg.substr(at + 4)));
            high = std::max(high, std::stod(svg.substr(at + 4)));
        }
        return high - low;
    };
    for (const char* column : {"", " --column 1,2"})
        EXPECT_GT(width_of_dots("g.csv", column), 0.5 * width_of_dots("u.csv", column)) << column;
}

// On a square grid the cells are squares, and the largest gap is in the middle of four points.
TEST(Plot, DrawsCellsAndTheLargestGap) {
    const Sandbox box;
    good(box.shell("stipple generate grid -n 16 -o g.csv"));
    const auto lines = [&](const std::string& more) {
        good(box.shell("stipple plot g.csv -o g.svg --width 640 " + more));
        const std::string count = xml(box, "g.svg", "path");
        return std::stoi(count);
    };
    const int plain = lines("");
    EXPECT_EQ(lines("--draw cells"), plain + 24);  // edges between 16 squares
    EXPECT_EQ(lines("--draw gap"), plain + 18);    // a disk and its rim, with periodic copies
    EXPECT_EQ(lines("--draw gap,cells"), plain + 42);
    EXPECT_EQ(lines("--draw grid=8x4"), plain + 10);  // 7 lines upward, and 3 across
    EXPECT_EQ(lines("--draw grid=1x2,cells"), plain + 25);
    for (const std::string extension : {"pdf", "png"}) {
        good(box.shell("stipple plot g.csv -o a." + extension));
        good(box.shell("stipple plot g.csv --draw grid=8x4 -o b." + extension));
        EXPECT_NE(box.read("a." + extension), box.read("b." + extension));
    }
    for (const std::string text : {"8", "8x", "0x4", "8x4x2", "axb", "2000x2"})
        expect_refusal(box.shell("stipple plot g.csv -o g.svg --draw grid=" + text), 2,
                       "--draw: 'grid=" + text + "' is not grid=COLUMNSxROWS of 1 to 1024");
    expect_refusal(box.shell("stipple plot g.csv -o g.svg --draw holes"), 2,
                   "not one of cells, gap, grid=COLUMNSxROWS");
    expect_refusal(box.shell("stipple plot --generate random -d 3 -o g.svg --draw gap"), 2,
                   "--draw");
}

// The cross-reference table has the position of every object; text is stored as text, and every
// point is a dot.
TEST(Plot, WritesPdf) {
    const Sandbox box;
    good(box.shell("stipple plot --generate random -n 37 --title 'Größe (10⁻³) ★' -o p.pdf"));
    const std::string pdf = box.read("p.pdf");
    ASSERT_TRUE(pdf.starts_with("%PDF-1.4\n"));
    ASSERT_TRUE(pdf.ends_with("%%EOF\n"));
    const std::string checked = good(
        box.shell("python3 -c '\n"
                  "import re, struct, zlib\n"
                  "b = open(\"p.pdf\", \"rb\").read()\n"
                  "table = int(re.search(rb\"startxref.(\\d+)\", b, re.S).group(1))\n"
                  "assert b[table:table + 4] == b\"xref\"\n"
                  "places = re.findall(rb\"(\\d{10}) 00000 n\", b[table:])\n"
                  "for i, at in enumerate(places):\n"
                  "    assert b[int(at):].startswith(b\"%d 0 obj\" % (i + 1))\n"
                  "streams = [zlib.decompress(b[m.end():m.end() + int(m.group(1))])\n"
                  "           for m in re.finditer(rb\"Length (\\d+)>>.stream.\", b, re.S)]\n"
                  "page = streams[0]\n"
                  "assert page.count(b\"BT\") == page.count(b\"ET\") and page.count(b\"q \") "
                  "== page.count(b\"Q\")\n"
                  "fonts = [{k: bytes.fromhex(u.decode()).decode(\"utf-16-be\")\n"
                  "          for k, u in re.findall(rb\"<(....)><(\\w+)>\\n\", s)}\n"
                  "         for s in streams if b\"beginbfchar\" in s]\n"
                  "for s in [s for s in streams if s.startswith(b\"\\0\\1\\0\\0\")]:\n"
                  "    tables = {s[12 + 16 * i:][:4]: struct.unpack(\">II\", s[20 + 16 * i:][:8])\n"
                  "              for i in range(struct.unpack(\">H\", s[4:6])[0])}\n"
                  "    part = lambda name: s[tables[name][0]:sum(tables[name])]\n"
                  "    count = struct.unpack(\">H\", part(b\"maxp\")[4:6])[0]\n"
                  "    assert count in [len(f) + 1 for f in fonts]\n"
                  "    places = struct.unpack(\">%dI\" % (count + 1), part(b\"loca\"))\n"
                  "    assert places == tuple(sorted(places))\n"
                  "    assert places[-1] == len(part(b\"glyf\"))\n"
                  "    assert len(part(b\"hmtx\")) == 4 * count\n"
                  "print(len(re.findall(rb\"([0-9.]+ [0-9.]+) m \\1 l\", page)))\n"
                  "for f, text in re.findall(rb\"/F(.) \\S+ Tf [^<]*<(\\w+)> Tj\", page):\n"
                  "    print(\"\".join(fonts[int(f) - 1][text[i:i + 4]]\n"
                  "          for i in range(0, len(text), 4)))'"));
    EXPECT_TRUE(checked.starts_with("37\n")) << checked.substr(0, 20);
    EXPECT_THAT(checked, HasSubstr("\nGröße (10⁻³) ★\n37 points, seed 1\n"));
    // Fonts are embedded, and their letters are searchable.
    EXPECT_THAT(pdf, HasSubstr("/FontFile2 "));
    EXPECT_THAT(pdf, Not(HasSubstr("/Type1")));
    if (box.shell("command -v pdffonts && command -v pdftotext").code == 0) {
        EXPECT_THAT(good(box.shell("pdftotext p.pdf -")), HasSubstr("Größe (10⁻³) ★"));
        std::istringstream fonts(good(box.shell("pdffonts p.pdf")));
        std::string line;
        for (int i = 0; std::getline(fonts, line); ++i)
            EXPECT_TRUE(i < 2 || line.find("yes yes yes") != std::string::npos) << line;
    }
    EXPECT_THAT(pdf, HasSubstr("/Title<FEFF004700720"));
    good(box.shell("stipple plot --generate random -n 37 --title 'Größe (10⁻³) ★' -f pdf > q.pdf"));
    EXPECT_TRUE(box.read("q.pdf").substr(0, 900) == pdf.substr(0, 900));
}

// Two coordinates that differ in their last bits, or by the whole range of doubles, give a picture
// or an error in every format; quickly, and without NaN or infinity in it.
TEST(Plot, EndsForEveryPairOfCoordinates) {
    const Sandbox box;
    // Sanitizers need more address space than any limit.
    const std::string limits = sanitized() ? "ulimit -t 60; " : "ulimit -t 20 -v 4000000; ";
    const std::vector<std::pair<std::string, std::string>> pairs = {
        {"1", "1.0000000000000002"},
        {"1e15", "1000000000000000.125"},
        {"1e300", "-1e300"},
        {"5e-324", "1e-320"},
        {"0", "5e-324"},
        {"1e-300", "1e300"},
        {"7", "7"},
        {"-1e15", "-1000000000000000.125"},
        {"1e9", "1000000000.001"}};
    for (const auto& [a, b] : pairs)
        for (const std::string file : {"p.svg", "p.pdf", "p.txt"})
            for (const std::string chart : {"", " --chart histogram"}) {
                for (const std::string d : {"1", "2", "3", "4"}) {
                    box.write("p.csv", d == "1"   ? "x\n" + a + "\n" + b + "\n"
                                       : d == "2" ? "x,y\n" + a + ",1\n" + b + ",2\n"
                                       : d == "3" ? "x,y,z\n" + a + ",1," + b + "\n" + b + ",2,3\n"
                                                  : "x,y,z,w\n" + a + ",1,2," + b + "\n" + b +
                                                        ",2,3," + a + "\n");
                    const Outcome outcome =
                        box.shell(limits + "stipple plot p.csv -o " + file + chart);
                    ASSERT_EQ(outcome.code, 0) << a << " " << b << " " << d << outcome.err;
                    const std::string picture = box.read(file);
                    ASSERT_LT(picture.size(), 200'000U) << a << " " << b << " " << d;
                    if (file == "p.pdf") continue;
                    ASSERT_THAT(picture, Not(::testing::ContainsRegex("[ \"(]-?(nan|inf)[ \")]")))
                        << a << " " << b;
                }
            }
    box.write("p.csv", "x,y\n1,5\n1.0000000000000002,6\n");
    good(box.shell("stipple plot p.csv -o p.svg"));
    EXPECT_THAT(xml(box, "p.svg", "text"), HasSubstr("x (all the same to 13 digits)"));
    box.write("p.csv", "x,y\n-1.7e308,0\n1.7e308,1\n");
    EXPECT_THAT(box.shell("stipple plot p.csv -o q.svg").err, HasSubstr("too wide for float64"));
    box.write("r.json", R"([{"format":"stipple.report","version":1,"analyzer":"dispersion",)"
                        R"("input":{"source":"a","count":4,"dimension":2,"domain":"unit-cube"},)"
                        R"("options":{},"results":{"value":1e-320}},)"
                        R"({"format":"stipple.report","version":1,"analyzer":"dispersion",)"
                        R"("input":{"source":"b","count":9,"dimension":2,"domain":"unit-cube"},)"
                        R"("options":{},"results":{"value":1e300}}])");
    for (const std::string file : {"p.svg", "p.png", "p.txt"})
        good(box.shell(limits + "stipple plot r.json -o " + file));
}

// Failed runs have no numbers: their rows are left out, with a note.
TEST(Plot, LeavesOutRowsWithMissingNumbers) {
    const Sandbox box;
    box.write("p.csv", "x,y\n0.1,0.2\n,0.5\n0.3,NA\n0.4,nan\n0.9,0.8\n");
    const Outcome outcome = box.run({"plot", "p.csv", "-o", "p.svg"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("p.csv: 3 of 5 rows are left out"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "2\n");
    EXPECT_THAT(xml(box, "p.svg", "text"),
                HasSubstr("2 points, without 3 that have missing numbers"));
    box.write("p.csv", "x,y\n,0.2\n1,nan\n");
    expect_refusal(box.run({"plot", "p.csv", "-o", "q.svg"}), 3, "each of its 2 rows");
}

TEST(Plot, LabelsAndAxesNameWhatIsDrawn) {
    const Sandbox box;
    const std::string three =
        "stipple plot --generate halton --generate sobol --generate random -n 64 ";
    good(box.shell(three + "--overlay --labels 'One,Two and more,Three' --axes 'Width (mm),Höhe' "
                           "-o p.svg"));
    std::string texts = xml(box, "p.svg", "text");
    for (const char* word : {"|One|", "|Two and more|", "|Three|", "|Width (mm)|", "|Höhe"})
        EXPECT_THAT("|" + texts, HasSubstr(word));
    // Quotes as in CSV, but only around a whole name.
    good(box.shell(three + R"(--labels 'A, "n = 1,""x""" ,5" wide' -o p.svg)"));
    texts = "|" + xml(box, "p.svg", "text");
    for (const char* word : {"|A|", "|n = 1,\"x\"|", "|5\" wide|"})
        EXPECT_THAT(texts, HasSubstr(word));
    expect_refusal(box.shell(three + R"(--labels 'A,"B,C' -o q.svg)"), 2,
                   "--labels: a quote is not closed in 'A,\"B,C'");
    good(box.shell(three + "--labels A,B,C -o p.svg"));
    EXPECT_THAT(xml(box, "p.svg", "text"), HasSubstr("A|64 points"));
    good(box.shell(three + "--chart radial --labels A,B,C --axes 'f,P(f),dB' -o p.svg"));
    texts = xml(box, "p.svg", "text");
    for (const char* word : {"A|B|C|", "|P(f)|", "|dB", "|f"}) EXPECT_THAT(texts, HasSubstr(word));
    expect_refusal(box.shell(three + "--labels A,B -o q.svg"), 2,
                   "--labels: 2 names; expected one for each of the");
    expect_refusal(box.shell(three + "--axes A -o q.svg"), 2, "--axes: 1 names for points of 2");
    good(
        box.shell("stipple study --generators halton,random -n 16,64,256 --seeds 3 --analyze "
                  "dispersion --quiet -o s.csv"));
    good(box.shell("stipple plot s.csv --labels 'Quasi,Pseudo' -o p.svg"));
    EXPECT_THAT(xml(box, "p.svg", "text"), HasSubstr("Pseudo (slope"));
}

// One frame for each set, with its own points; --overlay draws all in one frame.
TEST(Plot, SeveralSetsStandSideBySide) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 5 -m 4 -f json -o p.json"));
    good(box.shell("stipple plot p.json -o p.svg"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "20\n");
    for (const char* name : {"set 0", "set 1", "set 2", "set 3"})
        EXPECT_THAT(xml(box, "p.svg", "text"), HasSubstr(name));
    good(box.shell("stipple plot p.json -o p.svg --overlay"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "24\n");  // 4 of them in the legend
    good(box.shell("stipple generate random -n 5 -m 13 -f json -o many.json"));
    const Outcome outcome = box.run({"plot", "many.json", "-o", "p.svg"});
    EXPECT_THAT(outcome.err, HasSubstr("the first 12 of 13 sets"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "60\n");
    const std::string text = good(box.shell("stipple plot p.json -f text --width 100 --height 20"));
    EXPECT_THAT(text, HasSubstr("set 2"));
    const auto first = text.substr(0, text.find('\n'));
    EXPECT_THAT(first, ::testing::AllOf(HasSubstr("set 0"), HasSubstr("set 1")));
}

// Points, reports of two analyzers and a study in one figure, with letters in their order; a chart
// of two panels has two.
TEST(Plot, FramesOfAllKindsHaveLetters) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 64 -o p.csv"));
    good(box.shell("stipple analyze pair-correlation,periodogram p.csv -o r.json"));
    good(
        box.shell("stipple study --generators 'random;halton' -n 16..64*2 --seeds 2 --analyze "
                  "star-discrepancy --keys value --quiet -o s.csv"));
    good(box.shell("stipple plot s.csv r.json p.csv --letters -o p.svg"));
    const std::string text = xml(box, "p.svg", "text");
    std::size_t last = 0;
    for (const char* label : {"|(b) Pair correlation", "|(c)|", "|(d)|", "|(e) Star discrepancy"}) {
        EXPECT_GT(text.find(label), last) << label << text;
        last = text.find(label);
    }
    EXPECT_TRUE(text.starts_with("(a) p.csv|")) << text;
    EXPECT_EQ(xml(box, "p.svg", "circle"), "70\n");  // of the points, and of the study
    EXPECT_THAT(good(box.shell("stipple plot s.csv p.csv --letters -f text")),
                ::testing::AllOf(HasSubstr("(a) p.csv"), HasSubstr("(b) Star discrepancy")));
    good(box.shell("stipple plot p.csv --letters -o p.svg"));
    EXPECT_THAT(xml(box, "p.svg", "text"), Not(HasSubstr("(a)")));  // nothing to distinguish
}

TEST(Plot, DrawsPairsOfProjections) {
    const Sandbox box;
    good(box.shell("stipple analyze t-value --generate sobol -d 5 -n 64 -o t.json"));
    good(box.shell("stipple plot t.json -o t.svg"));
    EXPECT_THAT(xml(box, "t.svg", "text"),
                HasSubstr("Quality parameter t of pairs of coordinates|n = 64, d = 5"));
    EXPECT_EQ(xml(box, "t.svg", "image"), "2\n");
    good(
        box.shell("stipple analyze star-discrepancy --generate halton --generate sobol -d 4 -n 64 "
                  "--projections 2 | stipple plot --labels A,B -o s.svg"));
    EXPECT_THAT(xml(box, "s.svg", "text"), ::testing::AllOf(HasSubstr("A|"), HasSubstr("B|")));
    EXPECT_EQ(xml(box, "s.svg", "image"), "3\n");  // one bar for both
    EXPECT_THAT(good(box.shell("stipple plot t.json -f text")), HasSubstr("  2 │"));
}

// The number of rows depends on the size; a size that is too small is an error.
TEST(Plot, SheetsFillTheSizeThatIsAskedFor) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 5 -m 4 -f json -o p.json"));
    // Counts the columns and rows of the four titles.
    const auto places = [&](const std::string& size) {
        good(box.shell("stipple plot p.json -o p.svg " + size));
        const std::string svg = box.read("p.svg");
        std::set<std::string> left, top;
        const std::regex title("<text x=\"([0-9.]+)\" y=\"([0-9.]+)\"[^>]*>random \\(set");
        for (std::sregex_iterator it(svg.begin(), svg.end(), title), end; it != end; ++it) {
            left.insert((*it)[1]);
            top.insert((*it)[2]);
        }
        return std::pair(left.size(), top.size());
    };
    using Grid = std::pair<std::size_t, std::size_t>;
    EXPECT_EQ(places(""), (Grid{2, 2}));
    EXPECT_EQ(places("--width 1600 --height 400"), (Grid{4, 1}));
    EXPECT_EQ(places("--width 400 --height 1600"), (Grid{1, 4}));
    EXPECT_EQ(places("--height 500"), (Grid{2, 2}));
    // Sizes that are too small are refused, naming larger ones that do.
    for (const auto& [size, names] :
         {std::pair{"--width 200 --height 100", "--width $1 --height $2"},
          {"--height 95", "--height $1"},
          {"--width 130", "--width $1"}})
        for (const std::string chart : {"points", "spectrum"}) {
            const std::string plot = "stipple plot p.json -o p.svg --chart " + chart;
            if (chart == "spectrum" && size == std::string("--width 130")) {
                good(box.shell(plot + " " + size));  // has fewer texts
                continue;
            }
            const Outcome outcome = box.shell(plot + " " + size);
            expect_refusal(outcome, 2, " no room for the picture; at least ");
            const std::regex named(".*at least ([0-9]+)(?: and ([0-9]+))? do.*");
            good(box.shell(plot + " " + std::regex_replace(outcome.err, named, names)));
        }
    good(box.shell("stipple plot p.json --set 0 -o p.png --width 300 --height 900"));
    EXPECT_EQ(good(box.shell("python3 -c 'import struct; print(struct.unpack(\">II\", "
                             "open(\"p.png\", \"rb\").read()[16:24]))'")),
              "(300, 900)\n");
}

// Pictures of means have no subtitle, so names include the options.
TEST(Plot, MeansAreNamedWithTheirOptions) {
    const Sandbox box;
    const std::string make = "--generate sobol --generate sobol:scramble=owen -n 64 -m 2 --quiet ";
    for (const char* chart : {"spectrum", "radial"}) {
        good(box.shell("stipple plot " + make + "-o s.svg --chart " + chart));
        EXPECT_THAT(xml(box, "s.svg", "text"), HasSubstr("sobol:scramble=owen")) << chart;
    }
    good(box.shell("stipple plot " + make + "-o p.svg"));  // one of plain, two of scrambled points
    EXPECT_EQ(xml(box, "p.svg", "circle"), "192\n");
    good(box.shell("printf '1,60000\\n2,90000\\n' | stipple plot --rescale -o r.svg"));
    EXPECT_THAT(xml(box, "r.svg", "text"), Not(HasSubstr("60000")));
}

TEST(Plot, DrawsPairsOfThreeCoordinates) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 5 -d 3 -o p.csv"));
    good(box.shell("stipple plot p.csv -o p.svg"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "5\n");
    good(box.shell("stipple plot p.csv --chart pairs -o p.svg"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "15\n");
    EXPECT_THAT(good(box.shell("stipple plot p.csv --chart pairs -f text --width 60")),
                Not(HasSubstr("to the right")));
    expect_refusal(box.shell("stipple plot p.csv --column 1 --chart pairs -o p.svg"), 3,
                   "have no pairs");
}

// Columns with different units have separate x axes, with their names.
TEST(Plot, HistogramsOfUnlikeColumnsHaveTheirOwnAxes) {
    const Sandbox box;
    box.write("g.csv", "age,income\n23,1500\n35,2400\n45,3100\n52,4200\n");
    good(box.shell("stipple plot g.csv --chart histogram -o g.svg"));
    const std::string own = xml(box, "g.svg", "text");
    for (const char* text : {"age", "income", "30", "3000"}) EXPECT_THAT(own, HasSubstr(text));
    EXPECT_THAT(own, Not(HasSubstr("coordinate")));
    good(box.shell("stipple plot --generate random -n 9 --chart histogram -o h.svg"));
    EXPECT_THAT(xml(box, "h.svg", "text"), HasSubstr("coordinate"));
    // Points without a domain have Euclidean distances, and no expected distribution.
    good(box.shell("stipple plot g.csv --chart distances -o d.svg"));
    EXPECT_THAT(xml(box, "d.svg", "text"), Not(HasSubstr("torus")));
    EXPECT_THAT(xml(box, "d.svg", "text"), Not(HasSubstr("independent")));
    for (const auto& [bounds, drawn] : {std::pair{"0..1,0..1", true}, {"0..1,0..9000", false}}) {
        good(box.shell(std::string("stipple generate random -n 99 -f json --bounds ") + bounds +
                       " | stipple plot --chart distances -o d.svg"));
        EXPECT_EQ(xml(box, "d.svg", "text").find("independent") != std::string::npos, drawn);
    }
}

TEST(Plot, SeveralSpectraStandSideBySide) {
    const Sandbox box;
    const std::string plot =
        "stipple plot --generate random --generate halton -n 64 --chart spectrum ";
    good(box.shell(plot + "-o s.svg"));
    EXPECT_THAT(xml(box, "s.svg", "text"), HasSubstr("halton"));
    EXPECT_EQ(xml(box, "s.svg", "image"), "3\n");  // including the bar of shades
    const std::string text = good(box.shell(plot + "-f text --width 80 --height 30"));
    EXPECT_THAT(text.substr(0, text.find('\n')), HasSubstr("halton"));
}

TEST(Plot, LettersHaveALegendAllPanelsAndPairs) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 50 -o a.csv && stipple generate halton -n 90 -o b.csv "
        "&& stipple generate random -n 50 -d 5 -o c.csv"));
    const std::string curves =
        good(box.shell("stipple analyze periodogram a.csv b.csv | stipple plot -f text"));
    EXPECT_THAT(curves, HasSubstr("a a.csv   b b.csv\n"));
    EXPECT_THAT(curves, HasSubstr("radial power"));
    EXPECT_THAT(curves, HasSubstr("anisotropy (dB)"));
    EXPECT_THAT(curves, ::testing::ContainsRegex("│ b"));
    EXPECT_THAT(curves, Not(HasSubstr("\x1b")));  // colours are for terminals only
    const std::string pairs = good(box.shell("stipple plot c.csv -f text --width 100 --height 20"));
    for (const char* name : {"x1", "x2", "x3", "x4", "x5"}) EXPECT_THAT(pairs, HasSubstr(name));
    EXPECT_THAT(good(box.shell("stipple plot c.csv -f text --width 60 --height 20")),
                HasSubstr("the first 3 of 5 coordinates\n"));
}

TEST(Plot, MoreSetsThanColoursAreCutWithAWord) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 5 -m 9 -f json -o p.json"));
    const Outcome outcome = box.run({"plot", "p.json", "-o", "p.svg", "--overlay"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("the first 7 of 9 sets"));
    EXPECT_EQ(xml(box, "p.svg", "circle"), "42\n");  // 35 points and 7 in the legend
    good(box.run({"plot", "p.json", "--set", "8", "-o", "q.svg"}));
    EXPECT_EQ(xml(box, "q.svg", "circle"), "5\n");
}

TEST(Plot, DrawsTheRimOfADomain) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 20 -w disk -f json | stipple plot -o a.svg"));
    good(box.shell("stipple generate random -n 20 -w disk | stipple plot --domain disk -o b.svg"));
    good(box.shell("stipple generate random -n 20 | stipple plot -o c.svg"));
    EXPECT_EQ(xml(box, "a.svg", "path"), xml(box, "b.svg", "path"));
    EXPECT_NE(xml(box, "a.svg", "path"), xml(box, "c.svg", "path"));
}

// What the generator decided, such as the radius for a count, differs from frame to frame.
TEST(Plot, TitlesHaveOnlyTheOptionsThatTheUserTyped) {
    const Sandbox box;
    good(box.shell("stipple generate poisson-disk --count 64 --order=progressive --meta -o p.csv"));
    for (const std::string from : {"p.csv", "--generate poisson-disk:order=progressive -n 64"}) {
        good(box.shell("stipple plot -o a.svg " + from));
        const std::string texts = xml(box, "a.svg", "text");
        EXPECT_THAT(texts, HasSubstr("64 points, seed 1, order=progressive|"));
        EXPECT_THAT(texts, Not(HasSubstr("radius="))) << from;
    }
    good(box.shell("stipple plot -o a.svg --generate poisson-disk:radius=0.1"));
    EXPECT_THAT(xml(box, "a.svg", "text"), HasSubstr(", seed 1, radius=0.1|"));
}

// What newcomers meet first: points that are not in the unit cube, or have one coordinate too many.
TEST(Plot, AndAnalyzeSayHowToGoOn) {
    const Sandbox box;
    good(box.shell("stipple generate random -w disk -o disk.csv"));
    EXPECT_THAT(
        box.shell("stipple analyze chi-square disk.csv").err,
        HasSubstr(
            "; --domain names the domain of the points, or --meta on the command that wrote them"));
    EXPECT_THAT(box.shell("stipple analyze star-discrepancy disk.csv").err,
                HasSubstr("; the measure is defined for the unit cube; --rescale or --bounds"));
    EXPECT_THAT(box.shell("stipple plot --generate random -d 3 -w sphere").err,
                HasSubstr("; name the coordinates: sphere@1,2, or make points with -d 2"));
}

TEST(Plot, WithoutATitleNoFrameHasOne) {
    const Sandbox box;
    const std::string two = "--generate random --generate halton -n 64 --title '' ";
    for (const std::string chart : {"points", "spectrum", "local-discrepancy"}) {
        good(box.shell("stipple plot -o a.svg " + two + "--chart " + chart));
        EXPECT_THAT(xml(box, "a.svg", "text"), Not(HasSubstr("64 points"))) << chart;
        EXPECT_THAT(xml(box, "a.svg", "text"), Not(HasSubstr("halton"))) << chart;
    }
    EXPECT_THAT(good(box.shell("stipple plot -f text " + two)), Not(HasSubstr("halton")));
}

TEST(Plot, AMeanSpectrumSaysOfHowManySets) {
    const Sandbox box;
    good(
        box.shell("stipple plot --generate sobol:scramble=owen -n 64 -m 8 --chart spectrum "
                  "-o a.svg"));
    const std::string texts = xml(box, "a.svg", "text");
    EXPECT_THAT(texts, HasSubstr("of sobol:scramble=owen|64 points, mean of 8 sets|"));
    EXPECT_THAT(texts, Not(HasSubstr("seed 1")));
}

}  // namespace stipple::testing::plot_test
