// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numeric>
#include <set>

#include "core/rng.hpp"
#include "generators/blue_noise/eliminator.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/temporary_file.hpp"

namespace stipple::testing::sample_elimination_test {
namespace {

constexpr const char* unit = "sample-elimination";
const Space square{{{0, 0}, {1, 1}}, true};

std::string csv_of(const PointSet& set) {
    std::string text;
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t k = 0; k < set.dimension(); ++k)
            text += format_number(set[i][k]) + (k + 1 < set.dimension() ? "," : "\n");
    return text;
}

/// Oracle: the formula in eliminator.hpp, with all weights recomputed after each removal. Sums of
/// multiples of 2^-40 below 2^13 are exact in doubles.
std::vector<std::uint32_t> eliminate_plainly(const PointSet& set, const Space& space, double r_max,
                                             std::size_t kept,
                                             const std::vector<double>& shares = {}) {
    const double share = static_cast<double>(kept) / static_cast<double>(set.count());
    const double least = 0.65 * (1 - share * std::sqrt(share));
    std::vector<bool> alive(set.count(), true);
    const auto weight = [&](std::size_t i) {
        double sum = 0;
        for (std::size_t j = 0; j < set.count(); ++j) {
            if (j == i || !alive[j]) continue;
            const double reach = shares.empty() ? 2 * r_max : r_max * shares[i] + r_max * shares[j];
            const double t = 1 - std::max(distance(set[i], set[j], space) * (1 / reach), least);
            const double t4 = t * t * (t * t);
            if (t > 0) sum += std::floor(t4 * t4 * 0x1p40) * 0x1p-40;
        }
        return sum;
    };
    std::vector<std::uint32_t> gone;
    for (std::size_t left = set.count(); left > kept; --left) {
        double most = -1;
        std::uint32_t heaviest = 0;
        for (std::uint32_t i = 0; i < set.count(); ++i) {
            if (!alive[i]) continue;
            const double w = weight(i);
            if (w <= most) continue;
            most = w;
            heaviest = i;
        }
        alive[heaviest] = false;
        gone.push_back(heaviest);
    }
    return gone;
}

PointSet random_in(const Space& space, std::size_t count, std::uint64_t seed) {
    const std::size_t d = space.box.dimension();
    PointSet set(count, d);
    const Rng rng(seed);
    for (std::size_t i = 0; i < count * d; ++i)
        set.flat()[i] = space.box.low[i % d] + rng.uniform(i) * space.box.extent(i % d);
    return set;
}

}  // namespace

TEST(SampleElimination, GoesAsTheFormulaSaysPointByPoint) {
    for (const Space& space : some_spaces())
        for (const std::size_t kept : {1, 10, 30}) {
            const std::size_t d = space.box.dimension();
            PointSet set = random_in(space, 100, kept);
            // Equal points, points on the faces and in the middle.
            std::copy_n(set[3].begin(), d, set[40].begin());
            std::copy_n(space.box.low.begin(), d, set[50].begin());
            std::copy_n(space.box.high.begin(), d, set[51].begin());
            const BoxSpace box{space.box, space.torus};
            const double r = packing_radius(static_cast<double>(kept), d, volume_of(box.box));
            EXPECT_EQ(eliminate(set.flat(), box, r, kept, {}),
                      eliminate_plainly(set, space, r, kept))
                << space.name() << ", " << kept;
        }
}

