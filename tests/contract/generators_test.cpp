// SPDX-License-Identifier: MIT
//
// Promises of every registered generator.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "pipeline/pipeline.hpp"
#include "places.hpp"
#include "support/contract.hpp"

namespace stipple::testing::generators_test {
namespace {

class EveryGenerator : public ::testing::TestWithParam<std::string> {
  protected:
    const Generator& unit = find_generator(GetParam());
    const std::uint64_t many =
        count_of(unit.name, std::min<std::uint64_t>(10'000, 4 * many_of(unit.name)));
    const std::uint64_t few = count_of(unit.name, 400);
    const std::uint64_t more = count_of(unit.name, 900);
    const std::size_t dimension =
        std::clamp<std::size_t>(2, unit.traits.min_dimension, unit.traits.max_dimension);

    PointSet make(std::uint64_t count, const Seeded& seeded = {}, std::uint64_t start = 0) const {
        return stipple::testing::make(unit.name, points(count, dimension, start),
                                      needed_options(unit.name), seeded);
    }
    PointSet make_in(const RunContext& run, std::uint64_t count) const {
        return stipple::testing::make(unit.name, points(count, dimension),
                                      needed_options(unit.name), run);
    }
};

// 400 = 20^2, a count that grids support, too.
TEST_P(EveryGenerator, StaysInTheHalfOpenCube) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const PointSet set = make(few, {.seed = seed});
        for (const double x : set.flat()) EXPECT_TRUE(x >= 0 && x < 1) << x;
    }
}

TEST_P(EveryGenerator, GivesAsManyPointsAsAskedFor) {
    const PointSet set = make(few);
    EXPECT_EQ(set.count(), few);
    EXPECT_EQ(set.dimension(), dimension);
}

TEST_P(EveryGenerator, DependsOnTheSeedAloneNotOnThreads) {
    const PointSet one = make(many, {.seed = 9, .threads = 1});
    EXPECT_EQ(one, make(many, {.seed = 9, .threads = 2}));
    EXPECT_EQ(one, make(many, {.seed = 9, .threads = 7}));
    EXPECT_EQ(make(few, {.seed = 9}) != make(few, {.seed = 10}),
              uses_seed(unit, unit.options.defaults()));
}

TEST_P(EveryGenerator, KeepsItsPrefixPromise) {
    if (!unit.traits.prefix) GTEST_SKIP() << "its points depend on their number";
    const PointSet whole = make(more);
    const PointSet part = make(few);
    EXPECT_TRUE(std::ranges::equal(part.flat(), whole.flat().first(part.flat().size())));
}

TEST_P(EveryGenerator, StartDropsThatManyPoints) {
    if (!unit.traits.prefix) {
        EXPECT_NE(error_of([&] { make(few, {}, 3); }).find("usage: --start"), std::string::npos);
        return;
    }
    const PointSet whole = make(more);
    const PointSet tail = make(more - few, {}, few);
    EXPECT_TRUE(std::ranges::equal(tail.flat(), whole.flat().last(tail.flat().size())));
}

// Blocks of a sequence, requested in any sizes, join to the same points.
TEST_P(EveryGenerator, FillsAnyPiecesToTheSameWhole) {
    if (!unit.traits.sequence) GTEST_SKIP() << "made as a whole";
    const PointSet whole = make(few);
    Values options = unit.options.defaults();
    for (const auto& [option, value] : needed_options(unit.name))
        unit.options.set(options, option, value);
    const Plan plan = plan_for(unit, points(few, dimension), options);
    const auto sequence = unit.sequence(plan, options, {});
    for (const std::size_t piece : {1, 7, 64, 399}) {
        std::vector<double> rows;
        for (std::size_t i = 0; i < few; i += piece) {
            std::vector<double> part(std::min<std::size_t>(piece, few - i) * dimension);
            sequence->fill(i, part);
            rows.insert(rows.end(), part.begin(), part.end());
        }
        EXPECT_TRUE(std::ranges::equal(rows, whole.flat())) << "pieces of " << piece;
    }
}

TEST_P(EveryGenerator, RefusesAnEmptySet) {
    EXPECT_NE(error_of([&] { make(0); }).find("usage: --count: 0"), std::string::npos);
}

// The least count is 1, unless settings.txt lists counts.
TEST_P(EveryGenerator, MakesItsLeastCount) {
    EXPECT_EQ(make(count_of(unit.name, 1)).count(), count_of(unit.name, 1));
}

TEST_P(EveryGenerator, WorksInOneDimensionOrSaysThatItDoesNot) {
    const auto one = [&] {
        return stipple::testing::make(unit.name, points(count_of(unit.name, 100), 1),
                                      needed_options(unit.name));
    };
    if (unit.traits.min_dimension > 1)
        EXPECT_NE(error_of(one).find("usage: --dimension: 1 is outside"), std::string::npos);
    else
        EXPECT_EQ(one().dimension(), 1U);
}

TEST_P(EveryGenerator, RefusesDimensionsBeyondItsTraits) {
    const std::size_t beyond = unit.traits.max_dimension + 1;
    const auto error = error_of(
        [&] { stipple::testing::make(unit.name, points(1, beyond), needed_options(unit.name)); });
    EXPECT_NE(error.find("usage: --dimension"), std::string::npos) << error;
}

TEST_P(EveryGenerator, ProgressRisesToTheEnd) {
    expect_progress_to_the_end([&](const RunContext& run) { make_in(run, many); });
}

TEST_P(EveryGenerator, StopsAtOnce) {
    const std::uint64_t count = count_of(unit.name, 1'000'000);
    if (count < 1'000'000) GTEST_SKIP() << "makes no large sets";
    expect_to_stop_at_once([&](const RunContext& run) { make_in(run, count); });
}

TEST_P(EveryGenerator, RefusesWhatNeedsTooMuchMemory) {
    const std::uint64_t count = count_of(unit.name, 1'000'000);
    const auto error = error_of([&] { make(count, {.max_memory = count / 10}); });
    EXPECT_TRUE(error.starts_with("limit: ")) << error;
}

TEST_P(EveryGenerator, HasACompleteRecord) {
    expect_complete_record(unit);
    EXPECT_EQ(static_cast<bool>(unit.sequence), unit.traits.sequence);
    EXPECT_EQ(static_cast<bool>(unit.set), !unit.traits.sequence);
    EXPECT_TRUE(unit.traits.seeded || !unit.uses_seed);
    // The first of these options names a file; the others may only affect its contents.
    const auto& options = unit.options.options();
    for (const std::string& written : unit.writes) {
        const auto option = std::ranges::find(options, written, &Option::name);
        ASSERT_NE(option, options.end()) << written;
        EXPECT_TRUE(option->type == "file" || written != unit.writes.front()) << written;
    }
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryGenerator, ::testing::ValuesIn(names_of(generators::all())),
                         case_name);

}  // namespace

TEST(Registry, HoldsTheUnitsByTheirNamesInOrder) {
    const auto list = names_of(generators::all());
    EXPECT_TRUE(std::ranges::is_sorted(list));
    for (const char* name : {"grid", "halton", "hammersley", "jittered", "poisson-disk", "random"})
        EXPECT_EQ(std::ranges::count(list, name), 1) << name;
}

// A name means one unit, among generators and among the units that `warp` accepts.
TEST(Registry, EveryNameMeansOneUnit) {
    std::set<std::string> names;
    for (const Generator& unit : generators::all()) {
        EXPECT_TRUE(names.insert(unit.name).second) << unit.name;
        for (const std::string& alias : unit.aliases) {
            EXPECT_TRUE(names.insert(alias).second) << alias;
            EXPECT_EQ(&find_generator(alias), &unit);
        }
    }
    EXPECT_TRUE(names.contains("regular"));
    names.clear();
    for (const Warp& unit : warps::all()) EXPECT_TRUE(names.insert(unit.name).second) << unit.name;
    for (const Scramble& unit : scrambles::all()) {
        EXPECT_TRUE(names.insert(unit.name).second) << unit.name;
        for (const std::string& alias : unit.aliases) {
            EXPECT_TRUE(names.insert(alias).second) << alias;
            EXPECT_EQ(scramble_named(alias), &unit);
        }
    }
}

}  // namespace stipple::testing::generators_test
