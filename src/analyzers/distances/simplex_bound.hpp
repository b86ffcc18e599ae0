// SPDX-License-Identifier: MIT
//
// How far, at most, a place of a box around the origin is from the nearest of some points u_i:
//
//     max over |y_k| <= h_k of  min_i |y - u_i|^2
//         <=  |h|^2 + max over |y_k| <= h_k of  min_i ( |u_i|^2 - 2 u_i . y ).
//
// The right side is a linear program. Its dual,
//
//     minimise  sum_i w_i |u_i|^2 + 2 sum_k h_k |m_k|,   m = sum_i w_i u_i,  w >= 0,  sum_i w_i =
//     1,
//
// is solved by the simplex method, from the nearest point's weight of 1 on. Any weights give a
// bound, so that nothing depends on how far it gets.
//
// Shape   some points (at least one) in d dimensions.
// Cost    some 2 d steps of O(d (points + d)).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace stipple::analyzers {

/// Points around the origin, and room to work in.
struct Neighborhood {
    std::size_t dimension = 0;
    std::vector<double> offsets = {};  ///< one point after the other, the nearest first
    std::vector<double> table = {};

    void clear(std::size_t d) {
        dimension = d;
        offsets.clear();
    }
    [[nodiscard]] std::size_t count() const { return offsets.size() / dimension; }
    [[nodiscard]] const double* operator[](std::size_t i) const {
        return offsets.data() + i * dimension;
    }
};

struct SimplexBound {
    double squared;             ///< the bound
    std::vector<double> place;  ///< y that solves the linear program, in the box
};

SimplexBound bound_in_box(Neighborhood& near, std::span<const double> half);

}  // namespace stipple::analyzers
