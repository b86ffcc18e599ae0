// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>

#include "places.hpp"
#include "support/program.hpp"
#include "support/system.hpp"

namespace stipple::testing::generate_test {

using nlohmann::json;
using ::testing::HasSubstr;

TEST(Generate, HaltonIsTheTextbookSet) {
    const Sandbox box;
    EXPECT_EQ(good(box.run({"generate", "halton", "--start", "1", "-n", "5", "-d", "1"})),
              "x\n0.5\n0.25\n0.75\n0.125\n0.625\n");
}

TEST(Generate, HeadersNameTheCoordinates) {
    const Sandbox box;
    const auto header = [&](const char* d) {
        const auto out = good(box.run({"generate", "random", "-n", "1", "-d", d}));
        return out.substr(0, out.find('\n'));
    };
    EXPECT_EQ(header("1"), "x");
    EXPECT_EQ(header("2"), "x,y");
    EXPECT_EQ(header("3"), "x,y,z");
    EXPECT_EQ(header("5"), "x1,x2,x3,x4,x5");
}

TEST(Generate, CountsAreWrittenInManyWays) {
    const Sandbox box;
    for (const auto& [text, lines] :
         {std::pair{"1e3", 1000}, {"2^10", 1024}, {"2k", 2048}, {"1.5e2", 150}, {"7", 7}}) {
        const auto out =
            good(box.run({"generate", "random", "--no-header", std::string("--count=") + text}));
        EXPECT_EQ(std::ranges::count(out, '\n'), lines) << text;
    }
}

TEST(Generate, TheDefaultIsTheContracts) {
    const Sandbox box;
    const auto out = good(box.run({"generate", "random"}));
    EXPECT_EQ(std::ranges::count(out, '\n'), 1025);
    EXPECT_EQ(out, good(box.run({"generate", "random", "-n", "1024", "-d", "2", "-s", "1"})));
}

TEST(Generate, ShardsJoinToTheWholeByteForByte) {
    const Sandbox box;
    for (const char* generator : {"random", "halton", "hammersley", "jittered", "poisson-disk"})
        for (const char* format : {"csv", "txt", "bin"}) {
            const std::vector<std::string> base = {"generate", generator,     "-n", "1001", "-f",
                                                   format,     "--no-header", "-d", "2"};
            const std::string whole = good(box.run(base));
            std::string joined;
            for (int i = 0; i < 3; ++i) {
                auto part = base;
                part.insert(part.end(), {"--shard", std::to_string(i) + "/3"});
                joined += good(box.run(part));
            }
            EXPECT_EQ(joined, whole) << generator << ' ' << format;
        }
}

TEST(Generate, ThreadsNeverChangeTheBytes) {
    const Sandbox box;
    for (const char* generator : {"random", "jittered"}) {
        std::vector<std::string> outs;
        for (const char* threads : {"1", "2", "7"})
            outs.push_back(good(box.run({"generate", generator, "-n", "1e5", "-w", "disk", "-f",
                                         "json", "--with-pdf", "--threads", threads})));
        EXPECT_EQ(outs[0], outs[1]) << generator;
        EXPECT_EQ(outs[0], outs[2]) << generator;
    }
}

TEST(Generate, SeveralSetsAreTheSeedsInTurn) {
    const Sandbox box;
    const auto rows = [&](std::vector<std::string> more) {
        std::vector<std::string> words = {"generate", "random", "-n", "3", "--no-header"};
        words.insert(words.end(), more.begin(), more.end());
        return good(box.run(words));
    };
    const std::string both = rows({"-s", "5", "-m", "2", "-f", "txt"});
    EXPECT_EQ(both, rows({"-s", "5", "-f", "txt"}) + "#\n" + rows({"-s", "6", "-f", "txt"}));
    const auto csv = good(box.run({"generate", "random", "-n", "1", "-m", "2"}));
    EXPECT_TRUE(csv.starts_with("set,x,y\n0,")) << csv;
    EXPECT_THAT(csv, HasSubstr("\n1,"));
}

TEST(Generate, AFilePerSetIsNamedBySetAndSeed) {
    const Sandbox box;
    good(box.run(
        {"generate", "random", "-n", "4", "-m", "2", "-s", "8", "-o", "a{set}_{seed}.csv"}));
    EXPECT_EQ(box.files(), (std::vector<std::string>{"a0_8.csv", "a1_9.csv"}));
    good(box.run({"generate", "random", "-n", "4", "-s", "9", "-o", "b.csv"}));
    const std::string alone = box.read("b.csv");
    EXPECT_EQ(box.read("a1_9.csv"), alone);
    good(box.run({"generate", "random", "-n", "4", "-m", "2", "-s", "8", "-o", "c{seed}.npy"}));
    EXPECT_THAT(box.read("c9.npy"), HasSubstr("(4, 2)"));
    good(box.run({"warp", "owen", "b.csv", "-m", "2", "-s", "7", "-o", "o{seed}.csv"}));
    EXPECT_TRUE(box.exists("o7.csv") && box.exists("o8.csv"));
    EXPECT_EQ(box.run({"convert", "-o", "d{seed}.csv"}, "set,x,y\n0,.1,.2\n1,.3,.4\n").err,
              "stipple: --output: sets 0 and 1 both have the seed 1, and would be one file; use "
              "{set}\n");
    EXPECT_FALSE(box.exists("d1.csv"));
}

TEST(Generate, UnseededGeneratorsSayThatAllSetsAreTheSame) {
    const Sandbox box;
    const Outcome outcome = box.run({"generate", "halton", "-n", "2", "-m", "2"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("does not use the seed"));
    EXPECT_EQ(box.run({"generate", "halton", "-n", "2", "-m", "2", "--quiet"}).err, "");
}

TEST(Generate, ARandomSeedIsSaidAndMakesTheSetAgain) {
    const Sandbox box;
    const Outcome first = box.run({"generate", "random", "-n", "4", "--seed", "random"});
    ASSERT_EQ(first.code, 0);
    ASSERT_TRUE(first.err.starts_with("stipple: --seed ")) << first.err;
    const std::string seed = first.err.substr(16, first.err.size() - 17);
    EXPECT_EQ(good(box.run({"generate", "random", "-n", "4", "--seed", seed})), first.out);
}

TEST(Generate, BoundsScaleToAHalfOpenBox) {
    const Sandbox box;
    const auto out = good(
        box.run({"generate", "random", "-n", "2000", "--bounds", "-1..3,10..10.5", "-f", "json"}));
    const auto points = json::parse(out);
    EXPECT_EQ(points["meta"]["domain"], "box:bounds=[-1..3,10..10.5]");
    for (const auto& p : points["points"]) {
        EXPECT_TRUE(p[0] >= -1 && p[0] < 3);
        EXPECT_TRUE(p[1] >= 10 && p[1] < 10.5);
    }
}

TEST(Generate, JsonHoldsTheWholeProvenance) {
    const Sandbox box;
    const auto out =
        json::parse(good(box.run({"generate", "halton", "-n", "3", "--start", "1", "-w",
                                  "disk:method=concentric,center=[1,0]", "-f", "json"})));
    EXPECT_EQ(out["format"], "stipple.points");
    EXPECT_EQ(out["version"], 1);
    EXPECT_EQ(out["dimension"], 2);
    EXPECT_EQ(out["count"], 3);
    EXPECT_EQ(out["points"].size(), 3U);
    const auto& meta = out["meta"];
    for (const char* key : {"tool", "version", "generator", "options", "seed", "count", "dimension",
                            "start", "warps", "domain", "command"})
        EXPECT_TRUE(meta.contains(key)) << key;
    EXPECT_EQ(meta["tool"], "stipple");
    EXPECT_EQ(meta["generator"], "halton");
    EXPECT_EQ(meta["start"], 1);
    EXPECT_EQ(meta["warps"], json::array({"disk:method=concentric,center=[1,0]"}));
    EXPECT_EQ(meta["domain"], "disk:center=[1,0]");
    // The command in the provenance makes the same bytes.
    const Outcome again = box.shell(meta["command"].get<std::string>());
    EXPECT_EQ(json::parse(good(again)), out);
}

TEST(Generate, MetaStandsOnTopOfTextAndIsReadBack) {
    const Sandbox box;
    const auto out = good(box.run({"generate", "halton", "-n", "50", "-w", "disk", "--meta"}));
    EXPECT_TRUE(out.starts_with("# ")) << out;
    EXPECT_THAT(out, HasSubstr("# generator: \"halton\""));
    const Outcome judged = box.run({"analyze", "chi-square"}, out);
    EXPECT_EQ(judged.code, 0) << judged.err;
    EXPECT_EQ(json::parse(judged.out)["input"]["domain"], "disk");
}

TEST(Generate, AWarpOnSomeCoordinatesLeavesTheOthers) {
    const Sandbox box;
    const auto plain =
        json::parse(good(box.run({"generate", "halton", "-n", "9", "-d", "5", "-f", "json"})));
    const auto warped = json::parse(good(
        box.run({"generate", "halton", "-n", "9", "-d", "5", "-w", "disk@4,5", "-f", "json"})));
    const auto disk = json::parse(good(box.run({"warp", "disk@4,5", "-f", "json"}, plain.dump())));
    EXPECT_EQ(warped["points"], disk["points"]);
    EXPECT_EQ(warped["meta"]["domain"], "disk@4,5 x unit-cube@1,2,3");
    for (std::size_t i = 0; i < 9; ++i)
        for (std::size_t k = 0; k < 3; ++k)
            EXPECT_EQ(warped["points"][i][k], plain["points"][i][k]);
}

// If a file has a domain, it determines which coordinates can be warped; otherwise other
// coordinates are not checked.
TEST(Generate, AWarpAsksNothingOfCoordinatesItLeaves) {
    const Sandbox box;
    const std::vector<std::string> random = {"generate", "random", "-n", "50", "-d", "5", "-f"};
    const auto with = [&](std::vector<std::string> more) {
        auto words = random;
        words.insert(words.end(), more.begin(), more.end());
        return good(box.run(words));
    };
    const std::string pixel = "pixel@1,2:resolution=4x3";
    const auto at_once = json::parse(with({"json", "-w", "disk@4,5", "-w", pixel, "--with-pdf"}));
    const std::string disk = with({"json", "-w", "disk@4,5"});
    const auto later =
        json::parse(good(box.run({"warp", pixel, "-f", "json", "--with-pdf"}, disk)));
    EXPECT_EQ(later["points"], at_once["points"]);
    EXPECT_EQ(later["meta"]["domain"], at_once["meta"]["domain"]);
    EXPECT_EQ(good(box.run({"warp", pixel}, with({"csv", "-w", "disk@4,5"}))),
              with({"csv", "-w", "disk@4,5", "-w", pixel}));
    EXPECT_EQ(box.run({"warp", "sphere@3,4"}, disk).err,
              "stipple: warp sphere: coordinate 4 is already on another domain; it takes "
              "coordinates of the unit cube\n");
    // A warp with more numbers per point shifts the domains of the coordinates after it.
    const auto back = with({"json", "-w", "disk@4,5", "-w", pixel});
    EXPECT_EQ(json::parse(good(
                  box.run({"warp", pixel, "--inverse", "-f", "json"}, back)))["meta"]["domain"],
              "disk@4,5 x unit-cube@1,2,3");
    const auto moved = json::parse(good(box.run({"warp", "sphere@1,2", "-f", "json"}, disk)));
    EXPECT_EQ(moved["meta"]["domain"], "disk@5,6 x sphere@1,2,3 x unit-cube@4");
    box.write("two.json", good(box.run({"warp", pixel, "-f", "json"}, disk)));
    EXPECT_EQ(box.run({"reproduce", "two.json"}).code, 0);

    const std::string timed = "x,y,t\n0.1,0.2,7\n";
    EXPECT_EQ(good(box.run({"warp", "tent@1:radius=1"}, timed)).substr(6),
              "-0.5527864045000421,0.2,7\n");
    const auto unsaid = json::parse(good(box.run({"warp", "disk@1,2", "-f", "json"}, timed)));
    EXPECT_EQ(unsaid["meta"]["domain"], "");
    EXPECT_EQ(box.run({"warp", "owen@1,2"}, timed).code, 0);
    EXPECT_EQ(box.run({"warp", "disk@2,3", "-f", "json"}, timed).err,
              "stipple: 1 of 1 points are outside the unit cube [0, 1]^2 in coordinates 2,3; the "
              "first is point 0: (0.2, 7)\n");
}

// --start is only suggested for generate; other verbs do not have it.
TEST(Generate, AnInfiniteDensityIsHintedAtWhereThatHelps) {
    const Sandbox box;
    const std::vector<std::string> naive = {"disk:method=naive", "--with-pdf"};
    EXPECT_EQ(box.run({"warp", naive[0], naive[1]}, "0,0\n").err,
              "stipple: --with-pdf: the value at the point (0, 0) is infinite\n");
    EXPECT_TRUE(box.run({"generate", "halton", "-n", "3", "-d", "2", "-w", naive[0], naive[1]})
                    .err.ends_with(
                        "(0, 0) is infinite; --start 1 leaves out a sequence's first point, where "
                        "coordinates are 0\n"));
}

TEST(Generate, RejectionSaysHowManyPointsItKept) {
    const Sandbox box;
    const Outcome outcome =
        box.run({"generate", "random", "-n", "1000", "-w", "disk:method=rejection", "--no-header"});
    EXPECT_EQ(outcome.code, 0);
    const auto kept = std::ranges::count(outcome.out, '\n');
    EXPECT_THAT(outcome.err,
                HasSubstr("kept " + std::to_string(kept) + " of 1000 points (efficiency 0.8"));
    const json meta = json::parse(
        box.run({"generate", "random", "-n", "1000", "-w", "disk:method=rejection", "-f", "json"})
            .out)["meta"];
    EXPECT_EQ(meta["efficiency"], static_cast<double>(kept) / 1000);
    EXPECT_EQ(meta["count"], kept);
    // Without dropped points there is no note: the centre of the square is in the disk.
    EXPECT_EQ(
        box.run({"generate", "halton", "--start", "1", "-n", "1", "-w", "disk:method=rejection"})
            .err,
        "");
}

// Options are checked against the given box, not the unit cube; it also determines the dimension.
TEST(Generate, RadiiHoldInTheBox) {
    const Sandbox box;
    const auto run = [&](const std::string& radius, const std::string& bounds) {
        return box.run(
            {"generate", "poisson-disk", "--radius", radius, "--bounds", bounds, "-f", "json"});
    };
    EXPECT_GT(json::parse(good(run("5", "0..40,0..30")))["points"].size(), 20U);
    EXPECT_GT(json::parse(good(run("5", "0..40")))["points"].size(), 30U);
    EXPECT_EQ(json::parse(good(run("2", "0..4,0..5,0..6")))["meta"]["dimension"], 3);
    EXPECT_EQ(run("51", "0..40,0..30").code, 2);
    EXPECT_THAT(run("0.8", "0..0.4,0..0.3").err,
                HasSubstr("--radius: 0.8 is outside (0, 0.5]; no two points of the box"));
}

// The mean of the weights estimates the area, exactly if the density is constant.
TEST(Generate, WeightIsOneOverDensity) {
    const Sandbox box;
    EXPECT_EQ(good(box.run({"generate", "halton", "-n", "2", "-w", "triangle", "--with-pdf",
                            "--with-weight"})),
              "x,y,pdf,weight\n0,0,2,0.5\n0.23570226039551584,0.4714045207910318,2,0.5\n");
    EXPECT_EQ(good(box.run({"generate", "grid", "-n", "1", "--bounds", "0..4,0..2", "--with-weight",
                            "--with-pdf"})),
              "x,y,pdf,weight\n2,1,0.125,8\n");
    const std::string disks = good(box.run({"generate", "poisson-disk", "-n", "5", "--bounds",
                                            "0..4,0..2", "--with-weight", "--no-header"}));
    EXPECT_THAT(disks, ::testing::EndsWith(",8\n"));
    EXPECT_THAT(box.run({"warp", "triangle", "--inverse", "--with-weight"}, "0.1,0.2\n").err,
                HasSubstr("--with-weight: the inverse gives points of the unit cube"));
}

// Points do not move; the density is 0 outside the domain, also of coordinates that are not warped.
// A density on the square times that of the sphere: 2 x / (4 pi), where x is the first coordinate.
TEST(Warp, DensitiesOfPointsGoAlong) {
    const Sandbox box;
    box.write("p.csv", "x,y,pdf\n0.5,0.5,1\n0.25,0.5,0.5\n0.75,0.1,1.5\n");
    box.write("w.csv", "x,y,weight\n0.5,0.5,1\n0.25,0.5,2\n");
    box.write("q.csv", "x,y,z,pdf\n0.5,0.5,0.1,1\n");
    box.write("both.csv", "x,y,pdf,weight\n0.25,0.5,0.5,2\n");
    const auto last = [&](const std::string& line) {
        std::vector<double> numbers;
        std::istringstream rows(good(box.shell(line + " --no-header")));
        for (std::string row; std::getline(rows, row);)
            numbers.push_back(std::stod(row.substr(row.rfind(',') + 1)));
        return numbers;
    };
    const double sphere = 1 / (4 * std::numbers::pi);
    const auto expect = [&](const std::vector<double>& seen, const std::vector<double>& right) {
        ASSERT_EQ(seen.size(), right.size());
        for (std::size_t i = 0; i < seen.size(); ++i)
            EXPECT_NEAR(seen[i], right[i], 1e-14 * right[i]);
    };
    expect(last("stipple warp sphere p.csv"), {sphere, sphere / 2, 1.5 * sphere});
    expect(last("stipple warp sphere < p.csv"), {sphere, sphere / 2, 1.5 * sphere});
    expect(last("stipple warp sphere w.csv"), {1 / sphere, 2 / sphere});
    expect(last("stipple warp sphere both.csv"), {2 / sphere});
    expect(last("stipple warp sphere p.csv -f json | stipple warp sphere --inverse - -f csv"),
           {1, 0.5, 1.5});
    // The densities of other coordinates remain in the column.
    good(box.shell("stipple generate random -n 3 -d 3 -w normal@3 --with-pdf -f json -o n.json"));
    expect(last("stipple warp disk n.json --coordinates 1,2 -f json | "
                "stipple warp disk --coordinates 1,2 --inverse - -f csv"),
           last("stipple convert n.json --column 4 -f csv --quiet"));
    for (const char* refused : {"rejection --density '1+x*y' q.csv", "owen p.csv"})
        expect_refusal(box.shell(std::string("stipple warp ") + refused), 3,
                       "the points have a column of densities");
    good(box.shell("stipple warp owen p.csv --column x,y -o o.csv"));
}

TEST(Warp, TellsItsDensityAtGivenPoints) {
    const Sandbox box;
    const auto at = [&](const std::vector<std::string>& warp, const std::string& points) {
        std::vector<std::string> words{"warp"};
        words.insert(words.end(), warp.begin(), warp.end());
        words.insert(words.end(), {"--density-at", "--no-header"});
        return box.run(words, points);
    };
    EXPECT_EQ(good(at({"disk", "--radius", "2"}, "0,1\n2,2\n2,0\n-9,0\n")),
              "0,1,0.07957747154594767\n2,2,0\n2,0,0.07957747154594767\n-9,0,0\n");
    EXPECT_EQ(good(at({"disk", "--method", "naive"}, "0.5,0\n1.5,0\n")),
              "0.5,0,0.3183098861837907\n1.5,0,0\n");
    EXPECT_EQ(good(at({"sphere"}, "0,0,1\n0,0,0.5\n")), "0,0,1,0.07957747154594767\n0,0,0.5,0\n");
    EXPECT_EQ(good(at({"disk", "--coordinates", "1,2"}, "0,0,0.5\n0,0,1.5\n3,0,0.5\n")),
              "0,0,0.5,0.3183098861837907\n0,0,1.5,0\n3,0,0.5,0\n");
    EXPECT_EQ(good(at({"circle", "--method", "square-normalize"}, "1,0\n0,0\n")).substr(0, 4),
              "1,0,");
    EXPECT_EQ(good(box.shell("stipple generate random -n 300000 -w disk | stipple warp disk "
                             "--density-at | cksum")),
              good(box.shell("stipple generate random -n 300000 -w disk --with-pdf | cksum")));
    // Other coordinates keep the domain of the file. A set with an added column cannot be
    // reproduced from the recipe for its points.
    good(
        box.shell("stipple generate halton -n 5 -d 4 --start 1 -w sphere@1,2 -o on.json && stipple "
                  "warp exponential@4 on.json --density-at -o at.json"));
    const json on = json::parse(box.read("at.json"));
    for (const auto& row : on["points"])
        EXPECT_NEAR(row[5].get<double>() * 4 * std::numbers::pi, std::exp(-row[3].get<double>()),
                    1e-14)
            << row;
    EXPECT_EQ(box.shell("stipple reproduce at.json").code, 3);
    EXPECT_EQ(at({"disk"}, "1,2,3\n").code, 3);
    EXPECT_THAT(at({"disk", "--inverse"}, "1,2\n").err,
                HasSubstr("leaves the points where they are"));
    EXPECT_THAT(at({"owen"}, "0.1,0.2\n").err, HasSubstr("is a scramble"));
    EXPECT_EQ(at({"power", "--exponent", "-1/2"}, "0\n").code, 3);
}

// Seeds beyond the last one repeat the numbers of others, or give zeros.
TEST(Generate, RefusesSetsBeyondTheLastSeedOfAnEngine) {
    const Sandbox box;
    const std::string last = "stipple generate random --rng ranmar -n 1 -s 942438976 -m ";
    good(box.shell(last + "2"));
    EXPECT_EQ(
        box.shell(last + "3").err,
        "stipple: --seed: 942438976 and 3 sets go beyond 942438977, the last seed of random\n");
}

// The vector found by a search can be read by other packages and by --vector-file, and is in the
// provenance.
TEST(Generate, WritesVectorsAsOtherPackagesDo) {
    const Sandbox box;
    for (const std::string lattice : {"rank1-lattice --rule cbc", "polynomial-lattice"})
        for (const std::string form : {"lddata", "latnet-builder"}) {
            SCOPED_TRACE(lattice + form);
            const std::string make = "stipple generate " + lattice + " -q -n 256 -d 4 ";
            good(box.shell(make + "--vector-output v.txt --vector-format " + form + " -o p.json"));
            const json meta = json::parse(box.read("p.json"))["meta"];
            EXPECT_EQ(meta["options"]["rule"], "cbc");
            std::string vector = meta["found"]["vector"];
            EXPECT_GT(meta["found"]["squared_error"].get<double>(), 0);
            const std::string scramble = lattice == "polynomial-lattice" ? " --scramble owen" : "";
            EXPECT_EQ(box.shell("stipple generate " + lattice + scramble + " -n 256 -d 4").err,
                      fmt::format("stipple: note: {}: found generating vector {}, figure of merit "
                                  "{} (squared worst-case error)\n",
                                  meta["generator"].get<std::string>(), vector,
                                  meta["found"]["squared_error"].dump()));
            std::ranges::replace(vector, ',', '\n');
            EXPECT_TRUE(box.read("v.txt").ends_with("\n" + vector + "\n")) << box.read("v.txt");
            const std::string name = lattice.substr(0, lattice.find(' '));
            const std::string given = "stipple generate " + name + " --vector-file v.txt ";
            EXPECT_EQ(good(box.shell(given)), good(box.shell(make)));
            good(box.shell(given + "--vector-output w.txt --vector-format " + form + " -o q.json"));
            EXPECT_EQ(box.read("w.txt"), box.read("v.txt"));
            EXPECT_EQ(json::parse(box.read("q.json"))["meta"]["options"]["rule"], "vector");
            EXPECT_FALSE(json::parse(box.read("q.json"))["meta"].contains("found"));
        }
    good(box.shell("stipple generate rank1-lattice --rule fibonacci --vector-output f.txt"));
    EXPECT_EQ(box.read("f.txt"), "# lattice\n2  # dimensions\n987  # points\n1\n610\n");
    box.write("i.txt",
              "# Parameters for a polynomial lattice rule in base 2\n1  # dimensions\n2  # "
              "Interlacing factor\n2  # Number of components\n3  # m, of 2^m points\n11  # "
              "modulus\n1\n5\n");
    const std::string interlaced =
        "stipple generate polynomial-lattice --vector-file i.txt --vector-output j.txt ";
    good(box.shell(interlaced + "--vector-format latnet-builder"));
    EXPECT_EQ(box.read("j.txt"), box.read("i.txt"));
    expect_refusal(box.shell(interlaced), 2, "lddata cannot hold interlaced lattices");
    expect_refusal(box.shell("stipple generate rank1-lattice --vector-format lddata"), 2,
                   "--vector-format applies to --vector-output only; give that too");
    expect_refusal(box.shell("stipple generate rank1-lattice --vector-output p.csv -o p.csv"), 2,
                   "is already the output for the points");
}

TEST(Generate, SinglePrecisionNeverHoldsOne) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "1e6", "-d", "1", "-o", "p.f32"}));
    const std::string bytes = box.read("p.f32");
    ASSERT_EQ(bytes.size(), 4'000'000U);
    for (std::size_t i = 0; i < bytes.size(); i += 4) {
        float x = 0;
        std::memcpy(&x, &bytes[i], 4);
        ASSERT_LT(x, 1.0F);
    }
}

