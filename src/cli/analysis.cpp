// SPDX-License-Identifier: MIT
#include "cli/analysis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

#include "cli/inputs.hpp"
#include "cli/verbs.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "io/source_text.hpp"
#include "math/fourier/transform.hpp"
#include "pipeline/chain.hpp"
#include "plot/points_picture.hpp"
#include "report/grid_files.hpp"

namespace stipple::cli {
namespace {

/// Option of an analyzer that names a file to write beside its report.
struct FileOption {
    const char* option;
    const char* extension;  ///< extension of its only format; empty: any name
};
constexpr std::array<FileOption, 3> file_options = {
    {{"grid", ".npy"}, {"image", ".png"}, {"wisdom", ""}}};

// Small sets are collected and measured in parallel, a few megabytes at a time. Sets with at least
// `large` coordinates are measured immediately.
constexpr std::size_t large = std::size_t{1} << 18;
constexpr std::size_t together = std::size_t{1} << 20;  // limit for coordinates of collected sets
constexpr std::size_t most_waiting = std::size_t{1} << 12;

/// Adds another set's time, source and count to a mean.
void add_to(Measurement& mean, const Measurement& m) {
    mean.seconds = mean.seconds.value_or(0) + m.seconds.value_or(0);
    const std::string added = ", " + m.source;  // not for later sets of the last source
    if (mean.source != m.source && !mean.source.ends_with(added)) mean.source += added;
    if (mean.columns != m.columns) mean.columns.clear();
    const std::uint64_t largest = std::max({mean.count, mean.largest_count, m.count});
    mean.count = std::min(mean.count, m.count);
    if (mean.count != largest) mean.largest_count = largest;
}

/// Options for the picture of a grid.
PowerPicture picture_of(const Report& results, const Values& options) {
    PowerPicture picture;
    if (const auto* reach = results.find("max_distance"))
        picture.differences = std::get<double>(*reach);
    if (const auto* scale = options.try_find("image-scale"))
        picture.scale = std::get<std::string>(scale->value);
    if (const auto* bits = options.try_find("image-bits"))
        picture.bits = std::get<std::string>(bits->value) == "16" ? 16 : 8;
    if (const auto* slice = options.try_find("slice"))
        picture.slice = std::get<std::int64_t>(slice->value);
    return picture;
}

/// Shortest and longest of the box's positive side lengths; both 0 if all sides are 0.
std::pair<double, double> sides_of(const Box& box) {
    std::vector<double> sides;
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (box.extent(k) > 0) sides.push_back(box.extent(k));
    if (sides.empty()) return {};
    const auto [shortest, longest] = std::ranges::minmax(sides);
    return {shortest, longest};
}

}  // namespace

std::string kind_of(const Provenance& made, std::uint64_t count) {
    if (made.generator.empty())
        return made.flaw.empty() ? fmt::format("{} points", count) : made.flaw;
    std::string kind = made.generator;
    for (const auto& [name, value] : made.options) kind += fmt::format(" {}={}", name, value);
    for (const std::string& warp : made.warps) kind += " -w " + warp;
    // Without --count, the count may differ from seed to seed.
    if (made.command.find(" --count ") != std::string::npos)
        kind += fmt::format(" -n {}", made.count);
    return fmt::format("{} {} {} {}", kind, made.start, made.shard, made.bounds);
}

Analysis::Analysis(const Analyzer& analyzer, Values options, const AnalyzeRequest& request,
                   Session& session, io::Outputs& files, bool one_of_several)
    : analyzer_(analyzer),
      request_(request),
      session_(session),
      files_(files),
      one_of_several_(one_of_several),
      asked_(std::move(options)) {}

std::optional<std::string> Analysis::text_of(std::string_view name) const {
    const auto* option = asked_.try_find(name);
    if (option == nullptr || !option->given) return std::nullopt;
    return format_value(option->value);
}

// ---------------------------------------------------------------- arguments

void Analysis::check_arguments(const std::string& output) const {
    check_domain();
    check_side_files(output);
    warn_of_metric();
}

void Analysis::check_domain() const {
    const auto& named = request_.domain;
    const bool moved = request_.bounds || request_.rescale;
    if (!named || *named == "unit-cube" || moved || !analyzer_.traits.unit_cube) return;
    fail_with_hint(ErrorKind::usage, "--rescale or --bounds lo..hi moves points into the cube",
                   "--domain: {} requires points of the unit cube, not of {}", analyzer_.name,
                   *named);
}

void Analysis::check_side_files(const std::string& output) const {
    std::vector<std::pair<std::string, std::string>> taken = {{"output", output}};
    for (const FileOption& file : file_options) {
        const auto* option = asked_.try_find(file.option);
        if (option == nullptr || !option->given) continue;
        const auto& path = std::get<std::string>(option->value);
        if (path.starts_with("/dev/")) continue;
        if (!path.ends_with(file.extension))
            fail(ErrorKind::usage, "--{}: writes {}; '{}' has another name", file.option,
                 file.extension, path);
        for (const auto& [other, name] : taken)
            if (name == path)
                fail(ErrorKind::usage, "--{}: --{} writes {}, too", file.option, other, path);
        taken.emplace_back(file.option, path);
    }
}

/// Warns if distances mix units, because the sides of the box differ in length, or if they cross
/// the faces of a box that was computed from the points themselves.
void Analysis::warn_of_metric() const {
    const auto* metric = asked_.try_find("metric");
    if (metric == nullptr) return;
    const auto& bounds = request_.bounds;
    if (request_.rescale) {
        if (bounds || metric->given) return;
        return session_.warn(
            "--rescale puts extreme points on opposite faces, which the torus joins; --metric "
            "euclidean measures straight distances, and --rescale with --bounds maps the box that "
            "the points are in");
    }
    if (!bounds) return;
    const auto ranges = std::ranges::count(*bounds, ',') + 1;
    const auto [shortest, longest] = sides_of(parse_box(*bounds, static_cast<std::size_t>(ranges)));
    if (longest > shortest)
        session_.warn(
            fmt::format("the sides of --bounds are between {} and {} long, and distances mix "
                        "their units; with --rescale the box is first mapped to the unit cube",
                        format_number(shortest), format_number(longest)));
}

void Analysis::warn_of_prefixes(const Provenance& made) {
    if (told_of_prefixes_ || !(text_of("prefixes") || text_of("every"))) return;
    const std::string sentence = unlike_prefixes(made);
    if (sentence.empty()) return;
    told_of_prefixes_ = true;
    session_.warn(sentence);
}

/// Warns if the distances between points of a file mix columns of very different ranges.
void Analysis::warn_of_ranges(const PointSet& points) {
    if (told_of_ranges_ || !asked_.try_find("metric") || request_.bounds ||
        !request_.generate.empty())
        return;
    const bool boxed = points.domain->spec().starts_with("box");
    const auto [shortest, longest] = sides_of(
        boxed ? points.domain->bounding_box() : bounding_box(points.flat(), points.dimension()));
    if (!(longest > plot::most_unlike * shortest) || (!boxed && !plot::without_domain(points)))
        return;
    told_of_ranges_ = true;
    session_.warn(
        fmt::format("the ranges of the coordinates are between {:.4g} and {:.4g} wide, and "
                    "distances mix their units; --rescale maps the points to the unit cube first",
                    shortest, longest));
}

// ---------------------------------------------------------------- sets

void Analysis::add(PointSet points, SetOrigin origin) {
    warn_of_prefixes(points.provenance);
    warn_of_ranges(points);
    const std::size_t numbers = points.flat().size();
    // The first set of a kind may determine options for the others, so it is measured alone.
    const bool decides =
        request_.averaged() && analyzer_.follow && !known_group(origin.kind, points.dimension());
    if (numbers >= large || decides) measure_waiting();
    waiting_.push_back({std::move(points), std::move(origin)});
    numbers_ += numbers;
    if (decides || numbers >= large || numbers_ >= together || waiting_.size() >= most_waiting)
        measure_waiting();
}

void Analysis::add(const Arrival& arrival, const NextRows& next, SetOrigin& origin,
                   const Provenance& made, const RunContext& run) {
    const Values& options = options_for(origin.kind, arrival.dimension());
    Measurement m = timed(origin, arrival.domain, options,
                          [&] { return stipple::analyze(analyzer_, arrival, next, options, run); });
    if (request_.averaged() && origin.kind.empty()) origin.kind = kind_of(made, m.count);
    keep(std::move(m), origin);
}

Measurement Analysis::timed(const SetOrigin& origin, const DomainPtr& domain, const Values& options,
                            const std::function<Found()>& work) const {
    const auto start = std::chrono::steady_clock::now();
    Found found = work();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    return {.analyzer = analyzer_.name,
            .source = origin.source,
            .set = origin.number,
            .count = found.count,
            .dimension = domain->dimension(),
            .domain = domain->spec(),
            .columns = origin.columns,
            .options = typed_settings(options, analyzer_.options),
            .results = std::move(found.report),
            .seconds = seconds.count()};
}

void Analysis::measure_waiting() {
    numbers_ = 0;
    const std::vector<Waiting> sets = std::exchange(waiting_, {});
    const RunContext& run = session_.run();
    const std::size_t threads = run.thread_count();
    // Remaining sets, fewer than threads, are measured one by one with all threads.
    const std::size_t spread = threads > 1 ? sets.size() - sets.size() % threads : 0;
    std::vector<Outcome> outcomes(spread);
    // After a stop request, analyses that have begun may still return a result.
    for_each_block(unstopped(run), spread, 1, [&](const Block& block) {
        if (!interrupted())
            outcomes[block.index] = measured_alone(sets[block.index], run.share_of_memory(threads));
    });
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const bool again = i >= spread || outcomes[i].over_limit;
        if (again && interrupted()) continue;
        if (again) {
            keep(measured(sets[i], run), sets[i].origin);
            continue;
        }
        for (const auto& sentence : outcomes[i].warnings) run.notify(sentence);
        if (outcomes[i].error) std::rethrow_exception(outcomes[i].error);
        if (outcomes[i].measurement) keep(std::move(*outcomes[i].measurement), sets[i].origin);
    }
}

