// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/program.hpp"

namespace stipple::testing::parameters_cli_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const std::string beam = R"({"parameters": [
    {"name": "length", "unit": "mm", "range": [1, 100], "scale": "log"},
    {"name": "layers", "integers": [1, 8]},
    {"name": "kind", "levels": ["mild steel", "brass", "oak"], "probabilities": [2, 1, 1]}]})";

class Parameters : public ::testing::Test {
  protected:
    Parameters() {
        box.write("beam.json", beam);
        box.write("tight.json", R"({"parameters": [{"name": "a", "range": [0, 1]},
            {"name": "b", "range": [0, 1]}], "constraints": ["(a + b)^2 < 0.0625"]})");
        box.write("linear.json", R"({"parameters": [{"name": "a", "range": [0, 1]},
            {"name": "b", "range": [0, 1]}], "constraints": ["a + b < 0.25"]})");
        box.write("never.json", R"({"parameters": [{"name": "a", "range": [0, 1]}],
            "constraints": ["a^2 > 2"]})");
    }
    std::string text(const std::string& line) const { return good(box.shell(line)); }

    const Sandbox box;
};

TEST_F(Parameters, AreTheColumnsOfATable) {
    const std::string csv = text("stipple generate halton -n 4 --start 1 --parameters beam.json");
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "length,layers,kind");
    EXPECT_THAT(csv, HasSubstr(",6,\"mild steel\"\n"));
    EXPECT_THAT(csv, HasSubstr(",1,brass\n"));
}

TEST_F(Parameters, AreReadBackByEveryFormatAndVerb) {
    const std::string make = "stipple generate sobol -n 64 --parameters beam.json ";
    text(make + "-o a.csv");
    text(make + "--meta -o b.csv");
    text(make + "-o c.json");
    text(make + "-o d.npy");
    EXPECT_EQ(text("stipple convert a.csv --parameters beam.json"), box.read("a.csv"));
    EXPECT_EQ(text("stipple convert b.csv"), box.read("a.csv"));
    EXPECT_EQ(text("stipple convert c.json --format csv"), box.read("a.csv"));
    EXPECT_EQ(text("stipple convert d.npy --parameters beam.json --format csv"), box.read("a.csv"));
    EXPECT_THAT(text("stipple convert c.json --column kind,length --format csv"),
                HasSubstr("kind,length\n\"mild steel\",1\n"));
    text("stipple reproduce c.json");
    text("stipple reproduce b.csv");
    text("rm beam.json; stipple reproduce c.json");
    EXPECT_THAT(text("stipple analyze chi-square c.json"), HasSubstr("p_value"));
    EXPECT_THAT(text("stipple analyze moments c.json --json"), HasSubstr("covariance"));
    EXPECT_THAT(text("stipple analyze kolmogorov-smirnov c.json"),
                HasSubstr("probability of kind"));
    expect_refusal(box.run({"analyze", "serial", "c.json"}), 3,
                   "c.json: serial needs coordinates that preserve probability; parameters does "
                   "not have them");
    EXPECT_THAT(text("stipple plot c.json -f svg"), HasSubstr("length (mm)"));
    EXPECT_THAT(text("stipple plot c.json -f svg --chart histogram"),
                HasSubstr("density of ln length (mm)"));
    EXPECT_THAT(text("stipple plot c.json -f svg --axes L,n,k"), Not(HasSubstr("mm)")));
}

TEST_F(Parameters, WordsWithoutParametersAreNumberedByTheirLetters) {
    text("stipple generate sobol -n 16 --parameters beam.json -o a.csv");
    const Outcome read = box.shell("stipple convert a.csv -f jsonl | head -n 1");
    EXPECT_EQ(read.code, 0);
    EXPECT_THAT(read.err, HasSubstr("the column 'kind' holds words, which are read as numbers: '0 "
                                    "brass, 1 mild steel, 2 oak'"));
    EXPECT_EQ(box.shell("stipple convert a.csv --quiet").out, box.read("a.csv"));
    box.write("wrong.csv", "a,b\n1,steel\n2,3\n");
    expect_refusal(box.run({"convert", "wrong.csv"}), 3, "wrong.csv:2:3: 'steel' is not a number");
    box.write("other.csv", "length,layers,kind\n1,2,copper\n");
    expect_refusal(box.run({"convert", "other.csv", "--parameters", "beam.json"}), 3,
                   "other.csv:2:5: 'copper' is not among the words of its column; expected one of "
                   "'mild steel, brass, "
                   "oak'");
}

