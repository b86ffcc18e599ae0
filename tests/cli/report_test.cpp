// SPDX-License-Identifier: MIT
//
// The verb report: sets in; one page out that a browser shows without errors, or no page.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>

#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::report_test {

using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// Runs Chromium on a page of the directory, with its console on stderr.
Outcome browse(const Sandbox& box, const std::string& options, const std::string& page) {
    return box.shell(
        "chromium --headless --no-sandbox --disable-gpu --enable-logging=stderr "
        "--virtual-time-budget=5000 --user-data-dir=\"$PWD/profile\" " +
        options + " \"file://$PWD/" + page + "\"");
}

bool has_browser(const Sandbox& box) { return box.shell("command -v chromium").code == 0; }

nlohmann::json data_of(const Outcome& outcome) { return nlohmann::json::parse(good(outcome)); }

}  // namespace

TEST(Report, IsOnePageThatComparesFilesAndGeneratedSets) {
    const Sandbox box;
    good(
        box.shell("stipple generate halton -n 200 -o a.csv && stipple generate random -n 200 -f "
                  "json -o b.json && stipple report a.csv b.json --generate "
                  "sobol:scramble=owen --generate jittered -n 200 -o r.html 2>notes"));
    const std::string page = box.read("r.html");
    for (const char* words : {"a.csv", "b.json", "sobol:scramble=owen", "jittered", " best\"",
                              "Star discrepancy", "Left out", "prefers-color-scheme"})
        EXPECT_THAT(page, HasSubstr(words));
    EXPECT_THAT(page, Not(HasSubstr("://")));
}

TEST(Report, DoesNotOverwriteWhatItIsAbout) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 20 -o a.csv && ln -s a.csv b.html"));
    const std::string before = box.read("a.csv");
    for (const char* output : {"a.csv", "./a.csv", "b.html"}) {
        const Outcome outcome = box.run({"report", "a.csv", "-o", output});
        EXPECT_EQ(outcome.code, 2);
        EXPECT_THAT(outcome.err, HasSubstr("is an input, which it would overwrite"));
    }
    EXPECT_EQ(box.read("a.csv"), before);
}

// The script marks the page when it has run to its end.
TEST(Report, ChromiumShowsItWithoutComplaints) {
    const Sandbox box;
    if (!has_browser(box)) GTEST_SKIP() << "chromium is not installed";
    good(
        box.shell("stipple generate halton -n 300 -o 'a<b>.csv' && stipple report 'a<b>.csv' "
                  "--generate random -n 300 -o flat.html && stipple report --generate halton "
                  "--generate random -d 4 -n 300 --max-work 100000 -o deep.html"));
    for (const std::string page : {"flat.html", "deep.html"}) {
        const Outcome seen = browse(box, "--dump-dom", page);
        EXPECT_EQ(seen.code, 0) << seen.err;
        EXPECT_THAT(seen.out, HasSubstr("data-ready=\"yes\""));
        EXPECT_THAT(seen.err, Not(HasSubstr("CONSOLE"))) << page;
    }
    EXPECT_EQ(browse(box, "--screenshot=a.png --window-size=400,800", "flat.html").code, 0);
    EXPECT_EQ(box.read("a.png").substr(0, 4), "\x89PNG");
    EXPECT_EQ(browse(box, "--print-to-pdf=a.pdf", "flat.html").code, 0);
    EXPECT_EQ(box.read("a.pdf").substr(0, 5), "%PDF-");
}