/// Measures a set with one thread, while other threads measure other sets.
Analysis::Outcome Analysis::measured_alone(const Waiting& set, RunContext one) const {
    Outcome outcome;
    one.threads = 1;
    one.progress = {};
    one.warn = [&outcome](const std::string& text) { outcome.warnings.push_back(text); };
    try {
        outcome.measurement = measured(set, one);
    } catch (const Error& e) {
        outcome.error = std::current_exception();
        outcome.over_limit = e.kind() == ErrorKind::limit;
    } catch (...) {
        outcome.error = std::current_exception();
    }
    return outcome;
}

Measurement Analysis::measured(const Waiting& set, const RunContext& run) const {
    const RunContext named = naming_set(set.origin, run);
    const Values& options = options_for(set.origin.kind, set.points.dimension());
    const auto found = [&] {
        return naming(set.origin.source, [&] {
            return Found{stipple::analyze(analyzer_, set.points, options, named),
                         set.points.count()};
        });
    };
    Measurement m = timed(set.origin, set.points.domain, options, [&]() -> Found {
        if (!one_of_several_) return found();
        try {
            return found();
        } catch (const Error& e) {
            const std::string what = e.what();
            if (what.find(analyzer_.name) != std::string::npos) throw;
            throw Error(e.kind(), fmt::format("{}: {}", analyzer_.name, what), e.hint());
        }
    });
    // For a table, stores the domain of its input columns, not of all columns.
    if (analyzer_.traits.table) m.domain = set.points.provenance.domain;
    return m;
}

