// SPDX-License-Identifier: MIT
//
// A formula typed by a user, evaluated at points: f(x, y).
//
// See data/guide/formulas.md for variables, operators and functions.
//
// Cost    about 0.5 ns per operation and point in blocks of points, and 2 ns at single points;
//         functions take 5 to 20 ns, powers up to 40.
// Promise the same bits on every machine: functions and ^ are those of src/math, not the C
//         library's. Thread-safe.
// Beware  sin and cos lose digits far from 0, because the angle divided by 2 pi is rounded.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace stipple {

/// Names of coordinates in formulas, and the words for values 0, 1, ... of coordinates with levels.
class FormulaNames {
  public:
    void add(const std::string& name, std::vector<std::string> words = {});
    [[nodiscard]] std::size_t size() const { return names_.size(); }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
    [[nodiscard]] const std::vector<std::string>& words(std::size_t k) const { return words_[k]; }
    /// Index of the coordinate with this name; nullopt if there is none.
    [[nodiscard]] std::optional<std::size_t> find(std::string_view name) const;

  private:
    std::vector<std::string> names_;
    std::vector<std::vector<std::string>> words_;
    std::unordered_map<std::string, std::size_t> places_;
};

/// An operator or a function.
struct FormulaOperation {
    std::string_view name;
    std::size_t arguments;                ///< 0: one or more, combined in pairs from the left
    int binding;                          ///< precedence of an operator; 0 for functions
    double (*value)(double x, double y);  ///< y is not used if there is one argument
    /// Sets x[i] to value(x[i], y[i]) for a block of points.
    void (*apply)(double* x, const double* y, std::size_t count);
};

constexpr int comparison_binding = 3;

/// A step of a formula in postfix order, on a stack of values.
struct FormulaStep {
    enum Kind {
        number,
        coordinate,
        operation,
        added,  ///< added, subtracted, multiplied: computed without a call at single points
        subtracted,
        multiplied,
        when,       ///< pops a condition; if it is 0, continues after step `index`, an `otherwise`
        otherwise,  ///< continues after step `index`, a `chosen`
        chosen      ///< end of c ? a : b
    } kind;
    double value = 0;
    std::size_t index = 0;  ///< of the coordinate or, for `when` and `otherwise`, of a step
    const FormulaOperation* applied = nullptr;
};

class Expression {
  public:
    /// Parses a formula in the usual names of coordinates: x1, x2, ... and, for up to three
    /// coordinates, x, y, z.
    /// @throws Error(usage) "--OPTION: 'TEXT', column N: what is wrong; what is expected"
    Expression(std::string_view option, std::string_view text, std::size_t dimension)
        : Expression(option, text, dimension, nullptr) {}

    /// Formula in named coordinates. Names that are not valid variable names are quoted ("cross
    /// section"), and so are the words for values of coordinates: material == "steel".
    /// @throws Error(usage) as above
    Expression(std::string_view option, std::string_view text, const FormulaNames& names)
        : Expression(option, text, names.size(), &names) {}

    /// The formula without blanks.
    [[nodiscard]] const std::string& text() const { return text_; }
    [[nodiscard]] std::size_t dimension() const { return dimension_; }
    [[nodiscard]] const std::vector<FormulaStep>& steps() const { return steps_; }

    [[nodiscard]] double at(std::span<const double> point) const;

    /// Sets values[i] to the value at point i; points are stored one after another.
    void evaluate(std::span<const double> points, std::span<double> values) const;

    /// Value of the steps [first, last), which must not contain coordinates.
    [[nodiscard]] double constant(std::size_t first, std::size_t last) const;

  private:
    Expression(std::string_view option, std::string_view text, std::size_t dimension,
               const FormulaNames* names);

    std::string text_;
    std::size_t dimension_;
    std::vector<FormulaStep> steps_;
};

/// All operators and functions.
std::span<const FormulaOperation> formula_operations();

/// True if the text is a valid variable name without another meaning in formulas.
bool may_name_variable(std::string_view name);

/// A point for messages: "x = 0.5" or "(0.5, 2)".
std::string place_text(std::span<const double> point);

}  // namespace stipple
