// SPDX-License-Identifier: MIT
//
// Base of the warps' domains, which stores their spec and dimensions. Also the mapping onto a
// domain that implements both directions itself, by to_cube() and
//
//     void from_cube(std::span<const double> cube, std::span<double> image) const;   // many points
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/domain.hpp"
#include "warps/warp.hpp"

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

/// Writes cube coordinates, clamped to [0, 1], which rounding may exceed.
template <std::size_t d>
void put_clamped(const std::array<double, d>& from, std::span<double> cube) {
    for (std::size_t k = 0; k < d; ++k) cube[k] = std::clamp(from[k], 0.0, 1.0);
}

template <class Known>
class DomainMapping final : public Mapping {
  public:
    explicit DomainMapping(const std::shared_ptr<const Known>& domain)
        : Mapping(domain), known_(*domain) {}

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        known_.from_cube(cube, image);
    }
    bool infinite(std::span<const double> row) const override {
        if constexpr (requires { known_.infinite(row); }) return known_.infinite(row);
        return false;
    }

  private:
    const Known& known_;
};

/// Mapping onto the domain constructed from the arguments of this function.
template <class Known, class... Args>
std::unique_ptr<Mapping> domain_mapping(Args&&... args) {
    return std::make_unique<DomainMapping<Known>>(
        std::make_shared<const Known>(std::forward<Args>(args)...));
}

}  // namespace stipple::warps
