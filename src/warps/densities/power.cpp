// SPDX-License-Identifier: MIT
//
// Unit cube onto the interval [a, b], each coordinate independently, with a density proportional to
// x^k, by inversion; with p = k + 1
//
//     x^p = (1 - xi) a^p + xi b^p,    k = -1:  log x = (1 - xi) log a + xi log b.
//
// k = 2 on [-1, 1] is the density 3 x^2 / 2 and the map x = cbrt(2 xi - 1).
//
// If the interval is on one side of 0, e is the magnitude of the end with the larger |x|^p, o that
// of the other end, r = (o / e)^p < 1, and w the probability between x and the end e:
//
//     |x| = e (1 - w (1 - r))^(1/p) = e exp(log1p(w expm1(p log(o / e))) / p),
//
// where the second form is used if r > 1/2, and has k = -1 as its limit.
//
// Shape   any number of coordinates, all with the same distribution. An interval with negative
//         numbers requires an even k. An interval that contains 0 requires k > -1; if it ends at 0,
//         k above about -0.954, so that at most 1e-14 of the mass is below the smallest double.
// Strata  xi is used directly, not as 1 - xi: xi = 0 is a, and strata become intervals of equal
//         probability in the same order.
// Cost    O(1) a coordinate; on one core about 1 ns for k = 1, 4 for k = 2, 5 for others.
// Promise x in [a, b]. A round trip returns the same xi within 1e-14 (1 + |k| / 10), times 1 +
//         |log(b / a)| if the range does not contain 0, and times max(|a|, |b|) / (b - a). Forward
//         map, inverse and density give the same bits on every machine.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "math/densities/quadrature.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/roots.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/common_options.hpp"
#include "warps/line_domain.hpp"

namespace stipple::warps::power {
namespace {

constexpr Param<double> exponent{
    .name = "exponent",
    .fallback = 2,
    .low = -1000,
    .high = 1000,
    .help = "Exponent k of the density x^k; must be even if the range has negative numbers"};

constexpr Param<Numbers> range{
    {.name = "range", .fallback = "0,1", .help = "The interval: a,b with a < b"}};

/// Method for the inverse of x^p: logarithms if the interval is on one side of 0 and x^p hardly
/// varies on it, otherwise a root.
enum class Root { none, square, cube, other, logarithm };

/// y^(1/p) for y >= 0, computed in the cheapest way; cube roots also for y < 0.
template <Root root>
[[gnu::always_inline]] inline double rooted(double y, double inverse_p) {
    if constexpr (root == Root::none) return y;
    if constexpr (root == Root::square) return std::sqrt(y);
    if constexpr (root == Root::cube) return cube_root(y);
    // The error is at most 40 units in the last place, which is accurate enough here.
    const double root_of_y = stipple::exponential(logarithm(y) * inverse_p);
    return y > 0 ? root_of_y : 0;
}

struct Interval {
    double a;
    double b;
    double p;     ///< k + 1
    double size;  ///< the larger of |a| and |b|
};

/// y^p for y in [0, 1], computed in the cheapest way.
template <Root root>
double powered(double y, double p) {
    if constexpr (root == Root::none) return y;
    if constexpr (root == Root::square) return y * y;
    if constexpr (root == Root::cube) return y * y * y;
    return y > 0 ? stipple::exponential(logarithm(y) * p) : 0;
}

/// Common base of the distributions: everything except the forward map and its inverse.
struct PowerLaw : LineDistribution, Interval {
    explicit PowerLaw(const Interval& interval) : Interval(interval), unit(size) {}

    double unit;      ///< the end with the larger |x|^p, relative to which densities are measured
    double peak = 0;  ///< density at |x| = unit

    std::pair<double, double> range() const override { return {a, b}; }
    double density(double x) const override {
        return contains(x) ? peak * real_power(std::abs(x) / unit, p - 1) : 0;
    }
    LineMoments moments() const override;

