// SPDX-License-Identifier: MIT
//
// Independent coordinates, each with a distribution on the line, and the mapping onto them by
// inversion. A distribution is
//
//     struct Decay final : LineDistribution {
//         double forward(double u) const;   // the quantile of u in [0, 1]
//         bool infinite(double u) const;    // whether the quantile is infinite; optional
//         ...                               // members that LineDistribution requires
//     };
//
// or has `void forward_all(std::span<double> numbers) const` instead of forward(), which maps many
// numbers at a time and avoids copying the distribution.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/machine/wide.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps {

class LineDistribution {
  public:
    virtual ~LineDistribution() = default;

    /// Inverse of the quantile: the number in [0, 1] that maps to x; rounding may leave [0, 1].
    [[nodiscard]] virtual double inverse(double x) const = 0;
    [[nodiscard]] virtual double density(double x) const = 0;
    /// Interval shown in pictures; also the support, unless contains() is overridden.
    [[nodiscard]] virtual std::pair<double, double> range() const = 0;
    [[nodiscard]] virtual bool contains(double x) const {
        return x >= range().first && x <= range().second;
    }
    [[nodiscard]] virtual double measure() const {  ///< length of the whole range
        return range().second - range().first;
    }
    /// Moments; NaN or infinite if a moment does not exist or is unknown.
    [[nodiscard]] virtual LineMoments moments() const = 0;

    /// Whether inverse() is the distribution function: probabilities are lengths in the cube.
    [[nodiscard]] virtual bool even() const { return true; }

    /// Whether the distribution is discrete. cube_coordinate() is then in the middle of a cell
    /// whose length is the outcome's probability.
    [[nodiscard]] virtual bool has_outcomes() const { return false; }

    /// Cube coordinate of x, and probability between cube coordinates; overridden if not even().
    [[nodiscard]] virtual double cube_coordinate(double x) const { return inverse(x); }
    [[nodiscard]] virtual Estimate probability(double low, double high) const {
        return {high - low, 0};
    }

    /// Support of the density: disjoint intervals, and their total length.
    struct Positive {
        std::vector<std::pair<double, double>> intervals;
        double length;
    };
    static Positive all_of(std::vector<std::pair<double, double>> intervals) {
        double length = 0;
        for (const auto& [low, high] : intervals) length += high - low;
        return {std::move(intervals), length};
    }
    [[nodiscard]] virtual Positive positive() const { return {{range()}, measure()}; }

  protected:
    LineDistribution() = default;
    LineDistribution(const LineDistribution&) = default;
    LineDistribution& operator=(const LineDistribution&) = default;
};

class LineDomain final : public NamedDomain {
  public:
    /// @param distributions one distribution for each coordinate
    /// @param what description of the cube's coordinates
    LineDomain(std::vector<std::shared_ptr<const LineDistribution>> distributions, std::string spec,
               std::string what)
        : NamedDomain(std::move(spec), distributions.size(), distributions.size()),
          axes_(std::move(distributions)),
          what_(std::move(what)) {}

