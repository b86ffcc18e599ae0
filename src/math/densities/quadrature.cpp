// SPDX-License-Identifier: MIT
#include "math/densities/quadrature.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <queue>
#include <vector>

namespace stipple {
namespace {

/// Nodes on [-1, 1] from 0 on, and their mirror images; every second one is a node of Gauss's rule.
template <std::size_t n>
struct KronrodRule {
    std::array<double, n> nodes;
    std::array<double, n> weights;
    std::array<double, n / 2> gauss;  ///< weights of the nodes 0, 2, 4, ... in Gauss's rule
};

constexpr KronrodRule<8> fifteen{
    {0, 0.20778495500789848, 0.40584515137739718, 0.58608723546769115, 0.74153118559939446,
     0.8648644233597691, 0.94910791234275849, 0.99145537112081261},
    {0.20948214108472782, 0.20443294007529889, 0.19035057806478542, 0.16900472663926791,
     0.14065325971552592, 0.10479001032225019, 0.063092092629978558, 0.022935322010529224},
    {0.4179591836734694, 0.38183005050511892, 0.27970539148927664, 0.1294849661688697}};

constexpr KronrodRule<16> thirty_one{
    {0, 0.10114206691871749, 0.20119409399743451, 0.29918000715316884, 0.39415134707756339,
     0.4850818636402397, 0.57097217260853883, 0.65099674129741703, 0.72441773136017007,
     0.79041850144246595, 0.84820658341042721, 0.89726453234408188, 0.93727339240070595,
     0.96773907567913908, 0.98799251802048538, 0.99800229869339707},
    {0.10133000701479154, 0.10076984552387559, 0.099173598721791961, 0.096642726983623681,
     0.093126598170825317, 0.088564443056211764, 0.083080502823133021, 0.076849680757720376,
     0.069854121318728257, 0.062009567800670642, 0.053481524690928088, 0.044589751324764879,
     0.035346360791375847, 0.02546084732671532, 0.015007947329316122, 0.0053774798729233492},
    {0.20257824192556129, 0.19843148532711158, 0.18616100001556221, 0.16626920581699392,
     0.13957067792615432, 0.10715922046717194, 0.070366047488108124, 0.030753241996117269}};

template <std::size_t n>
Estimate by_rule(const KronrodRule<n>& rule, const std::function<double(double)>& f, double low,
                 double high) {
    const double middle = (high + low) / 2;
    const double half = (high - low) / 2;
    const double first = f(middle);
    double kronrod = first * rule.weights[0];
    double gauss = first * rule.gauss[0];
    const auto pair = [&](std::size_t i) {
        const double right = f(half * rule.nodes[i] + middle);
        return right + f(half * -rule.nodes[i] + middle);
    };
    for (std::size_t i = 2; i < n; i += 2) {
        const double sum = pair(i);
        kronrod += sum * rule.weights[i];
        gauss += sum * rule.gauss[i / 2];
    }
    for (std::size_t i = 1; i < n; i += 2) kronrod += pair(i) * rule.weights[i];
    const double rounding = 2 * std::numeric_limits<double>::epsilon() * std::abs(kronrod);
    return {half * kronrod, std::max(std::abs(kronrod - gauss), rounding)};
}

/// Halved where the error is above `tolerance`, and above 1e-10 of the value itself.
Estimate by_halves(const std::function<double(double)>& f, double low, double high, int levels,
                   double tolerance) {
    const Estimate whole = by_rule(thirty_one, f, low, high);
    const double relative = std::abs(whole.value * 1e-10);
    const double goal = tolerance == 0 ? relative : tolerance;
    if (levels == 0 || whole.error <= relative || whole.error <= goal) return whole;
    const double middle = (low + high) / 2;
    const Estimate left = by_halves(f, low, middle, levels - 1, goal / 2);
    const Estimate right = by_halves(f, middle, high, levels - 1, goal / 2);
    return {left.value + right.value, left.error + right.error};
}

struct Interval {
    double low;
    double high;
    Estimate sum;

    bool operator<(const Interval& other) const { return sum.error < other.sum.error; }
};

/// What f at an end differs from a parabola through the three nodes next to it.
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
        x[k] = middle + (k < 7 ? -half : half) * fifteen.nodes[node];
        value[k] = f(x[k]);
        kronrod += fifteen.weights[node] * value[k];
        if (node % 2 == 0) gauss += fifteen.gauss[node / 2] * value[k];
    }
    // Just inside, where a jump at the end itself does not count.
    const double inset = 1e-9 * half;
    const double ends =
        surprise({x[0], x[1], x[2]}, {value[0], value[1], value[2]}, low, f(low + inset)) +
        surprise({x[14], x[13], x[12]}, {value[14], value[13], value[12]}, high, f(high - inset));
    return {low, high, {half * kronrod, half * (std::abs(kronrod - gauss) + 0.01 * ends)}};
}

}  // namespace

Estimate gauss_kronrod_15(const std::function<double(double)>& f, double low, double high) {
    return by_rule(fifteen, f, low, high);
}

Estimate gauss_kronrod_31(const std::function<double(double)>& f, double low, double high) {
    return by_rule(thirty_one, f, low, high);
}

Estimate integrate_smooth(const std::function<double(double)>& f, double low, double high) {
    if (!(low < high)) return {};
    const double width = high - low;
    const auto by_t = [&](double t) {
        return 6 * t * (1 - t) * width * f(std::min(low + width * (t * t * (3 - 2 * t)), high));
    };
    return by_halves(by_t, 0, 1, 4, 0);
}

Estimate integrate_interval(const std::function<double(double)>& f, double low, double high,
                            const Effort& effort) {
    if (!(low < high)) return {0, 0};
    std::priority_queue<Interval> intervals;
    Estimate total;
    const auto add = [&](const Interval& interval, double sign) {
        total.value += sign * interval.sum.value;
        total.error += sign * interval.sum.error;
    };
    const double step = (high - low) / static_cast<double>(effort.first);
    const auto cut = [&](std::size_t i) {
        return i < effort.first ? low + static_cast<double>(i) * step : high;
    };
    for (std::size_t i = 0; i < effort.first; ++i) intervals.push(measured(f, cut(i), cut(i + 1)));
    const auto sum = [&] {
        total = {};
        auto left = intervals;
        for (; !left.empty(); left.pop()) add(left.top(), 1);
    };
    sum();
    while (total.error > effort.tolerance * std::abs(total.value) && total.error > 0 &&
           intervals.size() < effort.most) {
        const Interval worst = intervals.top();
        const double middle = 0.5 * (worst.low + worst.high);
        if (!(worst.low < middle && middle < worst.high)) break;
        intervals.pop();
        add(worst, -1);
        for (const Interval& half :
             {measured(f, worst.low, middle), measured(f, middle, worst.high)}) {
            add(half, 1);
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
    double inner_error = 0;  // the largest, times what lies outside
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
