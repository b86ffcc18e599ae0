// SPDX-License-Identifier: MIT
//
// Scrambles of digits in any base b. A coordinate is given as the integer q whose radical inverse
// it is: the least significant digit of q is the first digit x_1 after the point.
//
//     digital shift   y_j = x_j + s_j                               s_j random digits
//     matrix          y_j = sum_(i <= j) l_ji x_i + s_j             l random, lower triangular,
//                                                                   units on the diagonal (b prime)
//     nested uniform  y_j = pi(x_j), a random permutation for each prefix x_1 ... x_(j-1)
//
// modulo b. A nested permutation has a random pi(0); the images of the other digits follow pi(0)
// cyclically, in the order of the hashes of prefix and digit. All digits after the last one of q
// are zeros, so their images are the digits of a single uniform number, a hash of q. In this way,
// all of the infinitely many digits are scrambled.
//
// Shape    q below 2^53; base in [2, 65536].
// Cost     nested scrambling: setup O(b log b), then O(b) per digit, vectorised over points.
// Promise  shift and matrix give integer multiples of b^-K, correctly rounded, with K =
//          digits_of(b). A nested image is in the interior of its interval of length b^-L, where L
//          is the number of digits of q. In base 2 it is the image by BinaryOwen. All results are
//          below 1.
// Source   as math/digital/binary_scramble.hpp
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/digital/binary_scramble.hpp"

namespace stipple {

/// The largest K such that every multiple of base^-K can be recovered from its rounded double.
std::size_t digits_of(std::uint32_t base);

/// The integer q < base^K whose radical inverse is the multiple of base^-K nearest to x in [0, 1],
/// but below 1; K = digits_of(base).
std::uint64_t reversed_digits(double x, std::uint32_t base);

class BaseShift {
  public:
    BaseShift(std::uint64_t seed, std::size_t coordinate, std::uint32_t base);
    [[nodiscard]] double of(std::uint64_t reversed) const;

    /// The digits that are added.
    [[nodiscard]] std::span<const std::uint32_t> shift() const { return shift_; }

  private:
    std::uint32_t base_;
    std::vector<std::uint32_t> shift_;
};

class BaseMatrix {
  public:
    BaseMatrix(std::uint64_t seed, std::size_t coordinate, std::uint32_t base);
    [[nodiscard]] double of(std::uint64_t reversed) const;

    /// Coefficient of input digit `column` in output digit `row`; column <= row < digits_of(base).
    [[nodiscard]] std::uint32_t entry(std::size_t row, std::size_t column) const {
        return rows_[row * shift_.size() + column];
    }
    [[nodiscard]] std::span<const std::uint32_t> shift() const { return shift_; }

  private:
    std::uint32_t base_;
    std::vector<std::uint32_t> rows_;
    std::vector<std::uint32_t> shift_;
};

/// Nested uniform (Owen) scrambling of one coordinate.
class BaseOwen {
  public:
    BaseOwen(std::uint64_t seed, std::size_t coordinate, std::uint32_t base);

    /// Image of the radical inverse of `reversed`.
    [[nodiscard]] double of(std::uint64_t reversed) const;

    /// Sets out[j * stride] = of(first + j) for j < count, much faster than one by one.
    void fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;

    /// Keys of the hashes of prefixes and digits.
    struct Keys {
        std::uint64_t before;
        std::uint64_t between;
        std::uint64_t digit;
    };

  private:
    struct Stretch;
    [[nodiscard]] std::vector<std::uint64_t> first_images() const;
    void fill_binary(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;
    void append_digit(const Stretch& stretch, std::uint64_t above, std::size_t depth,
                      std::uint32_t digit, std::uint64_t* image) const;
    void append_digits(std::size_t depth);
    void join(const Stretch& stretch, double* out, std::size_t stride) const;

    std::uint64_t base_;
    BinaryOwen binary_;
    Keys keys_;
    std::array<std::uint64_t, 64> powers_;  ///< powers of the base, modulo 2^64
    std::uint64_t block_ = 1;               ///< b^t, the number of values of the t low digits
    std::size_t low_digits_ = 0;            ///< t
    std::vector<std::uint64_t> images_;     ///< images of the t low digits, as integers
    std::vector<std::size_t> lengths_;      ///< number of digits of q < b^t
    std::vector<double> short_;             ///< of(q) for q < b^t
};

}  // namespace stipple
