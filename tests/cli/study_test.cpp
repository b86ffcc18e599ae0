// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "places.hpp"
#include "support/launcher.hpp"
#include "support/program.hpp"
#include "support/system.hpp"

namespace stipple::testing::study_test {

using nlohmann::json;
using ::testing::HasSubstr;

namespace {

constexpr const char* small =
    "stipple study --generators 'random,sobol:scramble=owen,halton' -n 16..2^6 --seeds 4 "
    "--analyze 'star-discrepancy,l2-discrepancy:kind=centered' --no-seconds ";

using Row = std::map<std::string, std::string>;

std::vector<std::string> fields_of(const std::string& line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (const char c : line) {
        if (c == '"')
            quoted = !quoted;
        else if (c == ',' && !quoted)
            fields.emplace_back();
        else
            fields.back() += c;
    }
    return fields;
}

/// Rows of a CSV table, by column.
std::vector<Row> rows_of(const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::getline(in, line);
    const auto names = fields_of(line);
    std::vector<Row> rows;
    while (std::getline(in, line)) {
        const auto fields = fields_of(line);
        EXPECT_EQ(fields.size(), names.size()) << line;
        Row row;
        for (std::size_t k = 0; k < names.size(); ++k) row[names[k]] = fields[k];
        rows.push_back(std::move(row));
    }
    return rows;
}

std::string lines(const std::string& text, std::size_t count) {
    std::size_t end = 0;
    while (count-- > 0) end = text.find('\n', end) + 1;
    return text.substr(0, end);
}

}  // namespace

TEST(Study, RowsAreWhatAnalyzeSaysOfTheSameSets) {
    const Sandbox box;
    const auto rows = rows_of(good(box.shell(small)));
    std::size_t checked = 0;
    for (const Row& row : rows) {
        if (row.at("count") != "32" || row.at("key") != "value") continue;
        if (row.at("measure") != "star-discrepancy") continue;
        const std::string spec = row.at("generator") == "halton"   ? "halton"
                                 : row.at("generator") == "random" ? "random"
                                                                   : "sobol --scramble owen";
        const auto out =
            json::parse(box.shell("stipple generate " + spec + " -n 32 -s " + row.at("seed") +
                                  " | stipple analyze star-discrepancy")
                            .out);
        EXPECT_EQ(std::stod(row.at("value")), out["results"]["value"].get<double>());
        ++checked;
    }
    EXPECT_EQ(checked, 12U);
    EXPECT_EQ(rows.front().at("generator"), "random");
    EXPECT_EQ(rows.back().at("generator"), "halton");
    EXPECT_EQ(rows.back().at("count"), "64");
    EXPECT_EQ(rows.back().at("seed"), "4");
    EXPECT_THAT(rows.front().at("generator_options"), HasSubstr("rng=philox"));
}

// A radius in the provenance is not that of scrambled points, and those of a biased warp have
// densities of their own.
TEST(Study, MeasuresKnowTheWarpsOfTheirPoints) {
    const Sandbox box;
    for (const std::string what : {"poisson-disk -w owen", "integration -w disk:method=naive",
                                   "integration -w owen -w disk:method=naive"}) {
        const auto rows = rows_of(good(box.shell(
            "stipple study --generators poisson-disk -n 40 --quiet --no-seconds --analyze " +
            what)));
        const auto report = json::parse(
            good(box.shell("stipple analyze --generate poisson-disk -n 40 --quiet " + what)));
        EXPECT_GE(rows.size(), 2U) << what;
        for (const Row& row : rows) {
            std::string path = row.at("key");
            std::ranges::replace(path, '.', '/');
            const auto& there = report.at(json::json_pointer("/results/" + path));
            EXPECT_EQ(std::stod(row.at("value")),
                      there.is_boolean() ? there.get<bool>() : there.get<double>())
                << what << ": " << path;
        }
    }
}

TEST(Study, BytesDoNotDependOnThreads) {
    const Sandbox box;
    const std::string one = good(box.shell(small + std::string("--threads 1")));
    for (const char* threads : {"2", "5"})
        EXPECT_EQ(good(box.shell(small + std::string("--threads ") + threads)), one);
    EXPECT_EQ(one.find("seconds"), std::string::npos);
    EXPECT_EQ(good(box.shell(small + std::string("-o study.csv"))), "");
    EXPECT_EQ(box.read("study.csv"), one);
    EXPECT_EQ(box.files(), std::vector<std::string>{"study.csv"});
}

TEST(Study, OnlyTheLastTwoColumnsAreMeasuredByTheClock) {
    const Sandbox box;
    std::string command = small;
    const std::string plain = good(box.shell(command));
    command.erase(command.find("--no-seconds"));
    const auto timed = rows_of(good(box.shell(command)));
    const auto rows = rows_of(plain);
    ASSERT_EQ(timed.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        EXPECT_GE(std::stod(timed[i].at("seconds")), 0);
        EXPECT_GE(std::stod(timed[i].at("generate_seconds")), 0);
        EXPECT_EQ(timed[i].at("value"), rows[i].at("value"));
    }
}

TEST(Study, JsonLinesSayTheSame) {
    const Sandbox box;
    const auto rows = rows_of(good(box.shell(small)));
    ASSERT_EQ(good(box.shell(small + std::string("-o study.jsonl"))), "");
    std::istringstream in(box.read("study.jsonl"));
    std::size_t i = 0;
    for (std::string line; std::getline(in, line); ++i) {
        const auto object = json::parse(line);
        EXPECT_EQ(object["generator"], rows[i].at("generator"));
        EXPECT_EQ(object["value"].get<double>(), std::stod(rows[i].at("value")));
        EXPECT_EQ(object["count"].get<int>(), std::stoi(rows[i].at("count")));
    }
    EXPECT_EQ(i, rows.size());
}

TEST(Study, FailuresAreRowsAndTheExitCodeSaysSo) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple study --generators 'grid,random' -n 16,32 --seeds 2 --analyze "
        "'star-discrepancy,pair-correlation' -d 2,4");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err,
                HasSubstr("measurements failed, for the reasons in their rows; the first: "));
    std::map<std::string, int> failed;
    for (const Row& row : rows_of(outcome.out)) {
        if (row.at("status") != "failed") continue;
        EXPECT_EQ(row.at("value"), "");
        EXPECT_NE(row.at("reason"), "");
        ++failed[row.at("generator") + row.at("count") + "d" + row.at("dimension")];
    }
    // grid needs squares or fourth powers; pair-correlation at most three dimensions.
    EXPECT_EQ(failed, (std::map<std::string, int>{{"grid32d2", 4},
                                                  {"grid16d4", 2},
                                                  {"grid32d4", 4},
                                                  {"random16d4", 2},
                                                  {"random32d4", 2}}));
}

TEST(Study, TimeLimitsAreRowsAndExitFive) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple study --generators random -n 16,1000 -d 8 --analyze "
        "'star-discrepancy:method=exact;moments' --keys value,mean --time-limit 1");
    EXPECT_EQ(outcome.code, 5) << outcome.err;
    const auto rows = rows_of(outcome.out);
    ASSERT_GT(rows.size(), 10U);
    EXPECT_EQ(rows[0].at("status"), "ok");
    const auto late =
        std::ranges::find_if(rows, [](const Row& r) { return r.at("status") != "ok"; });
    ASSERT_NE(late, rows.end());
    EXPECT_EQ(late->at("reason"), "time limit: not done after 1 s");
    EXPECT_EQ(rows.back().at("status"), "ok");
}

// The neighbours of 2^14 points take 1.06 MiB, more than each thread's quarter of 2M.
TEST(Study, AShareOfTheMemoryThatIsTooSmallChangesNothing) {
    const Sandbox box;
    const std::string command =
        "stipple study --generators random -n 2^4,2^14 --seeds 3 --analyze "
        "'nearest-neighbor,integration' --no-seconds --max-memory ";
    for (const char* memory : {"2M", "200k"}) {
        const Outcome one = box.shell(command + memory + " --threads 1");
        const Outcome four = box.shell(command + memory + " --threads 4");
        EXPECT_EQ(one.code, std::string(memory) == "2M" ? 0 : 5) << one.err;
        EXPECT_EQ(four.code, one.code);
        EXPECT_EQ(four.out, one.out) << memory;
    }
}

