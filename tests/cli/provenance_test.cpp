// SPDX-License-Identifier: MIT
//
// Provenance in files and beside them: which points it is taken for, and what it states of them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::provenance_test {

using ::testing::HasSubstr;
using ::testing::StartsWith;

// People shorten text with head and grep, so that fewer points are no error.
TEST(Provenance, OfTextHasANoteOnMissingPoints) {
    const Sandbox box;
    for (const std::string format : {"csv", "tsv", "txt"}) {
        good(box.shell("stipple generate sobol -n 64 -w disk --meta -o p." + format +
                       "; head -n -5 p." + format + " > c." + format));
        EXPECT_EQ(box.shell("stipple analyze moments p." + format).err, "");
        const std::string note =
            ": 59 points, but its provenance states 64; it was cut off or edited\n";
        for (const std::string verb :
             {"convert -f csv", "analyze moments", "warp disk --inverse"}) {
            const Outcome outcome = box.shell("stipple " + verb + " c." + format);
            EXPECT_EQ(outcome.code, 0);
            EXPECT_EQ(outcome.err, "stipple: note: c." + format + note) << verb;
        }
        EXPECT_EQ(box.shell("cat c." + format + " | stipple analyze moments").err,
                  "stipple: note: stdin" + note);
    }
    EXPECT_EQ(box.shell("(cat p.txt; cat p.txt) | stipple analyze moments").err,
              "stipple: note: stdin: 128 points, but its provenance states 64; it was cut off or "
              "edited\n");
    EXPECT_THAT(box.run({"reproduce", "c.csv"}).out, HasSubstr("different"));
    EXPECT_EQ(box.run({"reproduce", "c.csv"}).err, "");
}

// Text that is read in parts, and the first of several sets.
TEST(Provenance, OfLargeTextHasANoteOnMissingPoints) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 300000 --meta -o p.csv; head -n 250000 p.csv > c.csv; "
        "stipple generate random -n 150000 -m 2 --meta -o m.txt; sed 20,30d m.txt > d.txt"));
    EXPECT_EQ(box.shell("stipple analyze moments p.csv m.txt").err, "");
    EXPECT_THAT(
        box.shell("stipple analyze moments c.csv").err,
        StartsWith("stipple: note: c.csv: 249988 points, but its provenance states 300000"));
    EXPECT_THAT(
        box.shell("stipple analyze moments d.txt").err,
        StartsWith("stipple: note: d.txt: 149989 points, but its provenance states 150000"));
}

// Raw numbers have no head, so that a part of them looks like a whole.
TEST(Provenance, BesideRawNumbersStatesHowManyThereAre) {
    const Sandbox box;
    good(
        box.shell("stipple generate sobol -n 64 -d 3 --meta -o p.bin; cp p.bin q.bin; "
                  "cp p.bin.meta.json q.bin.meta.json"));
    EXPECT_EQ(good(box.run({"convert", "p.bin", "-f", "csv"})),
              good(box.run({"generate", "sobol", "-n", "64", "-d", "3"})));
    for (const char* cut : {"head -c 1200 p.bin > q.bin", "cat p.bin p.bin > q.bin"}) {
        good(box.shell(cut));
        for (const char* verb : {"convert -f csv", "analyze moments", "plot -f svg", "report"}) {
            const Outcome outcome = box.shell(std::string("stipple ") + verb + " q.bin");
            EXPECT_EQ(outcome.code, 3) << verb;
            EXPECT_THAT(outcome.err,
                        HasSubstr("q.bin: its bytes are not those that q.bin.meta.json records; "
                                  "remove that file"));
        }
    }
    good(box.shell(
        "stipple generate sobol -n 65536 -d 3 --meta -o l.bin; truncate -s 1200000 l.bin"));
    EXPECT_THAT(
        box.shell("stipple analyze moments l.bin").err,
        HasSubstr("l.bin.meta.json states their number; remove it if it is of other points"));
    good(
        box.shell("stipple generate random -n 20 -m 3 --dtype f32 --meta -o m.bin; "
                  "stipple generate random -n 20 -m 3 --dtype f32 -o m.npy; "
                  "stipple generate poisson-disk --radius 0.2 -m 3 --meta -o u.bin"));
    EXPECT_EQ(good(box.run({"convert", "m.bin", "-f", "csv"})),
              good(box.run({"convert", "m.npy", "-f", "csv"})));
    EXPECT_EQ(box.run({"convert", "u.bin", "-f", "csv"}).err,
              "stipple: note: u.bin.meta.json: not used, since it does not state where its sets of "
              "different sizes end\n");
}

