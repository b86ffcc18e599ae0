// SPDX-License-Identifier: MIT
//
// Sobol' points by the program: compared with SciPy's, and notes to the user.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.hpp"

namespace stipple::testing::sobol_test {

using ::testing::HasSubstr;

// SciPy's numbers have 30 binary digits, enough for 2^16 points; the last set uses every dimension
// of the table.
TEST(Sobol, AgreesWithSciPyToTheLastBit) {
    const Sandbox box;
    for (const auto& [count, dimension] : {std::pair{"65536", "20"}, {"512", "3667"}}) {
        good(box.run(
            {"generate", "sobol", "--order", "gray", "-n", count, "-d", dimension, "-o", "a.npy"}));
        good(
            box.shell("/usr/bin/python3 -c 'import numpy as np; from scipy.stats import qmc;"
                      " a = np.load(\"a.npy\");"
                      " b = qmc.Sobol(a.shape[1], scramble=False).random(a.shape[0]);"
                      " assert a.shape == (" +
                      std::string(count) + ", " + dimension + ") and (a == b).all()'"));
    }
}

TEST(Sobol, TellsOnceThatACountIsNoNet) {
    const Sandbox box;
    const auto said = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments{"generate", "sobol", "-n", "1000"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = box.run(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err;
    };
    const std::string note =
        "stipple: note: 1000 points do not form a net; take a power of two: 512 or 1024\n";
    EXPECT_EQ(said({}), note);
    EXPECT_EQ(said({"--scramble", "owen", "-m", "3"}), note);
    EXPECT_EQ(said({"--scramble", "owen", "-m", "3", "-o", "a{set}.csv"}), note);
    EXPECT_EQ(said({"-w", "disk:method=rejection"}).substr(0, note.size()), note);
    EXPECT_EQ(said({"--shard", "0/2"}), note);
    EXPECT_EQ(said({"--shard", "1/2"}), "");
    EXPECT_EQ(said({"--start", "24"}), "");
    EXPECT_EQ(said({"--quiet"}), "");
}

TEST(Sobol, SetsDifferOnlyWhenScrambled) {
    const Sandbox box;
    const Outcome plain = box.run({"generate", "sobol", "-n", "4", "-m", "2"});
    EXPECT_EQ(plain.code, 0);
    EXPECT_THAT(plain.err, HasSubstr("does not use the seed: all 2 sets are the same"));
    const Outcome scrambled =
        box.run({"generate", "sobol", "-n", "4", "-m", "2", "--scramble", "matrix"});
    EXPECT_EQ(scrambled.err, "");
    EXPECT_THAT(good(box.run({"list", "generators", "--long"})),
                HasSubstr("uses the seed when scrambled"));
}

TEST(Sobol, ShardsOfScrambledPointsJoinToTheWhole) {
    const Sandbox box;
    good(box.shell(
        "for order in natural gray; do for scramble in digital-shift matrix owen; do\n"
        "s=\"stipple generate sobol --order $order --scramble $scramble -n 65536 -d 3 -f bin\"\n"
        "$s --threads 2 > whole && { for i in 0 1 2; do $s --shard $i/3; done } > parts &&\n"
        "cmp whole parts && test -s whole || exit 1\n"
        "done; done"));
}

TEST(Sobol, IsScrambledInItsMakingAsAfterIt) {
    const Sandbox box;
    good(
        box.shell("for scramble in digital-shift matrix owen; do\n"
                  "s='stipple generate sobol -n 4096 -d 5 -f bin'\n"
                  "$s --scramble $scramble > made && $s -w $scramble > warped &&\n"
                  "cmp made warped && test -s made || exit 1\n"
                  "done"));
}

TEST(Sobol, SaysWhereADirectionFileIsWrong) {
    const Sandbox box;
    box.write("bad.txt", "d s a m_i\n2 1 0 1\n3 2 1 1 4\n");
    const Outcome outcome =
        box.run({"generate", "sobol", "--directions", "bad.txt", "-o", "a.csv"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err,
              "stipple: bad.txt:3:9: '4' is out of range; expected an odd m_2 in [1, 3]\n");
    EXPECT_FALSE(box.exists("a.csv"));
}

}  // namespace stipple::testing::sobol_test
