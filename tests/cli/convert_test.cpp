// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.hpp"

namespace stipple::testing::convert_test {

using ::testing::HasSubstr;

// Shortest digits and float64 binaries lose nothing, so the way round all formats ends where it
// began.
TEST(Convert, AWayRoundAllFormatsLosesNothing) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "500", "-d", "3", "-o", "a.csv"}));
    good(box.run({"convert", "a.csv", "-o", "b.txt"}));
    good(box.run({"convert", "b.txt", "-o", "c.json"}));
    good(box.run({"convert", "c.json", "-o", "d.npy"}));
    good(box.run({"convert", "d.npy", "-o", "e.jsonl"}));
    good(box.run({"convert", "e.jsonl", "-o", "f.bin"}));
    good(box.run({"convert", "f.bin", "-d", "3", "-o", "g.csv"}));
    EXPECT_EQ(box.read("g.csv"), box.read("a.csv"));
}

TEST(Convert, SaysThatItLeavesRowNamesOut) {
    const Sandbox box;
    box.write("r.csv", "\"\",\"x\",\"y\"\n\"1\",0.5,0.25\n\"2\",0.125,0\n");
    for (const char* from :
         {"stipple convert r.csv -f csv", "cat r.csv | stipple convert -f csv"}) {
        const Outcome outcome = box.shell(from);
        EXPECT_EQ(outcome.code, 0);
        EXPECT_EQ(outcome.out, "x,y\n0.5,0.25\n0.125,0\n");
        EXPECT_THAT(outcome.err, HasSubstr("the first column has no name: it holds row names"));
    }
}

TEST(Convert, NumberTypesOfInputAndOutputAreToldApart) {
    const Sandbox box;
    good(box.run({"generate", "halton", "-n", "8", "--output-dtype", "f32", "-o", "a.bin"}));
    good(box.run({"convert", "a.bin", "-d", "2", "--input-dtype", "f32", "-o", "b.bin"}));
    EXPECT_EQ(box.read("a.bin").size(), 64U);
    EXPECT_EQ(box.read("b.bin").size(), 128U);
    good(box.run({"convert", "b.bin", "-d", "2", "--output-dtype", "f32", "-o", "c.bin"}));
    good(box.run({"warp", "disk", "a.bin", "-d", "2", "--input-dtype", "f32", "-o", "d.bin"}));
    good(box.run({"warp", "disk", "a.bin", "-d", "2", "--dtype", "f32", "-o", "e.bin"}));
    EXPECT_EQ(box.read("c.bin"), box.read("a.bin"));
    EXPECT_EQ(box.read("d.bin").size(), 128U);
    EXPECT_EQ(box.read("e.bin").size(), 64U);
    const auto means = [&](const char* file, const char* type) {
        return good(
            box.run({"analyze", "moments", file, "-d", "2", "--input-dtype", type, "-f", "csv"}));
    };
    EXPECT_EQ(means("a.bin", "f32").substr(0, 60), means("b.bin", "f64").substr(0, 60));
    expect_refusal(box.run({"generate", "halton", "--input-dtype", "f32"}), 2, "--input-dtype");
}

TEST(Convert, SetsSurvive) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "5", "-m", "3", "-o", "a.csv"}));
    good(box.run({"convert", "a.csv", "-o", "b.npy"}));
    EXPECT_THAT(box.read("b.npy"), HasSubstr("(3, 5, 2)"));
    good(box.run({"convert", "b.npy", "-o", "c.json"}));
    good(box.run({"convert", "c.json", "-o", "d.txt"}));
    good(box.run({"convert", "d.txt", "-o", "e.csv"}));
    EXPECT_EQ(box.read("e.csv"), box.read("a.csv"));
}