TEST(Generate, PrecisionCutsAndNeverRoundsUpToOne) {
    const Sandbox box;
    const auto out = good(box.run(
        {"generate", "halton", "--start", "1023", "-n", "1", "-d", "1", "--precision", "2"}));
    EXPECT_EQ(out, "x\n0.99\n");
}

TEST(Generate, PoissonDiskPutsItsRadiusIntoTheProvenance) {
    const Sandbox box;
    const auto out =
        json::parse(good(box.run({"generate", "poisson-disk", "-n", "200", "-f", "json"})));
    EXPECT_EQ(out["count"], 200);
    EXPECT_GT(out["meta"]["options"]["radius"].get<double>(), 0.04);
}

// Provenance of several sets is true for all of them: their seeds are consecutive, and it has a
// radius only if one was given.
TEST(Generate, TellsOfSeveralSetsWhatIsTrueOfAll) {
    const Sandbox box;
    const auto options = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words = {"generate", "poisson-disk", "-f",
                                          "json",     "--order",      "progressive"};
        words.insert(words.end(), more.begin(), more.end());
        return json::parse(good(box.run(words)))["meta"]["options"];
    };
    const auto several = options({"-n", "50", "-m", "3"});
    EXPECT_FALSE(several.contains("radius"));
    EXPECT_EQ(several["order"], "progressive");
    EXPECT_EQ(options({"--radius", "0.1", "-m", "3"})["radius"], 0.1);
    good(box.run({"generate", "poisson-disk", "-n", "50", "-m", "2", "-o", "p{set}.json"}));
    for (const char* name : {"p0.json", "p1.json"})
        EXPECT_TRUE(json::parse(box.read(name))["meta"]["options"].contains("radius")) << name;
}