// Words that look like numbers or like missing numbers.
TEST_F(Parameters, OddWordsSurvive) {
    for (const std::string words :
         {R"("nan", "18-25", "5%")", R"("inf", "NA", "-")", R"("a,b", "it's; so", "1/2 x")",
          R"("null", "-inf", "true", "0x1g", "NaN")"}) {
        box.write("w.json", R"({"parameters": [{"name": "k", "levels": [)" + words +
                                R"(]}, {"name": "x", "range": [0, 1]}]})");
        const std::string make = "stipple generate sobol -n 16 --parameters w.json ";
        const std::string csv = text(make + "-o a.csv; cat a.csv");
        for (const std::string format : {"csv", "txt", "json", "jsonl"}) {
            text(make + "-f " + format + " -o a." + format);
            EXPECT_EQ(text("stipple convert --parameters w.json -f csv a." + format), csv)
                << words << format;
        }
        EXPECT_EQ(text(make + "--meta | stipple convert"), csv) << words;
        EXPECT_EQ(text("tr , '\\t' < a.csv | grep -v '\"' | head -1"), "k\tx\n");
        EXPECT_EQ(text("stipple warp parameters --parameters w.json --inverse a.csv | stipple warp "
                       "parameters --parameters w.json"),
                  text(make + "--meta | stipple warp parameters --parameters w.json --inverse | "
                              "stipple warp parameters --parameters w.json"))
            << words;
        text("stipple analyze moments a.csv --parameters w.json");
    }
}

TEST_F(Parameters, AreFoundByTheNamesOfColumns) {
    text("stipple generate sobol -n 64 --parameters beam.json -o a.csv");
    text("awk -F, '{print $3 \",\" $1 \",\" $2}' a.csv > b.csv");
    text("sed '1s/layers/leyers/' a.csv > c.csv; awk -F, '{print $1 \",\" $3}' a.csv > d.csv");
    const std::string back = "stipple warp parameters --parameters beam.json --inverse ";
    EXPECT_EQ(text(back + "b.csv"), text(back + "a.csv | awk -F, '{print $3 \",\" $1 \",\" $2}'"));
    text(back + "a.csv -o ua.csv; " + back + "b.csv -o ub.csv");
    const std::string there = "stipple warp parameters --parameters beam.json ";
    EXPECT_EQ(text(there + "ub.csv"),
              text(there + "ua.csv | awk -F, '{print $3 \",\" $1 \",\" $2}'"));
    for (const std::string verb : {"warp parameters --inverse", "analyze moments",
                                   "analyze chi-square", "analyze kolmogorov-smirnov", "convert",
                                   "plot -f svg", "report", "analyze nearest-neighbor"}) {
        EXPECT_THAT(box.shell("stipple " + verb + " --parameters beam.json c.csv").err,
                    HasSubstr("there is no column 'layers'"))
            << verb;
        EXPECT_THAT(box.shell("stipple " + verb + " --parameters beam.json d.csv").err,
                    HasSubstr("there is no column 'layers'"))
            << verb;
    }
    for (const std::string verb : {"analyze moments", "analyze kolmogorov-smirnov"})
        EXPECT_EQ(
            text("stipple " + verb + " --parameters beam.json a.csv | grep -v 'csv\\|seconds'"),
            text("stipple " + verb + " --parameters beam.json b.csv | grep -v 'csv\\|seconds'"));
    text("awk -F, '{print $0 \",\" (NR > 1 ? 7 : \"cost\")}' a.csv > e.csv");
    EXPECT_THAT(box.shell(back + "e.csv").err,
                HasSubstr("the column 'cost' is not a coordinate of"));
}

