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
    /// Increasing in u; empty if the axis is continuous.
    std::function<double(double u)> outcome = {};
    bool categories = false;  ///< outcomes are unordered categories, any two equally different

    [[nodiscard]] bool discrete() const { return static_cast<bool>(outcome); }
};

/// Ends of the intervals of [0, 1] with the same outcome, ascending; empty if there are more than
/// `most` intervals or the axis is continuous.
std::vector<double> outcome_ends(const OutcomeAxis& axis, std::size_t most);

/// As outcome_ends(), for outcomes that serve as levels: at most ten numbers or 10 000 categories.
std::vector<double> level_ends(const OutcomeAxis& axis);

}  // namespace stipple