TEST(Generate, AClosedPipeIsNoError) {
    const Sandbox box;
    const Outcome outcome = box.shell("stipple generate random -n 1e9 -f bin | head -c 16 | wc -c");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "16\n");
    EXPECT_EQ(outcome.err, "");
}

// Sets are made one after the other, for any number of sets.
TEST(Generate, BeginsWithManySetsAtOnce) {
    SKIP_WITHOUT("/proc/self/fd");
    if (sanitized()) GTEST_SKIP() << "sanitizers need memory of their own";
    const Sandbox box;
    for (const char* generator : {"random", "poisson-disk"}) {
        const std::string one = std::string("stipple generate ") + generator + " -n 8 -m ";
        EXPECT_EQ(good(box.shell("ulimit -v 500000; " + one + "1e9 | head -n 40")),
                  good(box.shell(one + "5 | head -n 40")))
            << generator;
    }
    const Outcome files = box.shell(
        "ulimit -v 500000; stipple generate random -n 8 -m 1e9 -o 'x{set}.csv' & until find -L "
        "/proc/$!/fd -type f -links 0 -print -quit | grep -q .; do sleep 0.01; done; kill -INT $!; "
        "wait $!");
    EXPECT_EQ(files.code, 130);
    EXPECT_EQ(box.files(), std::vector<std::string>{});
    good(box.run({"generate", "random", "-n", "8", "-m", "2", "-o", "x{set}.csv"}));
    EXPECT_EQ(box.read("x1.csv"), good(box.shell("stipple generate random -n 8 --seed 2")));
}

