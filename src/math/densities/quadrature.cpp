// SPDX-License-Identifier: MIT
#include "math/densities/quadrature.hpp"

#include <algorithm>
#include <array>
#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <cmath>
#include <queue>

namespace stipple {
namespace {

/// Nodes in [0, 1]; those in [-1, 0) are mirror images. Every second one is a Gauss node.
using Kronrod = boost::math::quadrature::gauss_kronrod<double, 15>;
using Gauss = boost::math::quadrature::gauss<double, 7>;

/// Integral by the 31-point rule, bisected up to `levels` times if relative error > `tolerance`.
Estimate by_halves(const std::function<double(double)>& f, double low, double high, unsigned levels,
                   double tolerance) {
    Estimate sum;
    sum.value = boost::math::quadrature::gauss_kronrod<double, 31>::integrate(
        std::cref(f), low, high, levels, tolerance, &sum.error);
    return sum;
}

struct Interval {
    double low;
    double high;
    Estimate sum;

    bool operator<(const Interval& other) const { return sum.error < other.sum.error; }
};

/// Difference of f at an interval's end from the parabola through the three nodes next to it.
double surprise(const std::array<double, 3>& x, const std::array<double, 3>& f, double end,
                double value) {
    double expected = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double a = x[(i + 1) % 3];
        const double b = x[(i + 2) % 3];
        expected += f[i] * (end - a) * (end - b) / ((x[i] - a) * (x[i] - b));
    }
    return std::abs(value - expected);
}

Interval measured(const std::function<double(double)>& f, double low, double high) {
    const double half = 0.5 * (high - low);
    const double middle = low + half;
    std::array<double, 15> x{};
    std::array<double, 15> value{};
    double kronrod = 0;
    double gauss = 0;
    for (std::size_t k = 0; k < 15; ++k) {
        const std::size_t node = k < 7 ? 7 - k : k - 7;
        x[k] = middle + (k < 7 ? -half : half) * Kronrod::abscissa()[node];
        value[k] = f(x[k]);
        kronrod += Kronrod::weights()[node] * value[k];
        if (node % 2 == 0) gauss += Gauss::weights()[node / 2] * value[k];
    }
    // Evaluates slightly inside, so that a jump at the end itself does not matter.
    const double inset = 1e-9 * half;
    const double ends =
        surprise({x[0], x[1], x[2]}, {value[0], value[1], value[2]}, low, f(low + inset)) +
        surprise({x[14], x[13], x[12]}, {value[14], value[13], value[12]}, high, f(high - inset));
    return {low, high, {half * kronrod, half * (std::abs(kronrod - gauss) + 0.01 * ends)}};
}

}  // namespace

Estimate gauss_kronrod(const std::function<double(double)>& f, double low, double high) {
    return by_halves(f, low, high, 0, 0);
}

Estimate integrate_smooth(const std::function<double(double)>& f, double low, double high) {
    if (!(low < high)) return {};
    const double width = high - low;
    const auto by_t = [&](double t) {
        return 6 * t * (1 - t) * width * f(std::min(low + width * (t * t * (3 - 2 * t)), high));
    };
    return by_halves(by_t, 0, 1, 4, 1e-10);
}

std::vector<double> ends_of(std::vector<double> cuts, double low, double high) {
    std::erase_if(cuts, [&](double x) { return !(x > low && x < high); });
    cuts.push_back(low);
    cuts.push_back(high);
    std::ranges::sort(cuts);
    return cuts;
}

Estimate integrate_pieces(const std::function<double(double)>& f, std::span<const double> ends) {
    Estimate total;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        total += integrate_smooth(f, ends[i], ends[i + 1]);
    return total;
}

Estimate integrate_interval(const std::function<double(double)>& f, double low, double high,
                            const Effort& effort) {
    if (!(low < high)) return {0, 0};
    std::priority_queue<Interval> intervals;
    Estimate total;
    const double step = (high - low) / static_cast<double>(effort.first);
    const auto cut = [&](std::size_t i) {
        return i < effort.first ? low + static_cast<double>(i) * step : high;
    };
    for (std::size_t i = 0; i < effort.first; ++i) intervals.push(measured(f, cut(i), cut(i + 1)));
    const auto sum = [&] {
        total = {};
        auto left = intervals;
        for (; !left.empty(); left.pop()) total += left.top().sum;
    };
    sum();
    while (total.error > effort.tolerance * std::abs(total.value) && total.error > 0 &&
           intervals.size() < effort.most) {
        const Interval worst = intervals.top();
        const double middle = 0.5 * (worst.low + worst.high);
        if (!(worst.low < middle && middle < worst.high)) break;
        intervals.pop();
        total += {-worst.sum.value, -worst.sum.error};
        for (const Interval& half :
             {measured(f, worst.low, middle), measured(f, middle, worst.high)}) {
            total += half.sum;
            intervals.push(half);
        }
    }
    sum();
    return total;
}

Estimate integrate_box(const std::function<double(std::span<const double>)>& f, const Box& box,
                       const Effort& effort) {
    const std::size_t d = box.dimension();
    std::vector<double> point(d);
    double inner_error = 0;  // largest inner error times the volume of the outer coordinates
    const std::function<double(std::size_t, double)> inside = [&](std::size_t k, double x) {
        point[k] = x;
        if (k + 1 == d) return f(point);
        const Estimate part = integrate_interval([&](double y) { return inside(k + 1, y); },
                                                 box.low[k + 1], box.high[k + 1], effort);
        double outside = 1;
        for (std::size_t j = 0; j <= k; ++j) outside *= box.extent(j);
        inner_error = std::max(inner_error, part.error * outside);
        return part.value;
    };
    Estimate total =
        integrate_interval([&](double x) { return inside(0, x); }, box.low[0], box.high[0], effort);
    total.error += inner_error * static_cast<double>(d - 1);
    return total;
}

}  // namespace stipple
