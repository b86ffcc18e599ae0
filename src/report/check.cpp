// SPDX-License-Identifier: MIT
#include "report/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "report/document.hpp"

namespace stipple {
namespace {

constexpr std::array<std::string_view, 6> operators = {"<", "<=", ">", ">=", "==", "!="};

bool compare(double a, std::string_view op, double b) {
    if (op == "!=") return a != b;
    return (op[0] == '<' && a < b) || (op[0] == '>' && a > b) || (op.ends_with('=') && a == b);
}

/// Throws an Error(usage) for a condition.
template <class... Args>
[[noreturn]] void refuse(const Check& check, fmt::format_string<Args...> what, Args&&... args) {
    fail(ErrorKind::usage, "{}: {}", check.option, fmt::format(what, std::forward<Args>(args)...));
}

/// The number under a key: "value" or, in a list, "mean[0]".
double number_of(const Check& check, const Report& report, std::string_view key) {
    const auto open = key.find('[');
    const std::string_view name = key.substr(0, open);
    if (report.find(name) == nullptr)
        fail_with_hint(ErrorKind::usage, suggest(name, report.keys()),
                       "{}: there is no result '{}'", check.option, key);
    const auto list = list_at(report, name);
    if (list && open == std::string_view::npos)
        refuse(check, "'{}' has {} numbers; choose one, such as {}[0]", key, list->size(), key);
    if (!list || !key.ends_with(']')) return report.number(key);
    const auto index = parse_unsigned(key.substr(open + 1, key.size() - open - 2));
    if (!index || *index >= list->size())
        refuse(check, "'{}' is not a key; {} has {} numbers, [0] to [{}]", key, name, list->size(),
               list->size() - 1);
    return (*list)[*index];
}

struct Range {
    double lower;
    double upper;
};

/// The bounds "lower" and "upper" next to a "value"; nullopt if there are none.
std::optional<Range> bounds_of(const Check& check, const Report& report) {
    const std::string path = check.key.substr(0, check.key.find('['));
    const std::string index = check.key.substr(path.size());
    const std::string group = path.substr(0, path.rfind('.') + 1);
    const auto has = [&](const char* name) { return report.find(group + name) != nullptr; };
    if (path != group + "value" || !has("lower") || !has("upper")) return {};
    return Range{number_of(check, report, group + "lower" + index),
                 number_of(check, report, group + "upper" + index)};
}

/// Number to compare. For a `value` with bounds: the upper bound for < and <=, else the lower one.
double bounded(const Check& check, const Report& report) {
    const bool known = report.find(check.key.substr(0, check.key.find('['))) != nullptr;
    const double found = known ? number_of(check, report, check.key) : 0;
    const auto range = bounds_of(check, report);
    if (!range || range->lower == range->upper)
        return known ? found : number_of(check, report, check.key);
    if (check.op[0] == '<') return range->upper;
    if (check.op[0] == '>') return range->lower;
    refuse(check,
           "'{}' is only known to be between {} and {}; compare it with <, <=, > or >=", check.key,
           format_number(range->lower), format_number(range->upper));
}

/// The text or flag under a key; empty if there is none.
std::string word_of(const Report& report, const std::string& key) {
    const Report::Item* item = report.find(key);
    if (const auto* text = std::get_if<std::string>(item)) return *text;
    if (const auto* flag = std::get_if<bool>(item)) return *flag ? "true" : "false";
    return {};
}

/// The operator that a user of another language means, such as == for ===; empty if unknown.
std::string_view meant_by(std::string_view op) {
    constexpr std::array<std::pair<std::string_view, std::string_view>, 5> known = {
        {{"=", "=="}, {"===", "=="}, {"=<", "<="}, {"=>", ">="}, {"<>", "!="}}};
    for (const auto& [typed, meant] : known)
        if (op == typed) return meant;
    return {};
}

/// Lists words: "uniform, non-uniform or stratified".
std::string listed(const std::vector<std::string_view>& words) {
    const std::vector<std::string> most(words.begin(), words.end() - 1);
    return fmt::format("{} or {}", join(most, ", "), words.back());
}

}  // namespace

Check parse_check(std::string_view text, const std::string& option) {
    const auto at = text.find_first_of("<>=!");
    const auto last = text.find_first_not_of("<>=!", at);
    Check check{.option = option};
    if (at != std::string_view::npos && last != std::string_view::npos) {
        check.key = trim(text.substr(0, at));
        check.op = text.substr(at, last - at);
        check.value = trim(text.substr(last));
    }
    const bool known = std::ranges::find(operators, check.op) != operators.end();
    const auto meant = meant_by(check.op);
    if (check.key.empty() || check.value.empty() || !known)
        fail_with_hint(
            ErrorKind::usage, meant.empty() ? "" : fmt::format("did you mean '{}'?", meant),
            "{}: '{}' is not KEY<VALUE; expected one of <, <=, >, >=, == or !=", option, text);
    return check;
}

void require_sense(const Check& check, const ResultKey& result) {
    const auto words = split(result.words, '|');
    if (words.empty()) return;
    if (check.op != "==" && check.op != "!=")
        refuse(check, "'{}' is {}; compare it with == or !=", check.key, listed(words));
    if (std::ranges::find(words, check.value) == words.end())
        refuse(check, "'{}' cannot be '{}'; possible values: {}", check.key, check.value,
               listed(words));
}

bool Check::holds(const Report& report) const {
    const std::string word = word_of(report, key);
    if (!word.empty()) {
        if (op != "==" && op != "!=")
            refuse(*this, "'{}' is '{}', which is text; compare it with == or !=", key, word);
        return (word == value) == (op == "==");
    }
    const double found = bounded(*this, report);
    const auto wanted = parse_number(value);
    if (!wanted)
        refuse(*this, "'{}' is not a number, so that '{}' cannot be compared with it", value, key);
    return compare(found, op, *wanted);
}

std::string Check::found(const Report& report) const {
    std::string word = word_of(report, key);
    if (!word.empty()) return word;
    const auto range = bounds_of(*this, report);
    if (range && range->lower < range->upper)
        return fmt::format("between {} and {}", format_number(range->lower),
                           format_number(range->upper));
    return format_number(number_of(*this, report, key));
}

}  // namespace stipple
