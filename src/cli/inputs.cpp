// SPDX-License-Identifier: MIT
#include "cli/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "io/source_text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/units.hpp"

namespace stipple::cli {

// ---------------------------------------------------------------- files

namespace {

/// Options for reading an input.
struct Reading {
    ReadOptions options;
    const Format* format = nullptr;  ///< given by name; nullptr: from the file's name or bytes
};

/// Analyzers named on an `analyze` command line; empty for other verbs.
std::vector<const Analyzer*> analyzers_of(const Arguments& arguments) {
    std::vector<const Analyzer*> named;
    if (arguments.verb != Verb::analyze) return named;
    for (const std::string& spec : arguments.specs)
        named.push_back(&find_analyzer(parse_spec(spec).name));
    if (named.empty()) named.push_back(&find_analyzer(arguments.unit));
    return named;
}

/// Whether inputs are read as rows of tables, which is so if all analyzers need tables.
bool reads_tables(const Arguments& arguments) {
    const auto analyzers = analyzers_of(arguments);
    return !analyzers.empty() &&
           std::ranges::all_of(analyzers, [](const Analyzer* a) { return a->traits.table; });
}

Reading reading_of(const std::string& path, const Arguments& arguments) {
    ReadOptions options{.source = path};
    std::string from = arguments.get("from").value_or("");
    options.single = from == "f32";
    const auto analyzers = analyzers_of(arguments);
    options.densities = arguments.verb == Verb::convert ||
                        (arguments.verb == Verb::warp && !arguments.has("density-at")) ||
                        std::ranges::any_of(analyzers, [](const Analyzer* analyzer) {
                            return analyzer->traits.densities;
                        });
    // Plots and reports skip rows with gaps.
    options.gaps =
        arguments.verb == Verb::plot || arguments.verb == Verb::report || reads_tables(arguments);
    auto type = arguments.get("input-dtype");
    if (!type && arguments.verb != Verb::convert) type = arguments.get("dtype");
    if (type) options.single = *type == "f32";
    if (from == "f32" || from == "f64") from = "bin";
    if (const auto d = arguments.integer("dimension")) options.dimension = *d;
    if (const auto columns = arguments.get("column"))
        for (const auto column : split(*columns, ',')) options.columns.emplace_back(trim(column));
    if (const auto file = arguments.get("parameters")) {
        const auto named = read_parameters(*file);
        options.levels = named->levels();
        if (arguments.verb != Verb::warp && !reads_tables(arguments))
            options.expected = named->names();
    }
    return {std::move(options), from.empty() ? nullptr : &io::format_named(from)};
}

/// Files named on the command line, or standard input.
std::vector<std::string> named_files(const Arguments& arguments) {
    if (arguments.inputs.empty()) return {"-"};
    if (std::ranges::count(arguments.inputs, "-") > 1)
        fail(ErrorKind::usage, "standard input is named twice");
    return arguments.inputs;
}

/// Opens one file to be read in blocks.
std::unique_ptr<io::PointStream> open_file(const std::string& path, const Arguments& arguments,
                                           const std::string& strengths, const RunContext& run) {
    auto [options, format] = reading_of(path, arguments);
    options.strengths = strengths;
    return io::open_points(path, options, run, format);
}

/// Records the domain of the table's inputs, from --parameters, --bounds or --domain; the analyzer
/// identifies the input columns.
void take_told(PointSet& table, const Arguments& arguments, const RunContext& run) {
    if (arguments.has("rescale"))
        fail(ErrorKind::usage, "--rescale: these are rows of a table, not points");
    if (arguments.has("parameters") + arguments.has("bounds") + arguments.has("domain") > 1)
        fail(ErrorKind::usage, "--parameters, --bounds and --domain: give one of them");
    Provenance& told = table.provenance;
    const auto tell = [&told](std::string domain, std::size_t dimension) {
        told.domain = std::move(domain);
        if (dimension > 0 || told.generator.empty()) told.dimension = dimension;
    };
    if (const auto file = arguments.get("parameters")) {
        const auto named = read_parameters(*file, run);
        tell(named->spec(), named->dimension());
        told.levels = named->levels();
    }
    if (const auto bounds = arguments.get("bounds")) {
        const auto ranges = static_cast<std::size_t>(std::ranges::count(*bounds, ',')) + 1;
        tell("box:bounds=[" + *bounds + "]", ranges > 1 ? ranges : 0);
    }
    if (const auto domain = arguments.get("domain")) tell(*domain, 0);
    table.domain = unit_cube(table.dimension());
}

/// Completes the domain and provenance of the sets from the command line and their files.
std::vector<PointSet> named(std::vector<PointSet> sets, const Arguments& arguments,
                            const RunContext& run) {
    for (PointSet& set : sets) {
        if (reads_tables(arguments)) {
            take_told(set, arguments, run);
            continue;
        }
        io::take_densities(set);
        set.domain = input_domain(set.provenance, set.dimension(), arguments, run);
        set.provenance.domain = set.domain->spec();
        if (set.provenance.columns.empty()) set.provenance.columns = set.domain->names();
        if (set.provenance.levels.empty()) set.provenance.levels = set.domain->levels();
        set.provenance.count = set.count();
        set.provenance.dimension = set.dimension();
        complete(set.provenance);
    }
    return sets;
}

}  // namespace

std::vector<std::string> input_names(const Arguments& arguments) {
    if (arguments.inputs.empty() && arguments.has("generate")) return {};
    const auto files = named_files(arguments);
    return arguments.has("concat") ? std::vector{join(files, ", ")} : files;
}

std::string only_input(const Arguments& arguments, const std::string& hint) {
    if (arguments.inputs.size() > 1 && !arguments.has("concat"))
        fail_with_hint(ErrorKind::usage, hint, "{} takes one INPUT; {} are given",
                       info_of(*arguments.verb).name, arguments.inputs.size());
    return input_names(arguments).front();
}

DomainPtr input_domain(const Provenance& provenance, std::size_t dimension,
                       const Arguments& arguments, const RunContext& run) {
    const auto file = arguments.get("parameters");
    const std::string domain = file && arguments.verb != Verb::warp
                                   ? read_parameters(*file, run)->spec()
                                   : provenance.domain;
    // The file's domain does not describe columns selected by --column.
    if (arguments.has("column") || domain == "unit-cube" || domain.empty())
        return unit_cube(dimension);
    try {
        return parse_domain(domain, dimension, run);
    } catch (const Error& e) {  // the file is at fault, not the command line
        if (e.kind() != ErrorKind::usage) throw;
        throw Error(ErrorKind::input, fmt::format("its domain {}: {}", shown(domain), e.what()),
                    e.hint());
    }
}

Error named_error(const Error& e, const std::string& input, const std::string& hint) {
    // The contents of a file can exceed a limit, too; standard input needs no name.
    const bool of_file =
        e.kind() == ErrorKind::input || (e.kind() == ErrorKind::limit && input != "-");
    if (!of_file) return e;
    const std::string name = io::source_name(input);
    const std::string what = e.what();
    bool named = what.starts_with(name + ":");
    // Errors in one of several joined files already name it.
    for (const auto part : split(name, ','))
        named = named || what.starts_with(std::string(trim(part)) + ":");
    return {e.kind(), named ? what : fmt::format("{}: {}", name, what),
            hint.empty() ? e.hint() : hint};
}

void take_domain(PointSet& set, const Arguments& arguments) {
    if (const auto domain = arguments.get("domain"))
        set.domain = parse_domain(*domain, set.dimension());
}

std::size_t leave_out_gaps(PointSet& set, const std::string& input, const RunContext& run) {
    const std::size_t d = set.dimension();
    const std::size_t all = set.count();
    std::vector<double> rows;
    std::vector<double> densities;
    for (std::size_t i = 0; i < all; ++i) {
        if (std::ranges::any_of(set[i], [](double x) { return std::isnan(x); })) continue;
        rows.insert(rows.end(), set[i].begin(), set[i].end());
        if (!set.densities.empty()) densities.push_back(set.densities[i]);
    }
    const std::size_t left_out = all - rows.size() / d;
    if (left_out == 0) return 0;
    if (rows.empty())
        fail(ErrorKind::input, "{}: each of its {} rows has a missing number",
             io::source_name(input), all);
    run.notify(fmt::format("{}: {} of {} rows are left out; numbers are missing in them",
                           io::source_name(input), left_out, all));
    PointSet kept(std::move(rows), d);
    kept.domain = std::move(set.domain);
    kept.densities = std::move(densities);
    kept.provenance = std::move(set.provenance);
    kept.provenance.count = kept.count();
    set = std::move(kept);
    return left_out;
}

std::vector<PointSet> read_input(const std::string& path, const Arguments& arguments,
                                 const RunContext& run) {
    return read_all(*open_input(path, arguments, run), arguments, run);
}

std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Arguments& arguments, const RunContext& run) {
    const auto [options, format] = reading_of(path, arguments);
    return named(io::read_sets(bytes, path, options, run, format), arguments, run);
}

