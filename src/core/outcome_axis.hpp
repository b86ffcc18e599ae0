// SPDX-License-Identifier: MIT
//
// Maps from a coordinate in [0, 1] to the outcomes of a discrete distribution.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

namespace stipple {

struct OutcomeAxis {
    /// Outcome for the coordinate u, nondecreasing in u; empty if the axis is continuous.
    std::function<double(double u)> outcome = {};
    bool categories = false;  ///< outcomes are categories without an order

    [[nodiscard]] bool discrete() const { return static_cast<bool>(outcome); }
};

/// Ends of the intervals of u with one outcome each, ascending from 0 to 1; empty if there are more
/// than `most` intervals or the axis is continuous.
std::vector<double> outcome_ends(const OutcomeAxis& axis, std::size_t most);

/// outcome_ends() for outcomes that serve as levels of a factor; empty if there are more than 10
/// numbers or 10 000 categories.
std::vector<double> level_ends(const OutcomeAxis& axis);

}  // namespace stipple