TEST(Study, ScramblesOfASetDifferFromSeedToSeed) {
    const Sandbox box;
    const auto rows = rows_of(good(box.shell(
        "stipple study --generators halton -n 64 --seeds 2 -w owen --analyze star-discrepancy "
        "--keys value --no-seconds")));
    ASSERT_EQ(rows.size(), 2U);
    EXPECT_NE(rows[0].at("value"), rows[1].at("value"));
    for (const Row& row : rows) {
        const auto out =
            json::parse(box.shell("stipple generate halton -n 64 -w owen -s " + row.at("seed") +
                                  " | stipple analyze star-discrepancy")
                            .out);
        EXPECT_EQ(std::stod(row.at("value")), out["results"]["value"].get<double>());
        EXPECT_EQ(row.at("domain"), "unit-cube");
    }
}

TEST(Study, AMeasureThatCannotTakeTheWarpLooksBeforeIt) {
    const Sandbox box;
    const std::string measures =
        "'star-discrepancy,nearest-neighbor,integration:integrand=genz-gaussian' --no-seconds";
    const Outcome outcome =
        box.shell("stipple study --generators halton -n 64 -w disk --analyze " + measures);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(
        outcome.err,
        "stipple: note: star-discrepancy does not take points of disk: it measures them before "
        "the warp, on the unit cube\n"
        "stipple: note: integration:integrand=genz-gaussian does not take points of disk: it "
        "measures them before the warp, on the unit cube\n");
    const auto plain =
        rows_of(box.shell("stipple study --generators halton -n 64 --analyze " + measures).out);
    std::map<std::string, std::string> unwarped;
    for (const Row& row : plain) unwarped[row.at("measure") + row.at("key")] = row.at("value");
    for (const Row& row : rows_of(outcome.out)) {
        const bool cube = row.at("measure") != "nearest-neighbor";
        EXPECT_EQ(row.at("domain"), cube ? "unit-cube" : "disk");
        const std::string& before = unwarped.at(row.at("measure") + row.at("key"));
        if (cube) {
            EXPECT_EQ(row.at("value"), before);
        } else if (row.at("key") == "mean") {
            EXPECT_NE(row.at("value"), before);
        }
    }
}

TEST(Study, KeepsKeysOfOneAnalyzer) {
    const Sandbox box;
    const std::string study =
        "stipple study halton -n 16 --no-seconds --analyze "
        "star-discrepancy,l2-discrepancy --keys ";
    std::vector<std::string> kept;
    for (const Row& row : rows_of(good(
             box.shell(study + "star-discrepancy.value,l2-discrepancy.centered.value,squared"))))
        if (!row.at("key").ends_with("squared"))
            kept.push_back(row.at("measure") + " " + row.at("key"));
    EXPECT_EQ(kept, (std::vector<std::string>{"star-discrepancy value",
                                              "l2-discrepancy centered.value"}));
    expect_refusal(box.shell(study + "star-discrepancy.value"), 2,
                   "add one, or leave out l2-discrepancy");
}

// Warps of one generator, beside those of all; the values are those of analyze for such sets.
TEST(Study, GeneratorsMayHaveTheirOwnWarpsAndOptions) {
    const Sandbox box;
    const std::string study =
        "stipple study 'rank1-lattice -w cranley-patterson' 'sobol --scramble owen' "
        "'halton -w owen@2,1' -n 64 --seeds 3 -w tent --analyze moments "
        "--keys mean --no-seconds ";
    const auto rows = rows_of(good(box.shell(study)));
    const std::map<std::string, std::string> made = {
        {"rank1-lattice -w cranley-patterson", "rank1-lattice -w cranley-patterson -w tent"},
        {"sobol:scramble=owen", "sobol:scramble=owen -w tent"},
        {"halton -w owen@2,1", "halton -w owen@2,1 -w tent"}};
    std::set<std::string> seen;
    for (const Row& row : rows) {
        const std::string words = made.at(row.at("generator"));
        EXPECT_EQ(row.at("warps"), "tent");
        const auto report =
            json::parse(good(box.shell("stipple generate " + words + " --meta -q -n 64 -s " +
                                       row.at("seed") + " | stipple analyze moments")));
        const std::string& key = row.at("key");
        const auto open = key.find('[');
        if (open == std::string::npos || key.find('.') != std::string::npos) continue;
        EXPECT_EQ(
            std::stod(row.at("value")),
            report["results"][key.substr(0, open)][std::stoul(key.substr(open + 1))].get<double>())
            << words << key;
        seen.insert(row.at("generator") + row.at("seed"));
    }
    EXPECT_GE(seen.size(), 6U);
    EXPECT_EQ(good(box.shell("stipple study --generators 'rank1-lattice -w cranley-patterson,sobol "
                             "--scramble owen;halton -w owen@2,1' -n 64 "
                             "--seeds 3 -w tent --analyze moments --keys mean --no-seconds")),
              good(box.shell(study)));
}

// The warped generators are told apart in summaries and comparisons, which pair them by seed.
TEST(Study, OwnWarpsAreComparedAndResumed) {
    const Sandbox box;
    const auto study = [](const std::string& generators, int seeds) {
        return fmt::format(
            "stipple study {} -n 64 --seeds {} --analyze 'star-discrepancy,nearest-neighbor' "
            "--keys value,mean --no-seconds --summary --pairs paired -o s.csv ",
            generators, seeds);
    };
    const std::string both = "'rank1-lattice -w cranley-patterson' 'rank1-lattice -w disk@2,1'";
    good(box.shell(study(both + " halton -q", 8)));
    const std::string whole = box.read("s.csv");
    const auto pairs = rows_of(box.read("s.comparisons.csv"));
    ASSERT_GE(pairs.size(), 6U);
    EXPECT_EQ(pairs[0].at("generator_a"), "rank1-lattice -w cranley-patterson");
    EXPECT_EQ(pairs[0].at("generator_b"), "rank1-lattice -w disk@2,1");
    EXPECT_EQ(pairs[0].at("method"), "paired");
    EXPECT_EQ(pairs[0].at("sets_a"), "8");
    good(box.shell(study(both + " -q", 4) + "--overwrite"));
    good(box.shell(study(both + " halton -q", 8) + "--resume"));
    EXPECT_EQ(box.read("s.csv"), whole);
    expect_refusal(box.shell(study("rank1-lattice halton", 8) + "--resume"), 3, "--resume: ");
    // One measure looks before the warp of one generator only.
    const Outcome again = box.shell(study(both, 8) + "--overwrite");
    EXPECT_EQ(again.err,
              "stipple: note: star-discrepancy does not take points of disk@2,1: it measures them "
              "before the warp, on the unit cube\n");
    for (const Row& row : rows_of(box.read("s.csv")))
        EXPECT_EQ(row.at("domain"), row.at("generator").ends_with("disk@2,1") &&
                                            row.at("measure") == "nearest-neighbor"
                                        ? "disk@2,1"
                                        : "unit-cube");
}

