// SPDX-License-Identifier: MIT
#include "media/density_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "support/pictures.hpp"
#include "support/units.hpp"

namespace stipple::testing::density_map_test {
namespace {

std::vector<double> values_of(const DensityMap& map) {
    return {map.values().begin(), map.values().end()};
}

DensityMap density(const std::string& bytes, bool invert = false) {
    return read_density(TemporaryFile(bytes).path(), invert, {});
}

/// Error message, with FILE in place of the file's name.
std::string refused(const std::string& bytes, bool invert = false) {
    const TemporaryFile file(bytes);
    std::string error = error_of([&] { read_density(file.path(), invert, {}); });
    const auto at = error.find(file.path());
    return at == std::string::npos ? error : error.replace(at, file.path().size(), "FILE");
}

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();
constexpr double inf = std::numeric_limits<double>::infinity();

}  // namespace

TEST(DensityMap, IsConstantOnCellsWithMeanOne) {
    const DensityMap map(3, 2, {1, 2, 3, 0, 4, 2});  // mean 2
    EXPECT_EQ(values_of(map), (std::vector<double>{0.5, 1, 1.5, 0, 2, 1}));
    EXPECT_EQ(map.largest(), 2);
    EXPECT_EQ(map.at(0, 0), 0.5);
    EXPECT_EQ(map.at(0.34, 0.49), 1);
    EXPECT_EQ(map.at(0.99, 0.5), 1);
    EXPECT_EQ(map.at(0.33, 0.5), 0);
    EXPECT_EQ(map.at(0.5, 1), 2);  // the closed square
    EXPECT_EQ(map.at(1, 1), 1);
}

TEST(DensityMap, TakesNumbersOfAnySize) {
    EXPECT_EQ(values_of(DensityMap(2, 1, {1.5e308, 1.5e308})), (std::vector<double>{1, 1}));
    EXPECT_EQ(values_of(DensityMap(2, 1, {3e-320, 0})), (std::vector<double>{2, 0}));
}

// The map is piecewise linear, so values are known by hand: half of the mass is below y = 1/3.
TEST(DensityMap, PlacesTheUniformSquare) {
    const DensityMap map(2, 2, {3, 1, 0, 4});
    EXPECT_EQ(map.place(0, 0), (std::array<double, 2>{0, 0}));
    EXPECT_EQ(map.place(0.5, 0.25), (std::array<double, 2>{1 / 3.0, 0.25}));
    EXPECT_EQ(map.place(0.75, 0.25), (std::array<double, 2>{0.5, 0.25}));
    EXPECT_EQ(map.place(0.5, 0.75), (std::array<double, 2>{0.75, 0.75}));
    EXPECT_EQ(map.place(0, 0.5), (std::array<double, 2>{0.5, 0.5}));
}

// Chi-square over 80 cells of positive density; 200 is 11 standard deviations above the mean.
TEST(DensityMap, PlacesPointsInProportionAndNeverWhereItIsZero) {
    std::vector<double> values(9 * 11);
    const Rng shape(3);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = i % 5 == 0 ? 0 : 0.2 + shape.uniform(i);
    const DensityMap map(9, 11, values);
    const std::size_t n = 100'000;
    std::vector<double> found(values.size());
    const Rng rng(4);
    for (std::size_t i = 0; i < n; ++i) {
        const auto [x, y] = map.place(rng.uniform(2 * i), rng.uniform(2 * i + 1));
        ASSERT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1);
        ASSERT_GT(map.at(x, y), 0);
        ++found[static_cast<std::size_t>(y * 11) * 9 + static_cast<std::size_t>(x * 9)];
    }
    double statistic = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const double expected = static_cast<double>(n) * map.values()[i] / 99;
        if (expected > 0) statistic += (found[i] - expected) * (found[i] - expected) / expected;
    }
    EXPECT_LT(statistic, 200);
    EXPECT_GT(statistic, 30);
}

// Rounding must not move points into an empty neighbour, nor out of the square.
TEST(DensityMap, PlacesTheRimOfCellsInsideThem) {
    for (const std::size_t width : {1U, 3U, 49U, 98U, 1000U}) {
        std::vector<double> values(width);
        for (std::size_t i = 0; i < width; i += 2) values[i] = 0.1 * static_cast<double>(i % 7 + 1);
        const DensityMap map(width, 1, values);
        for (std::size_t i = 0; i <= 2 * width; ++i) {
            const double u = std::min(static_cast<double>(i) / (2.0 * static_cast<double>(width)),
                                      one_minus_ulp);
            for (const double v : {0.0, 0.3, one_minus_ulp}) {
                const auto [x, y] = map.place(u, v);
                EXPECT_TRUE(x >= 0 && x < 1 && y >= 0 && y < 1) << width << ": " << u;
                EXPECT_GT(map.at(x, y), 0) << width << ": " << u;
            }
        }
    }
}