// Each level occurs equally often, regardless of its probability.
TEST_F(Parameters, DesignsHaveTheirLevels) {
    box.write("d.json", R"({"parameters": [{"name": "k", "levels": ["A", "B"],
        "probabilities": [0.9, 0.1]}, {"name": "m", "levels": ["p", "q", "r"]},
        {"name": "x", "range": [0, 1]}]})");
    const auto counts = [&](const std::string& design, int column) {
        return text("stipple generate " + design +
                    " --parameters d.json --quiet | tail -n +2 | cut -d, -f" +
                    std::to_string(column) +
                    " | sort | uniq -c | awk '{printf \"%s%s \", $1, $2}'");
    };
    EXPECT_EQ(counts("factorial", 1), "6A 6B ");
    EXPECT_EQ(counts("factorial", 2), "4p 4q 4r ");
    EXPECT_EQ(counts("factorial --levels 2,6,2", 2), "8p 8q 8r ");
    EXPECT_EQ(counts("factorial --levels 2", 2), "4p 4r ");
    EXPECT_EQ(counts("plackett-burman -n 8", 1), "4A 4B ");
    EXPECT_EQ(counts("fractional-factorial -n 4", 1), "2A 2B ");
    for (const std::string design : {"morris", "box-behnken", "central-composite"})
        EXPECT_THAT(counts(design, 1), ::testing::AllOf(HasSubstr("A "), HasSubstr("B ")))
            << design;
    EXPECT_THAT(box.shell("stipple generate plackett-burman --parameters d.json").err,
                HasSubstr("note: m: q is in none of the 4 points"));
    EXPECT_EQ(box.shell("stipple generate factorial --parameters d.json").err, "");
    expect_refusal(
        box.run({"generate", "factorial", "--levels", "4", "--parameters", "d.json"}), 2,
        "--levels: 4 levels of parameter 2 would give some of its 3 outcomes more often");
}

TEST_F(Parameters, FixedDesignsKeepWhatHolds) {
    box.write("c.json", R"({"parameters": [{"name": "a", "range": [0, 1]}, {"name": "b",
        "range": [0, 1]}, {"name": "c", "integers": [1, 3]}], "constraints": ["a*b < 0.5"]})");
    for (const std::string design : {"box-behnken", "factorial -n 27", "plackett-burman", "fast",
                                     "grid -n 27", "jittered -n 27"}) {
        const Outcome made =
            box.shell("stipple generate " + design + " --parameters c.json -o o.csv");
        EXPECT_EQ(made.code, 0) << design << made.err;
        EXPECT_THAT(made.err, HasSubstr("satisfy the constraints")) << design;
        EXPECT_EQ(text("awk -F, 'NR > 1 && $1 * $2 >= 0.5' o.csv"), "") << design;
    }
    EXPECT_EQ(text("stipple generate factorial -n 27 --parameters c.json --quiet | wc -l"), "25\n");
}

// --start and shards count the rows of one sequence that satisfy the constraints, in order.
TEST_F(Parameters, StartCountsWhatHolds) {
    box.write("c.json", R"({"parameters": [{"name": "a", "range": [0, 1]}, {"name": "b",
        "range": [0, 1]}], "constraints": ["a*b < 0.3"]})");
    for (const std::string unit : {"sobol", "halton", "random", "sobol --scramble owen", "r2"}) {
        const std::string make = "stipple generate " + unit + " --parameters c.json --quiet ";
        const std::string whole = text(make + "-n 60");
        EXPECT_EQ(text(make + "-n 20; " + make + "-n 40 --start 20 | tail -n +2"), whole) << unit;
        EXPECT_EQ(text(make + "-n 20; for i in 0 1 2; do " + make +
                       "-n 40 --start 20 --shard $i/3 | tail -n +2; done"),
                  whole)
            << unit;
    }
}