TEST(Study, MetaNamesVersionAndCommandAndIsResumed) {
    const Sandbox box;
    for (const std::string name : {"s.csv", "s.jsonl"}) {
        const std::string study = small + ("--meta --summary -o " + name + " ");
        good(box.shell(study + "--threads 2"));
        const std::string whole = box.read(name);
        const std::string plain =
            good(box.shell(small + std::string(name == "s.csv" ? "-f csv" : "-f jsonl")));
        EXPECT_TRUE(whole.ends_with("\n" + plain));
        const std::string above = whole.substr(0, whole.size() - plain.size());
        EXPECT_THAT(above,
                    HasSubstr(good(box.shell("stipple --version | sed 's/[^0-9]*\\([0-9.]*\\).*/"
                                             "\\1/;q'"))
                                  .substr(0, 5)));
        EXPECT_THAT(
            above,
            HasSubstr("stipple study --generators random,sobol:scramble=owen,halton --analyze "));
        EXPECT_EQ(above.find("threads"), std::string::npos);
        for (const std::size_t cut :
             {std::size_t{3}, above.size() - 1, above.size() + 5, above.size() + 900}) {
            box.write(name, whole.substr(0, cut));
            box.write(name + ".journal", "{\"torn");
            EXPECT_EQ(good(box.shell(study + "--resume")), "") << cut;
            EXPECT_EQ(box.read(name), whole) << cut;
        }
        EXPECT_EQ(good(box.shell(small + ("--resume -o " + name))), "");
        EXPECT_EQ(box.read(name), whole);
        box.write(name, above + plain.substr(0, 900) + "nonsense\n" + plain.substr(900));
        expect_refusal(box.shell(study + "--resume"), 3,
                       fmt::format("{}:{}: this is not a row of a study", name,
                                   1 + std::ranges::count(above + plain.substr(0, 900), '\n')));
        good(box.shell(study + "--overwrite"));
        EXPECT_EQ(box.read(name), whole);
        good(box.shell("stipple plot " + name + " -o a.svg"));
        expect_refusal(box.run({"reproduce", name}), 3, "a table of a study, without points");
    }
    good(box.shell("stipple plot s.summary.csv -o b.svg"));
}

// Means, half-widths and root mean squares are those of --summary.
TEST(Study, WideTablesHaveARowForEachCountAndAColumnForEachGenerator) {
    const Sandbox box;
    const std::string study = small + std::string("--keys value ");
    good(box.shell(study + "--summary -o s.csv"));
    const std::string csv = good(box.shell(study + "--wide"));
    const auto wide = rows_of(csv);
    ASSERT_EQ(wide.size(), 6U);
    std::size_t cells = 0;
    for (const Row& mean : rows_of(box.read("s.summary.csv")))
        for (const Row& row : wide) {
            if (row.at("count") != mean.at("count") || row.at("measure") != mean.at("measure"))
                continue;
            const std::string& generator = mean.at("generator");
            EXPECT_EQ(row.at(generator), mean.at("mean"));
            if (generator != "halton") {
                EXPECT_NEAR(std::stod(row.at(generator + " half_width")),
                            (std::stod(mean.at("t_high")) - std::stod(mean.at("t_low"))) / 2,
                            1e-15);
            }
            ++cells;
        }
    EXPECT_EQ(cells, 18U);
    for (const std::string table : {"s.csv", "s.summary.csv"})
        EXPECT_EQ(good(box.shell("stipple study --wide " + table)), csv) << table;
    EXPECT_EQ(good(box.shell("stipple study --wide s.csv -f jsonl | head -1 | grep -c half_width")),
              "1\n");
    expect_refusal(box.shell("stipple study --wide s.csv -n 8"), 2, "--count: does not apply");
    for (const std::string table : {"s.csv", "s.summary.csv"}) {
        const std::string run = "stipple study --wide " + table + " --keys ";
        EXPECT_EQ(good(box.shell(run + "value")), csv);
        EXPECT_EQ(good(box.shell(run + "star-discrepancy.value | wc -l")), "4\n");
        expect_refusal(box.shell(run + "value,squares"), 2,
                       "--keys: " + table + " has no result 'squares'");
    }
    expect_refusal(box.shell("stipple study --wide s.summary.csv --confidence 0.9"), 2,
                   "--confidence: does not apply to the summary of a study");
    EXPECT_EQ(good(box.shell("stipple study --wide s.csv --confidence 0.9")),
              good(box.shell(study + "--wide --confidence 0.9")));
    box.write("p.csv", "x,y\n0,0\n");
    expect_refusal(box.shell("stipple study --wide p.csv"), 3,
                   "p.csv: is not the table of a study");
}

TEST(Study, SummarizesATableWithoutMeasuringAgain) {
    const Sandbox box;
    const std::string how = "--summary --pairs paired --confidence 0.9 --bootstrap 500 ";
    good(box.shell(small + ("-s 7 " + how + "-o s.csv")));
    const std::string means = box.read("s.summary.csv"), pairs = box.read("s.comparisons.csv");
    EXPECT_EQ(good(box.shell("stipple study s.csv " + how)), means + "\n" + pairs);
    good(box.shell("rm s.summary.csv s.comparisons.csv; stipple study s.csv -o t.csv " + how));
    EXPECT_EQ(box.read("t.summary.csv"), means);
    EXPECT_EQ(box.read("t.comparisons.csv"), pairs);
    EXPECT_EQ(box.files().size(), 3U);
    expect_refusal(box.shell("stipple study --summary t.summary.csv"), 2,
                   "--summary: does not apply to the summary of a study");
}

TEST(Study, WideTablesHaveTheLabelsOfGenerators) {
    const Sandbox box;
    const std::string study =
        "stipple study random halton -n 16,64 --analyze l2-discrepancy --keys centered.value ";
    good(box.shell(study + "-o s.csv"));
    for (const std::string from : {study.c_str(), "stipple study s.csv "}) {
        EXPECT_THAT(good(box.shell(from + "-f latex --labels 'Monte Carlo,Halton_2'")),
                    HasSubstr("$n$ & Monte Carlo & Halton\\_2 \\\\\n"));
        EXPECT_THAT(good(box.shell(from + "--wide --labels 'A,\"B, C\"'")),
                    HasSubstr(",A,A half_width,\"B, C\",\"B, C half_width\"\n"));
        expect_refusal(box.shell(from + "--wide --labels A"), 2,
                       "--labels: 1 names; expected one for each of the 2 generators");
    }
}

TEST(Study, LatexIsAWideTableWithoutConstantColumns) {
    const Sandbox box;
    const std::string study =
        "stipple study 'random -w owen' 'sobol:scramble=owen' -n 16,64 --seeds 4 --analyze "
        "integration:integrand=genz-gaussian --keys error ";
    good(box.shell(study + "--wide -o t.tex"));
    const std::string text = box.read("t.tex");
    EXPECT_THAT(text, ::testing::StartsWith("% needs \\usepackage{booktabs}\n% stipple "));
    EXPECT_THAT(text, HasSubstr("\n% key: genz-gaussian.error\n"));
    EXPECT_THAT(text, HasSubstr("\\begin{tabular}{rrr}\n\\toprule\n$n$ & random -w owen & "
                                "sobol:scramble=owen \\\\\n\\midrule\n16 & $"));
    EXPECT_THAT(text, HasSubstr("\n64 & $"));
    EXPECT_THAT(text, ::testing::EndsWith("\\bottomrule\n\\end{tabular}\n"));
    good(box.shell(study + "-o s.csv"));
    const auto body = [](const std::string& all) { return all.substr(all.find("\\begin")); };
    EXPECT_EQ(body(good(box.shell("stipple study s.csv -f latex"))), body(text));
    // Runs of pdflatex are possible where it is installed.
    if (box.shell("command -v pdflatex && kpsewhich booktabs.sty").code != 0) return;
    good(
        box.shell("stipple analyze moments,l2-discrepancy --generate 'sobol --scramble owen' "
                  "--generate random -m 4 --average -f latex > u.tex"));
    box.write("d.tex",
              "\\documentclass{article}\\usepackage{booktabs}\\begin{document}\\input{t}\n\n"
              "\\input{u}\\end{document}\n");
    const Outcome made = box.shell("pdflatex -interaction=batchmode -halt-on-error d.tex");
    EXPECT_EQ(made.code, 0) << made.out;
}

