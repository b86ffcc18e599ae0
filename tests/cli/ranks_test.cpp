// SPDX-License-Identifier: MIT
//
// One set, analyzed by several MPI ranks. Their results are tested with many more ranks, as
// threads, in tests/pipeline/shared_analysis_test.cpp.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "core/text.hpp"
#include "places.hpp"
#include "support/launcher.hpp"
#include "support/program.hpp"

namespace stipple::testing::ranks_test {

using ::testing::HasSubstr;

namespace {

/// Results without times.
std::string timeless(const Sandbox& box, const std::string& command) {
    return good(box.shell(command + " | sed 's/ *\"seconds\":.*//'"));
}

}  // namespace

// Three files, two of which are split between ranks, one of these being text.
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

// Each rank would draw a seed of its own, or read other bytes of a pipe.
TEST(Ranks, RefuseWhatEachWouldGetAnew) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    good(box.shell("mkfifo pipe"));
    const std::string seed = "stipple: --seed: every rank would draw another one; give a number\n";
    for (const auto& [command, why] :
         {std::pair{"analyze moments --generate random -n 1e6 --seed random", seed},
          {"study --generators random --analyze moments --seed random", seed},
          {"analyze moments pipe",
           "stipple: pipe: is a pipe or a device; ranks share only files; store its bytes in a "
           "file\n"}}) {
        const Outcome outcome = box.shell(mpirun + "-n 2 timeout 60 stipple " + command);
        EXPECT_EQ(outcome.code, 2) << command;
        EXPECT_EQ(outcome.out, "") << command;
        EXPECT_TRUE(outcome.err.starts_with(why)) << outcome.err;
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

// All ranks report the same error for bad points, and rank 0 names the file, as a single process
// does.
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

// Rank 1 has a directory, memory limit or output of its own. If anything fails there at any time,
// the other ranks end, too, and one line names the rank.
TEST(Ranks, EndTogetherWhereOneFails) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    for (const char* folder : {"missing", "torn", "different", "folder"})
        std::filesystem::create_directory(box.path() / folder);
    good(box.shell("stipple generate random -n 20000 -d 3 -o p.csv"));
    good(box.shell("stipple generate random -n 20000 -d 3 -s 2 -o different/p.csv"));
    const auto size = box.read("p.csv").size();
    for (const char* name : {"different/p.csv", "torn/p.csv"}) {
        std::string bytes = box.read(*name == 'd' ? name : "p.csv").substr(0, size - 30);
        bytes.resize(size, *name == 'd' ? '\n' : 'x');
        box.write(name, bytes);
    }
    box.write("c.json", R"({"generators":["random"],"count":[16],"analyze":["moments"]})");
    std::filesystem::create_directory(box.path() / "folder/p.csv");
    const auto failing = [&](int ranks, const std::string& there, const std::string& command) {
        box.write("rank.sh", "[ $OMPI_COMM_WORLD_RANK != 1 ] || " + there + "\nexec \"$@\"\n");
        const Outcome outcome =
            box.shell(fmt::format("{}-n {} timeout 60 sh rank.sh "
                                  "stipple {} < /dev/null",
                                  mpirun, ranks, command));
        EXPECT_EQ(outcome.out, "") << command;
        std::string said;
        for (const auto line : split(outcome.err, '\n'))
            if (line.starts_with("stipple: ")) said += std::string(line) + "\n";
        return fmt::format("{} {}", outcome.code, said);
    };
    char host[256] = {};
    ::gethostname(host, sizeof host - 1);
    const std::string rank_1 = fmt::format("stipple: rank 1 on {}: ", host);
    for (const int ranks : {2, 3}) {
        const auto analysis = [&](const std::string& there) {
            return failing(ranks, there, "analyze chi-square p.csv");
        };
        EXPECT_EQ(analysis("cd missing"), "4 " + rank_1 + "p.csv: no such file\n");
        EXPECT_EQ(analysis("cd folder"), "4 " + rank_1 + "p.csv: is a folder, not a file\n");
        EXPECT_THAT(analysis("cd torn"),
                    HasSubstr("3 stipple: p.csv: this file is not the same for rank 1"));
        EXPECT_THAT(analysis("cd different"),
                    HasSubstr("3 stipple: p.csv: this file is not the same for rank 1"));
        EXPECT_THAT(analysis("set -- \"$@\" --max-memory 10k"), HasSubstr("5 " + rank_1));
    }
    EXPECT_THAT(failing(2, "cd missing", "study --config c.json -o s.csv"),
                HasSubstr("4 " + rank_1 + "c.json: no such file"));
}

// 1e6 points take 15 MiB, more than half of the limit.
TEST(Ranks, ShareTheMemoryOfTheirMachine) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    const Outcome outcome = box.shell(
        mpirun + "-n 2 stipple analyze star-discrepancy --generate random -n 1e6 --max-memory 24M");
    EXPECT_EQ(outcome.code, 5);
    EXPECT_THAT(outcome.err,
                HasSubstr("the set of points needs 15.3 MiB of memory; the limit is 12 MiB"));
}

