// SPDX-License-Identifier: MIT
//
// Squared maximum mean discrepancy of points x_1, ..., x_n from a target, by sums over all pairs:
//
//     squared = total - 2/n sum_i mean(x_i) + n^-2 sum_i sum_k K(x_i, x_k)        (known mean)
//     squared = m^-2 sum K(y, y') - 2/(n m) sum K(x, y) + n^-2 sum K(x, x')       (points y)
//
// Values of K are rounded to multiples of 2^-70 times their upper bound. These are added, and the
// terms combined, as integers, so that the result is rounded only once.
//
// Cost    n^2 / 2 values of K, plus m^2 / 2 + n m for target points y; O(n + m) memory.
// Promise the same result for any number of threads and any order of the points; 0 if points and
//         target points are equal.

#include "math/kernels/kernel.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "core/machine/wide.hpp"
#include "core/parallel.hpp"

namespace stipple::kernels {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// Binary places of the upper parts of values below 1: sums of 2^37 of them fit 64 bits.
constexpr int high_places = 26;
/// Binary places of the remainders. These are at most 2^43 units: sums of 2^20 fit 64 bits.
constexpr int low_places = 70;

/// Sum of numbers x, |x| <= 2^exponent, in multiples of 2^(exponent - low_places).
class FixedSum {
  public:
    explicit FixedSum(int exponent) : scale_(std::ldexp(1.0, -exponent)) {}

    /// Adds the sum of up to `tile` values, multiplied by `times`.
    void add(const double* values, std::size_t count, unsigned times) {
        std::array<std::uint64_t, 2> parts = parts_of(values, count, scale_);
        const auto high = static_cast<Int128>(std::bit_cast<std::int64_t>(parts[0]));
        const auto low = static_cast<Int128>(std::bit_cast<std::int64_t>(parts[1]));
        sum_ += times * (high * (std::int64_t{1} << (low_places - high_places)) + low);
    }
    void add(double value) { add(&value, 1, 1); }
    void add(const FixedSum& other) { sum_ += other.sum_; }

    [[nodiscard]] Integer value() const { return Integer(sum_); }

  private:
    /// Splits values into multiples of 2^-high_places and remainders in multiples of 2^-low_places,
    /// and sums both. Adding 1.5 * 2^52 units puts the nearest integer into a double's low bits.
    STIPPLE_WIDE static std::array<std::uint64_t, 2> parts_of(const double* values,
                                                              std::size_t count, double scale) {
        const double high_round = std::ldexp(1.5, 52 - high_places);
        const double low_round = std::ldexp(1.5, 52 - low_places);
        std::uint64_t high_sum = 0;
        std::uint64_t low_sum = 0;
        for (std::size_t j = 0; j < count; ++j) {
            const double value = values[j] * scale;
            const double high = value + high_round;
            const double low = (value - (high - high_round)) + low_round;
            high_sum += std::bit_cast<std::uint64_t>(high);
            low_sum += std::bit_cast<std::uint64_t>(low);
        }
        return {high_sum - count * std::bit_cast<std::uint64_t>(high_round),
                low_sum - count * std::bit_cast<std::uint64_t>(low_round)};
    }

    double scale_;
    Int128 sum_ = 0;
};

constexpr std::size_t rows_at_once = 64;

/// Sum of K over a block of rows and all columns. If rows and columns are the same points, each row
/// takes only the columns up to itself, and counts all of them except the diagonal twice.
class BlockSum {
  public:
    BlockSum(const Kernel& kernel, const Columns& rows, const Columns& columns, int exponent)
        : kernel_(kernel), rows_(rows), columns_(columns), sum_(exponent) {}

    FixedSum over(const Block& block, bool same, const RunContext& run) {
        const std::size_t width = rows_.width();
        std::vector<double> points(rows_at_once * width);
        for (std::size_t i = block.first; i < block.last; ++i)
            rows_.row(i, &points[(i - block.first) * width]);
        const std::size_t end = same ? block.last : columns_.count();
        for (std::size_t first = 0; first < end; first += tile) {
            run.check_stop();
            for (std::size_t i = block.first; i < block.last; ++i)
                add_tile(i, &points[(i - block.first) * width], first, same);
        }
        return sum_;
    }

  private:
    void add_tile(std::size_t i, const double* row, std::size_t first, bool same) {
        const std::size_t end =
            same ? std::min(i + 1, first + tile) : std::min(columns_.count(), first + tile);
        if (end <= first) return;
        const std::size_t count = end - first;
        kernel_.fill(row, columns_, first, count, values_.data());
        const bool diagonal = same && end == i + 1;
        sum_.add(values_.data(), diagonal ? count - 1 : count, same ? 2 : 1);
        if (diagonal) sum_.add(kernel_.diagonal(row));
    }

