// SPDX-License-Identifier: MIT
//
// Discrete distributions: tables of outcomes, and equally likely integers of a range.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "math/densities/guide_table.hpp"
#include "math/distributions/marginal.hpp"

namespace stipple {

/// A discrete distribution, which can be truncated exactly.
class DiscreteMarginal : public Marginal {
  public:
    /// Restricts to the outcomes in [low, high]; null if there are none or they are too unlikely.
    [[nodiscard]] virtual MarginalPtr between(double low, double high) const = 0;
};

class Outcomes final : public DiscreteMarginal {
  public:
    /// Takes increasing values and weights >= 0 with any sum; `name` must outlive this object.
    Outcomes(std::string_view name, std::vector<double> values, std::vector<double> weights);

    std::string_view name() const override { return name_; }
    double quantile(double p, Tail tail) const override;
    double probability(double x, Tail tail) const override;
    double density(double x) const override;
    MarginalMoments moments() const override;
    std::pair<double, double> support() const override { return {values_.front(), values_.back()}; }
    double outcomes() const override { return static_cast<double>(values_.size()); }
    void quantiles(std::span<double> p) const override;
    MarginalPtr between(double low, double high) const override;

  private:
    std::string_view name_;
    std::vector<double> values_;
    std::vector<double> weights_;
    GuideTable ends_;            ///< F at each outcome
    std::vector<double> above_;  ///< 1 - F at each outcome
};

class Integers final : public DiscreteMarginal {
  public:
    Integers(double low, double high);

    std::string_view name() const override { return "integers"; }
    double quantile(double p, Tail tail) const override;
    double probability(double x, Tail tail) const override;
    double density(double x) const override;
    MarginalMoments moments() const override;
    std::pair<double, double> support() const override { return {low_, low_ + count_ - 1}; }
    double outcomes() const override { return count_; }
    void quantiles(std::span<double> p) const override;
    MarginalPtr between(double low, double high) const override;

  private:
    double low_;
    double count_;
};

}  // namespace stipple
