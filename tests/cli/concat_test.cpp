// SPDX-License-Identifier: MIT
//
// Joins shards, and many files, to one set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::concat_test {

using ::testing::HasSubstr;

// Sequences and sets, text and binary, shards of different size and of one point.
TEST(Concat, OfShardsIsTheWholeByteForByte) {
    const Sandbox box;
    for (const char* what :
         {"sobol --scramble owen -n 1000", "random -n 1000 -w disk:method=rejection", "halton -n 7",
          "poisson-disk -n 200", "random --rng mt19937-64 -n 5000 --start 9",
          "jittered -n 100 --bounds 0..4,0..3"}) {
        const std::string make = std::string("stipple generate ") + what + " --quiet ";
        good(box.shell("rm -f *; " + make + "-o whole.csv; " + make + "-o whole.json; " + make +
                       "-f bin -o whole.bin; for i in 0 1 2 3 4 5 6; do " + make +
                       "--shard $i/7 -o $i.csv; " + make + "--shard $i/7 -o $i.json; " + make +
                       "--shard $i/7 -f bin; done > cat.bin"));
        good(box.shell(
            "cmp cat.bin whole.bin && stipple convert --concat ?.csv -o c.csv && cmp c.csv "
            "whole.csv"));
        good(box.shell(
            "(head -n 1 0.csv; for i in 0 1 2 3 4 5 6; do tail -n +2 $i.csv; done) | cmp - "
            "whole.csv"));
        good(box.shell("stipple convert --concat ?.json -o c.json && cmp c.json whole.json"));
        EXPECT_THAT(good(box.run({"reproduce", "c.json"})), HasSubstr("identical")) << what;
    }
}

TEST(Concat, IsOneSetForAnalyzersThatStreamAndThatDoNot) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 3000 -o whole.csv; for i in 0 1 2; do stipple "
                  "generate random -n 3000 --shard $i/3 -o $i.csv; done"));
    for (const char* analyzer : {"moments", "chi-square", "star-discrepancy", "nearest-neighbor"}) {
        const std::string line = std::string("stipple analyze ") + analyzer;
        auto one = nlohmann::json::parse(good(box.shell(line + " whole.csv")));
        auto many = nlohmann::json::parse(good(box.shell(line + " --concat 0.csv 1.csv 2.csv")));
        EXPECT_EQ(many["results"], one["results"]) << analyzer;
        EXPECT_EQ(many["input"]["count"], 3000);
        EXPECT_EQ(many["input"]["source"], "0.csv, 1.csv, 2.csv");
    }
    EXPECT_EQ(
        good(box.shell("cat 0.csv | stipple convert --concat - 1.csv 2.csv | cmp - whole.csv")),
        "");
}

TEST(Concat, KnowsOnlyWhatIsTrueOfAll) {
    const Sandbox box;
    good(box.shell(
        "stipple generate random -n 30 -w disk -o other.json; for i in 0 1 2; do stipple generate "
        "random -n 30 --shard $i/3 -w disk -o $i.json; done"));
    good(
        box.shell("stipple -q convert --concat 0.json 1.json -o part.json && stipple convert "
                  "--concat 2.json other.json 0.json -o mixed.json"));
    for (const char* file : {"part.json", "mixed.json"}) {
        const auto meta = nlohmann::json::parse(box.read(file))["meta"];
        EXPECT_EQ(meta["generator"], "") << file;
        EXPECT_EQ(meta["domain"], "disk") << file;
    }
    EXPECT_EQ(box.run({"reproduce", "part.json"}).code, 3);
}

