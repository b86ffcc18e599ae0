// SPDX-License-Identifier: MIT
#include "study/unit_runner.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <functional>
#include <iterator>
#include <map>
#include <mutex>
#include <new>
#include <thread>

#include "core/parallel.hpp"
#include "core/text.hpp"
#include "pipeline/chain.hpp"
#include "pipeline/generated.hpp"
#include "pipeline/pipeline.hpp"
#include "pipeline/units.hpp"
#include "report/document.hpp"

namespace stipple {
namespace {

/// Replaces line breaks by blanks, as a row is one line.
std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    return text;
}

using Task = std::function<void(const RunContext&)>;

/// Calls `work` with a context that is stopped after `limit` seconds by the clock run.seconds.
/// Returns whether the limit was exceeded.
bool over_time(const RunContext& run, std::optional<double> limit, const Task& work) {
    if (!limit || !run.seconds) {
        work(run);
        return false;
    }
    std::stop_source stop;
    std::atomic<bool> over = false;
    const std::jthread watch([&, end = run.seconds() + *limit](const std::stop_token& done) {
        constexpr auto pause = std::chrono::milliseconds(10);
        std::mutex mutex;
        std::unique_lock lock(mutex);
        std::condition_variable_any wake;
        while (!wake.wait_for(lock, done, pause, [&] { return done.stop_requested(); })) {
            over = over || run.seconds() >= end;
            if (over || run.stop.stop_requested()) stop.request_stop();
        }
    });
    RunContext limited = run;
    limited.stop = stop.get_token();
    try {
        work(limited);
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::cancelled || !over) throw;
    }
    run.check_stop();
    return over;
}

/// Runs `work` with a time limit. Stores the time it took and, if it failed, the reason.
/// @throws Error(cancelled)
void attempt(UnitResult& result, double& seconds, std::optional<double> limit,
             const RunContext& run, const Task& work) {
    const double start = run.seconds ? run.seconds() : 0;
    try {
        if (over_time(run, limit, work))
            result.failure = fmt::format("time limit: not done after {} s", *limit);
    } catch (const std::exception& thrown) {
        const Error e = caught_error();
        if (e.kind() == ErrorKind::cancelled) throw;
        const bool limited = e.kind() == ErrorKind::limit;
        const bool file = e.kind() == ErrorKind::io && dynamic_cast<const Error*>(&thrown);
        const auto lack = limited ? lack_of_memory : file ? lack_of_file : "";
        result.failure = one_line(fmt::format("{}{}", lack, e.what()));
        result.out_of_memory =
            limited && (dynamic_cast<const std::bad_alloc*>(&thrown) != nullptr ||
                        e.hint().find("--max-memory") != std::string::npos);
    }
    seconds = run.seconds ? run.seconds() - start : 0;
}

/// Distinct points of the unit cube: coordinate k of point i is (i + 1)(2 k + 1) sqrt(2), modulo 1.
PointSet some_points(std::size_t dimension, std::size_t count = 64) {
    constexpr double step = 0.41421356237309515;
    PointSet points(count, dimension);
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t k = 0; k < dimension; ++k) {
            const double turns = static_cast<double>((i + 1) * (2 * k + 1)) * step;
            points[i][k] = turns - std::floor(turns);
        }
    return points;
}

/// Returns the Error that a measure throws for the points; nullopt if the measure accepts them,
/// throws another exception, or is not done after `limit` seconds.
std::optional<Error> refusal(const Chosen<Analyzer>& measure, const PointSet& points,
                             const RunContext& run, std::optional<double> limit = {}) {
    try {
        over_time(unwarned(silent(run)), limit, [&](const RunContext& limited) {
            (void)analyze(*measure.unit, points, measure.values, limited);
        });
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;
        return e;
    } catch (const std::exception&) {
        return std::nullopt;  // the measure's rows report the error
    }
    return std::nullopt;
}

bool takes_points(const Chosen<Analyzer>& measure, const PointSet& points, const RunContext& run) {
    const auto error = refusal(measure, points, run);
    return !error || (error->kind() != ErrorKind::input && error->kind() != ErrorKind::usage);
}

/// Whether a measure gets the warped points: true if it accepts these, or does not accept the
/// points before the warps either.
bool takes(const Chosen<Analyzer>& measure, const WarpChain& chain, const RunContext& run) {
    const std::string spec = chain.domain()->spec();
    if (spec == "unit-cube") return true;
    if (measure.unit->traits.unit_cube) return false;
    if (measure.unit->traits.boxed && !spec.starts_with("box")) return false;
    const std::size_t d = chain.dimension_in();
    const PointSet points = some_points(d, chain.traits().needs_whole_set ? 64 + d : 64);
    return takes_points(measure, image_of(points, chain, unwarned(silent(run))), run) ||
           !takes_points(measure, points, run);
}

