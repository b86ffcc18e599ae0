// SPDX-License-Identifier: MIT
//
// Hadamard matrices: n x n of -1 and 1, any two rows, and any two columns, orthogonal; the first
// column here all 1. With chi the quadratic character of the field of q elements:
//
//     n = q + 1, q = 3 mod 4     Paley I: chi(k - i), where chi(0) counts as 1; for a prime q each
//                                row is the one before, moved on by one, and the last one all -1
//     n = p (p + 2) + 1          the same from the product of the characters of two twin primes
//     n = 2 (q + 1), q = 1 mod 4 Paley II, from the symmetric conference matrix of order q + 1
//     n = 2 m                    H_m H_m / H_m -H_m (Sylvester)
//
// tried in this order; the second and later ones too where q is a power of a prime.
//
// Shape   multiples of 4 up to 2^20; of those up to 200 all but 92, 116, 156, 172, 184 and 188.
// Cost    O(q) memory; O(log n) an entry.
// Source  R. E. A. C. Paley, J. Math. Phys. 12 (1933) 311-320, doi:10.1002/sapm1933121311;
//         R. G. Stanton, D. A. Sprott, Canad. J. Math. 10 (1958) 73-77, doi:10.4153/CJM-1958-008-5
//         (twin primes).
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace stipple::generators {

inline constexpr std::uint64_t most_hadamard = std::uint64_t{1} << 20;

/// Whether there is a matrix of that order here: a multiple of 4.
bool has_hadamard(std::uint64_t order);

class Hadamard {
  public:
    /// @param order one that has_hadamard()
    explicit Hadamard(std::uint64_t order);

    /// Whether an entry is 1, not -1.
    [[nodiscard]] bool positive(std::uint64_t row, std::uint64_t column) const;

    /// How it is made: "Paley I, q = 11", with "doubled" for each time.
    [[nodiscard]] const std::string& construction() const { return construction_; }

  private:
    [[nodiscard]] bool core(std::uint64_t row, std::uint64_t column) const;

    enum class Kind { cyclic, field, conference };

    Kind kind_ = Kind::cyclic;
    std::uint64_t base_ = 0;    ///< order before it is doubled
    std::uint64_t prime_ = 0;   ///< q is a power of it
    std::vector<bool> square_;  ///< whether the character is 1, or its argument 0
    std::string construction_;
};

}  // namespace stipple::generators
