// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::analyze_test {

using nlohmann::json;
using ::testing::HasSubstr;

namespace {

json report_of(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return json::parse(outcome.out);
}

std::string grid(double offset) {
    std::string text;
    for (int i = 0; i < 10; ++i)
        for (int j = 0; j < 10; ++j)
            text +=
                std::to_string((i + offset) / 10) + "," + std::to_string((j + offset) / 10) + "\n";
    return text;
}

}  // namespace

TEST(Analyze, GivesTheContractsDocument) {
    const Sandbox box;
    const auto out = report_of(
        box.shell("stipple generate halton -n 100 --start 1 | stipple analyze star-discrepancy"));
    EXPECT_EQ(out["format"], "stipple.report");
    EXPECT_EQ(out["version"], 1);
    EXPECT_EQ(out["analyzer"], "star-discrepancy");
    EXPECT_EQ(out["input"],
              (json{{"source", "-"}, {"count", 100}, {"dimension", 2}, {"domain", "unit-cube"}}));
    EXPECT_TRUE(out["options"].is_object());
    EXPECT_TRUE(out["seconds"].is_number());
    const auto& results = out["results"];
    EXPECT_NEAR(results["value"].get<double>(), 6511.0 / 129600, 1e-15);
    EXPECT_EQ(results["exact"], true);
    for (const char* key : {"lower", "upper", "method"}) EXPECT_TRUE(results.contains(key)) << key;
    for (const char* key : {"corner", "closed", "points", "volume"})
        EXPECT_TRUE(results["worst_box"].contains(key)) << key;
}

// Columns pdf and weight = 1 / pdf, in each format with named columns.
TEST(Analyze, IntegrationTakesTheDensityOfAColumn) {
    const Sandbox box;
    const std::string rows = "0.1,2\n0.2,2\n0.6,0.5\n0.8,0.5\n";
    const auto estimate = [&](const std::string& text, const std::string& density,
                              std::vector<std::string> more = {}) {
        more.insert(more.begin(), {"analyze", "integration", "--expression", "x"});
        const json results = report_of(box.run(more, text))["results"];
        EXPECT_EQ(results.value("density", "domain"), density) << text;
        return results["expression"]["estimate"].get<double>();
    };
    EXPECT_DOUBLE_EQ(estimate("x,pdf\n" + rows, "pdf"), 0.7375);
    EXPECT_DOUBLE_EQ(estimate("x,weight\n0.1,0.5\n0.2,0.5\n0.6,2\n0.8,2\n", "weight"), 0.7375);
    EXPECT_DOUBLE_EQ(estimate("x,weight,pdf\n0.1,9,2\n0.2,9,2\n0.6,9,0.5\n0.8,9,0.5\n", "pdf"),
                     0.7375);
    const std::string lines = "[0.1,2]\n[0.2,2]\n[0.6,0.5]\n[0.8,0.5]\n";
    const std::string head = R"({"columns":["x","pdf"],"dimension":1})";
    EXPECT_DOUBLE_EQ(estimate(head + "\n" + lines, "pdf"), 0.7375);
    EXPECT_DOUBLE_EQ(
        estimate(R"({"columns":["x","pdf"],"dimension":1,"points":[[0.1,2],[0.2,2],[0.6,0.5],)"
                 R"([0.8,0.5]]})",
                 "pdf"),
        0.7375);
    // In the unit cube, after mapping from a box twice as long, the density is twice as high.
    EXPECT_DOUBLE_EQ(estimate("x,pdf\n0,1\n2,0.25\n", "pdf", {"--rescale"}), 1);
    // The pdf of a row does not apply to a selection of its coordinates.
    EXPECT_DOUBLE_EQ(estimate("x,pdf\n" + rows, "domain", {"--column", "x"}), 0.425);
    box.write("a.csv", "x,pdf\n0.1,2\n0.2,2\n");
    box.write("b.csv", "x,pdf\n0.6,0.5\n0.8,0.5\n");
    EXPECT_DOUBLE_EQ(estimate("", "pdf", {"--concat", "a.csv", "b.csv"}), 0.7375);
    const auto wrong = box.run({"analyze", "integration"}, "x,pdf\n0.1,2\n0.2,0\n");
    expect_refusal(wrong, 3, "point 1: its pdf is 0; expected a number above 0");
}

TEST(Analyze, KnownDiscrepanciesComeOut) {
    const Sandbox box;
    const auto value = [&](const std::string& points) {
        return report_of(box.run({"analyze", "star-discrepancy"}, points))["results"]["value"]
            .get<double>();
    };
    EXPECT_EQ(value("0.5,0.5\n"), 0.75);
    EXPECT_EQ(value("0,0"), 1);
    EXPECT_EQ(value("1 1"), 1);
    EXPECT_EQ(value("0.5\t0.5\r\n0.5\t0.5\r\n"), 0.75);
    EXPECT_NEAR(value(grid(0)), 0.19, 1e-15);
    EXPECT_NEAR(value(grid(0.5)), 39.0 / 400, 1e-15);
    const auto hammersley = box.run({"generate", "hammersley", "-n", "100"}).out;
    EXPECT_NEAR(value(hammersley), 121.0 / 3200, 1e-15);
}

TEST(Analyze, SpectrumKeysAndFiles) {
    const Sandbox box;
    const auto out = report_of(box.shell(
        "stipple generate random -n 1000 | stipple analyze periodogram --max-frequency 20 "
        "--grid g.npy --image g.png"));
    const auto& results = out["results"];
    for (const char* key :
         {"max_frequency", "effective_nyquist", "oscillation", "method", "tolerance"})
        EXPECT_TRUE(results.contains(key)) << key;
    const auto& radial = results["radial"];
    for (const char* key : {"frequency", "power", "anisotropy_db", "cells"})
        EXPECT_EQ(radial[key].size(), radial["frequency"].size()) << key;
    EXPECT_FALSE(results.contains("grid"));
    EXPECT_THAT(box.read("g.npy"), HasSubstr("'shape': (41, 41)"));
    EXPECT_TRUE(box.read("g.png").starts_with("\x89PNG\r\n\x1a\n"));
}

