// SPDX-License-Identifier: MIT
//
// Scrambling of points that are there, number by number: what scrambled generators must agree with.
#pragma once

#include <array>
#include <string_view>

#include "core/point_set.hpp"
#include "math/base_scramble.hpp"
#include "math/binary_scramble.hpp"

namespace stipple::testing {

namespace detail {

/// Coordinate k of all points, as image(x) makes it.
template <class Image>
void replace(PointSet& points, std::size_t k, const Image& image) {
    for (std::size_t i = 0; i < points.count(); ++i) points[i][k] = image(points[i][k]);
}

inline double binary_image(double x, std::uint64_t shift,
                           const std::array<std::uint64_t, 64>& columns) {
    const std::uint64_t fraction = unit_to_fraction(x);
    for (std::size_t j = 0; j < 64; ++j)
        if ((fraction << j >> 63) != 0) shift ^= columns[j];
    return fraction_to_unit(shift);
}

inline void scramble_binary(PointSet& points, std::string_view scramble, std::uint64_t seed,
                            std::size_t k) {
    if (scramble == "owen") {
        const BinaryOwen owen(seed, k);
        return replace(points, k, [&](double x) {
            std::uint64_t fraction = unit_to_fraction(x);
            owen.apply({&fraction, 1});
            return fraction_to_unit(fraction);
        });
    }
    auto columns = binary_matrix(seed, k);
    if (scramble == "digital-shift")
        for (std::size_t j = 0; j < 64; ++j) columns[j] = std::uint64_t{1} << (63 - j);
    replace(points, k, [&](double x) { return binary_image(x, binary_shift(seed, k), columns); });
}

}  // namespace detail

/// The points with every coordinate scrambled; base prime.
inline PointSet scrambled(PointSet points, std::string_view scramble, std::uint32_t base,
                          std::uint64_t seed) {
    const auto by = [&](const auto& kernel, std::size_t k) {
        detail::replace(points, k, [&](double x) { return kernel.of(mirrored_digits(x, base)); });
    };
    for (std::size_t k = 0; k < points.dimension(); ++k) {
        if (base == 2)
            detail::scramble_binary(points, scramble, seed, k);
        else if (scramble == "owen")
            by(BaseOwen(seed, k, base), k);
        else if (scramble == "matrix")
            by(BaseMatrix(seed, k, base), k);
        else
            by(BaseShift(seed, k, base), k);
    }
    return points;
}

}  // namespace stipple::testing