// Shards of one set are joined in order. The first ones are a set of their own.
TEST(Concat, SaysWhichShardIsNotInItsPlace) {
    const Sandbox box;
    good(
        box.shell("for i in 0 1 2; do stipple generate halton -n 30 --shard $i/3 -o $i.json; done; "
                  "stipple generate halton -n 30 -o whole.json; cp 0.json again.json"));
    const auto told = [&](const std::string& files, int code) {
        const Outcome outcome = box.shell("stipple convert -f csv --concat " + files);
        EXPECT_EQ(outcome.code, code) << files;
        return outcome.err;
    };
    EXPECT_EQ(told("1.json 0.json", 3),
              "stipple: 1.json: it is shard 1/3 of its set; expected shard 0/3 in this place\n");
    EXPECT_EQ(told("0.json 2.json", 3),
              "stipple: 2.json: it is shard 2/3 of its set; expected shard 1/3 in this place\n");
    EXPECT_EQ(
        told("0.json again.json", 3),
        "stipple: again.json: it is shard 0/3 of its set; expected shard 1/3 in this place\n");
    EXPECT_EQ(
        told("0.json 1.json 2.json again.json", 3),
        "stipple: again.json: it is shard 0/3 of its set; expected no more files, since all 3 "
        "shards are there\n");
    EXPECT_EQ(
        told("0.json 1.json", 0),
        "stipple: note: 1.json: it is the last file, but shard 1/3; the others of its set are "
        "missing\n");
    EXPECT_EQ(told("0.json 1.json 2.json", 0) + told("2.json whole.json 0.json", 0), "");
}

TEST(Concat, RefusesWhatIsNotOneSet) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 3 -o a.json; stipple generate random -d 3 -n 3 -o "
                  "b.json; stipple generate random -n 3 -w disk -o c.json; stipple generate random "
                  "-n 3 -m 2 -o d.json; echo 0.5,x > e.csv"));
    const auto refusal = [&](const std::string& files) {
        const Outcome outcome = box.shell("stipple convert --concat " + files + " -o out.csv");
        EXPECT_EQ(outcome.code, 3);
        EXPECT_FALSE(box.exists("out.csv"));
        return outcome.err;
    };
    EXPECT_THAT(refusal("a.json b.json"),
                HasSubstr("b.json: its points have 3 coordinates; those before have 2"));
    EXPECT_THAT(refusal("a.json c.json"),
                HasSubstr("c.json: its points are on disk; those before are on unit-cube"));
    EXPECT_THAT(refusal("d.json a.json"), HasSubstr("d.json: it holds several sets"));
    EXPECT_THAT(refusal("a.json d.json"), HasSubstr("d.json: it holds several sets"));
    EXPECT_THAT(refusal("a.json e.csv"), HasSubstr("e.csv:"));
    EXPECT_THAT(box.shell("stipple analyze moments --concat a.json e.csv").err,
                HasSubstr("stipple: e.csv:"));
    EXPECT_EQ(box.shell("stipple convert --concat - - < a.json").code, 2);
    EXPECT_THAT(box.run({"convert", "a.json", "b.json"}).err, HasSubstr("--concat"));
}

// One order of names: for verbs that write and those that measure.
TEST(Concat, RefusesOtherNames) {
    const Sandbox box;
    good(box.shell(
        "printf 'x,m\\n0.1,steel\\n0.2,brass\\n' > a.csv; printf 'x,m\\n0.3,oak\\n0.4,steel\\n' "
        "> b.csv; printf 'x,m\\n0.5,brass\\n0.6,steel\\n' > c.csv; printf 'x,m\\n0.5,1\\n' > "
        "n.csv; printf 'x,y\\n0.1,0.2\\n' > xy.csv; printf 'y,x\\n0.3,0.4\\n' > yx.csv; echo "
        "0.5,0.6 > plain.csv; printf 'x,y,pdf\\n1,1,1\\n' > pdf.csv; printf "
        "'x,y,weight\\n1,1,1\\n' > weight.csv"));
    for (const char* verb : {"convert", "analyze moments"}) {
        const auto refusal = [&](const std::string& files) {
            const Outcome outcome =
                box.shell(std::string("stipple -q ") + verb + " --concat " + files);
            EXPECT_EQ(outcome.code, 3) << files;
            EXPECT_EQ(outcome.out, "");
            return outcome.err;
        };
        EXPECT_THAT(refusal("n.csv c.csv"),
                    HasSubstr("has the words 'brass, steel'; that of n.csv has no words"));
        EXPECT_THAT(refusal("xy.csv yx.csv"),
                    HasSubstr("yx.csv: its column 1 is y; that of xy.csv is x"));
        EXPECT_THAT(refusal("xy.csv c.csv"),
                    HasSubstr("c.csv: its column 2 is m; that of xy.csv is y"));
    }
    EXPECT_EQ(box.shell("stipple convert --concat pdf.csv weight.csv").code, 3);
    const auto rows = [&](const std::string& files) {
        return good(box.shell("stipple -q convert --no-header --concat " + files));
    };
    EXPECT_EQ(rows("a.csv c.csv"), "0.1,steel\n0.2,brass\n0.5,brass\n0.6,steel\n");
    EXPECT_EQ(rows("xy.csv plain.csv"), "0.1,0.2\n0.5,0.6\n");
    EXPECT_EQ(rows("plain.csv yx.csv"), "0.5,0.6\n0.3,0.4\n");
    EXPECT_EQ(rows("--column x,y xy.csv yx.csv"), "0.1,0.2\n0.4,0.3\n");
    box.write("p.json", R"({"parameters": [{"name": "x", "range": [0, 1]},
        {"name": "m", "levels": ["steel", "brass", "oak"]}]})");
    EXPECT_EQ(rows("--parameters p.json a.csv b.csv"),
              "0.1,steel\n0.2,brass\n0.3,oak\n0.4,steel\n");
}

