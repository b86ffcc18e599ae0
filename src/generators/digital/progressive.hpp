// SPDX-License-Identifier: MIT
//
// Progressive points in the unit square from two binary matrices: the first coordinate of point i
// has the digits of i mirrored at the point (van der Corput), the second those of the matrix times
// the digits of i; then both are scrambled, each digit by a random flip that depends on the digits
// before it (nested uniform scrambling, math/digital/binary_scramble.hpp). Scrambling moves elementary
// intervals onto each other, and so keeps what the matrix promises of them; it makes every point
// uniform in the square.
#pragma once

#include <array>
#include <cstdint>

#include "generators/generator.hpp"
#include "math/digital/binary_scramble.hpp"

namespace stipple::generators {

/// A matrix by its columns: the j-th is what bit j of the index adds to the digits of the second
/// coordinate, whose first digit is bit 63.
using ColumnMatrix = std::array<std::uint64_t, 53>;

class Progressive final : public Sequence {
  public:
    Progressive(const Plan& plan, const ColumnMatrix& matrix);

    void fill(std::uint64_t first, std::span<double> rows) override;

  private:
    ColumnMatrix matrix_;
    std::array<std::uint64_t, 256> low_;  ///< images of the indices below 256
    BinaryOwen first_;
    BinaryOwen second_;
};

}  // namespace stipple::generators