// A limit on the address space lets fewer threads start than requested.
TEST(Generate, GoesOnWithTheThreadsThatStart) {
    if (sanitized()) GTEST_SKIP() << "sanitizers need memory of their own";
    const Sandbox box;
    if (box.shell("ulimit -v 500000").code != 0)
        GTEST_SKIP() << "this system does not limit address spaces";
    const std::string all = good(box.shell("stipple generate poisson-disk -n 20000 | cksum"));
    for (const char* threads : {"8", "32", "64"})
        EXPECT_EQ(good(box.shell("ulimit -v 500000; stipple generate poisson-disk -n 20000 "
                                 "--threads " +
                                 std::string(threads) + " | cksum")),
                  all);
}

TEST(Generate, TakesSharedOptionsBeforeTheVerb) {
    const Sandbox box;
    const std::string points = good(box.run({"generate", "halton", "-n", "4", "-f", "txt"}));
    for (const char* words :
         {"-q generate halton -n 4 -f txt", "-n 4 --quiet --format=txt generate halton",
          "--threads 2 -f txt -n 4 generate halton"})
        EXPECT_EQ(good(box.shell(std::string("stipple ") + words)), points) << words;
    ASSERT_EQ(good(box.shell("stipple -q -o list generate halton -n 4 -f txt")), "");
    EXPECT_EQ(box.read("list"), points);
    expect_refusal(box.shell("stipple --scramble owen generate halton"), 2,
                   "--scramble: options follow the verb, such as 'stipple generate halton -n 16'");
    expect_refusal(box.shell("stipple -q"), 2, "unknown option '-q'");
}