// Radii of individual points, from a hundredth to a hundred times the others, also across faces.
TEST(SampleElimination, GoesAsTheFormulaSaysWithRadiiOfTheirOwn) {
    for (const Space& space : some_spaces()) {
        const std::size_t d = space.box.dimension();
        const PointSet set = random_in(space, 100, 7);
        std::vector<double> shares;
        for (std::size_t i = 0; i < 100; ++i)
            shares.push_back(i == 50  ? 100
                             : i < 50 ? 0.3 + Rng(3).uniform(i)
                                      : std::pow(10.0, -2 * Rng(4).uniform(i)));
        const BoxSpace box{space.box, space.torus};
        const double r = packing_radius(20, d, volume_of(box.box));
        // A radius larger than the box counts as its largest distance.
        std::vector<double> cut = shares;
        for (double& share : cut) share = std::min(share, box.largest_distance() / r);
        EXPECT_EQ(eliminate(set.flat(), box, r, 20, {}, shares),
                  eliminate_plainly(set, space, r, 20, cut))
            << space.name();
        const std::vector<double> even(100, 1.0);
        EXPECT_EQ(eliminate(set.flat(), box, r, 20, {}, even),
                  eliminate(set.flat(), box, r, 20, {}))
            << space.name();
    }
}

// On a lattice all weights are equal, and the first point is removed; also with two points.
TEST(SampleElimination, OfEqualWeightsTheFirstGoes) {
    std::vector<std::vector<double>> rows;
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) rows.push_back({i / 8.0, j / 8.0});
    const PointSet lattice = points_of(rows);
    const BoxSpace torus{square.box, true};
    const auto gone = eliminate(lattice.flat(), torus, 0.11, 60, {});
    EXPECT_EQ(gone.front(), 0U);
    EXPECT_EQ(gone, eliminate_plainly(lattice, square, 0.11, 60));
    const PointSet same = points_of({{0.5, 0.5}, {0.5, 0.5}, {0.5, 0.5}});
    EXPECT_EQ(eliminate(same.flat(), torus, 0.1, 1, {}), (std::vector<std::uint32_t>{0, 1}));
}

// Densest packings: 2 r = 1/n on the circle of length 1; hexagonal; face-centred cubic, with four
// points per cube, sqrt(1/2) apart. The ball's volume is pi^2 / 2 in 4-D and pi^3 / 6 in 6-D.
TEST(SampleElimination, PackingRadiusByHand) {
    EXPECT_DOUBLE_EQ(packing_radius(10, 1, 1), 0.05);
    EXPECT_DOUBLE_EQ(packing_radius(2, 2, 2 * std::sqrt(3.0)), std::sqrt(0.5));
    EXPECT_DOUBLE_EQ(packing_radius(4, 3, 1), std::sqrt(0.5) / 2);
    EXPECT_DOUBLE_EQ(packing_radius(1, 4, std::acos(-1) * std::acos(-1) / 2), 1);
    EXPECT_DOUBLE_EQ(packing_radius(1, 5, 8 * std::acos(-1) * std::acos(-1) / 15), 1);
    EXPECT_DOUBLE_EQ(packing_radius(64, 6, std::pow(std::acos(-1), 3) / 6), 0.5);
}

TEST(SampleElimination, MakesExactlyAsManyAsAskedInAnyBox) {
    for (const Space& space : some_spaces())
        for (const std::uint64_t n : {1, 2, 3, 50})
            for (const char* order : {"random", "progressive"}) {
                const PointSet set = make_in(unit, space, n, {{"order", order}});
                EXPECT_EQ(set.count(), n) << space.name();
                expect_inside(set, space);
            }
}

// The remaining points are a subset of the random points, in their order, with a relative radius of
// about 0.7 or more; random points have less than 0.02 at this count.
TEST(SampleElimination, KeepsRandomPointsThatAreFarApart) {
    for (const std::size_t d : {1, 2, 3}) {
        const Space cube{{std::vector<double>(d, 0), std::vector<double>(d, 1)}, true};
        const PointSet all = make(unit, points(2500, d), {{"ratio", "1"}});
        const PointSet left = make(unit, points(500, d));
        std::size_t at = 0;
        for (std::size_t i = 0; i < left.count(); ++i, ++at)
            while (at < all.count() && !std::ranges::equal(all[at], left[i])) ++at;
        EXPECT_LE(at, all.count());
        EXPECT_GT(smallest_distance(left, cube), 2 * 0.6 * packing_radius(500, d, 1)) << d;
    }
}

