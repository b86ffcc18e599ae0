// SPDX-License-Identifier: MIT
#include "study/study_config.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "study/spec_list.hpp"

namespace stipple {
namespace {

/// What the value of a key is.
enum class Holds { generators, analyzers, warps, counts, words, number, flag, no_flag, text };

struct Key {
    const char* name;
    Holds holds;
    const char* option;  ///< of the command line
};

constexpr std::array keys = {Key{"generators", Holds::generators, "generators"},
                             Key{"analyze", Holds::analyzers, "analyze"},
                             Key{"warp", Holds::warps, "warp"},
                             Key{"count", Holds::counts, "count"},
                             Key{"dimension", Holds::counts, "dimension"},
                             Key{"seed", Holds::number, "seed"},
                             Key{"seeds", Holds::number, "seeds"},
                             Key{"keys", Holds::words, "keys"},
                             Key{"curves", Holds::flag, "curves"},
                             Key{"time-limit", Holds::number, "time-limit"},
                             Key{"seconds", Holds::no_flag, "no-seconds"},
                             Key{"summary", Holds::flag, "summary"},
                             Key{"pairs", Holds::text, "pairs"},
                             Key{"confidence", Holds::number, "confidence"},
                             Key{"bootstrap", Holds::number, "bootstrap"},
                             Key{"output", Holds::text, "output"},
                             Key{"format", Holds::text, "format"}};

/// Numbers that a key takes, and how a message calls them.
struct Range {
    const char* key;
    double low;
    double high;
    bool whole;  ///< whole numbers, the ends among them; else numbers between the ends
    const char* name;
};

constexpr std::array number_ranges = {
    Range{"seed", 0, 0x1p64, true, "a whole number in [0, 2^64)"},
    Range{"seeds", 1, 0x1p53, true, "a whole number in [1, 2^53]"},
    Range{"time-limit", 0, 1e9, false, "a number of seconds above 0"},
    Range{"confidence", 0, 1, false, "a number between 0 and 1"},
    Range{"bootstrap", 1, 1e7, true, "a whole number in [1, 10000000]"}};

constexpr std::array<std::pair<const char*, const char*>, 2> choices = {
    {{"pairs", "welch|paired"}, {"format", "csv|jsonl"}}};

constexpr std::array remarks = {"$schema", "comment"};

/// Looks for keys that stand twice in an object, of which a parser would take the last.
class Repetitions {
  public:
    explicit Repetitions(const std::string& source) : source_(source) {}

    bool operator()(int, Json::parse_event_t event, const Json& value) {
        if (event == Json::parse_event_t::object_start) objects_.emplace_back();
        if (event == Json::parse_event_t::object_end) objects_.pop_back();
        if (event != Json::parse_event_t::key) return true;
        const auto name = value.get<std::string>();
        auto& keys_here = objects_.back();
        const bool twice = std::ranges::find(keys_here, name) != keys_here.end();
        keys_here.push_back(name);
        if (!twice) return true;
        std::string where = "$";
        for (const auto& object : objects_) where += "." + object.back();
        fail(ErrorKind::input, "{}: {}: the key stands twice", source_, where);
    }

  private:
    std::string source_;
    std::vector<std::vector<std::string>> objects_;  ///< that are open: their keys so far
};

class ConfigReader {
  public:
    explicit ConfigReader(std::string source) : source_(std::move(source)) {}

