// SPDX-License-Identifier: MIT
//
// Short ways for tests to make and measure point sets.
#pragma once

#include <concepts>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple::testing {

/// Count and dimension, and what else a request has.
Request points(std::uint64_t count, std::size_t dimension, std::uint64_t start = 0);

/// A request's seed, and what of a run tests like to choose.
struct Seeded {
    std::uint64_t seed = 1;
    unsigned threads = 0;
    std::uint64_t max_memory = std::numeric_limits<std::uint64_t>::max();
};

/// The generator's points for that request, whose own seed does not count.
PointSet make(std::string_view generator, Request request, const Settings& settings = {},
              const Seeded& seeded = {});

/// The same in a given run; a template, so that braces are a Seeded.
template <std::same_as<RunContext> Run>
PointSet make(std::string_view generator, const Request& request, const Settings& settings,
              const Run& run) {
    return generate(generator, request, settings, run);
}

/// A set of the given points.
PointSet points_of(const std::vector<std::vector<double>>& rows);

/// Options that tests of all units set, and the points of a unit's first golden set: those of
/// tests/contract/settings.txt.
Settings needed_options(const std::string& unit);
std::uint64_t many_of(const std::string& unit);

/// The least count that the unit makes from `wanted` on, or the largest of those that settings.txt
/// lists; `wanted` where it lists none.
std::uint64_t count_of(const std::string& unit, std::uint64_t wanted);

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