// Batches give the same points wherever they are split; sides of 1, and several buckets per row.
TEST(DensityMap, PlacesBatchesAsSinglePoints) {
    for (const auto& [width, height] : {std::pair{1, 1}, {300, 7}, {1, 50}, {5, 200}}) {
        std::vector<double> values(static_cast<std::size_t>(width * height));
        Rng(6).fill(0, values);
        for (double& value : values) value = value < 0.3 ? 0 : std::pow(value, 20);
        values.back() = 1;
        const DensityMap map(static_cast<std::size_t>(width), static_cast<std::size_t>(height),
                             values);
        std::vector<double> cube(2 * 1003);
        Rng(7).fill(0, cube);
        std::vector<double> image(cube.size());
        map.place_all(cube, image);
        for (std::size_t i = 0; i < cube.size(); i += 2)
            EXPECT_EQ(map.place(cube[i], cube[i + 1]), (std::array{image[i], image[i + 1]}));
    }
}

TEST(DensityMap, FindsWhatItPlaced) {
    const DensityMap map(2, 2, {3, 1, 0, 4});
    EXPECT_EQ(map.find(1 / 3.0, 0.25), (std::array{0.5, 0.25}));
    EXPECT_EQ(map.find(0.75, 0.75), (std::array{0.5, 0.75}));
    EXPECT_EQ(map.find(0, 0), (std::array{0.0, 0.0}));
    EXPECT_EQ(map.find(1, 1), (std::array{1.0, 1.0}));
    EXPECT_EQ(map.find(0.3, 0.75), (std::array{0.0, 0.75})) << "an empty cell has no width";
    EXPECT_EQ(DensityMap(2, 3, {1, 1, 0, 0, 1, 1}).find(0.7, 0.5), (std::array{0.0, 0.5}))
        << "an empty row has no height";
}

TEST(ReadDensity, ReadsFloatPicturesFromTheBottom) {
    const std::string bytes = pfm_of("Pf", 2, 2, {1, 2, 0, 5});
    EXPECT_EQ(values_of(density(bytes)), values_of(DensityMap(2, 2, {1, 2, 0, 5})));
    EXPECT_EQ(values_of(density(bytes, true)), values_of(DensityMap(2, 2, {4, 3, 5, 0})));
    EXPECT_EQ(refused(pfm_of("Pf", 2, 1, {1, -2})),
              "input: FILE: value -2 in row 0, column 1; expected finite densities, none below 0");
    EXPECT_EQ(refused(pfm_of("Pf", 1, 2, {1, NAN})),
              "input: FILE: value nan in row 1, column 0; expected finite densities, none below 0");
    EXPECT_EQ(refused(pfm_of("PF", 1, 1, {1, -2, 5})),
              "input: FILE: value -2 in row 0, column 0; expected finite densities, none below 0");
    EXPECT_EQ(refused(pfm_of("PF", 1, 1, {1, NAN, 5})),
              "input: FILE: value nan in row 0, column 0; expected finite densities, none below 0");
}

TEST(ReadDensity, TurnsPicturesTheRightWayUp) {
    const std::string bytes = png_of(2, 2, {0, 51, 102, 255});
    EXPECT_EQ(values_of(density(bytes)),
              values_of(DensityMap(2, 2, {102 / 255.0, 1, 0, 51 / 255.0})));
    const DensityMap ink = density(bytes, true);
    EXPECT_EQ(values_of(ink), values_of(DensityMap(2, 2, {1 - 102 / 255.0, 0, 1, 1 - 51 / 255.0})));
    EXPECT_EQ(ink.at(0.1, 0.9), ink.largest());  // black, at the top left
}

TEST(ReadDensity, PutsNothingWhereAPictureIsTransparent) {
    const std::string bytes = png_of(2, 1, {0, 0, 51, 255}, {.colour = PNG_COLOR_TYPE_GRAY_ALPHA});
    EXPECT_EQ(values_of(density(bytes)), (std::vector<double>{0, 2}));
    EXPECT_EQ(values_of(density(bytes, true)), (std::vector<double>{0, 2}));
}

