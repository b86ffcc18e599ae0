// SPDX-License-Identifier: MIT
#include "generators/poisson_disk/varying/varied_disks.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/rng.hpp"
#include "generators/varied_index.hpp"
#include "support/pictures.hpp"
#include "support/spacing.hpp"
#include "support/units.hpp"

namespace stipple::testing::varied_disks_test {
using namespace stipple::poisson_disk;

namespace {

/// Oracle: cells of a field with their radii; 0 where points are not allowed.
struct Radii {
    Space space;
    std::size_t width;
    std::size_t height;
    std::vector<double> values;

    [[nodiscard]] double at(double x, double y) const {
        const auto cell = [&](std::size_t k, double place, std::size_t cells) {
            const double unit = (place - space.box.low[k]) / space.box.extent(k);
            return std::min(cells - 1, static_cast<std::size_t>(unit * static_cast<double>(cells)));
        };
        return values[cell(1, y, height) * width + cell(0, x, width)];
    }
    [[nodiscard]] double least() const {
        double least = std::numeric_limits<double>::infinity();
        for (const double r : values)
            if (r > 0) least = std::min(least, r);
        return least;
    }
};

Space space_named(std::vector<double> low, std::vector<double> high, bool torus = true) {
    return {{std::move(low), std::move(high)}, torus};
}

/// Values by a formula of the position in the unit square.
template <class Value>
Radii radii(const Space& space, std::size_t width, std::size_t height, const Value& value) {
    Radii all{space, width, height, {}};
    for (std::size_t j = 0; j < height; ++j)
        for (std::size_t i = 0; i < width; ++i)
            all.values.push_back(
                value((static_cast<double>(i) + 0.5) / static_cast<double>(width),
                      (static_cast<double>(j) + 0.5) / static_cast<double>(height)));
    return all;
}

/// Steps, gentle and steep slopes, holes, single cells; grids finer and coarser than the radii.
std::vector<Radii> some_radii() {
    const Space square = space_named({0, 0}, {1, 1});
    const Space walled = space_named({0, 0}, {1, 1}, false);
    const Space wide = space_named({-7, 3}, {6.3, 4.1});
    const Space thin = space_named({0, 0}, {40, 0.01}, false);
    const Space far = space_named({1e6, -5}, {1e6 + 9, 8});
    const auto hole = [](double x, double y) {
        const double out = std::hypot(x - 0.5, y - 0.5);
        return out < 0.2 ? 0 : 0.03 + 0.2 * out;
    };
    return {radii(square, 1, 1, [](double, double) { return 0.06; }),
            radii(walled, 1, 1, [](double, double) { return 0.06; }),
            radii(square, 2, 1, [](double x, double) { return x < 0.5 ? 0.02 : 0.4; }),
            radii(walled, 3, 5, [](double x, double y) { return 0.03 + 0.3 * x * y; }),
            radii(square, 64, 48, hole),
            radii(walled, 7, 7, hole),
            radii(square, 40, 40, [](double x, double y) { return x + y < 0.6 ? 0.01 : 0.3; }),
            radii(square, 9, 9, [](double x, double y) { return x + y < 0.2 ? 0.02 : 5.0; }),
            radii(square, 20, 20, [](double x, double) { return x < 0.1 ? 0.05 : 0; }),
            radii(wide, 30, 5, [](double x, double y) { return 0.2 + 0.7 * x * (1 - y); }),
            radii(thin, 300, 4, [](double x, double) { return 0.3 + x; }),
            radii(far, 11, 13, [](double x, double y) { return 0.5 + std::abs(x - y); }),
            radii(walled, 6, 6, [](double, double) { return 3.0; }),
            radii(square, 2, 2, [](double x, double y) {
                return x < y ? 1e308 : x > y ? 1e300 : 0.05;
            })};
}

/// Set made by the generator from files.
PointSet make_set(const Radii& field, std::uint64_t seed) {
    std::vector<double> lengths = field.values;
    std::vector<double> open;
    for (double& r : lengths) {
        open.push_back(r > 0);
        if (r == 0) r = 1e-3 * field.least();  // under the mask, so it must have no effect
    }
    const std::string shape = fmt::format("({}, {})", field.height, field.width);
    const TemporaryFile map(npy_of("<f8", shape, lengths));
    const TemporaryFile mask(npy_of("<f8", shape, open));
    return make_in("poisson-disk", field.space, {},
                   {{"radius-map", map.path()}, {"mask", mask.path()}}, seed);
}

double pair_radius(const PointSet& set, std::size_t i, std::size_t j, const Radii& field) {
    return std::min(field.at(set[i][0], set[i][1]), field.at(set[j][0], set[j][1]));
}

/// Minimum distance of two points in units of the smaller of their radii.
double worst_pair(const PointSet& set, const Radii& field) {
    double worst = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            worst = std::min(worst,
                             distance(set[i], set[j], field.space) / pair_radius(set, i, j, field));
    return worst;
}

/// Proves that each position is closer to some point than the smaller of both radii: bisects each
/// cell of the field until one disk covers the part. Gives up at parts of 1e-9 of a side.
class Cover {
  public:
    Cover(const PointSet& set, const Radii& field) : set_(set), field_(field) {}

