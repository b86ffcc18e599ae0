// SPDX-License-Identifier: MIT
//
// The verbs that write points: generate, warp, convert.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>

#include "cli/inputs.hpp"
#include "cli/launched.hpp"
#include "cli/session.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"
#include "pipeline/warping.hpp"
#include "plot/drawing/ticks.hpp"

namespace stipple::cli {
namespace {

/// Side files for --vector-output, with the lattice in the provenance: from its options or, if a
/// search found the lattice, from the results of the search.
std::vector<SideFile> vector_files(const Provenance& meta, const ConvertRequest& request,
                                   const RunContext& run) {
    const Generator* generator = generator_named(meta.generator);
    if (!generator ||
        std::ranges::find(generator->writes, "vector-output") == generator->writes.end())
        fail(ErrorKind::input, "--vector-output: the provenance of these points names no lattice");
    SetsToMake asked{.generator = generator,
                     .options = generator->options.defaults(),
                     .request = {.count = meta.count, .dimension = meta.dimension}};
    const auto& known = generator->options.options();
    const auto set = [&](const std::string& name, const std::string& text) {
        if (std::ranges::find(known, name, &Option::name) != known.end())
            generator->options.set(asked.options, name, text);
    };
    const auto usual = typed_settings(asked.options, generator->options);
    for (const auto& option : meta.found.empty() ? meta.options : meta.found)
        if (std::ranges::find(usual, option) == usual.end() && option.first != "vector-output" &&
            option.first != "vector-format")
            set(option.first, option.second);
    set("vector-output", *request.vector_output);
    if (request.vector_format) set("vector-format", *request.vector_format);
    const GeneratedSets sets(std::move(asked), run);
    sets.prepare(run);
    return sets.side_files();
}

/// Indices of the columns with the names of the coordinates in a warp's domain. Empty if these are
/// all columns, in order; for a forward warp (`back` is false) also if no column has such a name.
/// @throws Error(input) if only some of the names exist; with `back`, also if none exists, or if
/// there are other columns
std::vector<std::size_t> coordinates_by_name(const Spec& spec,
                                             const std::vector<std::string>& columns, bool back,
                                             const RunContext& run) {
    const Warp& warp = find_warp(spec.name);
    const auto names = warp.make(spec.values(warp.options), columns.size(), run)->domain()->names();
    std::vector<std::size_t> at;
    std::string missing;
    for (const std::string& name : names) {
        const auto column = std::ranges::find(columns, name);
        if (column == columns.end() && missing.empty()) missing = name;
        if (column != columns.end())
            at.push_back(static_cast<std::size_t>(column - columns.begin()));
    }
    if (names.empty() || (at.empty() && !back)) return {};
    if (!missing.empty())
        fail_with_hint(ErrorKind::input, suggest(missing, columns), "there is no column '{}'",
                       missing);
    for (std::size_t k = 0; k < columns.size() && back; ++k)
        if (std::ranges::find(at, k) == at.end())
            fail_with_hint(ErrorKind::input, "--column picks columns by name",
                           "the column '{}' is not a coordinate of {}", columns[k], spec.name);
    const bool in_order = at.size() == columns.size() && std::ranges::is_sorted(at);
    return in_order ? std::vector<std::size_t>() : at;
}

}  // namespace

std::string output_of(const Request& request) {
    std::string path = request.output.value_or("-");
    if (file_per_set(path))
        fail(ErrorKind::usage, "--output: one file is written for all sets; '{}' names several",
             path);
    return path;
}

bool is_terminal(const std::string& path) {
    return path == "-" && isatty(STDOUT_FILENO) == 1 && !is_launched();
}

namespace {

/// " --name value", quoted for a shell.
std::string typed_option(const std::string& name, const std::string& value, bool flag) {
    return flag ? fmt::format(" --{}", name) : fmt::format(" --{} {}", name, shell_word(value));
}

/// The unit's own options as typed, without flags that are off.
std::string typed_own(const Arguments& arguments, const std::vector<std::string>& left_out) {
    if (arguments.settings.empty()) return {};
    const VerbInfo& info = info_of(*arguments.verb);
    const auto known = own_options(info.verb, unit_of(info.name, arguments.unit));
    std::string text;
    for (const auto& [name, value] : arguments.settings) {
        const Option& option = *std::ranges::find(known, name, &Option::name);
        const bool flag = option.type == "flag";
        if (std::ranges::find(left_out, name) == left_out.end() &&
            (!flag || std::get<bool>(option.parse(value))))
            text += typed_option(name, value, flag);
    }
    return text;
}

std::string typed_common(const Arguments& arguments, const std::string& name,
                         const std::string& value) {
    const Option& option = find_common("--" + name, *arguments.verb)->option;
    return typed_option(name, value, option.type == "flag");
}

}  // namespace

std::string command_text(const Arguments& arguments, std::vector<std::string> left_out,
                         std::optional<std::uint64_t> seed) {
    if (seed) left_out.emplace_back("seed");
    std::string text = "stipple " + info_of(*arguments.verb).name;
    if (!arguments.unit.empty()) text += " " + arguments.unit;
    text += typed_own(arguments, left_out);
    for (const char* silent : {"output", "threads", "quiet", "progress", "max-memory"})
        left_out.emplace_back(silent);
    for (const std::string& input : arguments.inputs) text += fmt::format(" {}", shell_word(input));
    for (const auto& [name, value] : arguments.common)
        if (std::ranges::find(left_out, name) == left_out.end())
            text += typed_common(arguments, name, value);
    if (seed && arguments.has("seed")) text += fmt::format(" --seed {}", *seed);
    return text;
}

std::string typed_generator(const std::string& text) {
    const GeneratorSpec asked = parse_generator(text);
    if (text.find(' ') == std::string::npos) return shell_word(text);
    std::string words = asked.unit.name;
    for (const auto& [name, value] : asked.unit.settings)
        words += typed_option(name, value, value == "true");
    for (const std::string& warp : asked.warps) words += typed_option("warp", warp, false);
    return words;
}

namespace {

/// Options of the generator in a command or a spec; empty if the text is neither.
std::vector<std::pair<std::string, std::string>> settings_in(std::string_view typed) {
    constexpr std::string_view verb = "stipple generate ";
    if (typed.starts_with(verb)) typed.remove_prefix(verb.size());
    try {
        return parse_generator(typed).unit.settings;
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

bool seed_matters(const Generator& generator, const Provenance& from) {
    // Scrambles, such as "owen" or "owen:depth=3", depend on the seed, unlike warps.
    for (const std::string& warp : from.warps)
        if (scramble_named(warp.substr(0, warp.find_first_of(":@"))) != nullptr) return true;
    try {
        Values values = generator.options.defaults();
        for (const auto& [name, text] : from.options) generator.options.set(values, name, text);
        return uses_seed(generator, values);
    } catch (const Error&) {
        return generator.traits.seeded;  // the options are those of another version of stipple
    }
}

std::vector<std::string> changed_options(const Provenance& from, const Generator& generator,
                                         std::string_view typed) {
    std::vector<std::string> changed;
    const auto given = settings_in(typed);
    const auto defaults = typed_settings(generator.options.defaults(), generator.options);
    const auto first = [](const auto& setting) { return setting.first; };
    for (const auto& setting : from.options) {
        constexpr std::size_t readable = 40;
        const auto& [name, value] = setting;
        const bool is_default = std::ranges::find(defaults, setting) != defaults.end();
        const auto number = parse_number(value);
        if (!is_default && value.size() <= readable &&
            (typed.empty() || std::ranges::find(given, name, first) != given.end()))
            changed.push_back(
                fmt::format("{}={}", name, number ? plot::rounded(*number, 5) : value));
    }
    return changed;
}

std::string typed_options(const Arguments& arguments,
                          std::initializer_list<std::string_view> names) {
    std::string text;
    for (const auto wanted : names)
        for (const auto& [name, value] : arguments.common)
            if (name == wanted) text += typed_common(arguments, name, value);
    return text;
}

Target target_of(const Writing& request) {
    Target target{.path = request.output.value_or("-"), .format = request.format};
    target.format = &format_of(target);
    target.header = request.header;
    target.meta = request.meta;
    target.single = request.dtype_out ? *request.dtype_out
                    : request.dtype   ? *request.dtype
                                      : io::extension_is_single(target.path);
    target.precision = request.precision;
    target.columns = {.pdf = request.with_pdf, .weight = request.with_weight};
    // For `warp`, --dtype may be meant for the input alone.
    if ((request.dtype_out || (request.dtype && request.verb != Verb::warp)) && target.single &&
        !target.format->traits.binary)
        fail_with_hint(ErrorKind::usage, "--precision truncates the numbers of text",
                       "--{}: {} is text, which has no float32",
                       request.dtype_out ? "output-dtype" : "dtype", target.format->name);
    if (target.format->traits.binary && is_terminal(target.path))
        fail_with_hint(ErrorKind::usage, "name a file with -o, or pipe it on",
                       "--format: {} is binary, and standard output is a terminal",
                       target.format->name);
    return target;
}

SetsToMake sets_to_make(const GenerateRequest& request, Session& session) {
    const Generator& generator = find_generator(request.unit);
    SetsToMake job = sets_asked(generator, settings_of(generator.options, request), request);
    job.request.seed = seed_of(request, largest_seed(generator, job.options), session);
    job.shard = request.shard;
    if (request.bounds) job.request.bounds = bounds_for(job, *request.bounds);
    return job;
}

int GenerateRequest::perform(Session& session) const {
    SetsToMake job = sets_to_make(*this, session);
    const Target target = target_of(*this);
    std::vector<std::string> left_out = job.generator->writes;
    left_out.emplace_back("format");
    job.command = command_text(*this, std::move(left_out), job.request.seed);
    if (target.format->name != "csv") job.command += " --format " + target.format->name;
    // An interrupted search has written its best points; the exit code lets scripts stop.
    return produce(job, target, session.run()) ? 130 : 0;
}

namespace {

/// Spec of the requested warp or scramble, with settings and coordinates.
/// @param scrambled null for a warp
/// @throws Error(usage)
Spec spec_of(const WarpRequest& request, const Scramble* scrambled) {
    settings_of(scrambled ? scrambled->options : find_warp(request.unit).options, request);
    Spec spec{.name = request.unit, .coordinates = {}, .settings = request.settings};
    if (request.parameters) {
        const Spec named = parse_spec(request.parameters->spec());
        if (spec.name != named.name)
            fail(ErrorKind::usage, "--parameters applies only to the warp {}", named.name);
        spec.settings.insert(spec.settings.end(), named.settings.begin(), named.settings.end());
    }
    if (request.coordinates)
        spec.coordinates = parse_spec(spec.name + "@" + *request.coordinates).coordinates;
    if (scrambled)
        refuse_options(request, "inverse,density-at,with-pdf,with-weight",
                       spec.name + " is a scramble, random and of density 1");
    else
        refuse_options(request, "seed,sets", spec.name + " is a warp, which is not random");
    return spec;
}

}  // namespace

int WarpRequest::perform(Session& session) const {
    const RunContext& run = session.run();
    const Scramble* scrambled = scramble_named(unit);
    Spec spec = spec_of(*this, scrambled);
    const Target target = target_of(*this);
    const std::string path = only_input(*this);
    if (scrambled) {
        write_scrambled(read_input(path, *this, run), spec,
                        seed_of(*this, ~std::uint64_t{0}, session), sets, target, run);
        return 0;
    }
    const auto stream = open_input(path, *this, run);
    if (const auto& names = stream->provenance().columns;
        spec.coordinates.empty() && !names.empty())
        spec.coordinates = naming(
            path, [&] { return coordinates_by_name(spec, names, inverse || density_at, run); });
    const bool whole =
        !stream->provenance().density_column.empty() ||
        (!inverse && !density_at && takes_whole_sets(spec, stream->dimension(), run));
    Unwarped points;
    if (whole || !can_stream(*stream, target))
        points.sets = read_all(*stream, *this, run);
    else
        points = {.stream = stream.get(),
                  .on = input_domain(stream->provenance(), stream->dimension(), *this, run)};
    if (density_at)
        write_density_at(points, spec, target, run);
    else
        write_warped(std::move(points), spec, inverse, target, run);
    return 0;
}

int ConvertRequest::perform(Session& session) const {
    const std::string path = only_input(*this, "--concat takes several as one set");
    const Target target = target_of(*this);
    auto points = read_input(path, *this, session.run());
    if (vector_output)
        naming(path, [&] {
            points[0].side_files = vector_files(points[0].provenance, *this, session.run());
        });
    write_sets(points, target, session.run());
    return 0;
}

}  // namespace stipple::cli