TEST(Analyze, ChiSquareKnowsTheDisk) {
    const Sandbox box;
    const std::string judge = " | stipple analyze chi-square --domain disk";
    const auto verdict = [&](const std::string& make) {
        return report_of(box.shell(make + judge))["results"]["verdict"].get<std::string>();
    };
    EXPECT_EQ(verdict("stipple generate random -n 1e5 -w disk"), "uniform");
    EXPECT_EQ(verdict("stipple generate random -n 1e5 -w disk:method=concentric"), "uniform");
    EXPECT_EQ(verdict("stipple generate random -n 1e5 -w disk:method=naive"), "non-uniform");
    EXPECT_EQ(verdict("stipple generate halton -n 1e5 -w disk"), "stratified");
    EXPECT_EQ(verdict("stipple generate jittered -n 1e5 -w disk"), "stratified");
}

TEST(Analyze, NamesTheWayBackOfWarpedPoints) {
    const Sandbox box;
    ASSERT_EQ(box.shell("stipple generate halton -n 100 -w disk -o disk.json").code, 0);
    const auto refused = box.run({"analyze", "star-discrepancy", "disk.json"});
    EXPECT_EQ(refused.code, 3);
    EXPECT_THAT(refused.err, HasSubstr("'stipple warp disk --inverse' takes them back"));
    report_of(
        box.shell("stipple warp disk --inverse disk.json -f json | "
                  "stipple analyze star-discrepancy"));
    const auto inside = box.shell(
        "stipple generate halton -n 100 -w 'triangle:vertices=[0,0 .5,0 0,.5]' -f json | "
        "stipple analyze star-discrepancy");
    EXPECT_THAT(inside.err, HasSubstr("'stipple warp \"triangle:vertices=[0,0 0.5,0 0,0.5]\" "
                                      "--inverse' takes them back to the cube; --domain"));
}

TEST(Analyze, ChecksAndExpectationsSetTheExitCode) {
    const Sandbox box;
    box.write("h.csv", box.run({"generate", "halton", "-n", "1000"}).out);
    const auto code = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"analyze", more.front(), "h.csv"});
        more.erase(more.begin() + 3);
        return box.run(more).code;
    };
    EXPECT_EQ(code({"star-discrepancy", "--check", "value<0.1", "--check", "worst_box.points>0"}),
              0);
    EXPECT_EQ(code({"star-discrepancy", "--check", "value < 0.001"}), 1);
    EXPECT_EQ(code({"star-discrepancy", "--check", "exact==true"}), 0);
    EXPECT_EQ(code({"star-discrepancy", "--check", "method==sweep-1d"}), 1);
    EXPECT_EQ(code({"star-discrepancy", "--check", "method==guess"}), 2);
    EXPECT_EQ(code({"star-discrepancy", "--check", "valeu<1"}), 2);
    EXPECT_EQ(code({"star-discrepancy", "--check", "value~1"}), 2);
    EXPECT_EQ(code({"chi-square", "--expect", "stratified"}), 0);
    EXPECT_EQ(code({"chi-square", "--expect", "uniform"}), 1);
    EXPECT_EQ(code({"chi-square", "--expect", "non-uniform"}), 1);
    EXPECT_EQ(code({"kolmogorov-smirnov", "--bounds", "0..2", "--expect", "non-uniform"}), 0);
    const Outcome failed = box.run({"analyze", "star-discrepancy", "h.csv", "--check", "value<0"});
    EXPECT_EQ(json::parse(failed.out)["analyzer"], "star-discrepancy");
    EXPECT_THAT(failed.err, HasSubstr("h.csv: value<0 does not hold: it is 0."));
    const Outcome other = box.run({"analyze", "star-discrepancy", "h.csv", "--domain", "disk"});
    EXPECT_EQ(other.code, 2);
    EXPECT_THAT(
        other.err,
        HasSubstr("--domain: star-discrepancy requires points of the unit cube, not of disk"));
    const Outcome two = box.run({"analyze", "star-discrepancy", "h.csv", "h.csv", "--method",
                                 "bounds", "--max-work", "1", "--tolerance", "0"});
    EXPECT_EQ(two.code, 0);
    EXPECT_THAT(
        two.err,
        HasSubstr(
            "stipple: note: h.csv: the star discrepancy is not known exactly; it is between "));
}

TEST(Analyze, SaysWhatTakesPointsOffASurface) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple generate random -n 100 -w sphere -f bin --dtype f32 | stipple analyze chi-square "
        "-d 3 --from bin --dtype f32 --domain sphere");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("points are outside the domain sphere"));
    EXPECT_THAT(outcome.err, HasSubstr("float32 or few digits move points off a surface"));
}

TEST(Analyze, LimitsNameTheFile) {
    const Sandbox box;
    box.write("deep.csv", box.run({"generate", "random", "-n", "300", "-d", "9"}).out);
    const auto refused = [&](const std::vector<std::string>& inputs) {
        std::vector<std::string> call{"analyze", "star-discrepancy", "--method",
                                      "exact",   "--max-work",       "1000"};
        call.insert(call.end(), inputs.begin(), inputs.end());
        const Outcome outcome = box.run(call);
        EXPECT_EQ(outcome.code, 5);
        return outcome.err;
    };
    constexpr const char* why = "the star discrepancy of 300 points in 9 dimensions takes more";
    EXPECT_THAT(refused({"deep.csv"}), HasSubstr(std::string("stipple: deep.csv: ") + why));
    EXPECT_THAT(refused({"deep.csv", "deep.csv"}),
                HasSubstr(std::string("stipple: deep.csv: ") + why));
}

