// SPDX-License-Identifier: MIT
//
// Options shared by many warps, and their checks.
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

/// Checks a coordinate x of a centre. @throws Error(usage) if it is so large that rounding would
/// destroy a shape of size `reach`
void refuse_far(double x, double reach);

/// Expands an option with one number for all coordinates, or one for each, to d numbers.
/// @throws Error(usage) for another count of numbers
std::vector<double> one_for_each(const Param<Numbers>& option, std::vector<double> numbers,
                                 std::size_t d);

/// Weights divided by their sum. @throws Error(usage) if a weight is below 0 or, without
/// `normalize`, if the sum differs from 1 by more than 1e-12
std::vector<double> checked_weights(const Param<Numbers>& option, std::vector<double> weights,
                                    bool normalize);

/// Cumulative sums of weights that sum to 1; the last is exactly 1.
std::vector<double> sums_to_1(const std::vector<double>& weights);

}  // namespace stipple::warps
