// SPDX-License-Identifier: MIT
//
// The half-space of all points x with normal . x <= bound.
#pragma once

#include <string>
#include <vector>

namespace stipple {

struct HalfSpace {
    std::vector<double> normal;  ///< if all are 0, every point is inside, or none if bound < 0
    double bound = 0;
    std::string text = {};  ///< as written by the user, for messages
};

}  // namespace stipple
