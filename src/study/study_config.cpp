// SPDX-License-Identifier: MIT
#include "study/study_config.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <unordered_set>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"

namespace stipple {
namespace {

/// Values of a key: specs, one or a list; items (words or numbers), one or a list; a boolean.
enum class Holds { specs, items, flag };

struct Key {
    const char* name;
    Holds holds;
};

constexpr std::array config_keys = {
    Key{"generators", Holds::specs}, Key{"analyze", Holds::specs},
    Key{"warp", Holds::specs},       Key{"count", Holds::items},
    Key{"dimension", Holds::items},  Key{"seed", Holds::items},
    Key{"seeds", Holds::items},      Key{"keys", Holds::items},
    Key{"curves", Holds::flag},      Key{"time-limit", Holds::items},
    Key{"seconds", Holds::flag},     Key{"summary", Holds::flag},
    Key{"pairs", Holds::items},      Key{"confidence", Holds::items},
    Key{"bootstrap", Holds::items},  Key{"output", Holds::items},
    Key{"format", Holds::items},     Key{"parameters", Holds::items},
    Key{"wide", Holds::flag},        Key{"meta", Holds::flag}};

constexpr std::array remarks = {"$schema", "comment"};

/// Checks the options of a spec. @throws Error
void check_unit(std::string_view key, std::string_view text) {
    if (key == "generators") {
        const GeneratorSpec asked = parse_generator(text);
        (void)asked.unit.values(find_generator(asked.unit.name).options);
        for (const std::string& warp : asked.warps) check_unit("warp", warp);
        return;
    }
    const Spec spec = parse_spec(text);
    if (key == "analyze") (void)spec.values(find_analyzer(spec.name).options);
    if (key != "warp") return;
    const Scramble* scramble = scramble_named(spec.name);
    (void)spec.values(scramble ? scramble->options : find_warp(spec.name).options);
}

class ConfigReader {
  public:
    explicit ConfigReader(std::string source) : source_(std::move(source)) {}

    StudySettings read(std::string_view text) {
        const Json root = parse_written_json(text, source_);
        if (!root.is_object()) refuse("$", "expected an object, {\"generators\": ...}");
        for (const auto& [name, value] : root.items()) {
            if (std::ranges::find(remarks, name) != remarks.end()) continue;
            const auto* key = std::ranges::find(config_keys, name, &Key::name);
            if (key == config_keys.end())
                refuse(path("$", name), "there is no such key", suggest(name, study_config_keys()));
            read_key(*key, value, path("$", name));
        }
        for (const char* needed : {"generators", "analyze"})
            if (!root.contains(needed)) refuse("$", fmt::format("the key '{}' is missing", needed));
        return std::move(settings_);
    }

  private:
    [[noreturn]] void refuse(const std::string& where, const std::string& what,
                             std::string hint = {}) const {
        throw Error(ErrorKind::input, fmt::format("{}: {}: {}", source_, where, what),
                    std::move(hint));
    }

    /// Runs a check, and adds the position to its error.
    void checked(const std::string& where, const std::function<void()>& check) const {
        try {
            check();
        } catch (const Error& e) {
            refuse(where, e.what(), e.hint());
        }
    }

    static std::string path(const std::string& parent, const std::string& key) {
        return fmt::format("{}.{}", parent, key);
    }

    void read_key(const Key& key, const Json& value, const std::string& where) {
        const std::string name = key.name;
        if (key.holds == Holds::specs) return read_units(name, value, where);
        if (key.holds == Holds::items) {
            settings_.emplace_back(name, option_text(value, where));
            return;
        }
        if (!value.is_boolean())
            refuse(where, fmt::format("expected true or false, got {}", shown(json_text(value))));
        // Only "seconds" is true by default; if false, it becomes the flag --no-seconds.
        const bool left_out = name == "seconds";
        if (value.get<bool>() != left_out)
            settings_.emplace_back(left_out ? "no-seconds" : name, "true");
    }