TEST(Analyze, SeveralInputsAndSetsAreAnArrayOrAMean) {
    const Sandbox box;
    box.write("a.csv", box.run({"generate", "random", "-n", "200", "-m", "3"}).out);
    box.write("b.txt", box.run({"generate", "random", "-n", "200", "-s", "4", "-f", "txt"}).out);
    const auto all = report_of(box.run({"analyze", "star-discrepancy", "a.csv", "b.txt"}));
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[1]["input"]["set"], 1);
    EXPECT_FALSE(all[3]["input"].contains("set"));
    const auto mean =
        report_of(box.run({"analyze", "star-discrepancy", "a.csv", "b.txt", "--average"}));
    const auto twice = box.run({"analyze", "star-discrepancy", "a.csv", "a.csv", "--average"});
    EXPECT_EQ(report_of(twice)["input"]["source"], "a.csv") << "sources are not repeated";
    EXPECT_THAT(twice.err, HasSubstr("a.csv is given twice: its sets are averaged twice"));
    double sum = 0;
    for (const auto& one : all) sum += one["results"]["value"].get<double>();
    EXPECT_NEAR(mean["results"]["value"].get<double>(), sum / 4, 1e-15);
    double squares = 0;
    for (const auto& one : all)
        squares += std::pow(one["results"]["value"].get<double>() - sum / 4, 2);
    EXPECT_NEAR(mean["standard_error"]["value"].get<double>(), std::sqrt(squares / 12), 1e-15);
    EXPECT_EQ(mean["input"]["sets"], 4);
}

// The anisotropy of a mean spectrum is not the mean of anisotropies: it is lower by 10 log10(sets).
TEST(Analyze, AnAverageSpectrumHasItsOwnAnisotropy) {
    const Sandbox box;
    const auto out = report_of(box.shell(
        "stipple generate random -n 500 -m 100 | stipple analyze periodogram --max-frequency 30 "
        "--average"));
    const auto& radial = out["results"]["radial"];
    double sum = 0;
    for (std::size_t i = 10; i < 30; ++i) sum += radial["anisotropy_db"][i].get<double>();
    EXPECT_NEAR(sum / 20, -20, 1);
    EXPECT_TRUE(out["standard_error"]["radial"].contains("power"));
}

// Counts of prefixes are not measured: they have no mean and no error, and results form a table.
TEST(Analyze, AnAverageOfTablesIsATable) {
    const Sandbox box;
    const std::string table = good(
        box.shell("stipple analyze star-discrepancy --generate random -n 64 -m 3 --prefixes 16,64 "
                  "-f csv --average"));
    EXPECT_THAT(table, HasSubstr("prefixes.count,prefixes.value,"));
    EXPECT_THAT(table, HasSubstr("standard_error.prefixes.value"));
    EXPECT_THAT(table, Not(HasSubstr("standard_error.prefixes.count")));
    EXPECT_EQ(std::ranges::count(table, '\n'), 3);
}

TEST(Analyze, PrintsTextAndTables) {
    const Sandbox box;
    box.write("p.csv", "0.5,0.5\n");
    const Outcome text = box.run({"analyze", "star-discrepancy", "p.csv", "--format", "text"});
    EXPECT_THAT(text.out,
                HasSubstr("star-discrepancy of p.csv (1 points, dimension 2, unit-cube)"));
    EXPECT_THAT(text.out, HasSubstr("0.75"));
    const Outcome csv =
        box.run({"analyze", "star-discrepancy", "p.csv", "p.csv", "--format", "csv"});
    EXPECT_TRUE(csv.out.starts_with("analyzer,source,set,count,dimension,domain,value,"))
        << csv.out;
    EXPECT_THAT(csv.out, HasSubstr("\nstar-discrepancy,p.csv,,1,2,unit-cube,0.75,"));
    EXPECT_EQ(box.run({"analyze", "star-discrepancy", "p.csv", "-o", "out.csv"}).code, 0);
    EXPECT_TRUE(box.read("out.csv").starts_with("analyzer,"));
    EXPECT_EQ(box.run({"analyze", "star-discrepancy", "p.csv", "-o", "out.json"}).code, 0);
    EXPECT_EQ(json::parse(box.read("out.json"))["results"]["value"], 0.75);
}

TEST(Analyze, BoundsAndRescaleMapToTheCube) {
    const Sandbox box;
    const std::string points = "2,20\n";
    EXPECT_EQ(report_of(box.run({"analyze", "star-discrepancy", "--bounds", "0..4,0..40"},
                                points))["results"]["value"],
              0.75);
    EXPECT_EQ(report_of(box.run({"analyze", "star-discrepancy", "--rescale"},
                                "2,20\n4,40\n"))["results"]["value"],
              0.5);
    EXPECT_EQ(box.run({"analyze", "star-discrepancy", "--bounds", "0..1"}, points).code, 3);
}

TEST(Analyze, PicksColumns) {
    const Sandbox box;
    const std::string table = "name_a,b,c\n0.1,0.5,0.5\n";
    for (const char* columns : {"b,c", "2,3"})
        EXPECT_EQ(report_of(box.run({"analyze", "star-discrepancy", "--column", columns},
                                    table))["results"]["value"],
                  0.75);
    EXPECT_EQ(box.run({"analyze", "star-discrepancy", "--column", "b,d"}, table).code, 2);
}

TEST(Analyze, TheInverseOfAWarpGivesTheSetBack) {
    const Sandbox box;
    const auto plain =
        report_of(box.shell("stipple generate halton -n 500 | stipple analyze star-discrepancy"));
    const auto back = report_of(
        box.shell("stipple generate halton -n 500 -w disk | stipple warp disk --inverse | "
                  "stipple analyze star-discrepancy"));
    EXPECT_NEAR(back["results"]["value"].get<double>(), plain["results"]["value"].get<double>(),
                1e-13);
}

