// SPDX-License-Identifier: MIT
//
// The programs of data/examples behave as their comments say; install_test.cpp builds them against
// the installed package.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/examples.hpp"
#include "support/program.hpp"

namespace stipple::testing::examples_test {

TEST(Examples, DoWhatTheySay) { expect_examples(examples_path()); }

TEST(Examples, JudgeSaysWhatIsWrong) {
    const Sandbox box;
    const Outcome outcome = box.shell(examples_path() + "/judge missing.csv");
    EXPECT_EQ(outcome.code, 1);
    EXPECT_THAT(outcome.err, ::testing::HasSubstr("judge: missing.csv: "));
}

}  // namespace stipple::testing::examples_test