// The root mean square of errors, normal numbers of mean 0, has an interval by chi-square; with 4
// degrees of freedom its 95 % limits are 0.4844185571 and 11.1432867819.
TEST(Study, SummaryHasIntervalsOfErrors) {
    const Sandbox box;
    good(
        box.shell("stipple study --generators random --count 16 --sets 4 --analyze integration "
                  "--keys error -o study.csv --summary"));
    const auto means = rows_of(box.read("study.summary.csv"));
    ASSERT_FALSE(means.empty());
    for (const Row& row : means) {
        const double rms = std::stod(row.at("rms"));
        if (rms == 0) continue;  // constant values have no interval
        EXPECT_NEAR(std::stod(row.at("rms_high")), rms * std::sqrt(4 / 0.4844185571), 1e-9 * rms);
        EXPECT_NEAR(std::stod(row.at("rms_low")), rms * std::sqrt(4 / 11.1432867819), 1e-9 * rms);
    }
    good(
        box.shell("stipple study --generators 'random;sobol:scramble=owen' --count 1024 --sets 8 "
                  "--analyze integration:integrand=genz-gaussian --keys error -o study.csv "
                  "--summary --overwrite"));
    const Row pair = rows_of(box.read("study.comparisons.csv")).front();
    EXPECT_EQ(pair.at("compared"), "absolute value");
    EXPECT_GT(std::stod(pair.at("difference")), 0);
    EXPECT_LT(std::stod(pair.at("p_value")), 0.05);  // though both means are near 0
    expect_refusal(box.run({"plot", "study.comparisons.csv", "-o", "c.svg"}), 3,
                   "comparisons of a study are not drawn");
}

TEST(Study, SummaryHasMeansIntervalsAndComparisons) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("--keys value -o study.csv --summary"))), "");
    const auto means = rows_of(box.read("study.summary.csv"));
    std::vector<double> values;
    for (const Row& row : rows_of(box.read("study.csv")))
        if (row.at("generator") == "random" && row.at("count") == "16" &&
            row.at("measure") == "star-discrepancy")
            values.push_back(std::stod(row.at("value")));
    ASSERT_EQ(values.size(), 4U);
    const double mean = (values[0] + values[1] + values[2] + values[3]) / 4;
    double squares = 0;
    for (const double x : values) squares += (x - mean) * (x - mean);
    const double error = std::sqrt(squares / 12);
    const Row& first = means.front();
    EXPECT_EQ(first.at("sets"), "4");
    EXPECT_NEAR(std::stod(first.at("mean")), mean, 1e-14);
    EXPECT_NEAR(std::stod(first.at("standard_error")), error, 1e-14);
    EXPECT_NEAR(std::stod(first.at("t_high")), mean + 3.182446305284263 * error, 1e-13);
    EXPECT_LT(std::stod(first.at("bootstrap_low")), mean);
    double mean_square = 0;
    for (const double x : values) mean_square += x * x / 4;
    const double rms = std::sqrt(mean_square);
    EXPECT_NEAR(std::stod(first.at("rms")), rms, 1e-14);
    EXPECT_EQ(first.at("rms_low"), "");  // a discrepancy never has mean 0
    const auto pairs = rows_of(box.read("study.comparisons.csv"));
    EXPECT_EQ(pairs.size(), 3U * 3 * 2);  // pairs of generators, for each count and measure
    for (const Row& row : pairs) {
        EXPECT_GE(std::stod(row.at("p_holm")), std::stod(row.at("p_value")));
        EXPECT_EQ(row.at("method"), "welch");
    }
}

// Files beside a table belong to that table, or are removed.
TEST(Study, NothingOfTheStudyBeforeIsLeftBehind) {
    const Sandbox box;
    const std::string one =
        "stipple study --generators random -n 16 --seeds 3 --analyze moments --keys mean -o s.csv ";
    ASSERT_EQ(good(box.shell(small + std::string("-o s.csv --summary"))), "");
    ASSERT_EQ(good(box.shell(one + "--overwrite --summary")), "");
    const std::string pairs = box.read("s.comparisons.csv");
    EXPECT_TRUE(pairs.starts_with("table,dimension,warps,count,measure,key,generator_a,"));
    EXPECT_EQ(std::ranges::count(pairs, '\n'), 1) << "names alone: there are no pairs";
    ASSERT_EQ(good(box.shell(one + "--overwrite")), "");
    EXPECT_EQ(box.files(), std::vector<std::string>{"s.csv"});
    box.write("s.summary.csv", "somebody's own\n");
    ASSERT_EQ(good(box.shell(one + "--overwrite")), "");
    EXPECT_EQ(box.read("s.summary.csv"), "somebody's own\n");
}

TEST(Study, ResumeAfterACutGivesTheSameBytes) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("-o whole.csv"))), "");
    const std::string whole = box.read("whole.csv");
    for (const std::size_t cut :
         {std::size_t{0}, std::size_t{5}, whole.find('\n') + 1, whole.find('\n') + 30,
          lines(whole, 4).size(), lines(whole, 5).size() + 11, lines(whole, 20).size(),
          whole.size() - 3}) {
        box.write("cut.csv", whole.substr(0, cut));
        box.write("cut.csv.journal", "{\"torn");
        EXPECT_EQ(good(box.shell(small + std::string("-o cut.csv --resume"))), "") << cut;
        EXPECT_EQ(box.read("cut.csv"), whole) << cut;
        EXPECT_FALSE(box.exists("cut.csv.journal"));
    }
}

// Rows of an unfinished table are in any order. After a power failure anything may be behind them;
// damage between them is refused.
TEST(Study, ResumeTakesRowsInAnyOrderAndCutsOffADamagedEnd) {
    const Sandbox box;
    const std::string study =
        "stipple study --generators halton -n 1..4+1 --analyze star-discrepancy --keys value "
        "--no-seconds ";
    ASSERT_EQ(good(box.shell(study + "-o whole.csv")), "");
    const std::string whole = box.read("whole.csv");
    const std::string names = lines(whole, 1);
    const auto row = [&](std::size_t i) {
        return lines(whole, i + 1).substr(lines(whole, i).size());
    };
    const std::string print = row(1).substr(row(1).rfind(',') + 1, 16);
    const std::string head = "{\"format\":\"stipple.study-journal\",\"version\":3,\"study\":\"";
    const auto resumed = [&](const std::string& rows, const std::string& settings = "{}") {
        box.write("cut.csv", names + rows);
        box.write("cut.csv.journal", head + print + "\",\"settings\":" + settings + "}\n");
        return box.shell(study + "-o cut.csv --resume");
    };
    for (const std::string& end :
         {std::string(), row(2).substr(0, 30), std::string("x,\n7 3\n"), std::string(99, '\0'),
          std::string(99, '\0') + "\n", row(2) + "x\n", row(2) + row(1).substr(0, 9)}) {
        EXPECT_EQ(good(resumed(row(4) + row(3) + end)), "") << end;
        EXPECT_EQ(box.read("cut.csv"), whole) << end;
        EXPECT_FALSE(box.exists("cut.csv.journal"));
    }
    // What is there is taken, not measured once more.
    std::string third = row(3);
    third.insert(third.find(",ok,"), "5");
    EXPECT_EQ(good(resumed(row(4) + third)), "");
    EXPECT_EQ(box.read("cut.csv"), lines(whole, 3) + third + row(4));
    expect_refusal(resumed(row(4) + "x\n" + row(3)), 3, "cut.csv:3: this is not a row of a study");
    EXPECT_EQ(box.read("cut.csv"), names + row(4) + "x\n" + row(3));
    for (const std::string& twice : {row(4) + row(3) + row(4), row(1) + row(2) + row(1)})
        expect_refusal(resumed(twice), 3, "cut.csv:4: this row is not in its place");
    box.write("cut.csv.journal", head + "0\",\"settings\":{\"counts\":1,\"generators\":[]}}\n");
    expect_refusal(box.shell(study + "-o cut.csv --resume"), 3, "the file holds another study");
}