// The bar of many searches shows how long they will take, not the quality of each.
TEST(Generate, SaysHowLongManySearchesWillTake) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple generate optimized -n 64 -m 1e9 -o p.csv --progress always 2> err & until [ "
        "$(stat -c %s err) -gt 1000 ]; do kill -0 $! || break; sleep 0.02; done; kill -INT $!; "
        "wait "
        "$!; code=$?; grep -c best err; grep -Eqs '[0-9] (days|years) left' err && exit $code");
    EXPECT_EQ(outcome.code, 130);
    EXPECT_EQ(outcome.out, "0\n");
}

// Scripts must not go on with points of an interrupted search, although it writes them.
TEST(Generate, WritesTheBestPointsOfAnInterruptedSearchAndExits130) {
    const Sandbox box;
    for (const std::string search :
         {"optimized -n 100 --effort", "latin-hypercube -n 60 --optimize maximin --effort"}) {
        const Outcome outcome = box.shell(
            "stipple generate " + search +
            " 1000 -o p.csv --progress always 2> err & until grep -qs best err; do kill -0 $! || "
            "break; sleep 0.02; done; kill -INT $!; wait $!; code=$?; tr '\\r' '\\n' < err | sed "
            "-n "
            "'s/.*stipple:/stipple:/p' >&2; rm err; exit $code");
        EXPECT_EQ(outcome.code, 130) << search;
        EXPECT_TRUE(outcome.err.starts_with("stipple: note: interrupted: ")) << outcome.err;
        EXPECT_TRUE(outcome.err.ends_with(" so far\n")) << outcome.err;
        EXPECT_GE(std::ranges::count(box.read("p.csv"), '\n'), 61) << search;
    }
}

