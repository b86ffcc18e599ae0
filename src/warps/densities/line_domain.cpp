// SPDX-License-Identifier: MIT
#include "warps/densities/line_domain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace stipple::warps {

LineDomain::LineDomain(std::vector<std::shared_ptr<const LineDistribution>> distributions,
                       std::string spec, std::string what)
    : NamedDomain(std::move(spec), distributions.size(), distributions.size()),
      axes_(std::move(distributions)),
      what_(std::move(what)) {}

double LineDomain::measure() const {
    double product = 1;
    for (const auto& axis : axes_) product *= axis->measure();
    return product;
}

bool LineDomain::contains(std::span<const double> point) const {
    for (std::size_t k = 0; k < axes_.size(); ++k)
        if (!axes_[k]->contains(point[k])) return false;
    return true;
}

Box LineDomain::bounding_box() const {
    Box box;
    for (const auto& axis : axes_) {
        const auto [low, high] = axis->range();
        box.low.push_back(low);
        box.high.push_back(high);
    }
    return box;
}

double LineDomain::density(std::span<const double> point) const {
    double product = 1;
    for (std::size_t k = 0; k < axes_.size(); ++k) product *= axes_[k]->density(point[k]);
    return product;
}

void LineDomain::to_cube(std::span<const double> point, std::span<double> cube) const {
    for (std::size_t k = 0; k < axes_.size(); ++k)
        cube[k] = std::clamp(axes_[k]->cube_coordinate(point[k]), 0.0, 1.0);
}

Estimate LineDomain::probability(const Box& cell) const {
    Estimate product{1, 0};
    for (std::size_t k = 0; k < axes_.size(); ++k) {
        const Estimate one = axes_[k]->probability(cell.low[k], cell.high[k]);
        product = {product.value * one.value,
                   product.error * one.value + product.value * one.error};
    }
    return product;
}

std::optional<Moments> LineDomain::moments() const {
    std::vector<LineMoments> each;
    for (const auto& axis : axes_) each.push_back(axis->moments());
    return independent_moments(each);
}

std::vector<std::string> LineDomain::cube_axes() const {
    if (axes_.size() == 1) return {what_};
    std::vector<std::string> names;
    for (std::size_t k = 1; k <= axes_.size(); ++k)
        names.push_back(fmt::format("{} of x{}", what_, k));
    return names;
}

Support LineDomain::support() const {
    constexpr std::size_t most_boxes = 64;
    Support all{.measure = Estimate{1, 0}, .boxes = {Box{}}};
    for (const auto& axis : axes_) {
        const auto [intervals, length] = axis->positive();
        all.whole = all.whole && length >= axis->measure();
        all.measure->value *= length;
        std::vector<Box> boxes;
        if (axes_.size() == 1 || all.boxes.size() * intervals.size() <= most_boxes)
            for (const Box& before : all.boxes)
                for (const auto& [low, high] : intervals) {
                    boxes.push_back(before);
                    boxes.back().low.push_back(low);
                    boxes.back().high.push_back(high);
                }
        all.boxes = std::move(boxes);
    }
    all.finite = all.measure->value < std::numeric_limits<double>::infinity();
    if (!all.finite) all.measure.reset();
    return all;
}

void LineDomain::inverse(std::span<const double> image, std::span<double> cube) const {
    const std::size_t d = axes_.size();
    for (std::size_t i = 0; i < image.size(); i += d)
        for (std::size_t k = 0; k < d; ++k)
            cube[i + k] = std::clamp(axes_[k]->inverse(image[i + k]), 0.0, 1.0);
}

}  // namespace stipple::warps