// A finished study has no journal; a copy of its table may be incomplete.
TEST(Study, ResumeCompletesAFinishedTableThatWasCut) {
    const Sandbox box;
    const std::string study =
        "stipple study --generators 'random,halton' -n 16,32 --analyze moments --no-seconds ";
    ASSERT_EQ(good(box.shell(study + "-o whole.csv")), "");
    const std::string whole = box.read("whole.csv");
    const std::size_t last_line = whole.rfind('\n', whole.size() - 2) + 1;
    for (const std::size_t cut :
         {std::size_t{5}, whole.find('\n'), last_line, last_line + 20, whole.size() - 1,
          whole.rfind('\n', last_line - 2) + 1, lines(whole, 6).size() + 3, whole.size()}) {
        box.write("cut.csv", whole.substr(0, cut));
        EXPECT_EQ(good(box.shell(study + "-o cut.csv --resume")), "") << cut;
        EXPECT_EQ(box.read("cut.csv"), whole) << cut;
        EXPECT_FALSE(box.exists("cut.csv.journal"));
    }
}

TEST(Study, ResumeMeasuresAgainWhatLackedAFileOrMemory) {
    const Sandbox box;
    const std::string study =
        "stipple study --generators 'random,sobol -w empirical:file=v.txt' -d 1 -n 16,32 --seeds 2 "
        "--analyze moments --keys mean --no-seconds -o ";
    const Outcome without = box.shell(study + "s.csv");
    EXPECT_EQ(without.code, 3);
    EXPECT_THAT(box.read("s.csv"), HasSubstr("failed,file: v.txt: no such file"));
    box.write("v.txt", "1\n2\n5\n");
    EXPECT_EQ(good(box.shell(study + "s.csv --resume")), "");
    EXPECT_EQ(good(box.shell(study + "whole.csv")), "");
    EXPECT_EQ(box.read("s.csv"), box.read("whole.csv"));

    const std::string large =
        "stipple study --generators 'halton,lloyd:iterations=0' -n 100,50000 --analyze moments "
        "--keys mean --no-seconds --threads 1 -o ";
    const Outcome tight = box.shell(large + "l.csv --max-memory 3M");
    EXPECT_EQ(tight.code, 5) << tight.out << tight.err;
    EXPECT_THAT(box.read("l.csv"), HasSubstr("failed,limit: "));
    EXPECT_EQ(good(box.shell(large + "l.csv --resume")), "");
    EXPECT_EQ(good(box.shell(large + "all.csv")), "");
    EXPECT_EQ(box.read("l.csv"), box.read("all.csv"));
}

TEST(Study, WideTablesOfUnfinishedStudiesHaveANote) {
    const Sandbox box;
    good(box.shell("stipple study --generators random -n 16,32 --analyze moments -o s.csv"));
    for (const bool unfinished : {false, true}) {
        if (unfinished) box.write("s.csv.journal", "");
        for (const char* options : {"--wide", "--wide -f latex"}) {
            const Outcome outcome = box.shell(std::string("stipple study s.csv ") + options);
            EXPECT_EQ(outcome.code, 0);
            EXPECT_EQ(outcome.err,
                      unfinished ? "stipple: note: s.csv: the study is not finished\n" : "");
        }
    }
}

// A measure that rejects sets of few points may accept more.
TEST(Study, OptionsThatFitSomeSetsAreNoReasonToRefuseTheStudy) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple study --generators random -n 16,4096 --no-seconds --analyze "
        "hyperuniformity:max-radius=12,min-radius=1 --keys exponent");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.out, HasSubstr("--max-radius: 12 is more than a quarter"));
    EXPECT_THAT(outcome.out, HasSubstr(",exponent,"));
}

TEST(Study, JsonLinesAreResumedToo) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("-o whole.jsonl"))), "");
    const std::string whole = box.read("whole.jsonl");
    for (const std::size_t cut : {std::size_t{20}, lines(whole, 3).size() + 40, whole.size() - 1}) {
        box.write("cut.jsonl", whole.substr(0, cut));
        box.write("cut.jsonl.journal", "");
        EXPECT_EQ(good(box.shell(small + std::string("-o cut.jsonl --resume"))), "") << cut;
        EXPECT_EQ(box.read("cut.jsonl"), whole) << cut;
    }
}

TEST(Study, ResumeAfterAKillGivesTheSameBytes) {
    const Sandbox box;
    const std::string command =
        "stipple study --generators 'random;halton;jittered;sobol:scramble=owen' -n 4^2..4^5 "
        "--seeds 25 --analyze 'star-discrepancy,l2-discrepancy' --no-seconds ";
    ASSERT_EQ(good(box.shell(command + "-o whole.csv")), "");
    const auto until = [](int rows) {
        return fmt::format(
            "until [ $(cat cut.csv* | wc -l) -gt {} ]; do kill -0 $pid || break; done; ", rows);
    };
    (void)box.shell(command + "-o cut.csv & pid=$!; " + until(200) + "kill -9 $pid; wait $pid");
    (void)box.shell(command + "-o cut.csv --resume --threads 1 & pid=$!; " + until(400) +
                    "kill -INT $pid; wait");
    EXPECT_EQ(good(box.shell(command + "-o cut.csv --resume --threads 3")), "");
    EXPECT_TRUE(box.read("cut.csv") == box.read("whole.csv"));
    EXPECT_EQ(box.files(), (std::vector<std::string>{"cut.csv", "whole.csv"}));
}

// A study that is stopped again and again keeps every complete unit. The first of a measure is not
// enough to tell: only a second one shows which rows a complete unit has.
TEST(Study, ResumeKeepsWhatIsMeasured) {
    SKIP_WITHOUT("/proc/self/fd");
    const Sandbox box;
    const std::string study =
        "stipple study --generators 'random;poisson-disk' -n 2000..5000+300 --seeds 4 --analyze "
        "star-discrepancy --quiet -o study.csv --resume & pid=$!; ";
    const std::string rows = "cat study.csv* | grep -c -e '^random' -e '^poisson'";
    constexpr int rows_of_unit = 7;
    const std::string enough = std::to_string(2 * rows_of_unit);
    (void)box.shell(study + "until [ $(" + rows + ") -gt " + enough +
                    " ]; do kill -0 $pid || break; done; kill -9 $pid; wait $pid");
    ASSERT_TRUE(box.exists("study.csv.journal"));
    const int before = std::stoi(good(box.shell(rows)));
    EXPECT_GT(before, 2 * rows_of_unit);
    (void)box.shell(study + caught("$pid") + "kill -9 $pid; wait $pid");
    EXPECT_GE(std::stoi(good(box.shell(rows))), before - before % rows_of_unit);
}

TEST(Study, SaysWhichGeneratorsNeverDiffer) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple study --generators 'sobol;niederreiter:base=2;random;sobol:scramble=owen;pmj02' "
        "-n "
        "16,64 --seeds 4 --analyze moments --keys cube.mean --no-seconds --summary -o s.csv");
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.err, HasSubstr("sobol and niederreiter have the same values "
                                       "everywhere: their sets may be the same points"));
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1);
}

// On standard output, each table has its preface, as in files.
TEST(Study, MetaStandsAboveEachTableOfAStream) {
    const Sandbox box;
    const std::string study = small + std::string("--meta --summary ");
    good(box.shell(study + "-o s.csv"));
    const std::string meta = lines(box.read("s.csv"), 3);
    EXPECT_TRUE(meta.starts_with("# tool: "));
    const std::string all = good(box.shell(study));
    EXPECT_EQ(all, box.read("s.csv") + "\n" + box.read("s.summary.csv") + "\n" +
                       box.read("s.comparisons.csv"));
}

// All rows are complete and kept; so is the journal, since the summary is missing.
TEST(Study, StopsWhileItSumsUp) {
    const Sandbox box;
    const std::string study =
        "stipple study --generators 'random;halton' -n 64 --seeds 99 --analyze moments "
        "--no-seconds "
        "-o study.csv ";
    const Outcome outcome =
        box.shell("timeout --preserve-status -s INT -k 9 1 " + study + "--summary --bootstrap 1e7");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(box.files(), (std::vector<std::string>{"study.csv", "study.csv.journal"}));
    EXPECT_EQ(good(box.shell(study + "--summary --resume")), "");
    EXPECT_EQ(box.files().size(), 3U);
}

