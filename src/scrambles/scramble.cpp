// SPDX-License-Identifier: MIT
#include "scrambles/scramble.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/combinatorics/primes.hpp"

namespace stipple {
namespace {

constexpr std::uint32_t largest_base = 65536;

std::uint32_t base_of(double number, bool prime) {
    const bool whole = number >= 2 && number <= largest_base && number == std::floor(number);
    if (!whole)
        fail(ErrorKind::usage, "--base: {} is not a whole number in [2, {}]", format_number(number),
             largest_base);
    const auto base = static_cast<std::uint32_t>(number);
    if (prime && !is_prime(base))
        fail(ErrorKind::usage, "--base: {} is not a prime, as this scramble needs", base);
    return base;
}

}  // namespace

std::vector<std::uint32_t> bases_for(const std::vector<double>& given, std::size_t coordinates,
                                     bool prime) {
    if (given.size() != 1 && given.size() != coordinates)
        fail(ErrorKind::usage, "--base: {} numbers for {} coordinates; give one, or one for each",
             given.size(), coordinates);
    std::vector<std::uint32_t> bases;
    for (std::size_t k = 0; k < coordinates; ++k)
        bases.push_back(base_of(given[given.size() == 1 ? 0 : k], prime));
    return bases;
}

Randomization coordinate_wise(std::size_t dimension,
                              std::function<void(std::size_t, std::span<double>)> move) {
    return [dimension, move = std::move(move)](std::uint64_t, std::span<double> rows) {
        std::array<double, most_moved> column;
        const std::size_t count = rows.size() / dimension;
        for (std::size_t begin = 0; begin < count; begin += column.size()) {
            const std::size_t length = std::min(column.size(), count - begin);
            for (std::size_t k = 0; k < dimension; ++k) {
                double* x = rows.data() + begin * dimension + k;
                for (std::size_t i = 0; i < length; ++i) column[i] = x[i * dimension];
                move(k, std::span(column).first(length));
                for (std::size_t i = 0; i < length; ++i) x[i * dimension] = column[i];
            }
        }
    };
}

}  // namespace stipple