std::unique_ptr<io::PointStream> open_input(const std::string& path, const Arguments& arguments,
                                            const RunContext& run, const std::string& strengths) {
    if (!arguments.has("concat")) return open_file(path, arguments, strengths, run);
    return io::join_points(named_files(arguments),
                           [&arguments, &run, strengths](const std::string& file) {
                               return open_file(file, arguments, strengths, run);
                           });
}

std::vector<PointSet> read_all(io::PointStream& stream, const Arguments& arguments,
                               const RunContext& run) {
    return named(stream.read_all(run), arguments, run);
}

// ---------------------------------------------------------------- boxes

namespace {

/// Bounding box of the points; sides of length 0 become 1.
Box box_around(const PointSet& points) {
    Box box = bounding_box(points.flat(), points.dimension());
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (!(box.high[k] > box.low[k])) box.high[k] = box.low[k] + 1;
    return box;
}

/// A box that contains the points, and whether they are mapped from it to the unit cube.
struct Bounds {
    Box box;
    bool to_cube = false;

    [[nodiscard]] DomainPtr domain() const {
        return to_cube ? unit_cube(box.dimension()) : box_domain(box);
    }

    /// Checks that rows are in the box and, if `to_cube`, maps them. Rows may have more numbers than
    /// the box has coordinates.
    /// @param first index of the first point, for messages
    /// @throws Error(input) for points outside
    void take(std::span<double> rows, std::size_t width, std::uint64_t first) const {
        const DomainPtr around = box_domain(box);
        const std::size_t d = box.dimension();
        for (std::size_t i = 0; i < rows.size(); i += width)
            if (!around->contains(rows.subspan(i, d)))
                fail(ErrorKind::input, "point {} is outside the bounds {}", first + i / width,
                     format_box(box));
        for (std::size_t i = 0; to_cube && i < rows.size(); i += width)
            around->to_cube(rows.subspan(i, d), rows.subspan(i, d));
    }

