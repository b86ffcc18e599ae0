// SPDX-License-Identifier: MIT
//
// Checks shared by the contract tests of all kinds of units.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "stipple/run.hpp"
#include "support/units.hpp"

namespace stipple::testing {

template <class Unit>
std::vector<std::string> names_of(const std::vector<Unit>& units) {
    std::vector<std::string> names;
    for (const Unit& unit : units) names.push_back(unit.name);
    return names;
}

/// A unit's name as a test name for GoogleTest, such as poisson_disk.
inline std::string case_name(const ::testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::ranges::replace(name, '-', '_');
    return name;
}

/// Expects the work's progress to rise from 0 to exactly 1.
inline void expect_progress_to_the_end(const std::function<void(const RunContext&)>& work) {
    double last = 0;
    RunContext run;
    run.progress = [&](double done) {
        EXPECT_GE(done, last);
        last = done;
    };
    work(run);
    EXPECT_EQ(last, 1);
}

/// Requests a stop when the work's progress reaches `when`. Expects at most one more report from
/// each of its two threads, then Error(cancelled). (Seconds until then are measured by benchmarks.)
inline void expect_to_stop_at_once(const std::function<void(const RunContext&)>& work,
                                   double when = 0) {
    std::stop_source source;
    RunContext run{.threads = 2, .stop = source.get_token()};
    int later = 0;
    run.progress = [&](double done) {
        if (source.stop_requested()) ++later;
        if (done >= when) source.request_stop();
    };
    EXPECT_EQ(error_of([&] { work(run); }), "cancelled: interrupted");
    EXPECT_LE(later, 2);
}

/// Expects a summary, a source, and help for every option.
template <class Unit>
void expect_complete_record(const Unit& unit) {
    EXPECT_FALSE(unit.summary.empty());
    EXPECT_FALSE(unit.source.empty());
    for (const Option& option : unit.options.options())
        EXPECT_FALSE(option.help.empty()) << option.name;
}

}  // namespace stipple::testing
