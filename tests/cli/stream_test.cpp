// SPDX-License-Identifier: MIT
//
// Pipes of more points than fit in memory: same results as from files, in little memory.
#include <gtest/gtest.h>

#include "support/program.hpp"

namespace stipple::testing::stream_test {

TEST(Stream, AnalyzerInAPipeFindsWhatItFindsInMemory) {
    const Sandbox box;
    const std::string kept = "| sed 's/\"seconds\".*//; s/\"source\":[^,]*,//'";
    const auto found = [&](const std::string& line) { return good(box.shell(line + kept)); };
    for (const char* analyzer : {"chi-square --shifted", "moments", "serial"}) {
        const std::string verb = std::string("stipple analyze ") + analyzer;
        const auto whole = found("stipple generate random -n 400000 | " + verb);
        EXPECT_EQ(found("stipple generate random -n 400000 -f bin | " + verb + " -d 2 --from bin"),
                  whole);
        EXPECT_EQ(found("stipple generate random -n 400000 -f npy | " + verb + " --threads 1"),
                  whole);
        EXPECT_EQ(found("stipple generate random -n 400000 -f json | " + verb), whole)
            << "read as a whole";
    }
}

TEST(Stream, WarpInAPipeIsTheWarpInGenerate) {
    const Sandbox box;
    for (const char* format : {"bin", "csv", "txt"}) {
        const std::string f = std::string(" -f ") + format;
        const auto direct =
            good(box.shell("stipple generate random -n 300000 -w disk" + f + " | cksum"));
        EXPECT_EQ(good(box.shell("stipple generate random -n 300000 -f bin | "
                                 "stipple warp disk -d 2 --from bin" +
                                 f + " | cksum")),
                  direct);
        EXPECT_EQ(good(box.shell("stipple generate random -n 300000 | stipple warp disk" + f +
                                 " | cksum")),
                  direct);
        EXPECT_EQ(good(box.shell("stipple generate random -n 300000 -f npy | "
                                 "stipple warp disk --threads 1" +
                                 f + " | cksum")),
                  direct);
    }
    EXPECT_EQ(good(box.shell("stipple generate random -n 300000 -f bin | stipple warp disk -d 2 "
                             "--from bin -f bin | stipple warp disk --inverse -d 2 --from bin -f "
                             "txt --precision 9 | cksum")),
              good(box.shell("stipple generate random -n 300000 -w disk | stipple warp disk "
                             "--inverse -f npy | stipple convert -f txt --precision 9 | cksum")));
}

TEST(Stream, WarpKeepsSetsApart) {
    const Sandbox box;
    for (const char* format : {"csv", "txt", "npy"}) {
        const std::string f = std::string(" -f ") + format;
        EXPECT_EQ(good(box.shell("stipple generate random -n 150000 -m 2" + f +
                                 " | stipple warp disk -f csv | cksum")),
                  good(box.shell("stipple generate random -n 150000 -m 2 -w disk -f csv | cksum")))
            << format;
    }
}

TEST(Stream, WarpTellsWhatItDropped) {
    const Sandbox box;
    const auto out = box.shell(
        "stipple generate random -n 300000 -f bin | stipple warp disk "
        "--method rejection -d 2 --from bin -f bin | wc -c");
    EXPECT_EQ(out.code, 0);
    EXPECT_NE(out.err.find("of 300000 points (efficiency 0.78"), std::string::npos) << out.err;
}

TEST(Stream, ABadPointLeavesNoFile) {
    const Sandbox box;
    const auto out = box.shell(
        "(stipple generate random -n 300000; echo 1,2) | "
        "stipple warp disk -o out.csv");
    EXPECT_EQ(out.code, 3);
    EXPECT_EQ(out.err, "stipple: point 300000 is outside the unit cube [0, 1]^2: (1, 2)\n");
    EXPECT_FALSE(box.exists("out.csv"));
    const auto named = box.shell(
        "(stipple generate random -n 300000; echo 1,2) | "
        "stipple analyze chi-square");
    EXPECT_EQ(named.code, 3);
    EXPECT_NE(named.err.find("stipple: stdin: 1 of 300001 points are outside the domain unit-cube; "
                             "the first is point 300000: (1, 2)"),
              std::string::npos)
        << named.err;
}

// 8 million points would take 128 MB.
TEST(Stream, MemoryDoesNotGrowWithThePoints) {
    const Sandbox box;
    for (const char* verb : {"analyze chi-square", "analyze moments", "warp disk -f bin"})
        EXPECT_EQ(box.shell(std::string("stipple generate random -n 8000000 -f bin | stipple ") +
                            verb + " -d 2 --from bin --max-memory 64M > /dev/null")
                      .code,
                  0)
            << verb;
}

TEST(Stream, SeveralSetsBecomeOneVerdict) {
    const Sandbox box;
    for (const char* how : {"sum", "sidak", "fisher"}) {
        const auto out =
            box.run({"analyze", "chi-square", "--average", "--combine", how, "--from", "txt"},
                    good(box.run({"generate", "random", "-m", "8", "-f", "txt"})));
        EXPECT_NE(good(out).find("\"verdict\": \"uniform\""), std::string::npos) << how;
    }
}

}  // namespace stipple::testing::stream_test
