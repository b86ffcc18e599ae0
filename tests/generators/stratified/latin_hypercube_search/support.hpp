// SPDX-License-Identifier: MIT
//
// Designs for tests of the search, and the criteria by their definitions.
#pragma once

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "generators/stratified/latin_hypercube_search/criteria.hpp"
#include "math/combinatorics/splitmix64.hpp"

namespace stipple::testing {

using latin_hypercube_search::Axis;
using latin_hypercube_search::Design;
using latin_hypercube_search::even_parts;
using latin_hypercube_search::Kind;
using latin_hypercube_search::Level;
using latin_hypercube_search::Objective;
using latin_hypercube_search::parts_by;
using latin_hypercube_search::Rules;

inline constexpr Kind all_kinds[] = {Kind::maximin,     Kind::phi_p,  Kind::audze_eglais,
                                     Kind::centered_l2, Kind::maxpro, Kind::correlation};

inline Design random_design(std::size_t points, std::size_t dimension, std::uint64_t key) {
    Design design(points, points, dimension);
    SplitMix64 draws(key);
    for (std::size_t k = 0; k < dimension; ++k) {
        const auto levels = design.along(k);
        std::iota(levels.begin(), levels.end(), Level{0});
        for (std::size_t i = points; i > 1; --i) std::swap(levels[i - 1], levels[draws.below(i)]);
    }
    return design;
}

/// First coordinate 0, 1, ..., and these others, such as {2, 0, 1}.
inline Design design_of(const std::vector<std::vector<Level>>& others) {
    Design design(others[0].size(), others[0].size(), 1 + others.size());
    std::iota(design.along(0).begin(), design.along(0).end(), Level{0});
    for (std::size_t k = 0; k < others.size(); ++k)
        std::ranges::copy(others[k], design.along(k + 1).begin());
    return design;
}

/// Whether each level 0, ..., n - 1 occurs once along each coordinate.
inline bool is_latin(const Design& design) {
    for (std::size_t k = 0; k < design.dimension; ++k) {
        const auto along = design.along(k).first(design.points);
        std::vector<Level> levels(along.begin(), along.end());
        std::ranges::sort(levels);
        for (std::size_t l = 0; l < levels.size(); ++l)
            if (levels[l] != static_cast<Level>(l)) return false;
    }
    return true;
}

inline double square_of(const Design& design, std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t k = 0; k < design.dimension; ++k)
        sum += std::pow(design.along(k)[i] - design.along(k)[j], 2);
    return sum;
}

inline double correlation_of(const Design& design, std::size_t k, std::size_t l) {
    const auto n = static_cast<double>(design.points);
    double sum = 0;
    for (std::size_t i = 0; i < design.points; ++i)
        sum += (design.along(k)[i] - (n - 1) / 2) * (design.along(l)[i] - (n - 1) / 2);
    return 12 * sum / (n * (n * n - 1));
}

/// The criterion's value by its definition, to be minimized; the square for centered_l2.
inline double value_of(Kind kind, const Design& design, double p = 15) {
    const std::size_t n = design.points;
    const std::size_t d = design.dimension;
    const auto size = static_cast<double>(n);
    double sum = 0;
    double least = 1e300;
    const auto z = [&](std::size_t i, std::size_t k) {
        return (2.0 * design.along(k)[i] + 1) / (2 * size) - 0.5;
    };
    for (std::size_t i = 0; i < n; ++i) {
        double mean = 1;
        for (std::size_t k = 0; k < d; ++k)
            mean *= 1 + std::abs(z(i, k)) / 2 - z(i, k) * z(i, k) / 2;
        if (kind == Kind::centered_l2) sum -= 2 / size * mean;
        for (std::size_t j = 0; j < n; ++j) {
            double product = 1;
            double gaps = 1;
            for (std::size_t k = 0; k < d; ++k) {
                product *= 1 + std::abs(z(i, k)) / 2 + std::abs(z(j, k)) / 2 -
                           std::abs(z(i, k) - z(j, k)) / 2;
                gaps *= std::pow(z(i, k) - z(j, k), 2);
            }
            if (kind == Kind::centered_l2) sum += product / (size * size);
            if (j >= i) continue;
            const double square = square_of(design, i, j);
            least = std::min(least, square);
            if (kind == Kind::phi_p) sum += std::pow(square, -p / 2);
            if (kind == Kind::audze_eglais) sum += 1 / square;
            if (kind == Kind::maxpro) sum += 1 / gaps;
        }
    }
    if (kind == Kind::maximin) return -least;
    if (kind == Kind::phi_p) return std::pow(sum, 1 / p);
    if (kind == Kind::centered_l2) return sum + std::pow(13 / 12.0, d);
    if (kind == Kind::maxpro)
        return std::pow(sum / (size * (size - 1) / 2), 1 / static_cast<double>(d));
    if (kind == Kind::audze_eglais) return sum;
    double largest = 0;
    for (std::size_t k = 0; k < d; ++k)
        for (std::size_t l = 0; l < k; ++l)
            largest = std::max(largest, std::abs(correlation_of(design, k, l)));
    return largest;
}

}  // namespace stipple::testing