    bool complete() {
        std::vector<std::size_t> all(set_.count());
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
        const Box& box = field_.space.box;
        const auto line = [&](std::size_t k, std::size_t i, std::size_t cells) {
            return box.low[k] + box.extent(k) * static_cast<double>(i) / static_cast<double>(cells);
        };
        for (std::size_t j = 0; j < field_.height; ++j)
            for (std::size_t i = 0; i < field_.width; ++i) {
                const double r = field_.values[j * field_.width + i];
                if (r > 0 &&
                    !covered({line(0, i, field_.width), line(1, j, field_.height)},
                             {line(0, i + 1, field_.width), line(1, j + 1, field_.height)}, r, all))
                    return false;
            }
        return true;
    }

  private:
    using Corner = std::array<double, 2>;

    bool covered(const Corner& low, const Corner& high, double r,
                 const std::vector<std::size_t>& maybe) {
        std::vector<std::size_t> reaching;
        for (const std::size_t i : maybe) {
            const double disk = std::min(r, field_.at(set_[i][0], set_[i][1]));
            double nearest = 0;
            double farthest = 0;
            for (std::size_t k = 0; k < 2; ++k) {
                const double half = (high[k] - low[k]) / 2;
                const Space& space = field_.space;
                double d = std::abs(set_[i][k] - (low[k] + half));
                if (space.torus) d = std::min(d, space.box.extent(k) - d);
                nearest += std::pow(std::max(0.0, d - half), 2);
                farthest += std::pow(d + half, 2);
            }
            if (farthest < disk * disk) return true;
            if (nearest < disk * disk) reaching.push_back(i);
        }
        const std::size_t k = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
        if (reaching.empty() || high[k] - low[k] < 1e-9 * field_.space.box.extent(k)) return false;
        Corner upper = low;
        Corner lower = high;
        upper[k] = lower[k] = (low[k] + high[k]) / 2;
        return covered(low, lower, r, reaching) && covered(upper, high, r, reaching);
    }

