// SPDX-License-Identifier: MIT
//
// The verbs that write points: generate, warp, convert.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <random>

#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "io/files.hpp"
#include "io/source_text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple::cli {
namespace {

bool asks_single(const Arguments& arguments, bool otherwise) {
    const auto text = arguments.get("dtype");
    return text ? *text == "f32" : otherwise;
}

const Format& output_format(const Arguments& arguments, const std::string& path) {
    if (const auto name = arguments.get("format")) return io::format_named(*name);
    const Format* format = io::format_of_extension(path);
    return format ? *format : io::format_named("csv");
}

std::optional<Shard> parse_shard(const Arguments& arguments) {
    const auto text = arguments.get("shard");
    if (!text) return std::nullopt;
    const auto parts = split(*text, '/');
    const auto index = parts.size() == 2 ? parse_unsigned(parts[0]) : std::nullopt;
    const auto of = parts.size() == 2 ? parse_unsigned(parts[1]) : std::nullopt;
    if (!index || !of || *index >= *of)
        fail(ErrorKind::usage, "--shard: '{}' is not I/K with 0 <= I < K", *text);
    return Shard{*index, *of};
}

std::uint64_t drawn_seed(std::uint64_t largest) {
    std::random_device device;
    const std::uint64_t bits = (static_cast<std::uint64_t>(device()) << 32) | device();
    // 53 bits at most, so that the seed survives every program that reads numbers as doubles.
    return bits % (std::min(largest, (std::uint64_t{1} << 53) - 1) + 1);
}

/// The command that makes these bytes: what was typed, less what cannot change them.
std::string command_of(const Arguments& arguments, const Generator& generator,
                       const Values& job_options, const Target& target, std::uint64_t seed) {
    const auto& options = generator.options.options();
    std::vector<std::string> words = {"stipple", "generate", arguments.unit};
    const auto type = [&words](const std::string& name, const std::string& text, bool flag) {
        words.push_back("--" + name);
        if (!flag) words.push_back(shell_word(text));
    };
    for (const auto& [name, text] : arguments.settings) {
        if (std::ranges::find(generator.writes, name) != generator.writes.end()) continue;
        const bool flag = std::ranges::find(options, name, &Option::name)->type == "flag";
        if (!flag || std::get<bool>(job_options.find(name).value)) type(name, text, flag);
    }
    const std::vector<std::string> silent = {"output",     "format", "threads", "quiet",
                                             "max-memory", "seed",   "progress"};
    const std::vector<std::string> flags = {"with-pdf", "with-weight", "meta", "no-header"};
    for (const auto& [name, text] : arguments.common)
        if (std::ranges::find(silent, name) == silent.end())
            type(name, text, std::ranges::find(flags, name) != flags.end());
    if (arguments.has("seed")) type("seed", std::to_string(seed), false);
    if (target.format->name != "csv") type("format", target.format->name, false);
    return join(words, " ");
}

}  // namespace

std::vector<std::string> input_names(const Arguments& arguments) {
    std::vector<std::string> names = arguments.inputs;
    if (names.empty()) names.emplace_back("-");
    if (std::ranges::count(names, "-") > 1) fail(ErrorKind::usage, "standard input is named twice");
    return names;
}

std::string output_of(const Arguments& arguments) {
    std::string path = arguments.get("output").value_or("-");
    if (file_per_set(path))
        fail(ErrorKind::usage, "--output: one file is written for all sets; '{}' names several",
             path);
    return path;
}

std::string command_text(const Arguments& arguments, std::span<const std::string> left_out) {
    std::string text;
    for (const std::string& input : arguments.inputs) text += fmt::format(" {}", shell_word(input));
    for (const auto& [name, value] : arguments.common) {
        if (std::ranges::find(left_out, name) != left_out.end()) continue;
        text += fmt::format(" --{}", name);
        if (find_common("--" + name, *arguments.verb)->option.type != "flag")
            text += fmt::format(" {}", shell_word(value));
    }
    return text;
}

std::string shell_word(const std::string& word) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%^";
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) return word;
    std::string out = "'";
    for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    return out + "'";
}