TEST_F(Parameters, EarlierRunsAreExtended) {
    box.write("c.json", R"({"parameters": [{"name": "a", "range": [1, 100], "scale": "log"},
        {"name": "n", "integers": [1, 4]}, {"name": "k", "levels": ["u", "v"]},
        {"name": "z", "distribution": "normal"}]})");
    const std::string make = "stipple generate latin-hypercube --parameters c.json ";
    text(make + "-n 20 -o a.csv");
    // In another order, and with outputs of the runs.
    text(
        "awk -F, '{print $4 \",\" $3 \",\" $1 \",\" $2 \",\" (NR > 1 ? NR : \"cost\")}' a.csv > "
        "b.csv");
    const std::string all = text(make + "--extend b.csv --add 20");
    EXPECT_EQ(text(make + "--extend b.csv -n 40"), all);
    box.write("all.csv", all);
    EXPECT_EQ(text("head -n 21 all.csv"), box.read("a.csv"));
    EXPECT_EQ(text("cut -d, -f2 all.csv | tail -n +2 | sort | uniq -c | awk '{print $1, $2}'"),
              "10 1\n10 2\n10 3\n10 4\n");
    EXPECT_EQ(text("cut -d, -f3 all.csv | tail -n +2 | sort | uniq -c | awk '{print $1, $2}'"),
              "20 u\n20 v\n");
    // One in each fortieth of the log range.
    EXPECT_EQ(
        text("awk -F, 'NR > 1 {print int(log($1) / log(100) * 40)}' all.csv | sort -u | wc -l"),
        "40\n");
    box.write("bad.csv", "a,n,k,z\n5,9,u,0\n");
    expect_refusal(box.run({"generate", "latin-hypercube", "--extend", "bad.csv", "--add", "2",
                            "--parameters", "c.json"}),
                   3, "bad.csv: the point (5, 9, 0, 0) is outside the domain parameters");
    box.write("bad.csv", "a,n,k\n5,2,u\n");
    expect_refusal(box.run({"generate", "latin-hypercube", "--extend", "bad.csv", "--add", "2",
                            "--parameters", "c.json"}),
                   3, "there is no column 'z'");
}

TEST_F(Parameters, TheDesignItselfIsInTheUnitCube) {
    const std::string cube =
        text("stipple generate sobol -n 8 --parameters tight.json --unit-cube");
    EXPECT_EQ(cube.substr(0, cube.find('\n')), "a,b");
    EXPECT_EQ(cube, text("stipple generate sobol -n 8 --parameters tight.json"));
    text("stipple generate sobol -n 64 --parameters beam.json -o a.csv");
    EXPECT_THAT(text("stipple warp parameters --parameters beam.json --inverse a.csv | head -n 2"),
                HasSubstr("length,layers,kind\n0,0.0625,0.25\n"));
}

// A fraction of 1/32 of the points satisfies the constraints.
TEST_F(Parameters, ConstraintsLeaveAsManyPointsAsAreAskedFor) {
    for (const std::string unit :
         {"random", "sobol --scramble owen", "latin-hypercube", "poisson-disk"})
        EXPECT_EQ(box.shell("stipple generate " + unit +
                            " -n 300 --parameters tight.json | tail -n +2 | "
                            "awk -F, '$1+$2 < 0.25' | wc -l")
                      .out,
                  "300\n")
            << unit;
    const std::string one = text("stipple generate random -n 300 --parameters tight.json");
    EXPECT_EQ(one, text("stipple generate random -n 300 --parameters tight.json --threads 1"));
    EXPECT_EQ(one, text("for i in 0 1 2; do stipple generate random -n 300 --parameters tight.json "
                        "--shard $i/3 | tail -n +$((i > 0 ? 2 : 1)); done"));
    expect_refusal(
        box.run({"generate", "latin-hypercube", "--parameters", "never.json", "-n", "10"}), 3,
        "the constraints hold for none of");
}

// Equalities of continuous parameters, and fractions of 1e-8, found by counting some million
// points.
TEST_F(Parameters, ConstraintsThatHardlyEverHoldAreRefused) {
    const auto refused = [&](const std::string& constraint, const std::string& unit) {
        box.write("rare.json", R"({"parameters": [{"name": "a", "range": [0, 1]},
            {"name": "b", "range": [0, 1]}], "constraints": [")" +
                                   constraint + "\"]}");
        expect_refusal(box.shell("stipple generate " + unit + " -n 10 --parameters rare.json"), 3,
                       "the constraints hold for ");
    };
    refused("a == 0.5", "sobol");
    refused("a == 0.5", "poisson-disk");
    refused("a*b < 1e-10", "random");
}

