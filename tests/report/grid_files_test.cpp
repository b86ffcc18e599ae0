// SPDX-License-Identifier: MIT
#include "report/grid_files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cstring>

namespace stipple::testing::grid_files_test {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace {

/// Grey values of a PNG, row after row from the top.
std::vector<int> decode(const std::string& bytes, const Grid& shape) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_TRUE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
    EXPECT_EQ(image.width, shape.columns);
    EXPECT_EQ(image.height, shape.rows);
    image.format = PNG_FORMAT_GRAY;
    std::vector<png_byte> pixels(PNG_IMAGE_SIZE(image));
    EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr));
    return {pixels.begin(), pixels.end()};
}

const Grid sample{.rows = 3, .columns = 3, .values = {0, 1, 3, 1, 9, 1, 1e300, 1, 0}};

}  // namespace

// Layout of the NPY format, version 1.0: magic, length of the header in 2 bytes, header to a
// multiple of 64, numbers.
TEST(GridFiles, NpyHoldsShapeAndNumbers) {
    const Grid grid{.rows = 2, .columns = 3, .values = {0.5, -1, 2, 3, 4, 1e-300}};
    const std::string bytes = npy_bytes(grid);
    ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t header =
        static_cast<unsigned char>(bytes[8]) + 256U * static_cast<unsigned char>(bytes[9]);
    EXPECT_EQ((10 + header) % 64, 0U);
    const std::string text = bytes.substr(10, header);
    EXPECT_TRUE(text.starts_with("{'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }"));
    EXPECT_EQ(text.back(), '\n');
    ASSERT_EQ(bytes.size(), 10 + header + 6 * 8);
    std::vector<double> values(6);
    std::memcpy(values.data(), bytes.data() + 10 + header, 48);
    EXPECT_EQ(values, grid.values);
}

// Grey is 255 P / (1 + P); the last row is on top; the centre is black.
TEST(GridFiles, PngIsGreyByPowerWithTheLastRowOnTop) {
    EXPECT_EQ(decode(png_bytes(sample), sample),
              (std::vector<int>{255, 128, 0, 128, 0, 128, 0, 128, 191}));
}

// A plane off the centre omits no frequency.
TEST(GridFiles, PngSaysWhatItsPixelsAre) {
    EXPECT_THAT(png_bytes(sample),
                AllOf(HasSubstr("Power spectrum, white noise P = 1, at the frequencies -1 to 1 "),
                      HasSubstr("Frequency 0, in the centre, is left out.")));
    EXPECT_THAT(png_bytes(sample, {.differences = 2.5}),
                AllOf(HasSubstr("Pair differences, independent points P = 1, from -2.5 to 2.5 "),
                      Not(HasSubstr("spectrum")), Not(HasSubstr("requenc"))));
    Grid cube{.rows = 9, .columns = 3, .values = std::vector<double>(27)};
    EXPECT_THAT(png_bytes(cube, {.slice = 1}),
                AllOf(HasSubstr(" Plane fz = 1."), Not(HasSubstr("left out"))));
    EXPECT_THAT(png_bytes(cube), HasSubstr(" Plane fz = 0. Frequency 0, in the centre, "));
}

TEST(GridFiles, PngOfALineIsALine) {
    const Grid line{.rows = 1, .columns = 5, .values = {1, 0, 7, 0, 1}};
    EXPECT_EQ(decode(png_bytes(line), line), (std::vector<int>{128, 0, 0, 0, 128}));
}

}  // namespace stipple::testing::grid_files_test
