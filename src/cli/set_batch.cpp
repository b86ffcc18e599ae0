// SPDX-License-Identifier: MIT
#include "cli/set_batch.hpp"

#include <exception>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace stipple::cli {
namespace {

constexpr std::size_t large = std::size_t{1} << 18;     // coordinates of a set
constexpr std::size_t together = std::size_t{1} << 20;  // of all that wait
constexpr std::size_t most_waiting = std::size_t{1} << 12;

/// What became of a set.
struct Outcome {
    std::optional<Measurement> measurement;
    std::exception_ptr error;
    bool over_limit = false;  ///< it would need more than its share of the memory, say
    std::vector<std::string> warnings;
};

/// Measures sets side by side, a thread each; those that a stop came before have no outcome.
std::vector<Outcome> side_by_side(std::span<const FoundSet> sets, const SetBatch::Measure& measure,
                                  const RunContext& run) {
    std::vector<Outcome> outcomes(sets.size());
    RunContext all = run;
    all.stop = {};  // a set that has begun may come to a result nevertheless
    for_each_block(all, sets.size(), 1, [&](const Block& block) {
        if (run.stop.stop_requested()) return;
        Outcome& outcome = outcomes[block.index];
        RunContext one = run;
        one.threads = 1;
        one.progress = {};
        one.max_memory = run.max_memory / run.thread_count();
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
    return outcomes;
}

}  // namespace

SetBatch::SetBatch(const RunContext& run, Measure measure, Keep keep)
    : run_(run), measure_(std::move(measure)), keep_(std::move(keep)) {}

void SetBatch::add(FoundSet set) {
    const std::size_t numbers = set.points.flat().size();
    if (numbers >= large) {
        finish();
        alone(set);
        return;
    }
    waiting_.push_back(std::move(set));
    numbers_ += numbers;
    if (numbers_ >= together || waiting_.size() >= most_waiting) finish();
}

void SetBatch::alone(const FoundSet& set) {
    if (run_.stop.stop_requested()) return;
    keep_(set, measure_(set, run_));
}

void SetBatch::finish() {
    const auto sets = std::exchange(waiting_, {});
    numbers_ = 0;
    const std::size_t threads = run_.thread_count();
    // The last ones, too few for a thread each, are measured by all threads one after the other.
    const std::size_t spread = threads > 1 ? sets.size() - sets.size() % threads : 0;
    auto outcomes = side_by_side(std::span(sets).first(spread), measure_, run_);
    for (std::size_t i = 0; i < spread; ++i) {
        Outcome& outcome = outcomes[i];
        if (outcome.over_limit) {
            alone(sets[i]);
            continue;
        }
        for (const auto& sentence : outcome.warnings) run_.notify(sentence);
        if (outcome.error) std::rethrow_exception(outcome.error);
        if (outcome.measurement) keep_(sets[i], std::move(*outcome.measurement));
    }
    for (std::size_t i = spread; i < sets.size(); ++i) alone(sets[i]);
}

}  // namespace stipple::cli
