// SPDX-License-Identifier: MIT
//
// Unit coordinates that are mapped to the outcomes of a discrete distribution.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace stipple {

/// Maps a unit coordinate to the outcomes of a discrete distribution.
struct OutcomeAxis {
    std::function<double(double u)> outcome = {};  ///< rises with u; empty: the axis is continuous
    bool categories = false;  ///< outcomes are unordered categories, all equally different

    [[nodiscard]] bool discrete() const { return static_cast<bool>(outcome); }
};

/// Ends of the intervals of [0, 1] with the same outcome, ascending; empty if there are more than
/// `most` intervals or the axis is continuous.
std::vector<double> outcome_ends(const OutcomeAxis& axis, std::size_t most);

/// Like outcome_ends(), for axes whose outcomes serve as levels: categories, or up to ten numbers.
std::vector<double> level_ends(const OutcomeAxis& axis);

}  // namespace stipple
