// SPDX-License-Identifier: MIT
//
// The points with normal . x <= bound.
#pragma once

#include <string>
#include <vector>

namespace stipple {

struct HalfSpace {
    std::vector<double> normal;  ///< if all 0: every point, or none for bound < 0
    double bound = 0;
    std::string text = {};  ///< as written by the user, for messages
};

}  // namespace stipple