// A Latin hypercube of twelve points: each twelfth of an axis contains one; levels divide it into
// halves and quarters.
TEST_F(Parameters, OptimizedDesignsSatisfyConstraints) {
    box.write("near.json", R"({"parameters": [{"name": "a", "range": [0, 12]},
        {"name": "b", "range": [0, 12]}, {"name": "m", "levels": ["p", "q"]},
        {"name": "i", "integers": [1, 4]}], "constraints": ["abs(a - b) < 5 - i"]})");
    const auto column = [](const std::string& from, int k, const std::string& scale) {
        return fmt::format(
            "awk -F, 'NR > 1 {{print int(${} * {})}}' {} | sort -n | uniq -c | "
            "awk '{{print $1, $2}}'",
            k, scale, from);
    };
    std::string each;
    for (int i = 0; i < 12; ++i) each += fmt::format("1 {}\n", i);
    for (const std::string criterion : {"maximin", "maxpro", "centered-l2"}) {
        const std::string make =
            "stipple generate latin-hypercube -n 12 --effort 0.001 "
            "--parameters near.json --optimize " +
            criterion;
        EXPECT_EQ(box.shell(make + " -o x.csv").err, "") << criterion;
        for (const int k : {1, 2}) EXPECT_EQ(text(column("x.csv", k, "1")), each) << criterion;
        EXPECT_EQ(text(column("x.csv", 4, "1")), "3 1\n3 2\n3 3\n3 4\n");
        EXPECT_EQ(text("cut -d, -f3 x.csv | sort | uniq -c | awk '{print $1, $2}'"),
                  "1 m\n6 p\n6 q\n");
        EXPECT_EQ(text("awk -F, 'NR > 1 && ($1 - $2 >= 5 - $4 || $2 - $1 >= 5 - $4)' x.csv"), "");
        text(make + " --unit-cube -o cube.csv");
        for (const int k : {1, 2, 3, 4})
            EXPECT_EQ(text(column("cube.csv", k, "12 + 1e-9")), each) << criterion << k;
    }
}

// No Latin hypercube with strata of equal width has all points below the diagonal.
TEST_F(Parameters, OptimizedDesignsHaveOtherStrataWhereConstraintsNeedThem) {
    const std::string make =
        "stipple generate latin-hypercube --optimize maximin --effort 0.001 -n 40 --parameters "
        "tight.json";
    const auto made = box.shell(make);
    EXPECT_THAT(made.err,
                HasSubstr("no Latin hypercube of 40 points was found that satisfies the "
                          "constraints; instead, the strata of each axis hold equal fractions"));
    EXPECT_EQ(box.shell(make + " | tail -n +2 | awk -F, '$1+$2 < 0.25' | wc -l").out, "40\n");
    EXPECT_EQ(made.out, box.shell(make + " --threads 1").out);
    // Below 0.25 - s is a share of (1 - 4 s)^2: the quarters of 40 points are 10 each, or nearly.
    const std::string quarter =
        make + " | awk -F, 'NR > 1 && $1 < 0.25 * (1 - sqrt(0.75))' | wc -l";
    const int count = std::stoi(box.shell(quarter).out);
    EXPECT_GE(count, 9);
    EXPECT_LE(count, 11);
    expect_refusal(box.run({"generate", "latin-hypercube", "--optimize", "maximin", "--parameters",
                            "never.json", "-n", "10"}),
                   3, "latin-hypercube: only 0 of ");
}

