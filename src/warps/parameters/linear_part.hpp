// SPDX-License-Identifier: MIT
//
// Parameters that linear constraints join, uniform on the polytope that these leave of their ranges
// (math/polytopes), and the map of the cube onto it, with no point dropped. A constraint belongs here if it is
// affine in parameters that are uniform on ranges of their own and that no copula joins:
//
//     {"range": [0, 2]}, {"range": [0, 2]}, "a + 2*b < 3 && a > b"
//
// What depends on such a parameter still follows its own distribution, given it; and whatever other
// constraints drop, what is left follows the distribution under all of them.
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
    /// @param coordinates those of the polytope, among all parameters
    /// @param ranges of these
    LinearPart(std::vector<std::size_t> coordinates, const Box& ranges,
               const std::vector<HalfSpace>& cuts, std::vector<Expression> constraints);

    [[nodiscard]] const std::vector<std::size_t>& coordinates() const { return coordinates_; }
    [[nodiscard]] bool holds(std::size_t k) const;
    [[nodiscard]] const Polytope& polytope() const { return polytope_; }
    /// Of the volume of the ranges.
    [[nodiscard]] double share() const { return share_; }

    /// Puts the coordinates into rows of all parameters. Rounding breaks no constraint, also where it
    /// is strict: such points move towards the middle until they break none.
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

/// A range of which a parameter is uniform; none: it is not, or depends on others.
using UniformRange = std::optional<std::pair<double, double>>;

/// Takes the constraints that belong to a polytope out of a list; nothing if there are none, or if
/// their polytope is too large. @throws Error(usage) if no parameters satisfy them
std::optional<LinearPart> take_linear_part(const std::vector<UniformRange>& ranges,
                                           std::vector<Expression>& constraints);

}  // namespace stipple::parameters
