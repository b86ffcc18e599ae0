// SPDX-License-Identifier: MIT
//
// Short ways for tests to make and measure point sets.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple::testing {

/// Count and dimension, and what else a request has.
Request points(std::uint64_t count, std::size_t dimension, std::uint64_t start = 0);

/// The generator's points for that request; the seed is run.seed.
PointSet make(std::string_view generator, Request request, const Settings& settings = {},
              const RunContext& run = {});

/// A set of the given points.
PointSet points_of(const std::vector<std::vector<double>>& rows);

/// One number of an analyzer's report, by dotted key.
double measure(std::string_view analyzer, std::string_view key, const PointSet& points,
               const Settings& settings = {});

/// The message of the Error that `work` throws, with its kind in front: "usage: --count: ...", and
/// its hint behind " | ". Empty if it throws none.
template <class Work>
std::string error_of(Work&& work) {
    try {
        work();
    } catch (const Error& e) {
        constexpr const char* kinds[] = {"usage", "input", "io", "limit", "cancelled"};
        std::string text = std::string(kinds[static_cast<int>(e.kind())]) + ": " + e.what();
        if (!e.hint().empty()) text += " | " + e.hint();
        return text;
    }
    return {};
}

}  // namespace stipple::testing
