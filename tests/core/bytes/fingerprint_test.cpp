// SPDX-License-Identifier: MIT
#include "core/bytes/fingerprint.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace stipple::testing::fingerprint_test {

// Values published by the authors of the hash.
TEST(Fingerprint, IsThatOfItsAuthors) {
    EXPECT_EQ(fingerprint(std::string_view("")), 0xcbf29ce484222325U);
    EXPECT_EQ(fingerprint(std::string_view("a")), 0xaf63dc4c8601ec8cU);
    EXPECT_EQ(fingerprint(std::string_view("foobar")), 0x85944171f73967e8U);
}

TEST(Fingerprint, OfNumbersIsThatOfTheirBytes) {
    const std::vector<double> numbers = {0.0, -0.0, 1.0};
    const std::string bytes("\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\x80\0\0\0\0\0\0\xf0\x3f", 24);
    EXPECT_EQ(fingerprint(std::span<const double>(numbers)), fingerprint(bytes));
}

TEST(Fingerprint, IsWrittenInSixteenDigits) {
    EXPECT_EQ(format_fingerprint(255), "00000000000000ff");
}

}  // namespace stipple::testing::fingerprint_test
