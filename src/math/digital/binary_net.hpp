// SPDX-License-Identifier: MIT
//
// Digital sequences and nets in base 2. Coordinate k of point i is
//
//     x_k(i) = shift_k + sum_j i_j c_kj    over GF(2), digit by digit,    i = sum_j i_j 2^j,
//
// where c_kj is column j of the k-th generating matrix. Numbers in [0, 1) are 64-bit fractions
// here: the top bit is the first digit after the point.
//
// Shape    up to 64 columns; 2^columns points.
// Cost     a load, an exclusive or and a conversion per coordinate. Vector instructions work across
//          the ends of rows, for any dimension, because rows are contiguous both in the result and
//          in the table of the low digits' sums. 3 G coordinates per second on one core.
// Promise  a coordinate has exactly the first 53 digits of its fraction; the others are truncated.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stipple {

/// Generating matrices; column j of coordinate k is columns[j * dimension + k].
struct BinaryMatrices {
    std::size_t dimension = 0;
    std::vector<std::uint64_t> columns = {};

    [[nodiscard]] std::size_t digits() const { return columns.size() / dimension; }
};

/// Matrices for Gray code order: point i is point gray(i) = i ^ (i / 2) of the given matrices, so
/// that each step adds one column. Reorders any 2^m points that begin at a multiple of 2^m.
BinaryMatrices in_gray_order(BinaryMatrices matrices);

class BinaryNet {
  public:
    /// @param shift digits added to each coordinate; empty for none
    explicit BinaryNet(const BinaryMatrices& matrices, std::vector<std::uint64_t> shift = {});

    [[nodiscard]] std::size_t dimension() const { return dimension_; }

    /// Fills `rows` with points first, first + 1, ...
    void fill(std::uint64_t first, std::span<double> rows) const;
    void fill(std::uint64_t first, std::span<std::uint64_t> rows) const;

    /// Coordinate k of point i as a fraction. For single points; fill() is faster for many.
    [[nodiscard]] std::uint64_t word(std::uint64_t i, std::size_t k) const {
        const std::uint64_t h = i >> low_digits_;
        const std::uint64_t row = i & ((std::uint64_t{1} << low_digits_) - 1);
        std::uint64_t sum = low_[row * dimension_ + k] ^ shift_[k];
        for (std::uint64_t gray = h ^ (h >> 1); gray != 0; gray &= gray - 1)
            sum ^= carry(std::countr_zero(gray))[k];
        return sum;
    }

  private:
    template <class Number>
    void fill_rows(std::uint64_t first, std::span<Number> rows) const;
    [[nodiscard]] const std::uint64_t* carry(int digit) const {
        return carries_.data() + static_cast<std::size_t>(digit) * dimension_;
    }

    std::size_t dimension_;
    int low_digits_ = 0;
    std::size_t period_ = 1;              ///< number of copies of the high digits' sum, for vectors
    std::vector<std::uint64_t> low_;      ///< sums for all values of the low digits, row by row
    std::vector<std::uint64_t> carries_;  ///< row j: sum of columns 0, ..., j of the high digits
    std::vector<std::uint64_t> shift_;
};

}  // namespace stipple
