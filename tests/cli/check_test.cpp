// SPDX-License-Identifier: MIT
//
// Conditions on results: --check with and without a condition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::check_test {

using nlohmann::json;
using ::testing::HasSubstr;
using ::testing::StartsWith;

namespace {

using Words = std::vector<std::string>;

/// A directory with a maximal set of radius 0.1 (good.csv) and a random one (bad.csv).
struct Sets {
    Sandbox box;

    Sets() {
        good(box.run({"generate", "poisson-disk", "--radius", "0.1", "-o", "good.csv"}));
        good(box.run({"generate", "random", "-n", "100", "-o", "bad.csv"}));
    }

    [[nodiscard]] Outcome verify(Words more) const {
        more.insert(more.begin(), {"analyze", "poisson-disk"});
        return box.run(more);
    }
};

}  // namespace

TEST(Check, AloneAsksWhetherTheSetIsValid) {
    const Sets sets;
    const std::vector<Words> forms = {{"--radius", "0.1", "FILE", "--check"},
                                      {"--radius", "0.1", "--check", "FILE"},
                                      {"--check", "--radius", "0.1", "FILE"},
                                      {"FILE", "--check", "--radius=0.1"},
                                      {"FILE", "--check", "--check", "--radius=0.1"},
                                      {"--check", "--radius=0.1", "--check", "radius<=0.1", "FILE"},
                                      {"--check", "radius<1", "--check", "FILE", "--radius=0.1"},
                                      {"FILE", "--radius=0.1", "--check", "valid == true"}};
    for (const Words& form : forms)
        for (const std::string file : {"good.csv", "bad.csv"}) {
            Words words = form;
            std::ranges::replace(words, std::string("FILE"), file);
            const Outcome outcome = sets.verify(words);
            const std::string shown = ::testing::PrintToString(words) + outcome.err;
            EXPECT_EQ(outcome.code, file == "good.csv" ? 0 : 1) << shown;
            ASSERT_EQ(json::parse(outcome.out)["input"]["source"], file) << shown;
            if (file == "bad.csv")
                EXPECT_THAT(outcome.err,
                            HasSubstr("bad.csv: valid==true does not hold: it is false\n"));
            else
                EXPECT_EQ(outcome.err, "") << shown;
        }
}

TEST(Check, AloneTakesAllInputsAndStandardInput) {
    const Sets sets;
    const Outcome both = sets.verify({"--radius=0.1", "good.csv", "--check", "bad.csv"});
    EXPECT_EQ(both.code, 1);
    EXPECT_EQ(json::parse(both.out).size(), 2U);
    EXPECT_EQ(both.err, "stipple: bad.csv: valid==true does not hold: it is false\n");
    const std::string verify = "cat good.csv | stipple analyze poisson-disk --radius 0.1 --check";
    EXPECT_EQ(sets.box.shell(verify + " -").code, 0);
    EXPECT_EQ(sets.box.shell(verify).code, 0);
}

TEST(Check, OfAMeanNeedsAllSetsToBeValid) {
    const Sets sets;
    const Words average = {"--radius=0.1", "--average", "--check"};
    const auto code = [&](const Words& files) {
        Words words = average;
        words.insert(words.end(), files.begin(), files.end());
        return sets.verify(words).code;
    };
    EXPECT_EQ(code({"good.csv", "good.csv"}), 0);
    EXPECT_EQ(code({"good.csv", "bad.csv"}), 1);
    EXPECT_EQ(code({"bad.csv", "good.csv"}), 1);
    EXPECT_EQ(code({"bad.csv", "bad.csv"}), 1);
}

// The mean may meet a condition that single sets do not, and the other way round.
TEST(Check, ExpectationsAreOfTheMean) {
    const Sets sets;
    for (const Words& files :
         {Words{"good.csv", "bad.csv"}, {"bad.csv", "good.csv"}, {"bad.csv"}}) {
        Words words = {"--radius=0.1", "--average", "--expect", "valid"};
        words.insert(words.end(), files.begin(), files.end());
        const Outcome outcome = sets.verify(words);
        EXPECT_EQ(outcome.code, 1);
        EXPECT_THAT(outcome.err, HasSubstr("not all are maximal Poisson-disk sets\n"));
    }
    EXPECT_EQ(sets.verify({"--average", "--expect", "valid", "good.csv", "good.csv"}).code, 0);
    // p = 0.021 for seed 9, 0.14 for seed 1, and 0.054 for all nine together.
    good(sets.box.shell(
        "for s in 1 2 3 4 5 6 7 8 9; do stipple generate random -n 100 -s $s -o r$s.csv; done"));
    const auto judge = [&](const std::string& rest) {
        return sets.box.shell("stipple analyze chi-square --expect uniform --level " + rest);
    };
    EXPECT_EQ(judge("0.05 r9.csv").code, 1);
    EXPECT_EQ(judge("0.05 --average r9.csv r[1-8].csv").code, 0);
    EXPECT_EQ(judge("0.06 r1.csv").code, 0);
    const Outcome mean = judge("0.06 --average r1.csv r[2-9].csv");
    EXPECT_EQ(mean.code, 1);
    EXPECT_THAT(mean.err, HasSubstr("r9.csv: expected uniform, found non-uniform (p = 0.0537)"));
}