// The page's script marks the same values as the program: hiding a set gives the marks of a page
// without it.
TEST(Report, MarksTheBestOfTheSetsThatAreShown) {
    const Sandbox box;
    if (!has_browser(box)) GTEST_SKIP() << "chromium is not installed";
    const std::string others = "--generate random --generate 'sobol:scramble=owen' ";
    good(box.shell(
        "stipple generate halton -n 256 -o a.csv; stipple generate halton -n 99 -o b.csv; "
        "stipple report a.csv " +
        others +
        "-n 256 -o three.html; "
        "stipple report b.csv " +
        others +
        "-n 256 -o sizes.html; "
        "stipple report " +
        others + "-n 256 -o two.html"));
    const auto marks = [](const std::string& page) {  // "KEY:.*." for each row with a key
        std::vector<std::string> rows;
        const std::regex part(
            "data-key=\"([^\"]*)|<td class=\"number( best)?[^\"]*\" data-set|(</tr>)");
        bool inside = false;
        for (std::sregex_iterator it(page.begin(), page.end(), part), end; it != end; ++it) {
            const auto& found = *it;
            if (found[1].matched) rows.push_back(found[1].str() + ":");
            if (!found[1].matched && !found[3].matched && inside)
                rows.back() += found[2].matched ? '*' : '.';
            inside = found[1].matched || (inside && !found[3].matched);
        }
        return rows;
    };
    std::vector<std::string> expected = marks(box.read("two.html"));
    EXPECT_THAT(expected, ::testing::Contains(HasSubstr("*")));
    for (std::string& row : expected) row.insert(row.find(':') + 1, ".");  // the hidden set
    for (const std::string name : {"three.html", "sizes.html"}) {
        std::string page = box.read(name);
        page.insert(page.rfind("</body>"),
                    "<script>document.querySelector('nav input[value=\"0\"]').click()</script>");
        EXPECT_NE(marks(page), expected) << name;
        box.write("hidden.html", page);
        EXPECT_EQ(marks(browse(box, "--dump-dom", "hidden.html").out), expected) << name;
    }
}

// Checks that the tests above would detect errors in the browser.
TEST(Report, ChromiumsComplaintsWouldBeSeen) {
    const Sandbox box;
    if (!has_browser(box)) GTEST_SKIP() << "chromium is not installed";
    box.write("bad.html", "<!DOCTYPE html><title>bad</title><script>none.of()</script>");
    EXPECT_THAT(browse(box, "--dump-dom", "bad.html").err, HasSubstr("CONSOLE"));
}

TEST(Report, DependsOnTheSetsAloneNotOnThreads) {
    const Sandbox box;
    const std::string make =
        "report --generate random --generate halton -n 300 -d 3 --max-work 200000 ";
    good(box.shell("stipple " + make + "--threads 1 -o one.html"));
    good(box.shell("stipple " + make + "--threads 3 -o two.html"));
    EXPECT_EQ(box.read("one.html"), box.read("two.html"));
    EXPECT_EQ(good(box.shell("stipple " + make + "--json --threads 1")),
              good(box.shell("stipple " + make + "--json --threads 4")));
}

// Every number of the page is printed by its command.
TEST(Report, ItsCommandsMeasureTheSameNumbers) {
    const Sandbox box;
    good(box.shell("stipple generate random -n 60 -d 3 -m 2 -o two.csv"));
    const auto page = data_of(
        box.shell("stipple report two.csv --generate 'sobol:scramble=owen' -n 64 -d 3 --seed 7 "
                  "--max-work 50000 --json"));
    ASSERT_EQ(page["sets"].size(), 3U);
    std::size_t checked = 0;
    for (const auto& set : page["sets"])
        for (const auto& measure : set["measures"]) {
            EXPECT_EQ(measure.contains("left_out"), !measure.contains("command"));
            if (measure.contains("left_out")) continue;
            const Outcome again = box.shell(measure["command"].get<std::string>());
            ASSERT_EQ(again.code, 0) << measure["command"] << again.err;
            const auto found = nlohmann::json::parse(again.out);
            const auto& one = found.is_array() ? found[set["set"].get<std::size_t>()] : found;
            EXPECT_EQ(one["results"], measure["results"]) << measure["command"];
            ++checked;
        }
    EXPECT_GE(checked, 30U);
}