TEST(Convert, NumPyReadsWhatWeWriteAndWeReadWhatNumPyWrites) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "50", "-o", "a.npy"}));
    good(box.run({"generate", "random", "-n", "50", "--dtype", "f32", "-o", "s.npy"}));
    good(box.shell(
        "/usr/bin/python3 -c 'import numpy as np; a = np.load(\"a.npy\"); assert a.shape == (50, "
        "2);"
        " s = np.load(\"s.npy\"); assert s.dtype == np.float32 and abs(a - s).max() < 1e-7;"
        " np.save(\"b.npy\", np.asfortranarray(a)); np.savetxt(\"b.txt\", a);"
        " np.savetxt(\"b.csv\", a, delimiter=\",\", fmt=\"%.17g\", header=\"x,y\", "
        "comments=\"\")'"));
    good(box.run({"convert", "a.npy", "-o", "a.csv"}));
    for (const char* name : {"b.npy", "b.txt", "b.csv"}) {
        good(box.run({"convert", name, "-o", "again.csv"}));
        EXPECT_EQ(box.read("again.csv"), box.read("a.csv")) << name;
    }
}

TEST(Convert, ReadsSpreadsheetsGnuplotAndOneLineFiles) {
    const Sandbox box;
    const std::string wanted = "x,y\n0.25,0.5\n0.75,1\n";
    for (const std::string text :
         {"\xEF\xBB\xBFx,y\r\n0.25,0.5\r\n0.75,1\r\n", "# gnuplot\n0.25   0.5\n\n0.75\t1\n",
          "0.25,0.5\n0.75,1", "0.25\t5e-1\n0.75\t1.0\n"}) {
        const Outcome outcome = box.run({"convert", "-o", "-"}, text);
        EXPECT_EQ(outcome.out, wanted) << text << outcome.err;
    }
    EXPECT_EQ(box.run({"convert"}, "0.5").out, "x\n0.5\n");
}

TEST(Convert, PicksAndOrdersColumns) {
    const Sandbox box;
    EXPECT_EQ(box.run({"convert", "--column", "3,1"}, "0.1,0.2,0.3\n").out, "x,y\n0.3,0.1\n");
}

// Whatever it is called, as UTK calls its own files .bin.
TEST(Convert, UtkIsKnownByItsFirstBytes) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 9 -d 3 -m 2 -o a.csv --format csv"));
    good(box.shell("stipple convert a.csv -o a.bin --format utk"));
    EXPECT_EQ(good(box.shell("stipple convert a.bin")), box.read("a.csv"));
    EXPECT_EQ(good(box.shell("stipple convert < a.bin")), box.read("a.csv"));
    EXPECT_THAT(good(box.shell("stipple analyze nearest-neighbor a.bin -f csv")),
                HasSubstr(",9,3,"));
    EXPECT_EQ(box.shell("head -c 30 a.bin | stipple convert").code, 3);
    EXPECT_EQ(box.shell("stipple convert a.bin --from bin -d 3").code, 3);
    good(box.shell(
        "stipple generate random -n 3e5 -f utk > big && stipple convert big -f csv | cksum "
        "> one && stipple generate random -n 3e5 | cksum > two && cmp one two"));
}

TEST(Convert, PsaStartsWithTheCount) {
    const Sandbox box;
    EXPECT_EQ(box.run({"convert", "-f", "psa"}, "0.5 0.25\n0 0\n").out, "2\n0.5 0.25\n0 0\n");
    EXPECT_EQ(box.run({"convert", "--from", "psa"}, "2\n0.5 0.25\n0 0\n").out,
              "x,y\n0.5,0.25\n0,0\n");
}

TEST(Convert, PicturesAndMeshesAreWriteOnly) {
    const Sandbox box;
    good(box.run({"generate", "halton", "-n", "9", "-o", "p.svg"}));
    EXPECT_THAT(box.read("p.svg"), HasSubstr("<svg"));
    good(box.run({"generate", "halton", "-n", "9", "-d", "3", "-o", "p.ply"}));
    EXPECT_TRUE(box.read("p.ply").starts_with("ply\n"));
    const Outcome outcome = box.run({"convert", "p.ply", "-o", "q.csv"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("ply"));
}

}  // namespace stipple::testing::convert_test
