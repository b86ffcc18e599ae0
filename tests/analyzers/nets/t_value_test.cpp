// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"
#include "support/contract.hpp"
#include "support/nets.hpp"
#include "support/scrambling.hpp"
#include "support/units.hpp"

namespace stipple::testing::t_value_test {
namespace {

Report t_value(const PointSet& points, std::int64_t base = 2, std::int64_t projections = 2,
               const RunContext& run = {}) {
    return analyze("t-value", points,
                   {{"base", std::to_string(base)}, {"projections", std::to_string(projections)}},
                   run);
}

std::int64_t t_of(const PointSet& points, std::int64_t base = 2) {
    return static_cast<std::int64_t>(t_value(points, base).number("t"));
}

std::vector<std::int64_t> list(const Report& report, std::string_view key) {
    return std::get<Report::Integers>(*report.find(key));
}

PointSet projected(const PointSet& points, const std::vector<std::size_t>& coordinates) {
    PointSet out(points.count(), coordinates.size());
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < coordinates.size(); ++k) out[i][k] = points[i][coordinates[k]];
    return out;
}

/// Oracle: the definition, for each t and each interval.
std::int64_t t_by_definition(const PointSet& points, int base) {
    return static_cast<std::int64_t>(exact_t(points, static_cast<std::uint64_t>(base)));
}

/// Point i of a digital net is the sum of the columns selected by the digits of i.
PointSet digital_net(int base, int m, std::size_t dimension, const Rng& rng) {
    const auto n = static_cast<std::size_t>(std::lround(std::pow(base, m)));
    PointSet points(n, dimension);
    const auto b = static_cast<std::uint64_t>(base);
    std::uint64_t draw = 0;
    for (std::size_t k = 0; k < dimension; ++k) {
        std::vector<std::vector<std::uint64_t>> matrix(static_cast<std::size_t>(m));
        for (auto& row : matrix)
            for (int j = 0; j < m; ++j) row.push_back(rng.below(draw++, b));
        for (std::size_t i = 0; i < n; ++i) {
            std::uint64_t x = 0;
            for (const auto& row : matrix) {
                std::uint64_t digit = 0;
                std::uint64_t rest = i;
                for (const std::uint64_t entry : row) {
                    digit += entry * (rest % b);
                    rest /= b;
                }
                x = x * b + digit % b;
            }
            points[i][k] = static_cast<double>(x) / static_cast<double>(n);
        }
    }
    return points;
}

PointSet shuffled(const PointSet& points, const Rng& rng) {
    PointSet out = points;
    for (std::size_t i = points.count() - 1; i > 0; --i)
        std::ranges::swap_ranges(out[i], out[rng.below(i, i + 1)]);
    return out;
}

}  // namespace

// Four points: 2 x 2 boxes hold one each, and so do four columns, but a row of four holds two.
TEST(TValue, ByHand) {
    const PointSet points = points_of({{0, 0}, {0.25, 0.5}, {0.5, 0.125}, {0.75, 0.875}});
    const Report report = t_value(points);
    EXPECT_EQ(report.number("t"), 1);
    EXPECT_EQ(report.number("m"), 2);
    EXPECT_EQ(report.number("base"), 2);
    EXPECT_EQ(list(report, "projections.t_1d"), (Report::Integers{0, 1}));
    EXPECT_EQ(list(report, "projections.t_2d"), (Report::Integers{1}));
    EXPECT_EQ(list(report, "projections.largest"), (Report::Integers{1, 1}));
    EXPECT_EQ(report.number("projections.worst_size"), 1);
    EXPECT_EQ(list(report, "projections.worst"), (Report::Integers{2}));
    EXPECT_EQ(t_of(points, 4), 1);
}

TEST(TValue, HammersleyIsAZeroNetInItsBase) {
    for (const std::uint64_t n : {2, 64, 16384})
        EXPECT_EQ(t_of(make("hammersley", points(n, 2))), 0);
    EXPECT_GT(t_of(make("hammersley", points(729, 2)), 3), 0);
    // The second and third coordinates have the bases 2 and 3.
    const PointSet three = make("hammersley", points(729, 3));
    EXPECT_EQ(t_of(projected(three, {0, 2}), 3), 0);
    EXPECT_EQ(t_value(projected(three, {0, 2}), 3).text("method"), "rank");
}

// Nested scrambling preserves the counts in all elementary boxes, but the result is not a digital
// net; after a digital shift it still is.
TEST(TValue, ScramblingChangesNoT) {
    const PointSet plane = make("hammersley", points(4096, 2));
    const PointSet owen = scrambled(plane, "owen");
    EXPECT_EQ(t_of(owen), 0);
    EXPECT_EQ(t_value(owen).text("method"), "counting");
    const PointSet shifted = scrambled(plane, "digital-shift");
    EXPECT_EQ(t_of(shifted), 0);
    EXPECT_EQ(t_value(shifted).text("method"), "rank");
    const PointSet three = projected(make("hammersley", points(729, 3)), {0, 2});
    EXPECT_EQ(t_of(scrambled(three, "owen:base=3"), 3), 0);
    EXPECT_EQ(t_of(scrambled(three, "digital-shift:base=3"), 3), 0);
}