    void read_units(const std::string& key, const Json& value, const std::string& where) {
        if (value.is_string() || value.is_object()) return read_unit(key, value, where);
        if (!value.is_array() || (value.empty() && key != "warp"))
            refuse(where, "expected a list of specs such as \"sobol:scramble=owen\"");
        for (std::size_t i = 0; i < value.size(); ++i)
            read_unit(key, value[i], fmt::format("{}[{}]", where, i));
    }

    void read_unit(const std::string& key, const Json& value, const std::string& where) {
        if (!value.is_string() && !value.is_object())
            refuse(where, "expected a spec or {\"name\": ..., \"options\": {...}}, got " +
                              shown(json_text(value)));
        const std::string text =
            value.is_string() ? value.get<std::string>() : spec_of(key, value, where);
        checked(where, [&] { check_unit(key, text); });
        settings_.emplace_back(key, text);
    }

    /// Spec of {"name": ..., "options": {...}}.
    std::string spec_of(const std::string& key, const Json& object,
                        const std::string& where) const {
        const std::vector<std::string> known = {"name", "options"};
        for (const auto& [name, value] : object.items())
            if (std::ranges::find(known, name) == known.end())
                refuse(path(where, name), "there is no such key", suggest(name, known));
        if (!object.contains("name") || !object["name"].is_string())
            refuse(where, "the key 'name' is missing, or is not a string");
        const auto name = object["name"].get<std::string>();
        if (!object.contains("options")) return name;
        const Json& options = object["options"];
        if (!options.is_object()) refuse(path(where, "options"), "expected an object");
        std::string text = name;
        char separator = ':';
        for (const auto& [option, value] : options.items()) {
            const std::string place = path(path(where, "options"), option);
            const std::string setting = fmt::format("{}=[{}]", option, option_text(value, place));
            checked(place, [&] { check_unit(key, fmt::format("{}:{}", name, setting)); });
            text += separator;
            text += setting;
            separator = ',';
        }
        return text;
    }

    /// Returns a value as it would be typed: numbers of a list are separated by commas, points by
    /// blanks.
    std::string option_text(const Json& value, const std::string& where, int lists = 2) const {
        if (value.is_string()) return value.get<std::string>();
        if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
        if (value.is_number_float()) return format_number(value.get<double>());
        if (value.is_number()) return json_text(value);
        if (!value.is_array() || lists == 0)
            refuse(where, "expected a word, a number, true, false or a list, got " +
                              shown(json_text(value)));
        std::string text;
        for (const Json& item : value) {
            if (!text.empty()) text += item.is_array() ? ' ' : ',';
            text += option_text(item, where, lists - 1);
        }
        return text;
    }

    std::string source_;
    StudySettings settings_;
};

}  // namespace

StudySettings parse_study_config(std::string_view json, const std::string& source) {
    return ConfigReader(source).read(json);
}

std::vector<std::string> study_config_keys() {
    std::vector<std::string> names;
    for (const Key& key : config_keys) names.emplace_back(key.name);
    return names;
}

namespace {

/// Whether a number is a power of a base of 2 or more.
bool is_power(std::uint64_t number, std::uint64_t base) {
    while (number > 1 && number % base == 0) number /= base;
    return number == 1;
}

/// One item of a list: a number or a range.
class CountRange {
  public:
    CountRange(std::string_view text, std::string_view who, std::uint64_t low, std::uint64_t high)
        : text_(trim(text)), who_(who), low_(low), high_(high) {}

