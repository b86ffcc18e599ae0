// SPDX-License-Identifier: MIT
#include "report/check.hpp"

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
    const Report::Item* item = report.find(key);
    std::string word;
    if (item)
        if (const auto* text = std::get_if<std::string>(item)) word = *text;
    if (item)
        if (const auto* flag = std::get_if<bool>(item)) word = *flag ? "true" : "false";
    if (!word.empty()) {
        if (op != "==" && op != "!=")
            fail(ErrorKind::usage, "--check: '{}' is '{}', a word; compare it with == or !=", key,
                 word);
        return (word == value) == (op == "==");
    }
    const double found = report.number(key);
    const auto wanted = parse_number(value);
    if (!wanted)
        fail(ErrorKind::usage, "--check: '{}' is not a number to compare '{}' with", value, key);
    return compare(found, op, *wanted);
}

}  // namespace stipple
