// SPDX-License-Identifier: MIT
//
// Hadamard matrices: n x n matrices of -1 and 1 with orthogonal rows. Here the first column is all
// 1. With chi the quadratic character of the field of q elements:
//
//     n = q + 1, q = 3 mod 4     Paley I: chi(k - i), where chi(0) counts as 1; for a prime q each
//                                row is the previous one shifted by one, and the last is all -1
//     n = p (p + 2) + 1          the same from the product of the characters of two twin primes
//     n = 2 (q + 1), q = 1 mod 4 Paley II, from the symmetric conference matrix of order q + 1
//     n = 4 v                    four functions of a table (Goethals, Seidel)
//     n = 4 q, q = 1 mod 4       Miyamoto, from the conference matrix of order q + 1 and a Hadamard
//                                matrix of order q - 1
//     n = 2 m                    rows H_m H_m and H_m -H_m (Sylvester)
//
// The constructions are tried in this order; q may also be a power of a prime.
//
// Shape   multiples of 4 up to 2^20: all up to 664, and most of the larger ones.
// Cost    O(q) memory; O(log n) an entry.
// Source  R. E. A. C. Paley, J. Math. Phys. 12 (1933) 311-320, doi:10.1002/sapm1933121311;
//         R. G. Stanton, D. A. Sprott, Canad. J. Math. 10 (1958) 73-77, doi:10.4153/CJM-1958-008-5
//         (twin primes); M. Miyamoto, J. Combin. Theory A 57 (1991) 86-108,
//         doi:10.1016/0097-3165(91)90008-5.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace stipple::generators {

inline constexpr std::uint64_t most_hadamard = std::uint64_t{1} << 20;

/// Whether a matrix of this order can be built; only multiples of 4 can.
bool has_hadamard(std::uint64_t order);

struct GoethalsSeidel;
enum class HadamardKind { none, paley_one, twin_primes, paley_two, four_functions, miyamoto };

class Hadamard {
  public:
    /// @param order an order for which has_hadamard() is true
    explicit Hadamard(std::uint64_t order);

    /// Whether an entry is 1 rather than -1.
    [[nodiscard]] bool positive(std::uint64_t row, std::uint64_t column) const;
    /// Name of the construction, such as "Paley I, q = 11", with ", doubled" for each doubling.
    [[nodiscard]] const std::string& construction() const { return construction_; }

  private:
    [[nodiscard]] bool core(std::uint64_t row, std::uint64_t column) const;
    [[nodiscard]] bool paley_two(std::uint64_t row, std::uint64_t column) const;
    [[nodiscard]] bool miyamoto(std::uint64_t row, std::uint64_t column) const;

    void take_field(std::uint64_t q, const char* name);

    std::uint64_t base_;  ///< order before doubling
    HadamardKind kind_;
    std::uint64_t prime_ = 0;   ///< prime of which q is a power; p (p + 2) for twin primes
    std::vector<bool> square_;  ///< whether an element is 0 or its character is 1
    const GoethalsSeidel* four_ = nullptr;
    std::shared_ptr<const Hadamard> smaller_;  ///< Hadamard matrix of order q - 1
    std::vector<std::uint64_t> elements_;      ///< nonzero squares of the field, then nonsquares
    std::string construction_;
};

}  // namespace stipple::generators
