// SPDX-License-Identifier: MIT
//
// Scrambles of digits in any base. A coordinate is given by its digits behind the point, as those
// of a whole number, the least significant first: q stands for the radical inverse of q.
//
//     digital shift   y_j = x_j + s_j                               a random digit each
//     matrix          y_j = sum_(i <= j) l_ji x_i + s_j             l random, lower triangular,
//                                                                   units on the diagonal (b prime)
//     nested uniform  y_j = pi(x_j), a random permutation for each prefix x_1 ... x_(j-1)
//
// modulo b. A nested permutation is made so: pi(0) is drawn, and the other digits follow it,
// cyclically, in the order of hashes of prefix and digit. Behind the last digit of q all digits are
// zeros, so their images are the digits of one uniform number, a hash of q: no digit is left out.
//
// Shape    q below 2^53; base in [2, 65536].
// Cost     of nested scrambling: O(b) a digit, eight at a time; O(b log b) to begin with.
// Promise  shift and matrix give whole multiples of b^-K, correctly rounded, with K = digits_of(b).
//          A nested image is in the interior of its interval of length b^-L, L being the digits of
//          q. In base 2 it is that of BinaryOwen. All are below 1.
// Source   as math/digital/binary_scramble.hpp
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/digital/binary_scramble.hpp"

namespace stipple {

/// The most digits of which every multiple of base^-K is found again from its rounded double.
std::size_t digits_of(std::uint32_t base);

/// The whole number whose reversed digits are those of x in [0, 1]: of the nearest multiple of
/// base^-K. So the radical inverse of q < base^K gives q.
std::uint64_t reversed_digits(double x, std::uint32_t base);

class BaseShift {
  public:
    BaseShift(std::uint64_t seed, std::size_t coordinate, std::uint32_t base);
    [[nodiscard]] double of(std::uint64_t reversed) const;

    /// What is added to each digit.
    [[nodiscard]] std::span<const std::uint32_t> shift() const { return shift_; }

  private:
    std::uint32_t base_;
    std::vector<std::uint32_t> shift_;
};

class BaseMatrix {
  public:
    BaseMatrix(std::uint64_t seed, std::size_t coordinate, std::uint32_t base);
    [[nodiscard]] double of(std::uint64_t reversed) const;

    /// Digit `row` of the image of digit `column` being 1; column <= row < digits_of(base).
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

    /// The image of the radical inverse of `reversed`.
    [[nodiscard]] double of(std::uint64_t reversed) const;

    /// out[j * stride] = of(first + j) for j < count, much faster.
    void fill(std::uint64_t first, std::size_t count, double* out, std::size_t stride) const;

    /// Keys of the hash of a prefix.
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
    std::array<std::uint64_t, 64> powers_;  ///< of the base, modulo 2^64
    std::uint64_t block_ = 1;               ///< b^t, the number of values that t low digits have
    std::size_t low_digits_ = 0;            ///< t
    std::vector<std::uint64_t> images_;     ///< of all t low digits, as whole numbers
    std::vector<std::size_t> lengths_;      ///< digits of q < b^t
    std::vector<double> short_;             ///< of(q) for q < b^t
};

}  // namespace stipple
