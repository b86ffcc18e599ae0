// SPDX-License-Identifier: MIT
//
// Gamma, beta and Student's t distributions, by incomplete gamma and beta functions. The tail of
// Student's t is
//
//     P(T > t) = I_z(nu / 2, 1 / 2) / 2,    z = nu / (nu + t^2),
//
// so that t = sqrt(nu (1 - z) / z). For small z, I_z(a, b) = z^a / (a B(a, b)) with a relative
// error of z, and P(T > t) = (t / sqrt(nu))^-nu / (nu B(nu / 2, 1 / 2)).

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/distributions/laws.hpp"
#include "math/distributions/marginal_of.hpp"
#include "math/functions/incomplete_functions.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

struct Gamma {
    static constexpr std::string_view name = "gamma";
    double shape;
    double scale;

    double quantile(double p, Tail tail) const {
        return scale *
               (tail == Tail::lower ? gamma_quantile(shape, p) : gamma_upper_quantile(shape, p));
    }
    double probability(double x, Tail tail) const {
        return tail == Tail::lower ? gamma_below(shape, x / scale) : gamma_above(shape, x / scale);
    }
    double density(double x) const { return gamma_density(shape, x / scale) / scale; }
    MarginalMoments moments() const {
        return {shape * scale, shape * scale * scale, 2 / std::sqrt(shape)};
    }
    std::pair<double, double> support() const { return {0, endless}; }
};

struct Beta {
    static constexpr std::string_view name = "beta";
    double a;
    double b;
    double low;
    double high;

    double quantile(double p, Tail tail) const {
        const Shares at = tail == Tail::lower ? beta_quantile(a, b, p) : beta_quantile(b, a, p);
        const double from_low = tail == Tail::lower ? at.x : at.rest;
        const double from_high = tail == Tail::lower ? at.rest : at.x;
        return from_low < 0.5 ? low + from_low * (high - low) : high - from_high * (high - low);
    }
    /// Measured from the nearer end, whose distance has no rounding error.
    double probability(double x, Tail tail) const {
        const double y = (x - low) / (high - low);
        const double rest = (high - x) / (high - low);
        if (tail == Tail::lower) return y < 0.5 ? beta_below(a, b, y) : beta_above(b, a, rest);
        return y < 0.5 ? beta_above(a, b, y) : beta_below(b, a, rest);
    }
    double density(double x) const {
        const double y = (x - low) / (high - low);
        const double rest = (high - x) / (high - low);
        return (y < 0.5 ? beta_density(a, b, y) : beta_density(b, a, rest)) / (high - low);
    }
    MarginalMoments moments() const {
        const double sum = a + b;
        const double width = high - low;
        return {low + width * a / sum, width * width * a / sum * b / sum / (sum + 1),
                2 * (b - a) * std::sqrt(sum + 1) / ((sum + 2) * std::sqrt(a) * std::sqrt(b))};
    }
    std::pair<double, double> support() const { return {low, high}; }
};

struct StudentT {
    static constexpr std::string_view name = "student-t";
    double degrees;
    double location;
    double scale;
    double ratio = gamma_ratio(0.5 * degrees, 0.5);                ///< sqrt(pi) / B(nu / 2, 1 / 2)
    double peak = ratio / std::sqrt(degrees * std::numbers::pi);   ///< density at 0
    double slope = degrees * std::sqrt(std::numbers::pi) / ratio;  ///< nu B(nu / 2, 1 / 2)
    double far_out = 1e15 * std::sqrt(degrees);                    ///< t^2 + nu = t^2 beyond

    double quantile(double p, Tail tail) const {
        if (p == 0.5) return location;
        const bool far = p < 0.5;
        const double t = standard_tail(far ? p : 1 - p);
        return far == (tail == Tail::lower) ? location - scale * t : location + scale * t;
    }
    double probability(double x, Tail tail) const {
        const double t = (x - location) / scale;
        const double beyond = tail_beyond(std::abs(t));
        return (t < 0) == (tail == Tail::lower) ? beyond : 1 - beyond;
    }
    double density(double x) const {
        const double t = std::abs(x - location) / scale;
        const double power =
            t > far_out ? real_power(t / std::sqrt(degrees), -degrees - 1)
                        : stipple::exponential(-0.5 * (degrees + 1) * log_1p(t * t / degrees));
        return peak / scale * power;
    }
    MarginalMoments moments() const {
        const double none = std::numeric_limits<double>::quiet_NaN();
        return {degrees > 1 ? location : none,
                degrees > 2 ? scale * scale * degrees / (degrees - 2) : endless,
                degrees > 3 ? 0 : none};
    }
    std::pair<double, double> support() const { return {-endless, endless}; }

  private:
    /// The t > 0 with P(T > t) = p, for p < 1/2.
    double standard_tail(double p) const {
        const auto [z, rest] = beta_quantile(0.5 * degrees, 0.5, 2 * p);
        if (z > 1e-30) return std::sqrt(degrees * rest / z);
        return std::sqrt(degrees) * real_power(p * slope, -1 / degrees);
    }
    double tail_beyond(double t) const {
        if (t > far_out) return real_power(t / std::sqrt(degrees), -degrees) / slope;
        const double square = t * t / degrees;
        return square < 1 ? 0.5 * beta_above(0.5, 0.5 * degrees, square / (1 + square))
                          : 0.5 * beta_below(0.5 * degrees, 0.5, 1 / (1 + square));
    }
};

}  // namespace

MarginalPtr gamma_law(double shape, double scale) { return marginal_of(Gamma{shape, scale}); }
MarginalPtr beta_law(double a, double b, double low, double high) {
    return marginal_of(Beta{a, b, low, high});
}
MarginalPtr student_t_law(double degrees, double location, double scale) {
    return marginal_of(StudentT{.degrees = degrees, .location = location, .scale = scale});
}

}  // namespace stipple
