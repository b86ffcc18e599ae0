// SPDX-License-Identifier: MIT
//
// The public API except studies and pages: calls by name, and checks of the caller's arguments.
#include <cmath>
#include <mutex>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "io/format.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/produce.hpp"
#include "pipeline/units.hpp"
#include "pipeline/warping.hpp"
#include "stipple/analyze.hpp"
#include "stipple/generate.hpp"
#include "stipple/io.hpp"
#include "stipple/warp.hpp"

namespace stipple {
namespace {

template <class Unit>
std::vector<std::string> names_of_units(const std::vector<Unit>& units) {
    std::vector<std::string> names;
    for (const Unit& unit : units) names.push_back(unit.name);
    return names;
}

/// Options of a spec, overridden by `settings`.
Values merged(const Spec& spec, const Schema& schema, const Settings& settings) {
    Values values = spec.values(schema);
    for (const auto& [name, text] : settings) schema.set(values, name, text);
    return values;
}

Spec spec_without_coordinates(std::string_view text) {
    Spec spec = parse_spec(text);
    if (!spec.coordinates.empty())
        fail(ErrorKind::usage, "{}: only warps and scrambles take coordinates after @", text);
    return spec;
}

DomainPtr domain_or_cube(const PointSet& points) {
    return points.domain ? points.domain : unit_cube(points.dimension());
}

/// Returns a checked copy of a set; its domain is the unit cube if it has none.
PointSet checked(PointSet set) {
    check_set(set);
    set.domain = domain_or_cube(set);
    return set;
}

void require_rows(std::span<const double> rows, std::size_t dimension) {
    if (dimension == 0 || rows.size() % dimension != 0)
        fail(ErrorKind::usage, "{} numbers cannot be divided into rows of {}", rows.size(),
             dimension);
}

}  // namespace

std::vector<std::string> generator_names() { return names_of_units(generators::all()); }
std::vector<std::string> warp_names() { return names_of_units(warps::all()); }
std::vector<std::string> scramble_names() { return names_of_units(scrambles::all()); }
std::vector<std::string> analyzer_names() { return names_of_units(analyzers::all()); }

PointSet generate(std::string_view text, const Request& request, const Settings& settings,
                  const RunContext& run) try {
    const Spec spec = spec_without_coordinates(text);
    const Generator& generator = find_generator(spec.name);
    return generate(generator, request, merged(spec, generator.options, settings), run);
} catch (...) {
    throw_to_caller();
}

Report analyze(std::string_view text, const PointSet& points, const Settings& settings,
               const RunContext& run) try {
    const Spec spec = spec_without_coordinates(text);
    const Analyzer& analyzer = find_analyzer(spec.name);
    if (!points.domain) {
        PointSet placed = points;
        placed.domain = unit_cube(points.dimension());
        return analyze(text, placed, settings, run);
    }
    check_densities(points);
    return analyze(analyzer, points, merged(spec, analyzer.options, settings), run);
} catch (...) {
    throw_to_caller();
}

// ---------------------------------------------------------------- samples one by one

struct Sampler::State {
    Plan plan;
    std::uint64_t end = 0;  ///< index after the last point
    std::unique_ptr<Sequence> sequence;
    std::mutex in_turn;  ///< held during fill() of a sequence without random access
};

namespace {

/// Largest count that the generator accepts, by bisection. `known` is an accepted count.
std::uint64_t largest_count(const Generator& generator, Request request, const Values& options,
                            std::uint64_t known) {
    const auto accepts = [&](std::uint64_t count) {
        request.count = count;
        try {
            plan_for(generator, request, options);
        } catch (const Error&) {
            return false;
        }
        return true;
    };
    std::uint64_t refused = generator.traits.max_index - request.start + 1;
    if (accepts(refused - 1)) return refused - 1;
    while (refused - known > 1) {
        const std::uint64_t middle = known + (refused - known) / 2;
        (accepts(middle) ? known : refused) = middle;
    }
    return known;
}

}  // namespace

Sampler::Sampler(std::string_view text, const Request& request) try
    : state_(std::make_unique<State>()) {
    const Spec spec = spec_without_coordinates(text);
    const Generator& generator = find_generator(spec.name);
    if (!generator.sequence)
        fail(ErrorKind::usage,
             "a Sampler cannot make {}: its points depend on each other; call generate()",
             generator.name);
    if (request.bounds)
        fail(ErrorKind::usage, "a Sampler gives points of the unit cube; leave out the bounds");
    const Values values = spec.values(generator.options);
    Request first = request;
    if (!first.count && generator.traits.prefix) first.count = 1;  // the default may be too large
    state_->plan = plan_for(generator, first, values);
    const std::uint64_t count = state_->plan.count;
    state_->end =
        generator.traits.prefix ? largest_count(generator, request, values, count) : count;
    state_->sequence = generator.sequence(state_->plan, values, {});
} catch (...) {
    throw_to_caller();
}
Sampler::Sampler(Sampler&&) noexcept = default;
Sampler& Sampler::operator=(Sampler&&) noexcept = default;
Sampler::~Sampler() = default;

std::size_t Sampler::dimension() const { return state_->plan.dimension; }

void Sampler::fill(std::uint64_t first, std::span<double> rows) const {
    require_rows(rows, dimension());
    const std::uint64_t count = rows.size() / dimension();
    if (first > state_->end || count > state_->end - first)
        fail(ErrorKind::usage, "points {} to {} are beyond the last one, which is {}", first,
             first + std::min(count - 1, ~first), state_->end - 1);
    std::unique_lock lock(state_->in_turn, std::defer_lock);
    if (!state_->sequence->random_access()) lock.lock();
    state_->sequence->fill(state_->plan.start + first, rows);
}

// ---------------------------------------------------------------- warps

PointSet warp(std::string_view spec, const PointSet& points, const RunContext& run) try {
    return warped_set(checked(points), parse_spec(spec), false, run);
} catch (...) {
    throw_to_caller();
}

PointSet warp_back(std::string_view spec, const PointSet& points, const RunContext& run) try {
    return warped_set(checked(points), parse_spec(spec), true, run);
} catch (...) {
    throw_to_caller();
}

std::string domain_of(const PointSet& points) { return domain_or_cube(points)->spec(); }

DomainPtr domain_named(std::string_view spec, std::size_t dimension, const RunContext& run) try {
    return parse_domain(spec, dimension, run);
} catch (...) {
    throw_to_caller();
}

double measure_of(const PointSet& points) { return domain_or_cube(points)->measure(); }

std::vector<double> densities(const PointSet& points) try {
    check_set(points);
    if (!points.densities.empty()) return points.densities;
    const DomainPtr domain = domain_or_cube(points);
    std::vector<double> density(points.count());
    for (std::size_t i = 0; i < density.size(); ++i) density[i] = domain->density(points[i]);
    return density;
} catch (...) {
    throw_to_caller();
}

struct Warper::State : WarpChain {
    using WarpChain::WarpChain;
};

Warper::Warper(std::span<const std::string> texts, std::size_t dimension) try {
    std::vector<Spec> specs;
    for (const std::string& text : texts) specs.push_back(parse_spec(text));
    state_ = std::make_unique<State>(specs, dimension, ChainSet{.count = 0});
} catch (...) {
    throw_to_caller();
}
Warper::Warper(const std::string& spec, std::size_t dimension)
    : Warper(std::span(&spec, 1), dimension) {}
Warper::Warper(Warper&&) noexcept = default;
Warper& Warper::operator=(Warper&&) noexcept = default;
Warper::~Warper() = default;

std::size_t Warper::dimension_in() const { return state_->dimension_in(); }
std::size_t Warper::dimension_out() const { return state_->dimension_out(); }

std::vector<double> Warper::forward(std::span<const double> rows) const try {
    require_rows(rows, dimension_in());
    for (std::size_t i = 0; i < rows.size(); ++i)
        if (!(rows[i] >= 0 && rows[i] <= 1))
            fail(ErrorKind::input, "number {} is {}, outside [0, 1]", i, rows[i]);
    return state_->forward({rows.begin(), rows.end()});
} catch (...) {
    throw_to_caller();
}

std::vector<double> Warper::inverse(std::span<const double> rows) const try {
    require_rows(rows, dimension_out());
    return state_->inverse({rows.begin(), rows.end()});
} catch (...) {
    throw_to_caller();
}

std::vector<double> Warper::density(std::span<const double> rows) const try {
    require_rows(rows, dimension_out());
    return state_->density(rows);
} catch (...) {
    throw_to_caller();
}

// ---------------------------------------------------------------- files

void write(const std::string& path, std::span<const PointSet> sets, const WriteOptions& options,
           const RunContext& run) try {
    Target target{.path = path,
                  .header = options.header,
                  .meta = options.meta,
                  .single = options.single,
                  .precision = options.precision};
    if (!options.format.empty()) target.format = &io::format_named(options.format);
    if (options.precision && (*options.precision < 0 || *options.precision > 1000))
        fail(ErrorKind::usage, "a precision of {} is outside [0, 1000]", *options.precision);
    std::vector<PointSet> copies;
    for (const PointSet& set : sets) copies.push_back(checked(set));
    write_sets(std::move(copies), target, run);
} catch (...) {
    throw_to_caller();
}

void write(const std::string& path, const PointSet& points, const WriteOptions& options,
           const RunContext& run) {
    write(path, std::span(&points, 1), options, run);
}

std::vector<PointSet> read_sets(const std::string& path, const ReadFileOptions& options,
                                const RunContext& run) try {
    ReadOptions inner{.source = path, .densities = true, .meta_beside = true};
    if (options.dimension > 0) inner.dimension = options.dimension;
    inner.single = options.single;
    const Format* format = options.format.empty() ? nullptr : &io::format_named(options.format);
    std::vector<PointSet> sets = io::open_points(path, inner, run, format)->read_all(run);
    for (PointSet& set : sets) {
        io::take_densities(set);
        complete(set.provenance);
        if (const std::string& domain = set.provenance.domain; !domain.empty())
            set.domain = parse_domain(domain, set.dimension(), run);
    }
    return sets;
} catch (...) {
    throw_to_caller();
}

PointSet read(const std::string& path, const ReadFileOptions& options, const RunContext& run) {
    std::vector<PointSet> sets = read_sets(path, options, run);
    if (sets.size() != 1) fail(ErrorKind::input, "{}: {} sets; expected one", path, sets.size());
    return std::move(sets.front());
}

}  // namespace stipple
