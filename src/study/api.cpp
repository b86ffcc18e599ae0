// SPDX-License-Identifier: MIT
//
// Public API of studies: results in memory.
#include <cmath>

#include "core/error.hpp"
#include "stipple/study.hpp"
#include "study/study_summary.hpp"
#include "study/study_table.hpp"
#include "study/sweep.hpp"
#include "study/unit_runner.hpp"

namespace stipple {
namespace {

std::optional<double> known(const std::optional<double>& value) {
    return value && std::isnan(*value) ? std::nullopt : value;
}

}  // namespace

std::vector<StudyValue> study(const Study& wanted, const RunContext& run) try {
    const Sweep sweep({.generators = wanted.generators,
                       .counts = wanted.counts,
                       .dimensions = wanted.dimensions,
                       .first_seed = wanted.first_seed,
                       .seeds = wanted.seeds,
                       .measures = wanted.analyzers,
                       .warps = wanted.warps,
                       .keys = wanted.keys,
                       .seconds = false});
    run.need_memory(static_cast<double>(sweep.units()) * sizeof(StudyValue), "the study's table");
    const UnitRunner runner(sweep, run);
    runner.require_options(run);
    std::vector<StudyValue> values;
    for (const auto& [units, results] : runner.run({{0, sweep.units()}}, run).segments)
        for (std::uint64_t unit = units.first; unit < units.last; ++unit)
            for (const StudyRow& row :
                 rows_of(sweep, sweep.unit(unit), results[unit - units.first]))
                values.push_back({row.generator, row.measure, row.dimension, row.count, row.seed,
                                  row.key, known(row.value), row.reason});
    return values;
} catch (...) {
    throw_to_caller();
}

StudySummary summary_of(std::span<const StudyValue> values) {
    StudySummary summary;
    for (const StudyValue& v : values)
        if (v.value)
            summary.add({.generator = v.generator,
                         .dimension = v.dimension,
                         .count = v.count,
                         .seed = v.seed,
                         .measure = v.analyzer,
                         .key = v.key,
                         .value = v.value});
    return summary;
}

std::vector<StudyMean> means_of(std::span<const StudyValue> values, double confidence) {
    if (!(confidence > 0 && confidence < 1))
        fail(ErrorKind::usage, "a confidence of {} is outside (0, 1)", confidence);
    const StudySummary summary = summary_of(values);
    std::vector<StudyMean> means;
    for (const MeanRow& row :
         summary.mean_rows({.confidence = confidence, .resamples = 0}, RunContext()))
        means.push_back({row.generator, row.measure, row.dimension, row.count, row.key, row.sets,
                         row.mean, row.t_low, row.t_high, row.rms});
    return means;
}

}  // namespace stipple
