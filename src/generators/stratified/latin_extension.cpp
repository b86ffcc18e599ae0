// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_extension.hpp"

#include <algorithm>

#include "math/combinatorics/splitmix64.hpp"

namespace stipple::generators {
namespace {

using latin_hypercube_search::Design;
using latin_hypercube_search::Level;

std::size_t stratum_of(double x, std::size_t count) {
    return std::min(static_cast<std::size_t>(x * static_cast<double>(count)), count - 1);
}

/// Number of given points in each stratum.
std::vector<std::size_t> held(const PointSet& given, std::size_t coordinate, std::size_t count) {
    std::vector<std::size_t> points(count);
    for (std::size_t i = 0; i < given.count(); ++i)
        ++points[stratum_of(given[i][coordinate], count)];
    return points;
}

}  // namespace

Design extended(const PointSet& given, std::size_t count, const Rng& rng) {
    const std::size_t d = given.dimension();
    std::vector<std::vector<Level>> empty(d);
    std::size_t rows = count;
    for (std::size_t k = 0; k < d; ++k) {
        const auto points = held(given, k, count);
        for (std::size_t l = 0; l < count; ++l)
            if (points[l] == 0) empty[k].push_back(static_cast<Level>(l));
        SplitMix64 draws(rng.bits(k));
        for (std::size_t l = empty[k].size(); l > 1; --l)
            std::swap(empty[k][l - 1], empty[k][draws.below(l)]);
        rows = std::max(rows, given.count() + empty[k].size());
    }
    Design design(count, rows, d);
    for (std::size_t k = 0; k < d; ++k) {
        const auto levels = design.along(k);
        for (std::size_t i = 0; i < given.count(); ++i)
            levels[i] = static_cast<Level>(stratum_of(given[i][k], count));
        std::ranges::copy(empty[k], levels.subspan(given.count()).begin());
    }
    return design;
}

std::size_t crowded_strata(const PointSet& given, std::size_t coordinate, std::size_t count) {
    return static_cast<std::size_t>(std::ranges::count_if(
        held(given, coordinate, count), [](std::size_t points) { return points > 1; }));
}

}  // namespace stipple::generators
