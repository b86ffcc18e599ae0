// SPDX-License-Identifier: MIT
//
// Completions of a command line. The shells' scripts call `stipple complete WORDS...`, which prints
// one candidate per line, from the units' records, or @files if a file name is possible.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>

#include "cli/help/guide.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "emit/emit.hpp"
#include "math/integrands/integrands.hpp"
#include "math/l2/kinds.hpp"

namespace stipple::cli {

// Contents of completion.bash, completion.zsh and completion.fish in this folder.
const char* bash_completion();
const char* zsh_completion();
const char* fish_completion();

namespace {

/// A possible word with its explanation.
struct Candidate {
    std::string word;
    std::string help = {};
};

using Candidates = std::vector<Candidate>;

const Candidate files = {"@files"};

/// Names of units, verbs or topics, with their summaries.
template <class Record>
Candidates with_summaries(const std::vector<Record>& records) {
    Candidates found;
    for (const Record& record : records) found.push_back({record.name, record.summary});
    return found;
}

Candidates words_of(const std::vector<std::string>& words) {
    Candidates found;
    for (const std::string& word : words) found.push_back({word});
    return found;
}

const std::vector<UnitInfo>& units_of(std::string_view name) {
    return std::ranges::find(catalog(), name, &Kind::name)->units;
}

Candidates joined(Candidates one, const Candidates& two) {
    one.insert(one.end(), two.begin(), two.end());
    return one;
}

/// Candidates for the last item of a list between commas.
Candidates in_list(Candidates found, const std::string& current) {
    for (Candidate& candidate : found) candidate.word.insert(0, current, 0, current.rfind(',') + 1);
    return found;
}

/// Candidates for the value of a unit's option; in a list, for its last item.
Candidates values_of(const Option& option, const std::string& current = {}) {
    if (option.type == "file") return {files};
    if (option.name == "integrand") return in_list(with_summaries(integrand_kinds()), current);
    if (option.name != "kind" || option.type != "text") return words_of(option.choices);
    Candidates kinds = {{"all"}};
    for (const l2::Kind kind : l2::all_kinds)
        kinds.push_back({std::string(l2::record_of(kind).name)});
    return in_list(std::move(kinds), current);
}

/// Result keys of the analyzers that a command names, from behind the last placeholder (KIND).
Candidates keys_in(const std::string& command) {
    Candidates found;
    for (const UnitInfo& unit : units_of("analyzers"))
        for (const ResultKey& result : unit.results) {
            const auto last = result.key.find_last_of("ABCDEFGHIJKLMNOPQRSTUVWXYZ");
            const auto begin = last == std::string::npos ? 0 : last + 2;
            if (begin < result.key.size() && command.find(unit.name) != std::string::npos)
                found.push_back({result.key.substr(begin), result.help});
        }
    return found;
}

/// Candidates for the end of a partly typed spec or, if `list`, of a list of specs such as
/// "halton,sobol:scramble=ow".
Candidates in_spec(const std::vector<UnitInfo>& units, const std::string& current, bool list) {
    const auto cut = current.find_last_of(",;:=");
    if (cut == std::string::npos) return with_summaries(units);
    const std::string head = current.substr(0, cut + 1);
    const auto colon = current.rfind(':', cut);
    const auto begin = colon == 0 ? 0 : current.find_last_of(",;", colon - 1) + 1;
    const UnitInfo* unit = nullptr;
    if (colon != std::string::npos && current.find(';', colon) == std::string::npos)
        for (const UnitInfo& each : units)
            if (each.name == current.substr(begin, colon - begin)) unit = &each;
    Candidates found;
    if (current[cut] == '=') {
        const auto name = current.find_last_of(":,", cut) + 1;
        for (const Option& option : unit ? unit->options : std::vector<Option>())
            if (option.name == current.substr(name, cut - name)) found = values_of(option);
        std::erase_if(found, [](const Candidate& value) { return value.word == files.word; });
    } else {
        for (const Option& option : unit ? unit->options : std::vector<Option>())
            found.push_back({option.name + "=", option.help});
        if (list && current[cut] != ':') found = joined(std::move(found), with_summaries(units));
    }
    for (Candidate& candidate : found) candidate.word = head + candidate.word;
    return found;
}

/// Candidates for the value of a common option.
/// @param current typed part of the value
Candidates values_of(const CommonOption& common, const std::string& current) {
    const std::string_view value = common.value;
    const auto spec = [&](std::string_view kind) {
        return in_spec(units_of(kind), current, value == "SPECS");
    };
    if (value == "FORMAT") return with_summaries(units_of("formats"));
    if (value == "SPECS" || value.starts_with("GENERATOR"))
        return spec(common.option.name == "analyze" ? "analyzers" : "generators");
    if (value == "S") return {{"random"}};
    if (value.starts_with("NAME[")) return joined(spec("warps"), spec("scrambles"));
    if (value == "SPEC") return joined({{"unit-cube"}}, spec("warps"));
    if (common.option.name == "draw") return in_list({{"cells"}, {"gap"}, {"grid="}}, current);
    return values_of(common.option);
}

/// Candidates for a verb's arguments other than its units: words, or files.
Candidates operands_of(Verb verb, const std::string& current) {
    Candidates found;
    switch (verb) {
        case Verb::generate:
        case Verb::emit:
            return {};
        case Verb::study:
            return in_spec(units_of("generators"), current, true);
        case Verb::list:
            for (const Kind& kind : catalog()) found.push_back({kind.name});
            return found;
        case Verb::help:
            found = joined(with_summaries(topics()), with_summaries(verbs()));
            for (const Kind& kind : catalog())
                if (!kind.verb.empty())
                    found = joined(std::move(found), with_summaries(kind.units));
            return found;
        case Verb::completions:
            return words_of({"bash", "zsh", "fish"});
        default:
            return {files};
    }
}

Candidates option_names(Verb verb, const UnitInfo* unit) {
    Candidates found = {{"--help", "show help"}};
    for (const CommonOption* common : options_of(verb))
        for (const auto name : split(common->names, ','))
            found.push_back({std::string(name), common->option.help});
    if (unit != nullptr)
        for (const Option& option : own_options(verb, *unit))
            found.push_back({"--" + option.name, option.help});
    return found;
}

/// Candidates for the value of the option `before`; nullopt if it is a flag or not an option.
std::optional<Candidates> values_behind(const std::vector<std::string>& words,
                                        const std::string& before, const std::string& current,
                                        Verb verb, const UnitInfo* unit) {
    if (const CommonOption* common = find_common(before, verb)) {
        if (common->option.type == "flag") return std::nullopt;
        if (common->value.find("KEY") != std::string::npos)
            return in_list(keys_in(join(words, " ")), current);
        return values_of(*common, current);
    }
    if (unit != nullptr)
        for (const Option& option : own_options(verb, *unit))
            if (before == "--" + option.name && option.type != "flag")
                return values_of(option, current);
    return std::nullopt;
}

/// Candidates for the last of the words.
/// @param current typed part of the last word
/// @param before preceding option, which may need a value
Candidates candidates(const std::vector<std::string>& words, const std::string& before,
                      const std::string& current) {
    if (words.size() < 2) return joined(with_summaries(verbs()), words_of({"--help", "--version"}));
    const VerbInfo* info = find_verb(words[0]);
    if (info == nullptr) return {};
    const Kind* kind = units_for(info->name);
    const std::vector<std::string> typed(words.begin() + 1, words.end() - 1);
    const std::string* named = kind ? word_of_unit(typed, *kind, info->verb) : nullptr;
    const UnitInfo* unit =
        named ? find_unit(*kind, named->substr(0, named->find_first_of("@:,;"))) : nullptr;
    if (const auto values = values_behind(words, before, current, info->verb, unit)) return *values;
    if (words.back().starts_with('-') && words.back() != "-") return option_names(info->verb, unit);
    if (!kind || unit != nullptr) return operands_of(info->verb, current);
    Candidates found = in_spec(kind->units, current, info->verb == Verb::analyze);
    if (info->verb == Verb::emit && current.find(':') == std::string::npos)
        std::erase_if(found, [](const Candidate& name) { return !emit::can_emit(name.word); });
    return found;
}

}  // namespace

std::string complete(std::vector<std::string> words) {
    if (words.empty()) words.emplace_back();
    std::string before = words.size() > 1 ? words[words.size() - 2] : "";
    std::string current = words.back();
    std::string prefix;
    const auto equals = current.find('=');
    if (current.starts_with("--") && equals != std::string::npos) {
        prefix = current.substr(0, equals + 1);
        before = current.substr(0, equals);
        current.erase(0, equals + 1);
    }
    const auto blank = current.rfind(' ');  // last blank of a quoted generator spec
    if (blank != std::string::npos && (before.starts_with("--generat") || words[0] == "study")) {
        prefix += current.substr(0, blank + 1);
        words = {"generate"};
        for (const auto word : split(current, ' ')) words.emplace_back(word);
        before = words[words.size() - 2];
        current = words.back();
    }
    std::string text;
    std::set<std::string> seen;
    for (const auto& [word, help] : candidates(words, before, current))
        if ((word.starts_with('@') || word.starts_with(current)) && seen.insert(word).second)
            text += fmt::format("{}{}{}{}\n", word.starts_with('@') ? "" : prefix, word,
                                help.empty() ? "" : "\t", help);
    return text;
}

int CompletionsRequest::perform(Session&) const {
    const std::string shell = inputs.size() == 1 ? inputs[0] : "";
    if (shell != "bash" && shell != "zsh" && shell != "fish")
        fail(ErrorKind::usage, "completions takes one shell, bash, zsh or fish; given: '{}'",
             join(inputs, " "));
    write_text("-", shell == "bash"  ? bash_completion()
                    : shell == "zsh" ? zsh_completion()
                                     : fish_completion());
    return 0;
}

}  // namespace stipple::cli
