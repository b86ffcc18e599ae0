// SPDX-License-Identifier: MIT
//
// Kernels of L2 discrepancies in numbers of 113 bits.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdint>
#include <cstdlib>

#include "analyzers/l2/l2_kind.hpp"
#include "math/functions/double_double.hpp"

namespace stipple::analyzers::l2 {

using Quad = boost::multiprecision::cpp_bin_float_quad;

inline DoubleDouble to_double_double(const Quad& x) {
    const auto high = static_cast<double>(x);
    return {high, static_cast<double>(x - Quad(high))};
}

/// The factor of an axis, 1 + w k or k alone, in its terms of x, x^2, |x - 1/2|, x y and |x - y|.
class AxisTerms {
  public:
    AxisTerms(const KindRecord& record, bool alone, double weight)
        : kernel_(record.kernel), one_(alone ? 0 : 1), unit_(Quad(record.scale) * weight / 48) {
        for (std::size_t i = 0; i < mean_.size(); ++i) mean_[i] = coefficient(kernel_.mean[i]);
        mean_[0] += one_;
    }

    [[nodiscard]] Quad product() const { return coefficient(kernel_.s11); }
    [[nodiscard]] Quad distance() const { return coefficient(kernel_.sigma); }

    /// The part of the factor that belongs to a point.
    [[nodiscard]] Quad own(double x) const {
        const Quad q = x;
        return (one_ + coefficient(kernel_.s00)) / 2 + coefficient(kernel_.s01) * q +
               coefficient(kernel_.s02) * q * q + coefficient(kernel_.s03) * abs(Quad(q - 0.5));
    }

    /// Mean of the factor over the other point.
    [[nodiscard]] Quad mean(double x) const {
        const Quad q = x;
        Quad mean = mean_[0];
        if (kernel_.mean[2] != 0)
            mean += (mean_[2] * q + mean_[1]) * q;
        else if (kernel_.mean[1] != 0)
            mean += mean_[1] * q;
        if (kernel_.mean[3] != 0) mean += mean_[3] * abs(Quad(q - 0.5));
        return mean;
    }

    /// The mean as a sum of these times 1, x, x^2 and |x - 1/2|.
    [[nodiscard]] const std::array<Quad, 4>& mean_terms() const { return mean_; }

    [[nodiscard]] Quad total() const { return one_ + coefficient(kernel_.total); }

    /// More than all terms of a factor together.
    [[nodiscard]] double terms() const {
        const std::int64_t all = std::abs(kernel_.s00) + 2 * std::abs(kernel_.s01) +
                                 2 * std::abs(kernel_.s02) + std::abs(kernel_.s03) +
                                 std::abs(kernel_.s11) + std::abs(kernel_.sigma);
        return static_cast<double>(one_ + coefficient(all));
    }

    /// The largest factor of the kinds for which that is the one of two equal points.
    [[nodiscard]] double most() const {
        return static_cast<double>(one_ + coefficient(kernel_.s00));
    }

  private:
    [[nodiscard]] Quad coefficient(std::int64_t s) const { return unit_ * s; }

    AxisKernel kernel_;
    int one_;
    Quad unit_;
    std::array<Quad, 4> mean_;  ///< coefficients of mean()
};

}  // namespace stipple::analyzers::l2