TEST(SampleElimination, LargerRatiosSpreadBetter) {
    const auto mean_nearest = [](const char* ratio) {
        const PointSet set = make(unit, points(400, 2), {{"ratio", ratio}});
        double sum = 0;
        for (std::size_t i = 0; i < set.count(); ++i) {
            double least = 9;
            for (std::size_t j = 0; j < set.count(); ++j)
                if (j != i) least = std::min(least, distance(set[i], set[j], square));
            sum += least;
        }
        return sum;
    };
    EXPECT_GT(mean_nearest("3"), 1.2 * mean_nearest("1"));
    EXPECT_GT(mean_nearest("15"), 1.01 * mean_nearest("3"));
}

TEST(SampleElimination, ProgressivePrefixesAreSpread) {
    const PointSet plain = make(unit, points(512, 2));
    const PointSet set = make(unit, points(512, 2), {{"order", "progressive"}});
    const auto sorted = [](const PointSet& s) {
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < s.count(); ++i) rows.emplace_back(s[i].begin(), s[i].end());
        std::ranges::sort(rows);
        return rows;
    };
    EXPECT_EQ(sorted(set), sorted(plain));
    // Prefixes after whole halvings have more than half of the largest distance, others more than
    // 0.35; the plain order fails 0.35 by far.
    for (const std::size_t n : {8, 16, 24, 32, 64, 100, 128, 200, 256, 400}) {
        const auto prefix = [&](const PointSet& s) {
            return PointSet(
                std::vector<double>(s.flat().begin(), s.flat().begin() + static_cast<long>(2 * n)),
                2);
        };
        const double most = 2 * packing_radius(static_cast<double>(n), 2, 1);
        const bool halving = (n & (n - 1)) == 0;
        EXPECT_GT(smallest_distance(prefix(set), square), (halving ? 0.5 : 0.35) * most) << n;
        if (n > 64) continue;
        EXPECT_LT(smallest_distance(prefix(plain), square), 0.35 * most) << n;
    }
}

TEST(SampleElimination, DependsOnTheSeedAloneNotOnThreads) {
    const auto with = [](std::uint64_t seed, unsigned threads) {
        return make(unit, points(3000, 2), {{"order", "progressive"}},
                    {.seed = seed, .threads = threads});
    };
    EXPECT_EQ(with(1, 1), with(1, 7));
    EXPECT_NE(with(1, 1), with(2, 1));
}

TEST(SampleElimination, TorusSpreadsAcrossTheFaces) {
    const PointSet closed = make(unit, points(300, 2));
    const PointSet open = make(unit, points(300, 2), {{"bounded", "true"}});
    const double most = 2 * packing_radius(300, 2, 1);
    EXPECT_GT(smallest_distance(closed, square), 0.6 * most);
    EXPECT_GT(smallest_distance(open, {square.box, false}), 0.5 * most);
    EXPECT_LT(smallest_distance(open, square), 0.4 * most);
}

// Points of a file in its own box give the same as those points in memory.
TEST(SampleElimination, ChoosesFromTheSpecifiedFile) {
    const Space space{{{-3, 10}, {4, 12}}, false};
    const PointSet all = random_in(space, 300, 8);
    const TemporaryFile file(csv_of(all));
    for (const bool torus : {false, true}) {
        Request request{.count = 60};
        request.bounds = space.box;
        Settings settings{{"from", file.path()}};
        if (torus) settings.emplace_back("torus", "true");
        const PointSet left = make(unit, request, settings);
        const BoxSpace box{space.box, torus};
        auto gone = eliminate(all.flat(), box, packing_radius(60, 2, 14), 60, {});
        std::ranges::sort(gone);
        std::vector<double> rows;
        for (std::uint32_t i = 0; i < 300; ++i)
            if (!std::ranges::binary_search(gone, i))
                rows.insert(rows.end(), all[i].begin(), all[i].end());
        EXPECT_EQ(left, PointSet(rows, 2));
        EXPECT_EQ(left.domain->spec(), box_domain(space.box)->spec());
    }
    EXPECT_EQ(make(unit, {}, {{"from", file.path()}}).count(), 60U);  // a fifth by default
    EXPECT_EQ(make(unit, points(300, 2), {{"from", file.path()}}), all);
}

