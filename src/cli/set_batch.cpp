// SPDX-License-Identifier: MIT
#include "cli/set_batch.hpp"

#include <optional>
#include <utility>
#include <vector>

#include "core/parallel.hpp"

namespace stipple::cli {
namespace {

/// What became of a set; nothing where a stop came before it.
struct Outcome {
    std::optional<Measurement> measurement;
    bool failed = false;
    std::vector<std::string> warnings;
};

}  // namespace

void measure_sets(std::span<const FoundSet> sets, const RunContext& run,
                  const std::function<Measurement(const FoundSet&, const RunContext&)>& measure,
                  const std::function<void(const FoundSet&, Measurement)>& keep) {
    const std::size_t threads = run.thread_count();
    // The last ones, too few for a thread each, are measured by all threads one after the other.
    const std::size_t spread = threads > 1 ? sets.size() - sets.size() % threads : 0;
    std::vector<Outcome> outcomes(spread);
    // A set that has begun may come to a result when a stop is requested.
    for_each_block(unstopped(run), spread, 1, [&](const Block& block) {
        if (run.stop.stop_requested()) return;
        Outcome& outcome = outcomes[block.index];
        RunContext one = run;
        one.threads = 1;
        one.progress = {};
        one.max_memory = run.max_memory / threads;
        one.warn = [&outcome](const std::string& text) { outcome.warnings.push_back(text); };
        try {
            outcome.measurement = measure(sets[block.index], one);
        } catch (...) {
            outcome.failed = true;
        }
    });
    for (std::size_t i = 0; i < spread; ++i) {
        Outcome& outcome = outcomes[i];
        if (outcome.failed) {
            // It may only need more than its share of the memory; else this fails again, and tells.
            keep(sets[i], measure(sets[i], run));
            continue;
        }
        for (const auto& sentence : outcome.warnings) run.notify(sentence);
        if (outcome.measurement) keep(sets[i], std::move(*outcome.measurement));
    }
    for (const FoundSet& set : sets.subspan(spread))
        if (!run.stop.stop_requested()) keep(set, measure(set, run));
}

}  // namespace stipple::cli
