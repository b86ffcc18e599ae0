// SPDX-License-Identifier: MIT
//
// Sums of powers of rows of numbers, and the moments of a sample that they make.
//
//     S_p = sum (x - c)^p, p = 1..6, and for each pair of columns sum (x - c)^p (y - c')^q, p, q in
//     {1, 2}; c is near the mean, so that central moments lose little by cancellation.
//
// Promise each block's sums, and then the blocks' in their order with their rounding carried along
//         (Neumaier): the same for any number of threads.
// Source  A. Neumaier, Zeitschrift fuer Angewandte Mathematik und Mechanik 54 (1974) 39-51.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/run_context.hpp"

namespace stipple::analyzers {

/// Of a sample: per column, and for covariances per pair, row after row.
struct SampleMoments {
    std::vector<double> mean;
    std::vector<double> variance;  ///< unbiased
    std::vector<double> skewness;  ///< m3 / m2^(3/2); 0 where all numbers are the same
    std::vector<double> covariance;
};

/// With the standard error of each.
struct SampleAndErrors {
    SampleMoments value;
    SampleMoments error;
};

class MomentSums {
  public:
    /// Of columns, about these numbers.
    explicit MomentSums(std::vector<double> about);

    void add(std::span<const double> rows, const RunContext& run);

    /// Of at least two rows. @throws Error(limit) when powers are beyond the largest double
    [[nodiscard]] SampleAndErrors moments() const;

  private:
    [[nodiscard]] std::size_t width() const { return about_.size(); }
    [[nodiscard]] double sum(std::size_t i) const { return sums_[i] + carries_[i]; }
    /// Where the products of columns i < j begin: sums of x y, x^2 y, x y^2, x^2 y^2.
    [[nodiscard]] std::size_t pair(std::size_t i, std::size_t j) const;
    void add_block(std::span<const double> rows, std::span<double> sums) const;
    void take_block(std::span<const double> sums);
    void column(std::size_t k, SampleAndErrors& out) const;
    void cross(std::size_t i, std::size_t j, SampleAndErrors& out) const;

    std::vector<double> about_;
    std::uint64_t count_ = 0;
    std::vector<double> sums_;     ///< powers 1..6 of each column, then pairs
    std::vector<double> carries_;  ///< what rounding took from them
};

}  // namespace stipple::analyzers
