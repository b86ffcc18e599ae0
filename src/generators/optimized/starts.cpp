// SPDX-License-Identifier: MIT
#include "generators/optimized/starts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rng.hpp"
#include "stipple/generate.hpp"

namespace stipple::optimized {
namespace {

double turned(double x) { return std::min(x - std::floor(x), one_minus_ulp); }

/// Part of a lattice's squared wraparound discrepancy that depends on its vector.
double wraparound_sum(std::size_t count, const std::vector<std::size_t>& vector) {
    std::vector<std::size_t> at(vector.size());
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) {
        double product = 1;
        for (std::size_t j = 0; j < vector.size(); ++j) {
            const double x = static_cast<double>(at[j]) / static_cast<double>(count);
            product *= 1.5 - x * (1 - x);
            at[j] = (at[j] + vector[j]) % count;
        }
        sum += product;
    }
    return sum;
}

/// Number of random vectors to try: grows with the number of distinct ones, so that few repeat.
std::size_t vectors_to_draw(std::size_t count, std::size_t dimension) {
    double all = 1;
    for (std::size_t j = 1; j < dimension; ++j) all *= static_cast<double>(count);
    return static_cast<std::size_t>(std::clamp(all / 50, 10.0, 1000.0));
}

}  // namespace

std::vector<double> golden_rows(std::size_t count, std::size_t dimension, SplitMix64& draws) {
    constexpr double step = 0.61803398874989485;
    const double shift[] = {to_unit(draws.next()), to_unit(draws.next())};
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i) {
        const auto at = static_cast<double>(i);
        if (dimension == 2) rows.push_back((at + shift[0]) / static_cast<double>(count));
        rows.push_back(turned(at * step + shift[1]));
    }
    return rows;
}

std::vector<double> rank1_rows(std::size_t count, std::span<const std::size_t> vector,
                               std::span<const double> shift) {
    const auto n = static_cast<double>(count);
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < vector.size(); ++j)
            rows.push_back(turned(static_cast<double>(i * vector[j] % count) / n + shift[j]));
    return rows;
}

std::vector<double> lattice_rows(std::size_t count, std::size_t dimension, SplitMix64& draws,
                                 const RunContext& run) {
    std::vector<std::size_t> best;
    double least = std::numeric_limits<double>::infinity();
    std::vector<std::size_t> vector(dimension, 1);
    for (std::size_t k = vectors_to_draw(count, dimension); k > 0; --k) {
        run.check_stop();
        for (std::size_t j = 1; j < dimension; ++j) vector[j] = draws.below(count);
        const double sum = wraparound_sum(count, vector);
        if (sum >= least) continue;
        least = sum;
        best = vector;
    }
    std::vector<double> shift;
    while (shift.size() < dimension) shift.push_back(to_unit(draws.next()));
    return rank1_rows(count, best, shift);
}

std::vector<double> net_rows(std::size_t count, std::size_t dimension, SplitMix64& draws) {
    const double shift = to_unit(draws.next());
    const PointSet net = generate(
        "sobol:scramble=owen", {.count = count, .dimension = dimension - 1, .seed = draws.next()});
    std::vector<double> rows;
    for (std::size_t i = 0; i < count; ++i) {
        rows.push_back((static_cast<double>(i) + shift) / static_cast<double>(count));
        rows.insert(rows.end(), net[i].begin(), net[i].end());
    }
    return rows;
}

}  // namespace stipple::optimized
