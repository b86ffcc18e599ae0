// SPDX-License-Identifier: MIT
//
// What the contract tests of all kinds of units share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>
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

/// poisson_disk: a unit's name as GoogleTest takes it.
inline std::string case_name(const ::testing::TestParamInfo<std::string>& info) {
    std::string name = info.param;
    std::ranges::replace(name, '-', '_');
    return name;
}

/// Processor time of all threads: not disturbed by what else the machine does.
inline double cpu_seconds() {
    timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// The work's progress rises from 0 to exactly 1.
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

/// Asked to stop at its first sign of life, the work ends within 100 ms of each of its two threads.
/// Twice that is let pass for a machine that is busy, ten times for one that sanitizers make slow.
inline void expect_to_stop_at_once(const std::function<void(const RunContext&)>& work) {
    std::stop_source source;
    RunContext run{.threads = 2, .stop = source.get_token()};
    double stopped_at = 0;
    run.progress = [&](double) {
        if (source.stop_requested()) return;
        stopped_at = cpu_seconds();
        source.request_stop();
    };
    const auto error = error_of([&] { work(run); });
    const double took = cpu_seconds() - stopped_at;
    EXPECT_EQ(error, "cancelled: interrupted");
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    EXPECT_LT(took, 2.0);
#else
    EXPECT_LT(took, 0.4);
#endif
}

/// The record says what it is, where it is from, and what its options do.
template <class Unit>
void expect_complete_record(const Unit& unit) {
    EXPECT_FALSE(unit.summary.empty());
    EXPECT_FALSE(unit.source.empty());
    for (const Option& option : unit.options.options())
        EXPECT_FALSE(option.help.empty()) << option.name;
}

}  // namespace stipple::testing
