// SPDX-License-Identifier: MIT
//
// Result of a search for an optimized set.
#pragma once

#include <vector>

#include "generators/search_run.hpp"

namespace stipple::optimized {

struct OptimizedRows {
    std::vector<double> rows;
    double value = 0;
    bool stopped = false;  ///< before the budget was used up, for a run that keeps the best
    bool certain = true;   ///< whether the value is exact, not possibly too small
};

}  // namespace stipple::optimized
