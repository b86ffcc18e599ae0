// SPDX-License-Identifier: MIT
//
// A domain with a density that is not constant, and cells of different probabilities.
#pragma once

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "core/domain.hpp"

namespace stipple::testing {

/// Unit cube with a piecewise constant density in the first coordinate. Cell probabilities can be
/// given a relative error `off`, and a stated error bound `error`.
class Steps final : public Domain {
  public:
    explicit Steps(std::vector<double> masses, std::size_t d = 1, double error = 0, double off = 0)
        : masses_(std::move(masses)), d_(d), error_(error), off_(off) {}

    std::string spec() const override { return "steps"; }
    std::size_t dimension() const override { return d_; }
    double measure() const override { return 1; }
    bool contains(std::span<const double> point) const override {
        return std::ranges::all_of(point, [](double x) { return x >= 0 && x <= 1; });
    }
    Box bounding_box() const override { return unit_cube(d_)->bounding_box(); }
    double density(std::span<const double> point) const override {
        const auto bins = static_cast<double>(masses_.size());
        return bins *
               masses_[std::min(masses_.size() - 1, static_cast<std::size_t>(bins * point[0]))];
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        std::ranges::copy(point, cube.begin());
    }
    bool even() const override { return false; }
    Estimate probability(const Box& cell) const override {
        double mass = below(cell.high[0]) - below(cell.low[0]);
        for (std::size_t k = 1; k < d_; ++k) mass *= cell.extent(k);
        return {mass * (1 + off_), error_};
    }
    std::vector<std::string> cube_axes() const override {
        return std::vector<std::string>(d_, "x");
    }

    /// Quantile: maps a uniform number to a coordinate with this density.
    double place(double u) const {
        std::size_t bin = 0;
        while (bin + 1 < masses_.size() && u >= masses_[bin]) u -= masses_[bin++];
        return (static_cast<double>(bin) + u / masses_[bin]) / static_cast<double>(masses_.size());
    }

  private:
    double below(double x) const {
        double sum = 0;
        for (std::size_t bin = 0; bin < masses_.size(); ++bin)
            sum += masses_[bin] *
                   std::clamp(x * static_cast<double>(masses_.size()) - static_cast<double>(bin),
                              0.0, 1.0);
        return sum;
    }

    std::vector<double> masses_;
    std::size_t d_;
    double error_;
    double off_;
};

}  // namespace stipple::testing