TEST(ReadDensity, ReadsArraysOfEveryType) {
    const DensityMap expected(3, 2, {1, 2, 3, 0, 4, 2});
    const auto expect_map = [&](const std::string& bytes) {
        const DensityMap map = density(bytes);
        EXPECT_EQ(map.width(), 3U);
        EXPECT_EQ(map.height(), 2U);
        EXPECT_EQ(values_of(map), values_of(expected)) << bytes.substr(0, 80);
    };
    expect_map(npy_of<double>("<f8", "(2, 3)", {1, 2, 3, 0, 4, 2}));
    expect_map(npy_of<float>("<f4", "(2, 3)", {1, 2, 3, 0, 4, 2}));
    expect_map(npy_of<std::uint8_t>("|u1", "(2, 3)", {1, 2, 3, 0, 4, 2}));
    expect_map(npy_of<std::uint16_t>("<u2", "(2, 3)", {1, 2, 3, 0, 4, 2}));
    expect_map(npy_of<std::int32_t>("<i4", "(2, 3)", {1, 2, 3, 0, 4, 2}));
    expect_map(npy_of<double>("<f8", "(2, 3)", {1, 0, 2, 4, 3, 2}, true));
}

TEST(ReadDensity, InvertsArraysAgainstTheirLargestValue) {
    const std::string bytes = npy_of<double>("<f8", "(1, 3)", {1, 4, 3});
    EXPECT_EQ(values_of(density(bytes, true)), values_of(DensityMap(3, 1, {3, 0, 1})));
}

TEST(ReadMask, IsWhatIsNotZero) {
    const TemporaryFile picture(png_of(2, 2, {0, 1, 255, 7}));
    EXPECT_EQ(values_of(read_mask(picture.path(), false, {})),
              values_of(DensityMap(2, 2, {1, 1, 0, 1})));
    const TemporaryFile array(npy_of<std::uint8_t>("|u1", "(2, 2)", {0, 1, 255, 0}));
    EXPECT_EQ(values_of(read_mask(array.path(), false, {})), (std::vector<double>{0, 2, 2, 0}));
    EXPECT_EQ(values_of(read_mask(array.path(), true, {})),
              values_of(DensityMap(2, 2, {1, 1, 0, 1})));
}

TEST(ReadDensity, RefusesBadFilesInOneLine) {
    const auto array = [](const std::vector<double>& values, const std::string& shape) {
        return npy_of<double>("<f8", shape, values);
    };
    const std::vector<std::pair<std::string, std::string>> cases = {
        {"", "FILE: the file is empty; expected a PNG or PFM picture or an NPY array"},
        {"x,y\n0,1\n", "FILE: neither a PNG or PFM picture nor an NPY array"},
        {array({1, -2, 3, 4}, "(2, 2)"),
         "FILE: value -2 in row 0, column 1; expected finite densities, none below 0"},
        {array({1, 2, not_a_number, 4}, "(2, 2)"),
         "FILE: value nan in row 1, column 0; expected finite densities, none below 0"},
        {array({1, 2, 3, inf}, "(2, 2)"),
         "FILE: value inf in row 1, column 1; expected finite densities, none below 0"},
        {array({0, 0}, "(1, 2)"), "FILE: all values are 0; no point can be placed"},
        {array({1, 1}, "(2,)"), "FILE: an array of shape (2,); expected (rows, columns)"},
        {array({1, 1}, "(1, 1, 2)"), "FILE: an array of shape (1, 1, 2); expected (rows, columns)"},
        {array({1}, "()"), "FILE: an array of shape (); expected (rows, columns)"},
        {array({}, "(0, 4)"), "FILE: an array of shape (0, 4) is empty"},
        {array({1}, "(1, 2)"),
         "FILE: byte 136: the file ends too soon; expected 16 bytes of numbers, found 8"},
        {png_of(2, 1, {0, 0}), "FILE: all values are 0; no point can be placed"},
        {png_of(2, 1, {3, 4}).substr(0, 50),
         "FILE: not a whole PNG picture: the file ends too soon"}};
    for (const auto& [bytes, message] : cases) EXPECT_EQ(refused(bytes), "input: " + message);
    EXPECT_EQ(refused(png_of(2, 1, {255, 255}), true),
              "input: FILE: all values are 0 when inverted; no point can be placed");
    EXPECT_EQ(refused(array({3, 3}, "(1, 2)"), true),
              "input: FILE: all values are 0 when inverted; no point can be placed");
}

TEST(ReadDensity, SaysWhyAFileCannotBeRead) {
    EXPECT_EQ(error_of([] { read_density("/nowhere/d.png", false, {}); }),
              "io: /nowhere/d.png: no such file");
    EXPECT_EQ(error_of([] { read_density("/tmp", false, {}); }),
              "io: /tmp: is a folder, not a file");
}

}  // namespace stipple::testing::density_map_test
