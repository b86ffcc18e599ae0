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
    bool certain = true;   ///< the value; one of a descent that was cut short may be too small
};

}  // namespace stipple::optimized
