// SPDX-License-Identifier: MIT
//
// The worst of all axis-parallel boxes, by branch and bound.
#pragma once

#include "analyzers/extreme_box.hpp"

namespace stipple::analyzers::extreme {

struct SearchResult {
    WorstBox worst;
    double upper;   ///< no box is worth more, over the scale
    bool complete;  ///< nothing is worse than the worst box
};

/// Searches on from a box found before; gives up after about `max_work` comparisons of
/// coordinates. Looks at open boxes alone for the largest empty box. Never depends on the number of
/// threads.
SearchResult search(const BoxGrid& grid, WorstBox worst, std::uint64_t max_work,
                    const RunContext& run);

}  // namespace stipple::analyzers::extreme