// --weights is a column of weights for periodogram, and a list of numbers for discrepancies.
TEST(Analyze, TakesWeightsOfEitherKind) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "20", "-o", "p.csv"}));
    const auto star = [&box](const char* unit, const std::vector<std::string>& more) {
        std::vector<std::string> words{"analyze", unit, "p.csv"};
        words.insert(words.end(), more.begin(), more.end());
        return report_of(box.run(words))["results"]["star"]["squared"].get<double>();
    };
    const double ones = star("l2-discrepancy", {"--weights", "1,1"});
    EXPECT_GT(ones, star("l2-discrepancy:weights=[0.5,1]", {}));
    EXPECT_GT(ones, star("l2-discrepancy", {}));  // which includes those of single axes
    EXPECT_EQ(star("l2-discrepancy", {"--weights", "0,0"}), 0);
    EXPECT_EQ(box.run({"analyze", "l2-discrepancy", "p.csv", "--weights", "1"}).code, 2);
    EXPECT_EQ(box.run({"analyze", "periodogram", "p.csv", "--weights", "z"}).code, 2);
}

// poisson-disk is both a generator and an analyzer.
TEST(Analyze, TakesNoValueOfAnOptionForItsUnit) {
    const Sandbox box;
    for (const std::string spec : {"poisson-disk", "poisson-disk:radius=0.1"}) {
        const json before = report_of(box.run({"analyze", "--generate", spec, "star-discrepancy"}));
        const json behind = report_of(box.run({"analyze", "star-discrepancy", "--generate", spec}));
        EXPECT_EQ(before["analyzer"], "star-discrepancy");
        EXPECT_EQ(before["results"], behind["results"]);
    }
}

TEST(Analyze, KnowsOfGeneratedPointsThatTheyAreIndependent) {
    const Sandbox box;
    const auto made = report_of(
        box.run({"analyze", "integration", "--generate", "random", "-n", "100", "-w", "disk"}));
    good(box.run({"generate", "random", "-n", "100", "-w", "disk", "-o", "p.json"}));
    const auto read = report_of(box.run({"analyze", "integration", "p.json"}));
    EXPECT_EQ(made["results"], read["results"]);
}

TEST(Analyze, AveragesSetsOfDifferentSizesWhereThatMeansSomething) {
    const Sandbox box;
    good(box.run({"generate", "sobol", "-n", "128", "-o", "a.csv"}));
    good(box.run({"generate", "sobol", "-n", "1024", "-o", "b.csv"}));
    for (const std::vector<std::string>& more : {std::vector<std::string>{"periodogram"},
                                                 {"periodogram", "--max-frequency", "20"},
                                                 {"chi-square"},
                                                 {"star-discrepancy"},
                                                 {"t-value"}}) {
        std::vector<std::string> words{"analyze", "a.csv", "b.csv", "--pool"};
        words.insert(words.begin() + 1, more.begin(), more.end());
        const Outcome outcome = box.run(words);
        EXPECT_EQ(outcome.code, 0) << more[0] << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("differ in their number of points")) << more[0];
    }
}

TEST(Analyze, WhatHasNoMeanHasNoStandardError) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "50", "-m", "3", "-o", "p.csv"}));
    for (const auto& [analyzer, gone] :
         {std::pair<std::string, std::vector<std::string>>{"nearest-neighbor", {"pair"}},
          {"coverage", {"center"}},
          {"poisson-disk", {"center", "first_conflict"}},
          {"periodogram",
           {"effective_nyquist", "oscillation", "total_variation", "low_frequency_exponent"}}}) {
        const auto mean = report_of(box.run({"analyze", analyzer, "p.csv", "--average"}));
        EXPECT_FALSE(mean["standard_error"].empty()) << analyzer;
        for (const auto& [key, error] : mean["standard_error"].items())
            EXPECT_TRUE(mean["results"].contains(key)) << analyzer << ' ' << key;
        for (const std::string& key : gone)
            EXPECT_FALSE(mean["standard_error"].contains(key)) << analyzer << ' ' << key;
    }
}

// Each of three sets has its own radius; a radius on the command line applies to all.
TEST(Analyze, VerifiesEverySetOfAFileByItsOwnRadius) {
    const Sandbox box;
    for (const std::string name : {"p.json", "p.jsonl", "p.csv", "p.txt"}) {
        const auto conflicts = [&](const std::vector<std::string>& more) {
            std::vector<std::string> words = {"generate", "poisson-disk", "-m",    "3",
                                              "-o",       name,           "--meta"};
            words.insert(words.end(), more.begin(), more.end());
            good(box.run(words));
            std::vector<std::string> found;
            for (const auto& one : report_of(box.run({"analyze", "poisson-disk", name})))
                found.push_back(one["results"]["conflicts"].dump() + " of " +
                                one["results"]["radius"].dump());
            return found;
        };
        const auto own = conflicts({"-n", "100"});
        ASSERT_EQ(own.size(), 3U) << name;
        for (const std::string& one : own) EXPECT_TRUE(one.starts_with("0 of 0.0")) << name << one;
        EXPECT_NE(own[0], own[1]) << name;
        EXPECT_EQ(conflicts({"--radius", "0.07"}), std::vector<std::string>(3, "0 of 0.07"))
            << name;
    }
}

