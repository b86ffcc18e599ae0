// SPDX-License-Identifier: MIT
//
// A distribution from a plain struct of formulas:
//
//     struct Gumbel {
//         static constexpr std::string_view name = "gumbel";
//         double quantile(double p, Tail tail) const;      // inline, and without a branch on p
//         double probability(double x, Tail tail) const;   // x in the support
//         double density(double x) const;                  // x in the support
//         MarginalMoments moments() const;                 // if missing: by quadrature
//         std::pair<double, double> support() const;
//     };
#pragma once

#include <memory>
#include <span>

#include "core/machine/wide.hpp"
#include "math/distributions/marginal.hpp"

namespace stipple {

// Takes the law by value, so that stores to `numbers` cannot change it and its constants stay in
// registers. All calls must be inlined, or else the loop is not vectorised.
template <class Law>
STIPPLE_WIDE [[gnu::flatten]] void lower_quantiles(const Law law, std::span<double> numbers) {
    for (double& x : numbers) x = law.quantile(x, Tail::lower);
}

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
    MarginalMoments moments() const override {
        if constexpr (requires { law_.moments(); })
            return law_.moments();
        else
            return moments_by_quadrature(*this);
    }
    std::pair<double, double> support() const override { return law_.support(); }
    void quantiles(std::span<double> p) const override { lower_quantiles(law_, p); }

  private:
    Law law_;
};

template <class Law>
MarginalPtr marginal_of(const Law& law) {
    return std::make_shared<const MarginalOf<Law>>(law);
}

}  // namespace stipple
