// SPDX-License-Identifier: MIT
//
// The verbs that write points: generate, warp, convert.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>

#include "cli/inputs.hpp"
#include "cli/launched.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"
#include "pipeline/warping.hpp"

namespace stipple::cli {
namespace {

Shard parse_shard(const Arguments& arguments) {
    const auto text = arguments.get("shard");
    if (!text) return {};
    const auto parts = split(*text, '/');
    const auto index = parts.size() == 2 ? parse_unsigned(parts[0]) : std::nullopt;
    const auto of = parts.size() == 2 ? parse_unsigned(parts[1]) : std::nullopt;
    if (!index || !of || *index >= *of)
        fail(ErrorKind::usage, "--shard: '{}' is not I/K with 0 <= I < K", *text);
    return {*index, *of};
}

/// The box of --bounds, from one range per coordinate or a single one for all. The box may
/// determine the dimension; options are checked against it.
Box bounds_of(const std::string& text, const SetsToMake& job) {
    const auto ranges = static_cast<std::size_t>(1 + std::ranges::count(text, ','));
    Request request = job.request;
    if (!job.warps.empty()) {  // bounds of the coordinates that the warps leave, or of all
        const std::size_t d = plan_for(*job.generator, request, job.options).dimension;
        const std::size_t kept = WarpChain(job.warps, d).kept().size();
        return parse_box(text, ranges == d ? d : std::max<std::size_t>(kept, 1));
    }
    request.bounds = parse_box(text, request.dimension.value_or(std::max<std::size_t>(ranges, 2)));
    return parse_box(text, plan_for(*job.generator, request, job.options).dimension);
}

/// Command that reproduces these bytes, without options that do not affect them.
std::string command_of(const Arguments& arguments, const SetsToMake& job, const Target& target) {
    const Generator& generator = *job.generator;
    const auto& options = generator.options.options();
    std::string text = "stipple generate " + arguments.unit;
    for (const auto& [name, value] : arguments.settings) {
        if (std::ranges::find(generator.writes, name) != generator.writes.end()) continue;
        const bool flag = std::ranges::find(options, name, &Option::name)->type == "flag";
        if (!flag || std::get<bool>(job.options.find(name).value))
            text += typed_option(name, value, flag);
    }
    text += command_text(arguments, {"format", "seed"});
    if (arguments.has("seed"))
        text += typed_option("seed", std::to_string(job.request.seed), false);
    if (target.format->name != "csv") text += typed_option("format", target.format->name, false);
    return text;
}

/// Files for --vector-output with the lattice in the provenance, using the results of its search if
/// there was one.
std::vector<SideFile> vector_files(const Provenance& meta, const Arguments& arguments,
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
    for (const char* name : {"vector-output", "vector-format"})
        if (const auto text = arguments.get(name)) set(name, *text);
    const GeneratedSets sets(std::move(asked), run);
    sets.prepare(run);
    return sets.side_files();
}

/// Positions of a warp's coordinates (or of its image, if `back`) among the columns, matched by the
/// names in its domain. Used if a table has them in another order or among other columns.
/// @throws Error(input) if the table has only some of them, or with `back` any other names
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
                           "the column '{}' is none of {}", columns[k], spec.name);
    const bool in_order = at.size() == columns.size() && std::ranges::is_sorted(at);
    return in_order ? std::vector<std::size_t>() : at;
}

}  // namespace

std::string output_of(const Arguments& arguments) {
    std::string path = arguments.get("output").value_or("-");
    if (file_per_set(path))
        fail(ErrorKind::usage, "--output: one file is written for all sets; '{}' names several",
             path);
    return path;
}

bool is_terminal(const std::string& path) {
    return path == "-" && isatty(STDOUT_FILENO) == 1 && !is_launched();
}

std::string typed_option(const std::string& name, const std::string& value, bool flag) {
    return flag ? fmt::format(" --{}", name) : fmt::format(" --{} {}", name, shell_word(value));
}

std::string command_text(const Arguments& arguments,
                         std::initializer_list<std::string_view> left_out) {
    constexpr std::array<std::string_view, 5> silent = {"output", "threads", "quiet", "progress",
                                                        "max-memory"};
    std::string text;
    for (const std::string& input : arguments.inputs) text += fmt::format(" {}", shell_word(input));
    for (const auto& [name, value] : arguments.common)
        if (std::ranges::find(silent, name) == silent.end() &&
            std::ranges::find(left_out, name) == left_out.end())
            text += typed_option(name, value,
                                 find_common("--" + name, *arguments.verb)->option.type == "flag");
    return text;
}

std::string shell_word(const std::string& word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%^";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string quoted = word;
    replace_all(quoted, "'", "'\\''");
    return "'" + quoted + "'";
}