// Every file that an option names is compared, as those of points are. Rank 1 reads its own.
TEST(Ranks, CompareAllFilesThatOptionsName) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    for (const char* folder : {"r0", "r1", "none"}) {
        const std::string at = std::string(folder) + "/";
        std::filesystem::create_directory(box.path() / folder);
        if (*folder == 'n') continue;
        const bool first = at == "r0/";
        box.write(at + "v.txt", first ? "1\n2\n4\n" : "1\n2\n5\n");
        box.write(at + "pool.csv",
                  first ? "x,y\n0.1,0.2\n0.3,0.4\n0.5,0.5\n" : "x,y\n0.1,0.2\n0.3,0.4\n0.5,0.6\n");
        box.write(at + "p.json", first ? R"({"parameters":[{"name":"a","range":[0,1]}]})"
                                       : R"({"parameters":[{"name":"a","range":[0,2]}]})");
        box.write(at + "poly.csv", first ? "0,0\n1,0\n0,1\n" : "0,0\n1,0\n0,2\n");
        box.write(at + "nest.json", R"({"parameters":[{"name":"a","file":"v.txt"}]})");
        box.write(at + "c.json", first ? R"({"generators":["random"],"analyze":["moments"]})"
                                       : R"({"generators":["sobol"],"analyze":["moments"]})");
    }
    good(
        box.shell("cd r0 && stipple generate random -n 9 -w polygon:file=poly.csv --meta -o s.csv "
                  "&& cp s.csv ../r1"));
    const auto told = [&](const std::string& folder, const std::string& command) {
        box.write("rank.sh", "cd r0; [ $OMPI_COMM_WORLD_RANK = 0 ] || cd ../" + folder +
                                 "\nexec timeout 60 \"$@\"\n");
        const Outcome outcome = box.shell(mpirun + "-n 2 sh rank.sh stipple " + command);
        EXPECT_EQ(outcome.out, "") << command;
        return fmt::format("{} {}", outcome.code, outcome.err.substr(0, outcome.err.find('\n')));
    };
    const std::string rank_1 = " is not the same for rank 1 as for rank 0";
    char host[256] = {};
    ::gethostname(host, sizeof host - 1);
    const std::string moments = "analyze moments --generate random -n 9 -d 1 ";
    const std::string study = "study --analyze moments -n 2 -d 1 --generators ";
    for (const auto& [command, file] :
         {std::pair{moments + "-w empirical:file=v.txt", "v.txt"},
          {moments + "--parameters p.json", "p.json"},
          {"analyze star-discrepancy --generate subset:from=pool.csv -n 2", "pool.csv"},
          {"analyze star-discrepancy --generate subset:of=[subset:from=pool.csv] -n 2", "pool.csv"},
          {moments + "-w 'mixture:weights=1,components=empirical:file=v.txt'", "v.txt"},
          {"analyze moments s.csv", "s.csv: poly.csv"},
          {"analyze moments s.csv --domain 'polygon:file=poly.csv'", "s.csv: poly.csv"},
          {study + "random -w empirical:file=v.txt", "v.txt"},
          {study + "'random -w empirical:file=v.txt'", "v.txt"},
          {study + "subset:from=pool.csv", "pool.csv"},
          {study + "random --parameters p.json", "p.json"},
          {"study --config c.json", "c.json"}}) {
        EXPECT_EQ(told("r1", command), fmt::format("3 stipple: {}: this file{}", file, rank_1))
            << command;
    }
    for (const auto& [command, file] : {std::pair{moments + "-w empirical:file=v.txt", "v.txt"},
                                        {moments + "--parameters p.json", "p.json"},
                                        {study + "random --parameters p.json", "p.json"}})
        EXPECT_EQ(told("none", command),
                  fmt::format("4 stipple: rank 1 on {}: {}: no such file", host, file))
            << command;
    EXPECT_EQ(told("r1", moments + "--parameters nest.json"),
              "3 stipple: nest.json: a file that it names" + rank_1);
}

