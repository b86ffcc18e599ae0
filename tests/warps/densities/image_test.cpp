// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/chain.hpp"
#include "support/pictures.hpp"
#include "support/warping.hpp"

namespace stipple::testing::image_test {
namespace {

/// An array of values as a file; the first row is at y = 0.
TemporaryFile array_of(std::size_t width, std::size_t height, const std::vector<double>& values) {
    return TemporaryFile(npy_of<double>("<f8", fmt::format("({}, {})", height, width), values));
}

std::unique_ptr<Mapping> image_of(const TemporaryFile& file) {
    return mapping("image:file=" + file.path());
}

std::unique_ptr<Mapping> bilinear(const TemporaryFile& file) {
    return mapping("image:interpolation=bilinear,file=" + file.path());
}

/// 9 x 11 pixels, some of them empty, including a row and a column.
std::vector<double> spotty() {
    std::vector<double> values(99);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = i % 5 == 0 || i / 9 == 4 || i % 9 == 8 ? 0 : 0.2 + Rng(3).uniform(i);
    return values;
}

/// Chi-square over pixels of positive mass, for images of random points; infinite if one is on an
/// empty pixel.
double statistic_of(const Mapping& map, const std::vector<double>& values, std::size_t width) {
    const std::size_t height = values.size() / width;
    const PointSet image = warped(map, make("random", points(100'000, 2)));
    std::vector<double> found(values.size());
    for (std::size_t i = 0; i < image.count(); ++i)
        ++found[static_cast<std::size_t>(image[i][1] * static_cast<double>(height)) * width +
                static_cast<std::size_t>(image[i][0] * static_cast<double>(width))];
    double total = 0;
    for (const double value : values) total += value;
    double statistic = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double expected = 1e5 * values[i] / total;
        if (expected == 0 && found[i] > 0) return INFINITY;
        if (expected > 0) statistic += (found[i] - expected) * (found[i] - expected) / expected;
    }
    return statistic;
}

}  // namespace

// Row sums 4 and 4: half of the mass is below 1/2. In the lower row, 3/4 of it is left of 1/2.
TEST(Image, PointsByHand) {
    const auto file = array_of(2, 2, {3, 1, 0, 4});
    const auto map = image_of(file);
    std::vector<double> image(8);
    map->forward(std::vector{0.0, 0.0, 0.5, 0.25, 0.75, 0.25, 0.5, 0.75}, image, {});
    EXPECT_EQ(image, (std::vector<double>{0, 0, 1 / 3.0, 0.25, 0.5, 0.25, 0.75, 0.75}));
    EXPECT_EQ(map->density(std::vector{0.1, 0.1}), 1.5);
    EXPECT_EQ(map->density(std::vector{0.1, 0.9}), 0);
    EXPECT_EQ(map->density(std::vector{1.0, 1.0}), 2);
    EXPECT_EQ(map->density(std::vector{1.1, 0.5}), 0);
}

TEST(Image, PictureStandsUprightAndInverts) {
    const TemporaryFile file(png_of(2, 2, {255, 0, 0, 0}));  // bright at the upper left
    const auto light = mapping("image:file=" + file.path());
    EXPECT_EQ(light->density(std::vector{0.25, 0.75}), 4);
    const auto ink = mapping("image:invert,file=" + file.path());
    EXPECT_EQ(ink->density(std::vector{0.25, 0.75}), 0);
    EXPECT_DOUBLE_EQ(ink->density(std::vector{0.75, 0.75}), 4 / 3.0);
    const TemporaryFile floats(pfm_of("Pf", 2, 2, {0, 0, 1, 0}, true));
    EXPECT_EQ(mapping("image:file=" + floats.path())->density(std::vector{0.25, 0.75}), 4);
}

TEST(Image, RoundTripOverTheWholeSquare) {
    expect_round_trip(*image_of(array_of(9, 11, spotty())), 1e-14);
    expect_round_trip(*image_of(array_of(1, 1, {5})), 1e-15);
    expect_round_trip(*image_of(array_of(1, 7, {0, 0, 1, 2, 3, 0, 0})), 1e-14);
}

// If the density is small, a step of xi is a large step of x; so xi is compared.
TEST(Image, UnitCoordinatesComeBack) {
    std::vector<double> values(64 * 64);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = std::pow(10, -9 * Rng(8).uniform(i));
    const auto map = image_of(array_of(64, 64, values));
    const PointSet cube = telling_points();
    PointSet image(cube.count(), 2), back(cube.count(), 2);
    map->forward(cube.flat(), image.flat(), {});
    map->inverse(image.flat(), back.flat());
    for (std::size_t i = 0; i < cube.flat().size(); ++i)
        ASSERT_NEAR(back.flat()[i], cube.flat()[i], 1e-14) << i;
}

// 71 pixels are not empty: the statistic has mean 70 and standard deviation 12, and exceeds 160
// with probability 5e-9. The same picture rotated by 180 degrees gives tens of thousands, or points
// on empty pixels.
TEST(Image, PointsFollowThePictureAndNoneIsWhereItIsEmpty) {
    const auto values = spotty();
    const double right = statistic_of(*image_of(array_of(9, 11, values)), values, 9);
    EXPECT_LT(right, 160);
    EXPECT_GT(right, 20);
    const std::vector<double> turned(values.rbegin(), values.rend());
    EXPECT_GT(statistic_of(*image_of(array_of(9, 11, turned)), values, 9), 1000);
    auto tilted = values;  // tilted by 10 %
    for (std::size_t i = 0; i < tilted.size(); ++i)
        tilted[i] *= 1 + 0.1 * static_cast<double>(i % 9) / 4;
    EXPECT_GT(statistic_of(*image_of(array_of(9, 11, tilted)), values, 9), 160);
}

// The conditional is p(x, y) / p(y): in each row, xi1 alone determines x.
TEST(Image, EachRowHasItsOwnConditional) {
    const auto map = image_of(array_of(2, 2, {1, 0, 1, 1}));
    std::vector<double> image(4);
    map->forward(std::vector{0.5, 1 / 6.0, 0.5, 2 / 3.0}, image, {});
    EXPECT_EQ(image, (std::vector{0.25, 0.25, 0.5, 0.75}));
}

TEST(Image, DensityIntegratesToOneAndIsTheStretch) {
    const auto map = image_of(array_of(9, 11, spotty()));
    double sum = 0;
    for (int j = 0; j < 11; ++j)
        for (int i = 0; i < 9; ++i)
            sum += map->density(std::vector{(i + 0.5) / 9, (j + 0.5) / 11}) / 99;
    EXPECT_NEAR(sum, 1, 1e-14);
    const double h = 1e-7;
    for (std::uint64_t i = 0; i < 300; ++i) {
        const double u = Rng(2).uniform(2 * i);
        const double v = Rng(2).uniform(2 * i + 1);
        std::vector<double> image(6);
        map->forward(std::vector{u, v, u + h, v, u, v + h}, image, {});
        const std::span<const double> at(image);
        const double p = map->density(at.first(2));
        if (map->density(at.subspan(2, 2)) != p || map->density(at.last(2)) != p) continue;
        EXPECT_NEAR((image[2] - image[0]) * (image[5] - image[1]) * p / (h * h), 1, 1e-6) << i;
    }
}

// Values 1 and 3 at the pixel centres 1/4 and 3/4: p = 1/2 up to 1/4, then linear to 3/2 at 3/4,
// for all y. P(x < 1/4) = 1/8, P(x < 1/2) = 5/16, P(x < 3/4) = 5/8.
TEST(BilinearImage, ByHand) {
    const auto map = bilinear(array_of(2, 1, {1, 3}));
    std::vector<double> image(8);
    map->forward(std::vector{1 / 16.0, 0.25, 1 / 8.0, 0.5, 5 / 16.0, 0.75, 13 / 16.0, 0.1}, image,
                 {});
    const std::vector<double> wanted{0.125, 0.25, 0.25, 0.5, 0.5, 0.75, 0.875, 0.1};
    for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR(image[i], wanted[i], 1e-15) << i;
    EXPECT_EQ(map->density(std::vector{0.1, 0.9}), 0.5);
    EXPECT_EQ(map->density(std::vector{0.5, 0.1}), 1);
    EXPECT_EQ(map->density(std::vector{1.0, 1.0}), 1.5);
    EXPECT_EQ(map->density(std::vector{1.5, 0.5}), 0);
    EXPECT_NEAR(map->domain()->box_mass({{-1, 0.25}, {0.5, 0.75}})->value, 5 / 32.0, 1e-15);
}

TEST(BilinearImage, RoundTripOverTheWholeSquare) {
    expect_round_trip(*bilinear(array_of(9, 11, spotty())), 1e-7);
    expect_round_trip(*bilinear(array_of(1, 1, {5})), 1e-15);
    expect_round_trip(*bilinear(array_of(3, 1, {1, 2, 4})), 1e-14);
}

// Cells of the domain's cube have their volume as probability: 16 x 16 of them, so the statistic
// has mean 255 and standard deviation 22.6, and exceeds 390 with probability 1e-7. Constant pixels
// are another distribution, and fail.
TEST(BilinearImage, PointsFollowTheDensity) {
    const auto values = spotty();
    const auto map = bilinear(array_of(9, 11, values));
    const auto statistic = [&](const Mapping& from) {
        const PointSet image = warped(from, make("random", points(100'000, 2)));
        std::vector<double> found(256);
        for (std::size_t i = 0; i < image.count(); ++i) {
            const auto cube = inverse_of(*map, {image[i][0], image[i][1]});
            ++found[static_cast<std::size_t>(std::min(cube[0], 1 - 1e-16) * 16) * 16 +
                    static_cast<std::size_t>(std::min(cube[1], 1 - 1e-16) * 16)];
        }
        double sum = 0;
        for (const double n : found) sum += (n - 1e5 / 256) * (n - 1e5 / 256) / (1e5 / 256);
        return sum;
    };
    EXPECT_LT(statistic(*map), 390);
    EXPECT_GT(statistic(*image_of(array_of(9, 11, values))), 1000);
}

// The density by its definition at nodes and between; its integrals over boxes by the midpoint rule
// on cells inside single patches (36 = 4 x 9 and 44 = 4 x 11), which is exact for bilinear
// functions.
TEST(BilinearImage, DensityAndMassesAreThoseOfTheDefinition) {
    const auto values = spotty();
    const auto map = bilinear(array_of(9, 11, values));
    const auto at = [&](int i, int j) {
        return values[static_cast<std::size_t>(std::clamp(j, 0, 10) * 9 + std::clamp(i, 0, 8))];
    };
    const auto value = [&](double x, double y) {
        const double s = 9 * x - 0.5;
        const double t = 11 * y - 0.5;
        const int i = static_cast<int>(std::floor(s));
        const int j = static_cast<int>(std::floor(t));
        return (1 - (t - j)) * ((1 - (s - i)) * at(i, j) + (s - i) * at(i + 1, j)) +
               (t - j) * ((1 - (s - i)) * at(i, j + 1) + (s - i) * at(i + 1, j + 1));
    };
    double total = 0;
    double quarter = 0;
    for (int i = 0; i < 36; ++i)
        for (int j = 0; j < 44; ++j) {
            const double part = value((i + 0.5) / 36, (j + 0.5) / 44) / (36 * 44);
            total += part;
            if (i < 18 && j >= 11) quarter += part;
        }
    EXPECT_NEAR(map->domain()->box_mass({{0, 0}, {1, 1}})->value, 1, 1e-14);
    EXPECT_NEAR(map->domain()->box_mass({{0, 0.25}, {0.5, 1}})->value, quarter / total, 1e-14);
    for (std::uint64_t i = 0; i < 300; ++i) {
        const std::vector<double> point{Rng(4).uniform(2 * i), Rng(4).uniform(2 * i + 1)};
        EXPECT_NEAR(map->density(point), value(point[0], point[1]) / total, 1e-13);
    }
    EXPECT_TRUE(bilinear(array_of(2, 2, {1, 2, 3, 4}))->domain()->support().whole);
    // Two corners of the square are beyond the centres of empty pixels.
    const Support corners = bilinear(array_of(2, 2, {1, 0, 0, 1}))->domain()->support();
    EXPECT_EQ(corners.measure->value, 0.875);
    const Support gap = bilinear(array_of(1, 4, {1, 0, 0, 1}))->domain()->support();
    EXPECT_FALSE(gap.whole);
    EXPECT_NEAR(gap.measure->value, 0.75, 1e-15);
}

TEST(Image, DomainSaysWhatItIsAndParsesBack) {
    const auto file = array_of(2, 1, {1, 3});
    const DomainPtr domain = mapping("image:invert,file=" + file.path())->domain();
    EXPECT_EQ(domain->spec(), "image:file=" + file.path() + ",invert=true");
    EXPECT_EQ(parse_domain(domain->spec(), 2)->density(std::vector{0.1, 0.5}), 2);
    EXPECT_EQ(domain->measure(), 1);
    EXPECT_TRUE(domain->even());
    EXPECT_TRUE(domain->contains(std::vector{1.0, 1.0}));
    EXPECT_FALSE(domain->contains(std::vector{1.0, std::nan("")}));
}

TEST(Image, RefusesWhatIsNoPictureAndPointsOutside) {
    EXPECT_EQ(error_of([] { mapping("image"); }),
              "usage: --file: no file given; expected a picture (PNG, PFM) or an array (NPY)");
    EXPECT_EQ(error_of([] { mapping("image:file=/nowhere.png"); }),
              "io: /nowhere.png: no such file");
    const auto file = array_of(2, 1, {1, 3});
    EXPECT_EQ(error_of([&] {
                  inverse_of(*image_of(file), {0.5, 1.5});
              }),
              "input: the point (0.5, 1.5) is outside the domain image:file=" + file.path());
    EXPECT_EQ(error_of([&] {
                  const Warp& warp = find_warp("image");
                  const Spec spec = parse_spec("image:file=" + file.path());
                  warp.make(spec.values(warp.options), 2, {.max_memory = 40});
              }),
              "limit: the array " + file.path() +
                  " needs 48 bytes of memory; the limit is 40 "
                  "bytes | raise the limit with --max-memory");
}

}  // namespace stipple::testing::image_test