// A table's density column is not a coordinate; other formats of stipple contain the same points.
TEST(SampleElimination, ReadsPointsInEveryFormat) {
    const PointSet all = random_in(square, 40, 8);
    std::string with_pdf = "x,y,pdf\n";
    std::string json = R"({"format":"stipple.points","version":1,"points":[)";
    for (std::size_t i = 0; i < all.count(); ++i) {
        const std::string x = format_number(all[i][0]);
        const std::string y = format_number(all[i][1]);
        with_pdf += x + "," + y + ",2.5\n";
        json += (i > 0 ? ",[" : "[") + x + "," + y + "]";
    }
    json += R"(],"dimension":2,"count":40})";
    std::string header = "{'descr': '<f8', 'fortran_order': False, 'shape': (40, 2), }";
    header.resize(117, ' ');
    const std::string npy = std::string("\x93NUMPY\x01\x00\x76\x00", 10) + header + "\n" +
                            std::string(reinterpret_cast<const char*>(all.flat().data()), 640);
    const TemporaryFile plain(csv_of(all));
    const PointSet expected = make(unit, {.count = 9}, {{"from", plain.path()}});
    EXPECT_EQ(expected.dimension(), 2U);
    for (const auto& [bytes, extension] :
         {std::pair{with_pdf, ".csv"}, {json, ".json"}, {npy, ".npy"}}) {
        const TemporaryFile file(bytes, extension);
        EXPECT_EQ(make(unit, {.count = 9}, {{"from", file.path()}}), expected) << extension;
    }
}

TEST(SampleElimination, RefusesSeveralSetsAndStandardInput) {
    const TemporaryFile two("0.1 0.2\n0.3 0.4\n#\n0.5 0.6\n");
    for (const char* generator : {unit, "lloyd"}) {
        EXPECT_EQ(error_of([&] {
                      make(generator, {}, {{"from", two.path()}});
                  }),
                  "input: " + two.path() + ": 2 sets of points; expected one");
        EXPECT_EQ(error_of([&] {
                      make(generator, {}, {{"from", "-"}});
                  }),
                  "usage: --from: standard input cannot be read again; give a file");
    }
}

// Reduces 2000 points on the unit sphere to 200: r_max belongs to the surface, not to the cube
// around it.
TEST(SampleElimination, SpreadsPointsOfASurface) {
    const Rng rng(3);
    PointSet sphere(2000, 3);
    for (std::size_t i = 0; i < sphere.count(); ++i) {
        const double z = 2 * rng.uniform(2 * i) - 1;
        const double angle = 6.283185307179586 * rng.uniform(2 * i + 1);
        const double across = std::sqrt(1 - z * z);
        sphere[i][0] = across * std::cos(angle);
        sphere[i][1] = across * std::sin(angle);
        sphere[i][2] = z;
    }
    const TemporaryFile file(csv_of(sphere));
    const auto spread = [&](Settings settings) {
        settings.emplace_back("from", file.path());
        const PointSet set = make(unit, {.count = 200}, settings);
        return smallest_distance(set, {{{-1, -1, -1}, {1, 1, 1}}, false});
    };
    const double area = 12.566370614359172;
    const double good = spread({{"manifold-dimension", "2"}, {"measure", "12.566370614359172"}});
    EXPECT_GT(good, 0.65 * 2 * packing_radius(200, 2, area));
    EXPECT_GT(good, spread({{"manifold-dimension", "2"}, {"measure", "0.1"}}));
    // The sphere's area is also found without an option.
    EXPECT_GT(spread({}), 0.6 * 2 * packing_radius(200, 2, area));
    EXPECT_GT(spread({{"manifold-dimension", "2"}}), 0.6 * 2 * packing_radius(200, 2, area));
}

