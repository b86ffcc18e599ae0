// SPDX-License-Identifier: MIT
//
// What searches for optimized sets give.
#pragma once

#include <vector>

#include "generators/search_run.hpp"

namespace stipple::optimized {

struct OptimizedRows {
    std::vector<double> rows;
    double value = 0;
    bool stopped = false;  ///< before the budget was used up, since the run keeps the best
};

}  // namespace stipple::optimized
