// SPDX-License-Identifier: MIT
//
// Named parameters: their distributions, their dependence, and the constraints that they satisfy.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/parameters/copula.hpp"
#include "experiments/parameters/reordering.hpp"
#include "math/densities/expression.hpp"
#include "math/distributions/marginal.hpp"
#include "math/polytopes/polytope.hpp"
#include "stipple/points.hpp"
#include "stipple/run.hpp"

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
/// constraints bound (math/polytopes). A constraint qualifies if it is affine, and all its
/// parameters are uniform on fixed ranges and in no copula:
///
///     {"range": [0, 2]}, {"range": [0, 2]}, "a + 2*b < 3 && a > b"
///
/// Parameters that depend on these still follow their conditional distributions.
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
    /// onto or beyond a constraint are moved towards the middle until all constraints hold.
    void from_cube(std::span<const double> cube, std::span<double> rows,
                   std::size_t dimension) const;
    void to_cube(std::span<const double> row, std::span<double> cube) const;

  private:
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
    /// Null if there are no linear constraints.
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
    /// Whether parameter k is a quantile at cube coordinate k itself, unchanged by a copula.
    [[nodiscard]] bool takes_own(std::size_t k) const { return !copula_ || copula_->leaves(k); }
    /// Whether the distribution of some parameter depends on other parameters.
    [[nodiscard]] bool conditional() const { return conditional_; }
    [[nodiscard]] bool discrete() const { return discrete_; }
    /// Maps a row of the unit cube to parameters; false if they violate a constraint.
    [[nodiscard]] bool from_cube(std::span<const double> cube, std::span<double> row) const;
    /// Maps each parameter back by its own distribution, ignoring constraints; discrete values to
    /// the middle of their intervals.
    void to_cube(std::span<const double> row, std::span<double> cube) const;
    /// Whether every parameter has a possible value and all constraints hold.
    [[nodiscard]] bool contains(std::span<const double> row) const;
    /// Density that ignores nonlinear constraints and reordering; a probability if discrete.
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

// Functions of parameter_file.cpp, for JSON as documented in data/parameters.schema.json.

/// Parses a parameter file's text; texts that refer to other files are rejected.
/// @param source name of the text in messages
/// @throws Error(input) "SOURCE: $.parameters[2].range: error; what is expected"
ParameterSpace parse_parameters(std::string_view json, const std::string& source);

/// Text of a parameter file, with the numbers of columns of other files. @throws Error(input),
/// Error(io)
std::string text_with_columns(const std::string& path, const RunContext& run);

/// The text of a parameter file on one line, for specs and provenance. @throws Error(input)
std::string one_line(std::string_view json, const std::string& source);

}  // namespace stipple::parameters
