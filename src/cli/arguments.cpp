// SPDX-License-Identifier: MIT
#include "cli/arguments.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"

namespace stipple::cli {
namespace {

constexpr unsigned generate = static_cast<unsigned>(Verb::generate);
constexpr unsigned warp = static_cast<unsigned>(Verb::warp);
constexpr unsigned analyze = static_cast<unsigned>(Verb::analyze);
constexpr unsigned convert = static_cast<unsigned>(Verb::convert);
constexpr unsigned list = static_cast<unsigned>(Verb::list);
constexpr unsigned plot = static_cast<unsigned>(Verb::plot);
constexpr unsigned study = static_cast<unsigned>(Verb::study);
constexpr unsigned report = static_cast<unsigned>(Verb::report);
constexpr unsigned reproduce = static_cast<unsigned>(Verb::reproduce);
constexpr unsigned help = static_cast<unsigned>(Verb::help);
constexpr unsigned writers = generate | warp | convert;
constexpr unsigned readers = warp | analyze | convert | plot | report;
constexpr unsigned workers = writers | analyze | plot | study | report | reproduce;

/// Long name of "-n,--count": "count".
std::string long_name(std::string_view names) {
    return std::string(names.substr(names.rfind("--") + 2));
}

/// Options that may stand here, for suggestions.
std::vector<std::string> known_options(Verb verb, const UnitInfo* unit) {
    std::vector<std::string> names = {"--help"};
    for (const auto& option : common_options())
        if (takes(option, verb)) names.push_back("--" + long_name(option.names));
    if (unit)
        for (const auto& option : own_options(verb, *unit)) names.push_back("--" + option.name);
    return names;
}

const VerbInfo* find_verb(std::string_view name) {
    const auto it =
        std::ranges::find_if(verbs(), [&](const VerbInfo& info) { return name == info.name; });
    return it == verbs().end() ? nullptr : &*it;
}

[[noreturn]] void complain(std::string_view what, const std::string& word,
                           const std::vector<std::string>& known) {
    const auto meant = nearest_word(word, known);
    std::string hint = meant            ? fmt::format("did you mean {}?", *meant)
                       : what == "verb" ? "known: " + join(known, ", ")
                                        : "--help lists the options";
    fail_with_hint(ErrorKind::usage, hint, "unknown {} '{}'", what, word);
}

/// Takes the word that names the unit with coordinates or options apart: `warp disk@4,5` means
/// `warp disk --coordinates 4,5`, `generate sobol:scramble=owen` the same as with --scramble owen.
/// What it sets is given back. @throws Error(usage) for what is no spec
Spec split_spec(std::string& word, const Kind& kind) {
    if (find_unit(kind, word) != nullptr) return {};
    Spec spec = parse_spec(word);
    word = spec.name;
    return spec;
}

/// The word that names the unit, alone or in a spec; nullptr: none does.
std::string* word_of_unit(std::vector<std::string>& words, const Kind& kind, Verb verb) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        const CommonOption* option = find_common(words[i], verb);
        if (option != nullptr && *option->value != '\0')
            ++i;  // to its value
        else if (find_unit(kind, words[i].substr(0, words[i].find_first_of("@:"))) != nullptr)
            return &words[i];
    }
    return nullptr;
}

/// `--check` before what is no condition, such as a file, gets none.
void complete_checks(std::vector<std::string>& words) {
    const auto condition = [](const std::string& word) {
        return !word.starts_with('-') && word.find_first_of("<>=") != std::string::npos;
    };
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i] != "--check") continue;
        if (i + 1 < words.size() && condition(words[i + 1])) continue;
        words[i] += "=" + std::string(bare_check);
    }
}