TEST(Study, InterruptKeepsWhatIsDoneAndExits130) {
    const Sandbox box;
    // The large sets would take hours; the small ones come first.
    const Outcome outcome = box.shell(
        "stipple study --generators 'random;halton' -n 16,10000 -d 6 --analyze star-discrepancy "
        "-o study.csv & pid=$!; until [ $(cat study.csv 2> /dev/null | grep -c ,value,) -ge 3 ]; "
        "do sleep 0.05; done; kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(outcome.err,
              "stipple: interrupted; study.csv and study.csv.journal hold 2 of 4 measurements; "
              "--resume continues\n");
    EXPECT_TRUE(box.exists("study.csv"));
    EXPECT_TRUE(box.exists("study.csv.journal"));
}

// The message does not claim rows that are not there.
TEST(Study, InterruptSaysWhenNothingIsDone) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple study random -n 10000 -d 6 --analyze star-discrepancy -o study.csv & pid=$!; "
        "until [ -e study.csv.journal ]; do sleep 0.05; done; kill -INT $pid; wait $pid");
    EXPECT_EQ(outcome.code, 130);
    EXPECT_THAT(outcome.err, HasSubstr("hold 0 of 1 measurements; --resume continues"));
}

TEST(Study, ResumeRefusesAnotherStudyAndWhatIsNone) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("-o study.csv"))), "");
    const std::string whole = box.read("study.csv");
    Outcome outcome = box.shell(small + std::string("--keys value -o study.csv --resume"));
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("study.csv: --resume: the file holds another study"));
    EXPECT_EQ(box.read("study.csv"), whole);
    EXPECT_EQ(good(box.shell(small + std::string("-o study.csv --resume"))), "");
    EXPECT_EQ(box.read("study.csv"), whole);
    box.write("points.csv", "x,y\n0.5,0.5\n");
    for (const char* resume : {"", "--resume"}) {
        outcome = box.shell(small + std::string("-o points.csv ") + resume);
        EXPECT_EQ(outcome.code, 3);
        EXPECT_THAT(outcome.err, HasSubstr("points.csv: exists and is not the table of a study"));
        EXPECT_EQ(box.read("points.csv"), "x,y\n0.5,0.5\n");
    }
    outcome = box.shell(small + std::string("--resume"));
    EXPECT_EQ(outcome.code, 2);
}

// Additions of any kind, before, between and after existing rows: the file equals that of a study
// with everything from the start, and existing rows are not measured again.
TEST(Study, ResumeAddsSeedsCountsGeneratorsAndMeasures) {
    const Sandbox box;
    const auto command = [](const std::string& generators, const std::string& counts,
                            const std::string& seeds, const std::string& measures) {
        return fmt::format(
            "stipple study --generators '{}' -n {} -d 2,3 {} --analyze '{}' --no-seconds ",
            generators, counts, seeds, measures);
    };
    const std::string before =
        command("random,halton", "8,32", "-s 3 --seeds 2", "moments,coverage");
    for (const std::string& more :
         {command("random,halton", "8,32", "-s 3 --seeds 5", "moments,coverage"),
          command("random,halton", "8,32", "-s 1 --seeds 4", "moments,coverage"),
          command("random,halton", "4,8,16,32,64", "-s 3 --seeds 2", "moments,coverage"),
          command("grid,halton,sobol,random", "8,32", "-s 3 --seeds 2", "moments,coverage"),
          command("random,halton", "8,32", "-s 3 --seeds 2", "voronoi,coverage,moments"),
          command("halton,sobol,random", "64,32,8", "-s 2 --seeds 9", "coverage,moments")}) {
        for (const char* name : {"s.csv", "s.jsonl"}) {
            const std::string to = fmt::format("-o {} ", name);
            (void)box.shell(more + to + "--overwrite");  // voronoi fails in three dimensions
            const std::string whole = box.read(name);
            good(box.shell(before + to + "--overwrite"));
            (void)box.shell(more + to + "--resume");
            EXPECT_TRUE(box.read(name) == whole) << more << to;
            EXPECT_FALSE(box.exists(name + std::string(".journal")));
        }
    }
    // Existing rows are kept, not measured again.
    good(box.shell(before + "-o s.csv --overwrite"));
    std::string text = box.read("s.csv");
    const auto at = text.find(",ok,");
    text.insert(at, "5");  // changes the first value
    box.write("s.csv", text);
    good(box.shell(command("random,halton", "8,32", "-s 3 --seeds 5", "moments,coverage") +
                   "-o s.csv --resume"));
    EXPECT_EQ(lines(box.read("s.csv"), 2).substr(0, at + 1), text.substr(0, at + 1));
}

// Killed while copying existing rows, before and after the table is truncated.
TEST(Study, ResumeWithMoreSeedsCanBeResumed) {
    const Sandbox box;
    const std::string before =
        "stipple study --generators random,halton -n 8,16 --seeds 30 "
        "--analyze moments --no-seconds -o s.csv ";
    const std::string more =
        "stipple study --generators random,halton -n 8,16 --seeds 40 "
        "--analyze moments --no-seconds -o s.csv ";
    good(box.shell(more + "--overwrite"));
    const std::string whole = box.read("s.csv");
    const std::string journal = "{\"format\":\"stipple.study-journal\",\"version\":3,";
    good(box.shell(before + "--overwrite"));
    const std::string old = box.read("s.csv");
    for (const char* limit : {"", "600", "2000", "6000"}) {  // limits that cut off the journal
        box.write("s.csv", old);
        if (*limit != 0)
            (void)box.shell(
                fmt::format("(ulimit -f 3; trap '' XFSZ; {}) 2>/dev/null", more + "--resume"));
        EXPECT_EQ(box.read("s.csv"), old);
        if (*limit != 0) {
            const std::string entries = box.read("s.csv.journal");
            EXPECT_TRUE(entries.starts_with(journal));
            box.write("s.csv.journal", entries.substr(0, std::stoul(limit)));
        }
        good(box.shell(more + "--resume"));
        EXPECT_TRUE(box.read("s.csv") == whole) << limit;
    }
}

TEST(Study, ResumeRefusesWhatHasLess) {
    const Sandbox box;
    const auto refused = [&](const std::string& options, const std::string& has) {
        const Outcome outcome =
            box.shell("stipple study --no-seconds -o s.csv --resume " + options);
        EXPECT_EQ(outcome.code, 3);
        EXPECT_EQ(outcome.err,
                  "stipple: s.csv: --resume: the study in the file has " + has +
                      ", this one does not; include it, too, or name another file with -o\n");
    };
    good(box.shell(
        "stipple study --generators random,halton -n 8,16 -d 2,3 -s 2 --seeds 3 --analyze "
        "moments,coverage --no-seconds -o s.csv"));
    const std::string whole = box.read("s.csv");
    refused("--generators random,sobol -n 8,16 -d 2,3 -s 2 --seeds 3 --analyze moments,coverage",
            "the generator halton");
    refused("--generators random,halton -n 8 -d 2,3 -s 2 --seeds 3 --analyze moments,coverage",
            "sets of 16 points");
    refused("--generators random,halton -n 8,16 -d 2 -s 2 --seeds 3 --analyze moments,coverage",
            "dimension 3");
    refused("--generators random,halton -n 8,16 -d 2,3 -s 3 --seeds 3 --analyze moments,coverage",
            "seed 2");
    refused("--generators random,halton -n 8,16 -d 2,3 -s 2 --seeds 2 --analyze moments,coverage",
            "seed 4");
    refused("--generators random,halton -n 8,16 -d 2,3 -s 2 --seeds 3 --analyze moments",
            "the measure coverage");
    EXPECT_EQ(box.read("s.csv"), whole);
    // Some rows are missing.
    box.write("s.csv", lines(whole, 1) + whole.substr(lines(whole, 12).size()));
    EXPECT_EQ(box.shell("stipple study --generators random,halton -n 8,16 -d 2,3 -s 2 --seeds 9 "
                        "--analyze moments,coverage --no-seconds -o s.csv --resume")
                  .code,
              3);
}