// Estimates the measure of the region that points fill, in its own dimension, from random and
// jittered points.
TEST(SampleElimination, FindsWhatPointsFill) {
    const Rng rng(5);
    const auto expect = [&](const PointSet& set, std::size_t d, double truth, double share) {
        const CrowdExtent found = crowd_extent(set.flat(), set.dimension(), 0, {});
        EXPECT_EQ(found.dimension, d);
        EXPECT_NEAR(found.measure, truth, share * truth);
    };
    for (const std::size_t n : {400, 3000, 100'000}) {
        PointSet disk(n, 2);
        PointSet jittered(n, 2);
        PointSet line(n, 3);
        for (std::size_t i = 0; i < n; ++i) {
            const double angle = 6.283185307179586 * rng.uniform(2 * i);
            const double radius = std::sqrt(rng.uniform(2 * i + 1));
            disk[i][0] = radius * std::cos(angle);
            disk[i][1] = radius * std::sin(angle);
            const auto side = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)));
            jittered[i][0] = (static_cast<double>(i % side) + rng.uniform(2 * i)) / 10;
            jittered[i][1] = (static_cast<double>(i / side) + rng.uniform(2 * i + 1)) / 10;
            line[i][0] = line[i][1] = line[i][2] = rng.uniform(i);
        }
        expect(disk, 2, 3.141592653589793, 0.1);
        expect(jittered, 2, static_cast<double>(n) / 100, 0.1);
        expect(line, 1, std::sqrt(3.0), 0.1);
    }
    EXPECT_EQ(crowd_extent(PointSet(500, 2).flat(), 2, 0, {}).dimension, 0U) << "all in one place";
    EXPECT_EQ(crowd_extent(PointSet(50, 2).flat(), 2, 0, {}).dimension, 0U) << "too few";
}

/// Mean distance to the nearest other point.
double mean_nearest(const PointSet& set) {
    double sum = 0;
    for (std::size_t i = 0; i < set.count(); ++i) {
        double least = 1e300;
        for (std::size_t j = 0; j < set.count(); ++j) {
            double away = 0;
            for (std::size_t k = 0; k < set.dimension(); ++k)
                away += (set[i][k] - set[j][k]) * (set[i][k] - set[j][k]);
            if (j != i) least = std::min(least, away);
        }
        sum += std::sqrt(least);
    }
    return sum / static_cast<double>(set.count());
}

// Points are spread as well as with a known region, at every ratio of counts: on a curve, a surface
// and in a body, for few points and many.
TEST(SampleElimination, FindsTheManifoldAtEveryRatio) {
    constexpr double turn = 6.283185307179586;
    struct Shape {
        const char* name;
        const char* dimension;
        double measure;
        std::function<std::vector<double>(double, double, double)> point;
    };
    const std::vector<Shape> shapes = {
        {"sphere", "2", 2 * turn,
         [](double u, double v, double) {
             const double z = 2 * u - 1;
             const double r = std::sqrt(1 - z * z);
             return std::vector{r * std::cos(turn * v), r * std::sin(turn * v), z};
         }},
        {"circle", "1", turn,
         [](double u, double, double) {
             return std::vector{std::cos(turn * u), std::sin(turn * u)};
         }},
        {"cylinder", "2", 2 * turn,
         [](double u, double v, double) {
             return std::vector{std::cos(turn * u), std::sin(turn * u), 2 * v};
         }},
        {"helix", "1", std::hypot(2 * turn, 3),
         [](double u, double, double) {
             return std::vector{std::cos(2 * turn * u), std::sin(2 * turn * u), 3 * u};
         }},
        {"cube", "3", 1, [](double u, double v, double w) {
             return std::vector{u, v, w};
         }}};
    const Rng rng(8);
    for (const Shape& shape : shapes)
        for (const std::size_t n : {150, 1000}) {
            std::vector<std::vector<double>> rows;
            for (std::size_t i = 0; i < n; ++i)
                rows.push_back(shape.point(rng.uniform(3 * i), rng.uniform(3 * i + 1),
                                           rng.uniform(3 * i + 2)));
            const TemporaryFile file(csv_of(points_of(rows)));
            for (const double ratio : {1.5, 2.0, 5.0, 20.0}) {
                const Request kept{.count =
                                       static_cast<std::uint64_t>(static_cast<double>(n) / ratio)};
                const double found = mean_nearest(make(unit, kept, {{"from", file.path()}}));
                const double told =
                    mean_nearest(make(unit, kept,
                                      {{"from", file.path()},
                                       {"manifold-dimension", shape.dimension},
                                       {"measure", fmt::format("{}", shape.measure)}}));
                EXPECT_GT(found, 0.9 * told) << shape.name << ", " << n << " / " << ratio;
            }
        }
}

