// SPDX-License-Identifier: MIT
//
// A formula that a user typed, parsed by muParser and evaluated at points: f(x, y).
//
// Variables, operators and functions are those of data/guide/formulas.md.
//
// Cost    some 10 ns an operation and point; parsing once a thread.
// Promise the same bits on every machine: functions and ^ are those of src/math, not the C
//         library's, and muParser's optimizer, which changes roundings, is off. Safe to use from
//         several threads.
// Beware  sin and cos lose digits far from 0, as the angle is divided by 2 pi in one rounding.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stipple {

/// Names of variables, each with the coordinate that it is.
using VariableNames = std::vector<std::pair<std::string, std::size_t>>;

/// x1, x2, ... and, of up to three coordinates, x, y, z.
VariableNames usual_variables(std::size_t dimension);

/// Those of the names that are words of a formula.
VariableNames named_variables(const std::vector<std::string>& names);

class Expression {
  public:
    /// @throws Error(usage) "--OPTION: 'TEXT', column N: what is wrong; what is expected"
    Expression(std::string_view option, std::string_view text, std::size_t dimension);

    /// Of a point whose coordinates have names of their own; those that are no words of a formula
    /// (length, x_1) cannot stand in it. @throws Error(usage) as above
    Expression(std::string_view option, std::string_view text,
               const std::vector<std::string>& names);

    /// The formula without blanks.
    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    [[nodiscard]] double at(std::span<const double> point) const;

    /// Values at points, which stand one after the other.
    void evaluate(std::span<const double> points, std::span<double> values) const;

  private:
    struct Machines;
    struct Variables;

    Expression(std::string_view option, std::string_view text, const Variables& variables);

    std::string text_;
    std::size_t dimension_;
    std::shared_ptr<Machines> machines_;
};

/// Whether a text is a word of a formula, and none that means something else there.
bool may_name_variable(std::string_view name);

/// Names of all functions.
std::vector<std::string> formula_functions();

/// Of the library: "2.3.3".
std::string muparser_version();

/// "x = 0.5" or "(x, y) = (0.5, 2)": a place, for messages.
std::string place_text(std::span<const double> point);

}  // namespace stipple