// Words of later files get numbers after those of the first, in files that are streamed, too.
TEST(Concat, NumbersTheWordsOfAllFilesTogether) {
    const Sandbox box;
    good(
        box.shell("printf 'm,x,k\\nsteel,0.1,a\\nbrass,0.2,b\\n' > a.csv; "
                  "printf 'm,x,k\\noak,0.3,c\\nsteel,0.4,a\\n' > b.csv; "
                  "printf 'm,x,k\\nash,0.5,b\\nbrass,0.6,c\\n' > c.csv; "
                  "stipple -q convert --concat a.csv b.csv c.csv -o all.json"));
    const auto all = nlohmann::json::parse(box.read("all.json"));
    EXPECT_EQ(all["meta"]["levels"],
              nlohmann::json::parse(R"({"m":["brass","steel","oak","ash"],"k":["a","b","c"]})"));
    EXPECT_EQ(all["points"], nlohmann::json::parse(
                                 "[[1,0.1,0],[0,0.2,1],[2,0.3,2],[1,0.4,0],[3,0.5,1],[0,0.6,2]]"));
    const Outcome noted = box.shell("stipple convert --concat a.csv b.csv -f csv");
    EXPECT_EQ(noted.out, "m,x,k\nsteel,0.1,a\nbrass,0.2,b\noak,0.3,c\nsteel,0.4,a\n");
    EXPECT_THAT(noted.err, HasSubstr("b.csv: the words of 'm' are numbered with those of the files "
                                     "before: '2 oak, 1 steel'"));
    const auto means = nlohmann::json::parse(good(
        box.shell("stipple -q analyze moments --bounds 0..3,0..1,0..2 --concat a.csv b.csv c.csv")))
        ["results"]["mean"];
    EXPECT_EQ(means[0], 7. / 6);
    EXPECT_EQ(means[2], 1.);
}

// The provenance of binary files is beside them. One of other points is left alone.
TEST(Concat, TakesTheProvenanceBesideBinaryFiles) {
    const Sandbox box;
    for (const char* format : {"npy", "utk"}) {
        const std::string end = std::string(".") + format;
        good(box.shell("for i in 0 1; do stipple generate halton -n 20 --shard $i/2 --meta -o $i" +
                       end + "; done; stipple generate halton -n 20 --meta -o all" + end));
        good(box.shell("stipple convert all" + end + " -o all.json; stipple convert --concat 0" +
                       end + " 1" + end + " -o c.json"));
        for (const char* file : {"all.json", "c.json"})
            EXPECT_THAT(good(box.run({"reproduce", file})), HasSubstr("identical")) << format;
        good(box.shell("cp 0" + end + " all" + end + "; stipple -q convert all" + end +
                       " -o o.json"));
        EXPECT_EQ(nlohmann::json::parse(box.read("o.json"))["meta"]["generator"], "") << format;
    }
}

TEST(Concat, RefusesDensitiesBesideCoordinates) {
    const Sandbox box;
    box.write("p.csv", "x,y,pdf\n0.1,0.2,1\n");
    box.write("q.txt", "0.3 0.4 0.9\n");
    EXPECT_EQ(box.run({"convert", "p.csv", "q.txt", "--concat"}).err,
              "stipple: q.txt: its last column is a coordinate; that of p.csv is a pdf; --column "
              "picks the coordinates\n");
    EXPECT_EQ(box.run({"convert", "q.txt", "p.csv", "--concat"}).code, 3);
}

}  // namespace stipple::testing::concat_test