/// The parser of one verb's words: CLI11 splits them up, and what is typed is kept as text. Only
/// the unit that the words name is a subcommand, so that a file may be called like another.
class Parser {
  public:
    /// @param unit that the words name; nullptr: none
    Parser(const VerbInfo& verb, const Kind* kind, const UnitInfo* unit)
        : verb_(verb), kind_(kind), unit_(unit) {
        arguments_.verb = verb.verb;
        app_.set_help_flag();
        app_.allow_extras();
        add_help(app_);
        for (const auto& option : common_options())
            if (takes(option, verb.verb)) add_common(option);
        if (kind == nullptr) {
            add_inputs(app_);
            return;
        }
        if (unit_ != nullptr) add_unit(*unit_);
    }

    Arguments parse(std::vector<std::string> words, const Spec& spec) {
        std::ranges::reverse(words);
        try {
            app_.parse(std::move(words));
        } catch (const CLI::ArgumentMismatch& e) {
            const std::string text = e.what();
            const std::string option = text.substr(0, text.find(':'));
            if (text.find("At Most 1 required") != std::string::npos)
                fail(ErrorKind::usage, "{} is given more than once", option);
            if (text.ends_with("missing")) fail(ErrorKind::usage, "{} needs a value", option);
            fail(ErrorKind::usage, "{}", text);
        } catch (const CLI::ParseError& e) {
            fail(ErrorKind::usage, "{}", e.what());
        }
        if (!app_.get_subcommands().empty()) arguments_.unit = unit_->name;
        if (!arguments_.help) check_remaining();
        take(spec);
        return std::move(arguments_);
    }

  private:
    /// Adds what the unit's own word sets. @throws Error(usage) where an option says it, too
    void take(const Spec& spec) {
        if (spec.name.empty()) return;
        if (!spec.coordinates.empty()) {
            if (verb_.verb != Verb::warp)
                fail(ErrorKind::usage, "{}@{}: coordinates behind @ are for warps", spec.name,
                     format_coordinates(spec.coordinates));
            if (arguments_.has("coordinates"))
                fail(ErrorKind::usage, "--coordinates is given more than once");
            arguments_.common.emplace_back("coordinates", format_coordinates(spec.coordinates));
        }
        const auto own = own_options(verb_.verb, *unit_);
        for (const auto& [name, text] : spec.settings) {
            const bool common =
                std::ranges::find(own, name, &Option::name) == own.end() &&
                std::ranges::find(unit_->options, name, &Option::name) != unit_->options.end();
            auto& all = common ? arguments_.common : arguments_.settings;
            for (const auto& [before, value] : all)
                if (before == name) fail(ErrorKind::usage, "--{} is given more than once", name);
            all.emplace_back(name, text);
        }
    }

    void add_help(CLI::App& app) {
        app.add_flag_callback("-h,--help", [this] { arguments_.help = true; });
    }

    void add_common(const CommonOption& option) {
        const std::string name = long_name(option.names);
        auto& common = arguments_.common;
        if (*option.value == '\0') {
            app_.add_flag_callback(option.names,
                                   [&common, name] { common.emplace_back(name, "true"); });
            return;
        }
        auto* added = app_.add_option_function<std::vector<std::string>>(
            option.names, [&common, name](const std::vector<std::string>& texts) {
                for (const auto& text : texts) common.emplace_back(name, text);
            });
        added->expected(1)->allow_extra_args(false);
        if (option.repeatable) added->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    }

    void add_unit(const UnitInfo& unit) {
        CLI::App& app = *app_.add_subcommand(unit.name);
        for (const std::string& alias : unit.aliases) app.alias(alias);
        app.set_help_flag();
        app.fallthrough();
        app.allow_extras();
        add_help(app);
        auto& settings = arguments_.settings;
        for (const Option& option : own_options(verb_.verb, unit)) {
            const std::string name = option.name;
            if (option.type == "flag")
                app.add_flag_callback("--" + name,
                                      [&settings, name] { settings.emplace_back(name, "true"); });
            else
                app.add_option_function<std::string>("--" + name,
                                                     [&settings, name](const std::string& text) {
                                                         settings.emplace_back(name, text);
                                                     });
        }
        if (verb_.verb != Verb::generate) add_inputs(app);
    }

    void add_inputs(CLI::App& app) {
        app.add_option_function<std::vector<std::string>>(
            "INPUT", [this](const std::vector<std::string>& files) { arguments_.inputs = files; });
    }

