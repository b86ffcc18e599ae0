// SPDX-License-Identifier: MIT
//
// The verb `completions`: scripts for bash, zsh and fish, made from the records. They run nothing
// but the shell.
#include <fmt/format.h>

#include <algorithm>

#include "cli/topics.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

/// What may stand behind an option.
struct CompletionValues {
    bool flag = false;
    bool file = false;
    std::vector<std::string> words = {};
};

/// An option as shells see it.
struct Word {
    std::string name;         ///< long, without dashes
    std::string letter = {};  ///< short, without its dash, or empty
    std::string help;
    CompletionValues values = {};
};

std::vector<std::string> names_of(const std::vector<Kind>& kinds, std::string_view name) {
    std::vector<std::string> names;
    for (const Kind& kind : kinds)
        if (kind.name == name)
            for (const UnitInfo& unit : kind.units) names.push_back(unit.name);
    return names;
}

std::vector<std::string> joined(std::vector<std::string> one, const std::vector<std::string>& two) {
    one.insert(one.end(), two.begin(), two.end());
    return one;
}

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    for (const auto word : split(text, '|')) words.emplace_back(word);
    return words;
}

/// What the placeholder of a common option stands for.
CompletionValues values_of(const CommonOption& option, const std::vector<Kind>& kinds) {
    const std::string_view value = option.value;
    if (value.empty()) return {.flag = true};
    if (value.find('|') != std::string_view::npos) return {.words = words_of(value)};
    if (value == "FILE" || value == "FOLDER") return {.file = true};
    if (value == "FORMAT") return {.words = names_of(kinds, "formats")};
    if (value == "SPECS" || value.starts_with("GENERATOR"))
        return {.words =
                    names_of(kinds, std::string_view(option.names) == "--analyze" ? "analyzers"
                                                                                  : "generators")};
    if (value == "S") return {.words = {"random"}};
    if (value.starts_with("NAME["))
        return {.words = joined(names_of(kinds, "warps"), names_of(kinds, "scrambles"))};
    if (value == "SPEC") return {.words = joined({"unit-cube"}, names_of(kinds, "warps"))};
    return {};
}

std::vector<Word> common_words(Verb verb, const std::vector<Kind>& kinds) {
    std::vector<Word> words;
    for (const CommonOption& option : common_options()) {
        if (!takes(option, verb)) continue;
        const std::string names = option.names;
        const auto dashes = names.rfind("--");
        words.push_back({.name = names.substr(dashes + 2),
                         .letter = dashes > 0 ? names.substr(1, 1) : "",
                         .help = option.help,
                         .values = values_of(option, kinds)});
    }
    words.push_back(
        {.name = "help", .letter = "h", .help = "all about it", .values = {.flag = true}});
    return words;
}

std::vector<Word> own_words(Verb verb, const UnitInfo& unit) {
    std::vector<Word> words;
    for (const Option& option : own_options(verb, unit))
        words.push_back({.name = option.name,
                         .help = option.help,
                         .values = {.flag = option.type == "flag",
                                    .file = option.type == "file",
                                    .words = option.choices}});
    return words;
}

/// What a verb takes that is not a unit: words, or files.
CompletionValues operands_of(Verb verb, const std::vector<Kind>& kinds) {
    std::vector<std::string> words;
    switch (verb) {
        case Verb::generate:
            return {};
        case Verb::list:
            for (const Kind& kind : kinds) words.push_back(kind.name);
            return {.words = words};
        case Verb::help:
            for (const Topic& topic : topics()) words.emplace_back(topic.name);
            for (const VerbInfo& info : verbs()) words.emplace_back(info.name);
            for (const Kind& kind : kinds)
                if (!kind.verb.empty())
                    words = joined(std::move(words), names_of(kinds, kind.name));
            std::ranges::sort(words);
            words.erase(std::ranges::unique(words).begin(), words.end());
            return {.words = words};
        case Verb::completions:
            return {.words = {"bash", "zsh", "fish"}};
        default:
            return {.file = true};
    }
}

std::string all_names(const UnitInfo& unit, std::string_view between) {
    return join(joined({unit.name}, unit.aliases), between);
}

