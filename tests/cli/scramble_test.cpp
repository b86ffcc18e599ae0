// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.hpp"

namespace stipple::testing::scramble_test {

using ::testing::HasSubstr;

TEST(Scramble, OnTheWayOutOrFromAFileIsTheSame) {
    const Sandbox box;
    good(
        box.shell("stipple generate halton -n 3000 -s 5 -w owen:base=[2,3] -o a.csv &&"
                  "stipple generate halton -n 3000 | stipple warp owen --base 2,3 -s 5 -o b.csv "
                  "&& cmp a.csv b.csv"));
}

// Digits are scrambled in the base of each generator, both in generate and for a file with
// provenance.
// Micro-jitter depends on the number of points, which these generators do not know in advance.
TEST(Scramble, TakesTheCountOfPointsThatWereMade) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "64", "-o", "p.csv"}));
    for (const std::string made :
         {"poisson-disk --radius 0.2", "lloyd --from p.csv --iterations 0",
          "subset --from p.csv --effort 0.01", "sample-elimination --from p.csv"}) {
        const std::string command = "stipple generate " + made;
        EXPECT_EQ(good(box.shell(command + " -w micro-jitter")),
                  good(box.shell(command + " | stipple warp micro-jitter")))
            << made;
    }
}

TEST(Scramble, TakesTheBasesOfTheGenerator) {
    const Sandbox box;
    for (const auto& [generator, bases] : {std::pair{"faure -d 5", "5"},
                                           {"halton -d 3", "2,3,5"},
                                           {"niederreiter --base 3", "3"},
                                           {"hammersley -d 3", "5,2,3"},
                                           {"van-der-corput --base 7", "7"},
                                           {"sobol -d 3", "2"}})
        for (const char* scramble : {"owen", "digital-shift", "matrix"}) {
            const std::string make = fmt::format("stipple generate {} -n 125 -s 3", generator);
            good(box.shell(fmt::format(
                "({0} -w {1}:base=[{2}] -o a.csv && {0} -w {1} -o b.csv && cmp a.csv b.csv && "
                "{0} --meta | stipple warp {1} -s 3 -o c.csv && cmp a.csv c.csv) 2>/dev/null",
                make, scramble, bases)));
        }
}

TEST(Scramble, ReplicationsAreIndependentAndHaveTheirSeeds) {
    const Sandbox box;
    good(box.run({"generate", "halton", "-n", "50", "-o", "h.csv"}));
    good(box.run({"warp", "digital-shift", "h.csv", "-m", "3", "-s", "7", "-o", "all.csv"}));
    good(box.run({"warp", "digital-shift", "h.csv", "-m", "3", "-s", "7", "-o", "r{set}.csv"}));
    good(box.run({"warp", "digital-shift", "h.csv", "-s", "8", "-o", "one.csv", "--meta"}));
    EXPECT_THAT(box.read("one.csv"), HasSubstr("# warps: [\"digital-shift:seed=8\"]"));
    good(
        box.shell("stipple convert r1.csv -o - | tail -n +2 > r1 &&"
                  "stipple convert one.csv -o - | tail -n +2 > one && cmp r1 one &&"
                  "! cmp -s r0.csv r1.csv &&"
                  "grep '^1,' all.csv | cut -d, -f2- | cmp - r1"));
}

TEST(Scramble, SetsOfAGeneratorThatUsesNoSeedDifferByTheirScramble) {
    const Sandbox box;
    const Outcome both = box.run({"generate", "halton", "-n", "4", "-m", "2", "-w", "rotation"});
    good(both);
    EXPECT_EQ(both.err, "");
    good(
        box.shell("stipple generate halton -n 4 -m 2 -w rotation -o 's{seed}.csv' &&"
                  "! cmp -s s1.csv s2.csv"));
}

TEST(Scramble, ThreadsAndShardsChangeNothing) {
    const Sandbox box;
    for (const char* name : {"owen", "micro-jitter", "matrix"})
        good(box.shell(std::string("G='stipple generate halton -n 40000 -f bin -w ") + name + "';" +
                       "eval $G --threads 1 > one; eval $G --threads 3 > three; cmp one three &&"
                       "for i in 0 1 2; do eval $G --shard $i/3; done | cmp - one"));
}

TEST(Scramble, SaysWhatItCannotDo) {
    const Sandbox box;
    const auto error = [&](std::vector<std::string> words) {
        const Outcome outcome = box.run(std::move(words), "0.5,0.5\n");
        EXPECT_EQ(outcome.code, 2);
        return outcome.err;
    };
    EXPECT_EQ(error({"warp", "owen", "--inverse"}),
              "stipple: --inverse: owen is a scramble, random and of density 1\n");
    EXPECT_EQ(error({"warp", "disk", "-s", "3"}),
              "stipple: --seed: disk is a warp, which is not random\n");
    EXPECT_EQ(error({"warp", "owne"}), "stipple: unknown warp 'owne'; did you mean 'owen'?\n");
    EXPECT_EQ(error({"warp", "owen", "--base", "1"}),
              "stipple: --base: 1 is not a whole number in [2, 65536]\n");
    EXPECT_EQ(error({"warp", "owen", "-s", "-3"}),
              "stipple: --seed: '-3' is not a whole number in [0, 2^64) or 'random'\n");
    EXPECT_EQ(box.run({"warp", "owen"}, "0.5,1.5\n").code, 3);
}

TEST(Scramble, IsAKindOfItsOwnInTheList) {
    const Sandbox box;
    const Outcome list = box.run({"list", "scrambles", "--json"});
    good(list);
    for (const char* name :
         {"cranley-patterson", "digital-shift", "matrix", "micro-jitter", "owen"})
        EXPECT_THAT(list.out, HasSubstr(std::string("\"name\": \"") + name + "\""));
    EXPECT_THAT(box.run({"warp", "--help"}).out, HasSubstr("Scrambles:"));
    EXPECT_THAT(box.run({"warp", "rotation", "--help"}).out, HasSubstr("cranley-patterson"));
}

// Digits that are scrambled twice by the same random numbers were as before.
TEST(Scramble, IsRefusedAfterItselfWithTheSameSeed) {
    const Sandbox box;
    const std::string make = "stipple generate sobol -n 4 -s 3 ";
    EXPECT_EQ(box.shell(make + "-w digital-shift -w owen -w digital-shift").err,
              "stipple: warp digital-shift: it would undo a part of the digital-shift before it, "
              "which has the same seed; give it another, such as digital-shift:seed=...\n");
    EXPECT_EQ(
        box.shell(make + "--scramble owen -w owen").err,
        "stipple: warp owen: it would undo a part of --scramble owen, which has the same seed; "
        "give it another, such as owen:seed=...\n");
    EXPECT_NE(box.shell(make + "-w matrix:seed=5 -w matrix@2:seed=5").code, 0);
    for (const char* fine : {"-w owen@1 -w owen@2", "-w owen:seed=1 -w owen", "-w owen -w matrix",
                             "--scramble owen -w owen:seed=9",
                             "-w cranley-patterson -w "
                             "cranley-patterson",
                             "--scramble owen -w matrix"})
        good(box.shell(make + fine));
}

}  // namespace stipple::testing::scramble_test
