// SPDX-License-Identifier: MIT
//
// Commands of experiments: sensitivity, and pictures and reports of named parameters.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::experiments_cli_test {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr const char* experiment =
    R"({"parameters":[{"name":"width","unit":"mm","range":[2,3]},)"
    R"({"name":"load","unit":"kN","distribution":"normal","mean":50,"deviation":5},)"
    R"({"name":"material","levels":["steel","brass"]}],"constraints":["width*load < 200"]})";

}  // namespace

// Inputs from one file, outputs from another, in which a run may be missing; and invalid
// combinations.
TEST(Experiments, SensitivityTakesOutputsBesideADesign) {
    const Sandbox box;
    good(box.shell("stipple generate sobol -n 64 -d 2 --bounds 0..10,5..6 --meta -o design.csv"));
    good(
        box.shell("grep -v '^#' design.csv | awk -F, 'NR == 1 {print \"load\"; next} NR == 9 "
                  "{print \"\"; next} {print 3 * $1 + 10 * $2}' > y.csv"));
    const Outcome outcome = box.shell(
        "stipple analyze sensitivity y.csv --design design.csv --check 'load.x.first>0.89' -f "
        "json");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "stipple: note: load: 1 of 64 runs failed, point 7; 63 runs are used\n");
    const json found = json::parse(outcome.out)["results"]["load"];
    EXPECT_EQ(found["method"], "chaos");
    EXPECT_EQ(found["scale"], "box");
    EXPECT_NEAR(double(found["x"]["total"]), 0.9, 1e-9);
    EXPECT_NEAR(double(found["y"]["first"]), 0.1, 1e-9);
    box.write("report.json", outcome.out);
    EXPECT_THAT(good(box.shell("stipple plot report.json")), HasSubstr("Sensitivity of y.csv"));
    EXPECT_THAT(good(box.shell("stipple plot report.json -f text")), HasSubstr("load"));

    const std::string analyze = "stipple analyze sensitivity --design design.csv ";
    expect_refusal(box.shell("head -20 y.csv | " + analyze), 3,
                   "design.csv: 64 rows; the outputs have 19");
    expect_refusal(box.shell(analyze + "y.csv --response stress"), 2,
                   "--response: the table has no column 'stress'");
    expect_refusal(box.shell(analyze + "y.csv --method morris"), 3,
                   "--method morris: the rows are not such a design");
    // Analyzers of points reject missing numbers, also next to an analyzer of tables.
    expect_refusal(box.shell("printf 'x,y\\n1,\\n' | stipple analyze moments,sensitivity"), 3,
                   "an empty field; expected a number");
}

// Keys of the results contain names of columns, so that unknown keys are refused only after the
// analysis. A name in capitals is no wildcard.
TEST(Experiments, SensitivityRefusesUnknownKeys) {
    const Sandbox box;
    good(
        box.shell("stipple generate sobol -n 64 -d 2 | awk 'NR == 1 {print \"x,y,LOAD\"; next} "
                  "{split($0, u, \",\"); print $0 \",\" u[1] + u[2]}' > runs.csv"));
    const std::string analyze =
        "stipple analyze sensitivity runs.csv --inputs x,y --response LOAD -f csv --keys ";
    for (const char* key : {"nonsense", "LOAD.z.first", "first,nonsense"})
        expect_refusal(box.shell(analyze + key), 2, "--keys: sensitivity has no result '");
    for (const char* key : {"LOAD.x.first", "x.first", "x", "LOAD"})
        EXPECT_THAT(good(box.shell(analyze + key)), HasSubstr(",LOAD.x.first")) << key;
    EXPECT_THAT(good(box.shell(analyze + "x.first")), Not(HasSubstr("LOAD.y")));
}

