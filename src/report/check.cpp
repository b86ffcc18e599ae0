// SPDX-License-Identifier: MIT
#include "report/check.hpp"

#include <fmt/format.h>

#include <optional>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

bool compare(double a, const std::string& op, double b) {
    if (op == "<") return a < b;
    if (op == "<=") return a <= b;
    if (op == ">") return a > b;
    if (op == ">=") return a >= b;
    if (op == "==") return a == b;
    return a != b;
}

/// The number that a key means: "value" or, of several, "mean[0]".
double number_of(const Report& report, std::string_view key) {
    const auto open = key.find('[');
    const Report::Item* item = report.find(key.substr(0, open));
    const auto refuse_list = [&](const auto& numbers) {
        fail(ErrorKind::usage, "--check: '{}' has {} numbers; one of them is {}[0]", key,
             numbers.size(), key);
    };
    if (item != nullptr && open == std::string_view::npos) {
        if (const auto* curve = std::get_if<Report::Curve>(item)) refuse_list(*curve);
        if (const auto* whole = std::get_if<Report::Integers>(item)) refuse_list(*whole);
    }
    if (open == std::string_view::npos || !key.ends_with(']') || item == nullptr)
        return report.number(key);
    const auto index = parse_unsigned(key.substr(open + 1, key.size() - open - 2));
    const auto pick = [&](const auto& numbers) {
        if (!index || *index >= numbers.size())
            fail(ErrorKind::usage, "--check: '{}' is no key; {} has {} numbers, [0] to [{}]", key,
                 key.substr(0, open), numbers.size(), numbers.size() - 1);
        return static_cast<double>(numbers[*index]);
    };
    if (const auto* curve = std::get_if<Report::Curve>(item)) return pick(*curve);
    if (const auto* whole = std::get_if<Report::Integers>(item)) return pick(*whole);
    return report.number(key);
}

struct Range {
    double lower;
    double upper;
};

/// The bounds beside a `value`, where it stands beside a `lower` and an `upper` one.
std::optional<Range> bounds_of(const Report& report, const std::string& key) {
    const std::string path = key.substr(0, key.find('['));
    const std::string index = key.substr(path.size());
    const std::string group = path.substr(0, path.rfind('.') + 1);
    const auto has = [&](const char* name) { return report.find(group + name) != nullptr; };
    if (path != group + "value" || !has("lower") || !has("upper")) return {};
    return Range{number_of(report, group + "lower" + index),
                 number_of(report, group + "upper" + index)};
}

/// What a condition on a `value` is about: it must hold for both bounds.
double bounded(const Report& report, const std::string& key, const std::string& op, double found) {
    const auto range = bounds_of(report, key);
    if (!range) return found;
    if (op == "<" || op == "<=") return range->upper;
    if (op == ">" || op == ">=") return range->lower;
    if (range->lower == range->upper) return found;
    fail(ErrorKind::usage,
         "--check: '{}' is only known to be between {} and {}; compare it with <, <=, > or >=", key,
         format_number(range->lower), format_number(range->upper));
}

/// The word or flag under a key; empty if it is none.
std::string word_of(const Report& report, const std::string& key) {
    const Report::Item* item = report.find(key);
    if (item == nullptr) return {};
    if (const auto* text = std::get_if<std::string>(item)) return *text;
    if (const auto* flag = std::get_if<bool>(item)) return *flag ? "true" : "false";
    return {};
}

}  // namespace

Check parse_check(std::string_view text) {
    const auto at = text.find_first_of("<>=!");
    const auto last = text.find_first_not_of("<>=!", at);
    Check check;
    if (at != std::string_view::npos && last != std::string_view::npos) {
        check.key = trim(text.substr(0, at));
        check.op = text.substr(at, last - at);
        check.value = trim(text.substr(last));
    }
    if (check.op == "=") check.op = "==";
    const bool known = check.op == "<" || check.op == "<=" || check.op == ">" || check.op == ">=" ||
                       check.op == "==" || check.op == "!=";
    if (check.key.empty() || check.value.empty() || !known)
        fail(ErrorKind::usage, "--check: '{}' is not KEY<VALUE; with <, <=, >, >=, == or !=", text);
    return check;
}

bool Check::holds(const Report& report) const {
    const std::string word = word_of(report, key);
    if (!word.empty()) {
        if (op != "==" && op != "!=")
            fail(ErrorKind::usage, "--check: '{}' is '{}', a word; compare it with == or !=", key,
                 word);
        return (word == value) == (op == "==");
    }
    const double found = bounded(report, key, op, number_of(report, key));
    const auto wanted = parse_number(value);
    if (!wanted)
        fail(ErrorKind::usage, "--check: '{}' is not a number to compare '{}' with", value, key);
    return compare(found, op, *wanted);
}

std::string Check::found(const Report& report) const {
    std::string word = word_of(report, key);
    if (!word.empty()) return word;
    const auto range = bounds_of(report, key);
    if (range && range->lower < range->upper)
        return fmt::format("between {} and {}", format_number(range->lower),
                           format_number(range->upper));
    return format_number(number_of(report, key));
}

}  // namespace stipple