/// A set of points before and after its warps.
struct MadeSet {
    PointSet before = {};
    std::optional<PointSet> image = {};  ///< nullopt if there are no warps
    UnitResult result = {};              ///< seconds and failure, the same for all measures
};

void make(MadeSet& made, const Sweep& sweep, const Cell& cell, std::uint64_t seed,
          const RunContext& run) {
    const auto& generator = sweep.generators()[cell.generator];
    SetsToMake job{.generator = generator.unit,
                   .options = generator.values,
                   .request = {.count = cell.count, .dimension = cell.dimension, .seed = seed}};
    const auto generated = [&](std::span<const Spec> warps) {
        job.warps = {warps.begin(), warps.end()};
        return GeneratedSets(job, run).made(0, run);
    };
    const WarpList& list = sweep.warps_of(cell.generator);
    PointSet& points = made.before;
    points = generated(list.first());
    if (list.later().empty()) return;
    // The chain may be split after the scrambles: their random choices depend only on the seed and
    // the coordinates, so the points are the same.
    const std::size_t d = points.dimension();
    const Plan plan{.count = points.count(), .dimension = d, .seed = seed};
    const ChainSet set = chain_set(*generator.unit, plan, generator.values);
    const WarpChain chain(list.later(), d, set, run);
    if (!chain.traits().refills && !chain.traits().needs_whole_set) {
        made.image = image_of(points, chain, run);
        std::ranges::copy(chain.record().specs, std::back_inserter(made.image->provenance.warps));
        return;
    }
    std::vector<Spec> warps = list.all;
    made.image = generated(warps);
    warps.back() = in_unit_cube(warps.back());
    points = generated(warps);
}

UnitResult measured(const SweepRequest& request, const Chosen<Analyzer>& measure,
                    const PointSet& points, const RunContext& run) {
    UnitResult result{.domain = points.domain->spec(), .points = points.count()};
    Report report;
    attempt(result, result.seconds, request.time_limit, run, [&](const RunContext& limited) {
        report = analyze(*measure.unit, points, measure.values, limited);
        limited.check_stop();  // throws if the time limit cut the report short
    });
    if (!result.failure.empty()) return result;
    result.numbers = numbers_of(report, measure.keys, request.curves);
    if (result.numbers.empty() && report.find("lower") && report.find("upper"))
        result.failure = fmt::format("its value is not known exactly; it is between {} and {}",
                                     format_number(report.number("lower")),
                                     format_number(report.number("upper")));
    else if (result.numbers.empty())
        result.failure =
            fmt::format("none of its results was requested; it has {}", join(report.keys(), ", "));
    return result;
}

void keep(WorkDone& done, std::uint64_t unit, const UnitResult& result) {
    auto& segments = done.segments;
    if (segments.empty() || segments.back().units.last != unit)
        segments.push_back({{unit, unit}, {}});
    segments.back().units.last = unit + 1;
    segments.back().results.push_back(result);
}

}  // namespace

bool is_meant(const std::string& key, const std::vector<std::string>& wanted) {
    const auto dotted = [](std::string text) {
        replace_all(text, "[", ".[");
        return "." + text + ".";
    };
    return std::ranges::any_of(wanted, [&, all = dotted(key)](const std::string& w) {
        return all.find(dotted(w)) != std::string::npos;
    });
}

std::vector<KeyedNumber> numbers_of(const Report& report, const std::vector<std::string>& keys,
                                    bool curves) {
    std::vector<KeyedNumber> numbers;
    std::vector<KeyedNumber> lists;
    for (const std::string& key : report.keys()) {
        const Report::Item& item = *report.find(key);
        const auto number = number_at(report, key);
        const auto list = list_at(report, key).value_or(Report::Curve());
        if (const auto* flag = std::get_if<bool>(&item))
            numbers.push_back({key, *flag ? 1.0 : 0.0});
        if (number) numbers.push_back({key, *number});
        for (std::size_t i = 0; i < list.size(); ++i)
            lists.push_back({fmt::format("{}[{}]", key, i), list[i]});
    }
    if (curves || !keys.empty() || numbers.empty())
        numbers.insert(numbers.end(), lists.begin(), lists.end());
    if (!keys.empty())
        std::erase_if(numbers, [&](const KeyedNumber& n) { return !is_meant(n.key, keys); });
    return numbers;
}

UnitRunner::UnitRunner(const Sweep& sweep, const RunContext& run)
    : sweep_(sweep), whole_memory_(run.max_memory) {
    for (std::size_t w = 0; w < sweep.warp_lists().size(); ++w)
        for (const std::size_t d : sweep.request().dimensions)
            for (std::size_t m = 0; m < sweep.measures().size(); ++m)
                if (!may_take_image({w, d, m}, run)) before_warps_.insert({w, d, m});
}

