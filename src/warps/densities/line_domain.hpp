// SPDX-License-Identifier: MIT
//
// Coordinates that are independent of each other, each by a distribution on the line, and the
// mapping onto them by inversion. A distribution is a value:
//
//     struct Decay final : LineDistribution {
//         double forward(double u) const;   // the quantile of u in [0, 1]
//         ...                               // what LineDistribution asks for
//     };
//
// or has `void forward_all(std::span<double> numbers) const` in place of forward(), which takes
// many numbers at a time.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"
#include "core/machine/wide.hpp"
#include "core/support.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/named_domain.hpp"
#include "warps/warp.hpp"

namespace stipple::warps {

class LineDistribution {
  public:
    virtual ~LineDistribution() = default;

    /// The way back, to the number in [0, 1] that has this image; rounding may leave [0, 1].
    [[nodiscard]] virtual double inverse(double x) const = 0;
    [[nodiscard]] virtual double density(double x) const = 0;           ///< 0 outside
    [[nodiscard]] virtual std::pair<double, double> range() const = 0;  ///< what a picture shows
    [[nodiscard]] virtual bool contains(double x) const {
        return x >= range().first && x <= range().second;
    }
    [[nodiscard]] virtual double measure() const {  ///< of all that it contains
        return range().second - range().first;
    }
    [[nodiscard]] virtual LineMoments moments() const = 0;

    /// Whether inverse() is the distribution function, which makes all intervals of the cube as
    /// likely as they are long.
    [[nodiscard]] virtual bool even() const { return true; }

    /// Coordinate in the cube, and the probability between two of them, where not even().
    [[nodiscard]] virtual double cube_coordinate(double x) const { return inverse(x); }
    [[nodiscard]] virtual Estimate probability(double low, double high) const {
        return {high - low, 0};
    }

    /// Where the density is not 0: intervals side by side, and their length.
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

class LineDomain final : public NamedDomain, public Gapped, public Weighable {
  public:
    /// @param distributions one for each coordinate
    /// @param what what the coordinates of the cube are, for people
    LineDomain(std::vector<std::shared_ptr<const LineDistribution>> distributions, std::string spec,
               std::string what);

    double measure() const override;
    bool contains(std::span<const double> point) const override;
    Box bounding_box() const override;
    double density(std::span<const double> point) const override;
    void to_cube(std::span<const double> point, std::span<double> cube) const override;
    bool even() const override { return axes_[0]->even(); }
    Estimate probability(const Box& cell) const override;
    Estimate box_mass(const Box& box) const override { return box_mass_by_axes(*this, box); }
    std::optional<Moments> moments() const override;
    std::vector<std::string> cube_axes() const override;
    Support support() const override;
    bool shows_gaps() const override { return true; }

    /// The distributions' ways back, point after point, of points that it contains.
    void inverse(std::span<const double> image, std::span<double> cube) const;

  private:
    std::vector<std::shared_ptr<const LineDistribution>> axes_;
    std::string what_;
};

// The distribution is taken by value: what is written cannot change it, so that its constants stay
// in registers. All calls are inlined: one that is not keeps the loop from being widened.
template <class Law>
STIPPLE_WIDE [[gnu::flatten]] void map_numbers(const Law law, std::span<double> numbers) {
    for (double& x : numbers) x = law.forward(x);
}

template <class Law>
class LineMapping final : public Mapping {
  public:
    LineMapping(std::vector<Law> laws, const std::shared_ptr<const LineDomain>& domain,
                std::string no_way_back)
        : Mapping(domain, std::move(no_way_back)), laws_(std::move(laws)), line_(*domain) {}

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        std::ranges::copy(cube, image.begin());
        if (laws_.size() == 1) return apply(laws_[0], image);
        for (std::size_t k = 0; k < laws_.size(); ++k) map_column(k, image);
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

    /// Coordinate k of all rows, some at a time side by side.
    void map_column(std::size_t k, std::span<double> rows) const {
        std::array<double, 256> column;
        const std::size_t d = laws_.size();
        const std::size_t count = rows.size() / d;
        for (std::size_t first = 0; first < count; first += column.size()) {
            const std::size_t size = std::min(column.size(), count - first);
            for (std::size_t i = 0; i < size; ++i) column[i] = rows[(first + i) * d + k];
            apply(laws_[k], std::span(column).first(size));
            for (std::size_t i = 0; i < size; ++i) rows[(first + i) * d + k] = column[i];
        }
    }

    std::vector<Law> laws_;  ///< one for all coordinates, or one for each
    const LineDomain& line_;
};

/// The mapping of d coordinates by one distribution for all, or by one for each.
/// @param no_way_back why there is no inverse; empty where there is one
template <class Law>
std::unique_ptr<Mapping> line_mapping(std::vector<Law> laws, std::size_t d, std::string spec,
                                      std::string what, std::string no_way_back = {}) {
    std::vector<std::shared_ptr<const LineDistribution>> axes;
    for (const Law& law : laws) axes.push_back(std::make_shared<Law>(law));
    if (laws.size() == 1) axes.resize(d, axes[0]);
    const auto domain =
        std::make_shared<const LineDomain>(std::move(axes), std::move(spec), std::move(what));
    return std::make_unique<LineMapping<Law>>(std::move(laws), domain, std::move(no_way_back));
}

}  // namespace stipple::warps
