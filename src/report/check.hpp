// SPDX-License-Identifier: MIT
//
// Conditions on results, as --check takes them: KEY<VALUE, with <, <=, >, >=, == or !=.
#pragma once

#include <string>
#include <string_view>

#include "analyzers/analyzer.hpp"
#include "stipple/report.hpp"

namespace stipple {

struct Check {
    std::string key = {};            ///< dotted
    std::string op = {};             ///< < <= > >= == !=
    std::string value = {};          ///< a number, true, false, or a word
    std::string option = "--check";  ///< by which it was given, for messages

    /// Whether it holds. @throws Error(usage): no such key, or no number where one is compared.
    [[nodiscard]] bool holds(const Report& report) const;

    /// What there is under the key, in words: "0.25", "false", "between 0.1 and 0.2".
    [[nodiscard]] std::string found(const Report& report) const;
};

/// @throws Error(usage)
Check parse_check(std::string_view text, const std::string& option = "--check");

/// Refuses what is certain before anything is measured: a word that the result never is, or none
/// where it is one. @throws Error(usage) naming what there is
void require_sense(const Check& check, const ResultKey& result);

}  // namespace stipple
