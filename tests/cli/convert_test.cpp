// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.hpp"

namespace stipple::testing::convert_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// Shortest digits and float64 binaries lose nothing, so converting through all formats gives the
// original.
// A column of densities stays with its points in every format, and is read back.
TEST(Convert, KeepsColumnsOfDensities) {
    const Sandbox box;
    for (const std::string column : {"--with-pdf", "--with-weight", "--with-pdf --with-weight"}) {
        const std::string csv = good(
            box.shell("stipple generate sobol -n 4 -w disk " + column + " -o p.csv; cat p.csv"));
        for (const std::string format : {"json", "jsonl", "csv"})
            EXPECT_EQ(good(box.shell("stipple convert p.csv -f " + format +
                                     " | stipple convert - -f csv")),
                      csv)
                << column << format;
        EXPECT_EQ(good(box.shell("stipple convert p.csv --column x,y")),
                  good(box.shell("stipple generate sobol -n 4 -w disk")));
    }
}

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
        EXPECT_THAT(outcome.err,
                    HasSubstr("the first column has no name; it is read as row names"));
    }
}

TEST(Convert, SaysWhichNamesItReplaces) {
    const Sandbox box;
    const auto converted = [&](const std::string& header) {
        box.write("r.csv", header + "\n1,2,3\n4,5,6\n");
        const Outcome outcome = box.shell("stipple convert r.csv -f csv");
        EXPECT_EQ(box.shell("cat r.csv | stipple convert -f csv").out, outcome.out);
        return outcome.out.substr(0, outcome.out.find('\n')) + "; " + outcome.err;
    };
    EXPECT_THAT(
        converted("a,\"b \"\"q\"\"\",c"),
        AllOf(StartsWith("a,y,c; stipple: note: r.csv: the column 'b \"\"q\"\"' is called y"),
              HasSubstr("a name is printable, no number and not set, pdf or weight, and has")));
    EXPECT_EQ(converted("a,,c"),
              "a,y,c; stipple: note: r.csv: a column has no name; it is called y\n");
    EXPECT_THAT(converted("y,[m],set"),
                AllOf(StartsWith("y,y_,z; "), HasSubstr("'[m]' is called y_"),
                      HasSubstr("'set' is called z")));
}

TEST(Convert, ReplacesNamesOfAllFormatsSingly) {
    const Sandbox box;
    box.write("r.json", R"([{"a":1,"inf":2,"c":3},{"a":4,"inf":5,"c":6}])");
    box.write("r.jsonl", "{\"columns\":[\"a\",\"inf\",\"c\"]}\n[1,2,3]\n[4,5,6]\n");
    for (const std::string file : {"r.json", "r.jsonl"}) {
        const Outcome read = box.run({"convert", file, "-f", "csv"});
        EXPECT_EQ(read.out, "a,y,c\n1,2,3\n4,5,6\n");
        EXPECT_THAT(read.err, StartsWith("stipple: note: " + file +
                                         ": the column 'inf' is called y; a name is printable"));
    }
    box.write("w.csv", "a,weight\n1,2\n");
    const Outcome picked = box.run({"convert", "w.csv", "--column", "a,weight", "-f", "csv"});
    EXPECT_EQ(picked.out, "a,y\n1,2\n");
    EXPECT_THAT(picked.err, HasSubstr("the column 'weight' is called y"));
}

TEST(Convert, ReadsLevelsThatLookLikeNumbers) {
    const Sandbox box;
    box.write(
        "p.json",
        R"({"parameters":[{"name":"a","range":[0,1]},{"name":"m","levels":["1,5","nan","NA"]}]})");
    for (const char* format : {"csv", "tsv"}) {
        const std::string file = std::string("t.") + format;
        good(box.run({"generate", "sobol", "-n", "8", "--parameters", "p.json", "-o", file}));
        good(box.run({"convert", file, "--parameters", "p.json", "-o", "back.csv"}));
        EXPECT_THAT(box.read("back.csv"), StartsWith("a,m\n0,\"1,5\"\n0.5,nan\n"));
    }
}

