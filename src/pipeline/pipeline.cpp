// SPDX-License-Identifier: MIT
#include "pipeline/pipeline.hpp"

#include <algorithm>
#include <future>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Whether a unit is called so, by its own name or another.
template <class Unit>
bool is_called(const Unit& unit, std::string_view name) {
    if constexpr (requires { unit.aliases; })
        if (std::ranges::find(unit.aliases, name) != unit.aliases.end()) return true;
    return unit.name == name;
}

template <class Unit>
const Unit* try_unit(const std::vector<Unit>& units, std::string_view name) {
    const auto it =
        std::ranges::find_if(units, [&](const Unit& unit) { return is_called(unit, name); });
    return it == units.end() ? nullptr : &*it;
}

template <class Unit>
const Unit& find_unit(std::string_view kind, const std::vector<Unit>& units,
                      std::string_view name) {
    if (const Unit* unit = try_unit(units, name)) return *unit;
    std::vector<std::string> names;
    for (const Unit& unit : units) {
        names.push_back(unit.name);
        if constexpr (requires { unit.aliases; })
            names.insert(names.end(), unit.aliases.begin(), unit.aliases.end());
    }
    if constexpr (std::is_same_v<Unit, Warp>)
        for (const Scramble& scramble : scrambles::all()) names.push_back(scramble.name);
    fail_with_hint(ErrorKind::usage, suggest(name, names), "unknown {} '{}'", kind, name);
}

Values values_of(const Schema& schema, const Settings& settings) {
    Values values = schema.defaults();
    for (const auto& [name, text] : settings) schema.set(values, name, text);
    return values;
}

/// Points of a sequence, block by block on all threads.
PointSet fill_all(Sequence& sequence, const Plan& plan, std::uint64_t start,
                  const RunContext& run) {
    run.need_memory(static_cast<double>(plan.count) * static_cast<double>(plan.dimension) * 8,
                    "the point set");
    PointSet points(Rows::unwritten(plan.count * plan.dimension), plan.dimension);
    walk_to(sequence, start, plan.dimension, run);
    RunContext lane = run;
    if (!sequence.random_access()) lane.threads = 1;
    const std::size_t block = std::max<std::size_t>(1, 8192 / plan.dimension);
    for_each_block(lane, plan.count, block, [&](const Block& b) {
        sequence.fill(start + b.first, points.flat().subspan(b.first * plan.dimension,
                                                             (b.last - b.first) * plan.dimension));
    });
    return points;
}

/// A set in memory, given to an accumulator in batches.
Report accumulated(const Analyzer& analyzer, const PointSet& points, const Values& options,
                   const RunContext& run) {
    const std::size_t d = points.dimension();
    const auto measure =
        accumulator_for(analyzer, {points.domain, points.count()}, d, options, run);
    RunContext quiet = run;
    quiet.progress = {};
    const std::size_t batch = arrival_batch(d);
    for (std::size_t first = 0; first < points.count(); first += batch) {
        const std::size_t count = std::min(batch, points.count() - first);
        measure->add(points.flat().subspan(first * d, count * d), quiet);
        run.tick(first + count, points.count());
    }
    return measure->report(quiet);
}

}  // namespace

Found analyze(const Analyzer& analyzer, const Arrival& arrival, std::size_t dimension,
              const NextRows& next, const Values& options, const RunContext& run) {
    const auto measure = accumulator_for(analyzer, arrival, dimension, options, run);
    RunContext quiet = run;
    quiet.progress = {};
    const std::size_t width = arrival.width();
    std::vector<double> rows(arrival_batch(dimension) * width);
    std::vector<double> ahead(rows.size());
    const auto policy = run.thread_count() > 1 ? std::launch::async : std::launch::deferred;
    Found found;
    std::size_t count = next(rows);
    while (count > 0) {
        run.check_stop();
        auto fetched = std::async(policy, [&] { return next(ahead); });
        measure->add(std::span(rows).first(count * width), quiet);
        found.count += count;
        if (arrival.count) run.tick(found.count, *arrival.count);
        count = fetched.get();
        rows.swap(ahead);
    }
    if (found.count == 0)
        fail(ErrorKind::input, "{} needs at least one point; the set is empty", analyzer.name);
    found.report = measure->report(quiet);
    return found;
}