TEST(Analyze, IntegratesWithErrorsFromTheSpreadOfSets) {
    const Sandbox box;
    const auto one = report_of(
        box.shell("stipple generate sobol -n 256 --meta | stipple analyze integration --integrand "
                  "zone-plate,genz-gaussian:seed=3"));
    ASSERT_EQ(one["results"].size(), 2U);
    const auto& plate = one["results"]["zone-plate"];
    EXPECT_EQ(plate["error"], plate["estimate"].get<double>() - plate["exact"].get<double>());
    EXPECT_FALSE(plate.contains("standard_error"));
    const auto random = report_of(
        box.shell("stipple generate random -n 256 -w disk --meta | stipple analyze integration "
                  "--expression 'x^2' --exact 0.7853981633974483"));
    const auto& formula = random["results"]["expression"];
    EXPECT_TRUE(formula["standard_error"].is_number());
    EXPECT_LT(std::abs(formula["error"].get<double>()),
              5 * formula["standard_error"].get<double>());
    const auto mean = report_of(
        box.shell("stipple generate sobol --scramble owen -n 64 -m 4 | stipple analyze integration "
                  "--integrand owen --average"));
    const auto& owen = mean["results"]["owen"];
    EXPECT_EQ(owen["standard_error"], mean["standard_error"]["owen"]["estimate"]);
    EXPECT_LT(owen["interval_low"], owen["interval_high"]);
    EXPECT_GT(owen["rms_error"], 0);
    EXPECT_EQ(box.shell("stipple generate grid -n 9 | stipple analyze integration --integrand "
                        "sky-radiance")
                  .code,
              3);
    EXPECT_EQ(
        box.shell("stipple generate grid -n 9 | stipple analyze integration --integrand skye").code,
        2);
}

// The results are the same for one thread and several, for a single file and many.
TEST(Analyze, SpreadsSetsOverThreadsAndTellsTheSame) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 60 -d 3 -m 11 -o sets.csv && "
                  "stipple generate random -n 70 -d 3 -m 5 -s 9 -o '{seed}.csv'"));
    const auto told = [&box](const std::string& options, const std::string& threads) {
        auto out =
            report_of(box.shell("stipple analyze star-discrepancy sets.csv 9.csv 10.csv "
                                "11.csv 12.csv 13.csv " +
                                options + " --threads " + threads));
        if (out.is_object()) out.erase("seconds");
        if (out.is_array())
            for (auto& one : out) one.erase("seconds");
        return out;
    };
    for (const std::string options : {"", "--average", "--every 35 --boxes half-open"}) {
        const json one = told(options, "1");
        EXPECT_EQ(one, told(options, "2")) << options;
        EXPECT_EQ(one, told(options, "3")) << options;
    }
    const json all = told("", "2");
    ASSERT_EQ(all.size(), 16U);
    EXPECT_EQ(all[10]["input"]["set"], 10);
    EXPECT_EQ(all[11]["input"]["source"], "9.csv");
    EXPECT_EQ(all[15]["input"]["source"], "13.csv");
}

// The first of several errors is reported, as if sets were measured one after the other.
TEST(Analyze, TellsTheFirstErrorOfManySetsForAnyNumberOfThreads) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 50 -m 6 -o '{set}.csv'"));
    box.write("far.csv", "0.5,0.5\n0.5,7\n");
    box.write("wide.csv", "0.5,-2\n");
    for (const char* threads : {"1", "2", "3"}) {
        const std::string analyze =
            fmt::format("stipple analyze star-discrepancy --threads {} ", threads);
        const Outcome far = box.shell(analyze + "0.csv 1.csv far.csv wide.csv 2.csv none.csv");
        EXPECT_EQ(far.code, 3);
        EXPECT_THAT(far.err, HasSubstr("far.csv"));
        EXPECT_EQ(far.out, "");
        const Outcome none = box.shell(analyze + "0.csv 1.csv 2.csv none.csv far.csv");
        EXPECT_EQ(none.code, 4);
        EXPECT_THAT(none.err, HasSubstr("none.csv"));
    }
}

TEST(Analyze, WritesDiscrepanciesOfPrefixesAndProjectionsAsTables) {
    const Sandbox box;
    const std::string table =
        good(box.shell("stipple generate halton -n 64 -d 3 | stipple analyze star-discrepancy "
                       "--prefixes 16,32,64 -f csv | cut -d , -f 1,4,7-10"));
    EXPECT_THAT(table,
                ::testing::StartsWith("analyzer,count,prefixes.count,prefixes.value,prefixes.lower,"
                                      "prefixes.upper\nstar-discrepancy,64,16,0."));
    EXPECT_EQ(std::ranges::count(table, '\n'), 4);
    const auto out =
        report_of(box.shell("stipple generate halton -n 64 -d 3 | stipple analyze "
                            "star-discrepancy --projections 2 "
                            "--check 'projections.largest.value<0.2'"));
    EXPECT_EQ(out["results"]["projections"]["axis_1"], (json{1, 1, 2}));
    EXPECT_EQ(out["results"]["projections"]["is_worst"].size(), 3U);
    EXPECT_EQ(out["options"]["projections"], 2);
    const auto mean = report_of(
        box.shell("stipple generate random -n 20 -d 3 -m 9 | stipple analyze star-discrepancy "
                  "--projections 2 --average"))["results"]["projections"];
    const std::vector<double> means = mean["value"];
    const auto worst = static_cast<std::size_t>(std::ranges::max_element(means) - means.begin());
    EXPECT_EQ(mean["is_worst"][worst], 1);
    EXPECT_EQ(mean["worst"], (json{mean["axis_1"][worst], mean["axis_2"][worst]}));
    const Outcome beyond = box.shell(
        "stipple generate halton -n 64 | stipple analyze "
        "star-discrepancy --prefixes 32,128");
    EXPECT_EQ(beyond.code, 3);
    EXPECT_EQ(beyond.err, "stipple: stdin: --prefixes: 128 is above the number of points, 64\n");
}

