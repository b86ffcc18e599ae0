// SPDX-License-Identifier: MIT
#include "pipeline/chain.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/rng.hpp"
#include "stipple/warp.hpp"
#include "support/units.hpp"

namespace stipple::testing::chain_test {
namespace {

WarpChain chain(std::initializer_list<const char*> specs, std::size_t dimension) {
    std::vector<Spec> parsed;
    for (const char* text : specs) parsed.push_back(parse_spec(text));
    return {parsed, dimension};
}

}  // namespace

TEST(WarpChain, WarpsTheNamedCoordinatesAndLeavesTheOthers) {
    const auto both = chain({"disk@4,2", "triangle@1,3"}, 5);
    const auto disk = chain({"disk"}, 2);
    const auto triangle = chain({"triangle"}, 2);
    const std::vector<double> row = {0.1, 0.2, 0.3, 0.4, 0.5};
    const auto out = both.forward(row);
    const auto on_disk = disk.forward({0.4, 0.2});
    const auto on_triangle = triangle.forward({0.1, 0.3});
    EXPECT_EQ(out,
              (std::vector<double>{on_triangle[0], on_disk[1], on_triangle[1], on_disk[0], 0.5}));
    EXPECT_EQ(both.domain()->spec(), "disk@4,2 x triangle@1,3 x unit-cube@5");
    EXPECT_NEAR(both.density(out)[0], 2 / 3.14159265358979, 1e-12);
}

// A triangle in space has three numbers for two coordinates; later coordinates are shifted.
TEST(WarpChain, ImagesOfMoreNumbersMakeRowsLonger) {
    const auto longer = chain({"disk@3,4", "triangle@1,2:vertices=[0,0,1 1,0,1 0,1,1]"}, 4);
    EXPECT_EQ(longer.dimension_out(), 5U);
    const std::vector<double> row = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8};
    const auto out = longer.forward(row);
    ASSERT_EQ(out.size(), 10U);
    EXPECT_EQ(out[2], 1);
    EXPECT_EQ(out[7], 1);
    const auto on_disk = chain({"disk"}, 2).forward({0.3, 0.4});
    EXPECT_EQ(out[3], on_disk[0]);
    EXPECT_EQ(out[4], on_disk[1]);
    const auto back = longer.inverse(out);
    for (std::size_t k = 0; k < row.size(); ++k) EXPECT_NEAR(back[k], row[k], 1e-14) << k;
}

// Inverses are points of the half-open cube [0, 1), which every warp accepts: never 1.
TEST(WarpChain, RimsComeBackBelowOne) {
    for (const char* warp : {"disk:method=concentric", "ellipse", "ball", "tent", "annulus"}) {
        const std::size_t d = std::string_view(warp) == "ball" ? 3 : 2;
        const auto there = chain({warp}, d);
        for (const double x : there.inverse(there.forward(std::vector<double>(d, one_minus_ulp)))) {
            EXPECT_LT(x, 1) << warp;
            EXPECT_NEAR(x, 1, 1e-14) << warp;
        }
    }
    const auto corner = chain({"disk:method=concentric"}, 2).inverse({1, 0});
    EXPECT_EQ(corner, (std::vector<double>{one_minus_ulp, 0.5}));
}

// A sphere has three numbers for two coordinates; the inverse shifts later coordinates back.
TEST(WarpChain, TheWayBackLeavesTheDomainsOfOtherCoordinates) {
    const auto sphere = chain({"sphere@1,2"}, 5);
    const auto before = [&](const std::string& after) {
        return domain_before(sphere, parse_domain(after, 6))->spec();
    };
    EXPECT_EQ(before("sphere@1,2,3 x disk@5,6 x unit-cube@4"), "disk@4,5 x unit-cube@1,2,3");
    EXPECT_EQ(before("sphere@1,2,3 x unit-cube@4,5,6"), "unit-cube");
    EXPECT_EQ(before("sphere@1,2,3 x box@4:bounds=[0..2] x unit-cube@5,6"),
              "box@3:bounds=[0..2] x unit-cube@1,2,4,5");
}

