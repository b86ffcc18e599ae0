// SPDX-License-Identifier: MIT
//
// A formula typed by a user, parsed by muParser and evaluated at points: f(x, y).
//
// See data/guide/formulas.md for variables, operators and functions.
//
// Cost    about 10 ns per operation and point; each thread parses the formula once. Names that are
//         not used in a formula cost nothing.
// Promise the same bits on every machine: functions and ^ are those of src/math, not the C
//         library's, and muParser's optimizer, which changes roundings, is off. Thread-safe.
// Beware  sin and cos lose digits far from 0, because the angle divided by 2 pi is rounded.
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

/// Names of variables, each with the index of its coordinate.
using VariableNames = std::vector<std::pair<std::string, std::size_t>>;

/// Usual names of coordinates: x1, x2, ... and, for up to three coordinates, x, y, z.
VariableNames usual_variables(std::size_t dimension);

/// Names of coordinates in formulas, and the words for the values 0, 1, ... of coordinates with
/// levels.
class FormulaNames {
  public:
    void add(const std::string& name, std::vector<std::string> words = {});
    [[nodiscard]] std::size_t size() const { return names_.size(); }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] const std::vector<std::string>& words(std::size_t k) const { return words_[k]; }
    /// Index of the coordinate with this name; nullopt if there is none.
    [[nodiscard]] std::optional<std::size_t> find(const std::string& name) const;

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<std::string>> words_;
    std::unordered_map<std::string, std::size_t> places_;
};

class Expression {
  public:
    /// Parses a formula in the usual names of coordinates.
    /// @throws Error(usage) "--OPTION: 'TEXT', column N: what is wrong; what is expected"
    Expression(std::string_view option, std::string_view text, std::size_t dimension);

    /// Formula in named coordinates. Names that are not valid variable names are quoted ("cross
    /// section"), and so are the words for values of coordinates: material == "steel".
    /// @throws Error(usage) as above
    Expression(std::string_view option, std::string_view text, const FormulaNames& names);

    /// The formula without blanks.
    [[nodiscard]] const std::string& text() const { return text_; }
    /// The formula without blanks and quotes, in the names of variables().
    [[nodiscard]] const std::string& plain() const { return plain_; }
    [[nodiscard]] const VariableNames& variables() const { return variables_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    [[nodiscard]] double at(std::span<const double> point) const;

    /// Sets values[i] to the value at point i; points are stored one after another.
    void evaluate(std::span<const double> points, std::span<double> values) const;

  private:
    struct Machines;

    void parse(std::string_view option, std::string_view text, const std::string& marked,
               const std::string& told);

    std::string text_;
    std::string plain_;
    VariableNames variables_;  ///< only those in the formula
    std::size_t dimension_;
    std::shared_ptr<Machines> machines_;
};

/// True if the text is a valid variable name without another meaning in formulas.
bool may_name_variable(std::string_view name);

/// Names of all functions.
std::vector<std::string> formula_functions();

/// Version of the library, such as "2.3.3".
std::string muparser_version();

/// A point for messages: "x = 0.5" or "(0.5, 2)".
std::string place_text(std::span<const double> point);

}  // namespace stipple