bool UnitRunner::may_take_image(const View& view, const RunContext& run) const {
    const auto warps = sweep_.warp_lists()[view.warps].later();
    try {
        return warps.empty() || takes(sweep_.measures()[view.measure],
                                      WarpChain(warps, view.dimension, {}, run), run);
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;
        return true;  // any other error is reported in the unit's row
    }
}

// Makes each set once; a set serves all seeds if the seed has no effect.
WorkDone UnitRunner::run(const std::vector<UnitRange>& ranges, const RunContext& run) const {
    const RunContext quiet = unwarned(silent(run));
    const bool shares_memory = run.max_memory < whole_memory_;
    WorkDone done;
    MadeSet set;
    std::map<std::size_t, UnitResult> results;  // results for this set, by index of the measure
    std::optional<std::pair<std::uint64_t, std::uint64_t>> made;  // cell and seed index of `set`
    for (const UnitRange& range : ranges)
        for (std::uint64_t index = range.first; index < range.last; ++index) {
            quiet.check_stop();
            const Unit unit = sweep_.unit(index);
            const Cell cell = sweep_.cell(unit.cell);
            const std::pair wanted{unit.cell, sweep_.seeded(cell.generator) ? unit.seed_index : 0};
            if (made != wanted) {
                results.clear();
                set = {};  // frees the previous set before the next one is made
                const std::uint64_t seed = sweep_.request().first_seed + unit.seed_index;
                attempt(set.result, set.result.generate_seconds, sweep_.request().time_limit, quiet,
                        [&](const RunContext& limited) { make(set, sweep_, cell, seed, limited); });
                made = wanted;
                done.seconds += set.result.generate_seconds;
            }
            const auto [it, fresh] = results.try_emplace(unit.measure);
            UnitResult& result = it->second;
            if (fresh) {
                const std::size_t warps = sweep_.generators()[cell.generator].warps;
                const bool after = set.image && takes_image({warps, cell.dimension, unit.measure});
                result = set.result;
                if (set.result.failure.empty())
                    result = measured(sweep_.request(), sweep_.measures()[unit.measure],
                                      after ? *set.image : set.before, quiet);
                result.generate_seconds = set.result.generate_seconds;
                done.seconds += result.seconds;
            }
            if (result.out_of_memory && shares_memory)
                done.too_large.push_back({index, index + 1});
            else
                keep(done, index, result);
        }
    return done;
}

std::optional<Error> UnitRunner::refusal_of(const View& view, std::size_t count,
                                            const RunContext& run) const {
    constexpr double soon = 0.2;  // seconds allowed for a trial
    PointSet points = some_points(view.dimension, count);
    const auto warps = sweep_.warp_lists()[view.warps].later();
    try {
        if (!warps.empty() && takes_image(view))
            points =
                image_of(points, WarpChain(warps, view.dimension, {}, run), unwarned(silent(run)));
    } catch (const Error& e) {
        if (e.kind() == ErrorKind::cancelled) throw;
        return std::nullopt;  // the measure's rows report the error
    }
    auto error = refusal(sweep_.measures()[view.measure], points, run, soon);
    return error && error->kind() == ErrorKind::usage ? error : std::nullopt;
}

void UnitRunner::require_options(const RunContext& run) const {
    for (std::size_t m = 0; m < sweep_.measures().size(); ++m) {
        std::optional<Error> first;
        const auto refused = [&](std::size_t w, std::size_t d) {
            const auto few = refusal_of({w, d, m}, 64, run);
            if (few && !first) first = few;
            // If the message for 149 points differs, the error depends on the number of points.
            const auto more = few ? refusal_of({w, d, m}, 149, run) : std::nullopt;
            return more && std::string_view(more->what()) == few->what();
        };
        bool always = true;
        for (std::size_t w = 0; w < sweep_.warp_lists().size(); ++w)
            for (const std::size_t d : sweep_.request().dimensions)
                always = always && refused(w, d);
        if (always)
            throw Error(
                first->kind(),
                fmt::format("analyze: {}: {}", sweep_.measures()[m].unit->name, first->what()),
                first->hint());
    }
}

std::vector<std::string> UnitRunner::before_warps() const {
    std::vector<std::string> sentences;
    for (std::size_t m = 0; m < sweep_.measures().size(); ++m)
        for (std::size_t w = 0; w < sweep_.warp_lists().size(); ++w) {
            const auto looks_before = [&](std::size_t d) { return !takes_image({w, d, m}); };
            if (std::ranges::any_of(sweep_.request().dimensions, looks_before))
                sentences.push_back(fmt::format(
                    "{} does not take points of {}: it measures them "
                    "before the warp, on the unit cube",
                    sweep_.measures()[m].spec, short_specs(sweep_.warp_lists()[w].names)));
        }
    return sentences;
}

}  // namespace stipple