TEST(Provenance, BesideAFileIsTakenByAllVerbs) {
    const Sandbox box;
    const std::string make = "stipple generate sobol -n 64 --scramble owen ";
    good(box.shell(make + "-w disk -o p.json; " + make + "-o cube.csv"));
    const auto domain =
        nlohmann::json::parse(good(box.run({"analyze", "moments", "p.json"})))["input"]["domain"];
    EXPECT_EQ(domain, "disk");
    for (const std::string format : {"npy", "utk", "bin", "psa"}) {
        good(box.shell(make + "-w disk --meta -f " + format + " -o p"));  // no extension
        const auto input =
            nlohmann::json::parse(good(box.run({"analyze", "moments", "p"})))["input"];
        EXPECT_EQ(input["domain"], "disk") << format;
        EXPECT_EQ(input["count"], 64) << format;
        EXPECT_EQ(good(box.shell("stipple warp disk --inverse p")),
                  good(box.shell("stipple warp disk --inverse p.json -f csv")));
        EXPECT_EQ(box.shell("stipple warp sphere p").code, 2) << "the points are on a disk";
        EXPECT_EQ(good(box.shell("stipple plot p -f text --title ''")),
                  good(box.shell("stipple plot p.json -f text --title ''")));
        good(box.shell("stipple report p -o r.html"));
        EXPECT_THAT(box.read("r.html"), HasSubstr("sobol")) << format;
        EXPECT_THAT(good(box.run({"reproduce", "p"})), HasSubstr("identical"));
    }
}

// Densities are no coordinates, and picked columns keep their names.
TEST(Provenance, BesideAFileNamesItsColumns) {
    const Sandbox box;
    box.write("p.json", R"({"parameters": [{"name": "load", "range": [0, 1]},
        {"name": "m", "levels": ["steel", "brass"]}]})");
    good(
        box.shell("stipple generate halton -n 8 --parameters p.json --with-pdf --meta -o t.npy; "
                  "stipple generate halton -n 8 --parameters p.json --with-pdf -o t.csv"));
    EXPECT_EQ(good(box.run({"convert", "t.npy", "-f", "csv"})), box.read("t.csv"));
    EXPECT_EQ(good(box.run({"convert", "t.npy", "--column", "m", "-f", "csv"})),
              good(box.run({"convert", "-q", "t.csv", "--column", "m", "-f", "csv"})));
    EXPECT_THAT(good(box.run({"reproduce", "t.npy"})), HasSubstr("identical"));
}

TEST(Provenance, BesideAFileMayBeOfOtherPoints) {
    const Sandbox box;
    good(box.shell(
        "stipple generate sobol -n 64 -w disk --meta -o p.npy; stipple generate sobol -n "
        "32 -o p.npy; stipple generate sobol -n 32 -o q.npy; echo '{}' > q.npy.meta.json"));
    const Outcome stale = box.run({"analyze", "star-discrepancy", "p.npy"});
    EXPECT_EQ(stale.code, 0);
    EXPECT_EQ(stale.err, "stipple: note: p.npy.meta.json: not used, since it is of other points\n");
    const Outcome foreign = box.run({"analyze", "star-discrepancy", "q.npy"});
    EXPECT_EQ(foreign.code, 0);
    EXPECT_THAT(foreign.err, StartsWith("stipple: note: q.npy.meta.json: no provenance"));
    EXPECT_EQ(nlohmann::json::parse(stale.out)["results"],
              nlohmann::json::parse(foreign.out)["results"]);
    for (const std::string format : {"npy", "utk", "bin", "psa"}) {  // as many points
        const std::string from =
            format == "psa" || format == "bin" ? " --from " + format + " -d 2" : "";
        good(box.shell("stipple -q generate sobol -n 70000 -w disk --meta -f " + format +
                       " -o r; stipple generate random -n 70000 -f " + format + " -o r"));
        const Outcome replaced = box.shell("stipple analyze moments r" + from);
        EXPECT_EQ(replaced.err,
                  "stipple: note: r.meta.json: not used, since it is of other points\n");
        EXPECT_EQ(nlohmann::json::parse(replaced.out)["input"]["domain"], "unit-cube") << format;
    }
}

