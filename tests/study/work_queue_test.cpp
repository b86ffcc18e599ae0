// SPDX-License-Identifier: MIT
#include "study/work_queue.hpp"

#include <gtest/gtest.h>

namespace stipple::testing::work_queue_test {
namespace {

using Ranges = std::vector<UnitRange>;

Sweep sweep() {
    return Sweep({.generators = {"random", "halton", "poisson-disk"},
                  .counts = {16, 4096, 65536},
                  .dimensions = {2, 3},
                  .seeds = 7,
                  .measures = {"star-discrepancy", "moments", "periodogram"}});
}

/// Number of times that each unit is assigned.
std::vector<int> given_out(const Sweep& s, const Ranges& done, std::size_t workers) {
    std::vector<int> times(s.units());
    WorkQueue queue(s, done, workers);
    while (const auto ranges = queue.pull())
        for (const auto& [first, last] : *ranges)
            for (std::uint64_t u = first; u < last; ++u) ++times[u];
    EXPECT_EQ(queue.pieces_left(), 0U);
    return times;
}

}  // namespace

TEST(WorkQueue, TellsWhatIsMissing) {
    const Ranges done = {{0, 0}, {10, 20}, {20, 25}, {30, 40}};
    EXPECT_EQ(missing(done, {0, 50}), (Ranges{{0, 10}, {25, 30}, {40, 50}}));
    EXPECT_EQ(missing(done, {12, 24}), Ranges{});
    EXPECT_EQ(missing(done, {15, 35}), (Ranges{{25, 30}}));
    EXPECT_EQ(missing(done, {0, 5}), (Ranges{{0, 5}}));
}

TEST(WorkQueue, GivesOutEveryUnitOnceForAnyNumberOfWorkers) {
    const Sweep s = sweep();
    EXPECT_EQ(s.units(), 3U * 2 * 3 * 7 * 3);
    for (const std::size_t workers : {1, 3, 1000})
        EXPECT_EQ(given_out(s, {}, workers), std::vector<int>(s.units(), 1)) << workers;
}

TEST(WorkQueue, LeavesOutWhatIsDone) {
    const Sweep s = sweep();
    const Ranges done = {{0, 5}, {17, 18}, {100, 200}, {377, 378}};
    std::vector<int> expected(s.units(), 1);
    for (const auto& [first, last] : done)
        for (std::uint64_t u = first; u < last; ++u) expected[u] = 0;
    EXPECT_EQ(given_out(s, done, 2), expected);
}

// A study that is stopped early has the same sets of all generators. One worker has nothing to balance;
// several begin so only for a twentieth of the work, which here ends before the large sets: then the
// longest comes, and shorter ones until they have taken as much time.
TEST(WorkQueue, BeginsWithSmallSetsOfAllGenerators) {
    const Sweep s({.generators = {"random", "poisson-disk"},
                   .counts = {16, 32, 10'000'000, 100'000'000},
                   .measures = {"moments"}});
    const auto order = [&s](std::size_t workers) {
        std::vector<std::uint64_t> firsts;
        WorkQueue queue(s, {}, workers);
        while (const auto ranges = queue.pull()) firsts.push_back(ranges->front().first);
        return firsts;
    };
    EXPECT_EQ(order(1), (std::vector<std::uint64_t>{0, 4, 1, 5, 2, 6, 3, 7}));
    EXPECT_EQ(order(2), (std::vector<std::uint64_t>{0, 4, 1, 5, 2, 7, 3, 6}));
}

TEST(WorkQueue, NothingIsLeftInTheEnd) {
    const Sweep s = sweep();
    const double modelled = WorkQueue(s).seconds_left();
    EXPECT_GT(modelled, 0);
    EXPECT_NEAR(WorkQueue(s, {{0, s.units()}}).seconds_left(), 0, 1e-9 * modelled);
    // Everything takes a hundred times what the model says: so will what is left.
    WorkQueue slower(s);
    const UnitRange first{0, s.units() / 3};
    const double left = WorkQueue(s, {first}).seconds_left();
    slower.finish({first}, (modelled - left) * 100);
    EXPECT_GT(slower.seconds_left(), 50 * left);
}

// Searches in 6 dimensions that are a thousand times faster than the model do not make those in the
// plane faster; cells of which nothing is known are as fast as all others together.
TEST(WorkQueue, LearnsFromMeasuredTimes) {
    const Sweep s(SweepRequest{.generators = {"random"},
                               .counts = {1000},
                               .dimensions = {2, 6, 3},
                               .seeds = 10,
                               .measures = {"star-discrepancy"}});
    const auto cost = [&s](std::uint64_t cell) { return set_cost(s, s.cell(cell)).all(); };
    WorkQueue queue(s);
    EXPECT_NEAR(queue.seconds_left(), 10 * (cost(0) + cost(1) + cost(2)), 1e-9);
    queue.finish({{10, 15}}, 5e-3 * cost(1));
    queue.finish({{0, 5}}, 5 * cost(0));
    const double all = (5 * cost(0) + 5e-3 * cost(1)) / (5 * cost(0) + 5 * cost(1));
    EXPECT_NEAR(queue.seconds_left(), 5 * cost(0) + 5e-3 * cost(1) + 10 * all * cost(2), 1e-9);
}

// poisson-disk is thought to be dearer, and is measured to be cheaper.
TEST(WorkQueue, SortsByMeasuredTimesWhenTheyAreKnown) {
    const Sweep s({.generators = {"random", "poisson-disk"},
                   .counts = {100'000'000},
                   .seeds = 4,
                   .measures = {"star-discrepancy"}});
    WorkQueue queue(s, {}, 2);
    EXPECT_EQ(queue.pull()->front().first, 4U) << "the longest";
    EXPECT_EQ(queue.pull()->front().first, 0U) << "the shortest";
    queue.finish({{0, 1}}, 100);
    queue.finish({{4, 5}}, 50);
    EXPECT_EQ(queue.pull()->front().first, 5U) << "the shortest, as measured";
}

TEST(Sweep, UnitsGoThroughGeneratorsThenDimensionsCountsSeedsMeasures) {
    const Sweep s = sweep();
    const Unit last = s.unit(s.units() - 1);
    EXPECT_EQ(last.measure, 2U);
    EXPECT_EQ(last.seed_index, 6U);
    const Cell cell = s.cell(last.cell);
    EXPECT_EQ(cell.generator, 2U);
    EXPECT_EQ(cell.dimension, 3U);
    EXPECT_EQ(cell.count, 65536U);
    EXPECT_EQ(s.cell(s.unit(7 * 3).cell).count, 4096U);
}

TEST(Sweep, TheFingerprintIsOfAllThatRowsDependOn) {
    const SweepRequest request{.generators = {"random"}, .measures = {"moments"}};
    const std::string own = Sweep(request).fingerprint();
    EXPECT_EQ(own.size(), 16U);
    EXPECT_EQ(Sweep(request).fingerprint(), own);
    auto other = request;
    other.seeds = 2;
    EXPECT_NE(Sweep(other).fingerprint(), own);
    other = request;
    other.warps = {"disk"};
    EXPECT_NE(Sweep(other).fingerprint(), own);
    other = request;
    other.generators = {"random:rng=philox"};  // the default, written explicitly
    EXPECT_EQ(Sweep(other).fingerprint(), own);
}

}  // namespace stipple::testing::work_queue_test
