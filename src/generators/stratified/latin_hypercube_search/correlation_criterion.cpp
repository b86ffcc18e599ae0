// SPDX-License-Identifier: MIT
//
// Correlation criterion by integer sums of products, one for every two coordinates. An exchange
// changes d - 1 of them.
#include <algorithm>
#include <cmath>

#include "generators/stratified/latin_hypercube_search/criteria.hpp"

namespace stipple::latin_hypercube_search {
namespace {

/// Energy and score by correlations.
class CorrelationCriterion final : public Criterion {
  public:
    CorrelationCriterion(const Design& design, const Rules& rules)
        : points_(design.points), dimension_(design.dimension), x_(design.rows * dimension_) {
        const std::size_t d = dimension_;
        for (std::size_t k = 0; k < d; ++k) {
            double squares = 0;  // sum over all levels, some of them in spare rows
            for (std::size_t l = 0; l < points_; ++l) {
                const auto x =
                    static_cast<double>(twice_from_middle(static_cast<Level>(l), k, rules));
                squares += x * x;
            }
            lengths_.push_back(std::sqrt(squares));
            for (std::size_t i = 0; i < design.rows; ++i)
                x_[i * d + k] = twice_from_middle(design.along(k)[i], k, rules);
        }
        products_.resize(d * d);
        for (std::size_t i = 0; i < points_; ++i)
            for (std::size_t k = 0; k < d; ++k)
                for (std::size_t l = 0; l < d; ++l)
                    products_[k * d + l] += x_[i * d + k] * x_[i * d + l];
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
            largest =
                std::max(largest, std::abs(over_lengths(k, l, products_[k * dimension_ + l])));
        });
        return {largest, energy()};
    }

    Score score_below(const Score&) override { return score(); }

  private:
    [[nodiscard]] std::int64_t twice_from_middle(Level level, std::size_t k,
                                                 const Rules& rules) const {
        return 2 * std::int64_t{rules.axis(k).place(level)} + 1 -
               static_cast<std::int64_t>(points_);
    }

    /// Growth of the sum of products of coordinates k and l if rows a and b exchange coordinate k.
    [[nodiscard]] std::int64_t growth(std::size_t k, std::size_t l, std::size_t a,
                                      std::size_t b) const {
        const std::int64_t* of_a = &x_[a * dimension_];
        const std::int64_t* of_b = &x_[b * dimension_];
        return (of_b[k] - of_a[k]) * (of_a[l] - (b < points_ ? of_b[l] : 0));
    }
    [[nodiscard]] double over_lengths(std::size_t k, std::size_t l, std::int64_t product) const {
        const double both = lengths_[k] * lengths_[l];
        return both > 0 ? static_cast<double>(product) / both : 0;
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
    std::vector<std::int64_t> x_;  ///< twice a level's distance from the middle, row after row
    std::vector<std::int64_t> products_;  ///< sums over all points, for every two coordinates
    std::vector<double> lengths_;         ///< Euclidean norm of each coordinate
};

}  // namespace

std::unique_ptr<Criterion> correlation_criterion(const Design& design, const Rules& rules) {
    return std::make_unique<CorrelationCriterion>(design, rules);
}

}  // namespace stipple::latin_hypercube_search
