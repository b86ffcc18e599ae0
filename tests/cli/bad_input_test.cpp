// SPDX-License-Identifier: MIT
//
// Every error gives one clear line on stderr, the documented exit code, nothing on stdout, and no
// new or damaged file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <map>

#include "support/program.hpp"
#include "support/system.hpp"

namespace stipple::testing::bad_input_test {

using namespace std::string_literals;
using ::testing::HasSubstr;

namespace {

/// Runs analyze star-discrepancy on a file with these bytes.
Outcome judge(const std::string& name, const std::string& bytes) {
    const Sandbox box;
    box.write(name, bytes);
    const Outcome outcome = box.run({"analyze", "star-discrepancy", name, "-o", "result.json"});
    EXPECT_EQ(box.files(), std::vector{name});
    return outcome;
}

std::string npy_header() {
    std::string text = "{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }";
    text.resize(117, ' ');
    return std::string("\x93NUMPY\x01\x00\x76\x00", 10) + text + "\n";
}

/// Creates entries that are unsuitable as input or output files.
void put_odd_things(const Sandbox& box) {
    box.write("points.csv", "x,y\n0.5,0.25\n0.25,0.5\n");
    box.write("empty.csv", "");
    std::filesystem::create_directory(box.path() / "folder");
    for (const auto& [target, link] : {std::pair{"nowhere.csv", "dangling.csv"},
                                       {"circle.csv", "circle.csv"},
                                       {"points.csv", "link.csv"}})
        std::filesystem::create_symlink(target, box.path() / link);
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    const std::string path = box.path() / "socket.csv";
    ASSERT_LT(path.size(), sizeof address.sun_path);
    std::ranges::copy(path, address.sun_path);
    const int listener = ::socket(AF_UNIX, SOCK_STREAM, 0);
    ASSERT_EQ(::bind(listener, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::close(listener);
}

/// Shell command for the bytes of the unnamed files that a process is writing: one number, whatever
/// else `find` meets there, since what follows calculates with it.
std::string unnamed_bytes(const std::string& pid) {
    return "$(find -L /proc/" + pid +
           "/fd -type f -links 0 -printf '%s\\n' 2>/dev/null | awk '{ s += $1 } END { print s + 0 "
           "}')";
}

}  // namespace

// A launcher's environment variables are inherited by everything that it starts.
TEST(BadInput, IsReportedByEveryVerbThatRanksDoNotShare) {
    const Sandbox box;
    const std::string ranks = "OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=1 PMI_RANK=1 stipple ";
    for (const std::string command : {"generate nonsense", "plot missing.csv", "list nonsense"})
        EXPECT_THAT(box.shell(ranks + command).err, HasSubstr("stipple: ")) << command;
    EXPECT_THAT(box.shell("OMPI_COMM_WORLD_RANK=1 stipple analyze nonsense").err,
                HasSubstr("nonsense"));
}

// Standard error is full, closed, or a broken pipe.
TEST(BadInput, ExitCodesHoldWhereNobodyHearsTheMessage) {
    SKIP_WITHOUT("/dev/full");
    const Sandbox box;
    for (const char* where : {"2>/dev/full", "2>&-", "2>&1 | true"}) {
        const Outcome outcome =
            box.shell(std::string("set -o pipefail; stipple generate nosuch ") + where);
        EXPECT_EQ(outcome.code, 2) << where << outcome.err;
    }
}

TEST(BadInput, NoSuchFile) {
    const Sandbox box;
    expect_refusal(box.run({"analyze", "star-discrepancy", "none.csv"}), 4, "none.csv");
    expect_refusal(box.run({"convert", "none.csv", "-o", "x.npy"}), 4, "none.csv");
    EXPECT_EQ(box.files(), std::vector<std::string>{});
}

TEST(BadInput, ADirectory) {
    const Sandbox box;
    expect_refusal(box.run({"analyze", "star-discrepancy", "."}), 4, "folder");
}

TEST(BadInput, OddInputsEndWithOneLineAndTheRightCode) {
    const Sandbox box;
    put_odd_things(box);
    good(box.run({"analyze", "moments", "link.csv"}));
    EXPECT_THAT(
        good(box.shell("mkfifo fifo; (cat points.csv > fifo &); stipple convert fifo; rm fifo")),
        HasSubstr("0.25"));
    for (const auto& [name, code] : std::map<std::string, int>{{"empty.csv", 3},
                                                               {"/dev/null", 3},
                                                               {"folder", 4},
                                                               {"dangling.csv", 4},
                                                               {"circle.csv", 4},
                                                               {"socket.csv", 4},
                                                               {"missing.csv", 4},
                                                               {"points.csv/x", 4}})
        for (const std::vector<std::string>& verb : {std::vector<std::string>{"analyze", "moments"},
                                                     {"convert", "-f", "csv"},
                                                     {"plot", "-f", "svg"},
                                                     {"report"},
                                                     {"warp", "disk"}}) {
            std::vector<std::string> words = verb;
            words.push_back(name);
            expect_refusal(box.run(words), code, name);
        }
}

TEST(BadInput, OddOutputsEndWithOneLineAndTheRightCode) {
    SKIP_WITHOUT("/dev/full");
    SKIP_WITHOUT("/proc/self/fd");
    const Sandbox box;
    put_odd_things(box);
    const auto written = [&](const std::string& name) {
        return box.run({"generate", "halton", "-n", "20000", "-f", "csv", "-o", name});
    };
    for (const char* name : {"folder", "circle.csv", "socket.csv", "/dev/full", "missing/x.csv",
                             "points.csv/x.csv", "/proc/x.csv"})
        expect_refusal(written(name), 4, name);
    for (const char* name : {"link.csv", "dangling.csv", "/dev/null"}) good(written(name));
    EXPECT_TRUE(std::filesystem::is_symlink(box.path() / "link.csv"));
    EXPECT_GT(box.read("points.csv").size(), 100'000U);
    EXPECT_GT(box.read("nowhere.csv").size(), 100'000U);
    for (const std::string command : {"list", "help", "analyze moments link.csv",
                                      "generate halton -n 1e6", "plot -f svg link.csv"}) {
        const Outcome closed = box.shell("set +o pipefail; stipple " + command + " | true");
        EXPECT_EQ(closed.err, "") << command;
        expect_refusal(box.shell("stipple " + command + " > /dev/full"), 4, "stdout");
    }
}

TEST(BadInput, EmptyFiles) {
    expect_refusal(judge("p.csv", ""), 3, "p.csv");
    expect_refusal(judge("p.csv", "\n\n"), 3, "p.csv");
    expect_refusal(judge("p.csv", "# nothing\n# here\n"), 3, "p.csv");
    expect_refusal(judge("p.csv", "x,y\n"), 3, "p.csv");
    expect_refusal(judge("p.json", ""), 3, "p.json");
    expect_refusal(judge("p.npy", ""), 3, "p.npy");
    const Sandbox box;
    expect_refusal(box.run({"analyze", "star-discrepancy"}, ""), 3,
                   "stdin: no input; expected points, one per line; did the command before it in "
                   "the pipe fail?");
}

TEST(BadInput, NumbersThatAreNone) {
    expect_refusal(judge("p.csv", "0.1,0.2\n0.3,nan\n"), 3, "p.csv:2:5");
    expect_refusal(judge("p.csv", "0.1,0.2\ninf,0.3\n"), 3, "p.csv:2:1");
    expect_refusal(judge("p.csv", "0.1,0.2\n0.3,-Infinity\n"), 3, "p.csv:2:5");
    expect_refusal(judge("p.csv", "0.1,1e999\n"), 3, "p.csv:1:5");
    expect_refusal(judge("p.csv", "nan,nan\n0.1,0.2\n"), 3, "p.csv:1:1");
    expect_refusal(judge("p.json", R"({"points":[[0.1,NaN]]})"), 3, "p.json:1:");
    expect_refusal(judge("p.json", R"([[0.1,1e999]])"), 3, "p.json:1:");
}

TEST(BadInput, RaggedRowsAndWords) {
    expect_refusal(judge("p.csv", "0.1,0.2\n0.3\n"), 3, "p.csv:2");
    expect_refusal(judge("p.csv", "0.1,0.2\n0.3,0.4,0.5\n"), 3, "p.csv:2");
    expect_refusal(judge("p.csv", "x,y\n0.1,0.2\nhello,0.4\n"), 3, "p.csv:3:1");
    expect_refusal(judge("p.csv", "0.1,0.2\n0.3,0.4 tail\n"), 3, "p.csv:2");
    expect_refusal(judge("p.json", "[[0.1,0.2],[0.3]]"), 3, "p.json:1:");
    expect_refusal(judge("p.json", R"([[0.1,"word"]])"), 3, "p.json:1:");
}

TEST(BadInput, BinaryJunkAndTruncation) {
    expect_refusal(judge("p.csv", std::string("\x01\x02\x00\xff\xfe junk", 10)), 3, "p.csv");
    expect_refusal(judge("p.npy", npy_header() + std::string(31, '\0')), 3, "p.npy");
    expect_refusal(judge("p.npy", npy_header() + std::string(33, '\0')), 3, "p.npy");
    expect_refusal(judge("p.npy", npy_header().substr(0, 40)), 3, "p.npy");
    expect_refusal(judge("p.json", R"({"format":"stipple.points","points":[[0.1,0.2],[0.3)"), 3,
                   "p.json:1:");
    const Sandbox box;
    box.write("p.bin", std::string(20, '\0'));
    expect_refusal(box.run({"analyze", "star-discrepancy", "p.bin", "-d", "2"}), 3, "p.bin");
    expect_refusal(box.run({"analyze", "star-discrepancy", "p.bin"}), 2, "-d");
}

TEST(BadInput, PointsOutsideTheCubeAreCountedAndTheFirstNamed) {
    const Outcome outcome = judge("p.csv", "0.5,0.5\n1.5,0.25\n-1,0\n");
    expect_refusal(outcome, 3, "2 of 3 points are outside");
    EXPECT_THAT(outcome.err, HasSubstr("p.csv: 2 of 3 points"));
    EXPECT_THAT(outcome.err, HasSubstr("--rescale"));
    const Sandbox box;
    EXPECT_THAT(box.shell("stipple generate halton -n 9 -f csv | stipple warp disk -f csv | "
                          "stipple analyze moments")
                    .err,
                HasSubstr("or --meta on the command that wrote them"));
}

TEST(BadInput, DimensionsThatAnAnalyzerDoesNotTake) {
    const Sandbox box;
    expect_refusal(box.run({"analyze", "periodogram"}, "0.1 0.2 0.3 0.4\n0.5 0.6 0.7 0.8\n"), 3,
                   "dimension");
}

TEST(BadInput, CountsThatAreNone) {
    const Sandbox box;
    for (const char* count : {"0", "-5", "1e30", "99999999999999999999"})
        expect_refusal(box.run({"generate", "random", "-n", count, "-o", "p.csv"}), 2, "--count");
    for (const char* count : {"1.5", "ten", "", "1e", "2^"})
        expect_refusal(box.run({"generate", "random", "-n", count}), 2, "whole number");
    expect_refusal(box.run({"generate", "random", "-d", "0"}), 2, "--dimension");
    expect_refusal(box.run({"generate", "random", "--seed", "-1"}), 2, "--seed");
    expect_refusal(box.run({"generate", "random", "--shard", "3/3"}), 2, "--shard");
    expect_refusal(box.run({"generate", "random", "--start", "2^53"}), 2, "--start");
    expect_refusal(box.run({"generate", "random", "-m", "0"}), 2, "--sets");
    expect_refusal(box.run({"generate", "random", "--bounds", "1..0"}), 2, "--bounds");
    expect_refusal(box.run({"generate", "random", "--dtype", "f16"}), 2, "--dtype");
    expect_refusal(box.run({"generate", "random", "--threads", "many"}), 2, "--threads");
    expect_refusal(box.run({"generate", "random", "--max-memory", "lots"}), 2, "--max-memory");
    EXPECT_EQ(box.files(), std::vector<std::string>{});
}

TEST(BadInput, CountsThatAGeneratorCannotMakeNameTheNearest) {
    const Sandbox box;
    const Outcome outcome = box.run({"generate", "grid", "-n", "1000"});
    expect_refusal(outcome, 2, "961 and 1024");
}

TEST(BadInput, UnknownNamesMeetTheNearestKnownOne) {
    const Sandbox box;
    expect_refusal(box.run({"generate", "haltom"}), 2, "did you mean 'halton'?");
    expect_refusal(box.run({"generate", "halton", "--cuont", "5"}), 2, "did you mean --count?");
    expect_refusal(box.run({"generate", "random", "--rngg", "philox"}), 2, "did you mean --rng?");
    expect_refusal(box.run({"generate", "random", "--rng", "filox"}), 2, "did you mean 'philox'?");
    expect_refusal(box.run({"generate", "halton", "-w", "dsik"}), 2, "did you mean 'disk'?");
    expect_refusal(box.run({"generate", "halton", "-w", "disk:radus=2"}), 2,
                   "did you mean 'radius'?");
    expect_refusal(box.run({"generate", "halton", "-f", "nppy"}), 2, "did you mean 'npy'?");
    expect_refusal(box.run({"analyze", "star-discrepency"}), 2, "did you mean 'star-discrepancy'?");
    expect_refusal(box.run({"generat", "halton"}), 2, "did you mean generate?");
    expect_refusal(box.run({"generate"}), 2, "'stipple list generators' names them");
    expect_refusal(box.run({"generate", "halton", "extra"}), 2, "extra");
    expect_refusal(box.run({"generate", "halton", "-n"}), 2, "--count");
}

TEST(BadInput, WhatIsSaidTwiceIsRefused) {
    const Sandbox box;
    expect_refusal(box.run({"generate", "halton", "-w", "disk:radius=1,radius=2"}), 2,
                   "'radius' is given twice: 1 and 2");
    expect_refusal(box.run({"warp", "disk", "--radius", "1", "--radius", "2"}, "0,0\n"), 2,
                   "--radius is given more than once");
    expect_refusal(box.run({"warp", "disk:radius=1", "--radius", "2"}, "0,0\n"), 2,
                   "--radius is given more than once");
    expect_refusal(box.run({"generate", "halton", "-n", "3", "-n", "4"}), 2,
                   "--count is given more than once");
    expect_refusal(box.run({"analyze", "moments", "--bounds", "0..1", "--domain", "disk"}, "0,0\n"),
                   2, "--bounds and --domain: give one of them");
}

TEST(BadInput, WordsAreNotNamedTwice) {
    const Sandbox box;
    const Outcome choice = box.run({"generate", "random", "--rng", "zzzzzzzz"});
    expect_refusal(choice, 2, "is not one of");
    EXPECT_EQ(choice.err.find("known:"), std::string::npos) << choice.err;
    expect_refusal(box.run({"generate", "random", "-d", "3", "-f", "psa"}), 2,
                   "psa holds points of dimension 2; these have 3");
}

TEST(BadInput, SpecsThatDoNotParseNameTheColumn) {
    const Sandbox box;
    expect_refusal(box.run({"generate", "halton", "-w", "disk:center=[0,0"}), 2, "column");
    expect_refusal(box.run({"generate", "halton", "-w", "disk:"}), 2, "column");
    expect_refusal(box.run({"generate", "halton", "-d", "5", "-w", "disk"}), 2, "disk@1,2");
    expect_refusal(box.run({"generate", "halton", "-w", "disk@1,3"}), 2, "coordinates 1 to 2");
    expect_refusal(box.run({"generate", "halton", "-w", "disk", "-w", "disk"}), 2,
                   "another domain");
}

TEST(BadInput, TargetsThatCannotBeWritten) {
    SKIP_WITHOUT("/dev/full");
    const Sandbox box;
    expect_refusal(box.run({"generate", "halton", "-o", "missing/p.csv"}), 4, "missing/p.csv");
    expect_refusal(box.run({"generate", "halton", "-o", "/dev/full"}), 4, "/dev/full");
    expect_refusal(box.shell("stipple generate halton > /dev/full"), 4, "stdout");
    expect_refusal(box.shell("stipple list > /dev/full"), 4, "stdout");
    std::filesystem::create_directory(box.path() / "folder");
    expect_refusal(box.run({"generate", "halton", "-o", "folder"}), 4, "folder");
    EXPECT_EQ(box.files(), std::vector<std::string>{"folder"});
}

// Root can write everywhere, so the command is run as user nobody.
TEST(BadInput, AReadOnlyTargetIsNotHarmed) {
    const Sandbox box;
    box.write("p.csv", "x,y\n0.5,0.5\n");
    std::filesystem::permissions(box.path(), std::filesystem::perms(0777));
    std::filesystem::permissions(box.path() / "p.csv", std::filesystem::perms(0444));
    const std::string as_nobody =
        geteuid() == 0 ? "setpriv --reuid=65534 --regid=65534 --clear-groups " : "";
    expect_refusal(box.shell(as_nobody + "stipple generate halton -n 9 -o p.csv"), 4, "p.csv");
    EXPECT_EQ(box.read("p.csv"), "x,y\n0.5,0.5\n");
    EXPECT_EQ(box.files(), std::vector<std::string>{"p.csv"});
}

TEST(BadInput, AFailureLeavesTheOldTargetAlone) {
    const Sandbox box;
    box.write("p.csv", "x,y\n0.5,0.5\n");
    box.write("bad.csv", "x,y\n0.5,word\n");
    expect_refusal(box.run({"convert", "bad.csv", "-o", "p.csv"}), 3, "bad.csv:2:5");
    expect_refusal(box.run({"generate", "poisson-disk", "--radius", "-1", "-o", "p.csv"}), 2,
                   "--radius");
    EXPECT_EQ(box.read("p.csv"), "x,y\n0.5,0.5\n");
}

TEST(BadInput, CtrlCLeavesNothingBehind) {
    SKIP_WITHOUT("/proc/self/fd");
    const Sandbox box;
    // A shell that ends early takes the program with it, which would write for hours.
    const std::string ends = "trap 'kill -KILL $! 2>/dev/null' EXIT; ";
    const std::string start = "stipple generate random -n 1e10 -o p.csv 2>&1 & until [ " +
                              unnamed_bytes("$!") + " -gt 0 ]; do sleep 0.01; done; ";
    for (const std::string signal : {"INT", "TERM", "HUP"}) {
        const Outcome outcome = box.shell(ends + start + "kill -" + signal + " $!; wait $!");
        EXPECT_EQ(outcome.code, 130);
        EXPECT_EQ(outcome.out, "stipple: interrupted\n");
        EXPECT_EQ(box.files(), std::vector<std::string>{});
    }
    EXPECT_EQ(box.shell(ends + start + "kill -KILL $!; wait $!").code, 137);
    EXPECT_EQ(box.files(), std::vector<std::string>{});
    // A program started by nohup ignores SIGHUP.
    const Outcome nohup =
        box.shell(ends + "nohup " + start + "kill -HUP $!; size=" + unnamed_bytes("$!") +
                  "; until [ " + unnamed_bytes("$!") +
                  " -gt $((size + 100000)) ]; do sleep 0.01; done; kill -TERM $!; wait $!");
    EXPECT_EQ(nohup.code, 130);
    const Outcome walking =
        box.shell("stipple generate random --rng ranlux48 --start 1e15 -n 1 & pid=$!; " +
                  caught("$pid") + "kill -INT $pid; wait $pid");
    EXPECT_THAT(walking.err, HasSubstr("stipple: interrupted"));
    const Outcome waiting = box.shell("mkfifo pipe; stipple analyze chi-square pipe & pid=$!; " +
                                      caught("$pid") + "kill -INT $pid; wait $pid; rm pipe");
    EXPECT_THAT(waiting.err, HasSubstr("stipple: interrupted"));
}

TEST(BadInput, AFileOverTheLimitIsAnErrorLikeAFullDisk) {
    const Sandbox box;
    expect_refusal(box.shell("ulimit -f 8; stipple generate random -n 1e5 -o p.csv"), 4,
                   "p.csv: larger than the limit of files");
    EXPECT_EQ(box.files(), std::vector<std::string>{});
}

// Escape sequences and newlines in names of files, titles and arguments.
TEST(BadInput, TextOfStrangersIsShownAndNotObeyed) {
    const Sandbox box;
    const std::string name = "x\x1b[31m\nstipple: identical\xff.csv";
    const std::string shown = "x\\x1b[31m\\nstipple: identical\\xff.csv";
    expect_refusal(box.run({"analyze", "moments", name}), 4, shown + ": no such file");
    expect_refusal(box.run({"analyze", "mom\x1b]0;t\x07"}), 2, "'mom\\x1b]0;t\\x07'");
    expect_refusal(box.run({"reproduce", name}), 4, shown);
    box.write(name, "x,y\n0.5,0.25\n0.25,0.5\n");
    EXPECT_THAT(good(box.run({"analyze", "moments", name, "-f", "text"})),
                HasSubstr("moments of " + shown + " ("));
    EXPECT_THAT(good(box.run({"analyze", "moments", name, "-f", "json"})),
                HasSubstr("x\\u001b[31m\\nstipple: identical\xEF\xBF\xBD.csv"));
    const std::string picture = good(box.run({"plot", name, "-f", "text"}));
    EXPECT_EQ(picture.substr(0, picture.find('\n')), shown);
    for (const char* format : {"svg", "html", "json"}) {
        const std::string file = std::string("out.") + format;
        good(box.run({*format == 's' ? "plot" : "report", name, "-o", file}));
        EXPECT_EQ(box.read(file).find('\x1b'), std::string::npos) << format;
    }
}

TEST(BadInput, LongWordsAreNotRepeated) {
    const Sandbox box;
    const std::string word(100'000, 'q');
    using Words = std::vector<std::string>;
    for (const Words& words :
         {Words{word}, Words{"generate", word}, Words{"generate", "halton", "-n", word},
          Words{"generate", "halton", "--" + word},
          Words{"generate", "halton", "-w", "disk:" + word},
          Words{"analyze", "moments", "--column", word}, Words{"convert", "-o", word},
          Words{"list", word}, Words{"help", word}, Words{"study", "--generators", word}}) {
        const Outcome outcome = box.run(words);
        EXPECT_NE(outcome.code, 0) << words.front();
        EXPECT_LT(outcome.err.size(), 3000U) << outcome.err.substr(0, 100);
    }
}

// Notes are printed with a result, but not with an error.
TEST(BadInput, AnErrorIsOneLineWhateverThereIsToRemark) {
    const Sandbox box;
    const std::string remarked = "stipple generate sobol -n 1000 ";
    EXPECT_THAT(box.shell(remarked).err, HasSubstr("1000"));
    expect_refusal(box.shell(remarked + "-w expression-2d:density=x-2"), 2, "density");
    expect_refusal(box.shell(remarked + "-o missing/p.csv"), 4, "missing");
}

TEST(BadInput, DomainsThatDoNotFitNameTheFile) {
    const Sandbox box;
    box.write("p.csv", "x,y\n0.5,0.25\n0.25,0.5\n");
    for (const std::string command : {"report -o x.html", "plot -o x.svg", "analyze moments"})
        expect_refusal(box.shell("stipple " + command + " p.csv --domain sphere"), 3,
                       "p.csv: the domain sphere has dimension 3; the points have 2");
}

TEST(BadInput, NamesMayBeginWithADash) {
    const Sandbox box;
    box.write("-x.csv", "x,y\n0.5,0.25\n0.25,0.5\n");
    good(box.run({"analyze", "moments", "--", "-x.csv"}));
    good(box.run({"convert", "-f", "json", "--", "-x.csv"}));
    expect_refusal(box.run({"analyze", "moments", "-x.csv"}), 2, "-x.csv");
}

// The exact value would take hours.
TEST(BadInput, CtrlCDuringASearchPrintsTheBoundsFoundSoFarButWritesNoFile) {
    const Sandbox box;
    const std::string search =
        "stipple generate halton -n 2000 -d 8 -o p.npy; stipple analyze star-discrepancy p.npy ";
    // Bounds are shown as soon as they are known.
    const std::string interrupt =
        " --progress always 2> err & until grep -qs between err; do sleep 0.02; done; kill -INT "
        "$!; "
        "wait $!; code=$?; tr '\\r' '\\n' < err | grep -a interrupted | sed "
        "'s/.*stipple:/stipple:/' "
        ">&2; rm err; exit $code";
    const Outcome printed = box.shell(search + interrupt);
    EXPECT_EQ(printed.code, 130);
    EXPECT_THAT(printed.err, HasSubstr("stipple: interrupted"));
    EXPECT_THAT(printed.out, HasSubstr("\"exact\": false"));
    EXPECT_THAT(printed.out, HasSubstr("\"upper\": "));
    const Outcome written = box.shell(search + "-o report.json" + interrupt);
    expect_refusal(written, 130, "interrupted");
    EXPECT_EQ(box.files(), std::vector<std::string>{"p.npy"});
}

TEST(BadInput, TooMuchMemoryIsRefusedBeforeStarting) {
    const Sandbox box;
    const Outcome outcome =
        box.run({"generate", "poisson-disk", "--radius", "1e-6", "--max-memory", "100M"});
    expect_refusal(outcome, 5, "of memory; the limit is 100 MiB");
    expect_refusal(box.shell("stipple generate halton -n 60000 -f csv | grep -v '#' | stipple "
                             "analyze kolmogorov-smirnov --max-memory 2M"),
                   5, "the limit is 2 MiB");
    expect_refusal(box.shell("stipple -q analyze kolmogorov-smirnov --generate random -n 60000 "
                             "--max-memory 40k"),
                   5, "sorting the coordinates needs 2.75 MiB of memory");
}

TEST(BadInput, TablesOfGeneratorsAreReadBeforeAnythingIsWritten) {
    const Sandbox box;
    box.write("bad.txt", "d s a m_i\n2 1 0 1\n3 2 1 1 x\n");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"generate", "sobol", "-d", "3", "--directions", "bad.txt"},
          {"generate", "digital-net", "--matrices", "bad.txt"},
          {"generate", "rank1-lattice", "-n", "16", "--vector-file", "bad.txt"}}) {
        const Outcome outcome = box.run(words);
        EXPECT_EQ(outcome.code, 3) << words[1];
        EXPECT_EQ(outcome.out, "") << words[1];
        EXPECT_THAT(outcome.err, HasSubstr("stipple: bad.txt:")) << words[1];
    }
    const Outcome missing = box.run({"generate", "sobol", "--directions", "missing.txt"});
    EXPECT_EQ(missing.code, 4);
    EXPECT_EQ(missing.out + missing.err, "stipple: missing.txt: no such file\n");
}

// A box from -1e308 to 1e308 has a width beyond the range of double.
TEST(BadInput, DomainsInAFileAreTheFilesFault) {
    const Sandbox box;
    box.write("f.json", R"({"points":[[0.1,0.2]],"meta":{"domain":"disk:radius=-1"}})");
    expect_refusal(box.run({"convert", "f.json"}), 3, "its domain 'disk:radius=-1': --radius");
    box.write("g.csv", "# tool: \"stipple\"\n# domain: \"nope\"\nx,y\n0.1,0.2\n0.3,0.4\n");
    expect_refusal(box.run({"analyze", "moments", "g.csv"}), 3, "unknown domain 'nope'");
}

TEST(BadInput, FilesBesideAReportStayWhenItFails) {
    SKIP_WITHOUT("/dev/full");
    const Sandbox box;
    box.write("p.csv", "x,y\n0.1,0.2\n0.4,0.3\n");
    box.write("g.npy", "mine");
    const auto refused = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"analyze", "periodogram", "p.csv", "--grid", "g.npy"};
        words.insert(words.end(), more.begin(), more.end());
        EXPECT_GT(box.run(words).code, 1);
        EXPECT_EQ(box.read("g.npy"), "mine");
        EXPECT_EQ(box.files(), (std::vector<std::string>{"g.npy", "p.csv"}));
    };
    refused({"--check", "powr<1"});
    refused({"-o", "/dev/full"});
    refused({"-o", "none/x.json"});
    refused({"--image", "none/x.png"});
    EXPECT_EQ(box.run({"analyze", "periodogram", "p.csv", "--grid", "g.npy"}).code, 0);
    EXPECT_NE(box.read("g.npy"), "mine");
}

TEST(BadInput, StandardInputIsNotReadTwice) {
    const Sandbox box;
    for (const std::string verb : {"analyze moments", "report", "convert --concat"})
        expect_refusal(box.shell("stipple " + verb + " - -", "0.1,0.2\n"), 2,
                       "standard input is named twice");
}

TEST(BadInput, OneFileIsNotSeveral) {
    const Sandbox box;
    box.write("p.csv", "x,y\n0.1,0.2\n");
    for (const std::string line :
         {"analyze moments p.csv -o 'r{set}.json'", "plot p.csv -o 'p{seed}.svg'",
          "study --generators random -n 4 --analyze moments -o 's{seed}.csv'",
          "report p.csv -o 'r{set}.html'"})
        expect_refusal(box.shell("stipple " + line), 2, "one file is written for all sets");
    box.write("d.pfm", "Pf\n1 1\n-1\n\0\0\x80\x3f"s);
    expect_refusal(box.run({"generate", "lloyd", "-n", "9", "--density", "d.pfm", "--with-weight"}),
                   2, "--with-weight: the density of points made with --density is not known");
    expect_refusal(box.run({"warp", "disk", "p.csv", "--with-pdf", "-f", "psa"}), 2,
                   "psa cannot hold pdf");
}

TEST(BadInput, BoxesWiderThanFloat64) {
    const Sandbox box;
    box.write("big.csv", "1e308,0\n-1e308,1\n");
    const char* words =
        "big.csv: the box around the points is too wide for float64: x1 goes from -1e+308 to "
        "1e+308";
    expect_refusal(box.run({"analyze", "star-discrepancy", "big.csv", "--rescale"}), 3, words);
    for (const char* chart : {"points", "density", "histogram"})
        expect_refusal(box.run({"plot", "big.csv", "--chart", chart, "-o", "p.svg"}), 3, words);
    expect_refusal(box.run({"report", "big.csv", "-o", "p.html"}), 3, words);
    expect_refusal(box.run({"convert", "big.csv", "-o", "p.svg"}), 3, "is too wide for float64");
    EXPECT_EQ(box.files(), std::vector<std::string>{"big.csv"});
}

TEST(BadInput, OptionsWithoutTheirValue) {
    const Sandbox box;
    expect_refusal(box.run({"generate", "halton", "--count"}), 2, "--count needs a value");
    expect_refusal(box.run({"generate", "halton", "-n"}), 2, "--count needs a value");
    expect_refusal(box.run({"analyze", "periodogram", "p.csv", "--max-frequency"}), 2,
                   "--max-frequency needs a value");
}

TEST(BadInput, ChartsOfTheWrongDimensionHintAtNothingThatHelps) {
    const Sandbox box;
    box.write("p.csv", "0.1,0.2,0.3\n0.4,0.5,0.6\n");
    const Outcome outcome = box.run({"plot", "p.csv", "--chart", "differential", "-o", "p.svg"});
    expect_refusal(outcome, 3,
                   "p.csv: differential requires points of dimension 2; these have 3\n");
}

}  // namespace stipple::testing::bad_input_test
