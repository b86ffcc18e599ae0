// SPDX-License-Identifier: MIT
//
// Global sensitivity of a model's outputs to its inputs: the parts of the variance of f(x) that are
// due to each x_i, alone and together with others,
//
//     first  S_i  = Var E(f | x_i) / Var f,    total  ST_i = 1 - Var E(f | all but x_i) / Var f,
//     second S_ij = Var E(f | x_i, x_j) / Var f - S_i - S_j.
//
// The points are a table of outputs, one row per run of the model. The inputs of these runs are in
// the file --design, or columns of the same table. The method of estimation depends on the design,
// whose rows are examined:
//
//     saltelli  pick-freeze: S, ST and, with both mixes, S_ij          (pick_freeze.cpp)
//     morris    trajectories: mu, mu*, sigma of elementary effects     (elementary_effects.cpp)
//     fast      curves of one frequency for each input: S, ST          (fourier_amplitude.cpp)
//     rank      any independent inputs: S                              (rank_indices.cpp)
//     chaos     any independent inputs: S, ST, S_ij of a polynomial    (polynomial_chaos.cpp)
//
// Shape   n rows of outputs, n x k inputs; a failed run has no output (NaN).
// Cost    that of the method; `auto` for a design without structure costs chaos and rank.
// Promise the same for any number of threads. The bootstrap's seed is an option.
// Beware  all indices are for independent inputs.
// Source  A. Saltelli et al., "Global Sensitivity Analysis. The Primer", Wiley 2008,
//         doi:10.1002/9780470725184; and those of the methods.

#include <algorithm>
#include <cmath>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "experiments/sensitivity/methods.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

constexpr Param<Path> design{
    {.name = "design",
     .unit = "file",
     .help = "File of the inputs, one row per run in the order of the outputs; default: the inputs "
             "are columns of the same table, before its outputs"}};

constexpr Param<Text> inputs{
    {.name = "inputs",
     .unit = "columns",
     .help =
         "Columns of the inputs, by name (quoted as in CSV) or number from 1: x,\"a, b\"; default: "
         "those named by provenance or --parameters, else all of --design, or all of the table "
         "that are not outputs"}};

constexpr Param<Text> response{
    {.name = "response",
     .unit = "columns",
     .help = "Columns of the outputs, by name or number as for --inputs: y,z; default: all except "
             "inputs and their copies, or the last one if the names of the inputs are not known"}};

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "auto",
    .choices = "auto|saltelli|morris|fast|rank|chaos",
    .help =
        "How the indices are estimated; auto: by the method whose design the rows form; for other "
        "rows chaos if its q2 is at least 0.8, else rank; `reason` explains the choice"};

constexpr Param<std::int64_t> bootstrap{
    .name = "bootstrap",
    .fallback = 1000,
    .low = 0,
    .high = 1'000'000,
    .unit = "resamples",
    .help =
        "Number of resamples for the intervals of saltelli and morris, which need 2 / (1 - "
        "level); 0: no intervals"};

constexpr Param<std::int64_t> bootstrap_seed{
    .name = "bootstrap-seed", .fallback = 1, .low = 0, .help = "Random seed of the resamples"};

constexpr Param<double> level{.name = "level",
                              .fallback = 0.95,
                              .low = 0.01,
                              .high = 0.9999,
                              .help = "Probability with which an interval contains the index"};

constexpr Param<std::int64_t> harmonics{
    .name = "harmonics",
    .low = 1,
    .high = 1000,
    .optional = true,
    .help =
        "For fast: number of harmonics of the curve's frequency that are summed; default: "
        "determined from the curves"};

constexpr Param<std::int64_t> degree{
    .name = "degree",
    .low = 1,
    .high = 20,
    .optional = true,
    .help =
        "For chaos: largest total degree; default: selected for each polynomial from its own runs"};

/// Method for a design, with the layout of its rows.
struct Plan {
    std::string method;  ///< empty: chaos or rank, decided by the fit
    Layout layout = {};
};

Setting setting_of(const Values& options) {
    Setting setting{.bootstrap = static_cast<std::size_t>(options[bootstrap]),
                    .level = options[level],
                    .seed = static_cast<std::uint64_t>(options[bootstrap_seed])};
    if (options.given(harmonics)) setting.harmonics = static_cast<std::size_t>(options[harmonics]);
    if (options.given(degree)) setting.degree = static_cast<std::size_t>(options[degree]);
    return setting;
}

Layout find_layout(const std::string& kind, const PointSet& points, const Setting& setting,
                   const RunContext& run) {
    if (kind == "saltelli") return find_pick_freeze(points);
    if (kind == "morris") return find_trajectories(points);
    return find_curves(points, setting.harmonics, run);
}

