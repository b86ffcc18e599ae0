// SPDX-License-Identifier: MIT
//
// Named parameters: what each of them follows, how they depend on each other, and what holds of all
// of them together.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "math/densities/expression.hpp"
#include "math/distributions/marginal.hpp"
#include "stipple/points.hpp"
#include "warps/parameters/copula.hpp"
#include "warps/parameters/linear_part.hpp"
#include "warps/parameters/reordering.hpp"

namespace stipple::parameters {

struct Parameter {
    std::string name;
    std::string unit;
    std::vector<std::string> levels;  ///< words that its numbers 0, 1, ... stand for; none: numbers
    MarginalPtr law;                  ///< none: it depends on the parameters before
    bool uniform = false;             ///< its law is
    /// Makes it, given the parameters before.
    std::function<MarginalPtr(std::span<const double> before)> law_given = {};
};

class ParameterSpace {
  public:
    /// @param constraints formulas in all parameters, which hold where they are not 0
    /// @throws Error(usage) if no parameters satisfy those that are linear
    ParameterSpace(std::vector<Parameter> parameters, std::optional<Copula> copula,
                   std::vector<Expression> constraints,
                   std::optional<Reordering> reordering = std::nullopt);

    [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
    /// What linear constraints join; null: nothing.
    [[nodiscard]] const LinearPart* linear() const { return linear_ ? &*linear_ : nullptr; }
    /// Whether from_cube() maps onto that, since rejection would leave little.
    [[nodiscard]] bool maps_linear() const { return linear_ && linear_->share() < 0.1; }
    /// Whether rows of the cube may have no parameters.
    [[nodiscard]] bool rejects() const { return !others_.empty() || (linear_ && !maps_linear()); }
    /// Whether all constraints are linear, and no set is reordered.
    [[nodiscard]] bool density_known() const { return others_.empty() && !reordering_; }
    [[nodiscard]] bool has_copula() const { return copula_.has_value(); }
    /// Of a set, in place of a copula, before from_cube().
    [[nodiscard]] const std::optional<Reordering>& reordering() const { return reordering_; }
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] Levels levels() const;

    /// Whether no copula changes the coordinate of the cube that a parameter is the quantile of.
    [[nodiscard]] bool takes_own(std::size_t k) const { return !copula_ || copula_->leaves(k); }

    /// Whether the law of some parameter depends on others.
    [[nodiscard]] bool conditional() const { return conditional_; }
    /// Whether some parameter is discrete.
    [[nodiscard]] bool discrete() const { return discrete_; }

    /// The parameters that a row of the unit cube gives. False: they break a constraint.
    [[nodiscard]] bool from_cube(std::span<const double> cube, std::span<double> row) const;

    /// The way back of each from its own law, before constraints; of a number that stands for an
    /// interval of the cube, to its middle.
    void to_cube(std::span<const double> row, std::span<double> cube) const;

    /// Whether each is a number that it may be, and all constraints hold.
    [[nodiscard]] bool contains(std::span<const double> row) const;

    /// Of the parameters before constraints that are not linear, without a reordering; of those that
    /// are discrete, their probability.
    [[nodiscard]] double density(std::span<const double> row) const;

  private:
    [[nodiscard]] bool in_linear(std::size_t k) const { return linear_ && linear_->holds(k); }
    /// @param held keeps a law that was made for this row
    [[nodiscard]] const Marginal& law(std::size_t k, std::span<const double> row,
                                      MarginalPtr& held) const;
    [[nodiscard]] std::vector<Share> shares(std::span<const double> row) const;

    std::vector<Parameter> parameters_;
    std::optional<Copula> copula_;
    std::vector<Expression> constraints_;
    std::optional<Reordering> reordering_;
    std::vector<Expression> others_;  ///< constraints that are not linear
    std::optional<LinearPart> linear_;
    bool discrete_ = false;
    bool conditional_ = false;
};

}  // namespace stipple::parameters
