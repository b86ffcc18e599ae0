// SPDX-License-Identifier: MIT
#include "core/product_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "core/spec.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

/// Copies the moments of a factor on the coordinates `at` into the moments of the product.
void place_moments(const Moments& part, std::span<const std::size_t> at, Moments& whole) {
    const std::size_t d = whole.dimension();
    for (std::size_t i = 0; i < at.size(); ++i) {
        whole.mean[at[i]] = part.mean[i];
        whole.skewness[at[i]] = part.skewness[i];
        for (std::size_t j = 0; j < at.size(); ++j)
            whole.covariance[at[i] * d + at[j]] = part.covariance[i * at.size() + j];
    }
}

class ProductDomain final : public Domain {
  public:
    explicit ProductDomain(std::vector<Factor> factors) : factors_(std::move(factors)) {
        std::vector<std::pair<std::size_t, std::size_t>> order;  // (coordinate, axis that uses it)
        for (const auto& [domain, coordinates] : factors_)
            for (std::size_t j = 0; j < domain->cube_dimension(); ++j)
                order.emplace_back(coordinates[std::min(j, coordinates.size() - 1)], order.size());
        std::ranges::sort(order);
        places_.resize(order.size());
        for (std::size_t place = 0; place < order.size(); ++place)
            places_[order[place].second] = place;
    }
    const std::vector<Factor>& factors() const { return factors_; }
    std::string spec() const override { return joined(&Domain::spec); }
    std::string title() const override { return joined(&Domain::title); }
    std::string joined(std::string (Domain::*text)() const) const {
        std::vector<std::string> parts;
        for (const auto& [domain, coordinates] : factors_) {
            const std::string name = (*domain.*text)();
            const auto options = std::min(name.find(':'), name.size());
            parts.push_back(name.substr(0, options) + "@" + format_coordinates(coordinates) +
                            name.substr(options));
        }
        return join(parts, " x ");
    }
    std::size_t dimension() const override {
        std::size_t sum = 0;
        for (const auto& factor : factors_) sum += factor.domain->dimension();
        return sum;
    }
    std::size_t cube_dimension() const override { return places_.size(); }
    double measure() const override {
        double product = 1;
        for (const auto& factor : factors_) product *= factor.domain->measure();
        return product;
    }
    bool contains(std::span<const double> point) const override {
        return std::ranges::all_of(factors_, [&](const Factor& factor) {
            return factor.domain->contains(part(factor, point));
        });
    }
    Box bounding_box() const override {
        Box box{std::vector<double>(dimension()), std::vector<double>(dimension())};
        for (const auto& [domain, coordinates] : factors_) {
            const Box part = domain->bounding_box();
            for (std::size_t k = 0; k < coordinates.size(); ++k) {
                box.low[coordinates[k]] = part.low[k];
                box.high[coordinates[k]] = part.high[k];
            }
        }
        return box;
    }
    double density(std::span<const double> point) const override {
        double product = 1;
        for (const auto& factor : factors_) product *= factor.domain->density(part(factor, point));
        return product;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        std::vector<double> own;
        std::size_t axis = 0;
        for (const auto& factor : factors_) {
            own.resize(factor.domain->cube_dimension());
            factor.domain->to_cube(part(factor, point), own);
            for (const double u : own) cube[places_[axis++]] = u;
        }
    }
    bool even() const override {
        return std::ranges::all_of(factors_, [](const Factor& f) { return f.domain->even(); });
    }
    bool has_outcomes() const override {
        return !even() && std::ranges::all_of(factors_, [](const Factor& f) {
            return f.domain->even() || f.domain->has_outcomes();
        });
    }
    Estimate probability(const Box& cell) const override {
        Estimate product{1, 0};
        std::size_t axis = 0;
        for (const auto& factor : factors_) {
            Box own;
            for (std::size_t j = 0; j < factor.domain->cube_dimension(); ++j, ++axis) {
                own.low.push_back(cell.low[places_[axis]]);
                own.high.push_back(cell.high[places_[axis]]);
            }
            const Estimate one = factor.domain->probability(own);
            product = {product.value * one.value,
                       product.error * (one.value + one.error) + product.value * one.error};
        }
        return product;
    }
    std::optional<Moments> moments() const override {
        const std::size_t d = dimension();
        Moments whole{std::vector<double>(d), std::vector<double>(d * d), std::vector<double>(d)};
        for (const auto& [domain, coordinates] : factors_) {
            const auto part = domain->moments();
            if (!part) return std::nullopt;
            place_moments(*part, coordinates, whole);
        }
        return whole;
    }
    std::vector<std::string> cube_axes() const override {
        std::vector<std::string> axes(cube_dimension());
        std::size_t axis = 0;
        for (const auto& [domain, coordinates] : factors_) {
            const auto own = domain->cube_axes();
            for (std::size_t j = 0; j < own.size(); ++j)
                axes[places_[axis++]] =
                    j < domain->dimension() && own[j] == fmt::format("x{}", j + 1)
                        ? fmt::format("x{}", coordinates[j] + 1)
                        : fmt::format("{} of {}@{}", own[j],
                                      domain->spec().substr(0, domain->spec().find(':')),
                                      format_coordinates(coordinates));
        }
        return axes;
    }

  private:
    static std::vector<double> part(const Factor& factor, std::span<const double> point) {
        std::vector<double> out;
        for (const std::size_t k : factor.coordinates) out.push_back(point[k]);
        return out;
    }

    std::vector<Factor> factors_;
    /// For the axes of the factors' cubes, factor by factor: index of the axis in the product's
    /// cube. There, axes are ordered by the coordinates that use them.
    std::vector<std::size_t> places_;
};

}  // namespace

DomainPtr product_domain(std::vector<Factor> factors) {
    return std::make_shared<ProductDomain>(std::move(factors));
}

std::vector<Factor> factors_of(const DomainPtr& domain) {
    if (const auto* product = dynamic_cast<const ProductDomain*>(domain.get()))
        return product->factors();
    std::vector<std::size_t> all(domain->dimension());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return {{domain, all}};
}

}  // namespace stipple
