// SPDX-License-Identifier: MIT
#include "core/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

std::vector<std::string> axis_names(std::size_t dimension) {
    std::vector<std::string> names;
    for (std::size_t k = 0; k < dimension; ++k) names.push_back(fmt::format("x{}", k + 1));
    return names;
}

/// Moments of the uniform distribution on a box: independent coordinates of variance extent^2 / 12.
Moments moments_of(const Box& box) {
    const std::size_t d = box.dimension();
    Moments m{std::vector<double>(d), std::vector<double>(d * d), std::vector<double>(d)};
    for (std::size_t k = 0; k < d; ++k) {
        m.mean[k] = box.low[k] + 0.5 * box.extent(k);
        m.covariance[k * d + k] = box.extent(k) * box.extent(k) / 12;
    }
    return m;
}

/// Copies the moments of coordinates `at` into the moments of the whole.
void place_moments(const Moments& part, std::span<const std::size_t> at, Moments& whole) {
    const std::size_t d = whole.dimension();
    for (std::size_t i = 0; i < at.size(); ++i) {
        whole.mean[at[i]] = part.mean[i];
        whole.skewness[at[i]] = part.skewness[i];
        for (std::size_t j = 0; j < at.size(); ++j)
            whole.covariance[at[i] * d + at[j]] = part.covariance[i * at.size() + j];
    }
}

class BoxDomain final : public Domain {
  public:
    BoxDomain(Box box, std::string spec, std::vector<std::string> names = {})
        : box_(std::move(box)), spec_(std::move(spec)), names_(std::move(names)) {}
    std::string spec() const override { return spec_; }
    std::size_t dimension() const override { return box_.dimension(); }
    double measure() const override { return volume_of(box_); }
    bool contains(std::span<const double> point) const override {
        for (std::size_t k = 0; k < dimension(); ++k)
            if (!(point[k] >= box_.low[k] && point[k] <= box_.high[k])) return false;
        return true;
    }
    Box bounding_box() const override { return box_; }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        for (std::size_t k = 0; k < dimension(); ++k)
            cube[k] = std::clamp((point[k] - box_.low[k]) / box_.extent(k), 0.0, 1.0);
    }
    std::optional<Estimate> box_mass(const Box& box) const override {
        return box_mass_by_axes(*this, box);
    }
    std::optional<Moments> moments() const override { return moments_of(box_); }
    std::vector<std::string> cube_axes() const override { return axis_names(dimension()); }
    std::vector<std::string> names() const override { return names_; }

  private:
    Box box_;
    std::string spec_;
    std::vector<std::string> names_;
};

class ProductDomain final : public Domain {
  public:
    explicit ProductDomain(std::vector<Factor> factors) : factors_(std::move(factors)) {
        std::vector<std::pair<std::size_t, std::size_t>> order;  // coordinate, axis
        for (const auto& [domain, coordinates] : factors_)
            for (std::size_t j = 0; j < domain->cube_dimension(); ++j)
                order.emplace_back(coordinates[std::min(j, coordinates.size() - 1)], order.size());
        std::ranges::sort(order);
        places_.resize(order.size());
        for (std::size_t place = 0; place < order.size(); ++place)
            places_[order[place].second] = place;
    }
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
            const auto plain = axis_names(domain->dimension());
            const auto own = domain->cube_axes();
            for (std::size_t j = 0; j < own.size(); ++j)
                axes[places_[axis++]] =
                    j < plain.size() && own[j] == plain[j]
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
    /// Position in the cube of each axis of the factors' cubes, listed factor by factor. The cube's
    /// axes are ordered by the coordinates that they depend on.
    std::vector<std::size_t> places_;
};

}  // namespace

double volume_of(const Box& box) {
    double volume = 1;
    for (std::size_t k = 0; k < box.dimension(); ++k) volume *= box.extent(k);
    return volume;
}