TEST(Analyze, SaysWhatPrefixesAndMixedUnitsTell) {
    const Sandbox box;
    const auto notes = [&](const std::string& make, const std::string& analyze) {
        const Outcome outcome =
            box.shell("stipple generate " + make + " | stipple analyze " + analyze);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.err;
    };
    const std::string prefixes = "star-discrepancy --prefixes 16,64";
    EXPECT_THAT(notes("jittered -n 64 -m 2 --meta", prefixes),
                HasSubstr("the points of jittered depend on the count: a prefix differs from a set "
                          "of fewer points"));
    for (const char* make : {"sobol -n 64 --meta", "jittered -n 64",
                             "poisson-disk -n 64 "
                             "--order progressive --meta"})
        EXPECT_EQ(notes(make, prefixes), "") << make;
    EXPECT_EQ(notes("jittered -n 64 --meta", "star-discrepancy"), "");
    const std::string make = "random -n 30 --bounds 0..1,0..100";
    EXPECT_EQ(notes(make, "nearest-neighbor --bounds 0..1,0..100"),
              "stipple: note: the sides of --bounds are between 1 and 100 long, and distances mix "
              "their units; with --rescale the box is first mapped to the unit cube\n");
    EXPECT_EQ(notes(make, "nearest-neighbor --bounds 0..1,0..100 --rescale"), "");
    EXPECT_THAT(
        notes(make, "nearest-neighbor --rescale"),
        HasSubstr("--rescale puts extreme points on opposite faces, which the torus joins"));
    EXPECT_EQ(notes(make, "nearest-neighbor --rescale --metric euclidean"), "");
    EXPECT_EQ(notes(make, "star-discrepancy --rescale"), "");
    EXPECT_EQ(notes(make, "nearest-neighbor --bounds 0..100"), "");
    EXPECT_EQ(notes(make, "star-discrepancy --bounds 0..1,0..100"), "");
}

// Copies of one set have the anisotropy of that set, not of a mean spectrum.
TEST(Analyze, CopiesOfOneSetAreNoEvidence) {
    const Sandbox box;
    const auto results = [&](const std::string& sets) {
        return report_of(
            box.shell("stipple analyze periodogram --generate halton -n 64 --average "
                      "--quiet -m " +
                      sets))["results"];
    };
    EXPECT_EQ(results("100"), results("1"));
    EXPECT_EQ(report_of(box.shell("stipple analyze kolmogorov-smirnov --generate jittered -n 64 "
                                  "--average -m 4"))["standard_error"]
                  .contains("combined_p_value"),
              false);
}

TEST(Analyze, SaysWhereRangesMixUnits) {
    const Sandbox box;
    box.write("w.csv", "height,weight\n1.5,60000\n1.7,75000\n1.8,90000\n");
    EXPECT_THAT(box.run({"analyze", "nearest-neighbor", "w.csv", "--metric", "euclidean"}).err,
                HasSubstr("the column 'weight' is used as the weight of the points"));
    box.write("t.csv", "height,mass\n1.5,60000\n1.7,75000\n1.8,90000\n");
    const Outcome mixed =
        box.run({"analyze", "nearest-neighbor", "t.csv", "--metric", "euclidean"});
    EXPECT_THAT(mixed.err, HasSubstr("the ranges of the coordinates are between 0.3 and 3e+04"));
    EXPECT_EQ(good(box.shell("stipple analyze nearest-neighbor t.csv --metric euclidean --rescale"))
                  .empty(),
              false);
}

// With --rescale, the box of --bounds is mapped to the unit cube.
TEST(Analyze, MapsTheBoxOfBoundsToTheCube) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 50 -o u.csv"));
    good(box.shell("stipple generate halton -n 50 --bounds 0..4,-8..8 --no-header -o b.csv"));
    const auto results = [&](const std::string& words) {
        return report_of(box.shell("stipple analyze nearest-neighbor " + words))["results"];
    };
    EXPECT_EQ(results("b.csv --bounds 0..4,-8..8 --rescale"), results("u.csv"));
    EXPECT_NE(results("b.csv --bounds 0..4,-8..8"), results("u.csv"));
}

TEST(Analyze, SaysHowSeveralAnalyzersAreNamed) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 50 -m 2 -f json -o u.json"));
    expect_refusal(box.run({"analyze", "star-discrepancy", "moments", "u.json"}), 2,
                   "separate several analyzers by commas: star-discrepancy,moments");
    const Outcome broken =
        box.run({"analyze", "star-discrepancy", "u.json", "--check", "value<0.01"});
    EXPECT_EQ(broken.code, 1);
    EXPECT_THAT(broken.err, HasSubstr("u.json, set 0: value<0.01 does not hold"));
    EXPECT_THAT(broken.err, HasSubstr("u.json, set 1: value<0.01 does not hold"));
    box.write("moments", "0.1,0.2\n0.3,0.4\n");  // a file may have an analyzer's name
    good(box.run({"analyze", "star-discrepancy", "moments"}));
}

