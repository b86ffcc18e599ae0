// SPDX-License-Identifier: MIT
//
// Continuous distributions by formulas. With E(p) = -log(1 - p), the quantile of the standard
// exponential distribution, and Phi^-1 that of the normal:
//
//     uniform      low + p (high - low)            log-uniform  low (high / low)^p
//     exponential  E(p) / rate                     weibull      scale E(p)^(1 / shape)
//     gumbel       location - scale log(-log p)    lognormal    exp(mu + sigma Phi^-1(p))
//     triangular   low + sqrt(p (high - low) (mode - low)), and its mirror image above the mode
//
// Gamma, beta and Student's t distributions use incomplete gamma and beta functions. The tail of
// Student's t is
//
//     P(T > t) = I_z(nu / 2, 1 / 2) / 2,    z = nu / (nu + t^2),
//
// so that t = sqrt(nu (1 - z) / z). For small z, I_z(a, b) = z^a / (a B(a, b)) with a relative
// error of z, and P(T > t) = (t / sqrt(nu))^-nu / (nu B(nu / 2, 1 / 2)).
//
// Beware  exp(y) has a relative error of |y| / 2^53, at most 8e-14.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <span>

#include "core/machine/wide.hpp"
#include "math/distributions/laws.hpp"
#include "math/functions/distributions.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/incomplete_functions.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/normal_distribution.hpp"

namespace stipple {
namespace {

// Takes the law by value, so that stores to `numbers` cannot change it and its constants stay in
// registers. Unless all calls are inlined, the loop is not vectorised.
template <class Law>
STIPPLE_WIDE [[gnu::flatten]] void lower_quantiles(const Law law, std::span<double> numbers) {
    for (double& x : numbers) x = law.quantile(x, Tail::lower);
}

/// A distribution from a plain struct of formulas:
///
///     struct Gumbel {
///         static constexpr std::string_view name = "gumbel";
///         double quantile(double p, Tail tail) const;     // inline, and without a branch on p
///         double probability(double x, Tail tail) const;  // x in the support
///         double density(double x) const;                 // x in the support
///         MarginalMoments moments() const;
///         std::pair<double, double> support() const;
///     };
template <class Law>
class MarginalOf final : public Marginal {
  public:
    explicit MarginalOf(const Law& law) : law_(law) {}

    std::string_view name() const override { return Law::name; }
    double quantile(double p, Tail tail) const override {
        const auto [low, high] = law_.support();
        if (p <= 0 || p >= 1) return (p <= 0) == (tail == Tail::lower) ? low : high;
        return law_.quantile(p, tail);
    }
    double probability(double x, Tail tail) const override {
        const auto [low, high] = law_.support();
        if (x <= low || x >= high) return (x <= low) == (tail == Tail::lower) ? 0 : 1;
        return law_.probability(x, tail);
    }
    double density(double x) const override {
        const auto [low, high] = law_.support();
        return x >= low && x <= high ? law_.density(x) : 0;
    }
    MarginalMoments moments() const override { return law_.moments(); }
    std::pair<double, double> support() const override { return law_.support(); }
    void quantiles(std::span<double> p) const override { lower_quantiles(law_, p); }

  private:
    Law law_;
};

template <class Law>
MarginalPtr marginal_of(const Law& law) {
    return std::make_shared<const MarginalOf<Law>>(law);
}

constexpr double infinite = std::numeric_limits<double>::infinity();

struct Uniform {
    static constexpr std::string_view name = "uniform";
    double low;
    double high;

    double quantile(double p, Tail tail) const {
        const double from_low = tail == Tail::lower ? p : 1 - p;
        const double from_high = tail == Tail::lower ? 1 - p : p;
        return from_low < 0.5 ? low + from_low * (high - low) : high - from_high * (high - low);
    }
    double probability(double x, Tail tail) const {
        return (tail == Tail::lower ? x - low : high - x) / (high - low);
    }
    double density(double /*x*/) const { return 1 / (high - low); }
    MarginalMoments moments() const {
        return {low + 0.5 * (high - low), (high - low) * (high - low) / 12, 0};
    }
    std::pair<double, double> support() const { return {low, high}; }
};

struct LogUniform {
    static constexpr std::string_view name = "log-uniform";
    double low;
    double high;
    double log_ratio = log_1p((high - low) / low);