    [[nodiscard]] PointSet taken(PointSet points) const {
        take(points.flat(), box.dimension(), 0);
        if (to_cube)
            for (double& density : points.densities) density *= volume_of(box);
        points.domain = domain();
        return points;
    }
};

PointSet rescaled(PointSet points) {
    const Bounds around{box_around(points), true};
    return around.taken(std::move(points));
}

/// --bounds, for an analyzer of points of d coordinates.
std::optional<Bounds> bounds_of(const Arguments& arguments, const Analyzer& analyzer,
                                std::size_t d) {
    const auto text = arguments.get("bounds");
    if (!text) return std::nullopt;
    return Bounds{parse_box(*text, d), analyzer.traits.unit_cube || arguments.has("rescale")};
}

}  // namespace

void require_width(const PointSet& points, const std::string& input) {
    constexpr double most = 1e307;  // leaves room for margins
    const Box box = bounding_box(points.flat(), points.dimension());
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (box.low[k] < -most || box.high[k] > most)
            fail(ErrorKind::input,
                 "{}the box around the points is too wide for float64: x{} goes from {} to {}",
                 input.empty() ? "" : io::source_name(input) + ": ", k + 1,
                 format_number(box.low[k]), format_number(box.high[k]));
}

PointSet placed(PointSet points, const std::string& input, const Arguments& arguments) {
    require_width(points, input);
    naming(input, [&] { take_domain(points, arguments); });
    return arguments.has("rescale") ? rescaled(std::move(points)) : std::move(points);
}

PointSet of_the_cube(PointSet points, const Analyzer& analyzer) {
    const std::string domain = points.domain->spec();
    const auto outside = [](double x) { return !(x >= 0 && x <= 1); };
    if (!analyzer.traits.unit_cube || domain == "unit-cube" ||
        (domain.starts_with("box") &&
         points.domain->bounding_box() == unit_cube(points.dimension())->bounding_box()) ||
        std::ranges::any_of(points.flat(), outside))  // reported later, with the first such point
        return points;
    fail_with_hint(ErrorKind::input,
                   way_to_cube(points) + "; --domain unit-cube takes them as they are",
                   "{} measures points against the unit cube; the domain of these is {}",
                   analyzer.name, points.domain->title());
}

PointSet prepared(PointSet points, const Analyzer& analyzer, const Arguments& arguments) {
    if (analyzer.traits.table && reads_tables(arguments)) return points;
    take_domain(points, arguments);
    if (const auto bounds = bounds_of(arguments, analyzer, points.dimension()))
        return bounds->taken(std::move(points));
    if (arguments.has("rescale")) {
        require_width(points);
        return rescaled(std::move(points));
    }
    return of_the_cube(std::move(points), analyzer);
}

Arrival arrival_of(const io::PointStream& stream, bool weighted, const Analyzer& analyzer,
                   const Arguments& arguments, const RunContext& run) {
    const std::size_t d = stream.dimension() - (weighted ? 1 : 0);
    DomainPtr domain;
    if (const auto bounds = bounds_of(arguments, analyzer, d))
        domain = bounds->domain();
    else if (const auto named = arguments.get("domain"))
        domain = parse_domain(*named, d);
    else
        domain = input_domain(stream.provenance(), d, arguments, run);
    return {.domain = std::move(domain), .count = stream.count(), .weighted = weighted};
}

