// SPDX-License-Identifier: MIT
//
// Studies in memory, for the public API.
#include <map>

#include "core/error.hpp"
#include "stipple/study.hpp"
#include "study/statistics.hpp"
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
    const UnitRunner runner(sweep, table, run.max_memory);
    runner.require_options(run);
    std::vector<StudyValue> values;
    for (const Segment& segment : runner.run({{0, sweep.units()}}, run).segments)
        for (const std::string& line : segment.lines) {
            const auto row = table.parse(std::string_view(line).substr(0, line.find('\n')));
            values.push_back({row->generator, row->measure, row->dimension, row->count, row->seed,
                              row->key, row->value, row->reason});
        }
    return values;
}

std::vector<StudyMean> means_of(std::span<const StudyValue> values, double confidence) {
    if (!(confidence > 0 && confidence < 1))
        fail(ErrorKind::usage, "a confidence of {} is outside (0, 1)", confidence);
    std::vector<StudyMean> means;
    std::vector<std::vector<double>> samples;
    std::map<std::tuple<std::string, std::string, std::uint64_t, std::uint64_t, std::string>,
             std::size_t>
        places;
    for (const StudyValue& v : values) {
        if (!v.value) continue;
        const auto [place, added] = places.try_emplace(
            {v.generator, v.analyzer, v.dimension, v.count, v.key}, means.size());
        if (added) {
            means.push_back({v.generator, v.analyzer, v.dimension, v.count, v.key});
            samples.emplace_back();
        }
        samples[place->second].push_back(*v.value);
    }
    for (std::size_t i = 0; i < means.size(); ++i) {
        const SampleSummary summary = summarize(samples[i]);
        const Interval interval = t_interval(summary, confidence);
        means[i].sets = summary.count;
        means[i].mean = summary.mean;
        means[i].low = interval.low;
        means[i].high = interval.high;
    }
    return means;
}

}  // namespace stipple
