// SPDX-License-Identifier: MIT
//
// Conditions on results: --check with and without a condition.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "support/program.hpp"

namespace stipple::testing::check_test {

using nlohmann::json;
using ::testing::HasSubstr;

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

}  // namespace stipple::testing::check_test
