// SPDX-License-Identifier: MIT
//
// Text notation of regular fractions. Factors are A, B, ..., Z, a, ..., z without I and i, because
// I denotes the mean. Generators are D=ABC,E=-AB; the defining relation is I=ABCD=-ABE=-CDE; each
// main effect is listed with its aliases.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/designs/regular_fraction.hpp"

namespace stipple::generators {

inline constexpr std::string_view factor_letters =
    "ABCDEFGHJKLMNOPQRSTUVWXYZabcdefghjklmnopqrstuvwxyz";

/// One generator such as D=-ABC.
struct Equation {
    std::size_t factor = 0;
    std::uint64_t product = 0;  ///< set of factors, one bit each
    bool negative = false;
};

/// Parses generators separated by commas or spaces. @throws Error(usage)
std::vector<Equation> parse_equations(std::string_view text);

/// Fraction of `factors` factors that is defined by equations. @throws Error(usage) if these
/// contradict each other or make two factors equal
RegularFraction fraction_of(const std::vector<Equation>& equations, std::size_t factors);

/// Generators as text: "D=ABC,E=-AB".
std::string equations_of(const RegularFraction& design);

/// Defining relation as text: "I=ABCD=-ABE=-CDE".
std::string relation_of(const RegularFraction& design, const std::vector<std::uint64_t>& words);

/// Each main effect with its shortest aliases: "A=BD=CE; B=AD".
std::string aliases_of(const RegularFraction& design, const std::vector<std::uint64_t>& words);

/// Numbers of words by length: "7 of 3, 7 of 4, 1 of 7".
std::string lengths_text(const WordLengths& lengths);

/// Roman numeral up to ten (III for 3), Arabic digits beyond.
std::string roman_numeral(std::size_t number);

}  // namespace stipple::generators
