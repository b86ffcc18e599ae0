// SPDX-License-Identifier: MIT
#include "page/measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

#include "core/bytes/fingerprint.hpp"
#include "core/error.hpp"
#include "core/spec.hpp"
#include "page/experiment.hpp"
#include "page/figures.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/set_writer.hpp"

namespace stipple::page {
namespace {

struct Planned {
    const char* name;
    const char* title;
    const char* analyzer;
    const char* kind = "";  ///< option kind of star-discrepancy
    bool searches = false;  ///< takes a work limit
    bool prefixes = false;  ///< measures prefixes of the set
    const char* integrands = "";
    bool distances = false;  ///< uses distances between points
};

constexpr std::array plans = {
    Planned{"star-discrepancy", "Star discrepancy", "star-discrepancy", "", true},
    Planned{"convergence", "Star discrepancy of prefixes", "star-discrepancy", "", true, true},
    Planned{"extreme-discrepancy", "Extreme discrepancy", "star-discrepancy", "extreme", true},
    Planned{"periodic-discrepancy", "Periodic discrepancy", "star-discrepancy", "periodic", true},
    Planned{"l2-discrepancy", "L2 discrepancies", "l2-discrepancy"},
    Planned{"dispersion", "Dispersion", "dispersion", "", true},
    Planned{"t-value", "t-value", "t-value"},
    Planned{"nearest-neighbor", "Nearest neighbours", "nearest-neighbor", "", false, false, "",
            true},
    Planned{"periodogram", "Power spectrum", "periodogram"},
    Planned{"pair-correlation", "Pair correlation", "pair-correlation", "", false, false, "", true},
    Planned{"integration", "Integration", "integration", "", false, false,
            "genz-gaussian,genz-continuous,genz-discontinuous"},
    Planned{"chi-square", "χ² test", "chi-square"},
    Planned{"kolmogorov-smirnov", "Kolmogorov–Smirnov test", "kolmogorov-smirnov"}};

/// Limits sums over all pairs, which take n² d steps except in the plane, where faster methods
/// exist; likewise neighbour searches in dimensions where trees do not help. One comparison of the
/// limit counts for several steps.
/// @throws Error(limit)
void need_few_pairs(const Planned& plan, const PointSet& points, std::int64_t work) {
    const std::string_view analyzer = plan.analyzer;
    const std::size_t d = points.dimension();
    const bool sums = analyzer == "l2-discrepancy" && d > 2;
    if (!sums && (analyzer != "nearest-neighbor" || d <= 8)) return;
    const auto n = static_cast<double>(points.count());
    const double steps = n * n * static_cast<double>(d);
    if (steps <= (sums ? 20 : 5) * static_cast<double>(work)) return;
    fail(ErrorKind::limit,
         "it would compare all pairs of {} points in {} dimensions, which takes long; use a larger "
         "--max-work, or 'stipple analyze {}'",
         points.count(), points.dimension(), plan.analyzer);
}

/// Work limit of a search for a worst box, in comparisons. For many points the search for extreme
/// and periodic boxes ends with its initial bounds anyway, so it gets less.
std::int64_t work_for(const Planned& plan, std::size_t count, std::int64_t work) {
    constexpr std::size_t many = 50'000;
    return *plan.kind != '\0' && count > many ? std::max<std::int64_t>(1, work / 8) : work;
}

/// 16, 32, 64, ..., count.
std::string prefixes_of(std::size_t count) {
    std::string text;
    for (std::size_t n = 16; n < count; n *= 2) text += fmt::format("{},", n);
    return text + std::to_string(count);
}

/// Prefixes are measured only for sequences, and only for sizes where the search is exact and fast.
/// @throws Error(limit), Error(input)
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
    const Analyzer& analyzer = find_analyzer(plan.analyzer);
    Measure measure{.name = plan.name, .title = plan.title, .analyzer = plan.analyzer};
    measure.command = fmt::format("stipple analyze {} {}", plan.analyzer, input.words);
    const auto set = [&](const char* option, const std::string& text) {
        analyzer.options.set(values, option, text);
        measure.command += fmt::format(" --{} {}", option, text);
    };
    if (*plan.kind != '\0') set("kind", plan.kind);
    if (plan.searches) set("max-work", std::to_string(work));
    if (plan.prefixes) set("prefixes", prefixes_of(points.count()));
    if (*plan.integrands != '\0') set("integrand", plan.integrands);
    measure.options = typed_settings(values, analyzer.options);
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
    const Analyzer& analyzer = find_analyzer(plan.analyzer);
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
    if (plan.distances && points.dimension() > 1 && is_experiment(domain)) {
        measure.left_out =
            "its distances would mix the units of the parameters; 'stipple warp parameters "
            "--inverse' maps the points to the unit cube, which has no units";
        return measure;
    }
    if (analyzer.traits.unit_cube && domain != "unit-cube") {
        measure.left_out = fmt::format("it compares points with the unit cube; these are on {}",
                                       shown->domain->title());
        return measure;
    }
    try {
        need_few_pairs(plan, points, work);
        if (plan.prefixes) need_prefixes(points);
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
    RunContext mute = run;
    mute.warn = {};  // the page shows bounds itself
    const Cubed cube = cubed(points, input);
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

std::vector<std::string> measure_names() {
    std::vector<std::string> names;
    for (const Planned& plan : plans) names.emplace_back(plan.name);
    return names;
}

const Analyzer* analyzer_of(std::string_view measure) {
    for (const Planned& plan : plans)
        if (plan.name == measure) return &find_analyzer(plan.analyzer);
    return nullptr;
}

}  // namespace stipple::page