TEST(Report, LeavesOutRowsWithMissingNumbers) {
    const Sandbox box;
    box.write("p.csv", "x,y\n0.1,0.2\n,0.5\n0.3,NA\n0.4,nan\n0.9,0.8\n0.2,0.6\n");
    const Outcome outcome = box.run({"report", "p.csv", "-o", "p.html"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("p.csv: 3 of 6 rows are left out"));
    EXPECT_THAT(box.read("p.html"), HasSubstr("3 points in 2 dimensions"));
    EXPECT_THAT(box.read("p.html"), HasSubstr("without 3 rows that have missing numbers"));
    EXPECT_THAT(box.read("p.html"), Not(HasSubstr("stipple analyze")));
}

TEST(Report, ChecksWhatItIsToldTo) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 100 -o a.csv"));
    const std::string report = "stipple report a.csv -o r.html --check ";
    EXPECT_EQ(box.shell(report + "'star-discrepancy.value<=0.5'").code, 0);
    EXPECT_EQ(box.shell(report + "'star-discrepancy<=0.5'").code, 0);
    const Outcome failed = box.shell(report + "'star-discrepancy<=0.001'");
    expect_refusal(failed, 1, "a.csv: star-discrepancy.value<=0.001 does not hold: it is 0.");
    EXPECT_TRUE(box.exists("r.html"));
    EXPECT_EQ(box.shell(report + "'chi-square.verdict!=non-uniform'").code, 0);
    EXPECT_EQ(box.shell(report + "'chi-square.verdict==uniform' --check 'dispersion<=1'").code, 1);
    EXPECT_EQ(box.shell(report + "'kolmogorov-smirnov.statistic[1]<0.9'").code, 0);
}

// --fail-on is the older form of --check.
TEST(Report, FailsOnTheOppositeAndSaysSo) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 100 -o a.csv"));
    const std::string report = "stipple report a.csv -o r.html --fail-on ";
    const Outcome fine = box.shell(report + "'star-discrepancy>0.5'");
    EXPECT_EQ(fine.code, 0);
    EXPECT_EQ(fine.err,
              "stipple: note: --fail-on star-discrepancy>0.5 is the older form of --check "
              "'star-discrepancy.value<=0.5'\n");
    const Outcome failed = box.shell(report + "'star-discrepancy>0.001' --quiet");
    expect_refusal(failed, 1, "a.csv: star-discrepancy.value<=0.001 does not hold: it is 0.");
    EXPECT_EQ(box.shell(report + "'chi-square.verdict!=uniform' --fail-on 'dispersion>1'").code, 1);
    EXPECT_EQ(box.shell(report + "'chi-square.verdict==non-uniform'").code, 0);
}

// A condition that bounds leave open counts as failed.
TEST(Report, FailsWhereBoundsLeaveItOpen) {
    const Sandbox box;
    const std::string report =
        "stipple report --generate random -n 200 -d 6 --max-work 20000 -o r.html --check ";
    const Outcome open = box.shell(report + "'star-discrepancy<=0.3'");
    expect_refusal(open, 1, "is between");
    EXPECT_EQ(box.shell(report + "'star-discrepancy<=1'").code, 0);
}

// Impossible conditions are rejected before anything is measured.
TEST(Report, RefusesConditionsThatNeverHold) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 20 -d 5 -o a.csv"));
    const auto expect = [&](const char* condition, const char* words) {
        for (const char* option : {"--check", "--fail-on"}) {
            const Outcome outcome = box.run(
                {"report", "a.csv", "--max-work", "1000", option, condition, "-o", "r.html"});
            expect_refusal(outcome, 2, words);
            EXPECT_THAT(outcome.err, HasSubstr(option));
        }
    };
    expect("chi-square.verdict==foo", "possible values: uniform, non-uniform or stratified");
    expect("star-discrepancy.exact==1", "possible values: true or false");
    expect("star-discrepancy=1", "did you mean '=='?");
    expect("l2-discrepancy>1", "its keys are l2-discrepancy.star.value, ");
    expect("t-value>1", "its keys are t-value.t, ");
    expect("nearest-neighbor>1", "its keys are nearest-neighbor.minimum, ");
    expect("nearest-neighbor.minimun>1", "did you mean 'nearest-neighbor.minimum'?");
    expect("disperson.value>1", "did you mean 'dispersion'?");
    expect("l2-discrepancy.stra.value>1", "did you mean 'l2-discrepancy.star.value'?");
    EXPECT_FALSE(box.exists("r.html"));
}

// A condition on a missing measure counts as failed; the page says the same.
TEST(Report, FailsWhereAMeasureWasLeftOut) {
    const Sandbox box;
    good(box.shell("stipple generate halton -n 20 -o a.csv"));
    box.write("out.csv", "0.5,1.5\n0.2,0.3\n0.7,0.1\n");
    for (const char* sets : {"a.csv out.csv", "out.csv"}) {
        const Outcome outcome = box.shell(std::string("stipple report ") + sets +
                                          " -o r.html --check 'star-discrepancy<=0.9'");
        expect_refusal(outcome, 1,
                       "out.csv: star-discrepancy.value<=0.9 does not hold: it is not known (");
        EXPECT_THAT(outcome.err, Not(HasSubstr("a.csv: ")));
        EXPECT_TRUE(box.exists("r.html"));
    }
}