/// The run, with warnings that begin with the set's name if there are several sets.
RunContext Analysis::naming_set(const SetOrigin& origin, const RunContext& run) const {
    RunContext named = run;
    if (!origin.several) return named;
    std::string name = io::source_name(origin.source);
    if (origin.number) name += fmt::format(", set {}", *origin.number);
    named.warn = [&run, name](const std::string& sentence) {
        run.notify(fmt::format("{}: {}", name, sentence));
    };
    return named;
}

// ---------------------------------------------------------------- means

/// Key of a group of sets that are averaged together: same kind and dimension, or all sets with
/// --pool.
std::string Analysis::group_name(const std::string& kind, std::size_t dimension) const {
    return request_.pool ? "" : fmt::format("{} {}", dimension, kind);
}

/// The group of a set; nullptr if no set of it has been measured.
const Analysis::Group* Analysis::known_group(const std::string& kind, std::size_t dimension) const {
    const auto it = group_indices_.find(group_name(kind, dimension));
    return it == group_indices_.end() ? nullptr : &groups_[it->second];
}

/// Options for a set: those of its group if earlier sets determined them, otherwise those given.
const Values& Analysis::options_for(const std::string& kind, std::size_t dimension) const {
    const Group* group = known_group(kind, dimension);
    return group ? group->options : asked_;
}

void Analysis::keep(Measurement m, const SetOrigin& origin) {
    if (!request_.averaged()) {
        save_grid(m.results, measurements_.size(), origin.several);
        measurements_.push_back(std::move(m));
        return;
    }
    const auto [it, is_new] =
        group_indices_.emplace(group_name(origin.kind, m.dimension), groups_.size());
    if (is_new) groups_.push_back({asked_});
    const std::size_t index = it->second;
    Group& group = groups_[index];
    if (index < measurements_.size() && measurements_[index].dimension != m.dimension)
        fail(ErrorKind::usage, "--pool: the sets have points of {} and of {} coordinates",
             measurements_[index].dimension, m.dimension);
    group.average.add(m.results);
    if (analyzer_.combine) group.singles.push_back(numbers_only(m.results));
    if (group.average.count() > 1) return add_to(measurements_[index], m);
    if (analyzer_.follow) analyzer_.follow(m.results, group.options);
    measurements_.push_back(std::move(m));
}

