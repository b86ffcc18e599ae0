// SPDX-License-Identifier: MIT
//
// Mean and variance of numbers that are added one by one or in blocks.
//
// Promise the mean is that of a compensated sum (Neumaier); it is the same for the same blocks in
//         the same order.
// Source  A. Neumaier, Zeitschrift fuer Angewandte Mathematik und Mechanik 54 (1974) 39-51.
//         T. F. Chan, G. H. Golub, R. J. LeVeque, The American Statistician 37 (1983) 242-247
//         (merging of variances), doi:10.1080/00031305.1983.10483115.
#pragma once

#include <cmath>

#include "math/arithmetic/double_double.hpp"

namespace stipple::analyzers {

class Tally {
  public:
    void add(double x) {
        carried(x);
        const double step = x - center_;
        count_ += 1;
        center_ += step / count_;
        squares_ += step * (x - center_);
    }

    void add(const Tally& other) {
        if (other.count_ == 0) return;
        carried(other.sum_);
        carry_ += other.carry_;
        const double step = other.center_ - center_;
        const double both = count_ + other.count_;
        squares_ += other.squares_ + step * step * (count_ / both) * other.count_;
        center_ += step * (other.count_ / both);
        count_ = both;
    }

    [[nodiscard]] double count() const { return count_; }
    [[nodiscard]] double mean() const { return (sum_ + carry_) / count_; }

    /// Unbiased variance; needs at least two numbers.
    [[nodiscard]] double variance() const { return squares_ / (count_ - 1); }

    /// Standard error of the mean, if the numbers are independent.
    [[nodiscard]] double standard_error() const { return std::sqrt(variance() / count_); }

  private:
    void carried(double x) {
        const DoubleDouble next = exact_sum(sum_, x);
        sum_ = next.high;
        carry_ += next.low;
    }

    double count_ = 0;
    double sum_ = 0;
    double carry_ = 0;
    double center_ = 0;   ///< running mean
    double squares_ = 0;  ///< sum of squared deviations from the running mean
};

}  // namespace stipple::analyzers
