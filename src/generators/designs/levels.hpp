// SPDX-License-Identifier: MIT
//
// Levels of designed experiments as coordinates. Level l = 0, ..., m - 1 of a factor is
//
//     (2 l + 1) / (2 m)     the middle of the l-th of m equal cells, or with --ends
//     l / (m - 1)           from face to face, the highest one just below 1.
//
// From the middles every warp by inversion onto m equally probable integers or categories gives the
// levels exactly, as does the box from -m / (m - 1) to m / (m - 1), in which they are the coded
// values -1, ..., 1 of the literature: --bounds -2..2 for two levels, -1.5..1.5 for three.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/options.hpp"
#include "generators/generator.hpp"

namespace stipple::generators {

inline constexpr Param<bool> ends_option{
    .name = "ends",
    .help =
        "Levels go from 0 to just below 1; by default they are the middles of equal cells, "
        "which warps onto integers and categories take. --bounds with the provenance's "
        "coded_bounds makes them -1 to 1"};

inline constexpr Param<std::int64_t> center_option{
    .name = "center",
    .fallback = 1,
    .low = 0,
    .high = 1'000'000,
    .unit = "runs",
    .help = "Runs at the centre, the last ones; experiments with noise repeat it 3 to 6 times"};

using Findings = std::vector<std::pair<std::string, std::string>>;

/// Where a level is. One level alone is in the middle.
double level_place(std::uint64_t level, std::uint64_t levels, bool ends);

/// The places of all levels.
std::vector<double> level_places(std::uint64_t levels, bool ends);

/// The range "-2..2" in which so many levels are -1, ..., 1, for --bounds.
std::string coded_range(std::uint64_t levels, bool ends);

/// The plan for a number of runs. @throws Error(usage) where another one is asked for
/// @param design "2^3 runs" in its message
Plan plan_of_runs(const Request& request, std::uint64_t runs, std::size_t factors,
                  const std::string& design);

/// As plan_of_runs(), for `others` runs and so many as are asked for at the centre.
Plan plan_with_center(const Request& request, const Values& options, std::uint64_t others,
                      std::size_t factors, const std::string& design);

/// Holds that count and start are multiples of the runs that belong together. @throws Error(usage)
void require_whole_blocks(const Plan& plan, std::uint64_t block, const std::string& who);

/// Which of the places a run has along a factor.
using LevelOf = std::function<std::size_t(std::uint64_t run, std::size_t factor)>;

std::unique_ptr<Sequence> level_sequence(std::size_t factors, std::vector<double> places,
                                         LevelOf level_of, Findings findings);

}  // namespace stipple::generators
