// SPDX-License-Identifier: MIT
#include "core/domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

}  // namespace

double volume_of(const Box& box) {
    double volume = 1;
    int power = 0;  // of 2, a factor of its own: products of some of the sides may be no doubles
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        std::array<int, 2> more{};
        volume = std::frexp(volume * std::frexp(box.extent(k), &more[0]), &more[1]);
        power += more[0] + more[1];
    }
    return std::ldexp(volume, power);
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

Box parse_box(std::string_view text, std::size_t dimension) {
    Box box;
    for (const auto part : split_outside("()", text, ",")) {
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
             "--bounds: {} ranges for {} coordinates; expected one for all, or one for each",
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
