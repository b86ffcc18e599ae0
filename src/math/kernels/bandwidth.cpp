// SPDX-License-Identifier: MIT
#include "math/kernels/bandwidth.hpp"

#include <algorithm>
#include <cmath>

namespace stipple::kernels {

double median_distance(const Columns& points, const Columns& others, std::size_t dimension) {
    constexpr std::size_t most = 1000;
    const std::size_t all = points.count() + others.count();
    const std::size_t some = std::min(all, most);
    std::vector<double> rows;
    for (std::size_t s = 0; s < some; ++s) {
        const std::size_t i = s * all / some;
        const bool mine = i < points.count();
        const Columns& from = mine ? points : others;
        for (std::size_t k = 0; k < dimension; ++k)
            rows.push_back(from.axis(k)[mine ? i : i - points.count()]);
    }
    std::vector<double> squares;
    for (std::size_t i = 0; i < some; ++i)
        for (std::size_t j = 0; j < i; ++j) {
            double square = 0;
            for (std::size_t k = 0; k < dimension; ++k) {
                const double u = rows[i * dimension + k] - rows[j * dimension + k];
                square += u * u;
            }
            squares.push_back(square);
        }
    if (squares.empty()) return 0;
    const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
    std::ranges::nth_element(squares, middle);
    return std::sqrt(*middle);
}

double uniform_distance(std::size_t dimension) {
    return std::sqrt(static_cast<double>(dimension) / 6);
}

}  // namespace stipple::kernels
