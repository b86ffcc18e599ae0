// SPDX-License-Identifier: MIT
//
// What warps of all kinds do with their options.
#pragma once

#include <string_view>
#include <vector>

#include "core/options.hpp"

namespace stipple::warps {

/// An option for a length above 0.
constexpr Param<double> length_option(std::string_view name, double fallback,
                                      std::string_view help) {
    return {.name = name, .fallback = fallback, .low = 1e-150, .high = 1e150, .help = help};
}

/// @throws Error(usage) when a centre's coordinate is so far that the shape is lost in rounding.
void refuse_far(double x, double reach);

/// A number for each of d coordinates, of an option that has one for all or one for each.
/// @throws Error(usage)
std::vector<double> one_for_each(const Param<Numbers>& option, std::vector<double> numbers,
                                 std::size_t d);

/// Numbers >= 0 that sum to 1 within 1e-12, or to anything where `normalize`, divided by their sum.
/// @throws Error(usage)
std::vector<double> checked_weights(const Param<Numbers>& option, std::vector<double> weights,
                                    bool normalize);

/// Running sums of such weights, the last of them 1.
std::vector<double> sums_to_1(const std::vector<double>& weights);

}  // namespace stipple::warps
