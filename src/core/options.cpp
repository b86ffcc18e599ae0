// SPDX-License-Identifier: MIT
#include "core/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

std::vector<std::string> words(std::string_view text, char separator) {
    std::vector<std::string> out;
    for (const auto part : split(text, separator)) out.emplace_back(part);
    return out;
}

[[noreturn]] void refuse(const Option& option, std::string_view text, std::string_view wanted) {
    if (text == "true" && option.type != "flag")  // "disk:radius", without a value
        fail(ErrorKind::usage, "--{} needs a value", option.name);
    fail(ErrorKind::usage, "--{}: '{}' is not {}", option.name, text, wanted);
}

/// Whether a text that is not a number should be parsed as a formula: it contains '(' or an
/// operator other than a leading sign or the sign of an exponent, or it is the constant pi or e.
bool looks_like_formula(std::string_view text) {
    const auto digit = [&](std::size_t i) {
        return i < text.size() && (text[i] == '.' || (text[i] >= '0' && text[i] <= '9'));
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '(' || text[i] == '*' || text[i] == '/' || text[i] == '^') return true;
        const bool sign = i > 0 && (text[i] == '+' || text[i] == '-');
        const bool of_exponent = (text[i - sign] == 'e' || text[i - sign] == 'E') && digit(i - 2);
        if (sign && !of_exponent) return true;
    }
    if (text.starts_with('-') || text.starts_with('+')) text.remove_prefix(1);
    return text == "pi" || text == "e";
}

Table parse_points(const Option& option, std::string_view text) {
    Table points;
    for (const auto part : split(text, ' '))
        if (!trim(part).empty()) points.push_back(parse_numbers(option.name, trim(part)));
    if (points.empty()) refuse(option, text, "a list of points such as '0,0 1,0'");
    for (const auto& point : points)
        if (point.size() != points.front().size())
            refuse(option, text, "a list of points of one dimension");
    return points;
}

std::vector<std::int64_t> parse_extents(const Option& option, std::string_view text) {
    std::vector<std::int64_t> extents;
    for (const auto part : split(text, 'x')) {
        const auto value = parse_integer(part);
        if (!value || *value < 1) refuse(option, text, "a shape such as 40x25");
        extents.push_back(*value);
    }
    if (extents.empty()) refuse(option, text, "a shape such as 40x25");
    return extents;
}

void check_range(const Option& option, double value, std::string_view text) {
    const bool above = option.low_open ? value > option.low : value >= option.low;
    if (!above || !(value <= option.high))
        fail(ErrorKind::usage, "--{}: {} is outside {}", option.name, text, option.range());
}

bool parse_flag(const Option& option, std::string_view text) {
    if (text == "true" || text == "on" || text == "yes" || text == "1" || text.empty()) return true;
    if (text == "false" || text == "off" || text == "no" || text == "0") return false;
    refuse(option, text, "true or false");
}

template <class P>
Option textual(const P& param, const char* type) {
    Option option{.name = std::string(param.name), .type = type, .fallback = typename P::Held{}};
    option.unit = param.unit;
    option.help = param.help;
    option.optional = param.fallback.empty();
    if (!option.optional) option.fallback = option.parse(param.fallback);
    return option;
}

template <class P>
Option numeric(const P& param, const char* type) {
    return {.name = std::string(param.name),
            .type = type,
            .fallback = param.fallback,
            .optional = param.optional,
            .low = static_cast<double>(param.low),
            .high = static_cast<double>(param.high),
            .low_open = param.low_open,
            .unit = std::string(param.unit),
            .help = std::string(param.help)};
}

std::string format_bound(double bound, bool integer) {
    if (bound <= std::numeric_limits<double>::lowest() || (integer && bound <= -0x1p63))
        return "-inf";
    if (bound >= std::numeric_limits<double>::max() || (integer && bound >= 0x1p63)) return "inf";
    return integer ? fmt::format("{:.0f}", bound) : format_number(bound);
}

}  // namespace

std::string format_value(const Value& value) {
    struct {
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(std::int64_t i) const { return std::to_string(i); }
        std::string operator()(double x) const { return format_number(x); }
        std::string operator()(const std::string& s) const { return s; }
        std::string operator()(const std::vector<double>& v) const { return join(v, ","); }
        std::string operator()(const Table& rows) const {
            std::vector<std::string> parts;
            for (const auto& row : rows) parts.push_back(join(row, ","));
            return join(parts, " ");
        }
        std::string operator()(const std::vector<std::int64_t>& v) const { return join(v, "x"); }
    } text;
    return std::visit(text, value);
}

std::optional<double> parse_formula(std::string_view option, std::string_view text) {
    if (const auto number = parse_number(text)) return number;
    if (!looks_like_formula(text)) return std::nullopt;
    const double value = formula_value(option, text);
    if (!std::isfinite(value))
        fail(ErrorKind::usage, "--{}: '{}' is not a finite number", option, text);
    return value;
}