TEST(Ranks, CompareTheirArguments) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    for (const std::string verb :
         {"analyze moments --generate random", "study --generators random --analyze moments"}) {
        const std::string command = "-n 1 stipple " + verb;
        const Outcome outcome =
            box.shell(mpirun + command + " -n 8 : " + command + " -n 16 --max-memory 1G");
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_THAT(outcome.err, HasSubstr("the arguments of rank 1 are not those of rank 0"));
    }
    char host[256] = {};
    ::gethostname(host, sizeof host - 1);
    for (const std::string verb :
         {"analyze moments --generate random", "study --generators random --analyze moments"}) {
        const std::string command = "-n 1 stipple " + verb + " -n 8";
        for (const int wrong : {0, 1}) {
            const std::string first = command + (wrong == 0 ? "x : " : " : ");
            const Outcome outcome = box.shell(mpirun + first + command + (wrong == 1 ? "x" : ""));
            EXPECT_EQ(outcome.code, 2);
            EXPECT_TRUE(outcome.err.starts_with(
                fmt::format("stipple: rank {} on {}: --count: '8x' is not ", wrong, host)))
                << outcome.err;
        }
        const Outcome both = box.shell(mpirun + command + "x : " + command + "x");
        EXPECT_EQ(both.code, 2);
        EXPECT_TRUE(both.err.starts_with("stipple: --count: '8x' is not ")) << both.err;
        EXPECT_EQ(both.err.find("'8x'"), both.err.rfind("'8x'")) << both.err;
    }
    box.write("a.csv", "x,y\n0.1,0.2\n0.3,0.4\n");
    box.write("b.csv", "x,y\n0.1,0.2\n0.3,0.4\n");
    const std::string alike = mpirun +
                              "-n 1 stipple analyze moments a.csv : -n 1 stipple analyze "
                              "moments b.csv --threads 1";
    good(box.shell(alike));
}

// mpirun gives its first process a terminal even if its own output is redirected.
TEST(Ranks, OfWhichThereIsOneWriteAsIfAlone) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    good(box.shell("stipple generate random -n 100 -o p.csv"));
    good(box.shell(mpirun + "-n 1 stipple analyze moments p.csv < /dev/null > r.json"));
    EXPECT_TRUE(box.read("r.json").starts_with("{"));
}

TEST(Ranks, SummarizeATableOnce) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    good(
        box.shell("stipple study --generators random --analyze moments --keys 'mean[0]' -o s.csv"));
    const std::string wide = "stipple study s.csv --wide";
    EXPECT_EQ(good(box.shell(mpirun + "-n 2 " + wide)), good(box.shell(wide)));
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