TEST(Analyze, AveragesEachKindOfSetsByItself) {
    const Sandbox box;
    good(box.run({"generate", "random", "-n", "64", "-m", "2", "--meta", "-o", "a.csv"}));
    good(box.run({"generate", "random", "-n", "64", "-s", "7", "-o", "b.json"}));
    good(box.run({"generate", "random", "-n", "80", "--meta", "-o", "c.csv"}));
    good(box.run({"generate", "sobol", "-n", "64", "--meta", "-o", "d.csv"}));
    good(box.run({"generate", "sobol:scramble=owen", "-n", "64", "--meta", "-o", "e.csv"}));
    good(box.run({"generate", "random", "-n", "64", "-w", "disk", "--meta", "-o", "f.csv"}));
    good(box.run({"generate", "random", "-n", "64", "-d", "3", "--meta", "-o", "g.csv"}));
    for (const char* analyzer : {"nearest-neighbor", "moments", "periodogram"}) {
        SCOPED_TRACE(analyzer);
        const std::string line = std::string("stipple analyze ") + analyzer + " --bounds 0..1 ";
        const Outcome outcome = box.shell(line + "d.csv a.csv b.json c.csv e.csv g.csv --average");
        ASSERT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_THAT(outcome.err, HasSubstr("the sets are of 5 kinds"));
        EXPECT_THAT(outcome.err, HasSubstr("--pool gives one mean of all"));
        const json means = json::parse(outcome.out);
        ASSERT_EQ(means.size(), 5U);
        EXPECT_EQ(means[1]["input"]["sets"], 3);
        EXPECT_EQ(means[1]["input"]["source"], "a.csv, b.json");
        EXPECT_EQ(means[1]["results"],
                  report_of(box.shell(line + "a.csv b.json --average"))["results"]);
        EXPECT_EQ(means[2]["results"], report_of(box.shell(line + "c.csv"))["results"]);
        const Outcome pooled = box.shell(line + "d.csv a.csv b.json c.csv e.csv --pool");
        EXPECT_EQ(json::parse(pooled.out)["input"]["sets"], 6);
    }
    const Outcome warped = box.run({"analyze", "moments", "a.csv", "f.csv", "--average"});
    EXPECT_EQ(json::parse(warped.out).size(), 2U);
}

// Sets without provenance are grouped by their number of points, except those of one file.
TEST(Analyze, AveragesWhatComesWithoutProvenanceByItsNumberOfPoints) {
    const Sandbox box;
    for (const char* analyzer : {"nearest-neighbor", "periodogram"}) {
        const std::string average = std::string(" | stipple analyze ") + analyzer + " --average";
        const Outcome one =
            box.shell("stipple generate poisson-disk --radius 0.1 -m 4 -f csv" + average);
        EXPECT_EQ(json::parse(one.out)["input"]["sets"], 4);
        good(
            box.shell("stipple generate random -n 40 -o a.csv; stipple generate random -n 40 "
                      "-s 2 -o b.csv; stipple generate random -n 60 -o c.csv"));
        const Outcome two =
            box.shell(std::string("stipple analyze ") + analyzer + " a.csv c.csv b.csv --average");
        const json means = json::parse(two.out);
        ASSERT_EQ(means.size(), 2U);
        EXPECT_EQ(means[0]["input"]["source"], "a.csv, b.csv");
        EXPECT_EQ(means[1]["input"]["count"], 60);
    }
}

TEST(Analyze, PoolsOnlySetsOfOneDimension) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple generate random -n 9 -d 2 -o a.csv && stipple generate random -n 9 -d 3 -o b.csv "
        "&& stipple analyze nearest-neighbor a.csv b.csv --pool");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("--pool: the sets have points of 2 and of 3 coordinates"));
}

// Distances are computed in the box of --bounds as in that of --domain; integrals include its
// volume.
TEST(Analyze, BoundsAreWhatThePointsLiveOn) {
    const Sandbox box;
    const std::string points = "0.5,1\n1.5,1\n";
    const auto found = [&](const std::vector<std::string>& words) {
        return report_of(box.run(words, points))["results"];
    };
    for (const auto& [option, text] :
         {std::pair{"--bounds", "0..2,0..8"}, {"--domain", "box:bounds=[0..2,0..8]"}}) {
        const auto near = found({"analyze", "nearest-neighbor", option, text});
        EXPECT_EQ(near["minimum"], 1.0) << option;
        const auto volume = found({"analyze", "integration", "--expression", "1", option, text});
        EXPECT_EQ(volume["expression"]["estimate"], 16.0) << option;
        EXPECT_EQ(found({"analyze", "moments", option, text})["exact"]["mean"][1], 4.0) << option;
    }
}

// Measuring with several analyzers in one pass gives the same results as with each alone.
TEST(Analyze, MeasuresBySeveralAnalyzers) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 90 -m 3 -o a.json"));
    good(box.shell("stipple generate halton -n 90 -o b.csv"));
    const std::string both = "'star-discrepancy:kind=extreme,moments,periodogram:max-frequency=4'";
    const std::vector<std::string> alone = {"star-discrepancy --kind extreme", "moments",
                                            "periodogram --max-frequency 4"};
    const auto without_seconds = [](json report) {
        report.erase("seconds");
        return report;
    };
    for (const std::string more : {"", " --average --quiet", " --threads 1"}) {
        const json all =
            json::parse(good(box.shell("stipple analyze " + both + " a.json b.csv" + more)));
        const std::size_t sets = more.starts_with(" --average") ? 2 : 4;
        ASSERT_EQ(all.size(), 3 * sets);
        for (std::size_t i = 0; i < alone.size(); ++i) {
            const json own = json::parse(
                good(box.shell("stipple analyze " + alone[i] + " a.json b.csv" + more)));
            for (std::size_t set = 0; set < sets; ++set)
                EXPECT_EQ(without_seconds(all[3 * set + i]), without_seconds(own[set])) << more;
        }
    }
    const json piped = json::parse(good(box.shell(
        "cat b.csv | stipple analyze 'star-discrepancy;moments' --json -o r.txt; cat r.txt")));
    ASSERT_EQ(piped.size(), 2U);
    EXPECT_EQ(piped[1]["analyzer"], "moments");
}