std::uint64_t seed_of(const Arguments& arguments, std::uint64_t largest, Session& session) {
    const auto text = arguments.get("seed");
    if (!text) return 1;
    if (*text == "random") {
        const std::uint64_t seed = drawn_seed(largest);
        session.warn(fmt::format("--seed {}", seed));
        return seed;
    }
    const auto seed = parse_unsigned(*text);
    if (!seed)
        fail(ErrorKind::usage, "--seed: '{}' is not a whole number in [0, 2^64) or 'random'",
             *text);
    return *seed;
}

Request request_of(const Arguments& arguments) {
    Request request;
    request.count = arguments.integer("count");
    if (const auto d = arguments.integer("dimension")) request.dimension = *d;
    request.start = arguments.integer("start").value_or(0);
    return request;
}

Target target_of(const Arguments& arguments) {
    Target target;
    target.path = arguments.get("output").value_or("-");
    target.format = &output_format(arguments, target.path);
    target.header = !arguments.has("no-header");
    target.meta = arguments.has("meta");
    target.single = asks_single(arguments, target.path.ends_with(".f32"));
    if (const auto digits = arguments.integer("precision"))
        target.precision = static_cast<int>(*digits);
    target.columns = {.pdf = arguments.has("with-pdf"), .weight = arguments.has("with-weight")};
    const bool terminal = target.path == "-" && isatty(STDOUT_FILENO) == 1;
    if (target.format->traits.binary && terminal)
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

namespace {

/// How an input is to be read.
struct Reading {
    ReadOptions options;
    const Format* format = nullptr;  ///< as named; else by its name or its bytes
};

Reading reading_of(const std::string& path, const Arguments& arguments) {
    ReadOptions options{.source = path};
    std::string from = arguments.get("from").value_or("");
    const bool convert = arguments.verb == Verb::convert;
    options.single = path.ends_with(".f32") || from == "f32";
    if (!convert) options.single = asks_single(arguments, options.single);
    if (from == "f32" || from == "f64") from = "bin";
    if (const auto d = arguments.integer("dimension")) options.dimension = *d;
    if (const auto columns = arguments.get("column"))
        for (const auto column : split(*columns, ',')) options.columns.emplace_back(trim(column));
    return {std::move(options), from.empty() ? nullptr : &io::format_named(from)};
}

/// Domain and provenance as the program knows them.
std::vector<PointSet> named(std::vector<PointSet> sets, const Arguments& arguments,
                            const RunContext& run) {
    for (PointSet& set : sets) {
        set.domain = input_domain(set.provenance, set.dimension(), arguments, run);
        set.provenance.domain = set.domain->spec();
        set.provenance.count = set.count();
        set.provenance.dimension = set.dimension();
    }
    return sets;
}

}  // namespace

DomainPtr input_domain(const Provenance& provenance, std::size_t dimension,
                       const Arguments& arguments, const RunContext& run) {
    const std::string& domain = provenance.domain;
    // Columns picked by hand are not what the file's domain speaks of.
    if (arguments.has("column") || domain == "unit-cube" || domain.empty())
        return unit_cube(dimension);
    try {
        return parse_domain(domain, dimension, run);
    } catch (const Error& e) {  // it is the file that is wrong, not the call
        if (e.kind() != ErrorKind::usage) throw;
        throw Error(ErrorKind::input, fmt::format("its domain {}: {}", io::shown(domain), e.what()),
                    e.hint());
    }
}

std::vector<PointSet> read_input(const std::string& path, const Arguments& arguments,
                                 const RunContext& run) {
    const auto [options, format] = reading_of(path, arguments);
    return named(io::read_points(path, options, run, format), arguments, run);
}

std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Arguments& arguments, const RunContext& run) {
    const auto [options, format] = reading_of(path, arguments);
    return named(io::read_sets(bytes, path, options, run, format), arguments, run);
}

std::unique_ptr<io::PointStream> open_joined(const Arguments& arguments, const RunContext& run,
                                             const std::string& strengths) {
    return io::join_points(input_names(arguments),
                           [&arguments, &run, strengths](const std::string& path) {
                               return open_input(path, arguments, run, strengths);
                           });
}

std::vector<PointSet> read_joined(const Arguments& arguments, const RunContext& run) {
    return named(open_joined(arguments, run)->read_all(run), arguments, run);
}

std::unique_ptr<io::PointStream> open_input(const std::string& path, const Arguments& arguments,
                                            const RunContext& run, const std::string& strengths) {
    auto [options, format] = reading_of(path, arguments);
    options.strengths = strengths;
    return io::open_points(path, options, run, format);
}