// The set as a whole: made, read, one of several, measured and reproduced.
TEST_F(Parameters, AreReorderedAsAWholeSet) {
    box.write("r.json", R"({"parameters": [{"name": "a", "range": [0, 2]}, {"name": "b",
        "distribution": "normal"}], "correlation": {"reordering": "iman-conover",
        "spearman": [["a", "b", 0.7]]}})");
    const std::string make = "stipple generate latin-hypercube -n 40 --parameters r.json ";
    const std::string one = text(make);
    EXPECT_NE(one, text("sed 's/0.7/-0.7/' r.json > s.json; stipple generate latin-hypercube -n 40 "
                        "--parameters s.json"));
    EXPECT_EQ(one, text(make + "--threads 1"));
    EXPECT_EQ(text("stipple generate latin-hypercube -n 40 | stipple warp parameters --parameters "
                   "r.json"),
              one);
    text("stipple generate latin-hypercube -n 40 -o p.csv");
    EXPECT_EQ(text("stipple warp parameters --parameters r.json p.csv"), one);
    EXPECT_EQ(text(make + "-m 2 | sed -n 's/^1,//p'"), text(make + "-s 2 | tail -n +2"));
    EXPECT_EQ(text("stipple generate latin-hypercube -n 40 -m 2 -o m.csv; "
                   "stipple warp parameters --parameters r.json m.csv"),
              text(make + "-m 2"));

    text(make + "-f json -o a.json; " + make + "--unit-cube -o cube.csv");
    EXPECT_EQ(text("cut -d, -f2 cube.csv | tail -n +2 | sort"),
              text("cut -d, -f2 p.csv | tail -n +2 | sort"));
    EXPECT_EQ(text("stipple analyze star-discrepancy cube.csv | grep '\"value\"'"),
              text("stipple analyze star-discrepancy --generate latin-hypercube -n 40 --parameters "
                   "r.json --unit-cube | grep '\"value\"'"));
    const std::string star = text(
        "stipple analyze star-discrepancy cube.csv | sed -n "
        "'s/.*\"value\": \\(.*\\),/\\1/p'");
    EXPECT_THAT(text("stipple study --generators latin-hypercube --analyze star-discrepancy -n 40 "
                     "--keys value --parameters r.json --quiet -f jsonl"),
                HasSubstr("\"value\":" + star.substr(0, star.size() - 1)));
    text("rm r.json; stipple reproduce a.json");
    expect_refusal(box.run({"analyze", "chi-square", "a.json"}), 3,
                   "a.json: the density of reordered parameters is not known");
}

TEST_F(Parameters, ReorderedAreRefusedInOneLine) {
    box.write("r.json", R"({"parameters": [{"name": "a", "range": [0, 2]}, {"name": "b",
        "range": [0, 1]}], "correlation": {"reordering": "iman-conover"},
        "constraints": ["a + b < 1.5"]})");
    expect_refusal(
        box.run({"generate", "random", "-n", "8", "--parameters", "r.json", "--shard", "0/2"}), 2,
        "--shard: the parameters of a whole set are reordered; make all points at once");
    expect_refusal(box.run({"generate", "random", "-n", "2", "--parameters", "r.json"}), 3,
                   "iman-conover: expected at least 3 points for 2 parameters; there are 2");
    box.write("p.csv", "x,y\n0.5,0.5\n0.5,0.25\n0.5,0.75\n");
    expect_refusal(box.run({"warp", "parameters", "--parameters", "r.json", "p.csv"}), 3,
                   "all points have the same value of a");
    const Outcome held = box.shell(
        "stipple generate sobol -n 100 --parameters r.json | tail -n +2 | awk -F, '$1+$2 < 1.5' | "
        "wc -l");
    EXPECT_EQ(held.out, "100\n");
    EXPECT_THAT(held.err, HasSubstr("of which 100 satisfy the constraints"));
}

TEST_F(Parameters, FollowColumnsOfFiles) {
    box.write("wind.csv", "day,speed\n1,3.5\n2,4.5\n3,3.5\n4,8\n");
    box.write("w.json",
              R"({"parameters": [{"name": "wind", "file": "wind.csv", "column": "speed"}]})");
    text("stipple generate halton -n 4 --parameters w.json -f json -o a.json");
    EXPECT_EQ(text("stipple convert a.json -f csv"), "wind\n3.5\n4.5\n3.5\n8\n");
    expect_refusal(box.run({"generate", "halton", "-d", "1", "-w", "parameters:file=w.json"}), 3,
                   "w.json: $.parameters[0].file: only --parameters FILE reads columns of other "
                   "files; put their numbers here, \"values\": [...]");
    text("rm wind.csv; stipple reproduce a.json");
    expect_refusal(box.run({"generate", "halton", "--parameters", "w.json"}), 4,
                   "wind.csv: no such file");
    box.write("wind.csv", "day,speed\n1,3.5\n");
    box.write("w.json", R"({"parameters": [{"name": "wind", "file": "wind.csv"}]})");
    expect_refusal(
        box.run({"generate", "halton", "--parameters", "w.json"}), 3,
        "w.json: $.parameters[0].file: wind.csv has 2 columns; expected 1; \"column\" selects one");
}

