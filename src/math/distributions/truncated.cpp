// SPDX-License-Identifier: MIT
//
// A distribution truncated to [a, b]. With m = F(b) - F(a), quantiles are computed in the tail that
// has the smaller probability, which is a sum of positive numbers:
//
//     quantile(p) = quantile of F(a) + p m in the lower tail,
//                   or of (1 - F(b)) + (1 - p) m in the upper tail.

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "math/densities/quadrature.hpp"
#include "math/distributions/marginal.hpp"
#include "math/distributions/outcomes.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"

namespace stipple {
namespace {

/// Probability of [a, b], a < b, computed without cancellation if it is small.
double mass_between(const Marginal& law, double a, double b) {
    const double below = law.probability(a, Tail::lower);
    const double above = law.probability(b, Tail::upper);
    const double with_b = law.probability(b, Tail::lower);
    const double with_a = law.probability(a, Tail::upper);
    if (with_b <= 0.5) return with_b - below;
    return with_a <= 0.5 ? with_a - above : 1 - (below + above);
}

class Truncated final : public Marginal {
  public:
    Truncated(MarginalPtr law, double low, double high)
        : law_(std::move(law)),
          low_(std::max(low, law_->support().first)),
          high_(std::min(high, law_->support().second)),
          below_(law_->probability(low_, Tail::lower)),
          above_(law_->probability(high_, Tail::upper)),
          mass_(mass_between(*law_, low_, high_)) {}

    double mass() const { return mass_; }

    std::string_view name() const override { return "truncated"; }
    double quantile(double p, Tail tail) const override {
        if (p <= 0 || p >= 1) return (p <= 0) == (tail == Tail::lower) ? low_ : high_;
        const double from_low = below_ + (tail == Tail::lower ? p : 1 - p) * mass_;
        const double from_high = above_ + (tail == Tail::lower ? 1 - p : p) * mass_;
        const double x = from_low <= from_high ? law_->quantile(from_low, Tail::lower)
                                               : law_->quantile(from_high, Tail::upper);
        return std::clamp(x, low_, high_);
    }
    double probability(double x, Tail tail) const override {
        const double inside = std::clamp(x, low_, high_);
        const double below = mass_between(*law_, low_, inside) / mass_;
        const double above = mass_between(*law_, inside, high_) / mass_;
        const double share = tail == Tail::lower ? below : above;
        const double rest = tail == Tail::lower ? above : below;
        return std::clamp(share <= rest ? share : 1 - rest, 0.0, 1.0);
    }
    double density(double x) const override {
        return x >= low_ && x <= high_ ? law_->density(x) / mass_ : 0;
    }
    MarginalMoments moments() const override { return moments_by_quadrature(*this); }
    std::pair<double, double> support() const override { return {low_, high_}; }
    void quantiles(std::span<double> p) const override {
        for (double& x : p) x = quantile(x, Tail::lower);
    }

  private:
    MarginalPtr law_;
    double low_;
    double high_;
    double below_;
    double above_;
    double mass_;
};

/// E ((x - about) / unit)^n, integrated over w in both tails, with p = exp(-w) / 2. NaN if more
/// than a fraction of 1e-12 is beyond p = 1e-300, or if the moment is infinite.
double moment_about(const Marginal& law, double about, double unit, int n) {
    double sum = 0, size = 0, beyond = 0;
    for (const Tail tail : {Tail::lower, Tail::upper}) {
        double deepest = 690;
        while (!std::isfinite(law.quantile(0.5 * exponential(-deepest), tail))) deepest -= 10;
        const auto f = [&](double w) {
            const double p = 0.5 * exponential(-w);
            return p *
                   whole_power((law.quantile(p, tail) - about) / unit, static_cast<std::size_t>(n));
        };
        const double part =
            integrate_interval(f, 0, 10).value + integrate_interval(f, 10, deepest).value;
        sum += part;
        size += std::abs(part);
        // Extrapolates the tail from the exponential decay at its end.
        const double last = std::abs(f(deepest));
        const double fall = logarithm(std::abs(f(deepest - 10)) / last) / 10;
        if (last > 0) beyond += fall > 0 ? last / fall : std::numeric_limits<double>::infinity();
    }
    return beyond <= 1e-12 * size ? sum : std::numeric_limits<double>::quiet_NaN();
}

MarginalMoments moments_in(const Marginal& law, double middle, double unit) {
    const double mean = middle + unit * moment_about(law, middle, unit, 1);
    const double variance = moment_about(law, mean, unit, 2);
    const double third = moment_about(law, mean, unit, 3);
    return {mean, unit * unit * variance, third / (variance * std::sqrt(variance))};
}

}  // namespace

MarginalMoments moments_by_quadrature(const Marginal& law) {
    const double middle = law.quantile(0.5);
    const double quartiles = law.quantile(0.25, Tail::upper) - law.quantile(0.25);
    const MarginalMoments usual = moments_in(law, middle, quartiles);
    const auto [low, high] = law.support();
    const double reach = std::max(middle - low, high - middle);  // so that powers do not overflow
    return std::isfinite(usual.skewness) || !std::isfinite(reach) ? usual
                                                                  : moments_in(law, middle, reach);
}

MarginalPtr truncated(MarginalPtr law, double low, double high, std::string_view where) {
    if (!(low < high))
        fail(ErrorKind::usage, "{}low: {} is not below {}high, {}", where, low, where, high);
    if (const auto* discrete = dynamic_cast<const DiscreteMarginal*>(law.get())) {
        MarginalPtr part = discrete->between(low, high);
        if (!part)
            fail(ErrorKind::usage,
                 "{}low: {} has no outcome with a probability above 1e-290 from {} to {}", where,
                 law->name(), low, high);
        return part;
    }
    auto part = std::make_shared<const Truncated>(law, low, high);
    const auto [from, to] = part->support();
    if (!(from < to && part->mass() > 1e-290))
        fail(ErrorKind::usage,
             "{}low: {} has the probability {:.3g} from {} to {}; expected above 1e-290", where,
             law->name(), from < to ? part->mass() : 0.0, low, high);
    const double beside =
        std::min(law->probability(from, Tail::upper), law->probability(to, Tail::lower));
    if (part->mass() < 1e-6 * beside)
        fail(ErrorKind::usage,
             "{}low: the range from {} to {} is too narrow for float64; the probability of {} in "
             "it is less than 1e-6 of that beyond it",
             where, low, high, law->name());
    return part;
}

}  // namespace stipple