/// Warns if rows do not form the design that their generator makes, or if they resemble a design.
void note_broken(const Inputs& in, const std::string& trouble, const RunContext& run) {
    if (!trouble.empty())
        return run.notify(
            fmt::format("{} made the design, but its rows are not complete: {}; constraints, "
                        "correlated or nested inputs or another order cause this; chaos or rank is "
                        "used instead, which assume independent inputs",
                        in.generator, trouble));
    const double share = share_of_neighbors(in.values, run);
    constexpr double enough = 1. / 3;
    if (share >= enough)
        run.notify(fmt::format(
            "{:.0f} % of the rows differ from another row in one input, as in designs of saltelli "
            "and morris, but they do not form complete groups in the order of such a design; chaos "
            "or rank is used instead, which assume independent rows",
            100 * share));
}

/// Chooses the method. @throws Error(input) if the rows are not a design for the requested method
Plan plan_of(const Inputs& in, const std::string& asked, const Setting& setting,
             const RunContext& run) {
    if (asked == "rank" || asked == "chaos") return {.method = asked};
    if (asked != "auto") {
        Plan plan{.method = asked, .layout = find_layout(asked, in.values, setting, run)};
        if (!plan.layout)
            fail_with_hint(ErrorKind::input, "--method rank and chaos accept any design",
                           "--method {}: the rows are not such a design: {}", asked,
                           plan.layout.trouble);
        return plan;
    }
    std::string trouble;
    for (const std::string kind : {"saltelli", "morris", "fast"}) {
        const bool made = in.generator == kind;
        // Any two values of a single input form a trajectory.
        if (kind == "morris" && in.size() == 1 && !made) continue;
        Layout layout = find_layout(kind, in.values, setting, run);
        if (layout) return {.method = kind, .layout = std::move(layout)};
        if (made) trouble = layout.trouble;
    }
    note_broken(in, trouble, run);
    if (!in.domain) note_dependence(in, run);
    return {};
}

/// Indices by chaos or, if no polynomial predicts well enough, by ranks; adds the reason.
Effects of_any_design(std::string& chosen, const Inputs& in, const Response& out,
                      const Setting& setting, const RunContext& run) {
    constexpr double enough = 0.8;
    constexpr std::size_t least = 8;  // smallest number of runs for chaos
    if (chosen == "rank") return rank_indices(in, out, setting, run);
    if (chosen == "chaos") {
        auto effects = polynomial_chaos(in, out, setting, run);
        if (effects) return *std::move(effects);
        fail_with_hint(ErrorKind::input, "--method rank does not need a polynomial",
                       "no polynomial predicts the output {} better than its mean", out.name);
    }
    std::optional<Effects> effects;
    std::string reason = fmt::format("fewer than {} runs, which chaos needs", least);
    if (succeeded(out.y).size() >= least) {
        effects = polynomial_chaos(in, out, setting, run.stage(0, 0.9));
        reason = "no polynomial predicts better than the mean";
    }
    if (effects) {
        const double q2 = effects->details.number("q2");
        const bool good = q2 >= enough;
        reason =
            fmt::format("q2 of chaos is {:.3g}, {}{}", q2, good ? "at least " : "below ", enough);
        if (!good) effects.reset();
    }
    chosen = effects ? "chaos" : "rank";
    if (!effects) effects = rank_indices(in, out, setting, run.stage(0.9, 1));
    effects->details.add("reason", reason);
    return *std::move(effects);
}

/// Reason why no method can compute indices of an output; empty if some method can.
std::string why_none(const std::string& taken, const Response& out) {
    const auto y = picked(out.y, succeeded(out.y));
    if (y.empty()) return "all runs failed";
    if (taken == "morris" || y.size() < 2 || !is_constant(y)) return {};
    return fmt::format("{} in all runs, up to rounding: there is no variance to attribute",
                       format_number(y.front()));
}

Effects effects_of(Plan& plan, const Runs& runs, const Response& out, const Setting& setting,
                   const RunContext& run) {
    if (plan.method == "saltelli") return pick_freeze(plan.layout, runs.inputs, out, setting, run);
    if (plan.method == "morris")
        return elementary_effects(plan.layout, runs.inputs, out, setting, run);
    if (plan.method == "fast") return fourier_amplitudes(plan.layout, runs.inputs, out, run);
    return of_any_design(plan.method, runs.inputs, out, setting, run);
}