std::string dashed(const std::vector<Word>& words) {
    std::vector<std::string> names;
    for (const Word& word : words) {
        if (!word.letter.empty()) names.push_back(fmt::format("-{}", word.letter));
        names.push_back(fmt::format("--{}", word.name));
    }
    return join(names, " ");
}

/// How bash's script says what may stand behind an option: words, @file, @any, or nothing for a
/// flag.
std::string bash_values(const CompletionValues& values) {
    if (values.file) return "@file";
    return values.words.empty() ? "@any" : join(values.words, " ");
}

/// Cases of one place (VERB or VERB/UNIT) for the values of its options.
std::string bash_value_cases(const std::string& place, const std::vector<Word>& words) {
    std::string text;
    for (const Word& word : words) {
        if (word.values.flag) continue;
        std::string pattern = fmt::format("{}:--{}", place, word.name);
        if (!word.letter.empty()) pattern += fmt::format("|{}:-{}", place, word.letter);
        text += fmt::format("        {}) echo '{}' ;;\n", pattern, bash_values(word.values));
    }
    return text;
}

constexpr const char* bash_frame = R"(
_stipple() {
    local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}
    local verb=${COMP_WORDS[1]} unit= word values i
    COMPREPLY=()
    # bash parts --option=value into three words.
    if [[ $cur == = ]]; then
        cur=
    elif [[ $prev == = ]]; then
        prev=${COMP_WORDS[COMP_CWORD-2]}
    fi
    if ((COMP_CWORD == 1)); then
        COMPREPLY=($(compgen -W "$(_stipple_verbs) --help --version" -- "$cur"))
        return
    fi
    for ((i = 2; i < COMP_CWORD; ++i)); do
        word=$(_stipple_unit "$verb" "${COMP_WORDS[i]}")
        [[ -n $word ]] && unit=$word && break
    done
    if [[ $prev == -* ]]; then
        values=$(_stipple_values "$verb:$prev")
        [[ -z $values && -n $unit ]] && values=$(_stipple_values "$verb/$unit:$prev")
    fi
    if [[ -z $values && $cur == -* ]]; then
        values=$(_stipple_options "$verb"; _stipple_options "$verb/$unit")
    elif [[ -z $values && -z $unit ]]; then
        values=$(_stipple_units "$verb")
    fi
    [[ -z $values ]] && values=$(_stipple_operands "$verb")
    case $values in
        @any) ;;
        @file)
            compopt -o filenames 2>/dev/null
            mapfile -t COMPREPLY < <(compgen -f -- "$cur")
            ;;
        *) COMPREPLY=($(compgen -W "$values" -- "$cur")) ;;
    esac
}

complete -F _stipple stipple
)";

std::string bash_script(const std::vector<Kind>& kinds) {
    std::vector<std::string> names;
    std::string operands;
    std::string units;
    std::string unit;
    std::string options;
    std::string values;
    for (const VerbInfo& info : verbs()) {
        const std::string verb = info.name;
        names.push_back(verb);
        operands += fmt::format("        {}) echo '{}' ;;\n", verb,
                                bash_values(operands_of(info.verb, kinds)));
        const auto common = common_words(info.verb, kinds);
        options += fmt::format("        {}) echo '{}' ;;\n", verb, dashed(common));
        values += bash_value_cases(verb, common);
        const auto kind = units_for(kinds, verb);
        if (!kind) continue;
        std::vector<std::string> known;
        for (const UnitInfo& each : kind->units) {
            known.push_back(each.name);
            unit += fmt::format("        {0}:{1}) echo {2} ;;\n", verb,
                                all_names(each, fmt::format("|{}:", verb)), each.name);
            const auto own = own_words(info.verb, each);
            const std::string place = fmt::format("{}/{}", verb, each.name);
            if (!own.empty())
                options += fmt::format("        {}) echo '{}' ;;\n", place, dashed(own));
            values += bash_value_cases(place, own);
        }
        units += fmt::format("        {}) echo '{}' ;;\n", verb, join(known, " "));
    }
    const auto function = [](const char* name, const char* word, const std::string& cases) {
        return fmt::format("\n_stipple_{}() {{\n    case {} in\n{}    esac\n}}\n", name, word,
                           cases);
    };
    return fmt::format("# bash completion for stipple {}, made by 'stipple completions bash'.\n",
                       STIPPLE_VERSION) +
           fmt::format("\n_stipple_verbs() {{ echo '{}'; }}\n", join(names, " ")) +
           function("units", "$1", units) + function("unit", "$1:$2", unit) +
           function("options", "$1", options) + function("values", "$1", values) +
           function("operands", "$1", operands) + bash_frame;
}