TEST(Study, AnUnfinishedStudyIsNotOverwritten) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("-o study.csv"))), "");
    const std::string whole = box.read("study.csv");
    box.write("study.csv", lines(whole, 9));
    box.write("study.csv.journal", "");
    const Outcome outcome = box.shell(small + std::string("-o study.csv"));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.err, HasSubstr("holds an unfinished study; --resume continues it"));
    EXPECT_EQ(box.read("study.csv"), lines(whole, 9));
}

TEST(Study, AFinishedStudyIsOverwrittenOnlyIfAsked) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("-o study.csv"))), "");
    const std::string whole = box.read("study.csv");
    const Outcome outcome = box.shell(small + std::string("-s 9 -o study.csv"));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err,
              "stipple: study.csv: exists and holds a study; --overwrite starts anew, --resume "
              "adds what is missing, -o names another file\n");
    EXPECT_EQ(box.read("study.csv"), whole);
    EXPECT_EQ(good(box.shell(small + std::string("-s 9 -o study.csv --overwrite"))), "");
    EXPECT_NE(box.read("study.csv"), whole);
    box.write("study.csv", lines(whole, 9));
    box.write("study.csv.journal", "");
    EXPECT_EQ(good(box.shell(small + std::string("-o study.csv --overwrite"))), "");
    EXPECT_EQ(box.read("study.csv"), whole);
    EXPECT_EQ(box.shell(small + std::string("-o study.csv --overwrite --resume")).code, 2);
}

TEST(Study, AnotherStudyIsNamedByWhatDiffers) {
    const Sandbox box;
    ASSERT_EQ(box.shell("stipple study --generators random -n 4096 -d 5 --seeds 99 --analyze "
                        "star-discrepancy -o study.csv & pid=$!; until [ -s study.csv ]; do sleep "
                        "0.05; done; kill -INT $pid; wait $pid")
                  .code,
              130);
    const Outcome outcome = box.shell(
        "stipple study --generators random -n 4096 -d 5 --seeds 98 --analyze "
        "star-discrepancy -o study.csv --resume");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err,
              "stipple: study.csv: --resume: the file holds another study: it has seeds '99', this "
              "one '98'; resume it with its own options, or name another file with -o\n");
}

// Rows show neither keys nor limits, which the fingerprint tells.
TEST(Study, AnotherFinishedStudyIsNamedByWhatDiffers) {
    const Sandbox box;
    const std::string study =
        "stipple study halton -n 16,32 --analyze star-discrepancy --seeds 2 -o ";
    const auto differs = [&](const std::string& options) {
        const Outcome outcome = box.shell(study + "s.csv --resume " + options);
        EXPECT_EQ(outcome.code, 3) << options;
        const auto from = outcome.err.find("another study") + 13;
        return outcome.err.substr(from, outcome.err.find("; resume it") - from);
    };
    good(box.shell(study + "s.csv"));
    const std::string whole = box.read("s.csv");
    EXPECT_EQ(differs("--keys value"), ": it has keys '', this one 'value'");
    EXPECT_EQ(differs("--keys value --curves"), ": it has keys '', this one 'value'");
    EXPECT_EQ(differs("--curves"), ": it has curves 'false', this one 'true'");
    EXPECT_EQ(differs("--time-limit 5"), ": it has time-limit 'none', this one '5'");
    EXPECT_EQ(differs("-w disk"), ": it has warp '', this one 'disk'");
    EXPECT_EQ(differs("--no-seconds"), ": it has seconds, this one has none");
    EXPECT_EQ(box.read("s.csv"), whole);
    good(box.shell(study + "s.csv --overwrite --keys value --time-limit 7 --no-seconds"));
    EXPECT_EQ(differs(""), ": it has no seconds, this one has");
    EXPECT_EQ(differs("--no-seconds --time-limit 7"), ": it has keys 'value', this one ''");
    EXPECT_EQ(differs("--no-seconds --keys value"),
              ": of other keys, another time-limit or version of stipple, which rows do not show");
}

TEST(Study, RowsThatWereChangedAreFoundOut) {
    const Sandbox box;
    ASSERT_EQ(good(box.shell(small + std::string("-o study.csv"))), "");
    const std::string whole = box.read("study.csv");
    std::string moved = lines(whole, 1) + whole.substr(lines(whole, 9).size());
    box.write("study.csv", moved);
    Outcome outcome = box.shell(small + std::string("-o study.csv --resume"));
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("study.csv:2: this row is not in its place"));
    box.write("study.csv", lines(whole, 3) + "nonsense\n" + whole.substr(lines(whole, 4).size()));
    outcome = box.shell(small + std::string("-o study.csv --resume"));
    EXPECT_EQ(outcome.code, 3);
    EXPECT_THAT(outcome.err, HasSubstr("study.csv:4: this is not a row of a study"));
}

TEST(Study, HugeStudiesAreRefusedBeforeTheyStart) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "stipple study --generators random,halton -n 1024 --seeds 5e8 --analyze "
        "star-discrepancy -o study.csv --threads 2");
    EXPECT_EQ(outcome.code, 5);
    // Estimating the time of a billion cells would take too long.
    EXPECT_EQ(box.run({"study", "--generators", "random", "--analyze", "moments", "-n",
                       "1..1000000+1", "-d", "1..1000+1"})
                  .code,
              5);
    EXPECT_THAT(outcome.err, HasSubstr("the study has 1000000000 rows or more (2 generators x 1 "
                                       "dimensions x 1 counts x 500000000 seeds x 1 measures), "
                                       "about "));
    EXPECT_THAT(outcome.err, HasSubstr("on 2 cores; --yes starts it anyway\n"));
    EXPECT_TRUE(box.files().empty());
}

TEST(Study, AConfigurationSaysTheSameAsOptions) {
    const Sandbox box;
    box.write("study.json",
              R"({"generators": ["random", {"name": "sobol", "options": {"scramble": "owen"}},
                                 "halton"],
                  "count": "2^4..64", "seeds": 4, "seconds": false,
                  "analyze": ["star-discrepancy", "l2-discrepancy:kind=centered"]})");
    const std::string typed = good(box.shell(small));
    EXPECT_EQ(good(box.shell("stipple study --config study.json")), typed);
    EXPECT_EQ(good(box.shell("stipple study --config - < study.json")), typed);
    EXPECT_NE(good(box.shell("stipple study --config study.json --seeds 2")), typed);
    box.write("bad.json", R"({"generators": ["sobl"], "analyze": "moments"})");
    const Outcome outcome = box.shell("stipple study --config bad.json");
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err,
              "stipple: bad.json: $.generators[0]: unknown generator 'sobl'; did you mean "
              "'sobol'?\n");
}

// Values are checked like typed ones; the message names their key.
TEST(Study, ValuesOfAConfigurationThatNoOptionTakesAreNamedByTheirKey) {
    const Sandbox box;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {R"("seed": -1)", "seed: '-1' is not a whole number in [0, 2^64) or 'random'"},
        {R"("seeds": 0)", "seeds: 0 is outside [1, 9007199254740992]"},
        {R"("seeds": 2.5)", "seeds: '2.5' is not a whole number, such as 1000, 1e6, 2^20 or 64k"},
        {R"("count": [16, "64..16"])", "count: the range '64..16' is empty: 64 is above 16"},
        {R"("confidence": 95, "summary": true)",
         "confidence: '95' is not a number above 0 and below 1"},
        {R"("time-limit": 0)", "time-limit: '0' is not a number above 0 and below 1000000000"},
        {R"("bootstrap": 0, "summary": true)", "bootstrap: 0 is outside [1, 10000000]"},
        {R"("pairs": "t", "summary": true)", "pairs: 't' is not one of welch, paired"},
        {R"("format": "json")",
         "format: 'json' is not one of csv, jsonl, latex; did you mean 'jsonl'?"}};
    for (const auto& [setting, message] : cases) {
        box.write("s.json", R"({"generators": "random", "analyze": "moments", )" + setting + "}");
        const Outcome outcome = box.shell("stipple study --config s.json");
        EXPECT_EQ(outcome.code, 3) << setting;
        EXPECT_EQ(outcome.err, "stipple: s.json: $." + message + "\n");
    }
    box.write("s.json", R"({"generators": "random", "analyze": "moments", "seeds": 1e3})");
    const auto rows = rows_of(good(box.shell("stipple study --config s.json --keys mean -n 4")));
    EXPECT_EQ(rows.back().at("seed"), "1000");
}