void note_failures(const Response& out, const Effects& effects, const RunContext& run) {
    constexpr std::size_t few = 5;
    std::vector<std::size_t> failed;
    for (std::size_t i = 0; i < out.y.size(); ++i)
        if (std::isnan(out.y[i])) failed.push_back(i);
    if (failed.empty()) return;
    const std::span first = std::span(failed).first(std::min(failed.size(), few));
    run.notify(fmt::format("{}: {} of {} runs failed, point{} {}{}; {} runs are used", out.name,
                           failed.size(), out.y.size(), failed.size() == 1 ? "" : "s",
                           join(first, ", "), failed.size() > few ? ", ..." : "", effects.used));
}

/// Makes a name usable as a part of a key that differs from the keys already used.
std::string key_of(std::string name, const Report& taken) {
    std::ranges::replace(name, '.', '_');
    while (name.empty() || taken.find(name) != nullptr) name += '_';
    return name;
}

/// Adds an index and its interval if they are finite.
void add(Report& report, const std::string& name, const Index& index) {
    if (!std::isfinite(index.value)) return;
    report.add(name, index.value);
    if (!std::isfinite(index.low) || !std::isfinite(index.high)) return;
    report.add(name + "_low", index.low);
    report.add(name + "_high", index.high);
}

/// Indices of one input and, if some indices are missing, the reason.
Report report_of_input(const Effects& effects, std::size_t i) {
    Report own;
    const auto known = [i](const IndexKind& kind) { return std::isfinite(kind.of[i].value); };
    for (const IndexKind& kind : effects.kinds) add(own, kind.name, kind.of[i]);
    if (!std::ranges::all_of(effects.kinds, known))
        own.add("missing",
                i < effects.missing.size() && !effects.missing[i].empty()
                    ? effects.missing[i]
                    : "the index cannot be determined from the runs, or is too large for float64");
    return own;
}

Report report_of(const Effects& effects, const std::string& name, const Inputs& in,
                 const Response& out) {
    Report report;
    report.add("method", name);
    report.add("failed", out.y.size() - succeeded(out.y).size());
    report.add("used", effects.used);
    report.add("samples", effects.samples);
    if (std::isfinite(effects.mean)) report.add("mean", effects.mean);
    if (std::isfinite(effects.variance)) report.add("variance", effects.variance);
    for (const auto& entry : effects.details.entries()) report.entries().push_back(entry);
    if (!effects.no_intervals.empty()) report.add("no_intervals", effects.no_intervals);
    std::vector<std::string> keys;
    for (std::size_t i = 0; i < in.size(); ++i) {
        keys.push_back(key_of(in.names[i], report));
        report.add(keys.back(), report_of_input(effects, i));
    }
    for (const PairIndex& pair : effects.pairs) {
        Report own;
        add(own, "second", pair.index);
        if (own.entries().empty()) continue;  // the reports of both inputs contain the reason
        report.add(key_of(keys[pair.first] + ":" + keys[pair.second], report), std::move(own));
    }
    return report;
}

Report report_of_none(const Response& out, const std::string& why) {
    Report report;
    report.add("failed", out.y.size() - succeeded(out.y).size());
    return report.add("missing", why);
}

/// Checks that each given option applies to a method that was used. @throws Error(usage)
void check_options(const Values& options, const std::vector<std::string>& methods) {
    const auto require = [&](const auto& option, std::vector<std::string> of) {
        const bool used = std::ranges::find_first_of(methods, of) != methods.end();
        if (options.given(option) && !methods.empty() && !used)
            fail(ErrorKind::usage, "--{} applies to --method {}; this is {}", option.name,
                 join(of, " and "), methods.front());
    };
    require(bootstrap, {"saltelli", "morris"});
    require(bootstrap_seed, {"saltelli", "morris"});
    require(harmonics, {"fast"});
    require(degree, {"chaos"});
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    if (points.count() == 0) fail(ErrorKind::input, "sensitivity needs at least one run");
    const Runs runs = runs_of(
        points,
        {.design = options[design], .inputs = options[inputs], .response = options[response]}, run);
    const Setting setting = setting_of(options);
    const Plan plan = plan_of(runs.inputs, options[method], setting, run);
    Report report;
    std::vector<std::string> methods;
    const auto count = static_cast<double>(runs.responses.size());
    for (std::size_t r = 0; r < runs.responses.size(); ++r) {
        const Response& out = runs.responses[r];
        const auto done = static_cast<double>(r);
        const std::string key = key_of(out.name, report);
        Plan own = plan;
        if (const std::string why = why_none(plan.method, out); !why.empty()) {
            report.add(key, report_of_none(out, why));
            continue;
        }
        try {
            const Effects effects =
                effects_of(own, runs, out, setting, run.stage(done / count, (done + 1) / count));
            note_failures(out, effects, run);
            const auto* scale = std::get_if<std::string>(effects.details.find("scale"));
            if (scale != nullptr && *scale == "range" && methods.empty())
                run.notify(
                    "the ranges of the inputs are not known; each input is scaled by its own "
                    "extremes; --parameters, --bounds or the provenance of the design would give "
                    "the ranges");
            methods.push_back(own.method);
            report.add(key, report_of(effects, own.method, runs.inputs, out));
        } catch (const Error& error) {  // other outputs may have indices
            if (runs.responses.size() == 1 || error.kind() != ErrorKind::input) throw;
            report.add(key, report_of_none(out, error.what()));
        }
    }
    check_options(options, methods);
    run.tick(1, 1);
    return report;
}

