// SPDX-License-Identifier: MIT
//
// Explanations of results: which of two numbers is better, and typical values (data/typical.csv).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "analyzers/analyzer.hpp"

namespace stipple {

/// Options of a measure, by name.
using GivenOptions = std::vector<std::pair<std::string, std::string>>;

/// Sentences on a result: its description and, as far as known, typical values such as "lower is
/// better; 1024 points in the plane: random 0.0392, jittered 0.0133, best 0.00386 (pmj02)". Typical
/// values are for the plane, and for flags and choices at their defaults.
std::vector<std::string> meaning_of(const Analyzer& analyzer, std::string_view key,
                                    std::size_t dimension, const GivenOptions& given);

}  // namespace stipple
