// SPDX-License-Identifier: MIT
//
// Whole commands, composed from the registry's verbs, units and options; they read only the file of
// the input, and write nothing.
#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "fuzz.hpp"

namespace stipple::fuzz {
namespace {

using Words = std::vector<std::string>;

template <class T>
const T& any_of(FuzzedDataProvider& input, const std::vector<T>& all) {
    return all[input.ConsumeIntegralInRange<std::size_t>(0, all.size() - 1)];
}

std::string any_value(FuzzedDataProvider& input, const Option& option) {
    static const Words typical = {"0",    "1",         "3",     "0.5",         "1/3", "2^3",
                                  "1,2",  "0,0 1,0",   "4x3",   "0..2",        "-1",  "x",
                                  "disk", "halton",    "owen",  "x*y+1",       "all", "1/2",
                                  "csv",  "json",      "value", "sphere@1,2",  "64k", "random",
                                  "true", "unit-cube", "nan",   "moments:x=1", "1e9", "triangle"};
    if (option.type == "file") return as_file({});
    if (!option.choices.empty() && input.ConsumeIntegral<std::uint8_t>() < 240)
        return any_of(input, option.choices);
    if (input.ConsumeBool()) return any_of(input, typical);
    return input.ConsumeRandomLengthString(10);
}

void add_option(Words& words, FuzzedDataProvider& input, const Option& option) {
    // Studies write their table without checking file rules, so inputs must not set --output.
    if (option.name == "output") return;
    words.push_back("--" + option.name);
    if (option.type != "flag") words.push_back(any_value(input, option));
}

/// A verb, a unit, and options; the rest of the input is the file.
Words any_words(FuzzedDataProvider& input) {
    const cli::VerbInfo& verb = any_of(input, cli::verbs());
    Words words = {verb.name};
    const Kind* const kind = units_for(verb.name);
    const UnitInfo* unit = kind ? &any_of(input, kind->units) : nullptr;
    if (unit) words.push_back(unit->name);
    const auto common = cli::options_of(verb.verb);
    const std::vector<Option> own =
        unit ? cli::own_options(verb.verb, *unit) : std::vector<Option>();
    for (std::size_t i = input.ConsumeIntegralInRange<std::size_t>(0, 5); i > 0; --i) {
        const int which = input.ConsumeIntegralInRange(0, 9);
        if (which == 0)
            words.push_back(input.ConsumeRandomLengthString(12));
        else if (which < 5 && !own.empty())
            add_option(words, input, any_of(input, own));
        else if (!common.empty())
            add_option(words, input, any_of(input, common)->option);
    }
    return words;
}

/// Runs parsed arguments, with little memory and for a short time.
void work_on(const cli::Arguments& arguments) {
    if (arguments.verb == cli::Verb::study) return;
    const auto request = cli::request_of(arguments);
    cli::Session session(*request);
    auto& run = const_cast<RunContext&>(session.run());
    const RunContext limits = small_run();
    run.threads = limits.threads;
    run.stop = limits.stop;
    run.max_memory = std::min(run.max_memory, limits.max_memory);
    cli::work_on(*request, session);
}

void command(std::string_view bytes) {
    FuzzedDataProvider input(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    Words words = any_words(input);
    const std::string file = as_file(input.ConsumeRemainingBytesAsString());
    cli::complete(words);
    if (words[0] == "generate" && input.ConsumeBool()) words.insert(words.end(), {"-n", "20"});
    if (words[0] != "study") words.insert(words.end(), {"-o", "/dev/null"});
    if (words[0] == "plot") words.insert(words.end(), {"-f", "svg"});
    if (words[0] != "generate" && words[0] != "study") words.push_back(file);
    std::vector<const char*> pointers = {"stipple"};
    for (const std::string& word : words) pointers.push_back(word.c_str());
    const cli::Arguments arguments =
        cli::parse_arguments(static_cast<int>(pointers.size()), pointers.data());
    if (arguments.version) cli::version_text();
    if (arguments.help) cli::help_text(arguments);
    if (!arguments.help && !arguments.version && arguments.verb) work_on(arguments);
}

/// Arguments from the input, one per line.
void arguments(std::string_view bytes) {
    Words words;
    for (std::size_t at = 0; at <= bytes.size(); at = bytes.find('\n', at) + 1) {
        const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
        words.emplace_back(bytes.substr(at, end - at));
        if (end == bytes.size()) break;
    }
    cli::complete(words);
    std::vector<const char*> pointers = {"stipple"};
    for (const std::string& word : words) pointers.push_back(word.c_str());
    const cli::Arguments found =
        cli::parse_arguments(static_cast<int>(pointers.size()), pointers.data());
    if (found.help) cli::help_text(found);
}

}  // namespace

std::vector<Target> command_targets() { return {{"command", command}, {"arguments", arguments}}; }

}  // namespace stipple::fuzz
