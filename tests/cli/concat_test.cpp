// SPDX-License-Identifier: MIT
//
// Several files as one set: the shards of a set are the set.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

using namespace stipple::testing;
using nlohmann::json;
using ::testing::HasSubstr;

namespace {

/// Halton points in three shards of different formats, and the whole of them.
void make_shards(const Sandbox& box) {
    ASSERT_EQ(good(box.shell("stipple generate halton -n 1000 -o whole.csv && "
                             "stipple generate halton -n 1000 --shard 0/3 -o a.csv && "
                             "stipple generate halton -n 1000 --shard 1/3 -o b.npy && "
                             "stipple generate halton -n 1000 --shard 2/3 -o c.txt")),
              "");
}

}  // namespace

TEST(Concat, AnalyzersSeeOneSet) {
    const Sandbox box;
    make_shards(box);
    // In blocks, as a whole, and in blocks or not as the dimension says.
    for (const char* analyzer : {"moments", "star-discrepancy", "chi-square", "kolmogorov-smirnov",
                                 "nearest-neighbor", "l2-discrepancy"}) {
        const std::string verb = std::string("stipple analyze ") + analyzer;
        const auto whole = json::parse(good(box.shell(verb + " whole.csv")));
        const auto joined = json::parse(good(box.shell(verb + " --concat a.csv b.npy c.txt")));
        EXPECT_EQ(joined["results"], whole["results"]) << analyzer;
        EXPECT_EQ(joined["input"]["count"], 1000);
        EXPECT_EQ(joined["input"]["source"], "a.csv, b.npy, c.txt");
        EXPECT_FALSE(joined["input"].contains("set"));
    }
}

TEST(Concat, ConvertMakesOneFile) {
    const Sandbox box;
    make_shards(box);
    EXPECT_EQ(good(box.shell("stipple convert --concat a.csv b.npy c.txt -o joined.csv")), "");
    EXPECT_EQ(box.read("joined.csv"), box.read("whole.csv"));
    // Sets of one file are parts, too.
    EXPECT_EQ(good(box.shell("stipple generate random -m 3 -n 5 | stipple convert --concat - | "
                             "tail -n +2 | wc -l")),
              "15\n");
}

TEST(Concat, PartsMustFitTogether) {
    const Sandbox box;
    make_shards(box);
    ASSERT_EQ(good(box.shell("stipple generate halton -d 3 -o d.csv && "
                             "stipple generate halton -w disk --meta -o disk.csv")),
              "");
    Outcome outcome = box.shell("stipple analyze moments --concat a.csv d.csv");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err,
              "stipple: d.csv: --concat: its points have 3 coordinates, those of a.csv have 2\n");
    outcome = box.shell("stipple convert --concat a.csv disk.csv");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err,
              "stipple: disk.csv: --concat: its points are on disk, those of a.csv on unit-cube\n");
    EXPECT_EQ(outcome.out, "");
    outcome = box.shell("stipple convert a.csv b.npy");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--concat makes one set of several files"));
}
