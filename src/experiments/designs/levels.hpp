// SPDX-License-Identifier: MIT
//
// Levels of designed experiments as coordinates. Level l = 0, ..., m - 1 of a factor is at
//
//     (2 l + 1) / (2 m)     the middle of cell l of m equal cells, or with --ends at
//     l / (m - 1)           from face to face, the highest one just below 1.
//
// With the middles, every warp by inversion onto m equally probable integers or categories gives
// the levels exactly. The box from -m / (m - 1) to m / (m - 1) gives the coded values -1, ..., 1 of
// the literature: --bounds -2..2 for two levels, -1.5..1.5 for three.
//
// A factor that is warped onto K outcomes (categories, or up to ten numbers) ignores the outcomes'
// probabilities: a level at x moves to the middle of the interval of outcome floor(K x).
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
        "Spread levels from 0 to just below 1 instead of over the middles of equal cells, which "
        "warps onto integers and categories expect. --bounds with the provenance's coded_bounds "
        "makes them -1 to 1"};

inline constexpr Param<std::int64_t> center_option{
    .name = "center",
    .fallback = 1,
    .low = 0,
    .high = 1'000'000,
    .unit = "runs",
    .help = "Number of runs at the centre, which come last; experiments with noise use 3 to 6"};

/// Traits of designs that consist of levels and use no random numbers.
inline GeneratorTraits level_traits(std::size_t min_dimension, std::size_t max_dimension) {
    return {.min_dimension = min_dimension,
            .max_dimension = max_dimension,
            .prefix = false,
            .seeded = false,
            .levels = true};
}

using Findings = std::vector<std::pair<std::string, std::string>>;

/// Coordinate of a level; 1/2 if the factor has only one level.
double level_place(std::uint64_t level, std::uint64_t levels, bool ends);
std::vector<double> level_places(std::uint64_t levels, bool ends);

/// The --bounds that map the levels to -1, ..., 1, such as "-2..2".
std::string coded_range(std::uint64_t levels, bool ends);

/// Plan for exactly `runs` runs. @throws Error(usage) if the request has another count
/// @param design name of the design in that message
Plan plan_of_runs(const Request& request, std::uint64_t runs, std::size_t factors,
                  const std::string& design);

/// Like plan_of_runs(), for `others` runs plus the number of centre runs from --center.
Plan plan_with_center(const Request& request, const Values& options, std::uint64_t others,
                      std::size_t factors, const std::string& design);

/// Checks that count and start are multiples of `block`. @throws Error(usage) about design `who`
void require_whole_blocks(const Plan& plan, std::uint64_t block, const std::string& who);

/// Maps levels to coordinates, separately for each factor of a plan.
class LevelPlaces {
  public:
    explicit LevelPlaces(const Plan& plan);

    /// Number of outcomes that serve as levels of a factor; 0 if its levels are coordinates.
    [[nodiscard]] std::size_t outcomes(std::size_t factor) const {
        return factor < ends_.size() && !ends_[factor].empty() ? ends_[factor].size() - 1 : 0;
    }

    /// The middle of the interval of the outcome at x; x itself if the factor has no outcomes.
    [[nodiscard]] double operator()(std::size_t factor, double x) const;

  private:
    std::vector<std::vector<double>> ends_;  ///< ends of the outcomes' intervals, for each factor
};

using LevelOf = std::function<std::size_t(std::uint64_t run, std::size_t factor)>;

std::unique_ptr<Sequence> level_sequence(const Plan& plan, std::span<const double> places,
                                         LevelOf level_of, Findings findings);

}  // namespace stipple::generators