    void check_remaining() const {
        const auto rest = app_.remaining(true);
        if (rest.empty()) return;
        // A misspelt unit is the likelier reason for whatever else was not understood.
        if (kind_ && arguments_.unit.empty() && rest.front()[0] != '-')
            unit_of({*kind_}, verb_.name, rest.front());
        for (const std::string& word : rest)
            if (word.size() > 1 && word[0] == '-')
                complain("option", word.substr(0, word.find('=')),
                         known_options(verb_.verb, unit_));
        fail(ErrorKind::usage, "unexpected argument '{}'", rest.front());
    }

    const VerbInfo& verb_;
    const Kind* kind_;
    const UnitInfo* unit_;
    CLI::App app_{"stipple"};
    Arguments arguments_;
};

/// What stands before a verb, or in place of one.
Arguments parse_without_verb(const std::vector<std::string>& words) {
    Arguments arguments;
    if (words.empty()) return arguments;
    const std::string& word = words.front();
    arguments.help = word == "-h" || word == "--help";
    arguments.version = word == "--version";
    if (arguments.help || arguments.version) return arguments;
    if (word.starts_with('-')) complain("option", word, {"--help", "--version"});
    std::vector<std::string> names;
    for (const VerbInfo& info : verbs()) names.emplace_back(info.name);
    complain("verb", word, names);
}

}  // namespace

bool takes(const CommonOption& option, Verb verb) {
    return (option.verbs & static_cast<unsigned>(verb)) != 0;
}

const CommonOption* find_common(std::string_view name, Verb verb) {
    for (const CommonOption& option : common_options())
        for (const auto known : split(option.names, ','))
            if (known == name && takes(option, verb)) return &option;
    return nullptr;
}

