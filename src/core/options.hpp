// SPDX-License-Identifier: MIT
//
// Typed options of a unit, written down once: from a Schema come parsing, range checks and their
// messages, help, `list` and the tables of README.
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

/// One of a few words.
struct Choice {};
/// Any text.
struct Text {};
/// The name of a file.
struct Path {};
/// Numbers, separated by commas.
struct Numbers {};
/// Points: numbers separated by commas, points by blanks; "0,0 1,0 0,1".
struct Points {};
/// Whole numbers separated by x; "40x25".
struct Extents {};

/// Not a plain vector: a variant of these and strings alone is never valueless for libstdc++ 12, which
/// destroys what is not there when a copy of it runs out of memory.
struct Table : std::vector<std::vector<double>> {
    using vector::vector;
};

/// What an option can hold.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<double>, Table,
                           std::vector<std::int64_t>>;

/// The finite number that a text is, or that it is a formula of: 0.5, 1/3, sqrt(2)/2. Nothing where
/// it is neither. @throws Error(usage) naming the option and what is wrong with a formula
std::optional<double> parse_formula(std::string_view option, std::string_view text);

/// The value of a formula without variables. @throws Error(usage)
/// Not defined here, but where formulas of densities are (math/densities/expression.cpp).
double formula_value(std::string_view option, std::string_view text);

/// Numbers with commas, or for rows of a matrix blanks, between them; each as parse_formula() takes
/// it. @throws Error(usage)
std::vector<double> parse_numbers(std::string_view option, std::string_view text);

/// A value as one types it: true, 12, 0.5, polar, "0,0", "0,0 1,0", 40x25.
std::string format_value(const Value& value);

/// A number option: std::int64_t or double.
template <class T>
struct Param {
    static_assert(std::is_same_v<T, std::int64_t> || std::is_same_v<T, double>);
    using Held = T;
    std::string_view name;
    T fallback{};
    T low = std::numeric_limits<T>::lowest();
    T high = std::numeric_limits<T>::max();
    bool low_open = false;  ///< `low` itself is not allowed
    bool optional = false;  ///< has no default: ask Values::given
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
    std::string_view fallback{};  ///< none: the option is optional
    std::string_view choices;     ///< separated by |
    std::string_view help{};
};

namespace detail {
template <class T>
struct TextualParam {
    using Held = T;
    std::string_view name;
    std::string_view fallback{};  ///< none: the option is optional
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

/// The options of one unit with their values: a plain value.
class Values {
  public:
    struct Item {
        std::string name;
        Value value;
        bool given = false;  ///< set by the user, not by default
        bool operator==(const Item&) const = default;
    };

    /// The option's value; its type's empty value where it is optional and was not given.
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

    /// Sets an option, without checks; for a unit that writes down what it worked out.
    void put(std::string_view name, Value value, bool given = true);

    bool operator==(const Values&) const = default;

  private:
    std::vector<Item> items_;
};

/// One option as data, for parsing and for printing.
struct Option {
    std::string name;
    std::string type;  ///< flag, integer, number, choice, text, file, numbers, points, extents
    Value fallback;
    bool optional = false;
    double low = 0;   ///< of integer and number
    double high = 0;  ///< of integer and number
    bool low_open = false;
    std::vector<std::string> choices = {};
    std::string unit = {};
    std::string help = {};

    /// The value that `text` means. @throws Error(usage) saying what is allowed.
    [[nodiscard]] Value parse(std::string_view text) const;

    /// What is allowed: "[0, 10]", "polar|concentric", "numbers a,b,c", or nothing to say.
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