    std::vector<std::uint64_t> numbers() const {
        const auto dots = text_.find("..");
        if (dots == std::string_view::npos) return {number(text_)};
        const std::uint64_t first = number(text_.substr(0, dots));
        const std::string_view rest = text_.substr(dots + 2);
        const auto mark = rest.find_first_of("*+", rest.starts_with('+') ? 1 : 0);
        const std::uint64_t last = number(rest.substr(0, mark));
        if (first > last)
            fail(ErrorKind::usage, "{}: the range '{}' is empty: {} is above {}", who_, text_,
                 first, last);
        if (first == last) return {first};
        if (mark == std::string_view::npos) return by_factor(first, last, base(first, last));
        const auto step = parse_unsigned(trim(rest.substr(mark + 1)));
        const bool factor = rest[mark] == '*';
        if (!step || *step < (factor ? 2 : 1))
            fail(ErrorKind::usage, "{}: '{}' in '{}' is not a {}", who_,
                 trim(rest.substr(mark + 1)), text_,
                 factor ? "factor of 2 or more" : "step of 1 or more");
        return factor ? by_factor(first, last, *step) : by_step(first, last, *step);
    }

  private:
    std::uint64_t number(std::string_view text) const {
        text = trim(text);
        if (text.empty())
            fail(ErrorKind::usage, "{}: a number is missing{}", who_,
                 text_.empty() ? "" : fmt::format(" in '{}'", text_));
        const auto value = parse_unsigned(text);
        if (!value)
            fail(ErrorKind::usage,
                 "{}: '{}' is not a whole number such as 1000, 1e6, 2^20 or 64k, nor a range such "
                 "as 2^4..2^16, 16..65536*2 or 10..50+10",
                 who_, text);
        if (*value < low_ || *value > high_)
            fail(ErrorKind::usage, "{}: {} is outside [{}, {}]", who_, text, low_, high_);
        return *value;
    }

    /// Base of the powers that a range is written with: 2 in 2^4..2^16.
    /// @throws Error(usage) unless both ends are powers of it
    std::uint64_t base(std::uint64_t first, std::uint64_t last) const {
        const auto mark = text_.find('^');
        const auto end = text_.substr(0, mark);
        const auto begin = end.find_last_of(". ") + 1;  // 0 if nothing precedes the base
        const auto written = mark == std::string_view::npos ? std::optional<std::uint64_t>()
                                                            : parse_unsigned(end.substr(begin));
        if (written && *written > 1 && is_power(first, *written) && is_power(last, *written))
            return *written;
        const auto step = std::max<std::uint64_t>(1, (last - first) / 8);
        fail_with_hint(
            ErrorKind::usage,
            fmt::format("{}..{}*2 goes by a factor, {}..{}+{} by a step, 2^4..2^16 by powers",
                        first, last, first, last, step),
            "{}: '{}' does not say which numbers lie between its ends", who_, text_);
    }

    static std::vector<std::uint64_t> by_factor(std::uint64_t first, std::uint64_t last,
                                                std::uint64_t factor) {
        std::vector<std::uint64_t> list = {first};
        while (list.back() <= last / factor) list.push_back(list.back() * factor);
        return list;
    }

    std::vector<std::uint64_t> by_step(std::uint64_t first, std::uint64_t last,
                                       std::uint64_t step) const {
        constexpr std::uint64_t most = 1'000'000;
        if ((last - first) / step >= most)
            fail(ErrorKind::usage, "{}: the range '{}' has more than {} numbers", who_, text_,
                 most);
        std::vector<std::uint64_t> list = {first};
        while (step <= last - list.back()) list.push_back(list.back() + step);
        return list;
    }

    std::string_view text_;
    std::string_view who_;
    std::uint64_t low_;
    std::uint64_t high_;
};

}  // namespace

std::vector<std::uint64_t> parse_counts(std::string_view text, std::string_view who,
                                        std::uint64_t low, std::uint64_t high) {
    std::vector<std::uint64_t> all;
    std::unordered_set<std::uint64_t> seen;
    const auto items = split(text, ',');
    if (trim(text).empty()) fail(ErrorKind::usage, "{}: there are no numbers", who);
    for (const auto item : items)
        for (const std::uint64_t number : CountRange(item, who, low, high).numbers()) {
            if (!seen.insert(number).second)
                fail(ErrorKind::usage, "{}: {} is given twice in '{}'", who, number, text);
            all.push_back(number);
        }
    return all;
}

}  // namespace stipple
