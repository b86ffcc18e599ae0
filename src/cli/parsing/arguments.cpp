// SPDX-License-Identifier: MIT
#include "cli/parsing/arguments.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::cli {

bool Arguments::has(std::string_view name) const { return get(name).has_value(); }

std::optional<std::string> Arguments::get(std::string_view name) const {
    const auto texts = all(name);
    return texts.empty() ? std::nullopt : std::optional(texts.back());
}

std::vector<std::string> Arguments::all(std::string_view name) const {
    std::vector<std::string> texts;
    for (const auto& [option, text] : common)
        if (option == name) texts.push_back(text);
    return texts;
}

void Arguments::refuse(std::initializer_list<std::string_view> names, std::string_view why) const {
    for (const auto name : names)
        if (has(name)) fail(ErrorKind::usage, "--{}: {}", name, why);
}

std::optional<std::uint64_t> Arguments::integer(std::string_view name, std::uint64_t low,
                                                std::uint64_t high) const {
    const auto text = get(name);
    if (!text) return std::nullopt;
    const auto value = parse_unsigned(*text);
    if (value && *value >= low && *value <= high) return value;
    const auto number = parse_number(*text);
    if (!value && (!number || *number != std::floor(*number)))
        fail(ErrorKind::usage, "--{}: '{}' is not a whole number, such as 1000, 1e6, 2^20 or 64k",
             name, *text);
    fail(ErrorKind::usage, "--{}: {} is outside [{}, {}]", name, *text, low, high);
}

std::optional<std::uint64_t> Arguments::integer(std::string_view name) const {
    if (!has(name)) return std::nullopt;
    const Option& option = find_common("--" + std::string(name), *verb)->option;
    return integer(name, static_cast<std::uint64_t>(option.low),
                   static_cast<std::uint64_t>(option.high));
}

void check_choices(const Arguments& arguments) {
    for (const auto& [name, text] : arguments.common) {
        const CommonOption* common = find_common("--" + name, *arguments.verb);
        if (common != nullptr && common->option.type == "choice")
            static_cast<void>(common->option.parse(text));
    }
}

}  // namespace stipple::cli
