// SPDX-License-Identifier: MIT
//
// Discrete distributions: tables of outcomes with running sums from both ends, and ranges of
// integers. Also columns of numbers with linear interpolation. The weights of the Poisson and
// binomial distributions are products of ratios
//
//     p(k + 1) / p(k) = mean / (k + 1)    or    (n - k) / (k + 1) * p / (1 - p)
//
// starting from the mode, computed to twice the precision of a double, and divided by their sum.
//
// Cost    40 bytes an outcome; tables include outcomes more than 1e-306 times as likely as the
//         mode: a range of 75 standard deviations if there are many.
// Source  R. J. Hyndman, Y. Fan, "Sample quantiles in statistical packages", The American
//         Statistician 50 (1996) 361-365, doi:10.1080/00031305.1996.10473566: interpolation by
//         definition 7.

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/arithmetic/double_double.hpp"
#include "math/arithmetic/quotient.hpp"
#include "math/densities/guide_table.hpp"
#include "math/distributions/laws.hpp"
#include "math/distributions/outcomes.hpp"

namespace stipple {
namespace {

std::vector<double> sums_from_above(const std::vector<double>& weights) {
    std::vector<double> sums = running_sums(std::vector(weights.rbegin(), weights.rend()));
    std::ranges::reverse(sums);
    return sums;
}

/// F at each outcome, as a sum from the nearer end of the table.
std::vector<double> cell_ends(const std::vector<double>& weights,
                              const std::vector<double>& above) {
    std::vector<double> ends = running_sums(weights);
    for (std::size_t i = 0; i < ends.size(); ++i) {
        if (ends[i] > 0.5) ends[i] = 1 - above[i];
        if (i > 0) ends[i] = std::max(ends[i], ends[i - 1]);
    }
    return ends;
}

}  // namespace

Outcomes::Outcomes(std::string_view name, std::vector<double> values, std::vector<double> weights)
    : name_(name), values_(std::move(values)), weights_(std::move(weights)) {
    const double total = running_sums(weights_).back();
    for (double& w : weights_) w /= total;
    above_ = sums_from_above(weights_);
    above_.erase(above_.begin());
    above_.push_back(0);
    ends_ = GuideTable(cell_ends(weights_, above_), 2 * values_.size());
}

double Outcomes::quantile(double p, Tail tail) const {
    if (tail == Tail::lower || p > 0.5) return values_[ends_.at(tail == Tail::lower ? p : 1 - p)];
    const auto at = std::ranges::partition_point(above_, [&](double q) { return q >= p && q > 0; });
    return values_[static_cast<std::size_t>(at - above_.begin())];
}

double Outcomes::probability(double x, Tail tail) const {
    const auto after = std::ranges::upper_bound(values_, x);
    if (after == values_.begin()) return tail == Tail::lower ? 0 : 1;
    const auto i = static_cast<std::size_t>(after - values_.begin()) - 1;
    return tail == Tail::lower ? ends_.end(i) : above_[i];
}

double Outcomes::density(double x) const {
    const auto at = std::ranges::lower_bound(values_, x);
    const auto i = static_cast<std::size_t>(at - values_.begin());
    return at != values_.end() && *at == x ? weights_[i] : 0;
}

/// Moments, computed relative to the median in units of the largest distance from the median.
MarginalMoments Outcomes::moments() const {
    const double middle = quantile(0.5, Tail::lower);
    const double unit = std::max(middle - values_.front(), values_.back() - middle);
    if (unit == 0) return {middle, 0, 0};
    const auto mean_of = [&](const auto& term) {
        DoubleDouble sum;
        for (std::size_t i = 0; i < values_.size(); ++i)
            sum = sum + DoubleDouble{weights_[i] * term((values_[i] - middle) / unit), 0};
        return sum.high;
    };
    const double m = mean_of([](double x) { return x; });
    const double variance = mean_of([m](double x) { return (x - m) * (x - m); });
    const double third = mean_of([m](double x) { return (x - m) * (x - m) * (x - m); });
    return {middle + unit * m, unit * unit * variance,
            variance > 0 ? third / (variance * std::sqrt(variance)) : 0};
}

void Outcomes::quantiles(std::span<double> p) const {
    for (double& x : p) x = values_[ends_.at(std::max(x, 0.0))];
}

MarginalPtr Outcomes::between(double low, double high) const {
    std::vector<double> values;
    std::vector<double> weights;
    for (std::size_t i = 0; i < values_.size(); ++i) {
        if (values_[i] < low || values_[i] > high) continue;
        values.push_back(values_[i]);
        weights.push_back(weights_[i]);
    }
    const double most = weights.empty() ? 0 : std::ranges::max(weights);
    if (!(most > 1e-290)) return nullptr;
    for (double& w : weights) w /= most;
    return std::make_shared<Outcomes>(name_, std::move(values), std::move(weights));
}

Integers::Integers(double low, double high) : low_(low), count_(high - low + 1) {}

double Integers::quantile(double p, Tail tail) const {
    if (tail == Tail::lower) return low_ + std::min(std::floor(p * count_), count_ - 1);
    return low_ + count_ - std::clamp(std::ceil(p * count_), 1.0, count_);
}
double Integers::probability(double x, Tail tail) const {
    const double below = std::clamp(std::floor(x) - low_ + 1, 0.0, count_);
    return (tail == Tail::lower ? below : count_ - below) / count_;
}
double Integers::density(double x) const {
    return x >= low_ && x - low_ < count_ && std::floor(x) == x ? 1 / count_ : 0;
}
MarginalMoments Integers::moments() const {
    return {low_ + 0.5 * (count_ - 1), (count_ - 1) * (count_ + 1) / 12, 0};
}
void Integers::quantiles(std::span<double> p) const {
    for (double& x : p) x = quantile(std::max(x, 0.0), Tail::lower);
}
MarginalPtr Integers::between(double low, double high) const {
    const double from = std::max(low_, std::ceil(low));
    const double to = std::min(low_ + count_ - 1, std::floor(high));
    return from <= to ? std::make_shared<Integers>(from, to) : nullptr;
}

namespace {

/// Distribution on 0, ..., `last` from the ratios up(k) = p(k + 1) / p(k), without rare outcomes.
template <class Ratio>
MarginalPtr by_ratios(std::string_view name, double mode, double last, const Ratio& up) {
    constexpr double rare = 1e-306;
    std::vector<double> values, weights;
    DoubleDouble w{1, 0};
    for (double k = mode; k >= 0 && w.high > rare; --k) {
        values.push_back(k);
        weights.push_back(w.high);
        if (k > 0) w = quotient(w, up(k - 1));
    }
    std::ranges::reverse(values);
    std::ranges::reverse(weights);
    w = up(mode);
    for (double k = mode + 1; k <= last && w.high > rare; ++k) {
        values.push_back(k);
        weights.push_back(w.high);
        w = w * up(k);
    }
    return std::make_shared<Outcomes>(name, std::move(values), std::move(weights));
}

/// A column of numbers, interpolated linearly between its order statistics: with x_0 < ... < x_n-1
/// and h = p (n - 1), the quantile is x_i + (h - i) (x_i+1 - x_i) for i = floor(h).
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
    /// Moments of a mixture of uniform distributions between neighbouring numbers, computed
    /// relative to the median in units of the range.
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

MarginalPtr integers_law(double low, double high) { return std::make_shared<Integers>(low, high); }

MarginalPtr poisson_law(double mean) {
    return by_ratios("poisson", std::floor(mean), 1e15, [&](double k) {
        return quotient({mean, 0}, {k + 1, 0});
    });
}

MarginalPtr binomial_law(double trials, double probability) {
    const double mode = std::min(trials, std::floor((trials + 1) * probability));
    const DoubleDouble odds = quotient({probability, 0}, exact_sum(1, -probability));
    return by_ratios("binomial", mode, trials, [&](double k) {
        return quotient({trials - k, 0}, {k + 1, 0}) * odds;
    });
}

MarginalPtr empirical_law(std::vector<double> values) {
    std::ranges::sort(values);
    std::vector<double> counts;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (i == 0 || values[i] != values[i - 1])
            counts.push_back(1);
        else
            ++counts.back();
    }
    values.erase(std::unique(values.begin(), values.end()), values.end());
    return std::make_shared<Outcomes>("empirical", std::move(values), std::move(counts));
}

MarginalPtr interpolated_law(std::vector<double> values) {
    std::ranges::sort(values);
    return std::make_shared<const Interpolated>(std::move(values));
}

}  // namespace stipple