TEST(Study, BadInputIsOneLineThatHelps) {
    const Sandbox box;
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"--generators sobl --analyze moments",
         "stipple: unknown generator 'sobl'; did you mean 'sobol'?\n"},
        {"--generators random --analyze momnts",
         "stipple: unknown analyzer 'momnts'; did you mean 'moments'?\n"},
        {"--generators random --analyze moments -w dsk",
         "stipple: unknown warp 'dsk'; did you mean 'disk'?\n"},
        {"--generators 'random,a:v=[1' --analyze moments",
         "stipple: --generators, column 12: this '[' has no ']'\n"},
        {"--generators 'random,halton;' --analyze moments",
         "stipple: --generators, column 15: a name is expected\n"},
        {"--generators random --analyze moments -n 64..16",
         "stipple: --count: the range '64..16' is empty: 64 is above 16\n"},
        {"--analyze moments",
         "stipple: study: --generators is missing; 'stipple study --help' has examples; --config "
         "FILE names a study in a file\n"},
        {"--generators random,random --analyze moments",
         "stipple: generators: 'random' is given twice\n"},
        {"--generators random --analyze moments --pairs t",
         "stipple: --pairs: 't' is not one of welch, paired\n"},
        {"--generators random --analyze moments --pairs paired",
         "stipple: --pairs: requires --summary, which is not given\n"},
        {"--generators random --analyze moments --confidence 95",
         "stipple: --confidence: '95' is not a number above 0 and below 1\n"},
        {"--generators random --analyze l2-discrepancy:kind=centred -n 16,32 -d 2,3",
         "stipple: analyze: l2-discrepancy: --kind: 'centred' is not a kind of L2 discrepancy; did "
         "you mean 'centered'?\n"},
        {"--generators random --analyze differential:pixels=8 -w disk",
         "stipple: analyze: differential: --pixels: 8 is even; expected an odd number, so that one "
         "pixel is in the middle\n"},
        {"--generators random --analyze moments -d 1..6",
         "stipple: --dimension: '1..6' does not say which numbers lie between its ends; 1..6*2 "
         "goes by a "
         "factor, 1..6+1 by a step, 2^4..2^16 by powers\n"},
        {"--generators random --analyze moments -f json",
         "stipple: --format: 'json' is not one of csv, jsonl, latex; did you mean 'jsonl'?\n"},
        {"--generators random --analyze moments -o study.json",
         "stipple: --output: a study's table is .csv or .jsonl or, with --wide, .tex; 'study.json' "
         "is none of these; --format csv or jsonl selects a format for any file name\n"},
        {"--generators poison --analyze moments",
         "stipple: unknown generator 'poison'; did you mean 'poisson'?\n"},
        {"--generators random --analyze star-discrepancy --keys worst_bx",
         "stipple: --keys: no measure of the study has a result 'worst_bx'; "},
        {"--generators random --analyze moments,star-discrepancy --keys value",
         "stipple: --keys: none of these is a result of moments: value; add one, or leave "
         "out moments\n"},
        {"points.csv --generators random --analyze moments",
         "stipple: unknown generator 'points.csv'"},
        {"--generators 'random -w dsk' --analyze moments",
         "stipple: unknown warp 'dsk'; did you mean 'disk'?\n"},
        {"--generators 'random -n 7' --analyze moments",
         "stipple: 'random -n 7': -n is not understood; only -w WARP and the generator's --OPTIONs "
         "may follow it\n"},
        {"random --analyze moments --wide --summary",
         "stipple: --summary: is for tables of rows, not for a wide one\n"},
        {"random --analyze moments --labels A", "stipple: --labels: requires --wide"},
        {"random --analyze moments --confidence 0.9",
         "stipple: --confidence: requires --summary or --wide, which are not given\n"}};
    for (const auto& [arguments, message] : cases) {
        const Outcome outcome = box.shell("stipple study " + arguments);
        EXPECT_EQ(outcome.code, 2) << arguments;
        EXPECT_TRUE(outcome.err.starts_with(message)) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
}

TEST(Study, AClosedPipeIsNoError) {
    const Sandbox box;
    const Outcome outcome = box.shell(
        "(stipple study --generators random -n 16 --seeds 20000 --analyze moments; echo $? >&2) | "
        "head -1 > /dev/null");
    EXPECT_EQ(outcome.err, "0\n");
}

TEST(Study, RanksGiveTheBytesOfOneProcess) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    if (!can_launch()) GTEST_SKIP() << "no MPI, or no launcher";
    const std::string one = good(box.shell(small));
    for (const char* ranks : {"2", "4"}) {
        const Outcome outcome =
            box.shell(mpirun + "-n " + ranks + " " + small + "-o ranks.csv --overwrite");
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(box.read("ranks.csv"), one) << ranks;
    }
    // A failed measurement is a row, with any number of ranks.
    const std::string failing =
        "stipple study --generators 'grid,random' -n 16..2^6 --seeds 3 --analyze "
        "star-discrepancy --no-seconds -o failing.csv";
    EXPECT_EQ(box.shell(failing).code, 3);
    const std::string expected = box.read("failing.csv");
    EXPECT_EQ(box.shell(mpirun + "-n 2 " + failing + " --overwrite").code, 3);
    EXPECT_EQ(box.read("failing.csv"), expected);
    // Only rank 0 reports a wrong command line.
    const Outcome wrong =
        box.shell(mpirun + "-n 2 stipple study --generators sobl --analyze moments");
    EXPECT_EQ(wrong.code, 2);
    const auto first = wrong.err.find("unknown generator");
    EXPECT_NE(first, std::string::npos);
    EXPECT_EQ(wrong.err.find("unknown generator", first + 1), std::string::npos);
}

// Slurm's launcher gives PMIx the number of processes. Processes that are not connected must not
// each do the whole study.
TEST(Study, ProcessesThatDoNotFindEachOtherAreRefused) {
    if (sanitized()) GTEST_SKIP() << "MPI's own leaks are not ours";
    const Sandbox box;
    const Outcome first =
        box.shell("SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=0 " + std::string(small) + "-o study.csv");
    EXPECT_EQ(first.code, 2);
    EXPECT_THAT(first.err, HasSubstr("started 2 processes"));
    EXPECT_FALSE(box.exists("study.csv"));
    const Outcome second =
        box.shell("SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=1 " + std::string(small) + "-o study.csv");
    EXPECT_EQ(second.code, 2);
    EXPECT_EQ(second.err, "") << "the first one speaks for all";
}

// Variables that a shell inherited from a launcher suppress only errors of shared work.
TEST(Study, OnlySharedWorkLeavesErrorsToTheFirstRank) {
    const Sandbox box;
    const std::string rank = "OMPI_COMM_WORLD_SIZE=4 OMPI_COMM_WORLD_RANK=3 ";
    EXPECT_THAT(box.shell(rank + "stipple generate sobl").err, HasSubstr("did you mean 'sobol'?"));
    EXPECT_THAT(box.shell("PMI_RANK=1 stipple study --analyze moments").err,
                HasSubstr("--generators is missing"));
}

}  // namespace stipple::testing::study_test
