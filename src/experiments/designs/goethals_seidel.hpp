// SPDX-License-Identifier: MIT
//
// Hadamard matrix of order 4 v from four functions A, B, C, D with values -1 and 1 on an abelian
// group of v elements. With R the matrix that maps x to -x, and each function X also denoting the
// matrix with entries X(y - x), it is
//
//      A    B R     C R     D R
//     -B R  A      -D'R     C'R
//     -C R  D'R     A      -B'R
//     -D R -C'R     B'R     A
//
// if the autocorrelations of the four functions add up to 0 at each nonzero shift. The group
// consists of the integers modulo v, or of pairs of integers modulo two numbers with the product v.
//
// Source  J. M. Goethals, J. J. Seidel, J. Austral. Math. Soc. 11 (1970) 343-344,
//         doi:10.1017/S144678870000673X. v = 47 and 59: Turyn type sequences of D. Best, D. Z.
//         Djokovic, H. Kharaghani, H. Ramp, Discrete Math. 313 (2013) 2444-2455,
//         doi:10.1016/j.disc.2013.07.001. v = 103: D. Z. Djokovic, Australas. J. Combin. 10 (1994)
//         259-264. v = 107: H. Kharaghani, B. Tayfeh-Rezaie, J. Combin. Des. 13 (2005) 435-440,
//         doi:10.1002/jcd.20043. Others were searched for this program: v = 23, 43, 67, 127, 151
//         and 163 among unions of orbits of multipliers; those on pairs are T-sequences of length
//         3, 5, 7 and 9 times Williamson's symmetric quadruples (J. Cooper, J. S. Wallis, Bull.
//         Austral. Math. Soc. 7 (1972) 269-277, doi:10.1017/S0004972700045019).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace stipple::generators {

class GoethalsSeidel {
  public:
    /// @param elements v, for which is_there() holds
    explicit GoethalsSeidel(std::uint64_t elements);

    static bool is_there(std::uint64_t elements);

    /// Whether an entry of the matrix of order 4 v is 1 rather than -1.
    [[nodiscard]] bool positive(std::uint64_t row, std::uint64_t column) const;

  private:
    /// Number of the group element x + y.
    [[nodiscard]] std::uint64_t sum(std::uint64_t x, std::uint64_t y) const;
    [[nodiscard]] std::uint64_t negative(std::uint64_t x) const;

    /// Element i inner_ + j is the pair (i, j), i modulo outer_ and j modulo inner_.
    std::uint64_t outer_ = 1;
    std::uint64_t inner_ = 1;
    std::array<std::vector<bool>, 4> positive_;  ///< where A, B, C, D are 1
};

}  // namespace stipple::generators
