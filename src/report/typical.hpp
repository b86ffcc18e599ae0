// SPDX-License-Identifier: MIT
//
// What numbers mean: which of two is better, and what is typical (data/typical.csv).
#pragma once

#include <string>
#include <string_view>

namespace stipple {

/// "lower is better; 1024 points in the plane: random 0.0392, jittered 0.0133, best 0.00386 (pmj02)";
/// empty where nothing is known of the result.
std::string typical_in_words(std::string_view analyzer, std::string_view key);

}  // namespace stipple
