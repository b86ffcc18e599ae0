// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "support/sequences.hpp"

namespace stipple::testing::random_test {
namespace {

const std::vector<std::string> engines = {"philox",   "mt19937-64", "drand48",
                                          "ranlux48", "ranmar",     "random"};

PointSet with(const std::string& rng, const Request& request, std::uint64_t seed) {
    return make("random", request, {{"rng", rng}}, {.seed = seed});
}

}  // namespace

// Numbers of the C library's drand48, assigned to the coordinates in turn.
TEST(Random, Drand48DealsItsNumbersInTurn) {
    EXPECT_EQ(with("drand48", points(1, 3), 1),
              points_of({{0.041630344771878214, 0.45449244472862915, 0.8348172181669149}}));
    EXPECT_EQ(with("drand48", points(3, 1), 1),
              points_of({{0.041630344771878214}, {0.45449244472862915}, {0.8348172181669149}}));
    EXPECT_EQ(with("drand48", points(1, 1), 0), points_of({{0.17082803610628972}}));
}

// First numbers, known from the C library and from the standard's engines.
TEST(Random, EveryEngineIsTheOneThatIsNamed) {
    EXPECT_EQ(with("philox", points(1, 2), 5), points_of({{Rng(5).uniform(0), Rng(5).uniform(1)}}));
    EXPECT_EQ(with("random", points(1, 2), 1),
              points_of({{1804289383 * 0x1p-31, 846930886 * 0x1p-31}}));
    EXPECT_EQ(with("mt19937-64", points(1, 1, 9999), 5489),
              points_of({{to_unit(9981545732273789042U)}}));
    EXPECT_EQ(with("ranlux48", points(1, 1, 9999), 0), points_of({{249142670248501. * 0x1p-48}}));
    EXPECT_EQ(with("ranmar", points(3, 2, 10000), 1802 * 30082 + 9373),
              points_of({{6533892 * 0x1p-24, 14220222 * 0x1p-24},
                         {7275067 * 0x1p-24, 6172232 * 0x1p-24},
                         {8354498 * 0x1p-24, 10633180 * 0x1p-24}}));
    EXPECT_EQ(make("random", points(10, 2)), with("philox", points(10, 2), 1));
}

TEST(Random, AnyStretchIsThatOfTheWhole) {
    for (const auto& rng : engines)
        EXPECT_TRUE(stretches_agree("random", points(50, 3), {{"rng", rng}})) << rng;
}

TEST(Random, StartLeavesPointsOut) {
    for (const auto& rng : engines) {
        const PointSet whole = with(rng, points(9000, 3), 3);
        const PointSet tail = with(rng, points(4000, 3, 5000), 3);
        EXPECT_TRUE(std::ranges::equal(tail.flat(), whole.flat().subspan(5000 * 3))) << rng;
    }
}

TEST(Random, ThreadsChangeNothing) {
    for (const auto& rng : engines) {
        const PointSet alone = make("random", points(30000, 2), {{"rng", rng}}, {.threads = 1});
        EXPECT_EQ(make("random", points(30000, 2), {{"rng", rng}}, {.threads = 5}), alone) << rng;
    }
}

TEST(Random, SequentialEnginesSaySo) {
    for (const auto& rng : engines)
        EXPECT_EQ(sequence_of("random", points(1, 1), {{"rng", rng}})->random_access(),
                  rng == "philox" || rng == "drand48")
            << rng;
}

TEST(Random, FarIndicesWork) {
    const std::uint64_t far = (std::uint64_t{1} << 53) - 2;
    for (const char* rng : {"philox", "drand48"}) {
        const PointSet points = with(rng, stipple::testing::points(2, 1000, far), 1);
        for (const double x : points.flat()) EXPECT_TRUE(x >= 0 && x < 1) << rng;
    }
    // drand48 has the period 2^48.
    EXPECT_EQ(with("drand48", points(2, 1, std::uint64_t{1} << 48), 7),
              with("drand48", points(2, 1), 7));
}

TEST(Random, RefusesSeedsThatAnEngineDoesNotTake) {
    const auto refusal = [](const char* rng, std::uint64_t seed) {
        return error_of([&] { with(rng, points(1, 1), seed); });
    };
    EXPECT_EQ(refusal("drand48", 0xffffffff), "");
    EXPECT_EQ(refusal("drand48", 0x100000000),
              "usage: --seed: 4294967296 is outside [0, 4294967295], the range of this generator's "
              "seeds");
    EXPECT_EQ(refusal("random", 0xffffffff), "");
    EXPECT_NE(refusal("random", 0x100000000), "");
    EXPECT_EQ(refusal("ranmar", 942438977), "");
    EXPECT_NE(refusal("ranmar", 942438978), "");
    EXPECT_EQ(refusal("ranlux48", 2147483562), "");
    EXPECT_NE(refusal("ranlux48", 2147483563), "");
    EXPECT_EQ(refusal("mt19937-64", ~std::uint64_t{0}), "");
    EXPECT_EQ(refusal("philox", ~std::uint64_t{0}), "");
    EXPECT_NE(refusal("rand", 1), "");
}

TEST(Random, NotesWhereSeedZeroIsAnother) {
    const auto note = [](const char* rng, std::uint64_t seed) {
        std::string said;
        RunContext run;
        run.warn = [&](const std::string& text) { said = text; };
        generate("random", {.count = 1, .seed = seed}, {{"rng", rng}}, run);
        return said;
    };
    EXPECT_EQ(note("random", 0), "the engine random takes seed 0 for 1: both give the same points");
    EXPECT_EQ(with("random", points(3, 2), 0), with("random", points(3, 2), 1));
    EXPECT_EQ(note("ranlux48", 0),
              "the engine ranlux48 takes seed 0 for 19780503: both give the same points");
    EXPECT_EQ(with("ranlux48", points(3, 2), 0), with("ranlux48", points(3, 2), 19780503));
    for (const char* rng : {"philox", "drand48", "mt19937-64", "ranmar"})
        EXPECT_EQ(note(rng, 0), "");
    EXPECT_EQ(note("random", 1), "");
}

// The mean of 2e5 numbers differs from 1/2 by less than 5 standard deviations, sqrt(1 / (12 N)),
// and neighbours are uncorrelated: false alarm 6 engines x 2 x 6e-7. Using every second number
// only, or halving a range, fails by far.
TEST(Random, NumbersAreUniformAndUncorrelated) {
    for (const auto& rng : engines) {
        const PointSet set = with(rng, points(200'000, 1), 11);
        double sum = 0;
        double products = 0;
        for (std::size_t i = 0; i < set.count(); ++i) {
            sum += set[i][0] - 0.5;
            products += (set[i][0] - 0.5) * (set[(i + 1) % set.count()][0] - 0.5);
        }
        EXPECT_LT(std::abs(sum), 5 * std::sqrt(200'000 / 12.)) << rng;
        EXPECT_LT(std::abs(products), 5 * std::sqrt(200'000 / 144.)) << rng;
    }
}

}  // namespace stipple::testing::random_test