std::string replaced(std::string text, std::string_view letters, std::string_view before) {
    std::string out;
    for (const char c : text) {
        if (letters.find(c) != std::string_view::npos) out += before;
        out += c;
    }
    return out;
}

/// A text in single quotes.
std::string in_quotes(const std::string& text) {
    std::string out = "'";
    for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

/// What _arguments calls an option: '(-n --count)'{-n,--count}'[help]:value:action'.
std::string zsh_word(const Word& word) {
    std::string tail = fmt::format("[{}]", replaced(word.help, "[]\\", "\\"));
    if (!word.values.flag) {
        tail += word.values.file ? ":file:_files"
                : word.values.words.empty()
                    ? ":value: "
                    : fmt::format(":value:({})", join(word.values.words, " "));
    }
    if (word.letter.empty()) return in_quotes(fmt::format("*--{}{}", word.name, tail));
    return fmt::format("'*'{{-{},--{}}}{}", word.letter, word.name, in_quotes(tail));
}

std::string zsh_list(const std::vector<Word>& words) {
    std::string text;
    for (const Word& word : words) text += fmt::format("                {}\n", zsh_word(word));
    return text;
}

constexpr const char* zsh_frame = R"(
    local verb=$words[2] unit= word
    local -a options units operands
    if (( CURRENT == 2 )); then
        _describe -t verbs verb verbs
        return
    fi
    _stipple_verb
    for word in "${(@)words[3,CURRENT-1]}"; do
        [[ -n $aliases_of[$word] ]] && unit=$aliases_of[$word] && break
    done
    _stipple_unit
    shift words
    (( CURRENT-- ))
    if (( $#units )) && [[ -z $unit ]]; then
        _arguments $options '1:unit:->unit'
        [[ $state == unit ]] && _describe -t units unit units
    elif (( $#operands )); then
        _arguments $options '*:word:($operands)'
    elif [[ $verb == generate ]]; then
        _arguments $options '*: : '
    else
        _arguments $options '*:file:_files'
    fi
}

_stipple "$@"
)";

std::string zsh_described(const std::string& name, const std::string& help) {
    return fmt::format("        {}\n",
                       in_quotes(fmt::format("{}:{}", replaced(name, ":", "\\"), help)));
}

std::string zsh_script(const std::vector<Kind>& kinds) {
    std::string verb_lines;
    std::string verb_cases;
    std::string unit_cases;
    for (const VerbInfo& info : verbs()) {
        const std::string verb = info.name;
        verb_lines += zsh_described(verb, info.summary);
        verb_cases += fmt::format("        {})\n            options=(\n{}            )\n", verb,
                                  zsh_list(common_words(info.verb, kinds)));
        const auto operands = operands_of(info.verb, kinds).words;
        if (!operands.empty())
            verb_cases += fmt::format("            operands=({})\n", join(operands, " "));
        const auto kind = units_for(kinds, verb);
        if (kind) {
            verb_cases += "            units=(\n";
            for (const UnitInfo& unit : kind->units)
                verb_cases += fmt::format("        {}", zsh_described(unit.name, unit.summary));
            verb_cases += "            )\n            aliases_of=(\n";
            for (const UnitInfo& unit : kind->units)
                for (const auto& name : joined({unit.name}, unit.aliases))
                    verb_cases += fmt::format("                {} {}\n", name, unit.name);
            verb_cases += "            )\n";
            for (const UnitInfo& unit : kind->units)
                unit_cases += fmt::format(
                    "        {}/{})\n            options+=(\n{}            )\n"
                    "            ;;\n",
                    verb, unit.name, zsh_list(own_words(info.verb, unit)));
        }
        verb_cases += "            ;;\n";
    }
    return fmt::format(
               "#compdef stipple\n# zsh completion for stipple {}, made by 'stipple completions "
               "zsh'.\n\n",
               STIPPLE_VERSION) +
           "_stipple_verb() {\n    case $verb in\n" + verb_cases + "    esac\n}\n\n" +
           "_stipple_unit() {\n    case $verb/$unit in\n" + unit_cases + "    esac\n}\n\n" +
           "_stipple() {\n    local curcontext=$curcontext state line\n    typeset -A opt_args\n"
           "    local -A aliases_of\n    local -a verbs=(\n" +
           verb_lines + "    )" + zsh_frame;
}

constexpr const char* fish_frame = R"(
# Whether the verb is $argv[1] and, if more are named, one of the units behind it was typed.
function __stipple_is
    set -l words (commandline -opc)
    set -e words[1]
    test "$words[1]" = "$argv[1]"; or return 1
    test (count $argv) -gt 1; or return 0
    set -e words[1]
    for unit in $argv[2..-1]
        contains -- $unit $words; and return 0
    end
    return 1
end

complete -c stipple -f
complete -c stipple -n __fish_use_subcommand -l version -d 'the libraries that are linked'
complete -c stipple -n __fish_use_subcommand -s h -l help -d 'what there is'
)";

std::string fish_word(const std::string& condition, const Word& word) {
    std::string text =
        fmt::format("complete -c stipple -n {} -l {}", in_quotes(condition), word.name);
    if (!word.letter.empty()) text += fmt::format(" -s {}", word.letter);
    if (word.values.file)
        text += " -r -F";
    else if (!word.values.flag)
        text += " -x";
    if (!word.values.words.empty())
        text += fmt::format(" -a {}", in_quotes(join(word.values.words, " ")));
    return text + fmt::format(" -d {}\n", in_quotes(word.help));
}

std::string fish_script(const std::vector<Kind>& kinds) {
    std::string text =
        fmt::format("# fish completion for stipple {}, made by 'stipple completions fish'.\n",
                    STIPPLE_VERSION) +
        fish_frame;
    for (const VerbInfo& info : verbs()) {
        const std::string verb = fmt::format("__stipple_is {}", info.name);
        text += fmt::format("complete -c stipple -n __fish_use_subcommand -a {} -d {}\n", info.name,
                            in_quotes(info.summary));
        for (const Word& word : common_words(info.verb, kinds)) text += fish_word(verb, word);
        const CompletionValues operands = operands_of(info.verb, kinds);
        if (operands.file) text += fmt::format("complete -c stipple -n {} -F\n", in_quotes(verb));
        if (!operands.words.empty())
            text += fmt::format("complete -c stipple -n {} -a {}\n", in_quotes(verb),
                                in_quotes(join(operands.words, " ")));
        const auto kind = units_for(kinds, info.name);
        if (!kind) continue;
        std::string every;
        for (const UnitInfo& unit : kind->units) every += fmt::format(" {}", all_names(unit, " "));
        for (const UnitInfo& unit : kind->units) {
            text += fmt::format("complete -c stipple -n {} -a {} -d {}\n",
                                in_quotes(fmt::format("{0}; and not {0}{1}", verb, every)),
                                unit.name, in_quotes(unit.summary));
            for (const Word& word : own_words(info.verb, unit))
                text += fish_word(fmt::format("{} {}", verb, all_names(unit, " ")), word);
        }
    }
    return text;
}

}  // namespace

int completions(const Arguments& arguments, const std::vector<Kind>& kinds) {
    const std::string shell = arguments.inputs.size() == 1 ? arguments.inputs[0] : "";
    if (shell == "bash")
        write_text("-", bash_script(kinds));
    else if (shell == "zsh")
        write_text("-", zsh_script(kinds));
    else if (shell == "fish")
        write_text("-", fish_script(kinds));
    else
        fail(ErrorKind::usage, "completions takes one shell, bash, zsh or fish; given: '{}'",
             join(arguments.inputs, " "));
    return 0;
}

}  // namespace stipple::cli
