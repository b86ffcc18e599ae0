// SPDX-License-Identifier: MIT
//
// Typed options of a unit, defined once: a Schema provides parsing, range checks with their
// messages, help, `list` and the tables of the guide.
//
//     constexpr Param<std::int64_t> start{.name = "start", .low = 0, .high = 9, .help = "..."};
//     const Schema schema(start);
//     Values values = schema.defaults();
//     schema.set(values, "start", "7");
//     values[start]  ->  7
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

namespace stipple {

/// One of a fixed set of words.
struct Choice {};
struct Text {};
struct Path {};
/// Numbers, separated by commas.
struct Numbers {};
/// Points: numbers separated by commas, points by blanks; "0,0 1,0 0,1".
struct Points {};
/// Whole numbers separated by x; "40x25".
struct Extents {};

/// Rows of numbers. Not a plain vector, since libstdc++ 12 assumes that a variant of only vectors
/// and strings always holds a value: if a copy runs out of memory, it destroys a missing value.
struct Table : std::vector<std::vector<double>> {
    using vector::vector;
};

using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, Table,
                           std::vector<std::int64_t>>;

/// Parses a finite number or a formula with a finite value: 0.5, 1/3, sqrt(2)/2. Returns nullopt if
/// the text is neither. @throws Error(usage) naming the option and the error in the formula
std::optional<double> parse_formula(std::string_view option, std::string_view text);

/// Value of a formula without variables. Defined in math/densities/expression.cpp, with the
/// formulas of densities. @throws Error(usage)
double formula_value(std::string_view option, std::string_view text);

/// Parses numbers separated by commas, or by blanks in rows of a matrix; each may be a formula, as
/// in parse_formula(). @throws Error(usage)
std::vector<double> parse_numbers(std::string_view option, std::string_view text);

/// Formats a value as users type it: true, 12, 0.5, polar, "0,0", "0,0 1,0", 40x25.
std::string format_value(const Value& value);

/// An option with a value of type std::int64_t or double.
template <class T>
struct Param {
    static_assert(std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>);
    using Held = T;
    std::string_view name;
    T fallback{};
    T low = std::numeric_limits<T>::lowest();
    T high = std::numeric_limits<T>::max();
    bool low_open = false;  ///< excludes `low` itself
    bool optional = false;  ///< has no default; check Values::given
    std::string_view unit{};
    std::string_view help{};
};

/// A flag, off by default.
template <>
struct Param<bool> {
    using Held = bool;
    std::string_view name;
    std::string_view help{};
};

template <>
struct Param<Choice> {
    using Held = std::string;
    std::string_view name;
    std::string_view fallback{};  ///< empty: the option is optional
    std::string_view choices;     ///< separated by |
    std::string_view help{};
};

namespace detail {
template <class T>
struct TextualParam {
    using Held = T;
    std::string_view name;
    std::string_view fallback{};  ///< empty: the option is optional
    std::string_view unit{};
    std::string_view help{};
};
}  // namespace detail

template <>
struct Param<Text> : detail::TextualParam<std::string> {};
template <>
struct Param<Path> : detail::TextualParam<std::string> {};
template <>
struct Param<Numbers> : detail::TextualParam<std::vector<double>> {};
template <>
struct Param<Points> : detail::TextualParam<Table> {};
template <>
struct Param<Extents> : detail::TextualParam<std::vector<std::int64_t>> {};

/// Option values of one unit.
class Values {
  public:
    struct Item {
        std::string name;
        Value value;
        bool given = false;  ///< set by the user, not the default
        bool operator==(const Item&) const = default;
    };

    /// The option's value; an empty or zero value if the option is optional and was not given.
    template <class T>
    [[nodiscard]] typename Param<T>::Held operator[](const Param<T>& param) const {
        return std::get<typename Param<T>::Held>(find(param.name).value);
    }

    /// Whether the user set the option.
    template <class T>
    [[nodiscard]] bool given(const Param<T>& param) const {
        return find(param.name).given;
    }

    [[nodiscard]] const Item& find(std::string_view name) const;
    [[nodiscard]] const Item* try_find(std::string_view name) const;
    [[nodiscard]] const std::vector<Item>& items() const { return items_; }

    /// Sets an option without checks; units record computed values in this way.
    void put(std::string_view name, Value value, bool given = true);

    bool operator==(const Values&) const = default;

  private:
    std::vector<Item> items_;
};

/// Description of one option, for parsing and for help.
struct Option {
    std::string name;
    std::string type;  ///< flag, integer, number, choice, text, file, numbers, points, extents
    Value fallback;
    bool optional = false;
    double low = 0;   ///< smallest value, for integer and number
    double high = 0;  ///< largest value, for integer and number
    bool low_open = false;
    std::vector<std::string> choices = {};
    std::string unit = {};
    std::string help = {};

    /// Parses a value. @throws Error(usage) that states what is allowed
    [[nodiscard]] Value parse(std::string_view text) const;

    /// Allowed values: "[0, 10]", "polar|concentric"; empty if there is no limit.
    [[nodiscard]] std::string range() const;
};

Option describe(const Param<bool>& param);
Option describe(const Param<std::int64_t>& param);
Option describe(const Param<double>& param);
Option describe(const Param<Choice>& param);
Option describe(const Param<Text>& param);
Option describe(const Param<Path>& param);
Option describe(const Param<Numbers>& param);
Option describe(const Param<Points>& param);
Option describe(const Param<Extents>& param);

class Schema {
  public:
    template <class... Params>
    explicit Schema(const Params&... params) : options_{describe(params)...} {}

    [[nodiscard]] const std::vector<Option>& options() const { return options_; }
    [[nodiscard]] Values defaults() const;

    /// Sets option `name` from its text. @throws Error(usage): unknown option, out of range.
    void set(Values& values, std::string_view name, std::string_view text) const;

    [[nodiscard]] std::vector<std::string> names() const;

  private:
    std::vector<Option> options_;
};

}  // namespace stipple
