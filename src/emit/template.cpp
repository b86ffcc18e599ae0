// SPDX-License-Identifier: MIT
#include "emit/template.hpp"

#include <algorithm>
#include <cctype>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::emit {
namespace {

/// Returns the text before the separator, and removes both from `text`.
std::string_view take(std::string_view& text, char separator) {
    const auto end = std::min(text.find(separator), text.size());
    const std::string_view front = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    return front;
}

}  // namespace

Template::Template(std::string_view library, std::string prefix) : prefix_(std::move(prefix)) {
    constexpr std::string_view begin = "%part ";
    while (library.starts_with(begin)) {
        library.remove_prefix(begin.size());
        const std::string_view name = take(library, '\n');
        const auto end = std::min(library.find("\n%part "), library.size() - 1);
        parts_.emplace(name, library.substr(0, end + 1));
        library.remove_prefix(end + 1);
    }
}

const std::string* Template::find(std::string_view key, const Words& words) {
    used_.emplace(key);
    const auto found = words.find(key);
    return found == words.end() ? nullptr : &found->second;
}

bool Template::holds(std::string_view condition, const Words& words) {
    const std::string* value = find(take(condition, ' '), words);
    if (value == nullptr || condition.empty()) return value != nullptr;
    return std::ranges::count(split(condition, ' '), *value) > 0;
}

std::string Template::replaced(std::string_view line, const Words& words) {
    std::string out;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const std::string_view rest = line.substr(i);
        if (rest.starts_with("@@")) {
            out += prefix_;
            ++i;
        } else if (rest.size() > 1 && rest[0] == '@' && std::isalpha(rest[1]) != 0) {
            out += prefix_ + "_";
        } else if (rest.starts_with("{{")) {
            const std::string_view key = rest.substr(2, rest.find("}}") - 2);
            const std::string* value = find(key, words);
            if (value == nullptr) fail(ErrorKind::usage, "emit: no value of {}", key);
            std::string text = *value;
            replace_all(text, "\n", "\n" + std::string(line.substr(0, i)));
            out += text;
            i += key.size() + 3;
        } else {
            out += line[i];
        }
    }
    return out;
}

void Template::control(std::string_view line, const Words& words) {
    const std::string_view what = take(line, ' ');
    if (what == "%need" && needed_.insert(parts_.find(line)->first).second) add(line, words);
    if (what == "%use")
        for (const auto key : split(line, ' ')) used_.emplace(key);
    if (what == "%limit") {
        const std::string_view key = take(line, ' ');
        const std::string* value = find(key, words);
        if (value != nullptr && parse_unsigned(*value) > parse_unsigned(line))
            fail(ErrorKind::usage, "--{}: {} is more than {}, the most that can be emitted", key,
                 *value, line);
    }
    if (what == "%refuse") fail(ErrorKind::usage, "{}", replaced(line, words));
}

std::string Template::filled(std::string_view part, const Words& words) {
    std::string out;
    std::vector<bool> kept;  // for each enclosing %if, whether its lines are kept
    for (std::string_view rest = parts_.find(part)->second; !rest.empty();) {
        std::string_view line = take(rest, '\n');
        const bool here = std::ranges::all_of(kept, [](bool keep) { return keep; });
        if (line.starts_with("%if "))
            kept.push_back(here && holds(line.substr(4), words));
        else if (line == "%else")
            kept.back() = !kept.back();
        else if (line == "%end")
            kept.pop_back();
        else if (here && line.starts_with('%'))
            control(line, words);
        else if (here)
            out += replaced(line, words) + "\n";
    }
    return out;
}

void Template::add(std::string_view part, const Words& words) {
    const std::string own = filled(part, words);
    if (!text_.empty()) text_ += gap;
    text_ += own;
}

}  // namespace stipple::emit
