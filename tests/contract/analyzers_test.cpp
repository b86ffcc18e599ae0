// SPDX-License-Identifier: MIT
//
// Promises of every registered analyzer, with default options.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "support/contract.hpp"

namespace stipple::testing::analyzers_test {
namespace {

class EveryAnalyzer : public ::testing::TestWithParam<std::string> {
  protected:
    const Analyzer& unit = find_analyzer(GetParam());
    const std::size_t dimension =
        std::clamp<std::size_t>(2, unit.traits.min_dimension, unit.traits.max_dimension);

    /// Report on powers of two, which every analyzer accepts.
    Report report(std::uint64_t count, const RunContext& run = {}) const {
        PointSet set = make("random", points(count, dimension));
        set.provenance = {};  // for independent points, some results have standard errors
        return analyze(unit, set, unit.options.defaults(), run);
    }
};

TEST_P(EveryAnalyzer, GivesTheSameForAnyNumberOfThreads) {
    const Report one = report(4096, {.threads = 1});
    EXPECT_EQ(one, report(4096, {.threads = 2}));
    EXPECT_EQ(one, report(4096, {.threads = 7}));
}

TEST_P(EveryAnalyzer, GivesTheSameForPointsThatComeInBlocks) {
    EXPECT_NE(unit.analyze == nullptr, unit.accumulate == nullptr) << "one of both";
    if (!unit.accumulate) GTEST_SKIP();
    const PointSet set = make("random", points(200'001, dimension));
    const Values options = unit.options.defaults();
    for (const bool told : {false, true}) {
        std::size_t at = 0;
        const auto next = [&](std::span<double> rows) {
            const auto rest = set.flat().subspan(at);
            const std::size_t size = std::min(rest.size(), rows.size());
            std::ranges::copy(rest.first(size), rows.begin());
            at += size;
            return size / dimension;
        };
        Arrival arrival{.domain = set.domain};
        if (told) arrival.count = set.count();
        const Found found = analyze(unit, arrival, next, options, {});
        EXPECT_EQ(found.report, analyze(unit, set, options, {})) << told;
    }
}

TEST_P(EveryAnalyzer, GivesTheKeysOfItsRecord) {
    const Report found = report(512);
    for (const ResultKey& result : unit.results) {
        const bool there =
            found.find(result.key) || std::ranges::any_of(found.keys(), [&](const auto& key) {
                return find_result(unit, key) == &result;
            });
        EXPECT_EQ(there, result.always) << result.key;
        EXPECT_FALSE(result.help.empty()) << result.key;
    }
    for (const auto& key : found.keys()) EXPECT_NE(find_result(unit, key), nullptr) << key;
}

// Conditions on words are checked against the record before anything is measured.
TEST_P(EveryAnalyzer, GivesNoWordThatItsRecordDoesNotTell) {
    for (const std::size_t d : {1, 2, 3}) {
        if (d < unit.traits.min_dimension || d > unit.traits.max_dimension) continue;
        if (unit.traits.table && d == 1) continue;  // no input besides the output
        PointSet set = make("random", points(256, d));
        if (unit.traits.table) set.provenance = {};  // which lists no outputs
        const Report found = analyze(unit, set, unit.options.defaults(), {});
        for (const auto& key : found.keys()) {
            const std::string_view words = find_result(unit, key)->words;
            const Report::Item& item = *found.find(key);
            if (std::holds_alternative<bool>(item)) {
                EXPECT_EQ(words, true_or_false) << key;
            } else if (const auto* word = std::get_if<std::string>(&item)) {
                EXPECT_TRUE(words.empty() || std::ranges::count(split(words, '|'), *word) == 1)
                    << key << " is " << *word;
            } else {
                EXPECT_EQ(words, "") << key;
            }
        }
    }
}

TEST_P(EveryAnalyzer, ExplainsEachWordOfItsResults) {
    for (const ResultKey& result : unit.results)
        for (const auto word : split(result.words, '|'))
            EXPECT_TRUE(result.words == true_or_false ||
                        result.help.find(word) != std::string::npos)
                << result.key << ": " << word;
}

TEST_P(EveryAnalyzer, DrawsAndComparesResultsOfItsRecord) {
    for (const CurveKey& curve : unit.curves) {
        EXPECT_NE(find_result(unit, curve.key), nullptr) << curve.key;
        // A list for pairs of coordinates is over no other list.
        EXPECT_TRUE(curve.over.empty() || find_result(unit, curve.over) != nullptr) << curve.over;
    }
    for (const PageMeasure& measure : unit.page)
        for (const auto& [key, label] : measure.compared)
            EXPECT_NE(find_result(unit, key), nullptr) << key;
}

TEST_P(EveryAnalyzer, RefusesAnEmptySetAndWrongDimensions) {
    const Values options = unit.options.defaults();
    EXPECT_TRUE(error_of([&] {
                    analyze(unit, PointSet(0, dimension), options, {});
                }).starts_with("input: "));
    if (unit.traits.max_dimension >= 100) return;
    EXPECT_TRUE(
        error_of([&] { analyze(unit, PointSet(9, 100), options, {}); }).starts_with("input: "));
}

TEST_P(EveryAnalyzer, RefusesPointsOutsideItsDomainCountingThem) {
    if (unit.traits.table) GTEST_SKIP() << "outputs are any numbers";
    PointSet set = make("random", points(100, dimension));
    set[7][0] = 1.5;
    set[9][0] = -0.5;
    const auto error = error_of([&] { analyze(unit, set, unit.options.defaults(), {}); });
    EXPECT_TRUE(error.starts_with("input: 2 of 100 points are outside")) << error;
    EXPECT_NE(error.find("(1.5, "), std::string::npos) << error;
}

TEST_P(EveryAnalyzer, TakesTheDomainsThatItsRecordTells) {
    PointSet set = make("random", points(1024, 2));
    if (unit.traits.table) set.provenance = {};
    for (double& x : set.flat()) x /= 2;
    const auto error_on = [&](const char* domain) {
        set.domain = parse_domain(domain, 2);
        return error_of([&] { analyze(unit, set, unit.options.defaults(), {}); });
    };
    if (unit.traits.unit_cube) {  // even if all points are in the cube
        for (const char* domain : {"box:bounds=[0..1,-1..2]", "disk"})
            EXPECT_TRUE(error_on(domain).starts_with(
                "input: " + unit.name +
                " requires points of the unit cube; the domain of these is "))
                << error_on(domain);
        EXPECT_EQ(error_on("box:bounds=0..1"), "");
        return;
    }
    EXPECT_EQ(error_on("box:bounds=[0..1,-1..2]"), "");
    const std::string on_disk = error_on("disk");
    const std::string refused = " requires points of the unit cube or a box; the domain is disk";
    // An analyzer with a choice of kernels may support other domains with another kernel.
    const bool taken = !unit.traits.boxed && on_disk.empty();
    EXPECT_TRUE(taken || (on_disk.starts_with("input: " + unit.name) &&
                          on_disk.find(refused) != std::string::npos))
        << on_disk;
}

TEST_P(EveryAnalyzer, TakesPointsOnTheClosedCube) {
    PointSet set = make("random", points(1024, dimension));
    if (unit.traits.table) set.provenance = {};
    set[7][0] = 1;
    set[9][0] = 0;
    EXPECT_EQ(error_of([&] { analyze(unit, set, unit.options.defaults(), {}); }), "");
}

TEST_P(EveryAnalyzer, ProgressRisesToTheEnd) {
    expect_progress_to_the_end([&](const RunContext& run) { report(1 << 17, run); });
}

TEST_P(EveryAnalyzer, StopsAtOnce) {
    expect_to_stop_at_once([&](const RunContext& run) {
        const Report known = report(1 << 18, run);
        // Instead of throwing, a search may return the bounds found so far.
        if (known.find("lower") && known.number("lower") < known.number("upper")) run.check_stop();
    });
}

TEST_P(EveryAnalyzer, HasACompleteRecord) {
    expect_complete_record(unit);
    EXPECT_FALSE(unit.results.empty());
    EXPECT_FALSE(unit.traits.unit_cube && unit.traits.boxed);
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryAnalyzer, ::testing::ValuesIn(names_of(analyzers::all())),
                         case_name);

}  // namespace

}  // namespace stipple::testing::analyzers_test
