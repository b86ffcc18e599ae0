// SPDX-License-Identifier: MIT
#include "experiments/designs/fraction_notation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::generators {
namespace {

constexpr std::string_view letters = factor_letters;

std::string name_of(std::uint64_t factors) {
    std::string name;
    for (std::size_t k = 0; k < letters.size(); ++k)
        if ((factors >> k & 1) != 0) name += letters[k];
    return name;
}

Equation parse_equation(std::string_view text) {
    const auto index = [&](char c) {
        const auto at = letters.find(c);
        if (at == std::string_view::npos)
            fail(ErrorKind::usage,
                 "--generators: '{}' in '{}' is not a factor; expected A to Z, except I, or a to z",
                 c, text);
        return at;
    };
    const bool negative = text.size() > 2 && text[2] == '-';
    if (text.find('=') != 1 || text.size() < (negative ? 4 : 3))
        fail(ErrorKind::usage, "--generators: '{}' is not of the form D=ABC or D=-ABC", text);
    Equation equation{.factor = index(text[0]), .product = 0, .negative = negative};
    for (const char c : text.substr(negative ? 3 : 2))
        equation.product ^= std::uint64_t{1} << index(c);
    return equation;
}

/// Checks that no column is constant, equal to or opposite to another. @throws Error(usage)
void require_different_columns(const RegularFraction& design) {
    for (std::size_t i = 0; i < design.factors(); ++i) {
        if (design.columns[i] == 0)
            fail(ErrorKind::usage, "--generators: {} would be constant", letters[i]);
        for (std::size_t k = 0; k < i; ++k)
            if (design.columns[i] == design.columns[k])
                fail(ErrorKind::usage, "--generators: {} would be {} or -{} in all runs",
                     letters[i], letters[k], letters[k]);
    }
}

/// Sign of a word of the defining relation: "-" if the product of its factors is -1, else "".
const char* sign_of(const RegularFraction& design, std::uint64_t word) {
    bool negative = false;
    for (std::size_t k = 0; k < design.negative.size(); ++k)
        negative ^= design.negative[k] && (word >> k & 1) != 0;
    return negative ? "-" : "";
}

}  // namespace

std::vector<Equation> parse_equations(std::string_view text) {
    std::vector<Equation> all;
    for (const auto part : split(text, ','))
        for (const auto word : split(part, ' '))
            if (!word.empty()) all.push_back(parse_equation(word));
    return all;
}

RegularFraction fraction_of(const std::vector<Equation>& equations, std::size_t factors) {
    RegularFraction design = full_fraction(factors);
    design.negative.resize(factors);
    for (const Equation& e : equations) {
        if (std::erase(design.basic, e.factor) == 0)
            fail(ErrorKind::usage, "--generators: {} is given twice", letters[e.factor]);
        design.negative[e.factor] = e.negative;
    }
    for (std::size_t j = 0; j < design.basic.size(); ++j)
        design.columns[design.basic[j]] = std::uint64_t{1} << j;
    for (const Equation& e : equations) {
        std::uint64_t left = e.product;
        std::uint64_t& column = design.columns[e.factor] = 0;
        for (std::size_t j = 0; j < design.basic.size(); ++j)
            if ((e.product >> design.basic[j] & 1) != 0) {
                column |= std::uint64_t{1} << j;
                left &= ~(std::uint64_t{1} << design.basic[j]);
            }
        if (left != 0)
            fail(ErrorKind::usage,
                 "--generators: {}={} contains {}, which is a product itself or not a factor",
                 letters[e.factor], name_of(e.product), name_of(left));
    }
    require_different_columns(design);
    return design;
}

std::string equations_of(const RegularFraction& design) {
    std::string text;
    for (std::size_t k = 0; k < design.factors(); ++k) {
        if (std::ranges::count(design.basic, k) > 0) continue;
        std::uint64_t product = 0;
        for (std::size_t j = 0; j < design.basic.size(); ++j)
            product |= (design.columns[k] >> j & 1) << design.basic[j];
        const bool negative = !design.negative.empty() && design.negative[k];
        text += fmt::format("{}{}={}{}", text.empty() ? "" : ",", letters[k], negative ? "-" : "",
                            name_of(product));
    }
    return text;
}

std::string relation_of(const RegularFraction& design, const std::vector<std::uint64_t>& words) {
    std::string relation = "I";
    for (const std::uint64_t word : words)
        relation += fmt::format("={}{}", sign_of(design, word), name_of(word));
    return relation;
}

std::string aliases_of(const RegularFraction& design, const std::vector<std::uint64_t>& words) {
    std::vector<std::string> all;
    for (std::size_t k = 0; k < design.factors(); ++k) {
        const std::uint64_t factor = std::uint64_t{1} << k;
        const auto length = [&](std::uint64_t word) { return std::popcount(word ^ factor); };
        const int shortest = length(std::ranges::min(words, {}, length));
        std::string text(1, letters[k]);
        for (const std::uint64_t word : words)
            if (length(word) == shortest)
                text += fmt::format("={}{}", sign_of(design, word), name_of(word ^ factor));
        all.push_back(text);
    }
    return join(all, "; ");
}

std::string lengths_text(const WordLengths& lengths) {
    std::vector<std::string> parts;
    for (std::size_t t = 1; t < lengths.size(); ++t)
        if (lengths[t] > 0) parts.push_back(fmt::format("{} of {}", lengths[t], t));
    return join(parts, ", ");
}

std::string roman_numeral(std::size_t number) {
    constexpr const char* numerals[] = {"0",  "I",   "II",   "III", "IV", "V",
                                        "VI", "VII", "VIII", "IX",  "X"};
    return number <= 10 ? numerals[number] : std::to_string(number);
}

}  // namespace stipple::generators
