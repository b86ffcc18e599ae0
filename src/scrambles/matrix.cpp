// SPDX-License-Identifier: MIT
//
// Linear matrix scrambling: the vector of a coordinate's digits is multiplied by a random
// nonsingular lower triangular matrix, one a coordinate, and a digital shift is added.
//
// Cost     O(n d) in base 2, O(n d K^2) in others, with K digits.
// Promise  keeps the (t,m,s)-net property in its base. The variance of an estimate is that of
//          nested uniform scrambling.
// Beware   as in digital-shift.
// Source   J. Matousek, J. Complexity 14 (1998) 527-556, doi:10.1006/jcom.1998.0489.

#include <array>
#include <bit>
#include <variant>

#include "math/digital/base_scramble.hpp"
#include "math/digital/binary_scramble.hpp"
#include "scrambles/scramble.hpp"

namespace stipple::scrambles::matrix {
namespace {

constexpr Param<Numbers> base{{.name = "base",
                               .fallback = "2",
                               .help = "Base of the digits, a prime: one for all coordinates, or "
                                       "one for each"}};

/// The product with a binary matrix, byte by byte from tables.
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

    [[nodiscard]] std::uint64_t of(std::uint64_t fraction) const {
        std::uint64_t image = shift_;
        for (std::size_t byte = 0; byte < bytes; ++byte)
            image ^= tables_[byte][(fraction >> (56 - 8 * byte)) & 0xff];
        return image;
    }

  private:
    static constexpr std::size_t bytes = 7;  // hold the 53 digits of a double
    std::uint64_t shift_;
    std::vector<std::array<std::uint64_t, 256>> tables_;
};

class Matrix final : public CoordinateWise {
  public:
    Matrix(const ScrambleRequest& request, const std::vector<std::uint32_t>& bases)
        : CoordinateWise(bases.size()), bases_(bases) {
        for (std::size_t k = 0; k < bases.size(); ++k) {
            const std::size_t coordinate = request.coordinates[k];
            if (bases[k] == 2)
                products_.emplace_back(BinaryProduct(request.seed, coordinate));
            else
                products_.emplace_back(BaseMatrix(request.seed, coordinate, bases[k]));
        }
    }

  private:
    void move(std::size_t k, std::span<double> x) const override {
        if (const auto* binary = std::get_if<BinaryProduct>(&products_[k])) {
            for (double& value : x) value = fraction_to_unit(binary->of(unit_to_fraction(value)));
            return;
        }
        const BaseMatrix& matrix = std::get<BaseMatrix>(products_[k]);
        for (double& value : x) value = matrix.of(mirrored_digits(value, bases_[k]));
    }

    std::vector<std::uint32_t> bases_;
    std::vector<std::variant<BinaryProduct, BaseMatrix>> products_;
};

}  // namespace

Scramble unit() {
    return {.name = "matrix",
            .summary =
                "Linear matrix scrambling: digits times a random lower triangular matrix, "
                "and a digital shift",
            .source = "Matousek 1998, doi:10.1006/jcom.1998.0489",
            .options = Schema(base, scramble_seed),
            .aliases = {"linear-matrix"},
            .make = [](const Values& options,
                       const ScrambleRequest& request) -> std::unique_ptr<Randomization> {
                return std::make_unique<Matrix>(
                    request, bases_for(options[base], request.coordinates.size(), true));
            }};
}

}  // namespace stipple::scrambles::matrix