TEST(TValue, RandomPointsAreFarFromEven) {
    for (const std::uint64_t n : {256, 4096}) {
        const auto report = t_value(make("random", points(n, 3)));
        EXPECT_GT(report.number("t"), report.number("m") - 3);
        EXPECT_EQ(report.text("method"), "counting");
    }
}

TEST(TValue, DuplicatesHaveTheLargestT) {
    EXPECT_EQ(t_of(PointSet(std::vector<double>(3 * 32, 0.7), 3)), 5);
    EXPECT_EQ(t_of(PointSet(std::vector<double>(2 * 81, 0.7), 2), 3), 4);
    // Each point of a net twice: t is larger by one digit.
    const PointSet net = make("hammersley", points(64, 2));
    std::vector<double> twice(net.flat().begin(), net.flat().end());
    twice.insert(twice.end(), net.flat().begin(), net.flat().end());
    EXPECT_EQ(t_of(PointSet(twice, 2)), 1);
}

TEST(TValue, OnePointAndOneCoordinate) {
    const Report one = t_value(points_of({{0.3, 0.4, 0.5}}), 7);
    EXPECT_EQ(one.number("t"), 0);
    EXPECT_EQ(one.number("m"), 0);
    for (const double x : {0.0, 0.5, 1.0}) EXPECT_EQ(t_of(points_of({{x}})), 0);
    EXPECT_EQ(t_of(make("halton", points(1024, 1))), 0);
    EXPECT_EQ(t_of(points_of({{0}, {0.1}, {0.6}, {0.7}})), 1);
    EXPECT_EQ(t_of(points_of({{0.6}, {0.7}, {0.8}, {0.9}})), 2);
}

TEST(TValue, OneIsInTheLastInterval) {
    EXPECT_EQ(t_of(points_of({{0}, {0.25}, {0.5}, {1}})), 0);
    EXPECT_EQ(t_of(points_of({{0}, {0.25}, {0.75}, {1}})), 1);
    EXPECT_EQ(t_of(points_of({{0, 1}, {1, 0}})), 0);
    EXPECT_EQ(t_of(points_of({{0, 0}, {1. / 3, 1. / 3}, {1, 1}}), 3), 0);
}

// Many doubles nearest to j / b^m are below it, and belong to the cell of j; adjacent doubles
// belong to the cell that contains them.
TEST(TValue, RoundedMultiplesAreOnTheirEdges) {
    for (const auto& [b, n] : {std::pair{3, 6561}, {5, 3125}, {7, 2401}, {10, 10000}, {49, 2401}}) {
        std::vector<double> edges;
        for (int j = 0; j < n; ++j) edges.push_back(static_cast<double>(j) / n);
        EXPECT_EQ(t_of(PointSet(edges, 1), b), 0) << b;
        for (int j : {1, n / 2, n - 1}) {
            auto moved = edges;
            double& x = moved[static_cast<std::size_t>(j)];
            x = std::nextafter(x, 1);
            EXPECT_EQ(t_of(PointSet(moved, 1), b), 0) << b;
            x = std::nextafter(std::nextafter(x, 0), 0);
            int t = 1;  // and one more for each coarser edge at j / n
            for (; j % b == 0; j /= b) ++t;
            EXPECT_EQ(t_of(PointSet(moved, 1), b), t) << b;
        }
    }
}

// Also in another order, which hides the matrices, so that points are counted.
TEST(TValue, IsThatOfTheDefinition) {
    std::uint64_t stream = 0;
    for (const auto& [base, m, d] :
         {std::tuple{2, 5, 2}, {2, 6, 3}, {2, 4, 4}, {2, 4, 6}, {3, 3, 2}, {3, 4, 3}, {5, 2, 4}})
        for (int set = 0; set < 20; ++set) {
            const Rng rng(5, stream++);
            const auto net = digital_net(base, m, static_cast<std::size_t>(d), rng);
            const auto mixed = shuffled(net, Rng(6, stream));
            const std::int64_t expected = t_by_definition(net, base);
            for (const std::int64_t size : {1, 2, 3}) {
                const Report by_rank = t_value(net, base, size);
                EXPECT_EQ(by_rank.number("t"), expected) << base << ' ' << m << ' ' << d;
                EXPECT_EQ(by_rank.text("method"), "rank");
                const Report by_count = t_value(mixed, base, size);
                EXPECT_EQ(by_count.text("method"), "counting");
                for (const char* key : {"t", "projections"})
                    EXPECT_EQ(*by_rank.find(key), *by_count.find(key)) << key << ' ' << base;
            }
        }
}

TEST(TValue, CountsInBasesThatAreNotPrime) {
    for (int set = 0; set < 20; ++set) {
        const PointSet net = digital_net(4, 3, 3, Rng(8, static_cast<std::uint64_t>(set)));
        EXPECT_EQ(t_of(net, 4), t_by_definition(net, 4));
        EXPECT_EQ(t_value(net, 4).text("method"), "counting");
    }
}

