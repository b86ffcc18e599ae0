// SPDX-License-Identifier: MIT
//
// Sums of products of every two coordinates, in whole numbers: an exchange changes d - 1 of them.
#include <algorithm>
#include <cmath>

#include "generators/latin_hypercube_search/criteria.hpp"

namespace stipple::latin_hypercube_search {
namespace {

/// Energies of correlations.
class CorrelationCriterion final : public Criterion {
  public:
    CorrelationCriterion(const Design& design, const Rules& rules)
        : points_(design.points), dimension_(design.dimension), x_(design.rows * dimension_) {
        const std::size_t d = dimension_;
        for (std::size_t i = 0; i < design.rows; ++i)
            for (std::size_t k = 0; k < d; ++k)
                x_[i * d + k] = 2 * std::int64_t{place_of(design.along(k)[i], parts_of(rules, k),
                                                          points_)} +
                                1 - static_cast<std::int64_t>(points_);
        products_.resize(d * d);
        for (std::size_t i = 0; i < points_; ++i)
            for (std::size_t k = 0; k < d; ++k)
                for (std::size_t l = 0; l < d; ++l)
                    products_[k * d + l] += x_[i * d + k] * x_[i * d + l];
        for (std::size_t k = 0; k < d; ++k)
            lengths_.push_back(
                std::sqrt(std::max(1.0, static_cast<double>(products_[k * d + k]))));
    }

    double change(std::size_t k, std::size_t a, std::size_t b) override {
        double sum = 0;
        for (std::size_t l = 0; l < dimension_; ++l)
            if (l != k)
                sum += fourth(k, l, products_[k * dimension_ + l] + growth(k, l, a, b)) -
                       fourth(k, l, products_[k * dimension_ + l]);
        return sum;
    }

    void exchange(std::size_t k, std::size_t a, std::size_t b, double) override {
        for (std::size_t l = 0; l < dimension_; ++l)
            if (l != k)
                products_[l * dimension_ + k] = products_[k * dimension_ + l] += growth(k, l, a, b);
        std::swap(x_[a * dimension_ + k], x_[b * dimension_ + k]);
    }

    [[nodiscard]] double energy() const override {
        double sum = 0;
        for_pairs([&](std::size_t k, std::size_t l) {
            sum += fourth(k, l, products_[k * dimension_ + l]);
        });
        return sum;
    }

    [[nodiscard]] bool reached() const override { return energy() == 0; }

    [[nodiscard]] Score score() const override {
        double largest = 0;
        for_pairs([&](std::size_t k, std::size_t l) {
            largest = std::max(largest, std::abs(over_lengths(k, l, products_[k * dimension_ + l])));
        });
        return {largest, energy()};
    }

  private:
    /// Of the product of two coordinates, when rows exchange what they have of the first.
    [[nodiscard]] std::int64_t growth(std::size_t k, std::size_t l, std::size_t a,
                                      std::size_t b) const {
        const std::int64_t* of_a = &x_[a * dimension_];
        const std::int64_t* of_b = &x_[b * dimension_];
        return (of_b[k] - of_a[k]) * (of_a[l] - (b < points_ ? of_b[l] : 0));
    }
    [[nodiscard]] double over_lengths(std::size_t k, std::size_t l, std::int64_t product) const {
        return static_cast<double>(product) / (lengths_[k] * lengths_[l]);
    }
    [[nodiscard]] double fourth(std::size_t k, std::size_t l, std::int64_t product) const {
        const double r = over_lengths(k, l, product);
        return (r * r) * (r * r);
    }
    void for_pairs(auto take) const {
        for (std::size_t k = 0; k < dimension_; ++k)
            for (std::size_t l = 0; l < k; ++l) take(k, l);
    }

    std::size_t points_;
    std::size_t dimension_;
    std::vector<std::int64_t> x_;         ///< row after row, twice from the middle
    std::vector<std::int64_t> products_;  ///< of coordinates, over all points
    std::vector<double> lengths_;         ///< of coordinates, at first
};

}  // namespace

std::unique_ptr<Criterion> correlation_criterion(const Design& design, const Rules& rules) {
    return std::make_unique<CorrelationCriterion>(design, rules);
}

}  // namespace stipple::latin_hypercube_search