  private:
    /// E |x / unit|^n up to a factor that does not depend on n; s = p + n. For an interval on one
    /// side of 0 with the ends `unit` and `other` times `unit`.
    static double one_sided_sum(double s, double other) {
        if (other == 0) return 1 / s;
        const double log = logarithm(other);
        return std::abs(s == 0 ? log : exp_minus_1(s * log) / s);
    }
    double two_sided_sum(double s, double sign) const {
        return (real_power(b / size, s) + sign * real_power(-a / size, s)) / s;
    }
    LineMoments narrow_moments() const;
    LineMoments steep_moments(double heavier, double length) const;
};

/// Moments by quadrature, for ends so close to each other that powers would lose digits.
LineMoments PowerLaw::narrow_moments() const {
    const double middle = 0.5 * (a + b);
    const double scale = unit_for(b - a);
    const auto sum = [&](std::size_t n, double about) {
        const auto integrand = [&](double x) {
            return whole_power((x - about) / scale, n) * real_power(std::abs(x / middle), p - 1);
        };
        return gauss_kronrod(integrand, a, b).value;
    };
    const double mass = sum(0, 0);
    const double mean = middle + scale * (sum(1, middle) / mass);
    return {mean, sum(2, mean) / mass, sum(3, mean) / mass, scale};
}

/// For large exponents, for which raw moments would cancel: x / heavier - 1 = expm1(-+t), where t
/// has an exponential distribution up to `length`.
LineMoments PowerLaw::steep_moments(double heavier, double length) const {
    const double side = p > 0 ? -1 : 1;
    const auto expect = [&](double about, std::size_t n) {
        const auto at = [&](double t) {
            return stipple::exponential(-std::abs(p) * t) *
                   whole_power(exp_minus_1(side * t) - about, n);
        };
        constexpr double all = 45;  // beyond, the probability is 3e-20
        return gauss_kronrod(at, 0, std::min(length, all / std::abs(p))).value;
    };
    const double mass = expect(0, 0);
    const double mean = expect(0, 1) / mass;
    const double scale = unit_for(heavier / std::abs(p));
    const double ratio = heavier / scale;
    const double sign = b <= 0 || (a < 0 && -a > b) ? -1 : 1;
    return {sign * heavier * (1 + mean), ratio * ratio * (expect(mean, 2) / mass),
            sign * ratio * ratio * ratio * (expect(mean, 3) / mass), scale};
}

LineMoments PowerLaw::moments() const {
    const bool around_0 = a < 0 && b > 0;
    const double near = std::min(std::abs(a), std::abs(b));
    if (!around_0 && near > 0.5 * size && std::abs(p) * logarithm(size / near) < 1)
        return narrow_moments();
    const double heavier = around_0 || p > 0 ? size : near;  // the end with the larger |x|^p
    const double other = (p > 0 ? near : size) / heavier;
    const double length = other > 0 ? std::abs(logarithm(other)) : 1;
    if (std::abs(p) > 45 && (!around_0 || p * length > 45)) return steep_moments(heavier, length);
    const double sign = b <= 0 ? -1 : 1;
    std::array<double, 4> sums;
    for (int n = 0; n < 4; ++n)
        sums[static_cast<std::size_t>(n)] =
            around_0 ? two_sided_sum(p + n, n % 2 == 0 ? 1 : -1) : one_sided_sum(p + n, other);
    const double m = sums[1] / sums[0];
    const double mm = sums[2] / sums[0];
    const double third = sums[3] / sums[0] - 3 * m * mm + 2 * m * m * m;
    const double scale = unit_for(heavier);
    const double ratio = heavier / scale;
    return {sign * heavier * m, ratio * ratio * (mm - m * m), sign * ratio * ratio * ratio * third,
            scale};
}

/// An interval on one side of 0; powers are relative to the end with the larger |x|^p.
template <Root root>
struct OneSided final : PowerLaw {
    using PowerLaw::PowerLaw;

