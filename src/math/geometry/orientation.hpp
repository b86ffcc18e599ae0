// SPDX-License-Identifier: MIT
//
// Exact predicates in the plane: the side of a line that a point is on, and which of two edges is
// on the left where a row, a horizontal line, crosses both.
//
//     det = (a_x - c_x) (b_y - c_y) - (a_y - c_y) (b_x - c_x)
//
// If rounding could change the sign of the determinant, its six products are added exactly.
//
// Shape   coordinates within [-1e150, 1e150].
// Promise the correct sign, unless products are below 1e-290.
// Source  J. R. Shewchuk, Discrete Comput. Geom. 18 (1997) 305-363, doi:10.1007/PL00009321.
#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "math/arithmetic/double_double.hpp"
#include "math/geometry/vector3.hpp"

namespace stipple {

/// Sign of a sum of n products of two doubles.
template <std::size_t n>
int exact_sign(const std::array<DoubleDouble, n>& products) {
    std::array<double, 2 * n> parts{};  // without common bits, in increasing order of size
    std::size_t count = 0;
    for (const DoubleDouble& product : products)
        for (double term : {product.low, product.high}) {
            for (std::size_t i = 0; i < count; ++i) {
                const DoubleDouble sum = exact_sum(term, parts[i]);
                parts[i] = sum.low;
                term = sum.high;
            }
            parts[count++] = term;
        }
    while (count-- > 0)
        if (parts[count] != 0) return parts[count] > 0 ? 1 : -1;
    return 0;
}

/// Returns 1 if c is left of the line from a to b, -1 if right, 0 if on it.
inline int orientation(PlanePoint a, PlanePoint b, PlanePoint c) {
    constexpr double rounding = 2 * std::numeric_limits<double>::epsilon();
    const double left = (a.x - c.x) * (b.y - c.y);
    const double right = (a.y - c.y) * (b.x - c.x);
    const double twice = left - right;  // twice the area of the triangle
    if (std::abs(twice) > rounding * (std::abs(left) + std::abs(right))) return twice > 0 ? 1 : -1;
    return exact_sign<6>({exact_product(a.x, b.y), exact_product(-a.x, c.y),
                          exact_product(-c.x, b.y), exact_product(-a.y, b.x),
                          exact_product(a.y, c.x), exact_product(c.y, b.x)});
}

/// Row order: upwards, and from left to right within a row.
inline bool is_before(PlanePoint p, PlanePoint q) { return p.y < q.y || (p.y == q.y && p.x < q.x); }

/// An edge directed upwards, or to the right if it is horizontal.
struct UpwardEdge {
    PlanePoint low;
    PlanePoint high;
};

inline UpwardEdge upward(PlanePoint p, PlanePoint q) {
    return is_before(p, q) ? UpwardEdge{p, q} : UpwardEdge{q, p};
}

/// Returns 1 if edge e is left of edge f, -1 if right, 0 if they overlap. Some row must cross both
/// edges, and they must not cross each other.
inline int side_of_edge(const UpwardEdge& f, const UpwardEdge& e) {
    if (is_before(e.low, f.low)) return -side_of_edge(e, f);
    const int start = orientation(f.low, f.high, e.low);
    return start != 0 ? start : orientation(f.low, f.high, e.high);
}

}  // namespace stipple