namespace {

/// The box of --bounds, with a range for each coordinate, or one for all. How many there are is
/// planned in the box itself: options are checked by it.
Box bounds_of(const std::string& text, const Production& job) {
    const auto ranges = static_cast<std::size_t>(1 + std::ranges::count(text, ','));
    Request request = job.request;
    request.bounds = parse_box(text, request.dimension.value_or(std::max<std::size_t>(ranges, 2)));
    return parse_box(text, plan_for(*job.generator, request, job.options).dimension);
}

}  // namespace

Production production_of(const Arguments& arguments, Session& session) {
    Production job;
    job.generator = &find_generator(arguments.unit);
    job.options = settings_of(job.generator->options, arguments);
    job.request = request_of(arguments);
    const auto& max_seed = job.generator->max_seed;
    job.request.seed =
        seed_of(arguments, max_seed ? max_seed(job.options) : ~std::uint64_t{0}, session);
    job.sets = arguments.integer("sets").value_or(1);
    job.shard = parse_shard(arguments).value_or(Shard{});
    for (const auto& spec : arguments.all("warp")) job.warps.push_back(parse_spec(spec));
    if (const auto bounds = arguments.get("bounds")) job.request.bounds = bounds_of(*bounds, job);
    return job;
}

int generate(const Arguments& arguments, Session& session) {
    Production job = production_of(arguments, session);
    const Target target = target_of(arguments);
    job.command = command_of(arguments, *job.generator, job.options, target, job.request.seed);
    produce(job, target, session.run());
    return 0;
}

namespace {

/// Replications of the input by a scramble.
int scramble(const Arguments& arguments, const Spec& spec, const std::vector<PointSet>& sets,
             const Target& target, Session& session) {
    for (const char* option : {"inverse", "with-pdf", "with-weight"})
        if (arguments.has(option))
            fail(ErrorKind::usage, "--{}: {} is a scramble, random and of density 1", option,
                 spec.name);
    const std::uint64_t seed = seed_of(arguments, ~std::uint64_t{0}, session);
    const auto replications = arguments.integer("sets").value_or(1);
    write_scrambled(sets, spec, seed, replications, target, session.run());
    return 0;
}

}  // namespace

int warp(const Arguments& arguments, Session& session) {
    const bool scrambles = scramble_named(arguments.unit) != nullptr;
    settings_of(
        scrambles ? scramble_named(arguments.unit)->options : find_warp(arguments.unit).options,
        arguments);
    Spec spec{.name = arguments.unit, .coordinates = {}, .settings = arguments.settings};
    if (const auto coordinates = arguments.get("coordinates"))
        spec.coordinates = parse_spec(spec.name + "@" + *coordinates).coordinates;
    for (const char* option : {"seed", "sets"})
        if (!scrambles && arguments.has(option))
            fail(ErrorKind::usage, "--{}: {} is a warp, which is not random", option, spec.name);
    const Target target = target_of(arguments);
    if (arguments.inputs.size() > 1)
        fail(ErrorKind::usage, "warp takes one INPUT; {} are given", arguments.inputs.size());
    const std::string path = arguments.inputs.empty() ? "-" : arguments.inputs[0];
    const RunContext& run = session.run();
    if (scrambles)
        return scramble(arguments, spec, read_input(path, arguments, run), target, session);
    const auto stream = open_input(path, arguments, run);
    const bool inverse = arguments.has("inverse");
    if (can_stream(*stream, target))
        write_warped(*stream,
                     input_domain(stream->provenance(), stream->dimension(), arguments, run), spec,
                     inverse, target, run);
    else
        write_warped(named(stream->read_all(run), arguments, run), spec, inverse, target, run);
    return 0;
}

int convert(const Arguments& arguments, Session& session) {
    const bool joined = arguments.has("concat");
    if (arguments.inputs.size() > 1 && !joined)
        fail_with_hint(ErrorKind::usage, "--concat takes several as one set",
                       "convert takes one INPUT; {} are given", arguments.inputs.size());
    const std::string path = arguments.inputs.empty() ? "-" : arguments.inputs[0];
    const Target target = target_of(arguments);
    const RunContext& run = session.run();
    write_sets(joined ? read_joined(arguments, run) : read_input(path, arguments, run), target,
               run);
    return 0;
}

}  // namespace stipple::cli