TEST(WarpChain, DroppedPointsTakeTheirWholeRow) {
    const auto rejection = chain({"disk@1,2:method=rejection"}, 3);
    EXPECT_TRUE(rejection.traits().drops);
    const auto out = rejection.forward({0.5, 0.5, 0.1, 0.01, 0.01, 0.2, 0.75, 0.5, 0.3});
    EXPECT_EQ(out, (std::vector<double>{0, 0, 0.1, 0.5, 0, 0.3}));
}

TEST(WarpChain, RefusesWhatDoesNotFit) {
    EXPECT_EQ(error_of([] { chain({"disk"}, 3); }),
              "usage: warp disk takes 2 coordinates; the points have 3 | name the coordinates: "
              "disk@1,2, or make points with -d 2");
    EXPECT_EQ(error_of([] { chain({"disk"}, 1); }),
              "usage: warp disk takes 2 coordinates; the points have 1");
    EXPECT_EQ(error_of([] { chain({"disk@1,2,3"}, 3); }),
              "usage: warp disk takes 2 coordinates; 3 are named: disk@1,2,3");
    EXPECT_EQ(error_of([] { chain({"disk:radius=1,radius=2"}, 2); }),
              "usage: disk: the option 'radius' is given twice: 1 and 2");
    EXPECT_EQ(error_of([] { parse_domain("0..4", 2); }),
              "usage: unknown domain '0..4' | a box is written box:bounds=[0..4]");
    EXPECT_EQ(error_of([] { parse_domain("owen", 2); }).find("scramble"), std::string::npos);
    EXPECT_NE(error_of([] { chain({"disk@1,4"}, 3); }), "");
    EXPECT_NE(error_of([] { chain({"disk@1,2", "disk@2,3"}, 3); }), "");
}

TEST(WarpChain, RefusesPointsThatItWasNotMadeFor) {
    const WarpChain disk = chain({"disk"}, 2);
    EXPECT_EQ(error_of([&] { static_cast<void>(image_of(PointSet(5, 3), disk, {})); }),
              "input: the points have 3 coordinates; the warps take 2");
    EXPECT_EQ(error_of([&] { static_cast<void>(preimage_of(PointSet(5, 3), disk, {})); }),
              "input: the points have 3 coordinates; the warps give 2");
    PointSet once = image_of(points_of({{0.9, 0.5}}), disk, {});
    once.domain = unit_cube(2);  // like a file without provenance
    EXPECT_NE(error_of([&] {
                  static_cast<void>(warp("disk", once));
              }).find("1 of 1 points are outside the unit cube"),
              std::string::npos);
}

TEST(WarpChain, NothingLeavesTheCube) {
    const auto nothing = chain({}, 3);
    EXPECT_EQ(nothing.domain()->spec(), "unit-cube");
    EXPECT_EQ(nothing.forward({0.1, 0.2, 0.3}), (std::vector<double>{0.1, 0.2, 0.3}));
    EXPECT_EQ(nothing.density(std::vector<double>{0.1, 0.2, 0.3}), std::vector<double>{1});
}

TEST(WarpChain, ScramblesKeepCoordinatesInTheCubeForWhatFollows) {
    const std::vector<double> rows = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6};
    const auto alone = chain({"owen"}, 3);
    EXPECT_TRUE(alone.traits().seeded);
    EXPECT_EQ(alone.domain()->spec(), "unit-cube");
    const auto owen = alone.forward(rows);
    const auto both = chain({"owen", "disk@1,2", "digital-shift@3:seed=5"}, 3);
    EXPECT_EQ(both.domain()->spec(), "disk@1,2 x unit-cube@3");
    const auto out = both.forward(rows);
    const auto disk = chain({"disk"}, 2).forward({owen[0], owen[1], owen[3], owen[4]});
    EXPECT_EQ(out[0], disk[0]);
    EXPECT_EQ(out[4], disk[3]);
    EXPECT_EQ(out[2], chain({"digital-shift@3:seed=5"}, 3).forward({0, 0, owen[2]})[2]);
    EXPECT_EQ(both.density(out).size(), 2U);
}