TEST(Report, RefusesWhatItCannotReportOn) {
    const Sandbox box;
    good(
        box.shell("stipple generate random -n 20 -o a.csv && stipple generate random -d 3 -n 20 "
                  "-o b.csv && stipple generate random -m 13 -n 5 -o many.csv && : > none.csv"));
    expect_refusal(box.run({"report", "none.csv", "-o", "r.html"}), 3, "none.csv");
    expect_refusal(box.run({"report", "missing.csv", "-o", "r.html"}), 4, "missing.csv");
    expect_refusal(box.run({"report", "a.csv", "b.csv", "-o", "r.html"}), 3,
                   "b.csv: points of 3 coordinates are not compared with those of a.csv");
    expect_refusal(box.run({"report", "many.csv", "-o", "r.html"}), 2, "at most 12 sets");
    expect_refusal(box.run({"report", "--generate", "halto", "-o", "r.html"}), 2, "halton");
    expect_refusal(box.run({"report", "--generate", "halton:scrmble=owen", "-o", "r.html"}), 2,
                   "scramble");
    expect_refusal(box.run({"report", "a.csv", "-n", "5", "-o", "r.html"}), 2, "--generate");
    expect_refusal(box.run({"report", "-", "-", "-o", "r.html"}), 2, "twice");
    expect_refusal(box.run({"report", "a.csv", "--check", "value", "-o", "r.html"}), 2,
                   "--check: 'value' is not KEY<VALUE");
    expect_refusal(box.run({"report", "a.csv", "--check", "star-discrepncy>1", "-o", "r.html"}), 2,
                   "did you mean 'star-discrepancy'?");
    expect_refusal(box.run({"report", "a.csv", "--check", "dispersion.method>1", "-o", "r.html"}),
                   2, "--check");
    expect_refusal(box.run({"report", "a.csv", "-o", "no/such/r.html"}), 4, "no/such");
    if (std::filesystem::exists("/proc/self"))
        expect_refusal(box.run({"report", "a.csv", "-o", "/proc/r.html"}), 4,
                       "/proc/r.html: no file can be made in its folder");
    expect_refusal(box.run({"report", "a.csv", "--max-work", "0", "-o", "r.html"}), 2,
                   "--max-work");
    expect_refusal(box.run({"report", "a.csv", "--seed", "3", "-o", "r.html"}), 2, "--seed");
    EXPECT_FALSE(box.exists("r.html"));
}

TEST(Report, ReplacesAFileWhenItIsWhole) {
    const Sandbox box;
    box.write("r.html", "before");
    EXPECT_EQ(box.run({"report", "missing.csv", "-o", "r.html"}).code, 4);
    EXPECT_EQ(box.read("r.html"), "before");
    good(box.shell("stipple generate halton -n 20 | stipple report -o r.html"));
    EXPECT_THAT(box.read("r.html"), HasSubstr("standard input"));
    EXPECT_EQ(box.files(), std::vector<std::string>{"r.html"});
}

TEST(Report, LeavesNoFileWhenItIsInterrupted) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple report --generate random -n 3000 -d 9 --max-work 1e15 -o r.html "
        "--progress always 2> err & until grep -qs between err; do sleep 0.02; done; "
        "kill -INT $!; wait $!");
    EXPECT_EQ(outcome.code, 130) << box.read("err");
    EXPECT_EQ(box.files(), std::vector<std::string>{"err"});
}

TEST(Report, LeavesOutWhatADiskDoesNotHave) {
    const Sandbox box;
    const auto page = data_of(
        box.shell("stipple report --generate halton --generate random -n 300 -w disk --json"));
    const auto& measures = page["sets"][0]["measures"];
    const auto of = [&](const std::string& name) {
        return *std::ranges::find_if(measures, [&](const auto& m) { return m["name"] == name; });
    };
    EXPECT_EQ(page["sets"][0]["domain"], "disk");
    EXPECT_THAT(of("star-discrepancy")["left_out"].get<std::string>(), HasSubstr("disk"));
    EXPECT_TRUE(of("chi-square").contains("results"));
    EXPECT_TRUE(of("nearest-neighbor").contains("results"));
    good(box.shell("stipple report --generate halton -n 300 -w sphere -o s.html"));
    EXPECT_THAT(box.read("s.html"), HasSubstr("Left out"));
}