// Of equal points all except one are removed before any other.
TEST(SampleElimination, CopiesGoFirst) {
    const PointSet some = random_in(square, 60, 3);
    std::vector<std::vector<double>> rows;
    for (std::size_t i = 0; i < some.count(); ++i)
        for (std::size_t copy = 0; copy <= i % 3; ++copy)
            rows.emplace_back(some[i].begin(), some[i].end());
    const TemporaryFile file(csv_of(points_of(rows)));
    for (const char* order : {"random", "progressive"})
        for (const std::size_t kept : {10U, 59U, 60U, 75U}) {
            const PointSet left =
                make(unit, {.count = kept}, {{"from", file.path()}, {"order", order}});
            std::set<std::vector<double>> different;
            for (std::size_t i = 0; i < left.count(); ++i)
                different.insert({left[i].begin(), left[i].end()});
            EXPECT_EQ(left.count(), kept);
            EXPECT_EQ(different.size(), std::min<std::size_t>(kept, 60)) << order;
        }
}

TEST(SampleElimination, SpreadsPointsOfADisk) {
    const Rng rng(6);
    PointSet disk(3000, 2);
    for (std::size_t i = 0; i < disk.count(); ++i) {
        const double angle = 6.283185307179586 * rng.uniform(2 * i);
        const double radius = std::sqrt(rng.uniform(2 * i + 1));
        disk[i][0] = radius * std::cos(angle);
        disk[i][1] = radius * std::sin(angle);
    }
    const TemporaryFile file(csv_of(disk));
    const double most = 2 * packing_radius(500, 2, 3.141592653589793);
    const auto spread = [&](Settings settings) {
        settings.emplace_back("from", file.path());
        const PointSet set = make(unit, {.count = 500}, settings);
        return smallest_distance(set, {{{-1, -1}, {1, 1}}, false});
    };
    EXPECT_GT(spread({}), 0.62 * most);
    EXPECT_LT(spread({{"measure", "4"}}), 0.2 * most) << "that of the box is too large";
}

// Densities 1 and 4 side by side, and 0 on the right: a fifth and four fifths of the points, with
// half the distance where the density is four times as large. (0.04 would be five standard
// deviations of random points; the denser side keeps a few more at the border.)
TEST(SampleElimination, FollowsADensity) {
    const TemporaryFile density(npy_of<double>("<f8", "(1, 3)", {1, 4, 0}));
    for (const char* order : {"random", "progressive"}) {
        Request request = points(1500, 2);
        request.bounds = Box{{-3, 10}, {6, 12}};
        const PointSet set = make(unit, request, {{"density", density.path()}, {"order", order}});
        ASSERT_EQ(set.count(), 1500U);
        std::array<double, 2> counts{};
        std::array<double, 2> nearest{};
        const Space space{*request.bounds, true};
        for (std::size_t i = 0; i < set.count(); ++i) {
            ASSERT_LT(set[i][0], 3);
            const std::size_t side = set[i][0] < 0 ? 0 : 1;
            ++counts[side];
            double least = 100;
            for (std::size_t j = 0; j < set.count(); ++j)
                if (j != i) least = std::min(least, distance(set[i], set[j], space));
            nearest[side] += least;
        }
        EXPECT_NEAR(counts[1] / 1500, 0.8, 0.04) << order;
        EXPECT_NEAR(nearest[0] / counts[0] / (nearest[1] / counts[1]), 2, 0.2) << order;
        // Nearly as spread as without a density: random points have half the distance.
        const double r = packing_radius(1500 * 0.8, 2, 6);
        EXPECT_GT(nearest[1] / counts[1], 1.5 * r) << order;
    }
}

