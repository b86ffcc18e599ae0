// SPDX-License-Identifier: MIT
#include "core/outcome_axis.hpp"

#include "core/rng.hpp"

namespace stipple {

std::vector<double> outcome_ends(const OutcomeAxis& axis, std::size_t most) {
    if (!axis.discrete()) return {};
    const double last = axis.outcome(one_minus_ulp);
    std::vector<double> ends{0};
    while (ends.back() < 1) {
        if (ends.size() > most) return {};
        const double x = axis.outcome(ends.back());
        double inside = ends.back();
        double end = 1;
        while (x != last && inside < (inside + end) / 2 && (inside + end) / 2 < end) {
            const double middle = (inside + end) / 2;
            (axis.outcome(middle) == x ? inside : end) = middle;
        }
        ends.push_back(end);
    }
    return ends;
}

std::vector<double> level_ends(const OutcomeAxis& axis) {
    return outcome_ends(axis, axis.categories ? 10'000 : 10);
}

}  // namespace stipple
