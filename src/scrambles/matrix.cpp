// SPDX-License-Identifier: MIT
//
// Linear matrix scrambling: multiplies the vector of a coordinate's digits by a random nonsingular
// lower triangular matrix, one per coordinate, and adds a digital shift.
//
// Cost     O(n d) in base 2, O(n d K^2) in others, with K digits.
// Promise  keeps the (t,m,s)-net property in its base. The variance of an estimate is that of
//          nested uniform scrambling.
// Beware   as in digital-shift.
// Source   J. Matousek, J. Complexity 14 (1998) 527-556, doi:10.1006/jcom.1998.0489.

#include <array>
#include <bit>

#include "scrambles/digit_scramble.hpp"

namespace stipple::scrambles::matrix {
namespace {

constexpr Param<Numbers> base{{.name = "base",
                               .fallback = "2",
                               .help = "Base of the digits, a prime: one for all coordinates, or "
                                       "one for each; default: the generator's, else 2"}};

/// Product with a binary matrix plus a digital shift, from a table of 256 products for each byte.
class BinaryProduct {
  public:
    BinaryProduct(std::uint64_t seed, std::size_t coordinate)
        : shift_(binary_shift(seed, coordinate)), tables_(bytes) {
        const auto columns = binary_matrix(seed, coordinate);
        for (std::size_t byte = 0; byte < bytes; ++byte)
            for (std::size_t digits = 1; digits < 256; ++digits) {
                const auto lowest = static_cast<std::size_t>(std::countr_zero(digits));
                tables_[byte][digits] =
                    tables_[byte][digits & (digits - 1)] ^ columns[8 * byte + 7 - lowest];
            }
    }

    void apply(std::span<std::uint64_t> fractions) const {
        for (std::uint64_t& fraction : fractions) {
            std::uint64_t image = shift_;
            for (std::size_t byte = 0; byte < bytes; ++byte)
                image ^= tables_[byte][(fraction >> (56 - 8 * byte)) & 0xff];
            fraction = image;
        }
    }

  private:
    static constexpr std::size_t bytes = 7;  // enough for the 53 digits of a double
    std::uint64_t shift_;
    std::vector<std::array<std::uint64_t, 256>> tables_;
};

}  // namespace

Scramble unit() {
    return {.name = "matrix",
            .summary =
                "Linear matrix scrambling: a random lower triangular matrix times the digits, then "
                "a digital shift",
            .source = "Matousek 1998, doi:10.1006/jcom.1998.0489",
            .related = {"matousek", "affine"},
            .options = Schema(base, scramble_seed),
            .aliases = {"linear-matrix"},
            .stream_version = 2,
            .make = digit_scramble<BinaryProduct, BaseMatrix>(base, true)};
}

}  // namespace stipple::scrambles::matrix
