// SPDX-License-Identifier: MIT
//
// Named parameters: their distributions, their dependence, and the constraints that they satisfy.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/parameters/copula.hpp"
#include "experiments/parameters/reordering.hpp"
#include "math/densities/expression.hpp"
#include "math/distributions/marginal.hpp"
#include "math/polytopes/polytope.hpp"
#include "stipple/points.hpp"

namespace stipple::parameters {

struct Parameter {
    std::string name;
    std::string unit;
    std::vector<std::string> levels;  ///< names of the values 0, 1, ...; empty if numeric
    MarginalPtr law;                  ///< distribution; null if it depends on preceding parameters
    bool uniform = false;             ///< whether the distribution is uniform
    /// Returns the distribution, given the preceding parameters.
    std::function<MarginalPtr(std::span<const double> before)> law_given = {};
};

/// Parameters joined by linear constraints: uniform on the polytope that their ranges and the
/// constraints bound (math/polytopes). The cube is mapped onto the polytope, and no point is
/// dropped. A constraint qualifies if it is affine, and all its parameters are uniform on fixed
/// ranges and in no copula:
///
///     {"range": [0, 2]}, {"range": [0, 2]}, "a + 2*b < 3 && a > b"
///
/// Parameters that depend on the polytope's parameters still follow their conditional
/// distributions. If other constraints drop points, the remaining points follow the distribution
/// under all constraints.
class LinearPart {
  public:
    /// @param coordinates indices of the polytope's coordinates among all parameters
    /// @param ranges of these coordinates
    LinearPart(std::vector<std::size_t> coordinates, const Box& ranges,
               const std::vector<HalfSpace>& cuts, std::vector<Expression> constraints);

    [[nodiscard]] const std::vector<std::size_t>& coordinates() const { return coordinates_; }
    [[nodiscard]] bool holds(std::size_t k) const;
    [[nodiscard]] const Polytope& polytope() const { return polytope_; }
    /// Volume of the polytope as a fraction of the ranges' volume.
    [[nodiscard]] double share() const { return share_; }

    /// Writes the polytope's coordinates into rows of all parameters. Points that rounding moved
    /// onto or beyond a constraint are moved towards the middle until all constraints hold,
    /// including strict ones.
    void from_cube(std::span<const double> cube, std::span<double> rows,
                   std::size_t dimension) const;
    void to_cube(std::span<const double> row, std::span<double> cube) const;

  private:
    [[nodiscard]] bool allowed(std::span<const double> row) const;
    void move_inside(std::span<double> row) const;

    std::vector<std::size_t> coordinates_;
    Polytope polytope_;
    double share_;
    std::vector<Expression> constraints_;
};

class ParameterSpace {
  public:
    /// @param constraints formulas in all parameters; a constraint holds if its value is not 0
    /// @throws Error(usage) if no parameters satisfy the linear constraints
    ParameterSpace(std::vector<Parameter> parameters, std::optional<Copula> copula,
                   std::vector<Expression> constraints,
                   std::optional<Reordering> reordering = std::nullopt);

    [[nodiscard]] const std::vector<Parameter>& parameters() const { return parameters_; }
    /// Parameters joined by linear constraints; null if there are no linear constraints.
    [[nodiscard]] const LinearPart* linear() const { return linear_ ? &*linear_ : nullptr; }
    /// Whether from_cube() maps onto the polytope, because rejection would keep too few points.
    [[nodiscard]] bool maps_linear() const { return linear_ && linear_->share() < 0.1; }
    /// Whether from_cube() rejects some rows.
    [[nodiscard]] bool rejects() const { return !others_.empty() || (linear_ && !maps_linear()); }
    /// Whether density() is normalized: all constraints are linear, and sets are not reordered.
    [[nodiscard]] bool density_known() const { return others_.empty() && !reordering_; }
    [[nodiscard]] bool has_copula() const { return copula_.has_value(); }
    /// Reordering to apply to a whole set before from_cube(), instead of a copula; nullopt if none.
    [[nodiscard]] const std::optional<Reordering>& reordering() const { return reordering_; }
    [[nodiscard]] std::vector<std::string> names() const;
    [[nodiscard]] Levels levels() const;

    /// Whether parameter k is the quantile of cube coordinate k, unchanged by a copula.
    [[nodiscard]] bool takes_own(std::size_t k) const { return !copula_ || copula_->leaves(k); }

    /// Whether the distribution of some parameter depends on other parameters.
    [[nodiscard]] bool conditional() const { return conditional_; }
    /// Whether some parameter is discrete.
    [[nodiscard]] bool discrete() const { return discrete_; }

    /// Maps a row of the unit cube to parameters. Returns false if the parameters violate a
    /// constraint.
    [[nodiscard]] bool from_cube(std::span<const double> cube, std::span<double> row) const;

    /// Maps each parameter back by its own distribution, ignoring constraints. Discrete values map
    /// to the middle of their intervals.
    void to_cube(std::span<const double> row, std::span<double> cube) const;

    /// Whether every parameter has a possible value and all constraints hold.
    [[nodiscard]] bool contains(std::span<const double> row) const;

    /// Density without nonlinear constraints and without a reordering; for discrete parameters it
    /// is a probability.
    [[nodiscard]] double density(std::span<const double> row) const;

  private:
    [[nodiscard]] bool in_linear(std::size_t k) const { return linear_ && linear_->holds(k); }
    /// Distribution of parameter k. @param held owns the distribution if it was made for this row
    [[nodiscard]] const Marginal& law(std::size_t k, std::span<const double> row,
                                      MarginalPtr& held) const;
    [[nodiscard]] std::vector<Share> shares(std::span<const double> row) const;

    std::vector<Parameter> parameters_;
    std::optional<Copula> copula_;
    std::vector<Expression> constraints_;
    std::optional<Reordering> reordering_;
    std::vector<Expression> others_;  ///< nonlinear constraints
    std::optional<LinearPart> linear_;
    bool discrete_ = false;
    bool conditional_ = false;
};

}  // namespace stipple::parameters