    /// whether to use the form for r > 1/2
    static constexpr bool narrow = root == Root::logarithm;

    double heavy = 1;        ///< magnitude of the end with the larger |x|^p
    double sign = 1;         ///< sign of x
    bool heavy_last = true;  ///< whether the heavier end is b
    double w_at_0 = 1;
    double slope = -1;
    double r = 0;
    double inverse_p = 1;
    double log_ratio = 0;  ///< log(o / e)
    double less = 0;       ///< expm1(p log(o / e)) = r - 1

    double forward(double u) const {
        const double w = w_at_0 + slope * u;  // 1 - u or u, without a branch
        const double rest = (1 - w_at_0) - slope * u;
        double x = 0;
        if constexpr (narrow)
            x = stipple::exponential(p == 0 ? w * log_ratio : log_1p(w * less) * inverse_p);
        else
            x = rooted<root>(rest + w * r, inverse_p);
        const double placed = sign * (heavy * x);
        return std::max(a, std::min(placed, b));
    }
    double inverse(double x) const override {
        const double size_here = std::abs(x) / heavy;
        const double from = narrow ? logarithm(size_here) : 0;
        const double w = p == 0 ? from / log_ratio : exp_minus_1(p * from) / less;
        const double rest = narrow ? 1 - w : (powered<root>(size_here, p) - r) / -less;
        return heavy_last ? rest : 1 - rest;
    }
};

/// An interval around 0; k is even and p odd.
template <Root root>
struct TwoSided final : PowerLaw {
    using PowerLaw::PowerLaw;

    double low = 0;   ///< (a / size)^p
    double high = 0;  ///< (b / size)^p
    double inverse_p = 1;

