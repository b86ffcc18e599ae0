// SPDX-License-Identifier: MIT
#include "generators/digital/progressive.hpp"

#include <algorithm>

#include "math/functions/bits.hpp"

namespace stipple::generators {
namespace {

constexpr std::size_t lanes = 256;

/// Matrix times the digits of i.
std::uint64_t image(const ColumnMatrix& matrix, std::uint64_t i) {
    std::uint64_t sum = 0;
    for (std::size_t j = 0; i != 0; ++j, i >>= 1) sum ^= (i & 1) != 0 ? matrix[j] : 0;
    return sum;
}

}  // namespace

Progressive::Progressive(const Plan& plan, const ColumnMatrix& matrix)
    : matrix_(matrix), first_(plan.seed, 0), second_(plan.seed, 1) {
    for (std::size_t i = 0; i < low_.size(); ++i) low_[i] = image(matrix, i);
}

void Progressive::fill(std::uint64_t first, std::span<double> rows) {
    std::array<std::uint64_t, lanes> x;
    std::array<std::uint64_t, lanes> y;
    while (!rows.empty()) {
        // Up to the next multiple of 256, only the low digits of the index change.
        const std::size_t count = std::min<std::size_t>(rows.size() / 2, lanes - first % lanes);
        const std::uint64_t high_x = reversed_bits(first - first % lanes);
        const std::uint64_t high_y = image(matrix_, first - first % lanes);
        for (std::size_t j = 0; j < count; ++j) {
            x[j] = high_x | reversed_bits(first % lanes + j);
            y[j] = high_y ^ low_[first % lanes + j];
        }
        first_.apply({x.data(), count});
        second_.apply({y.data(), count});
        for (std::size_t j = 0; j < count; ++j) {
            rows[2 * j] = fraction_to_unit(x[j]);
            rows[2 * j + 1] = fraction_to_unit(y[j]);
        }
        rows = rows.subspan(2 * count);
        first += count;
    }
}

}  // namespace stipple::generators
