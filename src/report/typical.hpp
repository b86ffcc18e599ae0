// SPDX-License-Identifier: MIT
//
// What numbers mean: which of two is better, and what is typical (data/typical.csv).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/analyzer.hpp"

namespace stipple {

/// Sentences on a result: what its record says, and "lower is better; 1024 points in the plane: random
/// 0.0392, jittered 0.0133, best 0.00386 (pmj02)"; as far as anything is known of that dimension.
std::vector<std::string> meaning_of(const Analyzer& analyzer, std::string_view key,
                                    std::size_t dimension);

}  // namespace stipple
