// SPDX-License-Identifier: MIT
//
// Default length scales of kernels.
//
// Source  the median heuristic: A. Gretton, K. M. Borgwardt, M. J. Rasch, B. Schoelkopf, A. Smola,
//         J. Mach. Learn. Res. 13 (2012) 723-773.

#include "math/kernels/kernel.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace stipple::kernels {
namespace {

/// Median; the mean of the two middle numbers if the count is even, 0 if there are no numbers.
double median_of(std::vector<double>& numbers) {
    if (numbers.empty()) return 0;
    const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
    std::ranges::nth_element(numbers, middle);
    if (numbers.size() % 2 != 0) return *middle;
    const double below = *std::max_element(numbers.begin(), middle);
    return below + (*middle - below) / 2;
}

}  // namespace

MedianDistance median_distance(const Columns& points, const Columns& others, std::size_t dimension,
                               const RunContext& run) {
    constexpr std::uint64_t most = std::uint64_t{1} << 22;
    constexpr std::size_t often = 65536;
    const std::uint64_t all = points.count() + others.count();
    MedianDistance median{.pairs = all * (all - 1) / 2};
    median.of_all = median.pairs <= most;
    if (!median.of_all) median.pairs = most;
    run.need_memory(8 * static_cast<double>(median.pairs), "the distances of pairs");
    std::vector<double> distances;
    distances.reserve(median.pairs);
    const auto add = [&](std::uint64_t i, std::uint64_t j) {
        if (distances.size() % often == 0) run.check_stop();
        double square = 0;
        for (std::size_t k = 0; k < dimension; ++k) {
            const auto at = [&](std::uint64_t row) {
                return row < points.count() ? points.axis(k)[row]
                                            : others.axis(k)[row - points.count()];
            };
            square += (at(i) - at(j)) * (at(i) - at(j));
        }
        distances.push_back(std::sqrt(square));
    };
    if (median.of_all) {
        for (std::uint64_t i = 0; i < all; ++i)
            for (std::uint64_t j = 0; j < i; ++j) add(i, j);
    } else {
        const Rng rng(1);
        for (std::uint64_t p = 0; p < most; ++p) {
            const std::uint64_t i = rng.below(2 * p, all);
            const std::uint64_t j = rng.below(2 * p + 1, all - 1);
            add(i, j + (j >= i ? 1 : 0));
        }
    }
    median.value = median_of(distances);
    return median;
}

double uniform_distance(std::size_t dimension) {
    return std::sqrt(static_cast<double>(dimension) / 6);
}

}  // namespace stipple::kernels
