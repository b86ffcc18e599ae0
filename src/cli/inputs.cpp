// SPDX-License-Identifier: MIT
#include "cli/inputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "cli/launched.hpp"
#include "cli/session.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/source_text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/units.hpp"

namespace stipple::cli {

// ---------------------------------------------------------------- files

namespace {

/// Options for reading an input, and its format; null: detected from the file's name or bytes.
std::pair<ReadOptions, const Format*> reading_of(const std::string& path, const Sources& from) {
    ReadOptions options{.source = path, .columns = from.columns, .meta_beside = true};
    const bool raw = from.from == "f32" || from.from == "f64";
    // For `convert`, --dtype is the type of the output.
    const auto type = from.dtype_in || from.verb == Verb::convert ? from.dtype_in : from.dtype;
    options.single = type.value_or(from.from == "f32");
    options.densities = from.densities;
    options.gaps = from.gaps;
    options.dimension = from.dimension;
    if (from.parameters) {
        options.levels = from.parameters->levels();
        if (from.verb != Verb::warp && !from.tables) options.expected = from.parameters->names();
    }
    const Format* format = from.from.empty() ? nullptr : &io::format_named(raw ? "bin" : from.from);
    return {std::move(options), format};
}

/// Files named on the command line, or standard input.
std::vector<std::string> named_files(const Sources& from) {
    if (from.inputs.empty()) return {"-"};
    if (std::ranges::count(from.inputs, "-") > 1)
        fail(ErrorKind::usage, "standard input is named twice");
    return from.inputs;
}

/// Opens one file to be read in blocks. @param strengths column of weights; empty: none
std::unique_ptr<io::PointStream> open_file(const std::string& path, const Sources& from,
                                           const std::string& strengths, const RunContext& run) {
    auto [options, format] = reading_of(path, from);
    options.strengths = strengths;
    return io::open_points(path, options, run, format);
}

/// Stores the domain of a table's input columns, from --parameters, --bounds or --domain, in its
/// provenance. The analyzer selects these columns later.
void take_told(PointSet& table, const Sources& from) {
    if (from.rescale) fail(ErrorKind::usage, "--rescale: these are rows of a table, not points");
    if (!!from.parameters + from.bounds.has_value() + from.domain.has_value() > 1)
        fail(ErrorKind::usage, "--parameters, --bounds and --domain: give one of them");
    Provenance& told = table.provenance;
    const auto tell = [&told](std::string domain, std::size_t dimension) {
        told.domain = std::move(domain);
        if (dimension > 0 || told.generator.empty()) told.dimension = dimension;
    };
    if (from.parameters) {
        tell(from.parameters->spec(), from.parameters->dimension());
        told.levels = from.parameters->levels();
    }
    if (from.bounds) {
        const auto ranges = static_cast<std::size_t>(std::ranges::count(*from.bounds, ',')) + 1;
        tell("box:bounds=[" + *from.bounds + "]", ranges > 1 ? ranges : 0);
    }
    if (from.domain) tell(*from.domain, 0);
    table.domain = unit_cube(table.dimension());
}

/// Completes the domain and provenance of the sets from the command line and their files.
std::vector<PointSet> named(std::vector<PointSet> sets, const Sources& from,
                            const RunContext& run) {
    for (PointSet& set : sets) {
        if (from.tables) {
            take_told(set, from);
            continue;
        }
        io::take_densities(set);
        set.domain = input_domain(set.provenance, set.dimension(), from, run);
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

std::vector<std::string> input_names(const Sources& from) {
    if (from.inputs.empty() && !from.generate.empty()) return {};
    const auto names = named_files(from);
    return from.concat ? std::vector{join(names, ", ")} : names;
}

std::string only_input(const Sources& from, const std::string& hint) {
    if (from.inputs.size() > 1 && !from.concat)
        fail_with_hint(ErrorKind::usage, hint, "{} takes one INPUT; {} are given",
                       info_of(*from.verb).name, from.inputs.size());
    return input_names(from).front();
}

DomainPtr input_domain(const Provenance& provenance, std::size_t dimension, const Sources& from,
                       const RunContext& run) {
    const std::string domain =
        from.parameters && from.verb != Verb::warp ? from.parameters->spec() : provenance.domain;
    // The file's domain does not describe columns selected by --column.
    if (!from.columns.empty() || domain == "unit-cube" || domain.empty())
        return unit_cube(dimension);
    try {
        return parse_domain(domain, dimension, run);
    } catch (const Error& e) {  // an error of the file, which has the domain
        if (e.kind() != ErrorKind::usage) throw;
        throw Error(ErrorKind::input, fmt::format("its domain {}: {}", shown(domain), e.what()),
                    e.hint());
    }
}

Error named_error(const Error& e, const std::string& input, const std::string& hint) {
    // Errors of exceeded limits are named, too, except those of standard input.
    const bool of_file =
        e.kind() == ErrorKind::input || (e.kind() == ErrorKind::limit && input != "-");
    if (!of_file) return e;
    const std::string name = io::source_name(input);
    const std::string what = e.what();
    bool named = what.starts_with(name + ":");
    // Errors in one of several joined files already name that file.
    for (const auto part : split(name, ','))
        named = named || what.starts_with(std::string(trim(part)) + ":");
    return {e.kind(), named ? what : fmt::format("{}: {}", name, what),
            e.hint().empty() ? hint : e.hint()};
}

std::vector<PointSet> read_input(const std::string& path, const Sources& from,
                                 const RunContext& run) {
    return read_all(*open_input(path, from, run), from, run);
}

std::vector<PointSet> read_input(std::string_view bytes, const std::string& path,
                                 const Sources& from, const RunContext& run) {
    const auto [options, format] = reading_of(path, from);
    auto feed = std::make_unique<io::Feed>(bytes);
    return read_all(*io::open_points(std::move(feed), path, options, run, format), from, run);
}

std::unique_ptr<io::PointStream> open_input(const std::string& path, const Sources& from,
                                            const RunContext& run, const std::string& strengths) {
    if (!from.concat) return open_file(path, from, strengths, run);
    const auto open = [&from, &run, strengths](const std::string& file) {
        return open_file(file, from, strengths, run);
    };
    return io::join_points(named_files(from), open, run);
}

std::vector<PointSet> read_all(io::PointStream& stream, const Sources& from,
                               const RunContext& run) {
    return named(stream.read_all(run), from, run);
}

// ---------------------------------------------------------------- boxes

namespace {

/// Bounding box of the points; sides of length 0 become 1, or the least that changes their ends.
Box box_around(const PointSet& points) {
    Box box = bounding_box(points.flat(), points.dimension());
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (const double low = box.low[k]; !(box.high[k] > low))
            box.high[k] = std::max(low + 1, std::nextafter(low, HUGE_VAL));
    return box;
}

/// A box that contains the points, and whether they are mapped from it to the unit cube.
struct Bounds {
    Box box;
    bool to_cube = false;

    [[nodiscard]] DomainPtr domain() const {
        return to_cube ? unit_cube(box.dimension()) : box_domain(box);
    }

    /// Checks that rows are in the box and, if `to_cube`, maps them to the unit cube. Rows may have
    /// more numbers than the box has coordinates.
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

/// Removes rows with a missing number (NaN), such as failed runs; reports and returns their number.
/// @throws Error(input) if none remain
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

void take_domain(PointSet& set, const Sources& from) {
    if (from.domain) set.domain = parse_domain(*from.domain, set.dimension());
}

/// Checks that the box around the points, with margins, fits float64. @throws Error(input)
/// @param input named in the message; empty if the caller adds the name
void require_width(const PointSet& points, const std::string& input = {}) {
    constexpr double most = 1e307;  // leaves room for margins
    const Box box = bounding_box(points.flat(), points.dimension());
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (box.low[k] < -most || box.high[k] > most)
            fail(ErrorKind::input,
                 "{}the box around the points is too wide for float64: x{} goes from {} to {}",
                 input.empty() ? "" : io::source_name(input) + ": ", k + 1,
                 format_number(box.low[k]), format_number(box.high[k]));
}

PointSet rescaled(PointSet points) {
    const Bounds around{box_around(points), true};
    return around.taken(std::move(points));
}

/// The box of --bounds for points of d coordinates; nullopt if not given.
std::optional<Bounds> bounds_of(const Sources& from, const Analyzer& analyzer, std::size_t d) {
    if (!from.bounds) return std::nullopt;
    return Bounds{parse_box(*from.bounds, d), analyzer.traits.unit_cube || from.rescale};
}

}  // namespace

std::size_t place(PointSet& points, const std::string& input, const Sources& from,
                  const RunContext& run) {
    const std::size_t left_out = leave_out_gaps(points, input, run);
    require_width(points, input);
    naming(input, [&] { take_domain(points, from); });
    if (from.rescale) points = rescaled(std::move(points));
    return left_out;
}

PointSet prepared(PointSet points, const Analyzer& analyzer, const Sources& from) {
    if (from.tables) return points;
    take_domain(points, from);
    if (const auto bounds = bounds_of(from, analyzer, points.dimension()))
        return bounds->taken(std::move(points));
    if (from.rescale) {
        require_width(points);
        return rescaled(std::move(points));
    }
    require_cube_domain(points, analyzer);
    return points;
}

Arrival arrival_of(const io::PointStream& stream, bool weighted, const Analyzer& analyzer,
                   const Sources& from, const RunContext& run) {
    const std::size_t d = stream.dimension() - (weighted ? 1 : 0);
    DomainPtr domain;
    if (const auto bounds = bounds_of(from, analyzer, d))
        domain = bounds->domain();
    else if (from.domain)
        domain = parse_domain(*from.domain, d);
    else
        domain = input_domain(stream.provenance(), d, from, run);
    return {.domain = std::move(domain), .count = stream.count(), .weighted = weighted};
}

NextRows within_bounds(NextRows next, const Arrival& arrival, std::uint64_t first,
                       const Analyzer& analyzer, const Sources& from) {
    const auto bounds = bounds_of(from, analyzer, arrival.dimension());
    if (!bounds) return next;
    return [next = std::move(next), width = arrival.width(), bounds = *bounds,
            at = first](std::span<double> rows) mutable {
        const std::size_t count = next(rows);
        bounds.take(rows.first(count * width), width, at);
        at += count;
        return count;
    };
}

SharedSet shared_files(const Sources& from, const Analyzer& analyzer, const std::string& strengths,
                       Ranks& ranks, const RunContext& run) {
    const auto open = [&from, run, strengths](const std::string& path) {
        return open_file(path, from, strengths, run);
    };
    const SharedSet shared = shared_in_files(from.inputs, open, ranks, run);
    const auto front = open(from.inputs.front());
    const bool own = from.columns.empty() && !from.parameters;
    const std::string domain = from.domain.value_or(own ? front->provenance().domain : "");
    if (!from.bounds) require_same_files(files_in(domain, " x "), ranks, run);
    Arrival points = arrival_of(*front, !strengths.empty(), analyzer, from, run);
    points.count = shared.points.count;
    return {.points = points, .from = [=, &analyzer, &from](std::uint64_t first) {
                return within_bounds(shared.from(first), points, first, analyzer, from);
            }};
}

// ---------------------------------------------------------------- generators

namespace {

std::uint64_t drawn_seed(std::uint64_t largest) {
    std::random_device device;
    const std::uint64_t bits = (static_cast<std::uint64_t>(device()) << 32) | device();
    // At most 53 bits, since some programs read numbers as doubles.
    return bits % (std::min(largest, (std::uint64_t{1} << 53) - 1) + 1);
}

}  // namespace

std::uint64_t largest_seed(const Generator& generator, const Values& values) {
    return generator.max_seed ? generator.max_seed(values) : ~std::uint64_t{0};
}

std::uint64_t seed_of(const Request& request, std::uint64_t largest, Session& session) {
    const Seed given = request.seed.value_or(Seed());
    if (!given.random) return given.value;
    if (Ranks& ranks = joined_ranks(); ranks.size() > 1) {
        ranks.end_together();
        fail(ErrorKind::usage, "--seed: every rank would draw another one; give a number");
    }
    const std::uint64_t seed = drawn_seed(largest);
    session.tell(fmt::format("--seed {}", seed));
    return seed;
}

std::uint64_t seed_for_generators(const Sources& from, Session& session) {
    std::uint64_t largest = ~std::uint64_t{0};
    for (const std::string& text : from.generate) {
        const Spec spec = parse_generator(text).unit;
        const Generator& generator = find_generator(spec.name);
        largest = std::min(largest, largest_seed(generator, spec.values(generator.options)));
    }
    return seed_of(from, largest, session);
}

SetsToMake sets_asked(const Generator& generator, Values options, const Sources& from) {
    SetsToMake asked{
        .generator = &generator,
        .options = std::move(options),
        .request = {.count = from.count, .dimension = from.dimension, .start = from.start},
        .sets = from.sets,
        .warps = from.warps};
    if (!from.parameters) return asked;
    if (!asked.request.dimension) asked.request.dimension = from.parameters->dimension();
    const Spec warp = parse_spec(from.parameters->spec());
    asked.warps.push_back(from.unit_cube ? in_unit_cube(warp) : warp);
    return asked;
}

GeneratedSets generated_sets(const std::string& spec, std::uint64_t seed, const Sources& from,
                             const RunContext& run) {
    const GeneratorSpec named = parse_generator(spec);
    const Generator& generator = find_generator(named.unit.name);
    SetsToMake asked = sets_asked(generator, named.unit.values(generator.options), from);
    for (std::size_t i = 0; i < named.warps.size(); ++i)
        asked.warps.insert(asked.warps.begin() + static_cast<std::ptrdiff_t>(i),
                           parse_spec(named.warps[i]));
    asked.request.seed = seed;
    require_same_files(files_of(generator, asked.options, asked.warps), joined_ranks(), run);
    return {std::move(asked), run};
}

void read_parameter_file(Request& request, const RunContext& run) {
    if (!request.parameters_file) return;
    const std::string& path = *request.parameters_file;
    Ranks& ranks = joined_ranks();
    require_same_files({path}, ranks, run);
    agreed(ranks, [&] { request.parameters = read_parameters(path, run); });
    if (const auto rank = unlike_rank(request.parameters->spec(), ranks))
        fail(ErrorKind::input, "{}: a file that it names is not the same for rank {} as for rank 0",
             path, *rank);
}

}  // namespace stipple::cli