void Analysis::warn_of_sizes(const Group& group) const {
    std::vector<std::string> followed;  // options determined by the first set
    for (const auto& item : group.options.items())
        if (item != asked_.find(item.name))
            followed.push_back(fmt::format("--{} {}", item.name, format_value(item.value)));
    std::string text = "the sets that were averaged differ in their number of points";
    if (!followed.empty())
        text += fmt::format("; all are measured with {}, as the first", join(followed, " "));
    session_.warn(text);
}

void Analysis::finish_averages() {
    for (std::size_t i = 0; i < groups_.size(); ++i) {
        Measurement& m = measurements_[i];
        const Group& group = groups_[i];
        m.set.reset();
        take_mean(m, group.average, group.singles, analyzer_, group.options);
        if (m.largest_count > 0) warn_of_sizes(group);
        save_grid(m.results, i, groups_.size() > 1);
    }
}

void Analysis::finish() {
    if (request_.averaged()) finish_averages();
    if (const auto path = text_of("wisdom")) save_beside(*path, wisdom_text());
}

// ---------------------------------------------------------------- files and checks

void Analysis::save_grid(const Report& results, std::size_t number, bool several) {
    const auto* grid = std::get_if<Grid>(results.find("grid"));
    for (const bool image : {false, true}) {
        const char* const name = image ? "image" : "grid";
        auto path = text_of(name);
        if (!path) continue;
        if (grid == nullptr)
            fail(ErrorKind::input, "--{}: there is no grid for points of this dimension", name);
        if (several && path->find("{set}") == std::string::npos)
            fail(ErrorKind::usage, "--{}: several sets need a name with {{set}}, or --average",
                 name);
        replace_all(*path, "{set}", std::to_string(number));
        save_beside(*path,
                    image ? png_bytes(*grid, picture_of(results, asked_)) : npy_bytes(*grid));
    }
}

/// Writes a file that appears together with the report.
void Analysis::save_beside(const std::string& path, const std::string& bytes) {
    files_.add(path, session_.run().stop).write(bytes);
}

std::optional<std::string> Analysis::broken(const Check& check, const Report& results) const {
    // A result that is missing from the mean differs between the averaged sets; a condition on it
    // fails.
    if (request_.averaged() && !results.find(check.key) && find_result(analyzer_, check.key))
        return "not the same for all sets";
    if (check.holds(results)) return std::nullopt;
    return check.found(results);
}

namespace {

/// Whether a result equals that in `means`, apart from rounding; true if it is not a number or
/// list.
bool is_mean(const Report& means, const Report& results, const std::string& key) {
    const auto alike = [](double a, double b) {
        return a == b || !(std::abs(a - b) > 1e-9 * std::abs(b));
    };
    const auto before = list_at(means, key);
    const auto after = list_at(results, key);
    if (before && after) return std::ranges::equal(*before, *after, alike);
    const auto was = number_at(means, key);
    const auto is = number_at(results, key);
    return !was || !is || alike(*was, *is);
}

/// Selects the standard errors of those results that are plain means over the sets.
Report errors_of_means(const Report& errors, const Report& means, const Report& results,
                       const std::string& group = {}) {
    Report kept;
    for (const auto& [name, value, unit] : errors.entries()) {
        const std::string key = group + name;
        if (const auto* inner = std::get_if<Report>(&value))
            kept.add(name, errors_of_means(*inner, means, results, key + "."));
        else if (is_mean(means, results, key))
            kept.entries().push_back({name, value, unit});
    }
    return kept;
}

}  // namespace

void take_mean(Measurement& m, const ReportAverage& average, std::span<const Report> sets,
               const Analyzer& analyzer, const Values& options) {
    m.sets = average.count();
    const Report means = average.mean();
    m.results = means;
    if (analyzer.refine) analyzer.refine(m.results, average.count(), options);
    if (analyzer.combine) analyzer.combine(m.results, sets, options);
    if (average.count() < 2) return;
    m.standard_error = errors_of_means(average.standard_error(m.results), means, m.results);
}

}  // namespace stipple::cli
