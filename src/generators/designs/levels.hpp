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
//
// A factor that becomes one of K outcomes, words or up to ten numbers, takes them in turn, whatever
// their probabilities: a level at x is in the middle of the interval of outcome floor(K x).
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

/// The ends of the intervals of [0, 1] that have the same outcome each, rising; none where these are
/// more than `most`, or the axis is continuous.
std::vector<double> outcome_ends(const OutcomeAxis& axis, std::size_t most);

/// The same of categories, and of up to ten outcomes that are none: what designs take for levels.
std::vector<double> level_ends(const OutcomeAxis& axis);

/// Where levels are along the factors of a plan.
class LevelPlaces {
  public:
    explicit LevelPlaces(const Plan& plan);

    /// How many outcomes a factor has for levels; 0: those of a number are anywhere.
    [[nodiscard]] std::size_t outcomes(std::size_t factor) const {
        return factor < ends_.size() && !ends_[factor].empty() ? ends_[factor].size() - 1 : 0;
    }

    /// Of the level at x.
    [[nodiscard]] double operator()(std::size_t factor, double x) const;

  private:
    std::vector<std::vector<double>> ends_;  ///< of each factor, level_ends()
};

/// Which of the places a run has along a factor.
using LevelOf = std::function<std::size_t(std::uint64_t run, std::size_t factor)>;

std::unique_ptr<Sequence> level_sequence(const Plan& plan, std::span<const double> places,
                                         LevelOf level_of, Findings findings);

}  // namespace stipple::generators
