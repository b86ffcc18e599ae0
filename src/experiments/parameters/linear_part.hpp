// SPDX-License-Identifier: MIT
//
// Parameters joined by linear constraints: uniform on the polytope that their ranges and the
// constraints bound (math/polytopes). The cube is mapped onto the polytope, and no point is
// dropped. A constraint qualifies if it is affine, and all its parameters are uniform on fixed
// ranges and in no copula:
//
//     {"range": [0, 2]}, {"range": [0, 2]}, "a + 2*b < 3 && a > b"
//
// Parameters that depend on the polytope's parameters still follow their conditional distributions.
// If other constraints drop points, the remaining points follow the distribution under all
// constraints.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "math/densities/expression.hpp"
#include "math/polytopes/polytope.hpp"

namespace stipple::parameters {

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

/// Range of a parameter with a uniform distribution; nullopt if its distribution is not uniform or
/// depends on other parameters.
using UniformRange = std::optional<std::pair<double, double>>;

/// Makes a polytope from the linear constraints and removes them from the list; nullopt if there
/// are no such constraints, or if the polytope is too large. @throws Error(usage) if no parameters
/// satisfy them
std::optional<LinearPart> take_linear_part(const std::vector<UniformRange>& ranges,
                                           std::vector<Expression>& constraints);

}  // namespace stipple::parameters