    StudySettings read(std::string_view text) {
        const Json root = parsed(text);
        if (!root.is_object()) refuse("$", "expected an object, {\"generators\": ...}");
        for (const auto& [name, value] : root.items()) {
            if (std::ranges::find(remarks, name) != remarks.end()) continue;
            const auto* key =
                std::ranges::find_if(keys, [&](const Key& k) { return k.name == name; });
            if (key == keys.end())
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

    /// Runs a check of another part of the program; what it says is said with the place.
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

    [[nodiscard]] Json parsed(std::string_view text) const {
        try {
            return Json::parse(text, Repetitions(source_));
        } catch (const Json::parse_error& e) {
            const std::size_t at = std::min(e.byte > 0 ? e.byte - 1 : 0, text.size());
            const auto before = text.substr(0, at);
            const auto line = 1 + std::ranges::count(before, '\n');
            const auto last = before.rfind('\n');
            const auto column = last == std::string_view::npos ? at + 1 : at - last;
            fail(ErrorKind::input, "{}:{}:{}: is not JSON here", source_, line, column);
        }
    }

    void read_key(const Key& key, const Json& value, const std::string& where) {
        switch (key.holds) {
            case Holds::generators:
            case Holds::analyzers:
            case Holds::warps:
                return read_units(key, value, where);
            case Holds::counts:
                return read_counts(key, value, where);
            case Holds::words:
                return read_words(key, value, where);
            case Holds::number:
                return read_number(key, value, where);
            case Holds::flag:
            case Holds::no_flag:
                if (!value.is_boolean())
                    refuse(where, fmt::format("expected true or false, got {}", value.dump()));
                if (value.get<bool>() == (key.holds == Holds::flag)) add(key, "true");
                return;
            case Holds::text:
                if (!value.is_string())
                    refuse(where, fmt::format("expected a word, got {}", value.dump()));
                return read_text(key, value.get<std::string>(), where);
        }
    }

    void read_number(const Key& key, const Json& value, const std::string& where) {
        const Range& range = *std::ranges::find_if(
            number_ranges, [&](const Range& r) { return std::string_view(r.key) == key.name; });
        const double x = value.is_number() ? value.get<double>() : -1;
        const bool inside = range.whole
                                ? value.is_number_unsigned() && x >= range.low && x <= range.high
                                : x > range.low && x < range.high;
        if (!inside) refuse(where, fmt::format("expected {}, got {}", range.name, value.dump()));
        add(key, number_text(value));
    }

    void read_text(const Key& key, const std::string& text, const std::string& where) {
        for (const auto& [name, words] : choices)
            if (name == std::string_view(key.name)) {
                const auto known = split(words, '|');
                if (std::ranges::find(known, text) == known.end())
                    refuse(where,
                           fmt::format("expected {} or {}, got '{}'", known[0], known[1], text));
            }
        if (text.empty()) refuse(where, "expected a name, got an empty one");
        add(key, text);
    }

    void add(const Key& key, std::string text) {
        settings_.emplace_back(key.option, std::move(text));
    }

    static std::string number_text(const Json& value) {
        return value.is_number_float() ? format_number(value.get<double>()) : value.dump();
    }

    void read_units(const Key& key, const Json& value, const std::string& where) {
        if (value.is_string() || value.is_object()) return read_unit(key, value, where);
        if (!value.is_array() || (value.empty() && key.holds != Holds::warps))
            refuse(where, "expected a list of specs such as \"sobol:scramble=owen\"");
        for (std::size_t i = 0; i < value.size(); ++i)
            read_unit(key, value[i], fmt::format("{}[{}]", where, i));
    }

    void read_unit(const Key& key, const Json& value, const std::string& where) {
        std::string text;
        if (value.is_string())
            text = value.get<std::string>();
        else if (value.is_object())
            text = spec_of(key, value, where);
        else
            refuse(where,
                   "expected a spec or {\"name\": ..., \"options\": {...}}, got " + value.dump());
        checked(where, [&] { check_unit(key, parse_spec(text)); });
        add(key, text);
    }

    static void check_unit(const Key& key, const Spec& spec) {
        if (key.holds == Holds::generators) (void)spec.values(find_generator(spec.name).options);
        if (key.holds == Holds::analyzers) (void)spec.values(find_analyzer(spec.name).options);
        if (key.holds != Holds::warps) return;
        const Scramble* scramble = scramble_named(spec.name);
        (void)spec.values(scramble ? scramble->options : find_warp(spec.name).options);
    }

    /// The spec of {"name": ..., "options": {...}}.
    std::string spec_of(const Key& key, const Json& object, const std::string& where) const {
        const std::vector<std::string> known = {"name", "options"};
        for (const auto& [name, value] : object.items())
            if (std::ranges::find(known, name) == known.end())
                refuse(path(where, name), "there is no such key", suggest(name, known));
        if (!object.contains("name") || !object["name"].is_string())
            refuse(where, "the key 'name' is missing, or is no word");
        const auto name = object["name"].get<std::string>();
        if (!object.contains("options")) return name;
        const Json& options = object["options"];
        if (!options.is_object()) refuse(path(where, "options"), "expected an object");
        std::string text = name;
        char separator = ':';
        for (const auto& [option, value] : options.items()) {
            const std::string place = path(path(where, "options"), option);
            const std::string setting = fmt::format("{}=[{}]", option, option_text(value, place));
            checked(place,
                    [&] { check_unit(key, parse_spec(fmt::format("{}:{}", name, setting))); });
            text += separator;
            text += setting;
            separator = ',';
        }
        return text;
    }

    std::string option_text(const Json& value, const std::string& where) const {
        if (value.is_string()) return value.get<std::string>();
        if (value.is_boolean()) return value.get<bool>() ? "true" : "false";
        if (value.is_number()) return number_text(value);
        if (!value.is_array()) refuse(where, "expected a word, a number, true, false or a list");
        // Numbers are separated by commas, points by blanks.
        std::string text;
        for (const Json& item : value) {
            if (!text.empty()) text += item.is_array() ? ' ' : ',';
            text += option_text(item, where);
        }
        return text;
    }

    void read_counts(const Key& key, const Json& value, const std::string& where) {
        std::string text;
        const auto one = [&](const Json& item, const std::string& place) {
            if (!item.is_number_integer() && !item.is_string())
                refuse(place, "expected a whole number or a range such as \"2^4..2^16\", got " +
                                  item.dump());
            const std::string part = item.is_string() ? item.get<std::string>() : item.dump();
            try {
                parse_counts(part, place, 1, std::uint64_t{1} << 53);
            } catch (const Error& e) {
                throw Error(ErrorKind::input, fmt::format("{}: {}", source_, e.what()), e.hint());
            }
            if (!text.empty()) text += ',';
            text += part;
        };
        if (!value.is_array()) {
            one(value, where);
        } else {
            if (value.empty()) refuse(where, "there are no numbers");
            for (std::size_t i = 0; i < value.size(); ++i)
                one(value[i], fmt::format("{}[{}]", where, i));
        }
        add(key, text);
    }

    void read_words(const Key& key, const Json& value, const std::string& where) {
        if (!value.is_array()) refuse(where, "expected a list of words");
        std::string text;
        for (std::size_t i = 0; i < value.size(); ++i) {
            if (!value[i].is_string())
                refuse(fmt::format("{}[{}]", where, i), "expected a word, got " + value[i].dump());
            if (i > 0) text += ',';
            text += value[i].get<std::string>();
        }
        add(key, text);
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
    for (const Key& key : keys) names.emplace_back(key.name);
    return names;
}

}  // namespace stipple
