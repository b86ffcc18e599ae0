// SPDX-License-Identifier: MIT
//
// Runs the programs of data/examples, in whichever folder they were built.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "support/program.hpp"

namespace stipple::testing {

inline void expect_examples(const std::string& folder) {
    const Sandbox box;
    const auto out = [&](const std::string& line) { return good(box.shell(folder + "/" + line)); };
    EXPECT_EQ(out("pixel_sampler"), "covered: 0.28 of the picture; the disk's area is 0.28\n");
    EXPECT_EQ(out("integral"), "0.796600, standard error below 1e-6: yes; exact: 0.796600\n");
    EXPECT_EQ(out("density"), "2000 points, most on the right half\n");
    EXPECT_TRUE(box.exists("points.svg"));
    EXPECT_THAT(out("two_samplers"),
                ::testing::ContainsRegex("sobol:scramble=owen *512 points: 0.00"));
    EXPECT_THAT(box.read("two_samplers.html"), ::testing::HasSubstr("Sobol"));
    EXPECT_EQ(box.run({"generate", "random", "-n", "5000", "-w", "disk", "-o", "disk.json"}).code,
              0);
    EXPECT_THAT(out("judge disk.json"), ::testing::HasSubstr("5000 points on disk: uniform (p = "));
}

}  // namespace stipple::testing
