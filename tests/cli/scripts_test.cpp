// SPDX-License-Identifier: MIT
//
// The scripts that make tables of measured values.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "places.hpp"
#include "support/program.hpp"

namespace stipple::testing::scripts_test {

using ::testing::HasSubstr;

namespace {

void expect_quiet(const Outcome& outcome) {
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

}  // namespace

// 64 points of a square grid: distance 1/8, or sqrt(sqrt(3) / 2) of that in a hexagonal lattice;
// empty circles have radius sqrt(1/2) / 8, or sqrt(3 sqrt(3) / 4) times those of the hexagonal
// lattice.
TEST(BlueNoiseTable, HasARowForEachGenerator) {
    const Sandbox box;
    const std::string table = STIPPLE_SOURCE_DIR "/tests/bench/blue_noise_table.py ";
    const Outcome outcome =
        box.shell(table + "$(command -v stipple) --sets 2 --count 64 grid random");
    expect_quiet(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("| generator |"));
    EXPECT_THAT(outcome.out, HasSubstr("| grid      | 0.931    | 0.931    | 1.140 "));
    EXPECT_THAT(outcome.out, HasSubstr("\n| random    | 0.0"));
    EXPECT_THAT(outcome.out, HasSubstr("| published "));
    EXPECT_EQ(box.shell(table).code, 1);
    EXPECT_EQ(box.shell(table + "no/such/stipple").code, 1);
}

TEST(PublishedTable, HasOursBesideTheirs) {
    const Sandbox box;
    const std::string table = STIPPLE_SOURCE_DIR "/tests/bench/published_table.py ";
    const Outcome outcome = box.shell(table + "$(command -v stipple) --sets 2 random jittered");
    expect_quiet(outcome);
    EXPECT_THAT(outcome.out, HasSubstr("| published | ours "));
    EXPECT_THAT(outcome.out, HasSubstr("| `random -n 4096`   | mean       | 0.464     | 0.4"));
    EXPECT_THAT(outcome.out, HasSubstr("| `jittered -n 4096` | bond order | 0.363     | 0.3"));
    EXPECT_EQ(box.shell(table).code, 1);
    EXPECT_EQ(box.shell(table + "no/such/stipple").code, 1);
    EXPECT_EQ(box.shell(table + "stipple nobody").code, 1);
}

// Words that the script does not know install nothing.
TEST(Setup, KnowsItsWords) {
    const Sandbox box;
    const std::string setup = STIPPLE_SOURCE_DIR "/scripts/setup ";
    const Outcome help = box.shell(setup + "--help");
    expect_quiet(help);
    EXPECT_THAT(help.out, HasSubstr("usage: scripts/setup [python | "));
    for (const char* words : {"pyhton", "python wheel", "--verbose"})
        EXPECT_EQ(box.shell(setup + words).code, 2) << words;
    EXPECT_THAT(box.shell(setup + "pyhton").err,
                HasSubstr("setup: unknown argument 'pyhton'; usage"));
}

}  // namespace stipple::testing::scripts_test
