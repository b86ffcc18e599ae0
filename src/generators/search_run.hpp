// SPDX-License-Identifier: MIT
//
// Progress of searches with a budget, and their reaction to stop requests.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// Run context for the steps of a search. It ignores stop requests if the run keeps the best
/// result: then the search has to check for them itself.
inline RunContext until_best_is_wanted(const RunContext& run) {
    return run.keeps_best ? unstopped(run) : run;
}

/// Runs `work`; returns false if a stop request ended it and the best result so far is wanted.
/// @throws all other errors of `work`, and the cancellation if the best is not wanted
template <class Work>
bool unless_best_is_wanted(const RunContext& run, const Work& work) {
    try {
        work();
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::cancelled || !run.best_is_wanted()) throw;
        return false;
    }
    return true;
}

/// Reports the fraction `share` of the budget that is used, the latest value and the best so far.
inline void report_search(const RunContext& run, double share, const std::string& words,
                          double value, double best) {
    constexpr std::uint64_t parts = 10'000;
    until_best_is_wanted(run).tick(static_cast<std::uint64_t>(std::min(1.0, share) * parts), parts,
                                   fmt::format("{} {:.6g}, best {:.6g}", words, value, best));
}

}  // namespace stipple
