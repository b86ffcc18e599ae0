// SPDX-License-Identifier: MIT
//
// The mapping onto a domain that knows both ways itself: to_cube(), and
//
//     void from_cube(std::span<const double> cube, std::span<double> image) const;   // many points
#pragma once

#include <memory>
#include <utility>

#include "warps/warp.hpp"

namespace stipple::warps {

template <class Known>
class DomainMapping final : public Mapping {
  public:
    explicit DomainMapping(const std::shared_ptr<const Known>& domain)
        : Mapping(domain), known_(*domain) {}

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        known_.from_cube(cube, image);
    }

  private:
    const Known& known_;
};

/// The mapping onto the domain that is made of these.
template <class Known, class... Args>
std::unique_ptr<Mapping> domain_mapping(Args&&... args) {
    return std::make_unique<DomainMapping<Known>>(
        std::make_shared<const Known>(std::forward<Args>(args)...));
}

}  // namespace stipple::warps
