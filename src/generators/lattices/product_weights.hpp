// SPDX-License-Identifier: MIT
//
// What the lattices' options have in common: components of a vector, and the weights of coordinates
// in the search for one, which decay like a power, or are given one by one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/options.hpp"

namespace stipple {

inline constexpr Param<Numbers> product_weights{
    {.name = "weights",
     .help = "Weights of the coordinates in what the search makes least, a positive number each"}};

inline constexpr Param<std::int64_t> weight_decay{
    .name = "decay",
    .fallback = 2,
    .low = 0,
    .high = 20,
    .help = "Without weights: coordinate j has the weight j^-decay"};

/// Refuses both at once, and either where nothing is searched. @throws Error(usage)
/// @param searching the rules that search, as a message names them
/// @param rule the one at hand
void check_weights(const Values& options, bool searches, std::string_view searching,
                   std::string_view rule);

/// The first components of a vector that an option gives. @throws Error(usage): too few, or one
/// that is no whole number from `least` to `most`, which messages call `range`.
std::vector<std::uint64_t> given_components(const std::vector<double>& numbers,
                                            std::size_t dimension, double least, double most,
                                            std::string_view range);

/// The weights of the first coordinates. @throws Error(usage): too few, or not in (0, 10^6].
std::vector<double> weights_of(const Values& options, std::size_t dimension);

}  // namespace stipple
