// SPDX-License-Identifier: MIT
#include "analyzers/distances/pair_measure.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/tanh_sinh.hpp>
#include <cmath>
#include <numbers>

namespace stipple::analyzers {
namespace {

/// One axis in units of its side L: displacements reach up to `reach`, x being as likely as
/// 2 (1 - slope x) / (1 or 2); the integral over both signs is 1.
struct Axis {
    double side;
    double slope;  ///< 0 on the torus, 1 for straight distances

    [[nodiscard]] double reach() const { return slope > 0 ? side : side / 2; }

    /// Integral of 2 (1 - slope x / L) / L over [0, h], h at most the reach.
    [[nodiscard]] double within(double h) const {
        const double t = std::min(h, reach()) / side;
        return t * (2 - slope * t);
    }
};

double squared(double x) { return x * x; }

/// Integral over x in [low, high] of a.density(x) * b.within(sqrt(r^2 - x^2)), where the root is
/// not above b's reach.
double under_arc(const Axis& a, const Axis& b, double r, double low, double high) {
    const auto root = [&](double x) { return std::sqrt(std::max(0.0, (r - x) * (r + x))); };
    const auto arc = [&](double x) {  // of the root, and of what it has before it
        const double s = root(x);
        const double plain = (x * s + r * r * std::asin(std::min(1.0, x / r))) / 2;
        const double slanted = -s * s * s / 3;
        return plain - a.slope / a.side * slanted;
    };
    const auto parabola = [&](double x) {  // of r^2 - x^2
        return r * r * x - x * x * x / 3 - a.slope / a.side * squared(x) * (r * r / 2 - x * x / 4);
    };
    const double roots = arc(high) - arc(low);
    const double squares = b.slope > 0 ? parabola(high) - parabola(low) : 0;
    return 2 / a.side * (2 * roots / b.side - squares / squared(b.side));
}

double within_disk(const Axis& a, const Axis& b, double r) {
    const double high = std::min(r, a.reach());
    const double flat = r > b.reach() ? std::sqrt((r - b.reach()) * (r + b.reach())) : 0;
    if (flat >= high) return a.within(high) * b.within(b.reach());
    return a.within(flat) * b.within(b.reach()) + under_arc(a, b, r, flat, high);
}

/// Over the height c = r sin(angle), cut where the disk beside it meets a side or a corner.
double within_ball(const Axis& a, const Axis& b, const Axis& c, double r) {
    const double top = r > c.reach() ? std::asin(c.reach() / r) : std::numbers::pi / 2;
    std::array<double, 5> cuts{0, top, top, top, top};
    std::size_t count = 2;
    for (const double rim : {a.reach(), b.reach(), std::hypot(a.reach(), b.reach())})
        if (rim < r) cuts[count++] = std::min(top, std::acos(rim / r));
    std::ranges::sort(cuts);
    const auto slice = [&](double angle) {
        const double z = r * std::sin(angle);
        const double across = r * std::cos(angle);
        return 2 / c.side * (1 - c.slope * z / c.side) * across * within_disk(a, b, across);
    };
    // Beyond a cut the disk's share begins with a broken power, which this rule takes well.
    thread_local boost::math::quadrature::tanh_sinh<double> rule;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
        const double width = cuts[i + 1] - cuts[i];
        const auto part = [&](double share) { return slice(cuts[i] + share * width); };
        if (width > 0) sum += width * rule.integrate(part, 0.0, 1.0, 1e-13);
    }
    return sum;
}

}  // namespace

double pair_probability(const Box& box, bool torus, double r) {
    const auto axis = [&](std::size_t k) { return Axis{box.extent(k), torus ? 0.0 : 1.0}; };
    if (r <= 0) return 0;
    if (r >= longest_distance(box, torus)) return 1;
    if (box.dimension() == 1) return axis(0).within(r);
    if (box.dimension() == 2) return within_disk(axis(0), axis(1), r);
    return within_ball(axis(0), axis(1), axis(2), r);
}

double longest_distance(const Box& box, bool torus) {
    double sum = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) sum += squared(box.extent(k));
    return std::sqrt(sum) / (torus ? 2 : 1);
}

}  // namespace stipple::analyzers