std::unique_ptr<Accumulator> accumulator_for(const Analyzer& analyzer, const Arrival& arrival,
                                             std::size_t dimension, const Values& options,
                                             const RunContext& run) {
    check_dimension(analyzer, dimension);
    if (arrival.dimension() != dimension)
        fail(ErrorKind::input, "points of the domain {} have dimension {}; these have {}",
             arrival.domain->spec(), arrival.dimension(), dimension);
    return analyzer.accumulate(arrival, options, run);
}

const Generator& find_generator(std::string_view name) {
    return find_unit("generator", generators::all(), name);
}
const Warp& find_warp(std::string_view name) { return find_unit("warp", warps::all(), name); }
const Scramble* scramble_named(std::string_view name) { return try_unit(scrambles::all(), name); }
const Analyzer& find_analyzer(std::string_view name) {
    return find_unit("analyzer", analyzers::all(), name);
}

void walk_to(Sequence& sequence, std::uint64_t start, std::size_t dimension,
             const RunContext& run) {
    if (sequence.random_access()) return;
    const std::uint64_t step = 1 + 1'000'000 / dimension;
    std::vector<double> row(dimension);
    for (std::uint64_t i = step; i < start; i += step) {
        run.check_stop();
        sequence.fill(i, row);
    }
}

void tell_notes(const Generator& generator, const Request& request, const Values& options,
                const RunContext& run) {
    if (!generator.notes) return;
    for (const auto& note :
         generator.notes(request, plan_for(generator, request, options), options))
        run.tell(note);
}

PointSet make_points(const Generator& generator, const Request& request, const Values& options,
                     const RunContext& run) {
    const Plan plan = plan_for(generator, request, options);
    if (!generator.traits.sequence) return generator.set(plan, options, run);
    const RunContext steady = run.rising();
    return fill_all(*generator.sequence(plan, options, steady), plan, request.start, steady);
}

PointSet generate(const Generator& generator, const Request& request, const Values& options,
                  const RunContext& run) {
    tell_notes(generator, request, options, run);
    return make_points(generator, request, options, run);
}

PointSet generate(std::string_view name, const Request& request, const Settings& settings,
                  const RunContext& run) {
    const Generator& generator = find_generator(name);
    return generate(generator, request, values_of(generator.options, settings), run);
}

void require_unit_cube(const PointSet& points) {
    const auto outside = [](double x) { return !(x >= 0 && x <= 1); };
    std::size_t count = 0;
    std::size_t first = 0;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (std::ranges::any_of(points[i], outside) && count++ == 0) first = i;
    if (count == 0) return;
    std::vector<std::string> numbers;
    for (const double x : points[first]) numbers.push_back(format_number(x));
    fail_with_hint(
        ErrorKind::input, "--rescale or --bounds lo..hi moves points into the cube",
        "{} of {} points are outside the unit cube [0, 1]^{}; the first is point {}: ({})", count,
        points.count(), points.dimension(), first, join(numbers, ", "));
}

Report analyze(const Analyzer& analyzer, const PointSet& points, const Values& options,
               const RunContext& run) {
    if (points.count() == 0)
        fail(ErrorKind::input, "{} needs at least one point; the set is empty", analyzer.name);
    check_dimension(analyzer, points.dimension());
    if (analyzer.traits.unit_cube) require_unit_cube(points);
    return analyzer.accumulate ? accumulated(analyzer, points, options, run)
                               : analyzer.analyze(points, options, run);
}

Report analyze(std::string_view name, const PointSet& points, const Settings& settings,
               const RunContext& run) {
    const Analyzer& analyzer = find_analyzer(name);
    return analyze(analyzer, points, values_of(analyzer.options, settings), run);
}

}  // namespace stipple
