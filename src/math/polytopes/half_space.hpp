// SPDX-License-Identifier: MIT
//
// The half-space of all points x with normal . x <= bound.
#pragma once

#include <string>
#include <vector>

namespace stipple {

struct HalfSpace {
    std::vector<double> normal;  ///< may be 0: all points are inside if bound >= 0, else none
    double bound = 0;
    std::string text = {};  ///< as written by the user, for messages
};

}  // namespace stipple
