// SPDX-License-Identifier: MIT
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
    expect_refusal(box.run({"analyze", "kolmogorov-smirnov", "c.json"}), 3,
                   "c.json: kolmogorov-smirnov needs coordinates that preserve probability; "
                   "parameters has none");
    EXPECT_THAT(text("stipple plot c.json -f svg"), HasSubstr("length"));
}

TEST_F(Parameters, WordsWithoutParametersAreNumberedByTheirLetters) {
    text("stipple generate sobol -n 16 --parameters beam.json -o a.csv");
    const Outcome read = box.shell("stipple convert a.csv -f jsonl | head -n 1");
    EXPECT_EQ(read.code, 0);
    EXPECT_THAT(read.err, HasSubstr("the column 'kind' holds words, which are taken for numbers: "
                                    "'0 brass, 1 mild steel, 2 oak'"));
    EXPECT_EQ(box.shell("stipple convert a.csv --quiet").out, box.read("a.csv"));
    box.write("wrong.csv", "a,b\n1,steel\n2,3\n");
    expect_refusal(box.run({"convert", "wrong.csv"}), 3, "wrong.csv:2:3: 'steel' is not a number");
    box.write("other.csv", "length,layers,kind\n1,2,copper\n");
    expect_refusal(box.run({"convert", "other.csv", "--parameters", "beam.json"}), 3,
                   "other.csv:2:5: 'copper' is not among the words of its column; expected one of "
                   "'mild steel, brass, "
                   "oak'");
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

// A share of 1/32 holds.
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

// No point is dropped, so that a sequence keeps its structure and is cut as without constraints.
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
                   "--unit-cube: is of --parameters");
    expect_refusal(box.run({"generate", "sobol", "-d", "4", "--parameters", "beam.json"}), 2,
                   "warp parameters takes 3 coordinates; the points have 4");
    box.write("p.csv", "x,y\n0.5,0.5\n");
    expect_refusal(box.run({"warp", "parameters", "p.csv"}), 2, "--file: name a parameter file");
    expect_refusal(box.run({"warp", "disk", "p.csv", "--parameters", "beam.json"}), 2,
                   "--parameters: is of the warp parameters");
    box.write("bad.json", R"({"parameters": [{"name": "a", "range": [2, 1]}]})");
    expect_refusal(box.run({"generate", "sobol", "--parameters", "bad.json", "-o", "x.csv"}), 3,
                   "bad.json: $.parameters[0].range: low: 2 is not below high, 1");
    EXPECT_FALSE(box.exists("x.csv"));
}

}  // namespace
}  // namespace stipple::testing::parameters_cli_test
