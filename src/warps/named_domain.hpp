// SPDX-License-Identifier: MIT
//
// What the domains of warps have in common: they are told their spec and their dimensions.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "core/domain.hpp"

namespace stipple::warps {

class NamedDomain : public Domain {
  public:
    NamedDomain(std::string spec, std::size_t dimension, std::size_t cube_dimension)
        : spec_(std::move(spec)), dimension_(dimension), cube_dimension_(cube_dimension) {}

    std::string spec() const final { return spec_; }
    std::size_t dimension() const final { return dimension_; }
    std::size_t cube_dimension() const final { return cube_dimension_; }

  private:
    std::string spec_;
    std::size_t dimension_;
    std::size_t cube_dimension_;
};

/// Writes coordinates of the cube that rounding may have taken out of it.
template <std::size_t d>
void put_clamped(const std::array<double, d>& from, std::span<double> cube) {
    for (std::size_t k = 0; k < d; ++k) cube[k] = std::clamp(from[k], 0.0, 1.0);
}

}  // namespace stipple::warps
