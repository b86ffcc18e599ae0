// SPDX-License-Identifier: MIT
//
// Digital sequences in a prime base b. With the digits a_0, a_1, ... of index i, lowest first,
// coordinate k of point i is
//
//     x = sum_r y_r b^(-r-1)    where    y = C_k a  mod b,
//
// and C_k is its generating matrix. The step from i to i + 1 adds the sum of the columns 0, ..., t
// of C_k to y, digit by digit modulo b, where t is the number of trailing digits b - 1 of i. These
// sums are tabulated for all t. Digits are packed into words with at least four bits each, so that
// all digits of a word are added and reduced at once. A word becomes a number by joining
// neighbouring digits, then neighbouring pairs of digits, and so on.
//
// Shape    prime b <= 65521; indices below b^columns; only the first digits_of(b) rows are used,
//          because scrambles cannot recover more digits from a double.
// Cost     one word per coordinate and point for upper triangular matrices, up to four for others;
//          about four nanoseconds per word. Memory: a few columns per coordinate.
// Promise  y is exact, and x its nearest double; never 1.
// Source   H. Niederreiter, Random Number Generation and Quasi-Monte Carlo Methods, SIAM 1992,
//          section 4.3, doi:10.1137/1.9781611970081.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace stipple {

/// A generating matrix of integers below the base. Column j belongs to digit j of the index, lowest
/// first; row r belongs to digit r after the point.
struct DigitMatrix {
    std::size_t rows = 0;
    std::size_t columns = 0;
    std::vector<std::uint32_t> digits;  ///< row after row

    DigitMatrix() = default;
    DigitMatrix(std::size_t row_count, std::size_t column_count)
        : rows(row_count), columns(column_count), digits(row_count * column_count) {}

    std::uint32_t& at(std::size_t row, std::size_t column) {
        return digits[row * columns + column];
    }
    [[nodiscard]] std::uint32_t at(std::size_t row, std::size_t column) const {
        return digits[row * columns + column];
    }
    bool operator==(const DigitMatrix&) const = default;
};

class BaseNet {
  public:
    static constexpr std::uint32_t largest_base = 65521;
    static constexpr std::size_t most_words = 4;
    using Words = std::array<std::uint64_t, most_words>;

    /// @param rows, columns size of every matrix; at least 1
    BaseNet(std::uint32_t base, std::size_t rows, std::size_t columns);

    /// Adds a coordinate. The digits `shift`, if any, are added to its digits in all points.
    void append(const DigitMatrix& matrix, std::span<const std::uint32_t> shift = {});

    [[nodiscard]] std::size_t dimension() const { return coordinates_.size(); }

    /// Fills `rows` with points first, first + 1, ...
    void fill(std::uint64_t first, std::span<double> rows) const;

  private:
    struct Coordinate {
        Words origin{};  ///< digits of point 0
        std::vector<Words> columns;
        std::vector<Words> steps;  ///< steps[t] = sum of columns 0, ..., t
        std::size_t active = 1;    ///< words that change within a block
    };

    [[nodiscard]] Words pack(std::span<const std::uint32_t> digits, std::size_t stride) const;
    void add(Words& sum, const Words& term) const;
    [[nodiscard]] Words at(const Coordinate& coordinate, std::uint64_t index) const;
    void stretch(const Coordinate& coordinate, std::uint64_t first, std::size_t count, double* out,
                 std::size_t stride) const;

    std::uint32_t base_;
    std::size_t rows_;
    std::size_t columns_;
    unsigned width_ = 4;               ///< bits per digit
    std::size_t words_ = 1;            ///< number of words per coordinate
    Words scales_{};                   ///< factor of each word's number in units of b^-rows
    double whole_ = 1;                 ///< b^rows
    std::uint64_t block_ = 1;          ///< number of consecutive indices with the same high digits
    std::size_t low_digits_ = 0;       ///< b^low_digits = block
    std::vector<std::uint8_t> ruler_;  ///< trailing zeros of 1, ..., block - 1 in base b
    std::vector<Coordinate> coordinates_;
};

}  // namespace stipple