    const PointSet& set_;
    const Radii& field_;
};

/// Points of the generator with these values as --density.
template <class Run = Seeded>
PointSet of_density(const std::string& shape, const std::vector<double>& values,
                    const Request& request, Settings settings, const Run& run = {}) {
    const TemporaryFile file(npy_of("<f8", shape, values));
    settings.emplace_back("density", file.path());
    return make("poisson-disk", request, settings, run);
}

double count_in(const PointSet& set, double x0, double x1, double y0, double y1) {
    double count = 0;
    for (std::size_t i = 0; i < set.count(); ++i)
        count += set[i][0] >= x0 && set[i][0] < x1 && set[i][1] >= y0 && set[i][1] < y1;
    return count;
}

}  // namespace

// Ratios of densities beyond the largest double, and radii whose squares are out of range.
TEST(VariedDisks, KeepTheRuleAtTheEndsOfFloat64) {
    const Space square = space_named({0, 0}, {1, 1});
    const PointSet steep = of_density("(1, 2)", {1, 1e-320}, {}, {{"radius", "0.05"}});
    Radii field{square, 2, 1, {0.05, 5}};
    EXPECT_GE(worst_pair(steep, field), 1);
    EXPECT_TRUE(Cover(steep, field).complete());
    const std::vector<double> radii{0.5, 1, 1, 2};
    const auto made = [&](double unit, const Request& request, Settings settings) {
        std::vector<double> lengths = radii;
        for (double& length : lengths) length *= unit;
        const TemporaryFile map(npy_of("<f8", "(2, 2)", lengths));
        settings.emplace_back("radius-map", map.path());
        return make("poisson-disk", request, settings);
    };
    for (const double unit : {0x1p-600, 0x1p600}) {
        EXPECT_EQ(made(unit, {.count = 60}, {}), made(1, {.count = 60}, {}));
        EXPECT_EQ(made(unit, {}, {{"radius", "0.05"}}), made(1, {}, {{"radius", "0.05"}}));
    }
}

// Cells of thirds and halves give lines at 1/3, 1/2 and 2/3. By hand: 8 is the largest density
// inside the mask, so f = sqrt(8 / density).
TEST(RadiusField, SeesADensityThroughAMaskOfOtherCells) {
    const FieldSource source{.density = DensityMap(2, 1, {2, 8}),
                             .mask = DensityMap(3, 1, {1, 0, 1})};
    const RadiusField field({{0, 0}, {6, 1}}, source, {});
    EXPECT_EQ(field.at(1, 0.5), 2);
    EXPECT_EQ(field.at(2.5, 0.5), RadiusField::closed);
    EXPECT_EQ(field.at(3.5, 0.5), RadiusField::closed);
    EXPECT_EQ(field.at(4, 0), 1);
    EXPECT_EQ(field.at(5.9, 0.99), 1);
    EXPECT_DOUBLE_EQ(field.darts(), 2.0 / 4 + 2);
    EXPECT_EQ(field.least(), 1);
    EXPECT_EQ(field.most(field.root()), 2);
}

// Each node is the union of its children, and has bounds that hold for them.
TEST(RadiusField, NodesHoldWhatTheyJoin) {
    const Radii radii_of = some_radii()[9];
    FieldSource source;
    source.lengths = PlaneValues{radii_of.width, radii_of.height, radii_of.values};
    const RadiusField field(radii_of.space.box, source, {});
    std::vector<RadiusField::Node> nodes{field.root()};
    std::size_t cells = 0;
    double area = 0;
    while (!nodes.empty()) {
        const RadiusField::Node node = nodes.back();
        nodes.pop_back();
        const auto [low, high] = field.corners(node);
        if (node.level == 0) {
            ++cells;
            area += (high[0] - low[0]) * (high[1] - low[1]);
            EXPECT_EQ(field.least(node),
                      radii_of.at((low[0] + high[0]) / 2, (low[1] + high[1]) / 2));
            continue;
        }
        double least = RadiusField::closed;
        double most = 0;
        for (const RadiusField::Node& child : field.children(node)) {
            least = std::min(least, field.least(child));
            most = std::max(most, field.most(child));
            nodes.push_back(child);
        }
        EXPECT_EQ(field.least(node), least);
        EXPECT_EQ(field.most(node), most);
    }
    EXPECT_EQ(cells, radii_of.values.size());
    EXPECT_NEAR(area, 13.3 * 1.1, 1e-9);
}

// Compared with checking all disks one by one, for radii over seven decades.
TEST(VariedIndex, FindsWhatBlocksADisk) {
    for (const bool torus : {true, false}) {
        const BoxSpace space{{{-1, 2}, {2, 3}}, torus};
        VariedIndex index(space, 1e-6, 10);
        const Rng rng(3);
        int blocked = 0;
        for (std::uint64_t i = 0; i < 8000; i += 4) {
            const double size = std::pow(10, -6 + 7 * rng.uniform(i));
            Disk disk{{-1 + 3 * rng.uniform(i + 1), 2 + rng.uniform(i + 2)}, size};
            if (i > 4000)  // near an existing one
                for (std::size_t k = 0; k < 2; ++k)
                    disk.at[k] = std::clamp(index.disks()[i / 8].at[k] + size * (k == 0 ? 1 : 0.5),
                                            space.box.low[k], space.box.high[k]);
            const bool expected = std::ranges::any_of(index.disks(), [&](const Disk& other) {
                return distance(disk.at, other.at, {space.box, torus}) <
                       std::min(disk.radius, other.radius);
            });
            EXPECT_EQ(index.blocks(disk), expected) << i;
            blocked += expected;
            index.add(disk);
        }
        EXPECT_GT(blocked, 300);
        EXPECT_LT(blocked, 1700);
    }
}

TEST(VariedDisks, EveryPairKeepsTheSmallerRadius) {
    for (const Radii& field : some_radii())
        for (const std::uint64_t seed : {1, 2, 3}) {
            const PointSet set = make_set(field, seed);
            EXPECT_GE(worst_pair(set, field), 1) << field.space.name() << field.width;
            expect_inside(set, field.space);
            EXPECT_EQ(noted(set, "radius"), field.least());
        }
}

TEST(VariedDisks, EveryPlaceIsNearerThanTheSmallerRadiusToAPoint) {
    for (const Radii& field : some_radii())
        for (const std::uint64_t seed : {1, 2, 3}) {
            const PointSet set = make_set(field, seed);
            EXPECT_TRUE(Cover(set, field).complete()) << field.space.name() << field.width;
        }
}

// After removing a point the set is not maximal; the oracle of the test above must detect that.
TEST(VariedDisks, ASetWithoutOneOfItsPointsIsNotMaximal) {
    const Radii field = some_radii()[4];
    const PointSet set = make_set(field, 1);
    for (std::size_t gone = 0; gone < set.count(); gone += 10) {
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < set.count(); ++i)
            if (i != gone) rows.push_back({set[i][0], set[i][1]});
        EXPECT_FALSE(Cover(points_of(rows), field).complete()) << gone;
    }
}

