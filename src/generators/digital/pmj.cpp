// SPDX-License-Identifier: MIT
//
// Progressive multi-jittered points, in the plane. For every k
//
//     the first 4^k points     hold one in each of the 2^k x 2^k squares,
//     the first 2 4^k points   hold two in each square, in diagonally opposite quarters of it,
//
// and for every m each of the 2^m strips along either axis holds one of the first 2^m points. The
// same is true of points j 2^m, ..., (j + 1) 2^m - 1 for every j. Unlike in pmj02, other elementary
// intervals are left to chance.
//
// Coordinate 0 of point i is the radical inverse of i; coordinate 1 is a random binary matrix,
// another one for every seed, times the digits of i. Then both coordinates get nested uniform
// scrambling, which permutes elementary intervals. The promises depend on blocks of the matrix: for
// every m, the block of rows 1..r and columns m-r+1..m is regular for r = m (strips) and for r =
// m/2 (squares), or for odd m for both r = (m-1)/2 and (m+1)/2 (opposite quarters). Given the
// earlier columns, each of these conditions requires that one sum of the new column's entries is 1,
// and the conditions do not contradict each other. The column is drawn until they hold, at most 8
// times on average.
//
// Shape   2 dimensions, indices below 2^53.
// Cost    O(n), no memory beyond 4 kB; drawing the matrix takes a fraction of a millisecond.
// Promise the above, for every seed.
// Beware  the paper's points are drawn one by one in free strips; here later ones follow from
//         earlier ones by the matrix. Still, each single point is uniform in the square.
// Source  P. Christensen, A. Kensler, C. Kilpatrick, Comput. Graph. Forum 37 (4) (2018) 21-33,
//         doi:10.1111/cgf.13472 (what the points are); the construction is stipple's own, in the
//         spirit of A. Helmer, P. Christensen, A. Kensler, EGSR (2021), doi:10.2312/sr.20211287.

#include <array>

#include "core/rng.hpp"
#include "generators/net_sequence.hpp"

namespace stipple::generators::pmj {
namespace {

constexpr std::uint64_t top = std::uint64_t{1} << 63;

/// A matrix by its columns, the first digit of each in bit 63.
using ColumnMatrix = std::array<std::uint64_t, 53>;

/// Whether rows 1..r of columns last-r+1..last (counted from 0) are a regular block.
bool is_regular(ColumnMatrix matrix, std::size_t r, std::size_t last) {
    for (std::size_t row = 0; row < r; ++row) {
        const std::uint64_t digit = top >> row;
        const std::size_t begin = last + 1 - r + row;
        std::size_t pivot = begin;
        while (pivot <= last && (matrix[pivot] & digit) == 0) ++pivot;
        if (pivot > last) return false;
        std::swap(matrix[begin], matrix[pivot]);
        for (std::size_t j = begin + 1; j <= last; ++j)
            if ((matrix[j] & digit) != 0) matrix[j] ^= matrix[begin];
    }
    return true;
}

/// True if the first 2^m points satisfy the conditions, given that the first 2^(m-1) do.
bool is_good(const ColumnMatrix& matrix, std::size_t m) {
    return is_regular(matrix, m, m - 1) && is_regular(matrix, m / 2, m - 1) &&
           is_regular(matrix, (m + 1) / 2, m - 1);
}

/// Random matrix that satisfies the conditions. Digits of column j after the j-th stay 0, as
/// scrambling makes them random.
ColumnMatrix random_matrix(std::uint64_t seed) {
    const Rng rng(seed, 0);
    ColumnMatrix matrix{};
    std::uint64_t draw = 0;
    for (std::size_t j = 0; j < matrix.size(); ++j) do
            matrix[j] = rng.bits(draw++) & ~((top >> j) - 1);
        while (!is_good(matrix, j + 1));
    return matrix;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values&, const RunContext&) {
    BinaryMatrices matrices{2};
    const ColumnMatrix second = random_matrix(plan.seed);
    for (std::size_t j = 0; j < second.size(); ++j)
        matrices.columns.insert(matrices.columns.end(), {top >> j, second[j]});
    return owen_sequence(matrices, plan.seed);
}

}  // namespace

Generator unit() {
    return {.name = "pmj",
            .summary =
                "Progressive multi-jittered points: the first 4^k are multi-jittered, for every k",
            .source =
                "Christensen, Kensler, Kilpatrick 2018, doi:10.1111/cgf.13472; the "
                "construction by random matrices is stipple's",
            .traits = {.min_dimension = 2, .max_dimension = 2},
            .options = Schema(),
            .aliases = {"progressive-multi-jittered"},
            .sequence = make};
}

}  // namespace stipple::generators::pmj