    double forward(double u) const {
        const double y = low + u * (high - low);  // exactly 2 xi - 1 for [-1, 1]
        const double x = size * std::copysign(rooted<root>(std::abs(y), inverse_p), y) + 0.0;
        return std::max(a, std::min(x, b));
    }
    double inverse(double x) const override {
        const double y = std::copysign(powered<root>(std::abs(x) / size, p), x);
        return (y - low) / (high - low);
    }
};

template <class Law>
std::unique_ptr<Mapping> mapping_by(const Law& law, const WarpRequest& want) {
    return line_mapping(std::vector{std::make_shared<const Law>(law)}, want.given, want.spec(),
                        "probability below x");
}

template <Root root>
std::unique_ptr<Mapping> one_sided(const Interval& interval, const WarpRequest& want) {
    OneSided<root> law(interval);
    const bool mirrored = interval.b <= 0;
    const double from = std::abs(mirrored ? interval.b : interval.a);
    const double to = std::abs(mirrored ? interval.a : interval.b);
    const bool far_heavy = interval.p > 0;
    law.heavy = far_heavy ? to : from;
    law.sign = mirrored ? -1 : 1;
    law.heavy_last = far_heavy != mirrored;
    law.w_at_0 = law.heavy_last ? 1 : 0;
    law.slope = law.heavy_last ? -1 : 1;
    law.inverse_p = interval.p == 0 ? 0 : 1 / interval.p;
    const double other = far_heavy ? from : to;
    if (other > 0) {
        law.log_ratio = logarithm(other) - logarithm(law.heavy);
        law.r = stipple::exponential(interval.p * law.log_ratio);
        law.less = exp_minus_1(interval.p * law.log_ratio);
    } else {
        law.less = -1;
    }
    law.unit = law.heavy;
    law.peak = (interval.p == 0 ? 1 / std::abs(law.log_ratio) : std::abs(interval.p / law.less)) /
               law.heavy;
    return mapping_by(law, want);
}

template <Root root>
std::unique_ptr<Mapping> two_sided(const Interval& interval, const WarpRequest& want) {
    TwoSided<root> law(interval);
    law.low = -real_power(-interval.a / interval.size, interval.p);
    law.high = real_power(interval.b / interval.size, interval.p);
    law.inverse_p = 1 / interval.p;
    law.peak = interval.p / (law.high - law.low) / interval.size;
    return mapping_by(law, want);
}

template <Root root>
std::unique_ptr<Mapping> mapping_of(const Interval& interval, const WarpRequest& want) {
    if (interval.a < 0 && interval.b > 0) return two_sided<root>(interval, want);
    const double small = std::min(std::abs(interval.a), std::abs(interval.b));
    const bool narrow =
        small > 0 && std::abs(interval.p) * logarithm(interval.size / small) < std::numbers::ln2;
    return narrow ? one_sided<Root::logarithm>(interval, want) : one_sided<root>(interval, want);
}

/// Checks that at most 1e-14 of the mass is below the smallest double, if the range ends at 0;
/// x^-0.99, for example, has a large fraction of its mass there. @throws Error(usage)
void require_numbers_near_0(double k, double size) {
    constexpr double smallest = std::numeric_limits<double>::min();
    const double depth = logarithm(smallest / size);
    const double least = logarithm(1e-14) / depth - 1;
    if (k >= least) return;
    fail_with_hint(ErrorKind::usage,
                   fmt::format("or a range that starts above 0, such as at {:.0g}", 1e-150),
                   "--exponent: with x^{} on a range that ends at 0, {:.3g} of the mass is below "
                   "{:.2g}, the smallest double; expected at least {:.4f}",
                   k, stipple::exponential((k + 1) * depth), smallest, least + 5e-5);
}

Interval interval_of(const Values& options) {
    const std::vector<double> ends = options[range];
    const double k = options[exponent];
    if (ends.size() != 2)
        fail(ErrorKind::usage, "--range: expected 2 numbers, a,b; {} given", ends.size());
    const double a = ends[0] + 0.0;
    const double b = ends[1] + 0.0;
    if (!(a < b)) fail(ErrorKind::usage, "--range: {} is not below {}", a, b);
    const double size = std::max(std::abs(a), std::abs(b));
    if (size > 1e150 || b - a < 1e-15 * size || size < 1e-150)
        fail(ErrorKind::usage,
             "--range: {},{} is outside [-1e150, 1e150], or shorter than 1e-15 times its larger "
             "end or 1e-150",
             a, b);
    const double small = std::min(std::abs(a), std::abs(b));
    if ((a > 0 || b < 0) && small < 1e-150)
        fail(ErrorKind::usage,
             "--range: {},{} has an end within 1e-150 of 0; expected 0 itself or a number farther "
             "away",
             a, b);
    if (a <= 0 && b >= 0 && k <= -1)
        fail(ErrorKind::usage,
             "--exponent: x^{} has no finite integral over [{}, {}], which contains 0; expected an "
             "exponent above -1",
             k, a, b);
    if (a < 0 && std::fmod(k, 2) != 0)
        fail(ErrorKind::usage,
             "--exponent: x^{} is not positive on [{}, {}]; expected an even exponent for negative "
             "x",
             k, a, b);
    if (a == 0 || b == 0) require_numbers_near_0(k, size);
    return {.a = a, .b = b, .p = k + 1, .size = size};
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const Interval interval = interval_of(want.options);
    if (interval.p == 1) return mapping_of<Root::none>(interval, want);
    if (interval.p == 2) return mapping_of<Root::square>(interval, want);
    if (interval.p == 3) return mapping_of<Root::cube>(interval, want);
    return mapping_of<Root::other>(interval, want);
}

}  // namespace

Warp unit() {
    return {.name = "power",
            .summary = "Density x^k on an interval, on each coordinate, by inversion",
            .source = "Inverse of the distribution function, a power or a logarithm",
            .related = {"power-law"},
            .strata = "xi is the probability below x, used directly: xi = 0 is the lower end",
            .options = Schema(exponent, range),
            .mapping = make};
}

}  // namespace stipple::warps::power