TEST(Convert, SaysWhichColumnCountsTheRows) {
    const Sandbox box;
    const auto notes = [&](const std::string& text, const std::string& more = "") {
        box.write("r.csv", text);
        const Outcome file = box.shell("stipple convert r.csv -f csv " + more);
        EXPECT_EQ(file.code, 0);
        EXPECT_EQ(box.shell("cat r.csv | stipple convert -f csv " + more).err.empty(),
                  file.err.empty());
        return file.err;
    };
    const std::string note =
        "stipple: note: r.csv: the column 'id' counts the rows but is used as a coordinate; "
        "--column picks the others\n";
    EXPECT_EQ(notes("id,x\n0,0.5\n1,0.25\n2,0.5\n"), note);
    EXPECT_EQ(notes("id x\n# as in R\n1 0.5\n2 0.25\n\n3 0.5\n4 0.125\n"), note);
    EXPECT_EQ(notes("id,x\n0,0.5\n1,0.25\n2,0.5\n", "--column x"), "");
    EXPECT_EQ(notes("id,x\n0,0.5\n1,0.25\n"), "") << "two rows tell nothing";
    EXPECT_EQ(notes("id,x\n0,0.5\n1,0.25\n3,0.5\n"), "");
    EXPECT_EQ(notes("id,x\n5,0.5\n6,0.25\n7,0.5\n"), "");
    EXPECT_EQ(notes("id\n0\n1\n2\n"), "") << "there are no others";
    EXPECT_EQ(notes("0,0.5\n1,0.25\n2,0.5\n"), "") << "no names";
}

TEST(Convert, RefusesNumbersOfNoWordWhenWordsAreJoined) {
    const Sandbox box;
    box.write("a.csv", "x,m\n0.5,oak\n0.25,brass\n");
    box.write("b.csv", "x,m\n0.5,brass\n0.75,fir\n");
    good(box.run({"-q", "convert", "a.csv", "-o", "a.npy", "--meta"}));
    EXPECT_THAT(box.run({"convert", "a.npy"}).err, Not(HasSubstr("not used")));
    std::string json = good(box.run({"-q", "convert", "b.csv", "-f", "json", "--meta"}));
    json.replace(json.find("[0.75,1]"), 8, "[0.75,9]");
    box.write("b.json", json);
    const auto outcome = box.run({"convert", "--concat", "a.csv", "b.json"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("b.json: 9 is not the number of a word"));
}

TEST(Convert, RefusesFloat32ForLargerNumbers) {
    const Sandbox box;
    box.write("a.csv", "x,y\n0.5,3.4e38\n-1e300,1e-300\n");
    const auto outcome = box.run({"convert", "a.csv", "--dtype", "f32", "-o", "b.npy"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("float32 cannot hold -1e+300; write float64"));
    EXPECT_FALSE(box.exists("b.npy"));
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
    for (const char* option : {"--dtype", "--output-dtype"}) {
        expect_refusal(box.run({"generate", "halton", option, "f32", "-o", "t.csv"}), 2,
                       std::string(option) + ": csv is text, which has no float32");
        expect_refusal(box.run({"convert", "b.bin", "-d", "2", option, "f32", "-o", "t.json"}), 2,
                       std::string(option) + ": json is text, which has no float32");
    }
    good(box.run({"generate", "halton", "--dtype", "f64", "-o", "t.csv"}));
    good(box.run({"warp", "disk", "a.bin", "-d", "2", "--dtype", "f32", "-o", "t.csv"}));
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

// UTK's files are recognized under any name, because UTK itself calls them .bin.
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

TEST(Convert, CompressedFilesAreThoseOfGzipAndZstandard) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "3000", "-m", "2", "-o", "p.csv"}));
    good(box.shell("gzip -k p.csv; mv p.csv.gz theirs"));
    for (const char* name : {"q.csv.gz", "q.csv.zst", "Q.CSV.GZ"}) {
        SCOPED_TRACE(name);
        good(box.run({"convert", "p.csv", "-o", name}));
        EXPECT_TRUE(good(box.run({"convert", name, "-f", "csv"})) == box.read("p.csv"));
        EXPECT_TRUE(good(box.run({"convert", "-f", "csv"}, box.read(name))) == box.read("p.csv"));
        EXPECT_LT(box.read(name).size(), box.read("p.csv").size() / 2);
        const std::string reader = name[6] == 'z' ? "zstd" : "gzip";
        EXPECT_TRUE(good(box.shell(reader + " -dc < " + name)) == box.read("p.csv"));
    }
    EXPECT_TRUE(good(box.run({"convert", "theirs", "-f", "csv"})) == box.read("p.csv"));
    for (const std::string name : {"t.npy", "t.json", "t.jsonl", "t.f64", "t.txt", "t.utk"}) {
        good(box.run({"generate", "random", "-n", "60", "-m", "2", "-o", name}));
        good(box.run({"generate", "random", "-n", "60", "-m", "2", "-o", name + ".gz"}));
        const std::string shape = name == "t.f64" ? " --from bin -d 2" : "";
        EXPECT_EQ(good(box.shell("stipple convert " + name + ".gz -f csv" + shape)),
                  good(box.shell("stipple convert " + name + " -f csv" + shape)));
    }
    good(box.run({"list", "--json", "-o", "l.json.gz"}));
    EXPECT_NE(good(box.shell("gzip -dc l.json.gz")).find("star-discrepancy"), std::string::npos);
    good(box.shell("head -c 5000 q.csv.gz > cut.csv.gz"));
    expect_refusal(box.run({"convert", "cut.csv.gz", "-o", "r.csv"}), 3,
                   "cut.csv.gz: the compressed bytes end too soon");
    EXPECT_FALSE(box.exists("r.csv"));
}