// Sanitizers change the use of memory.
TEST(Generate, StreamsInLittleMemory) {
    if (sanitized()) GTEST_SKIP() << "sanitizers need memory of their own";
    const Sandbox box;
    for (const char* words : {"random -n 2e7 -f bin", "lloyd --iterations 0 -n 400 -m 9000 -f npy",
                              "lloyd --iterations 0 -n 400 -m 9000 -f json",
                              "lloyd --iterations 0 -n 400 -m 9000 -f csv --meta",
                              "optimized -n 600 -d 3 --effort 1e-4 --threads 1 -f npy"}) {
        const Outcome outcome =
            box.shell(std::string("python3 -c 'import resource, subprocess, sys\n"
                                  "p = subprocess.run([\"stipple\", \"generate\", *sys.argv[1:]],"
                                  " stdout=subprocess.DEVNULL)\n"
                                  "most = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss\n"
                                  "print(most // 1024 if sys.platform == \"darwin\" else most)\n"
                                  "sys.exit(p.returncode)' ") +
                      words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_LT(std::stol(outcome.out), 60'000) << "KiB: " << words;
    }
}

// The header, written before the first set, describes all sets.
TEST(Generate, SetsOfOneFileAreThoseOfAFileEach) {
    const Sandbox box;
    const std::string generate = "stipple generate poisson-disk --radius 0.1 --seed 3 -m 4 ";
    const auto sets = json::parse(good(box.shell(generate + "-f json")));
    good(box.shell(generate + "-o 's{set}.json'"));
    ASSERT_EQ(sets["sets"].size(), 4U);
    for (std::size_t set = 0; set < 4; ++set) {
        const auto alone = json::parse(box.read("s" + std::to_string(set) + ".json"));
        EXPECT_EQ(sets["sets"][set], alone["points"]) << set;
        EXPECT_EQ(sets["count"][set], alone["count"]) << set;
    }
    const std::string scrambled = "stipple generate halton -n 3000 | stipple warp owen -m 2 -f ";
    const auto both = json::parse(good(box.shell(scrambled + "json")))["sets"];
    EXPECT_EQ(both.dump(),
              json::parse(good(box.shell(scrambled + "json | stipple convert -f npy | "
                                                     "stipple convert -f json")))["sets"]
                  .dump());
    EXPECT_NE(both[0], both[1]);
    const Outcome full =
        box.shell("ulimit -f 20; stipple generate lloyd --iterations 0 -n 2500 -m 2 -f npy | cat");
    expect_refusal(full, 4, "a temporary file in ");
}

// More files than the limit on open files.
TEST(Generate, ManyFilesAppearTogether) {
    const Sandbox box;
    const std::string lines = "ulimit -n 90; stipple generate random -n 1 -m 200 -o ";
    good(box.shell(lines + "'x{set}.csv'"));
    EXPECT_EQ(box.files().size(), 200U);
    for (const int set : {0, 100, 199})
        EXPECT_EQ(box.read("x" + std::to_string(set) + ".csv"),
                  good(box.shell("stipple generate random -n 1 -s " + std::to_string(set + 1))));
    good(box.shell("rm x*; mkdir y150.csv"));
    const Outcome failed = box.shell(lines + "'y{set}.csv'");
    EXPECT_EQ(failed.code, 4) << failed.err;
    EXPECT_EQ(box.files(), std::vector<std::string>{"y150.csv"});
}

TEST(Generate, TakesTheOtherNamesOfAUnit) {
    const Sandbox box;
    const Outcome alias = box.run({"generate", "regular", "--cell", "corner", "-n", "9", "--meta"});
    EXPECT_EQ(alias.code, 0) << alias.err;
    EXPECT_THAT(alias.out, HasSubstr("# generator: \"grid\""));
    EXPECT_THAT(box.run({"generate", "regular", "--help"}).out, HasSubstr("Also called regular"));
    EXPECT_THAT(box.run({"list", "generators", "--long"}).out, HasSubstr("also called regular"));
}

// SciPy adds digits divided by powers of the base, with rounding errors; ours are the nearest
// doubles. The tolerance is about two errors of 2^-53 each.
TEST(Generate, HaltonAgreesWithSciPyToItsRounding) {
    const Sandbox box;
    good(box.run({"generate", "halton", "-n", "65536", "-d", "20", "-o", "a.npy"}));
    good(box.shell(
        "/usr/bin/python3 -c 'import numpy as np; from scipy.stats import qmc;"
        " a = np.load(\"a.npy\"); b = qmc.Halton(20, scramble=False).random(65536);"
        " assert a.shape == b.shape and abs(a - b).max() < 4e-16 and (a == b).mean() > 0.5'"));
}

// The density x^2 is 0 at 0, Sobol's first point; no reader accepts an infinite weight.
TEST(Generate, RefusesColumnsThatNoReaderTakes) {
    const Sandbox box;
    const auto run = [&](const char* start) {
        return box.run({"generate", "sobol", "-n", "2", "-d", "1", "-w", "power:exponent=2",
                        "--with-weight", "--start", start});
    };
    const Outcome refused = run("0");
    EXPECT_EQ(refused.code, 3);
    EXPECT_THAT(refused.err, HasSubstr("--with-weight: the value at the point (0) is infinite"));
    EXPECT_EQ(run("1").code, 0);
}

// A spec is a unit with its options in one word; it is accepted everywhere in place of a unit.
TEST(Generate, SpecsAreTakenWhereverAUnitIsNamed) {
    const Sandbox box;
    const auto same = [&](const std::vector<std::string>& spec,
                          const std::vector<std::string>& plain, const std::string& input) {
        EXPECT_EQ(good(box.run(spec, input)), good(box.run(plain, input))) << spec[1];
    };
    const std::string points = "0.25,0.5\n0.75,0.125\n";
    same({"generate", "sobol:scramble=owen", "-n", "4", "--meta"},
         {"generate", "sobol", "-n", "4", "--meta", "--scramble", "owen"}, "");
    same({"warp", "disk:radius=2,center=[1,0]"},
         {"warp", "disk", "--radius", "2", "--center", "1,0"}, points);
    same({"warp", "power@2:exponent=1"}, {"warp", "power", "--coordinates", "2", "--exponent", "1"},
         points);
    same({"warp", "owen:seed=7"}, {"warp", "owen", "--seed", "7"}, points);
    const std::string one = good(box.run({"analyze", "l2-discrepancy:kind=centered"}, points));
    EXPECT_NE(one.find("\"centered\""), std::string::npos);
    EXPECT_EQ(one.find("\"wraparound\""), std::string::npos);
    EXPECT_NE(
        box.run({"generate", "sobol@1:scramble=owen"}).err.find("only warps and scrambles take"),
        std::string::npos);
    EXPECT_NE(box.run({"generate", "sobol:scrmble=owen"}).err.find("did you mean 'scramble'?"),
              std::string::npos);
}

// Only coordinates that are not warped are scaled; the others are unchanged.
TEST(Generate, BoundsAreOfTheCoordinatesThatNoWarpTakes) {
    const Sandbox box;
    const auto rows = [&](const std::string& words) {
        return nlohmann::json::parse(good(box.shell("stipple generate " + words + " -f json")));
    };
    for (const std::string generator : {"halton -n 50", "jittered -n 64", "poisson-disk -n 40"}) {
        const std::string warped = generator + " -d 3 -w disk@1,2";
        const auto plain = rows(warped);
        const auto scaled = rows(warped + " --bounds -2..8");
        EXPECT_EQ(scaled["meta"]["domain"], "disk@1,2 x box@3:bounds=[-2..8]");
        EXPECT_EQ(scaled["meta"]["bounds"], "0..1,0..1,-2..8");
        if (generator.starts_with("poisson")) continue;  // its distances depend on the box
        for (std::size_t i = 0; i < plain["points"].size(); ++i) {
            EXPECT_EQ(scaled["points"][i][0], plain["points"][i][0]);
            EXPECT_EQ(scaled["points"][i][1], plain["points"][i][1]);
            EXPECT_EQ(scaled["points"][i][2], -2 + 10 * plain["points"][i][2].get<double>());
        }
    }
    // A warp with more numbers per point shifts the coordinates after it.
    const auto moved = rows("halton -n 9 -d 4 -w sphere@2,3 --bounds 5..6,10..20");
    EXPECT_EQ(moved["meta"]["domain"],
              "sphere@2,3,4 x box@1:bounds=[5..6] x box@5:bounds=[10..20]");
    for (const auto& point : moved["points"]) {
        EXPECT_GE(point[0], 5);
        EXPECT_GE(point[4], 10);
    }
    // A scramble leaves all coordinates in the cube.
    const auto owen = rows("sobol -n 8 -w owen --bounds 0..5");
    EXPECT_EQ(owen["meta"]["domain"], "box@1:bounds=[0..5] x box@2:bounds=[0..5]");
    EXPECT_EQ(
        good(box.shell("stipple generate halton -n 4 -d 3 -w disk@1,2 --bounds 0..4 --with-pdf | "
                       "cut -d, -f4 | tail -n 1")),
        "0.07957747154594767\n");  // 1 / (4 pi)
    good(
        box.shell("stipple generate halton -n 50 -d 3 -w disk@1,2 --bounds 0..4 -o a.json && "
                  "stipple reproduce a.json && stipple analyze moments a.json -o m.json"));
    expect_refusal(box.shell("stipple generate halton -w disk --bounds 0..4"), 2,
                   "the warps take all coordinates");
    expect_refusal(box.shell("stipple generate halton -d 5 -w disk@1,2 --bounds 0..4,0..5"), 2,
                   "--bounds");
    expect_refusal(box.shell("stipple generate poisson-disk -n 9 -w owen --bounds 0..4"), 2,
                   "poisson-disk measures its distances in the box");
}

// Products of some of the sides are no doubles, though that of all is.
TEST(Generate, DensitiesInBoundsAreDoubles) {
    const Sandbox box;
    for (const char* column : {"--with-pdf", "--with-weight"}) {
        const auto in = [&](const char* bounds) {
            return box.run(
                {"generate", "random", "-n", "1", "-d", "4", "--bounds", bounds, column});
        };
        for (const char* bounds :
             {"0..1e-200,0..1e-200,0..1e200,0..1e200", "0..1e200,0..1e200,0..1e-200,0..1e-200"}) {
            const std::string out = good(in(bounds));
            EXPECT_NEAR(std::stod(out.substr(out.rfind(',') + 1)), 1, 1e-15) << bounds;
        }
        for (const char* bounds : {"0..1e-100", "0..1e100"})
            EXPECT_EQ(in(bounds).err, std::string("stipple: ") + column +
                                          ": the volume of the bounds is beyond float64\n");
    }
}

}  // namespace stipple::testing::generate_test
