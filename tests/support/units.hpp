// SPDX-License-Identifier: MIT
//
// Shorthands for making and measuring point sets.
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

/// A request with count, dimension and start.
Request points(std::uint64_t count, std::size_t dimension, std::uint64_t start = 0);

/// Seed of a request, and parts of the run that tests choose.
struct Seeded {
    std::uint64_t seed = 1;
    unsigned threads = 0;
    std::uint64_t max_memory = std::numeric_limits<std::uint64_t>::max();
};

/// The generator's points; `seeded` replaces the seed in the request.
PointSet make(std::string_view generator, Request request, const Settings& settings = {},
              const Seeded& seeded = {});

/// The same with a given RunContext; a template, so that braces construct a Seeded.
template <std::same_as<RunContext> Run>
PointSet make(std::string_view generator, const Request& request, const Settings& settings,
              const Run& run) {
    return generate(generator, request, settings, run);
}

/// A set with these points.
PointSet points_of(const std::vector<std::vector<double>>& rows);

/// From tests/contract/settings.txt: the options that a unit needs in tests of all units, and the
/// number of points in its first golden set.
Settings needed_options(const std::string& unit);
std::uint64_t many_of(const std::string& unit);

/// Smallest count from `wanted` on that settings.txt lists for the unit, or the largest of them;
/// `wanted` if it lists none.
std::uint64_t count_of(const std::string& unit, std::uint64_t wanted);

/// One number of an analyzer's report, by dotted key.
double measure(std::string_view analyzer, std::string_view key, const PointSet& points,
               const Settings& settings = {});

/// Message of the Error that `work` throws, after its kind: "usage: --count: ...", followed by " |
/// " and its hint. Empty if it throws none.
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
