// SPDX-License-Identifier: MIT
//
// Factor of the kernel on one axis, k or 1 + weight k, with coefficients of 113 bits:
//
//     own(x) + own(y) + product x y + distance |x - y|.
#pragma once

#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstddef>
#include <cstdint>

#include "math/arithmetic/double_double.hpp"
#include "math/l2/kinds.hpp"

namespace stipple::l2 {

using Quad = boost::multiprecision::cpp_bin_float_quad;

inline DoubleDouble to_double_double(const Quad& x) {
    const auto high = static_cast<double>(x);
    return {high, static_cast<double>(x - Quad(high))};
}

/// Ratio of the kind's kernel to the one in its record; 2 pi^2 for the diaphony, 1 for others.
inline Quad scale_of(Kind kind) {
    return kind == Kind::diaphony ? Quad("19.73920880217871723766898199975230227063")
                                  : Quad(record_of(kind).scale);
}

struct AxisFactor {
    using Curve = std::array<Quad, 4>;  ///< coefficients of 1, x, x^2, |x - 1/2|

    AxisFactor(Kind kind, bool alone, double weight) {
        const AxisKernel& k = record_of(kind).kernel;
        const Quad one = alone ? 0 : 1;
        const Quad unit = scale_of(kind) * weight / 48;
        own = {one / 2 + unit * k.s00 / 2, unit * k.s01, unit * k.s02, unit * k.s03};
        for (std::size_t i = 0; i < mean.size(); ++i) mean[i] = unit * k.mean[i];
        mean[0] += one;
        product = unit * k.s11;
        distance = unit * k.sigma;
        total = one + unit * k.total;
    }

    Curve own;
    Curve mean;  ///< mean of the factor over y
    Quad product;
    Quad distance;
    Quad total;  ///< mean of the factor over x and y
};

// Coordinates are stored as integer multiples of 2^-63.

inline constexpr unsigned fraction_bits = 63;

/// The multiple of 2^-63 nearest to x in [0, 1].
inline std::uint64_t fixed(double x) {
    const double scaled = x * 0x1p63;
    const auto whole = static_cast<std::uint64_t>(scaled);
    return scaled < 0x1p52 ? static_cast<std::uint64_t>(scaled + 0.5) : whole;
}

}  // namespace stipple::l2
