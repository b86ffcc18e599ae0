// SPDX-License-Identifier: MIT
//
// A box with a density given by a formula, divided by its integral: the domain of expression-2d and
// rejection. Its cells are boxes; their probabilities are computed by quadrature
// (math/densities/quadrature.hpp).
#pragma once

#include <mutex>
#include <string>

#include "core/domain.hpp"
#include "math/densities/expression.hpp"
#include "warps/named_domain.hpp"

namespace stipple::warps {

class FormulaBox final : public NamedDomain {
  public:
    FormulaBox(std::string spec, Expression f, Box box);

    double measure() const override { return place_->measure(); }
    bool contains(std::span<const double> point) const override { return place_->contains(point); }
    Box bounding_box() const override { return box_; }
    double density(std::span<const double> point) const override;

    /// Relative position in the box, from 0 to 1.
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        place_->to_cube(point, cube);
    }
    bool even() const override { return false; }
    Estimate probability(const Box& cell) const override;
    std::optional<Estimate> box_mass(const Box& box) const override {
        return box_mass_by_axes(*this, box);
    }
    std::vector<std::string> cube_axes() const override { return place_->cube_axes(); }

    /// Moments by quadrature, to 1e-6 of the box's extents and 1e-5 of the standard deviations;
    /// nullopt if that accuracy is not reached, and in three dimensions.
    std::optional<Moments> moments() const override;

    /// Finds gaps on a grid of cells, and the measure of the remaining region by quadrature.
    Support support() const override;

    const Expression& formula() const { return f_; }
    const Box& box() const { return box_; }

    /// Integral of the formula over the box; computed at the first call.
    /// @throws Error(usage) if the formula is not a density in the box
    Estimate integral() const;

  private:
    Expression f_;
    Box box_;
    DomainPtr place_;  ///< uniform distribution on the box
    mutable std::once_flag once_;
    mutable Estimate integral_;
};

/// Parses --bounds for formulas: ranges for 1 to 3 coordinates. @throws Error(usage)
Box formula_bounds(const std::string& text, std::size_t most);

}  // namespace stipple::warps
