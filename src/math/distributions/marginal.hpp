// SPDX-License-Identifier: MIT
//
// A distribution on the line, F(x) = P(X <= x), with access from both tails. Small probabilities in
// the upper tail keep their digits there, but lose them in 1 - F(x).
//
//     quantile(p, lower)     the x with F(x) = p
//     quantile(p, upper)     the x with 1 - F(x) = p
//     probability(x, lower)  F(x)
//     probability(x, upper)  1 - F(x)
//
// Shape   p in [0, 1]: 0 and 1 are the ends of the support, which may be infinite.
// Promise relative error 1e-13 of quantiles, probabilities and densities, for probabilities from
//         1e-300 on, unless a distribution states otherwise. A quantile computed as a location or
//         end plus a term has an error of 1e-13 of the larger of the two. Probabilities and
//         densities may also change as if x differed by 4 units in the last place. Relative error
//         1e-9 of mean and variance, absolute error 1e-9 of the skewness. The same bits on every
//         machine.
#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <utility>

namespace stipple {

enum class Tail { lower, upper };

/// Moments of a distribution; infinite or NaN if they do not exist.
struct MarginalMoments {
    double mean = 0;
    double variance = 0;
    double skewness = 0;
};

class Marginal;
using MarginalPtr = std::shared_ptr<const Marginal>;

/// Immutable, hence safe to share between threads.
class Marginal {
  public:
    Marginal() = default;
    Marginal(const Marginal&) = delete;
    Marginal& operator=(const Marginal&) = delete;
    virtual ~Marginal() = default;

    /// Name for messages, such as "gamma".
    [[nodiscard]] virtual std::string_view name() const = 0;

    /// For a discrete distribution, the smallest outcome x with F(x) > p, or with 1 - F(x) < p in
    /// the upper tail. For p = 1 (upper tail: 0), the largest outcome that any other p gives.
    [[nodiscard]] virtual double quantile(double p, Tail tail = Tail::lower) const = 0;
    [[nodiscard]] virtual double probability(double x, Tail tail = Tail::lower) const = 0;

    /// Density, or the probability of x for a discrete distribution.
    [[nodiscard]] virtual double density(double x) const = 0;
    [[nodiscard]] virtual MarginalMoments moments() const = 0;
    [[nodiscard]] virtual std::pair<double, double> support() const = 0;

    /// Number of outcomes of a discrete distribution; 0 for a continuous one.
    [[nodiscard]] virtual double outcomes() const { return 0; }
    [[nodiscard]] bool discrete() const { return outcomes() > 0; }

    /// Replaces each p in (0, 1) by quantile(p); results for other p are unspecified.
    virtual void quantiles(std::span<double> p) const = 0;
};

/// Moments of a continuous distribution by quadrature over p. Not finite if the tails beyond p =
/// 1e-300 contribute more than a fraction of 1e-12, as for infinite moments.
MarginalMoments moments_by_quadrature(const Marginal& law);

/// Restricts the distribution to [low, high], either of which may be infinite, and normalizes it.
/// @throws Error(usage) if its probability there is too small; `where` precedes the names of the
/// ends in messages
MarginalPtr truncated(MarginalPtr law, double low, double high, std::string_view where = {});

}  // namespace stipple
