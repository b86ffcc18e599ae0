// SPDX-License-Identifier: MIT
//
// How searches with a budget report progress, and end when they are stopped.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "stipple/run.hpp"

namespace stipple {

/// The run, which goes on when a stop is requested if it keeps the best: searches look for that.
inline RunContext until_best_is_wanted(const RunContext& run) {
    return run.keeps_best ? unstopped(run) : run;
}

/// Does the work; false if a stop cut it short and the best so far will do.
/// @throws what the work throws, also when it is cut short and the best will not do
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

/// Reports that so much of the budget is used up, the value just found, and the best so far.
inline void report_search(const RunContext& run, double share, const std::string& words,
                          double value, double best) {
    constexpr std::uint64_t parts = 10'000;
    until_best_is_wanted(run).tick(static_cast<std::uint64_t>(std::min(1.0, share) * parts), parts,
                                   fmt::format("{} {:.6g}, best {:.6g}", words, value, best));
}

}  // namespace stipple
