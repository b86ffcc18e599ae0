// SPDX-License-Identifier: MIT
//
// A formula that a user typed, parsed by muParser and evaluated at points: f(x, y).
//
// Variables, operators and functions are those of data/guide/formulas.md.
//
// Cost    some 10 ns an operation and point; parsing once a thread. Names that do not stand in a
//         formula cost nothing.
// Promise the same bits on every machine: functions and ^ are those of src/math, not the C
//         library's, and muParser's optimizer, which changes roundings, is off. Safe to use from
//         several threads.
// Beware  sin and cos lose digits far from 0, as the angle is divided by 2 pi in one rounding.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace stipple {

/// Names of variables, each with the coordinate that it is.
using VariableNames = std::vector<std::pair<std::string, std::size_t>>;

/// x1, x2, ... and, of up to three coordinates, x, y, z.
VariableNames usual_variables(std::size_t dimension);

/// What formulas call the coordinates of a point that have names of their own, and the words that
/// stand for numbers 0, 1, ... of some of them.
class FormulaNames {
  public:
    void add(const std::string& name, std::vector<std::string> words = {});
    [[nodiscard]] std::size_t size() const { return names_.size(); }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] const std::vector<std::string>& words(std::size_t k) const { return words_[k]; }
    /// Nothing for what is no name.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<std::string>> words_;
    std::unordered_map<std::string, std::size_t> places_;
};

class Expression {
  public:
    /// @throws Error(usage) "--OPTION: 'TEXT', column N: what is wrong; what is expected"
    Expression(std::string_view option, std::string_view text, std::size_t dimension);

    /// Of a point whose coordinates have names of their own, in quotes where they are no words of a
    /// formula ("cross section"), as are the words of coordinates: material == "steel".
    /// @throws Error(usage) as above
    Expression(std::string_view option, std::string_view text, const FormulaNames& names);

    /// The formula without blanks.
    [[nodiscard]] const std::string& text() const { return text_; }
    /// The same without quotes, in these variables.
    [[nodiscard]] const std::string& plain() const { return plain_; }
    [[nodiscard]] const VariableNames& variables() const { return variables_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    [[nodiscard]] double at(std::span<const double> point) const;

    /// Values at points, which stand one after the other.
    void evaluate(std::span<const double> points, std::span<double> values) const;

  private:
    struct Machines;

    void parse(std::string_view option, std::string_view text, const std::string& marked,
               const std::string& told);

    std::string text_;
    std::string plain_;
    VariableNames variables_;  ///< those that stand in it
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
