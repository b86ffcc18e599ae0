// SPDX-License-Identifier: MIT
#include "pipeline/shared_analysis.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <memory>

#include "core/bytes/packed.hpp"
#include "core/error.hpp"
#include "io/files.hpp"
#include "report/document.hpp"
#include "support/temporary_file.hpp"
#include "support/thread_ranks.hpp"
#include "support/units.hpp"

namespace stipple::testing::shared_analysis_test {
namespace {

Values values_of(const Analyzer& analyzer, const Settings& settings) {
    Values values = analyzer.options.defaults();
    for (const auto& [name, text] : settings) analyzer.options.set(values, name, text);
    return values;
}

/// All numbers with all their bits.
std::string text_of(const Report& report) {
    return to_json(std::vector<Measurement>{{.analyzer = "",
                                             .source = "",
                                             .count = 0,
                                             .dimension = 1,
                                             .domain = "",
                                             .results = report}});
}

/// Report by this number of ranks.
std::string found_by(int ranks, const std::string& analyzer, const PointSet& points,
                     const Settings& settings = {}) {
    const Analyzer& unit = find_analyzer(analyzer);
    const Values options = values_of(unit, settings);
    std::string text;
    with_ranks(ranks, [&](Ranks& mine) {
        const auto found =
            analyze_shared(unit, shared_in_memory(points), options, mine, {.threads = 1});
        EXPECT_EQ(found.has_value(), mine.rank() == 0);
        if (found) text = text_of(found->report);
    });
    return text;
}

void expect_same_for_all_ranks(const std::string& analyzer, const PointSet& points,
                               const Settings& settings = {}) {
    const std::string one = text_of(analyze(analyzer, points, settings));
    for (const int ranks : {1, 2, 3, 4, 7})
        EXPECT_EQ(found_by(ranks, analyzer, points, settings), one)
            << analyzer << ", " << ranks << " ranks";
}

}  // namespace

// More batches than ranks, and fewer; the points do not divide evenly.
TEST(SharedAnalysis, IsThatOfOneProcessToTheLastBit) {
    for (const auto& [n, d] : {std::pair<std::size_t, std::size_t>{300'007, 2}, {50'001, 11}}) {
        const PointSet points = make("random", {.count = n, .dimension = d});
        expect_same_for_all_ranks("moments", points);
        expect_same_for_all_ranks("chi-square", points, {{"shifted", "true"}});
        expect_same_for_all_ranks("kolmogorov-smirnov", points);
    }
}

TEST(SharedAnalysis, AddsGridsOfSpectraToTheLastBit) {
    const PointSet points = make("random", {.count = 4'200'000, .dimension = 2});  // three grains
    const Settings few = {{"max-frequency", "8"}, {"tolerance", "1e-3"}};
    const std::string one = text_of(analyze("periodogram", points, few));
    EXPECT_EQ(found_by(2, "periodogram", points, few), one);
}

TEST(SharedAnalysis, AddsGridsOfFadedPointsToTheLastBit) {
    const PointSet points = make("random", {.count = 2'200'000, .dimension = 2});  // two grains
    const Settings hann = {{"max-frequency", "8"}, {"tolerance", "1e-3"}, {"window", "hann"}};
    EXPECT_EQ(found_by(2, "periodogram", points, hann),
              text_of(analyze("periodogram", points, hann)));
}

// Weights in the second block are much larger than in the first; both contribute to the sum.
TEST(SharedAnalysis, AddsGridsOfStrongAndWeakPointsToTheLastBit) {
    const std::size_t n = 2'200'000;  // two grains
    const PointSet bare = make("random", {.count = n, .dimension = 2});
    const double faint = 0x1p-17;
    std::vector<double> rows;
    rows.reserve(3 * n);
    for (std::size_t i = 0; i < n; ++i) {
        const double strength = static_cast<double>(i % 1001) / 500 - 0.3;
        rows.insert(rows.end(), {bare[i][0], bare[i][1], strength * (i < 2'097'152 ? faint : 1)});
    }
    const Analyzer& unit = find_analyzer("periodogram");
    const auto from = [&](std::uint64_t first) -> NextRows {
        return [&rows, at = 3 * static_cast<std::size_t>(first)](std::span<double> out) mutable {
            const std::size_t some = std::min(rows.size() - at, out.size());
            std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>(at), some, out.begin());
            at += some;
            return some / 3;
        };
    };
    const auto alone = [&](const Settings& settings) {
        return analyze(unit, {.domain = bare.domain, .count = n, .weighted = true}, from(0),
                       values_of(unit, settings), {.threads = 2})
            .report;
    };
    const Settings few = {{"max-frequency", "2"}, {"tolerance", "1e-6"}, {"weights", "3"}};
    const Report one = alone(few);
    std::string shared;
    with_ranks(2, [&](Ranks& mine) {
        const SharedSet set{.points = {.domain = bare.domain, .count = n, .weighted = true},
                            .from = from};
        const auto found = analyze_shared(unit, set, values_of(unit, few), mine, {.threads = 1});
        if (found) shared = text_of(found->report);
    });
    EXPECT_EQ(shared, text_of(one));
    // Oracle: the direct sum, with other rounding.
    const Report direct = alone({{"max-frequency", "2"}, {"method", "direct"}, {"weights", "3"}});
    const auto& exact = std::get<Grid>(*direct.find("grid")).values;
    const auto& found = std::get<Grid>(*one.find("grid")).values;
    for (std::size_t i = 0; i < exact.size(); ++i)
        EXPECT_NEAR(found[i], exact[i], 1e-5 * (1 + exact[i])) << i;
}