TEST(Check, WithoutAConditionIsRefusedWhereNothingTellsWhetherASetIsValid) {
    const Sets sets;
    for (const Words& more : {Words{"--check"}, {"--check", "value~1"}, {"--check", "--quiet"}}) {
        Words words = {"analyze", "star-discrepancy", "good.csv"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = sets.box.run(words);
        EXPECT_EQ(outcome.code, 2);
        EXPECT_EQ(outcome.out, "");
        EXPECT_THAT(outcome.err,
                    HasSubstr("--check: star-discrepancy has no result that says whether a set "
                              "is valid; expected KEY<VALUE"));
        EXPECT_THAT(outcome.err, HasSubstr("its results are value, "));
    }
    EXPECT_EQ(sets.verify({"good.csv", "--check", "valid<"}).code, 2);
    EXPECT_EQ(sets.verify({"good.csv", "--check", "gone.csv"}).code, 4);
}

// The results that are printed, in all formats; conditions see all results.
TEST(Keys, SelectTheResultsToPrint) {
    const Sandbox box;
    const std::string points = " --generate halton -n 64";
    const std::string star = "stipple analyze star-discrepancy" + points;
    const auto results = [&box](const std::string& command) {
        return json::parse(good(box.shell(command + " -f json")))["results"];
    };
    const json all = results(star);
    EXPECT_EQ(results(star + " --keys value"), (json{{"value", all["value"]}}));
    const json box_alone = {{"worst_box", all["worst_box"]}};
    EXPECT_EQ(results(star + " --keys worst_box --check 'value<1'"), box_alone);
    EXPECT_EQ(results(star + " --keys corner,value").size(), 2U);
    EXPECT_EQ(results(star + " --keys 'corner[1]'")["worst_box"]["corner[1]"],
              all["worst_box"]["corner"][1]);
    EXPECT_THAT(good(box.shell(star + " --keys value -f csv")),
                StartsWith("analyzer,source,set,count,dimension,domain,value\n"));
    const std::string text = good(box.shell(star + " --keys star-discrepancy -f text"));
    EXPECT_THAT(text, HasSubstr("\n  value  0."));
    EXPECT_EQ(std::ranges::count(text, '\n'), 2);
    const std::string mean = good(
        box.shell("stipple analyze moments --generate random -m 4 --average --keys mean -f json"));
    EXPECT_TRUE(json::parse(mean)["standard_error"].contains("mean"));
    EXPECT_FALSE(json::parse(mean)["standard_error"].contains("variance"));
}

TEST(Keys, AreThoseOfTheAnalyzers) {
    const Sandbox box;
    const std::string one = "stipple analyze star-discrepancy --generate halton --keys ";
    expect_refusal(box.shell(one + "vlaue"), 2,
                   "--keys: star-discrepancy has no result 'vlaue'; did you mean 'value'?");
    expect_refusal(box.shell(one + "value,"), 2, "has no result ''");
    expect_refusal(box.shell(one + "'corner[2]'"), 2,
                   "--keys: 'corner[2]' is not a key; worst_box.corner has 2 numbers, from [0]");
    const std::string two = "stipple analyze star-discrepancy,moments --generate halton --keys ";
    const json both = json::parse(good(box.shell(two + "star-discrepancy,moments.mean -f json")));
    EXPECT_TRUE(both[0]["results"].contains("value") && both[0]["results"].size() == 1);
    EXPECT_TRUE(both[1]["results"].contains("mean") && !both[1]["results"].contains("variance"));
    expect_refusal(box.shell(two + "value"), 2,
                   "--keys: 'value' does not begin with the name of one of the analyzers; such as "
                   "star-discrepancy.value or moments.value");
    const json one_of_two = json::parse(good(box.shell(two + "moments.mean -f json")));
    EXPECT_EQ(one_of_two["results"], both[1]["results"]);
    const json same = json::parse(
        good(box.shell("stipple analyze l2-discrepancy:kind=star,l2-discrepancy:kind=centered "
                       "--generate halton --keys l2-discrepancy.value -f json")));
    EXPECT_TRUE(same[0]["results"].contains("star") && same[1]["results"].contains("centered"));
}

TEST(NoSeconds, GivesTheSameBytesAgain) {
    const Sandbox box;
    const std::string command = "stipple analyze moments --generate halton -f json --no-seconds";
    const std::string text = good(box.shell(command));
    EXPECT_FALSE(json::parse(text).contains("seconds"));
    EXPECT_EQ(good(box.shell(command)), text);
}

}  // namespace stipple::testing::check_test