// A page about sets of 10^5 points is small.
TEST(Report, StaysSmallForLargeSets) {
    const Sandbox box;
    if (sanitized()) GTEST_SKIP() << "takes long with sanitizers";
    good(box.shell(
        "stipple report --generate random --generate jittered -n 99856 --max-work 1e6 -o r.html"));
    EXPECT_LT(box.read("r.html").size(), 1'000'000U);  // so a page of ten sets has less than 5 MB
}

// Means, standard errors and root mean squares equal those of analyze.
TEST(Report, ComparesMeansOfSeveralSets) {
    const Sandbox box;
    const std::string sets = " --generate random -n 64 -m 5 ";
    const auto page = data_of(box.shell("stipple report" + sets + "--json"));
    const auto star = data_of(box.shell("stipple analyze star-discrepancy --average" + sets));
    const auto errors = data_of(box.shell("stipple analyze integration --average" + sets));
    const auto& row = page["comparison"][0];
    EXPECT_EQ(row["key"], "star-discrepancy.value");
    EXPECT_NEAR(row["values"][0], star["results"]["value"], 1e-15);
    EXPECT_NEAR(row["standard_error"][0], star["standard_error"]["value"], 1e-15);
    EXPECT_EQ(page["sets"][0]["sets"], 5);
    int integrands = 0;
    for (const auto& compared : page["comparison"]) {
        const std::string key = compared["key"];
        if (!key.starts_with("integration.")) continue;
        const std::string integrand = key.substr(12, key.find(".error") - 12);
        EXPECT_NEAR(compared["values"][0], errors["results"][integrand]["rms_error"], 1e-15) << key;
        ++integrands;
    }
    EXPECT_EQ(integrands, 3);
    // A condition applies to each of the sets.
    const double worst = page["sets"][0]["measures"][0]["results"]["value"];
    const std::string check = "--check 'star-discrepancy<" + std::to_string(worst + 1e-9) + "' ";
    EXPECT_EQ(box.shell("stipple report --generate random -n 64 -o r.html " + check).code, 0);
    const Outcome failed = box.shell("stipple report" + sets + "-o r.html " + check);
    EXPECT_EQ(failed.code, 1);
    EXPECT_THAT(failed.err, HasSubstr("random, seed "));
    const std::string html = box.read("r.html");
    EXPECT_THAT(html, HasSubstr("the first of 5 sets"));
    EXPECT_THAT(html, HasSubstr("Star discrepancy of the first n points"));
}

TEST(Report, SavesPicturesAsTheyLook) {
    const Sandbox box;
    if (!has_browser(box)) GTEST_SKIP() << "chromium is not installed";
    good(box.shell("stipple report --generate halton -n 32 -o r.html"));
    std::string page = box.read("r.html");
    const std::string end = "</body>";
    page.insert(page.rfind(end),
                "<script>URL.createObjectURL = blob => { blob.text().then(text => "
                "document.documentElement.dataset.saved = text); return '#'; };"
                "HTMLAnchorElement.prototype.click = () => {};"
                "document.querySelector('.save').click();</script>");
    box.write("r.html", page);
    const Outcome outcome = browse(box, "--dump-dom", "r.html");
    EXPECT_THAT(outcome.out, HasSubstr("data-saved=\"&lt;svg xmlns="));
    EXPECT_THAT(outcome.out, HasSubstr("rgb(0, 114, 178)"));
}

TEST(Report, OfATableNeedsItsBox) {
    const Sandbox box;
    box.write("t.csv", "height,mass\n1.5,60000\n1.7,75000\n1.8,90000\n1.6,70000\n");
    const Outcome nothing = box.run({"report", "t.csv", "-o", "t.html"});
    EXPECT_EQ(nothing.code, 0);
    EXPECT_THAT(nothing.err, HasSubstr("t.csv: nothing could be measured"));
    good(box.run({"report", "t.csv", "--rescale", "-o", "t.html"}));
    EXPECT_THAT(box.read("t.html"), HasSubstr("t.csv --rescale"));
}

}  // namespace stipple::testing::report_test
