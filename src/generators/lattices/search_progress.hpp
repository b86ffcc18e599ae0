// SPDX-License-Identifier: MIT
//
// Progress of a search that goes before the making of points, which takes the rest.
#pragma once

#include <cstdint>

#include "core/run_context.hpp"

namespace stipple {

/// As run.tick, up to 0.99.
inline void search_tick(const RunContext& run, std::uint64_t done, std::uint64_t total) {
    run.check_stop();
    if (run.progress) run.progress(0.99 * static_cast<double>(done) / static_cast<double>(total));
}

}  // namespace stipple