Support Domain::support() const {
    if (std::isinf(measure())) return {.finite = false, .boxes = {}};
    return {.measure = Estimate{measure(), 0}, .boxes = {}};
}

Estimate box_mass_by_axes(const Domain& domain, const Box& box) {
    const std::size_t d = domain.dimension();
    const Box ends = domain.bounding_box();
    const bool finite = std::isfinite(domain.measure());
    const auto cube_of = [&](std::vector<double> corner) {
        for (std::size_t k = 0; k < d && finite; ++k)
            corner[k] = std::clamp(corner[k], ends.low[k], ends.high[k]);
        std::vector<double> cube(d);
        domain.to_cube(corner, cube);
        return cube;
    };
    Box cell{cube_of(box.low), cube_of(box.high)};
    for (std::size_t k = 0; k < d; ++k) {
        if (!(box.low[k] < box.high[k])) return {};
        if (cell.low[k] > cell.high[k]) std::swap(cell.low[k], cell.high[k]);
    }
    return domain.probability(cell);
}

DomainPtr unit_cube(std::size_t dimension, std::vector<std::string> names) {
    const Box cube{std::vector<double>(dimension, 0), std::vector<double>(dimension, 1)};
    return std::make_shared<BoxDomain>(cube, "unit-cube", std::move(names));
}
DomainPtr box_domain(Box box) {
    const std::string spec = "box:bounds=[" + format_box(box) + "]";
    return std::make_shared<BoxDomain>(std::move(box), spec);
}
DomainPtr product_domain(std::vector<Factor> factors) {
    return std::make_shared<ProductDomain>(std::move(factors));
}

Box parse_box(std::string_view text, std::size_t dimension) {
    Box box;
    for (const auto part : split_formulas(text, ',')) {
        const auto dots = part.find("..");
        const auto low = parse_formula("bounds", trim(part.substr(0, dots)));
        const auto high = dots == std::string_view::npos
                              ? std::nullopt
                              : parse_formula("bounds", trim(part.substr(dots + 2)));
        if (!low || !high || !(*low < *high) || !std::isfinite(*high - *low))
            fail(ErrorKind::usage,
                 "--bounds: '{}' is not a range lo..hi of finite numbers with lo < hi", part);
        box.low.push_back(*low);
        box.high.push_back(*high);
    }
    if (box.dimension() == 1) {
        box.low.resize(dimension, box.low[0]);
        box.high.resize(dimension, box.high[0]);
    }
    if (box.dimension() != dimension)
        fail(ErrorKind::usage,
             "--bounds: {} ranges for {} coordinates; one for all, or one for each",
             box.dimension(), dimension);
    return box;
}

std::string format_box(const Box& box) {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < box.dimension(); ++k)
        parts.push_back(fmt::format("{}..{}", box.low[k], box.high[k]));
    return join(parts, ",");
}

Box bounding_box(std::span<const double> rows, const Box& around) {
    Box box = around;
    const std::size_t d = box.dimension();
    for (std::size_t i = 0; i < rows.size(); ++i) {
        box.low[i % d] = std::min(box.low[i % d], rows[i]);
        box.high[i % d] = std::max(box.high[i % d], rows[i]);
    }
    return box;
}

Box bounding_box(std::span<const double> rows, std::size_t dimension) {
    const std::vector<double> first(rows.begin(),
                                    rows.begin() + static_cast<std::ptrdiff_t>(dimension));
    return bounding_box(rows, {first, first});
}

void scale_into(const Box& box, std::span<double> rows) {
    const std::size_t d = box.dimension();
    for (std::size_t i = 0; i < rows.size(); i += d)
        for (std::size_t k = 0; k < d; ++k) {
            const double x = box.low[k] + rows[i + k] * box.extent(k);
            // Rounding may reach the upper face, which is not in the half-open box.
            rows[i + k] = x < box.high[k] ? x : std::nextafter(box.high[k], box.low[k]);
        }
}

}  // namespace stipple