TEST(VariedDisks, NoPointLiesWhereTheDensityIsZeroOrTheMaskIs) {
    const PointSet set = of_density("(2, 2)", {0, 1, 2, 0}, points(3000, 2), {});
    EXPECT_EQ(set.count(), 3000);
    EXPECT_EQ(count_in(set, 0, 0.5, 0, 0.5) + count_in(set, 0.5, 1, 0.5, 1), 0);

    const TemporaryFile mask(npy_of("<f8", "(1, 3)", std::vector<double>{1, 0, 0.5}));
    const PointSet kept =
        of_density("(2, 2)", {0, 1, 2, 0}, {}, {{"radius", "0.01"}, {"mask", mask.path()}});
    EXPECT_GT(kept.count(), 1000U);
    EXPECT_EQ(count_in(kept, 1.0 / 3, 2.0 / 3, 0, 1), 0);
    EXPECT_EQ(count_in(kept, 0, 0.5, 0, 0.5) + count_in(kept, 0.5, 1, 0.5, 1), 0);
}

// PNG: the top row of the picture is at the top of the square; inverted, dark pixels are dense.
TEST(VariedDisks, PicturesStandUprightAndInvert) {
    const TemporaryFile file(png_of(1, 2, {255, 0}));
    const Settings settings{{"density", file.path()}, {"radius", "0.02"}};
    const PointSet light = make("poisson-disk", {}, settings);
    EXPECT_GT(light.count(), 500U);
    EXPECT_EQ(count_in(light, 0, 1, 0, 0.5), 0);
    Settings inverted = settings;
    inverted.emplace_back("invert", "true");
    EXPECT_EQ(count_in(make("poisson-disk", {}, inverted), 0, 1, 0.5, 1), 0);
}

// Dart throwing ends at a mean n r^2 of 0.6966; one set of 17'000 points is within 0.003 of that
// (its standard deviation is 0.0014).
TEST(VariedDisks, ConstantDensityHasTheDensityOfTheProcess) {
    for (const std::uint64_t seed : {1, 2, 3}) {
        const PointSet set = of_density("(3, 2)", std::vector<double>(6, 7.5), {},
                                        {{"radius", "0.0064"}}, {.seed = seed});
        EXPECT_NEAR(static_cast<double>(set.count()) * 0.0064 * 0.0064, 0.6966, 0.006) << seed;
    }
}

// Cells with densities 1 : 2 : 4, each with many points. The count in a cell of mean m varies less
// than for random points; it deviates by less than 3 sqrt(m), plus the effect of edges between
// cells: at most one point per eight radii of edge.
TEST(VariedDisks, PointsAreInProportionToTheDensity) {
    const double r = 0.005;
    const std::vector<double> values{1, 4, 2, 1};
    const PointSet set = of_density("(2, 2)", values, {}, {{"radius", format_number(r)}});
    for (std::size_t cell = 0; cell < 4; ++cell) {
        const double x = cell % 2 == 0 ? 0 : 0.5;
        const double y = cell < 2 ? 0 : 0.5;
        const double local = r * std::sqrt(4 / values[cell]);
        const double mean = 0.6966 * 0.25 / (local * local);
        EXPECT_NEAR(count_in(set, x, x + 0.5, y, y + 0.5), mean,
                    3 * std::sqrt(mean) + 2 / local / 8)
            << cell;
    }
}