const std::vector<CommonOption>& common_options() {
    static const std::vector<CommonOption> table = {
        {"--generators", "SPECS", "", "what is compared: sobol:scramble=owen,halton", study, true},
        {"--analyze", "SPECS", "", "what is measured: star-discrepancy,integration:integrand=...",
         study, true},
        {"--config", "FILE", "",
         "a study as JSON, as data/study.schema.json says; what is typed comes before it", study},
        {"-n,--count", "COUNTS", "1024", "points in a set: 16,64,256 or 2^4..2^16 or 16..65536*2",
         study},
        {"-d,--dimension", "DIMENSIONS", "2", "one or several, as for -n", study},
        {"-s,--seed", "S", "1", "the first 64-bit seed; 'random' draws one and says so", study},
        {"-m,--sets,--seeds", "R", "1",
         "sets of each generator, dimension and count: seeds S, S + 1, ...", study},
        {"-n,--count", "N", "1024", "points in a set; 1e6, 2^20 and 64k (= 65536) are accepted",
         generate},
        {"-d,--dimension", "D", "2", "dimension", generate},
        {"-d,--dimension", "D", "", "numbers of a point; needed to read raw binary", readers},
        {"-s,--seed", "S", "1", "64-bit seed; 'random' draws one and says so", generate},
        {"-s,--seed", "S", "1", "64-bit seed of a scramble; 'random' draws one and says so", warp},
        {"-m,--sets", "R", "1", "independent realizations, with seeds S, S + 1, ...", generate},
        {"-m,--sets", "R", "1", "independent replications by a scramble, with seeds S, S + 1, ...",
         warp},
        {"--generate", "GENERATOR[:OPT=V,...]", "",
         "measure sets straight from a generator, without INPUT: -n, -d, --seed, --sets, --start "
         "and "
         "--warp as of 'stipple generate'",
         analyze},
        {"--generate", "GENERATOR[:OPT=V,...]", "",
         "a set straight from a generator, behind those of the INPUTs; all of them have the same "
         "-n, "
         "-d, --seed, --start and --warp",
         report, true},
        {"-n,--count", "N", "1024", "points of a set of --generate", analyze | report},
        {"-s,--seed", "S", "1", "64-bit seed of --generate; 'random' draws one and says so",
         analyze | report},
        {"-m,--sets", "R", "1", "sets of --generate, with seeds S, S + 1, ...", analyze},
        {"-w,--warp", "NAME[:OPT=V,...]", "", "warp or scramble of --generate", analyze | report,
         true},
        {"--start", "I", "0", "index of the first point of --generate", analyze | report},
        {"--start", "I", "0", "index of a sequence's first point", generate},
        {"--shard", "I/K", "0/1",
         "the I-th of K (from 0) contiguous parts; together they are the whole, byte for byte",
         generate},
        {"--bounds", "LO..HI,...", "",
         "scale to a box: one range for all coordinates, or one for each", generate},
        {"--bounds", "LO..HI,...", "",
         "the box that the points live on; analyzers of the unit cube map it to that before",
         analyze},
        {"-w,--warp", "NAME[:OPT=V,...]", "",
         "warp or scramble on the way out; NAME@I,J takes two coordinates", generate, true},
        {"-w,--warp", "NAME[:OPT=V,...]", "", "warp or scramble before the measures, in order",
         study, true},
        {"--keys", "KEY,...", "",
         "results to keep, by name or a part of it between dots: value, radial.power, mean[0]; "
         "else all "
         "numbers",
         study},
        {"--curves", "", "", "keep lists of numbers, too, a row for each: radial.power[3]", study},
        {"--time-limit", "SECONDS", "",
         "for making a set, and for each measure of it; what takes longer fails", study},
        {"--no-seconds", "", "", "no columns of seconds: the same bytes whenever it runs", study},
        {"--summary", "", "",
         "means with standard errors, t and bootstrap intervals, medians, and generators compared "
         "pair by pair, their p-values corrected by Holm's method",
         study},
        {"--pairs", "welch|paired", "welch",
         "compare by Welch's t test, or by the differences of sets of one seed", study},
        {"--confidence", "C", "0.95", "of the intervals", study},
        {"--bootstrap", "B", "2000", "samples of the bootstrap", study},
        {"--resume", "", "", "go on with the file where it stopped; begins it where there is none",
         study},
        {"--overwrite", "", "", "begin anew, in place of the study that the file holds", study},
        {"--yes", "", "", "begin even with more than 10 million rows", study},
        {"--with-pdf", "", "", "add a column with the density of each point", generate | warp},
        {"--with-weight", "", "",
         "add a column with 1 / density: the mean of f times weight estimates the integral of f",
         generate | warp},
        {"--inverse", "", "", "the way back, to the unit cube", warp},
        {"--coordinates", "I,J,...", "", "coordinates to warp, from 1; the same as WARP@I,J", warp},
        {"--domain", "SPEC", "",
         "what the points live on: unit-cube, disk, triangle:vertices=[...], ...; else as the file "
         "says",
         analyze | plot | report},
        {"--rescale", "", "", "map the bounding box of the points to the unit cube before",
         analyze},
        {"--average", "", "",
         "one result: the mean over all sets, with standard errors of what scatters as means do",
         analyze},
        {"--check", "[KEY<VALUE]", "",
         "exit with 1 unless it holds; also <= > >= == !=; of several numbers one: mean[0]; alone: "
         "valid==true",
         analyze, true},
        {"--fail-on", "KEY>VALUE", "",
         "exit with 1 if it holds for any set, or may hold as far as bounds tell: "
         "star-discrepancy.value>0.01; also < <= >= == !=",
         report, true},
        {"--max-work", "N", "1e9",
         "comparisons of each search for a worst box (a few seconds); then the page has certain "
         "bounds",
         report},
        {"--concat", "", "", "take all INPUTs as one set, in their order: the shards of a set",
         analyze | convert},
        {"--column", "X,Y,...", "", "columns to read, by name or number (from 1)", readers},
        {"--from", "FORMAT", "", "format of the input; else from its extension or first bytes",
         readers},
        {"-o,--output", "FILE", "-",
         "- is standard output; {set} and {seed} in the name make a file for each set", writers},
        {"-o,--output", "FILE", "-", "- is standard output",
         analyze | list | plot | study | report},
        {"-o,--output", "FILE", "", "also write the points that were made again", reproduce},
        {"-f,--format", "FORMAT", "", "file format; else from the extension, else csv", writers},
        {"-f,--format", "text|json|csv", "", "how results are printed", analyze},
        {"-f,--format", "svg|png|text", "",
         "of the picture; else from the extension; text is Braille, as wide as the terminal", plot},
        {"--chart", "KIND", "points",
         "of points: points, density (counts), histogram, distances (to the nearest neighbour), "
         "spectrum, radial (power), pair-correlation, differential: these as analyze has them by "
         "default",
         plot},
        {"--key", "KEY", "", "of a report: what to draw, such as prefixes.value or minimum", plot},
        {"--set", "K", "", "which of several sets or reports, from 0; else all of them", plot},
        {"--theme", "light|dark", "light", "colours", plot},
        {"--width", "W", "", "pixels, or letters of text; else as suits the picture", plot},
        {"--height", "H", "", "pixels, or lines of text; else as suits the picture", plot},
        {"--title", "TEXT", "", "instead of what the provenance says; '' is none", plot},
        {"--x-scale", "linear|log", "", "of curves and histograms; else as suits them", plot},
        {"--y-scale", "linear|log", "", "of curves and histograms; else as suits them", plot},
        {"-f,--format", "csv|jsonl", "", "of the table; else from the extension, else csv", study},
        {"--dtype", "f64|f32", "f64", "number type of binary formats", writers},
        {"--dtype", "f64|f32", "f64", "number type of raw binary input", analyze | plot | report},
        {"--precision", "P", "",
         "digits after the point, cut off; else the shortest text that reads back the same",
         writers},
        {"--meta", "", "",
         "put the provenance in '# ' lines on top of text formats; beside npy, bin and psa, in "
         "FILE.meta.json",
         writers},
        {"--no-header", "", "", "no header line in csv", writers},
        {"--json", "", "", "complete and stable, for programs", list | reproduce},
        {"--json", "", "", "the page's content as data; also for -o FILE.json", report},
        {"--man", "", "", "as a manual page, for man", help},
        {"-o,--output", "FOLDER", "", "with --man: all manual pages, as files in a folder", help},
        {"--markdown", "", "", "as tables in Markdown", list},
        {"--threads", "T", "0", "0 = all cores; never changes a result", workers},
        {"--max-memory", "SIZE", "80 % of the machine's",
         "refuse what would need more, before starting; 500M, 2G", workers},
        {"--quiet", "", "", "no warnings and no progress", workers},
        {"--progress", "auto|always|never", "auto", "a bar on stderr, after 0.5 s on a terminal",
         workers}};
    return table;
}

std::vector<Option> own_options(Verb verb, const UnitInfo& unit) {
    std::vector<Option> own = unit.options;
    std::erase_if(own, [&](const Option& option) {
        return std::ranges::any_of(common_options(), [&](const CommonOption& common) {
            return takes(common, verb) && long_name(common.names) == option.name;
        });
    });
    return own;
}

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

Arguments parse_arguments(int argc, const char* const* argv, const std::vector<Kind>& kinds) {
    std::vector<std::string> words(argv + 1, argv + argc);
    const VerbInfo* verb = words.empty() ? nullptr : find_verb(words.front());
    if (verb == nullptr) return parse_without_verb(words);
    words.erase(words.begin());
    const auto kind = units_for(kinds, verb->name);
    if (verb->verb == Verb::analyze) complete_checks(words);
    std::string* const word = kind ? word_of_unit(words, *kind, verb->verb) : nullptr;
    const Spec spec = word != nullptr ? split_spec(*word, *kind) : Spec();
    const UnitInfo* const unit = word != nullptr ? find_unit(*kind, *word) : nullptr;
    return Parser(*verb, kind ? &*kind : nullptr, unit).parse(words, spec);
}

}  // namespace stipple::cli