TEST(Convert, RefusesExtensionsOfOtherFormats) {
    const Sandbox box;
    good(box.run({"generate", "halton", "-o", "p.csv"}));
    for (const char* name : {"q.png", "q.pdf", "q.xlsx", "q.parquet", "q.npz", "q.h5", "q.csv.bz2"})
        for (const char* verb : {"generate halton", "convert p.csv", "warp disk p.csv"})
            expect_refusal(box.shell("stipple " + std::string(verb) + " -o " + name), 2,
                           "known: .bin .f64 .f32 .csv .json");
    expect_refusal(box.run({"analyze", "moments", "p.csv", "-o", "q.html"}), 2,
                   "unknown extension '.html'; known: .json .csv .txt .tex");
    expect_refusal(box.run({"report", "p.csv", "-o", "q.pdf"}), 2, "known: .html .htm .json");
    EXPECT_EQ(box.files(), std::vector<std::string>{"p.csv"});
    good(box.run({"generate", "halton", "-o", "points"}));
    good(box.run({"generate", "halton", "-f", "csv", "-o", "q.h5"}));
    EXPECT_EQ(box.read("points"), box.read("p.csv"));
    EXPECT_EQ(box.read("q.h5"), box.read("p.csv"));
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

// As written by spreadsheets in western Europe.
TEST(Convert, ReadsNamesInLatin1) {
    const Sandbox box;
    box.write("a.csv",
              "Gr\xf6\xdf"
              "e;H\xf6he\n1,5;2\n2,5;3\n");
    EXPECT_EQ(good(box.shell("stipple convert a.csv -f csv")), "Größe,Höhe\n1.5,2\n2.5,3\n");
    EXPECT_EQ(good(box.shell("stipple convert a.csv --column Höhe -f csv")), "Höhe\n2\n3\n");
}

// Names are kept by every verb that keeps points, in every format that can store them.
TEST(Convert, KeepsTheNamesOfColumns) {
    const Sandbox box;
    box.write("a.csv", "age,income,size\n0.1,0.2,0.3\n0.4,0.5,0.6\n");
    const auto head = [](const std::string& text) { return text.substr(0, text.find('\n')); };
    good(
        box.shell("stipple convert a.csv -o a.json && stipple convert a.json -o b.jsonl && "
                  "stipple convert b.jsonl --meta -o c.txt && stipple convert c.txt -o d.csv"));
    EXPECT_EQ(box.read("d.csv"), box.read("a.csv"));
    EXPECT_EQ(head(good(box.shell("stipple convert b.jsonl --column size,age"))), "size,age");
    EXPECT_EQ(head(good(box.shell("stipple warp disk@1,3 a.csv"))), "x,income,z");
    EXPECT_EQ(head(good(box.shell("stipple warp owen a.csv"))), "age,income,size");
    EXPECT_EQ(head(good(box.shell("stipple warp disk@1,3 a.csv --density-at"))),
              "age,income,size,pdf");
    EXPECT_EQ(
        head(good(box.shell("stipple warp disk@1,3 d.csv | stipple warp disk@1,3 --inverse"))),
        "x,income,z");
    const std::string text = good(box.shell("stipple analyze moments a.csv -f text"));
    EXPECT_EQ(head(text), "moments of a.csv (2 points, dimension 3: age, income, size, unit-cube)");
    EXPECT_THAT(good(box.shell("stipple analyze moments a.csv")),
                HasSubstr("\"columns\": [\n      \"age\""));
    for (const char* more : {"", " --column size,income"})
        EXPECT_THAT(good(box.shell("stipple plot a.csv -f svg" + std::string(more))),
                    HasSubstr(">income<"));
}

}  // namespace stipple::testing::convert_test
