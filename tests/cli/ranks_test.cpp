// SPDX-License-Identifier: MIT
//
// One set, analyzed by several ranks of MPI. What they find together is tested with many more of
// them, as threads, in tests/study/shared_analysis_test.cpp.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/launcher.hpp"
#include "support/program.hpp"

namespace stipple::testing::ranks_test {

using ::testing::HasSubstr;

namespace {

/// Results without what the clock says of them.
std::string timeless(const Sandbox& box, const std::string& command) {
    return good(box.shell(command + " | sed 's/ *\"seconds\":.*//'"));
}

}  // namespace

// Three files, of which two are shared in the middle, and one of them is text.
TEST(Ranks, AnalyzeOneSetAsOneProcessDoes) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    for (const char* part : {"0/3 -o a.npy", "1/3 -o b.csv", "2/3 -o c.npy"})
        good(box.shell(std::string("stipple generate random -n 600000 --shard ") + part));
    const std::string shards = " --concat a.npy b.csv c.npy -f json";
    for (const std::string& command :
         {"stipple analyze moments" + shards, "stipple analyze chi-square" + shards,
          std::string("stipple analyze star-discrepancy --generate random -d 4 -n 120 -f json"),
          std::string("stipple analyze periodogram --generate random -n 4300000 -f json "
                      "--max-frequency 8 --tolerance 1e-3")}) {
        const std::string one = timeless(box, command);
        EXPECT_THAT(one, HasSubstr("results"));
        const std::string ranks = command.find("moments") != std::string::npos ? "-n 4 " : "-n 2 ";
        EXPECT_EQ(timeless(box, mpirun + ranks + command), one) << command;
    }
}

TEST(Ranks, SpeakOnceOfWhatIsWrong) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    box.write("torn.csv", "x,y\n0.1,0.2\n0.3,oh\n");
    const Outcome torn = box.shell(mpirun + "-n 2 stipple analyze moments torn.csv");
    EXPECT_EQ(torn.code, 3);
    const auto first = torn.err.find("torn.csv:3");
    EXPECT_NE(first, std::string::npos) << torn.err;
    EXPECT_EQ(torn.err.find("torn.csv:3", first + 1), std::string::npos) << torn.err;
    const Outcome alone = box.shell(mpirun + "-n 2 stipple analyze dispersion torn.csv");
    EXPECT_EQ(alone.code, 2);
    EXPECT_THAT(alone.err, HasSubstr("ranks do not share dispersion"));
}

// The ranks agree on what is wrong with points, and rank 0 names their file as one process does.
TEST(Ranks, NameTheFileThatIsAtFault) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    box.write("outside.csv", "x,y\n0.1,0.2\n0.3,1.5\n");
    box.write("good.csv", "x,y\n0.1,0.2\n0.3,0.5\n");
    for (const std::string rest : {"moments outside.csv", "moments --concat good.csv outside.csv",
                                   "star-discrepancy outside.csv"}) {
        const std::string command = "stipple analyze " + rest;
        const Outcome one = box.shell(command);
        const Outcome two = box.shell(mpirun + "-n 2 " + command);
        EXPECT_EQ(one.code, 3);
        EXPECT_EQ(two.code, 3);
        EXPECT_THAT(one.err, HasSubstr("outside.csv: 1 of "));
        EXPECT_THAT(two.err, HasSubstr(one.err));
    }
}

TEST(Ranks, AreToldByTheVersion) {
    const Sandbox box;
    EXPECT_THAT(good(box.run({"--version"})),
                HasSubstr(has_mpi() ? ", Open MPI v" : ", without MPI\n"));
}

TEST(Ranks, NeedABuildWithMpi) {
    if (has_mpi()) GTEST_SKIP() << "this build has MPI";
    const Sandbox box;
    for (const std::string command : {"analyze moments --generate random",
                                      "study --generators random -n 16 --analyze moments"}) {
        const Outcome outcome = box.shell("OMPI_COMM_WORLD_SIZE=2 stipple " + command);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_THAT(outcome.err, HasSubstr("this build has no MPI"));
    }
}

}  // namespace stipple::testing::ranks_test
