// SPDX-License-Identifier: MIT
//
// Regular fractions as experimenters write them: factors A, B, ..., Z, a, ..., z without I and i,
// of which I stands for the mean; generators D=ABC,E=-AB; the defining relation I=ABCD=-ABE=-CDE;
// and with each main effect what it is aliased with.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "generators/designs/regular_fraction.hpp"

namespace stipple::generators {

inline constexpr std::string_view factor_letters =
    "ABCDEFGHJKLMNOPQRSTUVWXYZabcdefghjklmnopqrstuvwxyz";

/// One generator, D=-ABC.
struct Equation {
    std::size_t factor = 0;
    std::uint64_t product = 0;  ///< set of factors
    bool negative = false;
};

/// @throws Error(usage)
std::vector<Equation> parse_equations(std::string_view text);

/// The fraction that equations between so many factors give. @throws Error(usage) where they
/// contradict each other, or two factors would be the same
RegularFraction fraction_of(const std::vector<Equation>& equations, std::size_t factors);

/// D=ABC,E=-AB
std::string equations_of(const RegularFraction& design);

/// I=ABCD=-ABE=-CDE, of the words of the defining relation.
std::string relation_of(const RegularFraction& design, const std::vector<std::uint64_t>& words);

/// A=BD=CE; B=AD: with each main effect the shortest that it cannot be told from.
std::string aliases_of(const RegularFraction& design, const std::vector<std::uint64_t>& words);

/// "7 of 3, 7 of 4, 1 of 7"
std::string lengths_text(const WordLengths& lengths);

/// III for 3, up to ten.
std::string roman_numeral(std::size_t number);

}  // namespace stipple::generators
