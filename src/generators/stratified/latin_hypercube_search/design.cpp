// SPDX-License-Identifier: MIT
#include "generators/stratified/latin_hypercube_search/design.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "core/rng.hpp"
#include "math/combinatorics/order.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"

namespace stipple::latin_hypercube_search {

namespace {

struct Lattice {
    std::size_t size = 1;
    std::vector<std::size_t> vector = {};
};

/// Minimum squared distance of two points on the torus, in levels.
double least_square(const Lattice& lattice) {
    double least = 0x1p62;
    for (std::size_t i = 1; i <= lattice.size / 2; ++i) {
        double square = 0;
        for (const std::size_t z : lattice.vector) {
            const std::size_t there = i * z % lattice.size;
            const auto gap = static_cast<double>(std::min(there, lattice.size - there));
            square += gap * gap;
        }
        least = std::min(least, square);
    }
    return least;
}

/// Estimate of the minimum squared distance, in levels, after a lattice is cut to n points.
double promise_of(const Lattice& lattice, std::size_t points) {
    if (lattice.size <= points + 1) return least_square(lattice);
    const auto d = static_cast<double>(lattice.vector.size());
    const double ratio = static_cast<double>(points) / static_cast<double>(lattice.size);
    return least_square(lattice) * exponential(logarithm(ratio) * 2 * (d - 1) / d);
}

Lattice drawn(std::size_t size, std::size_t dimension, SplitMix64& draws) {
    Lattice lattice{.size = size, .vector = {1}};
    while (lattice.vector.size() < dimension) {
        const std::size_t z = 1 + draws.below(lattice.size);
        if (std::gcd(z, lattice.size) == 1) lattice.vector.push_back(z);
    }
    return lattice;
}

/// Random lattice with the largest promise_of(): of many of size n + 1, or of a few of any size.
Lattice chosen(std::size_t points, std::size_t dimension, SplitMix64& draws) {
    const bool next = draws.below(3) == 0;
    const int tries = next ? 300 : 20;
    Lattice best;
    double promise = -1;
    for (int i = 0; i < tries; ++i) {
        const std::size_t size = points + (next ? 1 : draws.below(points / 3 + 2));
        Lattice lattice = drawn(size, dimension, draws);
        const double own = promise_of(lattice, points);
        if (own <= promise) continue;
        best = std::move(lattice);
        promise = own;
    }
    return best;
}

/// Indices of the `points` points nearest to the middle, by a maximum norm with random weights.
std::vector<std::size_t> middle_of(const std::vector<std::size_t>& x, std::size_t points,
                                   std::size_t dimension, SplitMix64& draws) {
    const std::size_t size = x.size() / dimension;
    std::vector<std::size_t> order(size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    if (size == points + 1) return {order.begin() + 1, order.end()};  // all except the corner
    std::vector<double> weights(dimension, 1);
    for (double& weight : weights)
        if (draws.below(2) == 0) weight = to_unit(draws.next());
    std::vector<double> off(size);
    for (std::size_t i = 0; i < size; ++i)
        for (std::size_t k = 0; k < dimension; ++k) {
            const auto twice = static_cast<double>(2 * x[i * dimension + k]);
            off[i] = std::max(off[i], weights[k] * std::abs(twice - static_cast<double>(size - 1)));
        }
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return off[i]; });
    order.resize(points);
    return order;
}

}  // namespace

Axis even_parts(std::size_t points, Level parts) {
    if (parts == 0) return {};
    Axis axis{.places = std::vector<Level>(points), .parts = parts};
    const auto n = static_cast<std::int64_t>(points);
    const std::int64_t m = parts;
    for (std::int64_t level = 0; level < n; ++level)
        axis.places[static_cast<std::size_t>(level)] =
            static_cast<Level>((n * (2 * ((2 * level + 1) * m / (2 * n)) + 1) - m) / (2 * m));
    return axis;
}

Axis parts_by(std::span<const double> outcomes, bool categories) {
    const std::size_t n = outcomes.size();
    Axis axis{.places = std::vector<Level>(n)};
    double same = 0;  // pairs of levels with the same outcome
    for (std::size_t first = 0, last = 0; first < n; first = last) {
        while (last < n && outcomes[last] == outcomes[first]) ++last;
        std::fill(&axis.places[first], &axis.places[first] + (last - first),
                  static_cast<Level>((first + last - 1) / 2));
        ++axis.parts;
        const auto size = static_cast<double>(last - first);
        same += size * (size - 1) / 2;
    }
    const auto count = static_cast<double>(n);
    const double pairs = count * (count - 1) / 2;
    if (categories && axis.parts > 1)
        axis.apart = static_cast<Level>(
            std::min(std::round(count * (count + 1) / 6 * pairs / (pairs - same)), count * count));
    return axis;
}

Design lattice_start(std::size_t points, std::size_t dimension, SplitMix64& draws) {
    const Lattice best = chosen(points, dimension, draws);
    const bool moved = best.size != points + 1;
    std::vector<std::size_t> x(best.size * dimension);
    for (std::size_t k = 0; k < dimension; ++k) {
        const std::size_t shift = moved ? draws.below(best.size) : 0;
        for (std::size_t i = 0; i < best.size; ++i)
            x[i * dimension + k] = (i * best.vector[k] + shift) % best.size;
    }
    const auto kept = middle_of(x, points, dimension, draws);
    Design design(points, points, dimension);
    for (std::size_t k = 0; k < dimension; ++k) {
        const auto order =
            order_by(points, [&](std::uint32_t i) { return x[kept[i] * dimension + k]; });
        for (std::size_t level = 0; level < points; ++level)
            design.along(k)[order[level]] = static_cast<Level>(level);
    }
    return design;
}

}  // namespace stipple::latin_hypercube_search
