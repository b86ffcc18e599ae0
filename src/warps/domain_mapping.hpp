// SPDX-License-Identifier: MIT
//
// The mapping onto a domain that knows both ways itself: to_cube(), and
//
//     void from_cube(std::span<const double> cube, std::span<double> image) const;   // many points
#pragma once

#include <memory>
#include <utility>

#include "warps/inside.hpp"
#include "warps/warp.hpp"

namespace stipple::warps {

template <class Known>
class DomainMapping final : public Mapping {
  public:
    explicit DomainMapping(std::shared_ptr<const Known> domain) : domain_(std::move(domain)) {}

    DomainPtr domain() const override { return domain_; }
    std::size_t cube_dimension() const override { return domain_->cube_dimension(); }
    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        domain_->from_cube(cube, image);
    }
    void inverse(std::span<const double> image, std::span<double> cube) const override {
        const std::size_t d = domain_->cube_dimension();
        const std::size_t m = domain_->dimension();
        expect_inside(*domain_, image);
        for (std::size_t i = 0; i < image.size() / m; ++i)
            domain_->to_cube(image.subspan(m * i, m), cube.subspan(d * i, d));
    }

  private:
    std::shared_ptr<const Known> domain_;
};

}  // namespace stipple::warps
