// SPDX-License-Identifier: MIT
//
// Scrambling of points that are there, number by number: what scrambled generators must agree with.
#pragma once

#include <bit>
#include <string_view>

#include "core/point_set.hpp"
#include "math/base_scramble.hpp"
#include "math/binary_scramble.hpp"

namespace stipple::testing {

inline double scrambled(double x, std::string_view scramble, std::uint32_t base, std::uint64_t seed,
                        std::size_t coordinate) {
    if (base != 2) {
        const std::uint64_t digits = mirrored_digits(x, base);
        if (scramble == "owen") return BaseOwen(seed, coordinate, base).of(digits);
        if (scramble == "matrix") return BaseMatrix(seed, coordinate, base).of(digits);
        return BaseShift(seed, coordinate, base).of(digits);
    }
    std::uint64_t fraction = unit_to_fraction(x);
    if (scramble == "owen") {
        BinaryOwen(seed, coordinate).apply({&fraction, 1});
        return fraction_to_unit(fraction);
    }
    std::uint64_t image = binary_shift(seed, coordinate);
    const auto columns = binary_matrix(seed, coordinate);
    for (std::size_t j = 0; j < 64; ++j)
        if ((fraction << j >> 63) != 0)
            image ^= scramble == "matrix" ? columns[j] : std::uint64_t{1} << (63 - j);
    return fraction_to_unit(image);
}

/// The points with every coordinate scrambled; base prime.
inline PointSet scrambled(PointSet points, std::string_view scramble, std::uint32_t base,
                          std::uint64_t seed) {
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < points.dimension(); ++k)
            points[i][k] = scrambled(points[i][k], scramble, base, seed, k);
    return points;
}

}  // namespace stipple::testing
