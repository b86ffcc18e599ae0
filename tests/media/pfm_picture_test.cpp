// SPDX-License-Identifier: MIT
#include "media/pfm_picture.hpp"

#include <gtest/gtest.h>

#include "support/pictures.hpp"
#include "support/units.hpp"

namespace stipple::testing::pfm_picture_test {
namespace {

PlaneValues read(const std::string& bytes) { return read_pfm(bytes, "p.pfm", {}); }

std::string refused(const std::string& bytes) {
    return error_of([&] { read(bytes); });
}

}  // namespace

TEST(PfmPicture, ReadsGreyInBothByteOrders) {
    const std::vector<float> samples = {0, 0.1F, -3, 1e30F, 1e-40F, 6};
    for (const bool big : {false, true}) {
        const PlaneValues picture = read(pfm_of("Pf", 3, 2, samples, big));
        EXPECT_EQ(picture.width, 3U);
        EXPECT_EQ(picture.height, 2U);
        EXPECT_EQ(picture.values, std::vector<double>(samples.begin(), samples.end()));
    }
}

// 1.0 is 3f 80 00 00, with the low byte last if the scale is positive.
TEST(PfmPicture, ReadsBytesByHand) {
    using namespace std::string_literals;
    EXPECT_EQ(read("Pf\n1 1\n1\n\x3f\x80\0\0"s).values, std::vector{1.0});
    EXPECT_EQ(read("Pf 1 1 -2.5 \0\0\x80\x3f"s).values, std::vector{1.0});
    EXPECT_EQ(read("Pf\r\n1  1\t-1\n\0\0\x80\x3f"s).values, std::vector{1.0});
}

TEST(PfmPicture, TakesColourByItsLuminance) {
    const PlaneValues picture = read(pfm_of("PF", 2, 1, {1, 0, 0, 0.5F, 2, 4}));
    ASSERT_EQ(picture.values.size(), 2U);
    EXPECT_DOUBLE_EQ(picture.values[0], 0.2126);
    EXPECT_DOUBLE_EQ(picture.values[1], 0.5 * 0.2126 + 2 * 0.7152 + 4 * 0.0722);
}

TEST(PfmPicture, KeepsWhatIsNoLight) {
    EXPECT_EQ(read(pfm_of("PF", 1, 1, {9, -1, 9})).values[0], -1);
    EXPECT_TRUE(std::isnan(read(pfm_of("PF", 1, 1, {9, -1, NAN})).values[0]));
}

TEST(PfmPicture, SaysWhatIsWrongAndWhere) {
    const std::string good = pfm_of("Pf", 2, 1, {1, 2});
    const std::vector<std::pair<std::string, std::string>> cases = {
        {good.substr(0, good.size() - 1), "byte 12: expected 8 bytes of floats, found 7"},
        {good + "x", "byte 12: expected 8 bytes of floats, found 9"},
        {"Pf\n0 1\n-1\n", "byte 3: expected the width, a whole number above 0"},
        {"Pf\n1 -1\n-1\n", "byte 5: expected the height, a whole number above 0"},
        {"Pf\n1 x\n-1\n", "byte 5: expected the height, a whole number above 0"},
        {"Pf\n1 1\n0\nabcd",
         "byte 7: expected a scale other than 0, below 0 for little-endian floats"},
        {"Pf\n1 1\n", "byte 7: expected a scale other than 0, below 0 for little-endian floats"},
        {"Pf\n999999999 999999999\n-1\n",
         "byte 26: expected 3999999992000000000 bytes of floats, found 0"}};
    for (const auto& [bytes, message] : cases)
        EXPECT_EQ(refused(bytes), "input: p.pfm: " + message);
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_NE(refused(good.substr(0, size)), "") << size;
}

TEST(PfmPicture, HonoursTheMemoryLimit) {
    const std::string bytes = pfm_of("Pf", 100, 100, std::vector<float>(10'000, 1));
    EXPECT_NE(error_of([&] { read_pfm(bytes, "p.pfm", {.max_memory = 100'000}); }).find("limit"),
              std::string::npos);
}

}  // namespace stipple::testing::pfm_picture_test