/// Records of the results. Those of an index are followed by those of its interval.
std::vector<ResultKey> result_keys() {
    std::vector<ResultKey> keys = {
        {"OUTPUT.method", "saltelli, morris, fast, rank or chaos", true,
         "saltelli|morris|fast|rank|chaos"},
        {"OUTPUT.reason",
         "for auto, if the rows form the design of no method: why chaos or rank was chosen"},
        {"OUTPUT.missing",
         "reason why an output has no indices, instead of its numbers: for example, it is constant",
         false},
        {"OUTPUT.no_intervals", "reason why indices have no intervals, for example few runs",
         false},
        {"OUTPUT.failed", "number of runs without this output"},
        {"OUTPUT.used", "number of runs used for the indices"},
        {"OUTPUT.samples",
         "number of independent samples among them: base rows (saltelli), trajectories (morris), "
         "points of a curve (fast), otherwise runs"},
        {"OUTPUT.mean", "mean of the output; absent for morris"},
        {"OUTPUT.variance",
         "variance of the output, of which the indices are fractions; absent for morris, and if it "
         "is beyond float64"},
        {"OUTPUT.q2",
         "for chaos: fraction of the variance that polynomials predict in runs not used to fit "
         "them (five-fold cross-validation); 0 or less if they predict nothing",
         false},
        {"OUTPUT.degree", "for chaos: largest total degree of the candidate terms", false},
        {"OUTPUT.terms",
         "for chaos: number of terms of the largest polynomial, without the constant", false},
        {"OUTPUT.scale",
         "for morris and chaos: how inputs are mapped to [0, 1]: cube: unchanged; box: from the "
         "box in provenance or --bounds; distributions: by those in provenance or --parameters; "
         "range: from their extremes. For chaos also values and ranks, which use the distribution "
         "of the sample",
         false, "cube|box|distributions|range|values|ranks"},
        {"OUTPUT.INPUT.missing", "reason why some index of the input is missing", false}};
    const auto add_index = [&](const std::string& key, const char* help, bool always = false,
                               const std::string& absent = {}) {
        keys.push_back({key, help, always});
        keys.push_back({key + "_low", "lower end of its interval" + absent, always});
        keys.push_back({key + "_high", "upper end of its interval" + absent, always});
    };
    add_index("OUTPUT.INPUT.first", "fraction of the variance that is due to the input alone", true,
              "; absent for fast");
    add_index("OUTPUT.INPUT.total",
              "fraction that is due to the input, alone or together with others; absent for rank");
    add_index("OUTPUT.INPUT.mu", "for morris: mean elementary effect");
    add_index("OUTPUT.INPUT.mu_star", "for morris: mean absolute elementary effect");
    add_index("OUTPUT.INPUT.sigma",
              "for morris: standard deviation of elementary effects; large if the input acts "
              "nonlinearly or together with others");
    add_index("OUTPUT.PAIR.second",
              "fraction that is due to two inputs together, beyond what each does alone; the pair "
              "is named x:y; for saltelli with --second-order, and for chaos, which omits pairs of "
              "index 0");
    return keys;
}

}  // namespace

Analyzer unit() {
    return {.name = "sensitivity",
            .summary = "Sobol' indices and elementary effects of a model's inputs, from its runs",
            .source = "Saltelli et al. 2008, doi:10.1002/9780470725184",
            .related = {"sobol-indices", "variance-based", "screening", "uncertainty", "surrogate",
                        "polynomial-chaos", "elementary-effects", "gsa", "salib", "pick-freeze"},
            .traits = {.unit_cube = false, .table = true},
            .options = Schema(design, inputs, response, method, bootstrap, bootstrap_seed, level,
                              harmonics, degree),
            .results = result_keys(),
            .analyze = analyze,
            .cost = [](double n, double d) { return 3e-6 * n * (d + 1); }};
}

}  // namespace stipple::analyzers::sensitivity
