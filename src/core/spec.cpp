// SPDX-License-Identifier: MIT
#include "core/spec.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

class SpecParser {
  public:
    explicit SpecParser(std::string_view text) : text_(text) {}

    Spec parse() {
        Spec spec;
        spec.name = take_until("@:");
        if (spec.name.empty()) complain("a unit's name is expected");
        if (accept('@')) spec.coordinates = coordinates();
        if (accept(':')) {
            do spec.settings.push_back(setting());
            while (accept(','));
        }
        if (at_ < text_.size()) complain("the end is expected");
        return spec;
    }

  private:
    [[noreturn]] void complain(std::string_view wanted) const {
        fail(ErrorKind::usage, "spec '{}', column {}: {}", text_, at_ + 1, wanted);
    }

    bool accept(char c) {
        if (at_ >= text_.size() || text_[at_] != c) return false;
        ++at_;
        return true;
    }

    std::string take_until(std::string_view ends) {
        const auto end = std::min(text_.find_first_of(ends, at_), text_.size());
        std::string part(text_.substr(at_, end - at_));
        at_ = end;
        return part;
    }

    std::vector<std::size_t> coordinates() {
        std::vector<std::size_t> list;
        const std::string text = take_until(":");
        for (const auto part : split(text, ',')) {
            const auto k = parse_integer(part);
            if (!k || *k < 1 || *k > 1'000'000) complain("coordinates such as 1,2 are expected");
            const auto index = static_cast<std::size_t>(*k - 1);
            if (std::ranges::find(list, index) != list.end()) complain("a coordinate occurs twice");
            list.push_back(index);
        }
        if (list.empty()) complain("coordinates such as 1,2 are expected");
        return list;
    }

    std::pair<std::string, std::string> setting() {
        std::string name = take_until("=,[]");
        if (name.empty()) complain("an option's name is expected");
        std::ranges::replace(name, '_', '-');  // names of Python arguments have underscores
        if (!accept('=')) return {std::move(name), "true"};
        if (!accept('[')) {
            std::string value = take_until(",[]");
            if (std::ranges::count(value, '(') > std::ranges::count(value, ')'))
                complain(fmt::format("a value with commas is written in brackets, {}=[...]", name));
            if (at_ < text_.size() && text_[at_] != ',') complain("',' or the end is expected");
            return {std::move(name), std::move(value)};
        }
        std::string value = bracketed();
        if (!accept(']')) complain("']' is missing");
        return {std::move(name), std::move(value)};
    }

    /// Text up to the ']' that closes the bracket just opened.
    std::string bracketed() {
        const std::size_t begin = at_;
        std::size_t open = 1;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '[') ++open;
            if (text_[at_] == ']' && --open == 0) break;
        }
        return std::string(text_.substr(begin, at_ - begin));
    }

    std::string_view text_;
    std::size_t at_ = 0;
};

/// Whether the text after a comma is a number, which cannot begin a spec, as in disk@1,2.
bool is_numeric(std::string_view rest) {
    return !rest.empty() && std::string_view("0123456789.+-").find(rest[0]) != rest.npos;
}

/// Whether the text after a comma is an option of the preceding spec: OPT=...
bool goes_on(std::string_view rest) {
    const auto end = rest.find_first_of("=,;:@[]");
    return end != std::string_view::npos && end > 0 && rest[end] == '=';
}

}  // namespace

Values Spec::values(const Schema& schema) const {
    Values values = schema.defaults();
    for (const auto& [option, text] : settings) {
        const auto* before = values.try_find(option);
        if (before != nullptr && before->given)
            fail(ErrorKind::usage, "{}: the option '{}' is given twice: {} and {}", name, option,
                 format_value(before->value), text);
        schema.set(values, option, text);
    }
    return values;
}

Spec parse_spec(std::string_view text) { return SpecParser(text).parse(); }

namespace {

/// Adds an option to a spec: the first after a colon, others after commas.
void add_setting(std::string& spec, std::string_view name, const std::string& value, bool first) {
    const bool brackets = value.find_first_of(", [") != std::string::npos;
    spec += fmt::format(fmt::runtime(brackets ? "{}{}=[{}]" : "{}{}={}"), first ? ':' : ',', name,
                        value);
}

}  // namespace

std::string format_spec(const Spec& spec) {
    std::string text = spec.name;
    if (!spec.coordinates.empty()) text += "@" + format_coordinates(spec.coordinates);
    for (const auto& [name, value] : spec.settings)
        add_setting(text, name, value, &name == &spec.settings.front().first);
    return text;
}

std::string format_spec(std::string_view name, const Values& values, const Schema& schema) {
    std::string spec(name);
    bool first = true;
    for (const Option& option : schema.options()) {
        const auto& item = values.find(option.name);
        const std::string text = format_value(item.value);
        // Compared as text: -0 equals 0, but is a different value. Optional options that are given
        // are always written.
        if (option.optional ? !item.given : text == format_value(option.fallback)) continue;
        add_setting(spec, option.name, text, std::exchange(first, false));
    }
    return spec;
}

std::vector<std::pair<std::string, std::string>> typed_settings(const Values& values,
                                                                const Schema& schema) {
    std::vector<std::pair<std::string, std::string>> settings;
    for (const Option& option : schema.options()) {
        const auto& item = values.find(option.name);
        if (!option.optional || item.given)
            settings.emplace_back(option.name, format_value(item.value));
    }
    return settings;
}

std::string format_coordinates(const std::vector<std::size_t>& coordinates) {
    std::vector<std::string> parts;
    for (const std::size_t k : coordinates) parts.push_back(std::to_string(k + 1));
    return join(parts, ",");
}

std::string short_specs(std::span<const std::string> specs) {
    constexpr std::size_t longest = 80;
    std::vector<std::string> all(specs.begin(), specs.end());
    for (std::string& spec : all)
        if (spec.size() > longest) spec.resize(std::min(spec.find(':'), spec.size()));
    return join(all, ", ");
}

std::vector<std::string> split_specs(std::string_view text, std::string_view who) {
    std::vector<std::string> specs;
    std::vector<std::size_t> open;
    std::size_t begin = 0;
    const auto cut = [&](std::size_t end) {
        const auto spec = trim(text.substr(begin, end - begin));
        if (spec.empty()) fail(ErrorKind::usage, "{}, column {}: a name is expected", who, end + 1);
        specs.emplace_back(spec);
        begin = end + 1;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '[') open.push_back(i);
        if (text[i] == ']' && open.empty())
            fail(ErrorKind::usage, "{}, column {}: this ']' has no '['", who, i + 1);
        if (text[i] == ']') open.pop_back();
        if (!open.empty() || (text[i] != ',' && text[i] != ';')) continue;
        const bool with_options = text.substr(begin, i - begin).find(':') != std::string::npos;
        const std::string_view rest = text.substr(i + 1);
        const bool continued = is_numeric(rest) || (with_options && goes_on(rest));
        if (text[i] == ';' || !continued) cut(i);
    }
    if (!open.empty())
        fail(ErrorKind::usage, "{}, column {}: this '[' has no ']'", who, open.back() + 1);
    cut(text.size());
    return specs;
}

}  // namespace stipple