std::vector<double> parse_numbers(std::string_view option, std::string_view text) {
    std::vector<double> numbers;
    const auto refuse_list = [&] {
        Option numbers_option;
        numbers_option.name = option;
        refuse(numbers_option, text, "a list of numbers such as 0.5,1");
    };
    for (const auto part : split_outside("()", text, ",")) {
        const std::size_t before = numbers.size();
        for (const auto word : split_outside("()", trim(part), " ")) {
            auto value = parse_number(word);
            if (const auto whole = parse_integer(word); whole && !value)  // 2^20, 64k
                value = static_cast<double>(*whole);
            if (!value) value = parse_formula(option, word);
            if (value) numbers.push_back(*value);
            if (!value && !word.empty()) refuse_list();
        }
        if (numbers.size() == before) refuse_list();
    }
    if (numbers.empty()) refuse_list();
    return numbers;
}

const Values::Item* Values::try_find(std::string_view name) const {
    const auto it = std::ranges::find(items_, name, &Item::name);
    return it == items_.end() ? nullptr : &*it;
}

const Values::Item& Values::find(std::string_view name) const {
    const Item* item = try_find(name);
    if (item == nullptr) fail(ErrorKind::usage, "--{}: no such option here", name);
    return *item;
}

void Values::put(std::string_view name, Value value, bool given) {
    const auto it = std::ranges::find(items_, name, &Item::name);
    if (it == items_.end())
        items_.push_back({std::string(name), std::move(value), given});
    else
        *it = {std::string(name), std::move(value), given};
}

Value Option::parse(std::string_view text) const {
    if (type == "flag") return parse_flag(*this, text);
    if (type == "integer") {
        const auto value = parse_integer(text);
        if (!value && parse_number(text)) {
            const double number = *parse_number(text);
            if (number == std::floor(number)) check_range(*this, number, text);
        }
        if (!value) refuse(*this, text, "a whole number");
        check_range(*this, static_cast<double>(*value), text);
        return *value;
    }
    if (type == "number") {
        const auto value = parse_formula(name, text);
        if (!value) refuse(*this, text, "a finite number");
        check_range(*this, *value, text);
        return *value;
    }
    if (type == "choice") {
        if (std::ranges::find(choices, text) == choices.end()) {
            fail_with_hint(ErrorKind::usage,
                           nearest_words(text, choices).empty() ? "" : suggest(text, choices),
                           "--{}: '{}' is not one of {}", name, text, join(choices, ", "));
        }
        return std::string(text);
    }
    if (type == "numbers") return parse_numbers(name, text);
    if (type == "points") return parse_points(*this, text);
    if (type == "extents") return parse_extents(*this, text);
    if (text.empty())
        fail(ErrorKind::usage, "--{}: is empty; expected {}", name,
             type == "file" ? "a file name" : "a text");
    return std::string(text);
}

std::string Option::range() const {
    if (type == "choice") return join(choices, "|");
    if (type != "integer" && type != "number") return {};
    const bool integer = type == "integer";
    const std::string from = format_bound(low, integer);
    const std::string to = format_bound(high, integer);
    if (from == "-inf" && to == "inf") return {};
    return fmt::format("{}{}, {}{}", low_open || from == "-inf" ? "(" : "[", from, to,
                       to == "inf" ? ")" : "]");
}

Option describe(const Param<bool>& param) {
    return {.name = std::string(param.name),
            .type = "flag",
            .fallback = false,
            .help = std::string(param.help)};
}
Option describe(const Param<std::int64_t>& param) { return numeric(param, "integer"); }
Option describe(const Param<double>& param) { return numeric(param, "number"); }
Option describe(const Param<Choice>& param) {
    return {.name = std::string(param.name),
            .type = "choice",
            .fallback = std::string(param.fallback),
            .optional = param.fallback.empty(),
            .choices = words(param.choices, '|'),
            .help = std::string(param.help)};
}
Option describe(const Param<Text>& param) { return textual(param, "text"); }
Option describe(const Param<Path>& param) { return textual(param, "file"); }
Option describe(const Param<Numbers>& param) { return textual(param, "numbers"); }
Option describe(const Param<Points>& param) { return textual(param, "points"); }
Option describe(const Param<Extents>& param) { return textual(param, "extents"); }

Values Schema::defaults() const {
    Values values;
    for (const Option& option : options_) values.put(option.name, option.fallback, false);
    return values;
}

std::vector<std::string> Schema::names() const {
    std::vector<std::string> names;
    for (const Option& option : options_) names.push_back(option.name);
    return names;
}

void Schema::set(Values& values, std::string_view name, std::string_view text) const {
    const auto it = std::ranges::find(options_, name, &Option::name);
    if (it == options_.end()) {
        const auto known = names();
        fail_with_hint(ErrorKind::usage,
                       known.empty() ? "it takes no options" : suggest(name, known),
                       "unknown option '{}'", name);
    }
    values.put(name, it->parse(text));
}

}  // namespace stipple