// Raw numbers say themselves neither their type nor their sets.
TEST(Provenance, BesideRawNumbersIsNotTakenForOthers) {
    const Sandbox box;
    good(
        box.shell("stipple generate sobol -n 64 --dtype f32 --meta -o p.bin; "
                  "stipple generate random -n 32 -o p.bin"));
    const Outcome outcome = box.run({"convert", "p.bin", "-f", "csv"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("p.bin: its bytes are not those that p.bin.meta.json "
                                       "records; remove that file, or give --dimension, if"));
    EXPECT_EQ(good(box.shell("stipple convert -q p.bin -d 2 -f csv")),
              good(box.run({"generate", "random", "-n", "32"})));
}

// Sets are taken out of files, and files are joined, by programs that know nothing of provenance.
TEST(Provenance, IsThatOfEachSet) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 4 -m 4 -s 10 --meta -o m.csv; "
                  "grep -E '^#|^set|^2' m.csv > two.csv; grep -E '^#|^set|^[13]' m.csv > gap.csv; "
                  "stipple generate random -n 4 -m 4 -s 10 -o m.jsonl; "
                  "tail -n 5 m.jsonl > last.jsonl; "
                  "stipple generate sobol -n 4 -s 7 -w disk -o s.jsonl; "
                  "cat last.jsonl s.jsonl > both.jsonl; "
                  "stipple convert gap.csv -o gap.json; stipple convert both.jsonl -o both.json"));
    EXPECT_THAT(good(box.run({"reproduce", "two.csv"})), HasSubstr("identical: 4 points"));
    EXPECT_THAT(good(box.run({"reproduce", "last.jsonl"})), HasSubstr("identical: 4 points"));
    EXPECT_THAT(good(box.run({"convert", "last.jsonl", "-f", "json"})), HasSubstr("\"seed\":13"));
    EXPECT_THAT(box.read("gap.json"), HasSubstr(R"("generator":"","options":{},"seed":null)"));
    EXPECT_THAT(box.read("both.json"), HasSubstr(R"("generator":"","options":{},"seed":null)"));
    const auto reports = nlohmann::json::parse(
        good(box.run({"analyze", "moments", "both.jsonl", "--format", "json"})));
    EXPECT_EQ(reports.at(0)["input"]["domain"], "unit-cube");
    EXPECT_EQ(reports.at(1)["input"]["domain"], "disk");
}

TEST(Provenance, OfSearchesIsWhatHoldsForAllSets) {
    const Sandbox box;
    EXPECT_THAT(good(box.run({"generate", "subset", "-n", "16", "--format", "json"})),
                HasSubstr("\"found\""));
    EXPECT_THAT(good(box.run({"generate", "subset", "-n", "16", "-m", "2", "--format", "json"})),
                ::testing::Not(HasSubstr("\"found\"")));
}

TEST(Provenance, DoesNotTellOfColumnsThatWerePicked) {
    const Sandbox box;
    good(box.run({"generate", "halton", "-n", "27", "--meta", "-o", "h.csv"}));
    good(box.run({"generate", "halton", "-n", "27", "--meta", "-o", "h.npy"}));
    good(box.run({"generate", "halton", "-n", "27", "-o", "h.json"}));
    for (const char* file : {"h.csv", "h.npy", "h.json"})
        for (const char* columns : {"y", "y,x"})
            EXPECT_THAT(good(box.run({"convert", file, "--column", columns, "-f", "json"})),
                        HasSubstr(R"("generator":"","options":{},"seed":null)"))
                << file << " " << columns;
    good(box.run({"convert", "h.csv", "--column", "x,y", "--meta", "-o", "same.csv"}));
    EXPECT_THAT(good(box.run({"reproduce", "same.csv"})), HasSubstr("identical"));
    // Numbers in base 3, of which scrambles must not be told that they are in the first's base 2.
    const Outcome scrambled = box.run({"warp", "owen", "h.csv", "--column", "y", "-f", "json"});
    EXPECT_THAT(scrambled.out, HasSubstr(R"("warps":["owen:seed=1"])"));
    EXPECT_EQ(scrambled.err,
              "stipple: note: --column picked coordinates of halton; the base of their digits is "
              "taken to be 2 unless base=B is given\n");
}

TEST(Provenance, SaysInWhichOrderNumbersWereCut) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 500 --precision 8 --meta -o p.csv; "
                  "stipple convert p.csv --dtype f32 --meta -o p.npy; "
                  "stipple convert p.npy --precision 3 --meta -o q.csv; "
                  "stipple convert q.csv --dtype f32 --meta -o q.npy"));
    for (const char* file : {"p.npy", "q.csv", "q.npy"})
        EXPECT_THAT(good(box.run({"reproduce", file})), HasSubstr("identical: 500 points"));
}

TEST(Provenance, OfRowsWithoutNamesHasTheirLength) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "9", "--with-pdf", "--meta", "-o", "p.txt"}));
    const Outcome outcome = box.run({"analyze", "moments", "p.txt"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err,
              "stipple: p.txt: the rows have 3 numbers, but the provenance above them states 2 "
              "coordinates; --column picks the coordinates by number\n");
    EXPECT_EQ(good(box.run({"convert", "p.txt", "--column", "1,2", "-f", "csv"})),
              good(box.run({"generate", "random", "-n", "9"})));
}

}  // namespace stipple::testing::provenance_test