// No point is dropped, so a sequence keeps its structure, and shorter sets are its prefixes.
TEST_F(Parameters, LinearConstraintsAreMetExactly) {
    for (const std::string unit : {"random", "sobol", "latin-hypercube", "poisson-disk"})
        EXPECT_EQ(box.shell("stipple generate " + unit +
                            " -n 256 --parameters linear.json | tail -n +2 | "
                            "awk -F, '$1+$2 < 0.25' | wc -l")
                      .out,
                  "256\n")
            << unit;
    EXPECT_EQ(text("stipple generate sobol -n 256 --parameters linear.json --unit-cube"),
              "a,b\n" + text("stipple generate sobol -n 256 --no-header"));
    EXPECT_EQ(text("stipple generate sobol -n 256 --parameters linear.json"),
              text("stipple generate sobol -n 512 --parameters linear.json | head -n 257"));
    text("stipple generate sobol -n 256 --parameters linear.json -f json -o l.json");
    EXPECT_THAT(text("stipple analyze chi-square l.json"), HasSubstr("\"stratified\""));
    text("stipple warp parameters --parameters linear.json --inverse l.json -o back.csv");
    EXPECT_THAT(text("stipple reproduce l.json"), HasSubstr("identical"));
    box.write("empty.json", R"({"parameters": [{"name": "a", "range": [0, 1]}],
        "constraints": ["a > 2"]})");
    expect_refusal(box.run({"generate", "sobol", "--parameters", "empty.json"}), 3,
                   "empty.json: $.constraints: no point in the ranges satisfies 'a>2'");
}

TEST_F(Parameters, ThePolytopeAloneIsAWarp) {
    text(
        "stipple generate sobol -n 256 -d 3 -w 'polytope:constraints=[x+y<=1; z>=x],"
        "bounds=[0..2,0..1,0..1]' -f json -o p.json");
    EXPECT_THAT(text("stipple analyze chi-square,moments p.json"), HasSubstr("\"stratified\""));
    EXPECT_THAT(text("stipple analyze chi-square p.json --domain 'polytope:constraints=[x+y<=1,"
                     "z>=x],bounds=[0..2,0..1,0..1]'"),
                HasSubstr("\"stratified\""));
    text("stipple reproduce p.json");
    expect_refusal(box.run({"generate", "sobol", "-w", "polytope:constraints=[x+y>=3]"}), 2,
                   "--constraints: no point in the ranges satisfies 'x+y>=3'");
}

TEST_F(Parameters, StudiesTakeThem) {
    EXPECT_THAT(
        text("stipple study --generators random,sobol --analyze nearest-neighbor --parameters "
             "tight.json -n 16 --seeds 2"),
        HasSubstr("random,"));
}

TEST_F(Parameters, AreRefusedInOneLine) {
    expect_refusal(box.run({"generate", "sobol", "--parameters", "no.json"}), 4, "no.json: ");
    expect_refusal(box.run({"generate", "sobol", "--unit-cube"}), 2,
                   "--unit-cube: requires --parameters");
    expect_refusal(box.run({"generate", "sobol", "-d", "4", "--parameters", "beam.json"}), 2,
                   "warp parameters takes 3 coordinates; the points have 4");
    box.write("p.csv", "x,y\n0.5,0.5\n");
    expect_refusal(box.run({"warp", "parameters", "p.csv"}), 2,
                   "--file: no file given; expected a parameter file");
    expect_refusal(box.run({"warp", "disk", "p.csv", "--parameters", "beam.json"}), 2,
                   "--parameters applies only to the warp parameters");
    box.write("bad.json", R"({"parameters": [{"name": "a", "range": [2, 1]}]})");
    expect_refusal(box.run({"generate", "sobol", "--parameters", "bad.json", "-o", "x.csv"}), 3,
                   "bad.json: $.parameters[0].range: low: 2 is not below high, 1");
    EXPECT_FALSE(box.exists("x.csv"));
}

}  // namespace
}  // namespace stipple::testing::parameters_cli_test