Target target_of(const Arguments& arguments) {
    Target target;
    target.path = arguments.get("output").value_or("-");
    if (const auto name = arguments.get("format")) target.format = &io::format_named(*name);
    target.format = &format_of(target);
    target.header = !arguments.has("no-header");
    target.meta = arguments.has("meta");
    auto type = arguments.get("output-dtype");
    if (!type) type = arguments.get("dtype");
    target.single = type ? *type == "f32" : io::extension_is_single(target.path);
    if (const auto digits = arguments.integer("precision"))
        target.precision = static_cast<int>(*digits);
    target.columns = {.pdf = arguments.has("with-pdf"), .weight = arguments.has("with-weight")};
    if (target.format->traits.binary && is_terminal(target.path))
        fail_with_hint(ErrorKind::usage, "name a file with -o, or pipe it on",
                       "--format: {} is binary, and standard output is a terminal",
                       target.format->name);
    return target;
}

Values settings_of(const Schema& schema, const Arguments& arguments) {
    Values values = schema.defaults();
    for (const auto& [name, text] : arguments.settings) schema.set(values, name, text);
    return values;
}

SetsToMake sets_to_make(const Arguments& arguments, Session& session) {
    const Generator& generator = find_generator(arguments.unit);
    SetsToMake job = sets_asked(generator, settings_of(generator.options, arguments), arguments);
    job.request.seed = seed_of(arguments, largest_seed(generator, job.options), session);
    job.shard = parse_shard(arguments);
    if (const auto bounds = arguments.get("bounds")) job.request.bounds = bounds_of(*bounds, job);
    return job;
}

int generate(const Arguments& arguments, Session& session) {
    SetsToMake job = sets_to_make(arguments, session);
    const Target target = target_of(arguments);
    job.command = command_of(arguments, job, target);
    produce(job, target, session.run());
    return 0;
}

int warp(const Arguments& arguments, Session& session) {
    const Scramble* scrambled = scramble_named(arguments.unit);
    settings_of(scrambled ? scrambled->options : find_warp(arguments.unit).options, arguments);
    Spec spec{.name = arguments.unit, .coordinates = {}, .settings = arguments.settings};
    if (const auto file = arguments.get("parameters")) {
        const Spec named = parse_spec(read_parameters(*file, session.run())->spec());
        if (spec.name != named.name)
            fail(ErrorKind::usage, "--parameters: is of the warp {}", named.name);
        spec.settings.insert(spec.settings.end(), named.settings.begin(), named.settings.end());
    }
    if (const auto coordinates = arguments.get("coordinates"))
        spec.coordinates = parse_spec(spec.name + "@" + *coordinates).coordinates;
    if (!scrambled)
        arguments.refuse({"seed", "sets"}, spec.name + " is a warp, which is not random");
    const Target target = target_of(arguments);
    const std::string path = only_input(arguments);
    const RunContext& run = session.run();
    if (scrambled) {
        const auto sets = read_input(path, arguments, run);
        arguments.refuse({"inverse", "density-at", "with-pdf", "with-weight"},
                         spec.name + " is a scramble, random and of density 1");
        const std::uint64_t seed = seed_of(arguments, ~std::uint64_t{0}, session);
        const auto replications = arguments.integer("sets").value_or(1);
        write_scrambled(sets, spec, seed, replications, target, run);
        return 0;
    }
    const auto stream = open_input(path, arguments, run);
    const bool inverse = arguments.has("inverse");
    const bool at_points = arguments.has("density-at");
    if (at_points)
        arguments.refuse({"inverse", "with-pdf", "with-weight"},
                         "--density-at leaves the points where they are");
    if (const auto& columns = stream->provenance().columns;
        spec.coordinates.empty() && !columns.empty())
        spec.coordinates = naming(
            path, [&] { return coordinates_by_name(spec, columns, inverse || at_points, run); });
    const bool densities = !stream->provenance().density_column.empty();
    const bool whole =
        densities || (!inverse && !at_points && takes_whole_sets(spec, stream->dimension(), run));
    Unwarped points;
    if (whole || !can_stream(*stream, target))
        points.sets = read_all(*stream, arguments, run);
    else
        points = {.stream = stream.get(),
                  .on = input_domain(stream->provenance(), stream->dimension(), arguments, run)};
    if (at_points)
        write_density_at(points, spec, target, run);
    else
        write_warped(std::move(points), spec, inverse, target, run);
    return 0;
}

int convert(const Arguments& arguments, Session& session) {
    const std::string path = only_input(arguments, "--concat takes several as one set");
    const Target target = target_of(arguments);
    auto sets = read_input(path, arguments, session.run());
    if (arguments.has("vector-output"))
        naming(path, [&] {
            sets[0].side_files = vector_files(sets[0].provenance, arguments, session.run());
        });
    else
        arguments.refuse({"vector-format"}, "is of --vector-output, which is not given");
    write_sets(sets, target, session.run());
    return 0;
}

}  // namespace stipple::cli
