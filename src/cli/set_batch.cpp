// SPDX-License-Identifier: MIT
#include "cli/set_batch.hpp"

#include <exception>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::cli {
namespace {

/// What became of a set; nothing where a stop came before it.
struct Outcome {
    std::optional<Measurement> measurement;
    std::exception_ptr error;
    bool over_limit = false;  ///< it would need more than its share of the memory, say
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
        RunContext one = run.share_of_memory(threads);
        one.threads = 1;
        one.progress = {};
        one.warn = [&outcome](const std::string& text) { outcome.warnings.push_back(text); };
        try {
            outcome.measurement = measure(sets[block.index], one);
        } catch (const Error& e) {
            outcome.error = std::current_exception();
            outcome.over_limit = e.kind() == ErrorKind::limit;
        } catch (...) {
            outcome.error = std::current_exception();
        }
    });
    for (std::size_t i = 0; i < spread; ++i) {
        Outcome& outcome = outcomes[i];
        if (outcome.over_limit) {
            if (!run.stop.stop_requested()) keep(sets[i], measure(sets[i], run));
            continue;
        }
        for (const auto& sentence : outcome.warnings) run.notify(sentence);
        if (outcome.error) std::rethrow_exception(outcome.error);
        if (outcome.measurement) keep(sets[i], std::move(*outcome.measurement));
    }
    for (const FoundSet& set : sets.subspan(spread))
        if (!run.stop.stop_requested()) keep(set, measure(set, run));
}

}  // namespace stipple::cli
