// SPDX-License-Identifier: MIT
//
// A distribution on the line, F(x) = P(X <= x), seen from either tail: what is far out in the upper
// tail has a probability near 0 there, and is lost in the last digits of 1 - F:
//
//     quantile(p, lower)     the x with F(x) = p
//     quantile(p, upper)     the x with 1 - F(x) = p
//     probability(x, lower)  F(x)
//     probability(x, upper)  1 - F(x)
//
// Shape   p in [0, 1]: 0 and 1 are the ends of the support, which may be infinite.
// Promise quantiles, probabilities and densities within 1e-13 of themselves, for probabilities from
//         1e-300 on, where a distribution does not say otherwise; a quantile that is a difference
//         from a location or an end, within 1e-13 of the larger of both; a probability or density,
//         as near as a change of x by 4 units in the last place leaves it. Moments within 1e-9 of
//         themselves, skewness within 1e-9. The same bits on every machine.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace stipple {

enum class Tail { lower, upper };

/// Infinite or NaN where the distribution has none.
struct MarginalMoments {
    double mean = 0;
    double variance = 0;
    double skewness = 0;
};

class Marginal;
using MarginalPtr = std::shared_ptr<const Marginal>;

/// Immutable; safe to use from several threads.
class Marginal {
  public:
    Marginal() = default;
    Marginal(const Marginal&) = delete;
    Marginal& operator=(const Marginal&) = delete;
    virtual ~Marginal() = default;

    /// "gamma": for messages.
    [[nodiscard]] virtual std::string_view name() const = 0;

    /// Of a discrete distribution: the smallest outcome x with F(x) > p, or with 1 - F(x) < p; for
    /// F(x) = 1, the largest outcome that any p below 1 gives.
    [[nodiscard]] virtual double quantile(double p, Tail tail = Tail::lower) const = 0;
    [[nodiscard]] virtual double probability(double x, Tail tail = Tail::lower) const = 0;

    /// Of a discrete distribution: the probability of x.
    [[nodiscard]] virtual double density(double x) const = 0;
    [[nodiscard]] virtual MarginalMoments moments() const = 0;
    [[nodiscard]] virtual std::pair<double, double> support() const = 0;

    /// How many outcomes a discrete distribution has; 0: it is continuous.
    [[nodiscard]] virtual double outcomes() const { return 0; }
    [[nodiscard]] bool discrete() const { return outcomes() > 0; }

    /// quantile(p) of many p in (0, 1), in place; other p give any number.
    virtual void quantiles(std::span<double> p) const = 0;
};

/// By quadrature over p, for continuous distributions; not finite where more than a share of 1e-12
/// lies beyond p = 1e-300, as of all that are infinite.
MarginalMoments moments_by_quadrature(const Marginal& law);

/// The distribution between two ends, either of which may be infinite, divided by its probability
/// there. @throws Error(usage) if that is too small to be divided by; `where` stands in front of
/// the names of the ends in messages
MarginalPtr truncated(MarginalPtr law, double low, double high, std::string_view where = {});

}  // namespace stipple
