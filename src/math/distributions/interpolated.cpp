// SPDX-License-Identifier: MIT
//
// Distribution of a column of numbers, interpolated linearly between its order statistics: with x_0
// < ... < x_n-1 and h = p (n - 1), the quantile is x_i + (h - i) (x_i+1 - x_i) for i = floor(h).
//
// Source  R. J. Hyndman, Y. Fan, "Sample quantiles in statistical packages", The American
//         Statistician 50 (1996) 361-365, doi:10.1080/00031305.1996.10473566: definition 7.

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/arithmetic/double_double.hpp"
#include "math/distributions/laws.hpp"
#include "math/distributions/marginal.hpp"

namespace stipple {
namespace {

class Interpolated final : public Marginal {
  public:
    explicit Interpolated(std::vector<double> sorted)
        : x_(std::move(sorted)), pieces_(static_cast<double>(x_.size() - 1)) {}

    std::string_view name() const override { return "empirical"; }
    double quantile(double p, Tail tail) const override {
        const double h = std::clamp(p, 0.0, 1.0) * pieces_;
        const double whole = std::min(std::floor(h), pieces_ - 1);
        const auto i = static_cast<std::size_t>(whole);
        const std::size_t last = x_.size() - 1;
        const double from = tail == Tail::lower ? x_[i] : x_[last - i];
        const double to = tail == Tail::lower ? x_[i + 1] : x_[last - i - 1];
        const double share = h - whole;
        return share < 1 ? from + share * (to - from) : to;
    }
    double probability(double x, Tail tail) const override {
        if (x <= x_.front() || x >= x_.back())
            return (x <= x_.front()) == (tail == Tail::lower) ? 0 : 1;
        const std::size_t i = piece_of(x);
        const double below = static_cast<double>(i) + (x - x_[i]) / (x_[i + 1] - x_[i]);
        const double above =
            static_cast<double>(x_.size() - 2 - i) + (x_[i + 1] - x) / (x_[i + 1] - x_[i]);
        return (tail == Tail::lower ? below : above) / pieces_;
    }
    double density(double x) const override {
        if (!(x >= x_.front() && x <= x_.back())) return 0;
        const std::size_t i = piece_of(x);
        return 1 / (pieces_ * (x_[i + 1] - x_[i]));
    }
    /// Moments of a mixture of uniform distributions on the pieces, computed relative to a middle
    /// number in units of the width.
    MarginalMoments moments() const override {
        const double middle = x_[x_.size() / 2];
        const double unit = x_.back() - x_.front();
        const auto mean_of = [&](const auto& term) {
            DoubleDouble sum;
            for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
                const double width = (x_[i + 1] - x_[i]) / unit;
                sum = sum + DoubleDouble{term((x_[i] - middle) / unit + 0.5 * width, width), 0};
            }
            return sum.high / pieces_;
        };
        const double m = mean_of([](double x, double /*width*/) { return x; });
        const double variance =
            mean_of([m](double x, double width) { return (x - m) * (x - m) + width * width / 12; });
        const double third = mean_of([m](double x, double width) {
            return (x - m) * ((x - m) * (x - m) + width * width / 4);
        });
        return {middle + unit * m, unit * unit * variance,
                third / (variance * std::sqrt(variance))};
    }
    std::pair<double, double> support() const override { return {x_.front(), x_.back()}; }
    void quantiles(std::span<double> p) const override {
        for (double& x : p) x = quantile(x, Tail::lower);
    }

  private:
    std::size_t piece_of(double x) const {
        const auto after = std::upper_bound(x_.begin() + 1, x_.end() - 1, x);
        return static_cast<std::size_t>(after - x_.begin()) - 1;
    }

    std::vector<double> x_;
    double pieces_;
};

}  // namespace

MarginalPtr interpolated_law(std::vector<double> values) {
    std::ranges::sort(values);
    return std::make_shared<const Interpolated>(std::move(values));
}

}  // namespace stipple
