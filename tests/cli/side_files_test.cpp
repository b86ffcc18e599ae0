// SPDX-License-Identifier: MIT
//
// Files that a generator writes beside the points.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "media/png_picture.hpp"
#include "support/program.hpp"
#include "support/system.hpp"

namespace stipple::testing::side_files_test {

using ::testing::HasSubstr;

namespace {

using Names = std::vector<std::string>;

/// Runs void-and-cluster on 16 x 16 cells with a mask image, and more options.
Outcome dither(const Sandbox& box, const std::string& mask, const Names& more) {
    Names words = {"generate", "void-and-cluster", "--size", "16x16", "-n",
                   "40",       "--mask-image",     mask};
    words.insert(words.end(), more.begin(), more.end());
    return box.run(words);
}

}  // namespace

TEST(SideFiles, AreWrittenWithThePointsAndDoNotChangeThem) {
    const Sandbox box;
    EXPECT_EQ(good(dither(box, "m.png", {"-o", "p.json"})), "");
    EXPECT_EQ(box.files(), (Names{"m.png", "p.json"}));
    const PngPicture mask = read_png(box.read("m.png"), "m.png", {});
    EXPECT_EQ(mask.width, 16U);
    EXPECT_EQ(mask.height, 16U);
    // Every rank occurs once: the mean grey is that of (rank + 1/2) / 256.
    double sum = 0;
    for (const double grey : mask.grey) sum += grey;
    EXPECT_NEAR(sum / 256, 0.5, 1e-4);
    const Outcome plain =
        box.run({"generate", "void-and-cluster", "--size", "16x16", "-n", "40", "-f", "json"});
    EXPECT_EQ(box.read("p.json"), good(plain));
}

TEST(SideFiles, ComeWithPointsThatGoIntoAPipe) {
    const Sandbox box;
    EXPECT_THAT(good(dither(box, "m.png", {})), HasSubstr("x,y\n"));
    const std::string mask = box.read("m.png");
    EXPECT_EQ(good(dither(box, "-", {"-o", "p.csv"})), mask);
    const Outcome closed = box.shell(
        "stipple generate void-and-cluster --size 128x128 -n 16e3 --mask-image big.png | head -n "
        "1");
    EXPECT_EQ(closed.code, 0) << closed.err;
    EXPECT_EQ(read_png(box.read("big.png"), "big.png", {}).width, 128U);
}

TEST(SideFiles, OfSeveralSetsHaveNamesOfTheirOwn) {
    const Sandbox box;
    good(dither(box, "m{seed}.png", {"-m", "2", "-s", "7", "-o", "p.csv"}));
    good(dither(box, "n{set}.png", {"-m", "2", "-s", "7", "-o", "p{set}.csv"}));
    EXPECT_EQ(box.files(),
              (Names{"m7.png", "m8.png", "n0.png", "n1.png", "p.csv", "p0.csv", "p1.csv"}));
    EXPECT_EQ(box.read("m7.png"), box.read("n0.png"));
    EXPECT_EQ(box.read("m8.png"), box.read("n1.png"));
    const auto pixels = [&](const char* file) { return read_png(box.read(file), file, {}).grey; };
    EXPECT_NE(pixels("m7.png"), pixels("m8.png"));
    good(dither(box, "warped.png", {"-s", "7", "-w", "disk", "-o", "p.csv"}));
    EXPECT_EQ(pixels("warped.png"), pixels("m7.png"));
}

TEST(SideFiles, OfOneNameAreRefused) {
    const Sandbox box;
    const Outcome same = dither(box, "m.png", {"-m", "2", "-o", "p{set}.csv"});
    EXPECT_EQ(same.code, 2);
    EXPECT_EQ(same.err, "stipple: --mask-image: 2 sets need a name with {set} or {seed}\n");
    for (const char* name : {"-", "p.csv", "p{set}.csv"}) {
        const Outcome both = dither(box, name, {"-o", name, "-f", "csv"});
        EXPECT_EQ(both.code, 2) << name;
        EXPECT_EQ(both.out, "") << name;
        EXPECT_THAT(both.err, HasSubstr("is already the output for the points")) << name;
    }
    EXPECT_EQ(box.files(), Names{});
}

// Existing files remain, and no others are left.
TEST(SideFiles, AreNotLeftByACommandThatFails) {
    SKIP_WITHOUT("/dev/full");
    SKIP_WITHOUT("/proc/self/fd");
    const Sandbox box;
    box.write("m.png", "old");
    for (const char* target : {"no/p.csv", "/dev/full", "m.png/p.csv"}) {
        EXPECT_EQ(dither(box, "m.png", {"-o", target}).code, 4) << target;
        EXPECT_EQ(box.files(), Names{"m.png"}) << target;
        EXPECT_EQ(box.read("m.png"), "old") << target;
    }
    for (const char* mask : {"no/n.png", "/proc/n.png", "m.png/n.png", "/dev/full"}) {
        const Outcome outcome = dither(box, mask, {"-o", "p.csv"});
        EXPECT_EQ(outcome.code, 4) << mask;
        EXPECT_THAT(outcome.err, HasSubstr(mask));
        EXPECT_EQ(box.files(), Names{"m.png"}) << mask;
        EXPECT_EQ(dither(box, mask, {}).out, "") << mask;
    }
    // Interrupted while the points wait for a reader: both files have been started.
    const Outcome outcome = box.shell(
        "mkfifo pipe; sleep 9 < pipe & reader=$!;"
        "stipple generate void-and-cluster --size 128x128 -n 16e3 --mask-image n.png -o pipe & "
        "pid=$!; until find -L /proc/$pid/fd -type f -links 0 -print -quit | grep -q .; do sleep "
        "0.01; done; "
        "kill -INT $pid; wait $pid; kill $reader; exit 0");
    EXPECT_EQ(box.files(), (Names{"m.png", "pipe"})) << outcome.err;
}

// Side files of generate, from the points alone.
TEST(SideFiles, OfALatticeComeFromItsProvenance) {
    const Sandbox box;
    for (const std::string made :
         {"rank1-lattice -n 101 -d 3", "rank1-lattice -n 64 --rule korobov --multiplier 19",
          "rank1-lattice -n 8 --vector 1,3", "polynomial-lattice -n 64 -d 3"})
        for (const std::string form : {"lddata", "latnet-builder"}) {
            good(box.shell("stipple generate -q " + made +
                           " -o p.json --vector-output v.txt "
                           "--vector-format " +
                           form));
            good(box.shell("stipple generate -q " + made +
                           " -o q.json && stipple convert q.json -o r.json "
                           "--vector-output w.txt --vector-format " +
                           form));
            EXPECT_EQ(box.read("w.txt"), box.read("v.txt")) << made;
            EXPECT_THAT(box.read("w.txt"), HasSubstr("# dimensions")) << made;
        }
    good(box.shell("stipple generate halton -n 9 -o h.json"));
    expect_refusal(box.shell("stipple convert h.json -o r.csv --vector-output x.txt"), 3,
                   "names no lattice");
    EXPECT_FALSE(box.exists("r.csv"));
    expect_refusal(box.shell("stipple convert h.json -o r.csv --vector-format lddata"), 2,
                   "--vector-format: requires --vector-output");
}

}  // namespace stipple::testing::side_files_test