TEST(TValue, ProjectionsAreThoseOfTheProjectedPoints) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const PointSet net = digital_net(2, 6, 4, Rng(seed));
        const Report report = t_value(net, 2, 3);
        Report::Integers ones;
        Report::Integers twos;
        Report::Integers threes;
        for (std::size_t a = 0; a < 4; ++a) {
            ones.push_back(t_by_definition(projected(net, {a}), 2));
            for (std::size_t b = 0; b < a; ++b) {
                twos.push_back(t_by_definition(projected(net, {b, a}), 2));
                for (std::size_t c = 0; c < b; ++c)
                    threes.push_back(t_by_definition(projected(net, {c, b, a}), 2));
            }
        }
        EXPECT_EQ(list(report, "projections.t_1d"), ones);
        EXPECT_EQ(list(report, "projections.t_2d"), twos);
        EXPECT_EQ(list(report, "projections.t_3d"), threes);
        EXPECT_EQ(list(report, "projections.largest"),
                  (Report::Integers{std::ranges::max(ones), std::ranges::max(twos),
                                    std::ranges::max(threes)}));
    }
}

TEST(TValue, NamesTheSmallestProjectionsThatHaveTheTOfAll) {
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const PointSet net = digital_net(2, 7, 5, Rng(seed, 9));
        const std::int64_t t = t_by_definition(net, 2);
        Report::Integers expected;
        std::size_t size = 0;
        while (expected.empty()) {
            ++size;
            for (unsigned chosen = 0; chosen < 32; ++chosen) {  // ascending in the last coordinate
                std::vector<std::size_t> along;
                for (std::size_t k = 0; k < 5; ++k)
                    if (chosen >> k & 1) along.push_back(k);
                if (along.size() != size || t_by_definition(projected(net, along), 2) != t)
                    continue;
                for (const std::size_t k : along)
                    expected.push_back(static_cast<std::int64_t>(k + 1));
            }
        }
        for (const std::int64_t known : {1, 2, 3}) {
            const Report report = t_value(net, 2, known);
            EXPECT_EQ(report.number("projections.worst_size"), static_cast<double>(size));
            EXPECT_EQ(list(report, "projections.worst"), expected) << seed << ", " << known;
        }
    }
}

// A digital shift does not change t, and the matrices of the net are still recognized.
TEST(TValue, SeesThroughADigitalShift) {
    const Rng rng(4);
    PointSet net = digital_net(2, 8, 3, rng);
    const Report before = t_value(net);
    for (std::size_t i = 0; i < net.count(); ++i)
        for (std::size_t k = 0; k < 3; ++k) {
            const auto shift = rng.bits(1'000'000 + k) >> 12;
            const auto x = static_cast<std::uint64_t>(net[i][k] * 0x1p52);
            net[i][k] = static_cast<double>(x ^ shift) * 0x1p-52;
        }
    EXPECT_EQ(t_value(net), before);
    EXPECT_EQ(before.text("method"), "rank");
    // After moving one point, it is not a digital net.
    net[200][1] = 1 - net[200][1];
    EXPECT_EQ(t_value(net).text("method"), "counting");
}

TEST(TValue, RefusesCountsThatAreNoPowerNamingTheNearest) {
    const PointSet set = make("random", points(1000, 2));
    EXPECT_EQ(error_of([&] { t_value(set); }),
              "input: t-value requires b^m points; 1000 is not a power of 2 (--base); 512 and 1024 "
              "are the nearest");
    EXPECT_EQ(error_of([&] { t_value(set, 4096); }),
              "input: t-value requires b^m points; 1000 is not a power of 4096 (--base); 1 and "
              "4096 are the nearest");
    EXPECT_EQ(error_of([&] { t_value(set, 10); }), "");
    EXPECT_EQ(error_of([&] { t_value(set, 1); }), "usage: --base: 1 is outside [2, 1000000]");
}

TEST(TValue, SaysBeforehandWhenItNeedsTooMuchMemory) {
    const PointSet set = make("random", points(4096, 100));
    const RunContext small{.threads = 1, .max_memory = 1'000'000};
    EXPECT_EQ(error_of([&] { t_value(set, 2, 2, small); }).substr(0, 27),
              "limit: the t-value needs 1.");
    const RunContext large{.threads = 1, .max_memory = 100'000'000};
    EXPECT_EQ(error_of([&] { t_value(set, 2, 8, large); }).substr(0, 36),
              "limit: the t of every projection nee");
}

TEST(TValue, TellsItsProgressWhileItCounts) {
    const PointSet set = shuffled(digital_net(2, 12, 5, Rng(3)), Rng(4));
    double last = 0;
    int calls = 0;
    RunContext run{.threads = 2};
    run.progress = [&](double done) {
        EXPECT_GE(done, last);
        last = done;
        ++calls;
    };
    t_value(set, 2, 2, run);
    EXPECT_EQ(last, 1);
    EXPECT_GT(calls, 20);
}

TEST(TValue, StopsWhileItCounts) {
    const PointSet net = shuffled(digital_net(2, 17, 4, Rng(3)), Rng(4));
    expect_to_stop_at_once([&](const RunContext& run) { t_value(net, 2, 2, run); }, 0.5);
}

}  // namespace stipple::testing::t_value_test