// The whole report, including the worst box, from searches of many rounds and of few.
TEST(SharedAnalysis, SearchesTogetherWhatOneSearches) {
    const Analyzer& unit = find_analyzer("star-discrepancy");
    for (const Settings& settings :
         {Settings{}, {{"max-work", "3000000"}}, {{"tolerance", "0.3"}}}) {
        const PointSet points = make("random", {.count = 80, .dimension = 4});
        const Values options = values_of(unit, settings);
        const std::string one = text_of(unit.analyze(points, options, {}));
        for (const int ranks : {2, 3})
            with_ranks(ranks, [&](Ranks& mine) {
                const Report found = unit.sharing.together(points, options, mine, {.threads = 1});
                EXPECT_EQ(text_of(found), one) << ranks;
            });
    }
}

// A stop request to one rank, early in the search, ends all ranks in the same round.
TEST(SharedAnalysis, StopsTogether) {
    const Analyzer& unit = find_analyzer("star-discrepancy");
    const PointSet points = make("random", {.count = 300, .dimension = 6});
    const Values options = values_of(unit, {});
    std::stop_source stop;
    stop.request_stop();
    std::atomic<int> ended = 0;
    with_ranks(3, [&](Ranks& mine) {
        RunContext run{.threads = 1};
        if (mine.rank() == 1) run.stop = stop.get_token();
        const Report found = unit.sharing.together(points, options, mine, run);
        EXPECT_LT(found.number("lower"), found.number("upper"));
        ++ended;
    });
    EXPECT_EQ(ended, 3);
}

TEST(SharedAnalysis, CountsPointsOutsideAsOneProcessDoes) {
    PointSet points = make("random", {.count = 500'000, .dimension = 2});
    for (const std::size_t i : {200'000, 400'000}) points[i][1] = 2;
    std::string one;
    try {
        analyze("moments", points);
    } catch (const Error& e) {
        one = e.what();
    }
    EXPECT_NE(one.find("2 of 500000 points"), std::string::npos) << one;
    with_ranks(4, [&](Ranks& mine) {
        try {
            const Values options = values_of(find_analyzer("moments"), {});
            analyze_shared(find_analyzer("moments"), shared_in_memory(points), options, mine,
                           {.threads = 1});
            EXPECT_NE(mine.rank(), 0);
        } catch (const Error& e) {
            EXPECT_EQ(e.what(), one);
        }
    });
}

// Files of any sizes and formats, split at positions that are not ends of files.
TEST(SharedFiles, GiveThePointsFromAnyPlace) {
    const PointSet points = make("random", {.count = 1000, .dimension = 3});
    std::vector<std::unique_ptr<TemporaryFile>> files;
    std::vector<std::string> paths;
    const std::size_t ends[] = {0, 10, 700, 1000};
    for (std::size_t i = 0; i < 3; ++i) {
        std::string text;
        for (std::size_t k = ends[i]; k < ends[i + 1]; ++k)
            text += fmt::format("{} {} {}\n", points[k][0], points[k][1], points[k][2]);
        files.push_back(std::make_unique<TemporaryFile>(text, ".txt"));
        paths.push_back(files.back()->path());
    }
    const io::Opener open = [](const std::string& path) {
        return io::open_points(path, {.source = path}, {});
    };
    for (const int ranks : {1, 2, 5})
        with_ranks(ranks, [&](Ranks& mine) {
            const SharedSet shared = shared_in_files(paths, open, mine, {});
            EXPECT_EQ(shared.points.count, 1000U);
            EXPECT_EQ(shared.points.dimension(), 3U);
            for (const std::size_t first : {0, 9, 10, 11, 500, 700, 999}) {
                std::vector<double> rows(3 * 50);
                const std::size_t got = shared.from(first)(rows);
                EXPECT_EQ(got, std::min<std::size_t>(50, 1000 - first));
                EXPECT_TRUE(std::equal(rows.begin(), rows.begin() + 3 * got,
                                       points.flat().begin() + 3 * first));
            }
        });
}

TEST(SharedFiles, FailOnAllRanksWithTheFirstError) {
    const io::Opener open = [](const std::string& path) {
        return io::open_points(path, {.source = path}, {});
    };
    std::atomic<int> failed = 0;
    with_ranks(3, [&](Ranks& mine) {
        try {
            shared_in_files({"/no/such/a.csv", "/no/such/b.csv"}, open, mine, {});
        } catch (const Error& e) {
            EXPECT_STREQ(e.what(), "/no/such/a.csv: no such file");
            ++failed;
        }
    });
    EXPECT_EQ(failed, 3);
}

}  // namespace stipple::testing::shared_analysis_test