TEST(WarpChain, ScramblesGoByTheSetsSeedOrTheirOwn) {
    const std::vector<double> rows = {0.1, 0.2};
    const Spec plain = parse_spec("owen");
    const Spec own = parse_spec("owen:seed=18446744073709551615");
    const auto image = [&](const Spec& spec, std::uint64_t seed) {
        return WarpChain({&spec, 1}, 2, {.seed = seed, .count = 1}).forward(rows);
    };
    EXPECT_NE(image(plain, 1), image(plain, 2));
    EXPECT_EQ(image(own, 1), image(own, 2));
    EXPECT_EQ(image(own, 1), image(plain, ~std::uint64_t{0}));
    EXPECT_FALSE(WarpChain({&own, 1}, 2).traits().seeded);
    EXPECT_EQ(error_of([] { chain({"owen:seed=-1"}, 2); }),
              "usage: owen: seed '-1' is not a whole number in [0, 2^64)");
    EXPECT_EQ(error_of([&] { static_cast<void>(chain({"owen"}, 2).inverse(rows)); }),
              "usage: --inverse: a scramble is random and has no inverse");
    EXPECT_EQ(
        error_of([] {
            chain({"disk", "owen@1"}, 2);
        }),
        "usage: warp owen: coordinate 1 is already on another domain; it takes coordinates of "
        "the unit cube");
}

// Warns of the first row of a set, independent of threads; for sequences with a point 0, of that.
// Components of a mixture have their own infinite ends.
TEST(WarpChain, TellsOnceOfTheFirstPointThatIsInfinitelyFar) {
    const auto told = [](std::initializer_list<const char*> specs, const PointSet& points) {
        const auto warps = chain(specs, points.dimension());
        std::vector<std::string> notes;
        RunContext run{.threads = 3};
        run.warn = [&](const std::string& note) { notes.push_back(note); };
        for (int again = 0; again < 2; ++again)
            EXPECT_EQ(image_of(points, warps, run).count(), points.count());
        return notes;
    };
    PointSet far = make("random", points(50'000, 2));
    EXPECT_TRUE(told({"normal"}, far).empty());
    far[40'000][1] = far[20'001][0] = far[20'002][1] = 0;
    const std::vector<std::string> first = told({"normal"}, far);
    ASSERT_EQ(first.size(), 1U);
    EXPECT_EQ(
        first[0],
        "point 20001 has a coordinate 0 or 1, which normal maps to infinity; a value far in the "
        "tail replaces it; leave such points out (generate --start 1) or scramble them");
    EXPECT_TRUE(told({"normal@2"}, far)[0].starts_with("point 20002 has"));
    EXPECT_TRUE(told({"exponential"}, far).empty()) << "0 is 0 there";
    EXPECT_TRUE(told({"disk"}, far).empty());
    far[7][1] = 1;
    EXPECT_TRUE(told({"exponential"}, far)[0].starts_with("point 7 has"));
    PointSet half({0.75, 0.5, 0.5, 0.5}, 2);
    EXPECT_TRUE(told({"normal"}, half).empty());
    EXPECT_TRUE(
        told({"mixture:components=[normal|normal:mean=5]"}, half)[0].starts_with("point 1"));
    // Long options are left out.
    const std::string long_name =
        "mixture:components=[normal:mean=1.5,deviation=2.5|normal:mean=5.5,deviation=3.5 4.5]";
    EXPECT_THAT(told({long_name.c_str()}, half)[0],
                ::testing::HasSubstr("which mixture maps to infinity"));
}

}  // namespace stipple::testing::chain_test
