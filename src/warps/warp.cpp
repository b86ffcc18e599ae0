// SPDX-License-Identifier: MIT
#include "warps/warp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

class Oriented final : public Mapping {
  public:
    Oriented(std::unique_ptr<Mapping> mapping, std::span<const double> order)
        : Mapping(mapping->domain()), mapping_(std::move(mapping)) {
        for (const double k : order) places_.push_back({std::size_t(std::abs(k)) - 1, k < 0});
    }

    std::size_t cube_dimension() const override { return places_.size(); }
    bool drops() const override { return mapping_->drops(); }
    bool biased() const override { return mapping_->biased(); }

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> keep) const override {
        mapping_->forward(turned(cube), image, keep);
    }

    bool infinite(std::span<const double> row) const override {
        return mapping_->infinite(turned(row));
    }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        std::vector<double> rows(cube.size());
        mapping_->inverse(image, rows);
        for (std::size_t i = 0; i < rows.size(); i += places_.size())
            for (std::size_t k = 0; k < places_.size(); ++k)
                cube[i + places_[k].from] = places_[k].reflected ? 1 - rows[i + k] : rows[i + k];
    }

    double density(std::span<const double> point) const override {
        return mapping_->density(point);
    }

  private:
    struct Place {
        std::size_t from;
        bool reflected;
    };

    [[nodiscard]] std::vector<double> turned(std::span<const double> cube) const {
        std::vector<double> rows(cube.size());
        for (std::size_t i = 0; i < rows.size(); i += places_.size())
            for (std::size_t k = 0; k < places_.size(); ++k) {
                const double x = cube[i + places_[k].from];
                rows[i + k] = places_[k].reflected ? std::min(1 - x, one_minus_ulp) : x;
            }
        return rows;
    }

    std::unique_ptr<Mapping> mapping_;
    std::vector<Place> places_;
};

/// Mapping with reordered unit coordinates: its i-th one is xi_k if order[i] is k, and 1 - xi_k if
/// order[i] is -k, with k from 1. @throws Error(usage) unless each k appears once in `order`
std::unique_ptr<Mapping> oriented(std::unique_ptr<Mapping> mapping, std::span<const double> order) {
    const std::size_t d = mapping->cube_dimension();
    std::vector<double> named(order.size());
    std::ranges::transform(order, named.begin(), [](double k) { return std::abs(k); });
    std::ranges::sort(named);
    std::vector<double> all(d);
    std::iota(all.begin(), all.end(), 1.0);
    if (named != all)
        fail(ErrorKind::usage,
             "--orientation: expected each of the unit coordinates 1 to {} once, such as {}", d,
             d == 2 ? "2,1 or -1,2" : "3,1,2");
    return std::make_unique<Oriented>(std::move(mapping), order);
}

}  // namespace

void Mapping::check_way_back() const {
    if (!no_way_back_.empty()) fail(ErrorKind::usage, "--inverse: {}", no_way_back_);
}

void Mapping::refuse_outside(std::span<const double> point) const {
    fail(ErrorKind::input, "the point ({}) is outside the domain {}", join(point, ", "),
         domain_->title());
}

void Mapping::expect_inside(std::span<const double> image) const {
    check_way_back();
    const std::size_t m = domain_->dimension();
    for (std::size_t i = 0; i + m <= image.size(); i += m)
        if (!domain_->contains(image.subspan(i, m))) refuse_outside(image.subspan(i, m));
}

void Mapping::inverse(std::span<const double> image, std::span<double> cube) const {
    expect_inside(image);
    const std::size_t d = domain_->cube_dimension();
    const std::size_t m = domain_->dimension();
    for (std::size_t i = 0; i < image.size() / m; ++i)
        domain_->to_cube(image.subspan(m * i, m), cube.subspan(d * i, d));
}

std::string WarpRequest::spec() const { return format_spec(warp.name, options, warp.options); }

std::string WarpRequest::spec(std::initializer_list<std::string_view> which) const {
    Values some = warp.options.defaults();
    for (const std::string_view option : which) {
        const auto& item = options.find(option);
        some.put(option, item.value, item.given);
    }
    return format_spec(warp.name, some, warp.options);
}

std::unique_ptr<Mapping> Warp::make(const Values& values, std::size_t given,
                                    const RunContext& run) const {
    std::unique_ptr<Mapping> made = mapping({*this, values, given, run});
    const bool turned =
        values.try_find(warps::orientation.name) != nullptr && values.given(warps::orientation);
    return turned ? oriented(std::move(made), values[warps::orientation]) : std::move(made);
}

}  // namespace stipple