NextRows within_bounds(NextRows next, const Arrival& arrival, std::uint64_t first,
                       const Analyzer& analyzer, const Arguments& arguments) {
    const auto bounds = bounds_of(arguments, analyzer, arrival.dimension());
    if (!bounds) return next;
    return [next = std::move(next), width = arrival.width(), bounds = *bounds,
            at = first](std::span<double> rows) mutable {
        const std::size_t count = next(rows);
        bounds.take(rows.first(count * width), width, at);
        at += count;
        return count;
    };
}

SharedSet shared_files(const Arguments& arguments, const Analyzer& analyzer,
                       const std::string& strengths, Ranks& ranks, const RunContext& run) {
    const auto open = [&arguments, run, strengths](const std::string& path) {
        return open_file(path, arguments, strengths, run);
    };
    const SharedSet files = shared_in_files(arguments.inputs, open, ranks, run);
    Arrival points =
        arrival_of(*open(arguments.inputs.front()), !strengths.empty(), analyzer, arguments, run);
    points.count = files.points.count;
    return {.points = points, .from = [=, &analyzer, &arguments](std::uint64_t first) {
                return within_bounds(files.from(first), points, first, analyzer, arguments);
            }};
}

// ---------------------------------------------------------------- generators

namespace {

std::uint64_t drawn_seed(std::uint64_t largest) {
    std::random_device device;
    const std::uint64_t bits = (static_cast<std::uint64_t>(device()) << 32) | device();
    // At most 53 bits, so that programs that read numbers as doubles preserve the seed.
    return bits % (std::min(largest, (std::uint64_t{1} << 53) - 1) + 1);
}

}  // namespace

std::uint64_t largest_seed(const Generator& generator, const Values& values) {
    return generator.max_seed ? generator.max_seed(values) : ~std::uint64_t{0};
}

std::uint64_t seed_of(const Arguments& arguments, std::uint64_t largest, Session& session) {
    const auto text = arguments.get("seed");
    if (!text) return 1;
    if (*text == "random") {
        const std::uint64_t seed = drawn_seed(largest);
        session.tell(fmt::format("--seed {}", seed));
        return seed;
    }
    const auto seed = parse_unsigned(*text);
    if (!seed)
        fail(ErrorKind::usage, "--seed: '{}' is not a whole number in [0, 2^64) or 'random'",
             *text);
    return *seed;
}

std::uint64_t seed_for(const Arguments& arguments, std::span<const std::string> specs,
                       Session& session) {
    std::uint64_t largest = ~std::uint64_t{0};
    for (const std::string& text : specs) {
        const Spec spec = parse_spec(text);
        const Generator& generator = find_generator(spec.name);
        largest = std::min(largest, largest_seed(generator, spec.values(generator.options)));
    }
    return seed_of(arguments, largest, session);
}

SetsToMake sets_asked(const Generator& generator, Values options, const Arguments& arguments) {
    SetsToMake asked{.generator = &generator, .options = std::move(options)};
    asked.request.count = arguments.integer("count");
    if (const auto d = arguments.integer("dimension")) asked.request.dimension = *d;
    asked.request.start = arguments.integer("start").value_or(0);
    asked.sets = arguments.integer("sets").value_or(1);
    for (const auto& text : arguments.all("warp")) asked.warps.push_back(parse_spec(text));
    if (const auto file = arguments.get("parameters")) {
        const auto named = read_parameters(*file);
        if (!asked.request.dimension) asked.request.dimension = named->dimension();
        const Spec warp = parse_spec(named->spec());
        asked.warps.push_back(arguments.has("unit-cube") ? in_unit_cube(warp) : warp);
    } else {
        arguments.refuse({"unit-cube"}, "is of --parameters, which is not given");
    }
    return asked;
}

GeneratedSets generated_sets(const std::string& spec, std::uint64_t seed,
                             const Arguments& arguments, const RunContext& run) {
    const Spec named = parse_spec(spec);
    const Generator& generator = find_generator(named.name);
    SetsToMake asked = sets_asked(generator, named.values(generator.options), arguments);
    asked.request.seed = seed;
    return {std::move(asked), run};
}

void require_options_of_sources(const Arguments& arguments) {
    if (!arguments.has("generate"))
        arguments.refuse({"count", "seed", "sets", "warp", "start", "unit-cube"},
                         "is of --generate, which names a generator");
    else if (arguments.inputs.empty())
        arguments.refuse({"bounds", "rescale", "domain", "column", "from", "dtype", "input-dtype"},
                         "is of points from files, not of --generate");
}

}  // namespace stipple::cli