    const Kernel& kernel_;
    const Columns& rows_;
    const Columns& columns_;
    FixedSum sum_;
    std::array<double, tile> values_{};
};

Integer pair_sum(const Kernel& kernel, const Columns& rows, const Columns& columns, int exponent,
                 const RunContext& run) {
    const bool same = &rows == &columns;
    std::vector<FixedSum> parts(block_count(rows.count(), rows_at_once), FixedSum(exponent));
    for_each_block(run, rows.count(), rows_at_once, [&](const Block& block) {
        parts[block.index] = BlockSum(kernel, rows, columns, exponent).over(block, same, run);
    });
    FixedSum sum(exponent);
    for (const FixedSum& part : parts) sum.add(part);
    return sum.value();
}

/// Sum of the kernel's means at the points.
Integer mean_sum(const Kernel& kernel, const Columns& points, int exponent, const RunContext& run) {
    std::vector<FixedSum> parts(block_count(points.count(), rows_at_once), FixedSum(exponent));
    for_each_block(silent(run), points.count(), rows_at_once, [&](const Block& block) {
        std::vector<double> row(points.width());
        for (std::size_t i = block.first; i < block.last; ++i) {
            points.row(i, row.data());
            parts[block.index].add(kernel.mean(row.data()));
        }
    });
    FixedSum sum(exponent);
    for (const FixedSum& part : parts) sum.add(part);
    return sum.value();
}

/// Largest and mean K(x, x) of some points; |K(x, y)| never exceeds the largest.
struct Diagonal {
    double largest = 0;
    double mean = 0;

    Diagonal(const Kernel& kernel, const Columns& points) {
        std::vector<double> row(points.width());
        for (std::size_t i = 0; i < points.count(); ++i) {
            points.row(i, row.data());
            const double value = kernel.diagonal(row.data());
            largest = std::max(largest, value);
            mean += value / static_cast<double>(points.count());
        }
        if (!(largest < 0x1p900))
            fail(ErrorKind::limit, "values of the kernel are too large for float64");
    }
};

/// Exponent e so that 2^e exceeds all values of K and means, with headroom for rounding.
int exponent_above(double largest) { return std::ilogb(std::max(largest, 0x1p-900)) + 2; }

/// numerator / denominator in units of 2^(exponent - low_places), rounded to about 60 bits.
double quotient(const Integer& numerator, const Integer& denominator, int exponent) {
    const Integer size = abs(numerator);
    if (size == 0) return 0;
    const int shift = 64 + static_cast<int>(msb(denominator)) - static_cast<int>(msb(size));
    const Integer whole = shift >= 0 ? Integer((size << shift) / denominator)
                                     : Integer((size >> -shift) / denominator);
    const double value = std::ldexp(static_cast<double>(whole), exponent - low_places - shift);
    return numerator < 0 ? -value : value;
}

}  // namespace

SquaredDiscrepancy squared_from_mean(const Kernel& kernel, const Columns& points,
                                     const RunContext& run) {
    const Diagonal diagonal(kernel, points);
    const int exponent = exponent_above(std::max(diagonal.largest, kernel.total()));
    FixedSum total(exponent);
    total.add(kernel.total());
    const Integer n = points.count();
    const Integer means = mean_sum(kernel, points, exponent, run);
    const Integer pairs = pair_sum(kernel, points, points, exponent, run);
    const Integer numerator = n * n * total.value() - 2 * n * means + pairs;
    const double known = kernel.mean_diagonal();
    return {quotient(numerator, n * n, exponent),
            4 * kernel.rounding() * std::max(diagonal.largest, kernel.total()),
            ((known > 0 ? known : diagonal.mean) - kernel.total()) /
                static_cast<double>(points.count())};
}

SquaredDiscrepancy squared_from_points(const Kernel& kernel, const Columns& points,
                                       const Columns& target, const RunContext& run) {
    const Diagonal mine(kernel, points);
    const Diagonal others(kernel, target);
    const double largest = std::max(mine.largest, others.largest);
    const int exponent = exponent_above(largest);
    const auto n = static_cast<double>(points.count());
    const auto m = static_cast<double>(target.count());
    const double work = n * n / 2 + n * m + m * m / 2;
    const double first = n * n / 2 / work;
    const double second = first + n * m / work;
    const Integer own = pair_sum(kernel, points, points, exponent, run.stage(0, first));
    const Integer cross = pair_sum(kernel, points, target, exponent, run.stage(first, second));
    const Integer theirs = pair_sum(kernel, target, target, exponent, run.stage(second, 1));
    const Integer of_points = points.count();
    const Integer of_target = target.count();
    const Integer numerator = of_target * of_target * own - 2 * of_points * of_target * cross +
                              of_points * of_points * theirs;
    const Integer both = of_points * of_target;
    return {quotient(numerator, both * both, exponent), 4 * kernel.rounding() * largest,
            (others.mean - quotient(theirs, of_target * of_target, exponent)) / n};
}

}  // namespace stipple::kernels
