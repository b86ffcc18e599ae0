// SPDX-License-Identifier: MIT
//
// Points of which each coordinate has a stratum of its own: a part of [0, 1) between neighbouring
// whole multiples of 1 / parts. Where in it the point is, is random, or the middle.
//
// Promise as math/digital/stratum.hpp says.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

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

/// Random numbers for a unit's own use, stream 0, 1, ...
Rng stratified_numbers(const Plan& plan, std::uint64_t stream);

}  // namespace stipple::generators