    double measure() const override {
        double product = 1;
        for (const auto& axis : axes_) product *= axis->measure();
        return product;
    }
    bool contains(std::span<const double> point) const override {
        for (std::size_t k = 0; k < axes_.size(); ++k)
            if (!axes_[k]->contains(point[k])) return false;
        return true;
    }
    Box bounding_box() const override {
        Box box;
        for (const auto& axis : axes_) {
            const auto [low, high] = axis->range();
            box.low.push_back(low);
            box.high.push_back(high);
        }
        return box;
    }
    double density(std::span<const double> point) const override {
        double product = 1;
        for (std::size_t k = 0; k < axes_.size(); ++k) product *= axes_[k]->density(point[k]);
        return product;
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        for (std::size_t k = 0; k < axes_.size(); ++k)
            cube[k] = std::clamp(axes_[k]->cube_coordinate(point[k]), 0.0, 1.0);
    }
    bool even() const override {
        return std::ranges::all_of(axes_, [](const auto& axis) { return axis->even(); });
    }
    bool has_outcomes() const override {
        return !even() && std::ranges::all_of(axes_, [](const auto& axis) {
            return axis->even() || axis->has_outcomes();
        });
    }
    Estimate probability(const Box& cell) const override {
        Estimate product{1, 0};
        for (std::size_t k = 0; k < axes_.size(); ++k) {
            const Estimate one = axes_[k]->probability(cell.low[k], cell.high[k]);
            product = {product.value * one.value,
                       product.error * one.value + product.value * one.error};
        }
        return product;
    }
    std::optional<Estimate> box_mass(const Box& box) const override {
        return box_mass_by_axes(*this, box);
    }
    std::optional<Moments> moments() const override {
        std::vector<LineMoments> each;
        for (const auto& axis : axes_) each.push_back(axis->moments());
        return independent_moments(each);
    }
    std::vector<std::string> cube_axes() const override {
        if (axes_.size() == 1) return {what_};
        std::vector<std::string> names;
        for (std::size_t k = 1; k <= axes_.size(); ++k)
            names.push_back(fmt::format("{} of x{}", what_, k));
        return names;
    }
    Support support() const override {
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
    bool shows_gaps() const override { return true; }

    /// Inverse of the distributions for rows of points that the domain contains.
    void inverse(std::span<const double> image, std::span<double> cube) const {
        const std::size_t d = axes_.size();
        for (std::size_t i = 0; i < image.size(); i += d)
            for (std::size_t k = 0; k < d; ++k)
                cube[i + k] = std::clamp(axes_[k]->inverse(image[i + k]), 0.0, 1.0);
    }

  private:
    std::vector<std::shared_ptr<const LineDistribution>> axes_;
    std::string what_;
};

// Takes the distribution by value: writes to `numbers` cannot alias it, so its constants stay in
// registers. All calls are inlined, since a call would prevent vectorization of the loop.
template <class Law>
STIPPLE_WIDE [[gnu::flatten]] void map_numbers(const Law law, std::span<double> numbers) {
    for (double& x : numbers) x = law.forward(x);
}

template <class Law>
class LineMapping final : public Mapping {
  public:
    LineMapping(std::vector<std::shared_ptr<const Law>> laws,
                const std::shared_ptr<const LineDomain>& domain, std::string no_way_back)
        : Mapping(domain, std::move(no_way_back)), laws_(std::move(laws)), line_(*domain) {}

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        std::ranges::copy(cube, image.begin());
        if (laws_.size() == 1) return apply(*laws_[0], image);
        for (std::size_t k = 0; k < laws_.size(); ++k) map_column(k, image);
    }
    bool infinite(std::span<const double> row) const override {
        if constexpr (requires(const Law& law) { law.infinite(1.0); })
            for (std::size_t k = 0; k < row.size(); ++k)
                if (laws_[k % laws_.size()]->infinite(row[k])) return true;
        return false;
    }
    void inverse(std::span<const double> image, std::span<double> cube) const override {
        expect_inside(image);
        line_.inverse(image, cube);
    }

  private:
    static void apply(const Law& law, std::span<double> numbers) {
        if constexpr (requires { law.forward_all(numbers); })
            law.forward_all(numbers);
        else
            map_numbers(law, numbers);
    }

    /// Maps coordinate k of all rows, gathered in blocks.
    void map_column(std::size_t k, std::span<double> rows) const {
        std::array<double, 256> column;
        const std::size_t d = laws_.size();
        const std::size_t count = rows.size() / d;
        for (std::size_t first = 0; first < count; first += column.size()) {
            const std::size_t size = std::min(column.size(), count - first);
            for (std::size_t i = 0; i < size; ++i) column[i] = rows[(first + i) * d + k];
            apply(*laws_[k], std::span(column).first(size));
            for (std::size_t i = 0; i < size; ++i) rows[(first + i) * d + k] = column[i];
        }
    }

    std::vector<std::shared_ptr<const Law>> laws_;  ///< one for all coordinates, or one for each
    const LineDomain& line_;
};

/// Mapping of d coordinates, with one distribution for all or one for each.
/// @param no_way_back why there is no inverse; empty if there is one
template <class Law>
std::unique_ptr<Mapping> line_mapping(std::vector<std::shared_ptr<const Law>> laws, std::size_t d,
                                      std::string spec, std::string what,
                                      std::string no_way_back = {}) {
    std::vector<std::shared_ptr<const LineDistribution>> axes(laws.begin(), laws.end());
    if (laws.size() == 1) axes.resize(d, axes[0]);
    const auto domain =
        std::make_shared<const LineDomain>(std::move(axes), std::move(spec), std::move(what));
    return std::make_unique<LineMapping<Law>>(std::move(laws), domain, std::move(no_way_back));
}

}  // namespace stipple::warps