TEST(SampleElimination, RefusesWhatCannotBe) {
    const TemporaryFile file(csv_of(points_of({{0.1, 0.2}, {0.3, 0.4}, {1.5, 0.5}})));
    const auto refusal = [&](const Request& request, Settings settings) {
        for (auto& [name, value] : settings)
            if (value == "FILE") value = file.path();
        const std::string error =
            error_of([&] { make(unit, request, settings, {.max_memory = 1 << 26}); });
        const auto at = error.find(file.path());
        return at == error.npos
                   ? error
                   : error.substr(0, at) + "FILE" + error.substr(at + file.path().size());
    };
    EXPECT_EQ(refusal(points(4, 2), {{"from", "FILE"}}),
              "usage: --count: 4 points cannot be chosen from the 3 in FILE");
    EXPECT_EQ(refusal(points(2, 3), {{"from", "FILE"}}),
              "usage: --dimension: 3, but FILE has points of 2 coordinates");
    EXPECT_EQ(refusal({}, {{"from", "FILE"}, {"torus", "true"}}),
              "input: FILE: point 2 is outside the box 0..1,0..1; coordinate 1 is 1.5");
    EXPECT_EQ(
        refusal({}, {{"from", "FILE"}, {"ratio", "3"}}),
        "usage: --ratio applies to random points only; --from chooses from all points of the file");
    EXPECT_EQ(
        refusal({}, {{"measure", "3"}}),
        "usage: --manifold-dimension and --measure apply to points from a file; give --from too");
    EXPECT_EQ(refusal({}, {{"from", "FILE"}, {"manifold-dimension", "1"}}),
              "input: FILE: too few different points to estimate the length, area or volume that "
              "they fill; give --measure");
    EXPECT_NE(refusal({}, {{"from", "FILE"}, {"manifold-dimension", "3"}}), "");
    EXPECT_NE(refusal({}, {{"ratio", "0.5"}}), "");
    EXPECT_EQ(refusal({}, {{"invert", "true"}}),
              "usage: --invert: there is no --density to invert");
    EXPECT_EQ(refusal(points(9, 3), {{"density", "FILE"}}),
              "usage: --dimension: 3 is not 2, the dimension of a --density");
    EXPECT_EQ(refusal({}, {{"density", "FILE"}, {"from", "FILE"}}),
              "usage: --density applies to random points only; the points of --from have a density "
              "already");
    EXPECT_NE(refusal({}, {{"density", "FILE"}}), "");
    EXPECT_NE(refusal({}, {{"torus", "true"}, {"bounded", "true"}}), "");
    EXPECT_EQ(refusal({}, {{"from", "/no/such"}}), "io: /no/such: no such file");
    EXPECT_EQ(refusal(points(10'000'000, 2), {}).substr(0, 6), "limit:");
    const TemporaryFile tiny("0\n1e-170\n3e-170\n");
    EXPECT_EQ(refusal({}, {{"from", tiny.path()}}),
              "input: " + tiny.path() +
                  ": 0..3e-170 has distances whose squares are out of the range of float64");
    const TemporaryFile flat(csv_of(points_of({{1, 1}, {1, 2}, {1, 3}})));
    EXPECT_EQ(refusal({}, {{"from", flat.path()}}),
              "input: the box around the points of " + flat.path() +
                  " has no volume | give --manifold-dimension and --measure");
    EXPECT_EQ(refusal({.count = 2},
                      {{"from", flat.path()}, {"manifold-dimension", "1"}, {"measure", "2"}}),
              "");
}

}  // namespace stipple::testing::sample_elimination_test