    double quantile(double p, Tail tail) const {
        return tail == Tail::lower ? low * stipple::exponential(p * log_ratio)
                                   : high * stipple::exponential(-p * log_ratio);
    }
    double probability(double x, Tail tail) const {
        return (tail == Tail::lower ? log_1p((x - low) / low) : log_1p((high - x) / x)) / log_ratio;
    }
    double density(double x) const { return 1 / (x * log_ratio); }
    MarginalMoments moments() const { return log_ratio < 4 ? narrow_moments() : wide_moments(); }
    std::pair<double, double> support() const { return {low, high}; }

  private:
    /// Moments from E (x / high)^n = (1 - (low / high)^n) / (n log_ratio).
    MarginalMoments wide_moments() const {
        const auto raw = [&](double n) { return -exp_minus_1(-n * log_ratio) / (n * log_ratio); };
        const double m = raw(1);
        const double variance = raw(2) - m * m;
        const double third = raw(3) - 3 * m * raw(2) + 2 * m * m * m;
        return {high * m, high * high * variance, third / (variance * std::sqrt(variance))};
    }

    /// Central moments as series of positive terms, with h = log_ratio / 2 and g^2 = low high:
    ///
    ///     mean / g = sinh(h) / h,    variance / g^2 = sum_k 2 k (2 h)^(2 k) / (2 k + 2)!,
    ///     third / g^3 = sum_k (9^k (2 k + 2) (2 k + 3) - 3/4 (9^(k+1) - 1) (2 k + 3)
    ///                          + 3/2 (9^(k+1) - 1)) h^(2 k) / (2 k + 3)!
    MarginalMoments narrow_moments() const {
        const double h = 0.5 * log_ratio;
        double mean = 0, variance = 0, third = 0;
        double power = 1;  // h^(2 k) / (2 k + 1)!
        double four = 1, nine = 1;
        for (double k = 0; k < 30; ++k) {
            const double below = 2 * k + 2;
            mean += power;
            variance += four * power * (2 * k / below);
            third += power * (nine - 0.75 * (9 * nine - 1) * (2 * k + 1) / (below * (below + 1)));
            power *= h * h / (below * (below + 1));
            four *= 4;
            nine *= 9;
        }
        const double middle = std::sqrt(low) * std::sqrt(high);
        return {middle * mean, middle * middle * variance,
                third / (variance * std::sqrt(variance))};
    }
};

struct Triangular {
    static constexpr std::string_view name = "triangular";
    double low;
    double mode;
    double high;
    double below = (mode - low) / (high - low);   ///< probability below the mode
    double above = (high - mode) / (high - low);  ///< probability above the mode

    /// Quantile, computed from the nearer end, using sums of positive numbers only.
    double quantile(double p, Tail tail) const {
        const double from_low = tail == Tail::lower ? p : 1 - p;
        const double from_high = tail == Tail::lower ? 1 - p : p;
        const bool left = below < 0.5 ? from_low < below : from_high > above;
        const double rise = std::sqrt(left ? from_low * below : from_high * above);
        const double rest =
            (left ? from_high + above * from_low : from_low + below * from_high) / (1 + rise);
        const double share = left ? rise : rest;  // (quantile - low) / width
        const double width = high - low;
        return share < 0.5 ? low + share * width : high - (left ? rest : rise) * width;
    }
    double probability(double x, Tail tail) const {
        const double y = (x - low) / (high - low);
        const double rest = (high - x) / (high - low);
        const bool left = x < mode;
        const double share = left ? y * (y / below) : rest * (rest / above);
        if (left == (tail == Tail::lower)) return share;
        if (share < 0.5 || (left ? below : above) < 0.5) return 1 - share;
        return left ? ((rest - above) + rest * y) / below : ((y - below) + y * rest) / above;
    }
    double density(double x) const {
        const double rise = x < mode ? (x - low) / (mode - low) : (high - x) / (high - mode);
        return 2 * (x == mode ? 1 : rise) / (high - low);
    }
    MarginalMoments moments() const {
        const double q = high - low;
        const double p = (mode - low) / q;
        const double square = 1 - p + p * p;
        const double skewness = std::numbers::sqrt2 * (1 - 2 * p) * (1 + p) * (2 - p) /
                                (5 * square * std::sqrt(square));
        return {low + q * (1 + p) / 3, q * q * square / 18, skewness};
    }
    std::pair<double, double> support() const { return {low, high}; }
};

/// Standard normal quantile: the x whose probability in the given tail is p.
double standard_quantile(double p, Tail tail) {
    const double z = normal_quantile(p);
    return tail == Tail::lower ? z : -z;
}
double standard_probability(double z, Tail tail) {
    return normal_distribution(tail == Tail::lower ? z : -z);
}
double standard_density(double z) {
    return stipple::exponential(-0.5 * z * z) *
           (0.5 * std::numbers::inv_sqrtpi * std::numbers::sqrt2);
}

struct Normal {
    static constexpr std::string_view name = "normal";
    double mean;
    double deviation;

