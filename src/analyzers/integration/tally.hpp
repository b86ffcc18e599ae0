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

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/arithmetic/double_double.hpp"

namespace stipple::analyzers {

class Tally {
  public:
    void add(double x) {
        carried(x);
        const double step = x - center_;
        count_ += 1;
        center_ += step / count_;
        const double rest = x - center_;
        const double square = step * rest;
        if (scale_ == 1 && square > 0x1p-800 && square < 0x1p800)
            squares_ += square;
        else if (step != 0)
            add_scaled(step, rest);
    }

    void add(const Tally& other) {
        if (other.count_ == 0) return;
        carried(other.sum_);
        carry_ += other.carry_;
        const double step = other.center_ - center_;
        const double both = count_ + other.count_;
        fit(std::max(std::abs(step), std::sqrt(other.squares_) / other.scale_));
        const double seen = step * scale_;
        squares_ += rescaled(other.squares_, scale_ / other.scale_) +
                    seen * seen * (count_ / both) * other.count_;
        center_ += step * (other.count_ / both);
        count_ = both;
    }

    [[nodiscard]] double count() const { return count_; }
    [[nodiscard]] double mean() const { return (sum_ + carry_) / count_; }

    /// Unbiased variance; needs at least two numbers. May leave float64.
    [[nodiscard]] double variance() const { return squares_ / (count_ - 1) / scale_ / scale_; }

    /// Square root of the variance, which never leaves float64.
    [[nodiscard]] double deviation() const { return std::sqrt(squares_ / (count_ - 1)) / scale_; }

    /// Standard error of the mean, if the numbers are independent.
    [[nodiscard]] double standard_error() const {
        return std::sqrt(squares_ / (count_ - 1) / count_) / scale_;
    }

  private:
    void carried(double x) {
        const DoubleDouble next = exact_sum(sum_, x);
        sum_ = next.high;
        carry_ += next.low;
    }

    void add_scaled(double step, double rest) {
        fit(std::abs(step));
        squares_ += (step * scale_) * (rest * scale_);
    }
    /// Rescales if the square of a deviation of this size would overflow, or vanish as the first.
    void fit(double size) {
        const double seen = size * scale_;
        if (seen < 0x1p400 && (seen > 0x1p-400 || squares_ > 0 || size == 0)) return;
        if (!(size <= std::numeric_limits<double>::max())) return;
        const double scale = std::ldexp(1.0, std::clamp(-std::ilogb(size), -600, 600));
        squares_ = rescaled(squares_, scale / scale_);
        scale_ = scale;
    }
    static double rescaled(double squares, double factor) {
        return squares > 0 ? squares * factor * factor : squares;
    }

    double count_ = 0;
    double sum_ = 0;
    double carry_ = 0;
    double center_ = 0;   ///< running mean
    double squares_ = 0;  ///< sum of squared deviations from the running mean, times scale_^2
    double scale_ = 1;    ///< a power of two; 1 unless squares would leave float64
};

}  // namespace stipple::analyzers