TEST(VariedDisks, MakesExactlyAsManyAsAskedWithARadiusThatHolds) {
    const std::vector<double> values{1, 0, 3, 0.01, 0.5, 8};
    for (const std::uint64_t n : {1, 2, 3, 7, 64, 1000}) {
        const PointSet set = of_density("(2, 3)", values, points(n, 2), {});
        EXPECT_EQ(set.count(), n);
        Radii field{space_named({0, 0}, {1, 1}), 3, 2, {}};
        for (const double v : values)
            field.values.push_back(v > 0 ? noted(set, "radius") * std::sqrt(8 / v) : 0);
        EXPECT_GE(worst_pair(set, field), 1 - 1e-12) << n;
        EXPECT_TRUE(Cover(set, field).complete()) << n;
    }
    EXPECT_EQ(of_density("(2, 3)", values, {}, {}).count(), 1024);
}

TEST(VariedDisks, AboutSoManyAreWithinTwoPercent) {
    const PointSet set = of_density("(2, 2)", {1, 2, 3, 4}, {}, {{"n-approx", "20000"}});
    EXPECT_NEAR(static_cast<double>(set.count()), 20'000, 400);
}

TEST(VariedDisks, RadiusMapsScaleToALeastRadiusAndToCounts) {
    const TemporaryFile map(npy_of("<f8", "(1, 2)", std::vector<double>{0.02, 0.1}));
    const auto with = [&](Settings settings, Request request = {}) {
        settings.emplace_back("radius-map", map.path());
        return make("poisson-disk", request, settings);
    };
    EXPECT_EQ(noted(with({}), "radius"), 0.02);
    EXPECT_EQ(with({}), with({{"radius", "0.02"}}));
    const PointSet smaller = with({{"radius", "0.01"}});
    const Radii field{space_named({0, 0}, {1, 1}), 2, 1, {0.01, 0.05}};
    EXPECT_GE(worst_pair(smaller, field), 1 - 1e-12);
    EXPECT_TRUE(Cover(smaller, field).complete());
    EXPECT_EQ(with({}, points(500, 2)).count(), 500);
}

TEST(VariedDisks, SeedAloneDecides) {
    const auto with = [](std::uint64_t seed, unsigned threads) {
        return of_density("(2, 2)", {1, 2, 3, 4}, points(500, 2), {},
                          {.seed = seed, .threads = threads});
    };
    EXPECT_EQ(with(1, 1), with(1, 7));
    EXPECT_NE(with(1, 1), with(2, 1));
}

// Every prefix has distances in proportion to the radii: the worst pair of the first m points in
// progressive order is far better than in random order.
TEST(VariedDisks, ProgressivePrefixesAreWellSpread) {
    const std::vector<double> values{1, 25};
    const Radii field{space_named({0, 0}, {1, 1}), 2, 1, {5, 1}};
    const auto first = [&](const char* order, std::size_t m) {
        const PointSet all = of_density("(1, 2)", values, points(2000, 2), {{"order", order}});
        std::vector<std::vector<double>> rows;
        for (std::size_t i = 0; i < m; ++i) rows.push_back({all[i][0], all[i][1]});
        return points_of(rows);
    };
    for (const std::size_t m : {20, 100, 500, 2000}) {
        const double area = (1 + 1.0 / 25) / 2;  // integral of 1 / f^2
        const double best = std::sqrt(area * 0.6966 / static_cast<double>(m));
        EXPECT_GT(worst_pair(first("progressive", m), field), 0.7 * best) << m;
    }
    EXPECT_LT(worst_pair(first("random", 100), field), 0.05);
}

TEST(VariedDisks, OrdersHoldTheSamePoints) {
    const auto sorted = [](const char* order) {
        const PointSet set = of_density("(1, 2)", {1, 25}, points(700, 2), {{"order", order}});
        std::vector<std::pair<double, double>> rows;
        for (std::size_t i = 0; i < set.count(); ++i) rows.emplace_back(set[i][0], set[i][1]);
        std::ranges::sort(rows);
        return rows;
    };
    EXPECT_EQ(sorted("random"), sorted("progressive"));
}

// First darts are distributed like 1 / r^2 and always fit: of sets with room for a single point, 9
// of 10 are in columns with nine times the density of those between. 400 sets; deviation at most 5
// standard deviations of 0.015 (false alarm 6e-7).
TEST(VariedDisks, DartsFallInProportion) {
    std::vector<double> values;
    for (int i = 0; i < 32 * 32; ++i) values.push_back(i % 2 == 0 ? 1 : 9);
    double dense = 0;
    for (std::uint64_t seed = 1; seed <= 400; ++seed) {
        const PointSet set =
            of_density("(32, 32)", values, {}, {{"radius", "1.4"}}, {.seed = seed});
        EXPECT_EQ(set.count(), 1);
        dense += static_cast<int>(set[0][0] * 32) % 2;
    }
    EXPECT_NEAR(dense / 400, 9.0 / 10, 5 * 0.015);
}

namespace {

/// Half the torus with radius 0.1, where darts are 16 times as dense, half with 0.4.
const Radii halves =
    radii(space_named({0, 0}, {1, 1}), 2, 1, [](double x, double) { return x < 0.5 ? 0.1 : 0.4; });

bool keeps(const std::vector<std::vector<double>>& rows, const std::vector<double>& dart) {
    const double r = halves.at(dart[0], dart[1]);
    return std::ranges::all_of(rows, [&](const std::vector<double>& other) {
        return distance(dart, other, halves.space) >= std::min(r, halves.at(other[0], other[1]));
    });
}

/// Corners of squares of an m x m lattice that no disk covers; those in the dense half are listed
/// 16 times.
std::vector<std::array<double, 2>> open_squares(const std::vector<std::vector<double>>& rows,
                                                std::size_t m) {
    std::vector<std::array<double, 2>> open;
    const double side = 1 / static_cast<double>(m);
    for (std::size_t i = 0; i < m * m; ++i) {
        const double x = static_cast<double>(i % m) * side;
        const double y = static_cast<double>(i / m) * side;
        const double r = halves.at(x + side / 2, y + side / 2);
        const std::vector<double> middle{x + side / 2, y + side / 2};
        const bool covered = std::ranges::any_of(rows, [&](const std::vector<double>& other) {
            return distance(middle, other, halves.space) + side * std::sqrt(0.5) <
                   std::min(r, halves.at(other[0], other[1]));
        });
        if (!covered) open.insert(open.end(), r < 0.2 ? 16 : 1, {x, y});
    }
    return open;
}

/// Oracle: darts one by one; at first anywhere, and in uncovered squares once most are covered.
PointSet thrown(std::uint64_t seed, bool to_the_end) {
    const Rng rng(seed, 5);
    std::vector<std::vector<double>> rows;
    std::uint64_t used = 0;
    for (const std::size_t m : {2, 32, 128}) {
        const double side = 1 / static_cast<double>(m);
        const auto open = open_squares(rows, m);
        for (int i = 0; i < 3000 && !open.empty(); ++i, used += 3) {
            const auto& corner = open[rng.below(used, open.size())];
            const std::vector<double> dart{corner[0] + rng.uniform(used + 1) * side,
                                           corner[1] + rng.uniform(used + 2) * side};
            if (keeps(rows, dart)) rows.push_back(dart);
        }
        if (!to_the_end) break;
    }
    return points_of(rows);
}

/// Number of points, of those in the dense half, and of pairs less than 1.1 of the smaller radius
/// apart.
std::array<double, 3> measures(const PointSet& set) {
    double near = 0;
    for (std::size_t i = 0; i < set.count(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            near += distance(set[i], set[j], halves.space) < 1.1 * pair_radius(set, i, j, halves);
    return {static_cast<double>(set.count()), count_in(set, 0, 0.5, 0, 1), near};
}

/// Largest difference between mean statistics of 200 sets each, in standard deviations.
template <class One, class Other>
double difference(const One& one, const Other& other) {
    constexpr double sets = 200;
    double largest = 0;
    std::array<double, 3> sums{};
    std::array<double, 3> squares{};
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        const auto a = measures(one(seed));
        const auto b = measures(other(seed));
        for (std::size_t k = 0; k < 3; ++k) {
            sums[k] += a[k] - b[k];
            squares[k] += (a[k] - b[k]) * (a[k] - b[k]);
        }
    }
    for (std::size_t k = 0; k < 3; ++k) {
        const double mean = sums[k] / sets;
        const double error = std::sqrt((squares[k] / sets - mean * mean) / sets);
        largest = std::max(largest, std::abs(mean) / error);
    }
    return largest;
}

}  // namespace

// Differences of more than 5 standard deviations have a probability of at most 2e-6. Sets of plain
// darts that stop early are detected.
TEST(VariedDisks, IsTheProcessOfPlainDartThrowing) {
    const auto ours = [](std::uint64_t seed) { return make_set(halves, seed); };
    const auto plain = [](std::uint64_t seed) { return thrown(seed, true); };
    const auto early = [](std::uint64_t seed) { return thrown(seed, false); };
    EXPECT_LT(difference(ours, plain), 5);
    EXPECT_GT(difference(ours, early), 5);
}

TEST(VariedDisks, RefusesContradictionsAndBadFiles) {
    const TemporaryFile good(npy_of("<f8", "(1, 2)", std::vector<double>{1, 2}));
    const TemporaryFile zeros(npy_of("<f8", "(1, 2)", std::vector<double>{0, 0}));
    const TemporaryFile left(npy_of("<f8", "(1, 2)", std::vector<double>{1, 0}));
    const TemporaryFile right(npy_of("<f8", "(1, 2)", std::vector<double>{0, 1}));
    const TemporaryFile none(npy_of("<f8", "(1, 2)", std::vector<double>{1, 0}));
    const TemporaryFile nan(npy_of("<f8", "(1, 2)", std::vector<double>{1, std::nan("")}));
    const TemporaryFile flat(npy_of("<f8", "(3)", std::vector<double>{1, 2, 3}));
    const TemporaryFile picture(png_of(1, 2, {255, 0}));
    const TemporaryFile cut(png_of(1, 2, {255, 0}).substr(0, 50));
    const auto refusal = [](const Settings& settings, const Request& request = {}) {
        return error_of([&] { make("poisson-disk", request, settings, {.max_memory = 1 << 28}); });
    };
    const std::string path = good.path();
    EXPECT_EQ(refusal({{"density", path}, {"radius-map", path}}),
              "usage: --radius-map contradicts --density; give one of them");
    EXPECT_EQ(refusal({{"invert", "true"}}), "usage: --invert: there is no --density to invert");
    EXPECT_EQ(refusal({{"mask", path}}, points(10, 3)),
              "usage: --dimension: 3 is not 2, the dimension of a --mask");
    EXPECT_EQ(refusal({{"density", path}, {"radius", "1.5"}}).substr(0, 6), "usage:");
    EXPECT_EQ(refusal({{"density", zeros.path()}}).substr(0, 6), "input:");
    EXPECT_EQ(refusal({{"mask", zeros.path()}}).substr(0, 6), "input:");
    EXPECT_EQ(refusal({{"density", left.path()}, {"mask", right.path()}}),
              "input: --mask: the density is 0 everywhere in it; no point can be placed");
    EXPECT_EQ(
        refusal({{"radius-map", none.path()}}),
        "input: " + none.path() + ": value 0 in row 0, column 1; expected finite lengths above 0");
    EXPECT_EQ(refusal({{"radius-map", nan.path()}}).substr(0, 6), "input:");
    EXPECT_EQ(refusal({{"radius-map", flat.path()}}).substr(0, 6), "input:");
    EXPECT_EQ(refusal({{"radius-map", picture.path()}}),
              "input: " + picture.path() + ": not an NPY array; expected an NPY array of lengths");
    EXPECT_EQ(refusal({{"density", cut.path()}}).substr(0, 6), "input:");
    EXPECT_EQ(refusal({{"density", path + ".missing"}}).substr(0, 3), "io:");
    EXPECT_EQ(refusal({{"density", path}, {"radius", "1e-5"}}).substr(0, 6), "limit:");
    EXPECT_EQ(refusal({{"density", path}, {"radius", "1e-300"}}).substr(0, 6), "limit:");
}

TEST(VariedDisks, ProgressRisesToTheEndAndAStopIsHeeded) {
    double last = 0;
    RunContext run;
    run.progress = [&](double fraction) {
        EXPECT_GE(fraction, last);
        last = fraction;
    };
    of_density("(1, 2)", {1, 2}, {}, {{"radius", "0.01"}}, run);
    EXPECT_EQ(last, 1);

    std::stop_source source;
    run = {.stop = source.get_token()};
    run.progress = [&](double) { source.request_stop(); };
    EXPECT_EQ(error_of([&] {
                  of_density("(1, 2)", {1, 2}, {}, {{"radius", "0.0003"}}, run);
              }),
              "cancelled: interrupted");
}

}  // namespace stipple::testing::varied_disks_test