    double quantile(double p, Tail tail) const {
        return mean + deviation * standard_quantile(p, tail);
    }
    double probability(double x, Tail tail) const {
        return standard_probability((x - mean) / deviation, tail);
    }
    double density(double x) const { return standard_density((x - mean) / deviation) / deviation; }
    MarginalMoments moments() const { return {mean, deviation * deviation, 0}; }
    std::pair<double, double> support() const { return {-infinite, infinite}; }
};

double bounded_exponential(double x) { return x <= 709 ? stipple::exponential(x) : infinite; }

struct Lognormal {
    static constexpr std::string_view name = "lognormal";
    double mu;
    double sigma;

    double quantile(double p, Tail tail) const {
        return stipple::exponential(mu + sigma * standard_quantile(p, tail));
    }
    double probability(double x, Tail tail) const { return standard_probability(place(x), tail); }
    double density(double x) const { return x > 0 ? standard_density(place(x)) / (sigma * x) : 0; }
    MarginalMoments moments() const {
        const double square = sigma * sigma;
        const double more = square <= 709 ? exp_minus_1(square) : infinite;
        return {bounded_exponential(mu + 0.5 * square), more * bounded_exponential(2 * mu + square),
                (more + 3) * std::sqrt(more)};
    }
    std::pair<double, double> support() const { return {0, infinite}; }

  private:
    double place(double x) const { return (logarithm(x) - mu) / sigma; }
};

/// Standard exponential quantile: E(p), or E(1 - p) for the upper tail.
double standard_decay(double p, Tail tail) {
    return tail == Tail::lower ? 0.0 - log_1p(-p) : 0.0 - logarithm(p);
}
double decayed(double x, Tail tail) {
    return tail == Tail::lower ? 0.0 - exp_minus_1(-x) : stipple::exponential(-x);
}

struct Exponential {
    static constexpr std::string_view name = "exponential";
    double rate;

    double quantile(double p, Tail tail) const { return standard_decay(p, tail) / rate; }
    double probability(double x, Tail tail) const { return decayed(rate * x, tail); }
    double density(double x) const { return rate * stipple::exponential(-rate * x); }
    MarginalMoments moments() const { return {1 / rate, 1 / (rate * rate), 2}; }
    std::pair<double, double> support() const { return {0, infinite}; }
};

struct Weibull {
    static constexpr std::string_view name = "weibull";
    double shape;
    double scale;

    double quantile(double p, Tail tail) const {
        return scale * real_power(standard_decay(p, tail), 1 / shape);
    }
    double probability(double x, Tail tail) const {
        return decayed(real_power(x / scale, shape), tail);
    }
    double density(double x) const {
        const double y = x / scale;
        const double decay = stipple::exponential(-real_power(y, shape));
        return decay > 0 ? shape / scale * real_power(y, shape - 1) * decay : 0;
    }
    MarginalMoments moments() const {
        if (shape > 10) return narrow_moments();
        const double m = raw(1);
        const double variance = raw(2) - m * m;
        const double third = raw(3) - 3 * m * raw(2) + 2 * m * m * m;
        return {scale * m, scale * scale * variance, third / (variance * std::sqrt(variance))};
    }
    std::pair<double, double> support() const { return {0, infinite}; }

