// SPDX-License-Identifier: MIT
//
// Conditions on results, the values of --check: KEY<VALUE, with <, <=, >, >=, == or !=.
#pragma once

#include <string>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "stipple/report.hpp"

namespace stipple {

struct Check {
    std::string key = {};            ///< dotted key of a result
    std::string op = {};             ///< < <= > >= == !=
    std::string value = {};          ///< a number, true, false, or a word
    std::string option = "--check";  ///< option with this condition, for messages

    /// Whether the condition holds. @throws Error(usage) if the key does not exist, or if its
    /// result is not a number but is compared with a number
    [[nodiscard]] bool holds(const Report& report) const;

    /// The value under the key, in words: "0.25", "false", "between 0.1 and 0.2".
    [[nodiscard]] std::string found(const Report& report) const;
};

/// Parses a condition. @throws Error(usage)
Check parse_check(std::string_view text, const std::string& option = "--check");

/// Rejects conditions that can never make sense, before the points are measured. For a result that
/// is a word, these are operators other than == and !=, and words that the result never is.
/// @throws Error(usage) naming the possible words
void require_sense(const Check& check, const ResultKey& result);

}  // namespace stipple
