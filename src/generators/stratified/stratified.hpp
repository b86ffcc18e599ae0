// SPDX-License-Identifier: MIT
//
// Points with every coordinate in a given stratum, a part of [0, 1) between consecutive multiples
// of 1 / parts. The position in the stratum is random, or the middle.
//
// The cells of multi-jittered sets are a grid of a given shape, or as square as the count allows.
//
// Promise as for math/digital/stratum.hpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "core/options.hpp"
#include "core/rng.hpp"
#include "generators/generator.hpp"

namespace stipple::generators {

inline constexpr Param<bool> centered_option{
    .name = "centered",
    .help = "Place each point at the middle of its stratum instead of at random"};

inline constexpr Param<Choice> order_option{.name = "order",
                                            .fallback = "shuffled",
                                            .choices = "shuffled|cells",
                                            .help = "Order of the points: random, or cell by cell"};

/// Option of multi-jittered sets, whose cells form a grid.
inline constexpr Param<Extents> shape_option{
    {.name = "shape",
     .unit = "cells",
     .help =
         "Columns x rows, such as 40x25; gives the count. Default: as square as the count allows"}};

struct StratifiedStyle {
    bool centered;
    bool shuffled;
};

inline StratifiedStyle style_of(const Values& options) {
    return {.centered = options[centered_option], .shuffled = options[order_option] == "shuffled"};
}

/// Sets low[j] to the stratum of point `index[j]` along `coordinate`; returns the number of strata.
using StrataOf = std::function<std::uint64_t(std::size_t coordinate, std::span<const double> index,
                                             std::span<double> low)>;

std::unique_ptr<Sequence> stratified_sequence(const Plan& plan, const StratifiedStyle& style,
                                              StrataOf strata);

/// Coordinate of point `index` in one of `parts` equal strata, as stratified_sequence() makes it.
double place_in_stratum(const Plan& plan, bool centered, std::size_t coordinate,
                        std::uint64_t index, double stratum, std::uint64_t parts);

/// Random numbers for a generator's own use; streams are numbered from 0.
Rng stratified_numbers(const Plan& plan, std::uint64_t stream);

/// Number of columns for `count` points: that of --shape, if given; otherwise the largest divisor
/// of the count in [sqrt(count / 2), sqrt(count)]; floor(sqrt(count)) if there is no such divisor.
std::uint64_t jitter_columns(std::uint64_t count, const Values& options);

/// For Generator::constants: number of columns and, if the last row is not full, of its points.
std::vector<Constants> column_constant(const Plan& plan, const Values& options, const RunContext&);

/// Plan with the product of the sides as count, and their number as dimension.
/// @param cells name of the cells in messages
/// @throws Error(usage) if the request contradicts the sides
Plan plan_of_shape(const Request& request, const std::vector<std::int64_t>& sides,
                   std::string_view cells);

/// Number of cells along each axis: the shape, or if it is empty the same number along all axes.
/// @throws Error(usage) as exact_root()
std::vector<std::uint64_t> sides_of(const Plan& plan, const std::vector<std::int64_t>& shape,
                                    const std::string& who);

/// Plan implied by count and --shape. @throws Error(usage) if they contradict each other
Plan plan_jitter_grid(const Request& request, const Values& options);

}  // namespace stipple::generators