// One design as a table with its parameter file, with provenance lines and an added column, and in
// two files; --bounds are those of the inputs.
TEST(Experiments, SensitivityKnowsTheInputsFromParametersAndProvenance) {
    const Sandbox box;
    box.write("p.json", R"({"parameters":[{"name":"a","range":[1,403.428793492735],"scale":"log"},)"
                        R"({"name":"b","range":[10,20]}]})");
    good(
        box.shell("stipple generate morris --middles -d 2 --parameters p.json --meta -o meta.csv"));
    good(box.shell("grep -v '^#' meta.csv > plain.csv"));
    const std::string model =
        "awk -F, '/^#/ {print; next} !n++ {print $0 \",y\"; next} {print $0 "
        "\",\" log($1) + 0.3 * $2}' ";
    good(box.shell(model + "meta.csv > told.csv; " + model + "plain.csv > table.csv"));
    good(box.shell("cut -d, -f3 table.csv > y.csv"));
    const std::string analyze = "stipple analyze sensitivity -f json ";
    for (const std::string way : {"told.csv", "table.csv --parameters p.json",
                                  "y.csv --design plain.csv --parameters p.json",
                                  "y.csv --design meta.csv", "told.csv --parameters p.json"}) {
        const json found = json::parse(good(box.shell(analyze + way)))["results"];
        ASSERT_EQ(found.size(), 1U) << way;
        EXPECT_EQ(found["y"]["scale"], "distributions") << way;
        EXPECT_NEAR(double(found["y"]["a"]["mu_star"]), 6, 1e-4) << way;
        EXPECT_NEAR(double(found["y"]["b"]["mu_star"]), 3, 1e-4) << way;
    }
    const Outcome bounds = box.shell(analyze + "table.csv --bounds 0..500,10..20 --response y");
    EXPECT_EQ(json::parse(bounds.out)["results"]["y"]["scale"], "box");
    EXPECT_NEAR(double(json::parse(bounds.out)["results"]["y"]["b"]["mu_star"]), 3, 1e-4);
    const Outcome plain = box.shell(analyze + "table.csv --response y");
    EXPECT_EQ(json::parse(plain.out)["results"]["y"]["scale"], "range");
    EXPECT_THAT(plain.err, HasSubstr("each input is scaled by its own extremes"));
    expect_refusal(box.shell(analyze + "table.csv --bounds 0..1,0..1,0..1"), 2,
                   "3 coordinates, but 2 inputs: a, b");
    expect_refusal(box.shell(analyze + "table.csv --rescale"), 2, "--rescale: these are rows of");
    expect_refusal(box.shell(analyze + "y.csv --parameters p.json"), 3,
                   "the table has no column a, b");
}

// Axes show levels as words, in pictures of every kind.
TEST(Experiments, ShowsWordsOfLevels) {
    const Sandbox box;
    box.write("p.json", R"({"parameters":[{"name":"a","range":[2,3]},)"
                        R"({"name":"material","levels":["steel","brass","copper"]}]})");
    good(box.shell("stipple generate sobol -n 64 --parameters p.json -o e.csv --meta"));
    for (const std::string chart : {"", " --chart histogram", " --chart pairs"}) {
        good(box.shell("stipple plot e.csv -o p.svg" + chart));
        const std::string picture = box.read("p.svg");
        for (const char* text : {">steel<", ">copper<", ">sobol, parameters<", ">64 points<"})
            EXPECT_THAT(picture, HasSubstr(text)) << chart;
    }
}

// Also if a file or an option defines parameters.
TEST(Experiments, ItsCommandsAreOfTheParameters) {
    const Sandbox box;
    box.write("p.json",
              R"({"parameters":[{"name":"a","range":[2,3]},{"name":"b","range":[0,9]}]})");
    good(box.shell("stipple generate sobol -n 64 --parameters p.json -o e.csv"));
    for (const std::string sources :
         {"e.csv --parameters p.json", "--generate halton -n 64 --parameters p.json",
          "--generate halton -n 64 --parameters p.json --unit-cube"}) {
        const auto page = json::parse(good(box.shell("stipple report " + sources + " --json")));
        std::size_t checked = 0;
        for (const auto& measure : page["sets"][0]["measures"]) {
            if (measure.contains("left_out")) continue;
            const Outcome again = box.shell(measure["command"].get<std::string>());
            ASSERT_EQ(again.code, 0) << measure["command"] << again.err;
            EXPECT_EQ(json::parse(again.out)["results"], measure["results"]) << measure["command"];
            ++checked;
        }
        EXPECT_GE(checked, 2U) << sources;
    }
}

// A table of parameters instead of their file's text, words instead of numbers of levels, and no
// distances between millimetres and kilonewtons.
TEST(Experiments, OfAnExperimentIsReadable) {
    const Sandbox box;
    box.write("p.json", experiment);
    good(
        box.shell("stipple generate sobol -n 64 --parameters p.json -o e.json && "
                  "stipple generate sobol -n 64 --parameters p.json -o e.csv && "
                  "stipple report e.json --quiet -o a.html && "
                  "stipple report e.csv --parameters p.json --quiet -o b.html"));
    for (const char* file : {"a.html", "b.html"}) {
        const std::string page = box.read(file);
        for (const char* words :
             {"<h3>Parameters</h3>", "width</th><td>mm</td><td>range 2 to 3</td>",
              "<td>normal; mean 50, deviation 5</td>", "<td>levels steel, brass</td>",
              "width*load &lt; 200", ">steel</text>", ">brass</text>", "named parameters",
              "would mix the units"})
            EXPECT_THAT(page, HasSubstr(words)) << file;
        for (const char* words : {"parameters:json", "{&quot;", "Mean nearest distance"})
            EXPECT_THAT(page, Not(HasSubstr(words))) << file;
    }
}

}  // namespace stipple::testing::experiments_cli_test
