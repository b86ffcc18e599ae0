// SPDX-License-Identifier: MIT
#include "math/geometry/edge_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arithmetic/double_double.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

/// Cross product from exact products: areas of slivers are small differences of large numbers.
Vector3 exact_cross(const ExactEdge& e, const ExactEdge& f) {
    const auto product = [&](std::size_t i, std::size_t j, double sign) {
        return DoubleDouble{sign * e.high[i], sign * e.low[i]} * DoubleDouble{f.high[j], f.low[j]};
    };
    Vector3 n;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t i = (k + 1) % 3;
        const std::size_t j = (k + 2) % 3;
        n[k] = (product(i, j, 1) + product(j, i, -1)).high;
    }
    return n;
}

}  // namespace

ExactEdge exact_edge(const Vector3& from, const Vector3& to) {
    ExactEdge edge{};
    for (std::size_t k = 0; k < 3; ++k) {
        const DoubleDouble difference = exact_sum(to[k], -from[k]);
        edge.high[k] = difference.high;
        edge.low[k] = difference.low;
    }
    return edge;
}

EdgeFrame::EdgeFrame(const Vector3& corner, const ExactEdge& a, const ExactEdge& b, double size)
    : corner_(corner) {
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    lengths_ = {length(a.high), length(b.high), length(minus(b.high, a.high))};
    const double longest = *std::ranges::max_element(lengths_);
    // Scaling by a power of 2 near the longest edge avoids overflow, underflow and rounding.
    const double unit = longest > 1e-140 ? unit_for(longest) : 1;
    const Vector3 e = times(a.high, 1 / unit);
    const Vector3 f = times(b.high, 1 / unit);
    const Vector3 n = exact_cross({e, times(a.low, 1 / unit)}, {f, times(b.low, 1 / unit)});
    const double area = length(n);
    const double height = area * unit * (unit / longest);
    flat_ = !(longest > 1e-140 && height > 64 * epsilon * size);
    if (flat_) return;
    area_ = area * unit * unit;
    slack_ = 16 * epsilon * size * (longest / height);
    normal_ = times(n, 1 / area);
    g_ = times(cross(f, normal_), 1 / (area * unit));
    h_ = times(cross(normal_, e), 1 / (area * unit));
}

}  // namespace stipple