TEST(Analyze, ChecksResultsOfSeveralAnalyzersByTheirNames) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 90 -o b.csv"));
    const std::string call =
        "stipple analyze star-discrepancy,moments,poisson-disk:radius=0.5 b.csv ";
    EXPECT_EQ(box.shell(call + "--check 'star-discrepancy<0.1' --check 'moments.mean[0]<0.6'").code,
              0);
    const auto refused = [&](const std::string& words, int code, const char* why) {
        expect_refusal(box.shell(call + words), code, why);
    };
    refused("--check 'star-discrepancy<0.01' -o r.json", 1,
            "b.csv: star-discrepancy.value<0.01 does not hold: it is 0.0");
    refused("--check -o r.json", 1, "b.csv: poisson-disk.valid==true does not hold");
    refused("--check 'mean[0]<0.6'", 2, "such as star-discrepancy.mean[0] or moments.mean[0]");
    refused("--radius 0.1", 2, "options follow the analyzer's name; such as poisson-disk:radius=");
    expect_refusal(box.shell("stipple analyze moments,momnets b.csv"), 2,
                   "unknown analyzer 'momnets'; did you mean 'moments'?");
    expect_refusal(box.shell("stipple analyze moments,t-value b.csv"), 3, "b.csv: t-value");
    EXPECT_EQ(
        box.shell("stipple analyze star-discrepancy b.csv --check 'star-discrepancy<0.1'").code, 0);
}

TEST(Analyze, TakesGeneratorsBehindFiles) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 90 -o b.csv"));
    const json all = json::parse(good(box.shell(
        "stipple analyze moments b.csv --generate halton --generate random -n 90 -m 2 --seed 7 "
        "--quiet")));
    ASSERT_EQ(all.size(), 5U);
    EXPECT_EQ(all[0]["results"], all[1]["results"]);
    EXPECT_EQ(all[2]["input"], json::parse(R"({"source": "halton", "set": 1, "count": 90,
                                              "dimension": 2, "domain": "unit-cube"})"));
    good(box.shell("stipple generate random -n 90 -s 8 -o c.csv"));
    const json last = json::parse(good(box.shell("stipple analyze moments c.csv")));
    EXPECT_EQ(all[4]["results"], last["results"]);
    const Outcome means = box.shell(
        "stipple analyze moments --generate halton --generate random --average -m 2 -n 9");
    EXPECT_EQ(json::parse(means.out).size(), 2U);
    EXPECT_EQ(means.err, "stipple: note: halton does not use the seed: all 2 sets are the same\n");
}

TEST(Analyze, TextHasAllNumbersOfListsWhereItIsAsked) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 90 -o a.csv"));
    const std::string analyze = "stipple analyze periodogram a.csv --max-frequency 12 -f ";
    EXPECT_THAT(good(box.shell(analyze + "text")), HasSubstr("... (12 values)"));
    const std::string full = good(box.shell(analyze + "text --full"));
    EXPECT_THAT(full, ::testing::Not(HasSubstr("...")));
    const json report = json::parse(good(box.shell(analyze + "json")));
    const double last = report["results"]["radial"]["power"][11];
    EXPECT_THAT(full,
                HasSubstr("radial.frequency radial.power radial.anisotropy_db radial.cells\n"));
    EXPECT_THAT(full, HasSubstr(fmt::format(" 12 {:>12.6g} ", last)));
}

TEST(Analyze, ArrayIsAnArrayForOneReportToo) {
    const Sandbox box;
    const std::string one = "stipple analyze moments --generate random --no-seconds --keys mean ";
    const auto array = json::parse(good(box.shell(one + "--array")));
    EXPECT_EQ(array, json::array({json::parse(good(box.shell(one)))}));
    EXPECT_EQ(good(box.shell(one + "-m 2 --array")), good(box.shell(one + "-m 2")));
    good(
        box.shell("stipple analyze periodogram --generate random -n 64 --array -o a.json && "
                  "stipple plot a.json -o a.svg"));
    expect_refusal(box.shell(one + "--array -f csv"), 2, "--array: requires --format json");
    expect_refusal(box.shell(one + "--array -o a.txt"), 2, "--array: requires --format json");
}

TEST(Analyze, GeneratedSetsHaveTheirOwnWarps) {
    const Sandbox box;
    const auto reports = json::parse(
        good(box.shell("stipple analyze moments --no-seconds --generate 'rank1-lattice -w owen' "
                       "--generate 'sobol --scramble owen' -n 32 -s 3 -w disk")));
    std::size_t i = 0;
    for (const std::string made : {"rank1-lattice -w owen", "sobol --scramble owen"}) {
        auto alone = json::parse(good(box.shell("stipple generate -q " + made +
                                                " --meta -n 32 -s 3 -w disk | "
                                                "stipple analyze moments --no-seconds")));
        EXPECT_EQ(reports[i]["input"]["source"], made);
        EXPECT_EQ(reports[i++]["results"], alone["results"]) << made;
    }
    expect_refusal(box.shell("stipple analyze moments --generate 'sobol -w dsk'"), 2,
                   "unknown warp 'dsk'");
    good(box.shell(
        "stipple report --generate 'rank1-lattice -w cranley-patterson' -n 16 -o r.html"));
    EXPECT_NE(box.read("r.html").find(
                  "stipple generate rank1-lattice --warp cranley-patterson --count 16"),
              std::string::npos);
}

// The mean of one set has that set's locations; the mean of several has none.
TEST(Analyze, TheMeanOfOneSetHasItsPlaces) {
    const Sandbox box;
    const auto found = [&](const std::string& sets) {
        return json::parse(
            good(box.shell("stipple analyze dispersion --generate random -n 20 --average "
                           "-m " +
                           sets)))["results"];
    };
    EXPECT_TRUE(found("1").contains("box"));
    EXPECT_FALSE(found("2").contains("box"));
}

TEST(Analyze, RescalesCoordinatesThatAreAllTheSame) {
    const Sandbox box;
    box.write("p.csv", "x,y\n1e17,0.1\n1e17,0.5\n1e17,0.3\n");
    const auto report = json::parse(
        good(box.run({"analyze", "star-discrepancy", "p.csv", "--rescale", "--format", "json"})));
    EXPECT_EQ(report["results"]["value"], 1);
}

}  // namespace stipple::testing::analyze_test