  private:
    /// Moments by quadrature, for large shapes, where differences of raw moments would cancel.
    MarginalMoments narrow_moments() const {
        const auto [mean, variance, skewness] = moments_by_quadrature(*weibull_law(shape, 1));
        return {scale * mean, scale * scale * variance, skewness};
    }
    /// Raw moment E (x / scale)^n.
    double raw(double n) const { return stipple::exponential(log_gamma(1 + n / shape)); }
};

struct Gumbel {
    static constexpr std::string_view name = "gumbel";
    double location;
    double scale;

    double quantile(double p, Tail tail) const {
        const double small = tail == Tail::lower ? 1 - p : p;  // 1 - p is exact if it is small
        const double near = 0.0 - log_1p(-small);
        const double far = 0.0 - logarithm(p);
        const double decay = tail == Tail::lower && p < 0.5 ? far : near;
        return location - scale * logarithm(decay);
    }
    double probability(double x, Tail tail) const {
        const double decay = power(x);
        return decayed(decay, tail == Tail::lower ? Tail::upper : Tail::lower);
    }
    double density(double x) const {
        const double decay = power(x);
        return decay * stipple::exponential(-decay) / scale;
    }
    MarginalMoments moments() const {
        return {location + scale * std::numbers::egamma,
                scale * scale * std::numbers::pi * std::numbers::pi / 6, 1.1395470994046486};
    }
    std::pair<double, double> support() const { return {-infinite, infinite}; }

  private:
    double power(double x) const {
        return stipple::exponential(std::min((location - x) / scale, 709.0));
    }
};

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
    std::pair<double, double> support() const { return {0, infinite}; }
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
    /// Probability, computed from the nearer end, so that no digits are lost close to it.
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
    double far_out = 1e15 * std::sqrt(degrees);  ///< beyond this, t^2 + nu rounds to t^2

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
                degrees > 2 ? scale * scale * degrees / (degrees - 2) : infinite,
                degrees > 3 ? 0 : none};
    }
    std::pair<double, double> support() const { return {-infinite, infinite}; }

  private:
    /// The t > 0 with P(T > t) = p, for p < 1/2.
    double standard_tail(double p) const {
        const auto [z, rest] = beta_quantile(0.5 * degrees, 0.5, 2 * p);
        if (z > 1e-30) return std::sqrt(degrees * rest / z);
        return std::sqrt(degrees) * real_power(p * slope, -1 / degrees);
    }
    double tail_beyond(double t) const {
        if (t > far_out) return real_power(t / std::sqrt(degrees), -degrees) / slope;
        return student_above(t, degrees);
    }
};

}  // namespace

MarginalPtr uniform_law(double low, double high) { return marginal_of(Uniform{low, high}); }
MarginalPtr log_uniform_law(double low, double high) {
    return marginal_of(LogUniform{.low = low, .high = high});
}
MarginalPtr triangular_law(double low, double mode, double high) {
    return marginal_of(Triangular{.low = low, .mode = mode, .high = high});
}
MarginalPtr normal_law(double mean, double deviation) {
    return marginal_of(Normal{mean, deviation});
}
MarginalPtr lognormal_law(double mu, double sigma) { return marginal_of(Lognormal{mu, sigma}); }
MarginalPtr exponential_law(double rate) { return marginal_of(Exponential{rate}); }
MarginalPtr weibull_law(double shape, double scale) { return marginal_of(Weibull{shape, scale}); }
MarginalPtr gumbel_law(double location, double scale) {
    return marginal_of(Gumbel{location, scale});
}
MarginalPtr gamma_law(double shape, double scale) { return marginal_of(Gamma{shape, scale}); }
MarginalPtr beta_law(double a, double b, double low, double high) {
    return marginal_of(Beta{a, b, low, high});
}
MarginalPtr student_t_law(double degrees, double location, double scale) {
    return marginal_of(StudentT{.degrees = degrees, .location = location, .scale = scale});
}

}  // namespace stipple
