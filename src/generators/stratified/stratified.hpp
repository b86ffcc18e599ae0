// SPDX-License-Identifier: MIT
//
// Points of which each coordinate has a stratum of its own: a part of [0, 1) between neighbouring
// whole multiples of 1 / parts. Where in it the point is, is random, or the middle.
//
// The grid of cells that multi-jittered sets have is of a given shape, or as square as the count
// lets it be.
//
// Promise as math/digital/stratum.hpp says.
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
    .name = "centered", .help = "Puts points into the middles of their strata, not anywhere"};

inline constexpr Param<Choice> order_option{.name = "order",
                                            .fallback = "shuffled",
                                            .choices = "shuffled|cells",
                                            .help = "Order of the points: random, or cell by cell"};

/// Of multi-jittered sets, whose cells are a grid.
inline constexpr Param<Extents> shape_option{
    {.name = "shape",
     .unit = "cells",
     .help = "Columns x rows, such as 40x25; gives the count. Without it: as square as the count "
             "allows"}};

struct StratifiedStyle {
    bool centered;
    bool shuffled;
};

/// What the two options above ask for.
inline StratifiedStyle style_of(const Values& options) {
    return {.centered = options[centered_option], .shuffled = options[order_option] == "shuffled"};
}

/// low[j] = number of the stratum of the `index[j]`-th point, along `coordinate`. Returns how many
/// strata there are.
using StrataOf = std::function<std::uint64_t(std::size_t coordinate, std::span<const double> index,
                                             std::span<double> low)>;

std::unique_ptr<Sequence> stratified_sequence(const Plan& plan, const StratifiedStyle& style,
                                              StrataOf strata);

/// A coordinate of point `index`, which is in a stratum of `parts`: where such a sequence has it.
double place_in_stratum(const Plan& plan, bool centered, std::size_t coordinate,
                        std::uint64_t index, double stratum, std::uint64_t parts);

/// Random numbers for a unit's own use, stream 0, 1, ...
Rng stratified_numbers(const Plan& plan, std::uint64_t stream);

/// Number of columns for `count` points: the shape's; or the divisor of the count nearest to its
/// root from below, if not less than sqrt(1/2) of it; or the root, rounded down.
std::uint64_t jitter_columns(std::uint64_t count, const Values& options);

/// The plan for the product of the sides as count, and their number as dimension.
/// @param cells what messages call them. @throws Error(usage) when the request contradicts it
Plan plan_of_shape(const Request& request, const std::vector<std::int64_t>& sides,
                   std::string_view cells);

/// Cells along each axis: as a shape says or, where it is empty, the root of the count along all.
/// @throws Error(usage) as exact_root()
std::vector<std::uint64_t> sides_of(const Plan& plan, const std::vector<std::int64_t>& shape,
                                    const std::string& who);

/// The plan that count and shape imply. @throws Error(usage) when they contradict each other.
Plan plan_jitter_grid(const Request& request, const Values& options);

}  // namespace stipple::generators
