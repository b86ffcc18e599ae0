// SPDX-License-Identifier: MIT
//
// The points with normal . x <= bound.
#pragma once

#include <string>
#include <vector>

namespace stipple {

struct HalfSpace {
    std::vector<double> normal;  ///< all 0: every point, or none where the bound is below 0
    double bound = 0;
    std::string text = {};  ///< as a user wrote it, for messages
};

}  // namespace stipple
