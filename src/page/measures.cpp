// SPDX-License-Identifier: MIT
#include "page/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "core/bytes/fingerprint.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/spec.hpp"
#include "page/experiment.hpp"
#include "page/figures.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple::page {
namespace {

/// Rejects measures that would compare too many pairs of points; in few dimensions, none, since
/// faster methods exist. @throws Error(limit)
void need_few_pairs(const Planned& plan, const PointSet& points, std::int64_t work) {
    const auto& [above, steps] = plan.analyzer->pairs;
    const auto n = static_cast<double>(points.count());
    const auto d = static_cast<double>(points.dimension());
    if (above == 0 || points.dimension() <= above || n * n * d <= steps * static_cast<double>(work))
        return;
    fail(ErrorKind::limit,
         "it would compare all pairs of {} points in {} dimensions, which takes long; use a larger "
         "--max-work, or 'stipple analyze {}'",
         points.count(), points.dimension(), plan.analyzer->name);
}

/// Work limit of a search for a worst box, in comparisons. For many points, searches with
/// non-default options get less work, since more would hardly improve their initial bounds.
std::int64_t work_for(const Planned& plan, std::size_t count, std::int64_t work) {
    constexpr std::size_t many = 50'000;
    const bool usual = std::ranges::all_of(
        plan.measure->options, [](const auto& option) { return option.second.empty(); });
    return !usual && count > many ? std::max<std::int64_t>(1, work / 8) : work;
}

/// Numbers of points of prefixes, as the value of an option: "16,32,64,...,COUNT".
std::string prefixes_of(std::size_t count) {
    std::string text;
    for (std::size_t n = 16; n < count; n *= 2) text += fmt::format("{},", n);
    return text + std::to_string(count);
}

/// Rejects measures of prefixes, except for sequences of a size for which the search is exact and
/// fast. @throws Error(limit), Error(input)
void need_prefixes(const PointSet& points) {
    constexpr std::size_t fewest = 32;
    constexpr std::size_t most = 100'000;
    if (points.dimension() > 2 || points.count() < fewest || points.count() > most)
        fail(ErrorKind::limit, "it is only computed for {} to {} points in one or two dimensions",
             fewest, most);
    if (const auto sentence = unlike_prefixes(points.provenance); !sentence.empty())
        fail(ErrorKind::input, "{}", sentence);
}

Measure described(const Planned& plan, const PointSet& points, const Input& input,
                  std::int64_t work, Values& values) {
    const auto& [name, analyzer, from] = plan;
    Measure measure{
        .name = std::string(name), .title = std::string(from->title), .analyzer = analyzer->name};
    measure.command = fmt::format("stipple analyze {} {}", analyzer->name, input.words);
    for (const auto& [option, value] : from->options) {
        const std::string text = !value.empty()         ? std::string(value)
                                 : option == "prefixes" ? prefixes_of(points.count())
                                                        : std::to_string(work);
        analyzer->options.set(values, option, text);
        measure.command += fmt::format(" --{} {}", option, text);
    }
    measure.options = typed_settings(values, analyzer->options);
    return measure;
}

/// A set mapped to the unit cube; empty unless its domain is a box.
struct Cubed {
    std::optional<PointSet> points;
    std::string bounds;
};

Cubed cubed(const PointSet& points, const Input& input) {
    const std::string domain = points.domain->spec();
    if (!input.bounds || !domain.starts_with("box:")) return {};
    Cubed cube{.points = points, .bounds = format_box(points.domain->bounding_box())};
    for (std::size_t i = 0; i < points.count(); ++i) {
        if (!points.domain->contains(points[i])) return {};
        points.domain->to_cube(points[i], (*cube.points)[i]);
    }
    cube.points->domain = unit_cube(points.dimension());
    return cube;
}

Measure measured(const Planned& plan, const PointSet& points, const Cubed& cube, const Input& input,
                 std::int64_t work, const RunContext& run) {
    const Analyzer& analyzer = *plan.analyzer;
    Values values = analyzer.options.defaults();
    Measure measure = described(plan, points, input, work_for(plan, points.count(), work), values);
    const PointSet* shown = &points;
    if (analyzer.traits.unit_cube && cube.points) {
        shown = &*cube.points;
        measure.command += " --bounds " + cube.bounds;
    }
    measure.command += input.remark;
    if (input.words.empty()) measure.command.clear();
    const std::string domain = shown->domain->spec();
    // Measures with an option --metric use distances between points.
    const bool distances = values.try_find("metric") != nullptr;
    if (distances && points.dimension() > 1 && is_experiment(domain)) {
        measure.left_out =
            "its distances would mix the units of the parameters; 'stipple warp parameters "
            "--inverse' maps the points to the unit cube, which has no units";
        return measure;
    }
    if (analyzer.traits.unit_cube && domain != "unit-cube") {
        measure.left_out = fmt::format("it requires points of the unit cube; these are on {}",
                                       shown->domain->title());
        return measure;
    }
    try {
        need_few_pairs(plan, points, work);
        const auto* prefixes = values.try_find("prefixes");
        if (prefixes != nullptr && prefixes->given) need_prefixes(points);
        measure.results = analyze(analyzer, *shown, values, run);
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled || e.kind() == ErrorKind::io) throw;
        measure.left_out = e.what();
    }
    return measure;
}

}  // namespace

std::vector<Measure> measure_set(const PointSet& points, const Input& input, std::int64_t work,
                                 const RunContext& run) {
    const RunContext mute = unwarned(run);  // warnings would repeat bounds that the page shows
    const Cubed cube = cubed(points, input);
    const auto plans = planned_measures();
    std::vector<Measure> all;
    for (std::size_t i = 0; i < plans.size(); ++i) {
        all.push_back(
            measured(plans[i], points, cube, input, work, part_of_run(mute, i, plans.size())));
        run.check_stop();
    }
    return all;
}

Set finished_set(Set set, const PointSet& points, const Input& input, std::int64_t work,
                 std::size_t number, bool with_pictures, const RunContext& run) {
    set.count = points.count();
    set.dimension = points.dimension();
    set.domain = points.domain->spec();
    set.fingerprint = fingerprint(points.flat());
    set.measures = measure_set(points, input, work, run);
    if (!with_pictures) return set;
    set.figures = point_figures(points, set, number);
    if (auto spectrum = spectrum_figure(set); !spectrum.empty())
        set.figures.push_back(std::move(spectrum));
    for (Measure& measure : set.measures)
        if (measure.results)
            std::erase_if(measure.results->entries(), [](const Report::Entry& entry) {
                return std::holds_alternative<Grid>(entry.value);
            });
    return set;
}

}  // namespace stipple::page
