// SPDX-License-Identifier: MIT
//
// Studies in memory, for the public API.
#include <algorithm>
#include <string_view>

#include "core/error.hpp"
#include "stipple/study.hpp"
#include "study/study_summary.hpp"
#include "study/study_table.hpp"
#include "study/sweep.hpp"
#include "study/unit_runner.hpp"

namespace stipple {

std::vector<StudyValue> study(const Study& wanted, const RunContext& run) {
    const Sweep sweep({.generators = wanted.generators,
                       .counts = wanted.counts,
                       .dimensions = wanted.dimensions,
                       .first_seed = wanted.first_seed,
                       .seeds = wanted.seeds,
                       .measures = wanted.analyzers,
                       .warps = wanted.warps,
                       .seconds = false});
    const StudyTable table(TableStyle::jsonl, false);
    const UnitRunner runner(sweep, table, run);
    runner.require_options(run);
    std::vector<StudyValue> values;
    for (const Segment& segment : runner.run({{0, sweep.units()}}, run).segments)
        for (std::string_view lines : segment.lines)
            while (!lines.empty()) {
                const auto row = table.parse(lines.substr(0, lines.find('\n')));
                lines.remove_prefix(std::min(lines.find('\n'), lines.size() - 1) + 1);
                values.push_back({row->generator, row->measure, row->dimension, row->count,
                                  row->seed, row->key, row->value, row->reason});
            }
    return values;
}

std::vector<StudyMean> means_of(std::span<const StudyValue> values, double confidence) {
    if (!(confidence > 0 && confidence < 1))
        fail(ErrorKind::usage, "a confidence of {} is outside (0, 1)", confidence);
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
    std::vector<StudyMean> means;
    for (const MeanRow& row :
         summary.mean_rows({.confidence = confidence, .resamples = 0}, RunContext()))
        means.push_back({row.generator, row.measure, row.dimension, row.count, row.key, row.sets,
                         row.mean, row.t_low, row.t_high, row.rms});
    return means;
}

}  // namespace stipple
