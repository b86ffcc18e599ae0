// SPDX-License-Identifier: MIT
#include "generators/optimized/even_order.hpp"

#include "generators/optimized/l2_factor.hpp"

namespace stipple::optimized {
namespace {

/// Greedy choice of the next point: the remaining one that adds least to the discrepancy.
class Greedy {
  public:
    Greedy(const std::vector<double>& rows, std::size_t dimension, std::vector<Factor> factors)
        : rows_(rows),
          d_(dimension),
          factors_(std::move(factors)),
          sums_(rows.size() / dimension),
          taken_(sums_.size()) {
        for (std::size_t i = 0; i < sums_.size(); ++i) {
            double mean = 1;
            for (std::size_t j = 0; j < d_; ++j) mean *= factors_[j].mean.at(rows[i * d_ + j]);
            means_.push_back(mean);
            own_.push_back(kernel(i, i));
        }
    }

    void take(std::size_t i) {
        taken_[i] = true;
        ++chosen_;
        for (std::size_t k = 0; k < sums_.size(); ++k)
            if (!taken_[k]) sums_[k] += kernel(i, k);
    }

    [[nodiscard]] std::size_t next() const {
        std::size_t best = sums_.size();
        for (std::size_t k = 0; k < sums_.size(); ++k)
            if (!taken_[k] && (best == sums_.size() || added(k) < added(best))) best = k;
        return best;
    }

  private:
    [[nodiscard]] double kernel(std::size_t i, std::size_t k) const {
        double product = 1;
        for (std::size_t j = 0; j < d_; ++j)
            product *= factors_[j].at(rows_[i * d_ + j], rows_[k * d_ + j]);
        return product;
    }
    [[nodiscard]] double added(std::size_t k) const {
        return 2 * sums_[k] + own_[k] - 2 * static_cast<double>(chosen_ + 1) * means_[k];
    }

    const std::vector<double>& rows_;
    std::size_t d_;
    std::vector<Factor> factors_;
    std::vector<double> sums_;  ///< sums of kernels with the points already taken
    std::vector<bool> taken_;
    std::vector<double> means_;
    std::vector<double> own_;
    std::size_t chosen_ = 0;
};

}  // namespace

std::vector<double> in_even_order(const std::vector<double>& rows, std::size_t dimension,
                                  std::size_t kept, l2::Kind kind, const l2::AxisWeights& weights,
                                  const RunContext& run) {
    Greedy greedy(rows, dimension, factors_of(kind, weights, dimension));
    std::vector<double> ordered;
    const std::size_t n = rows.size() / dimension;
    for (std::size_t i = 0; i < n; ++i) {
        run.check_stop();
        const std::size_t next = i < kept ? i : greedy.next();
        greedy.take(next);
        const auto row = rows.begin() + static_cast<std::ptrdiff_t>(next * dimension);
        ordered.insert(ordered.end(), row, row + static_cast<std::ptrdiff_t>(dimension));
    }
    return ordered;
}

}  // namespace stipple::optimized
