// SPDX-License-Identifier: MIT
//
// Niederreiter sequence in base 2: a digital sequence in which digit j of coordinate k, behind the
// point, is
//
//     sum_r i_r v_(r + u),    j = e Q + u,  0 <= u < e,    i = sum_r i_r 2^r,
//
// over GF(2). e is the degree of p_k, the k-th irreducible polynomial (x, 1 + x, 1 + x + x^2, ...),
// and v = v(k, Q) obeys the linear recurrence of p_k^(Q+1) from e Q zeros and e ones on: the
// Laurent series of some g / p_k^(Q+1).
//
// Shape   n x d for d <= 1000; indices below 2^52.
// Cost    O(n d), at the speed of the cache: see math/binary_net.hpp.
// Promise coordinates are exact to their first 53 digits, and below 1. Any 2^m points from a
//         multiple of 2^m on are a (t,m,d)-net in base 2, t = sum_k (deg p_k - 1), cut off at 53
//         digits; scrambled, too.
// Beware  other counts, and a first point left out, cost this evenness; the user is told.
// Source  P. Bratley, B. L. Fox, H. Niederreiter, ACM Trans. Model. Comput. Simul. 2 (1992)
//         195-213, doi:10.1145/146382.146385, with the choice of v of section 3.3;
//         H. Niederreiter, J. Number Theory 30 (1988) 51-70, doi:10.1016/0022-314X(88)90025-X.
#include <bit>

#include "generators/binary_sequence.hpp"
#include "math/gf2.hpp"

namespace stipple::generators {
namespace {

/// Digits of a fraction.
constexpr std::size_t rows = 64;

/// The first irreducible polynomials, in the order of the numbers that their bits make.
std::vector<std::uint64_t> irreducible_polynomials(std::size_t count) {
    std::vector<std::uint64_t> found;
    for (std::uint64_t p = 2; found.size() < count; ++p)
        if (gf2::is_irreducible(p)) found.push_back(p);
    return found;
}

/// A polynomial's coefficients, the constant first.
using Coefficients = std::vector<std::uint8_t>;

Coefficients product(const Coefficients& a, std::uint64_t p) {
    Coefficients result(a.size() + static_cast<std::size_t>(std::bit_width(p)) - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; p >> j != 0; ++j)
            result[i + j] = static_cast<std::uint8_t>(result[i + j] ^ (a[i] & (p >> j & 1)));
    return result;
}

/// v_0, ..., v_(length-1) by the recurrence of `power`, from `zeros` zeros and ones after them.
Coefficients recurrence(const Coefficients& power, std::size_t zeros, std::size_t length) {
    const std::size_t m = power.size() - 1;
    Coefficients v(std::max(length, m));
    for (std::size_t r = zeros; r < m; ++r) v[r] = 1;
    for (std::size_t r = m; r < v.size(); ++r)
        for (std::size_t i = 0; i < m; ++i)
            v[r] = static_cast<std::uint8_t>(v[r] ^ (power[i] & v[r - m + i]));
    return v;
}

void set_matrix(std::uint64_t p, std::size_t k, BinaryMatrices& matrices) {
    const auto e = static_cast<std::size_t>(std::bit_width(p)) - 1;
    Coefficients power{1};
    Coefficients v;
    for (std::size_t j = 0; j < rows; ++j) {
        const std::size_t u = j % e;
        if (u == 0) {
            power = product(power, p);
            v = recurrence(power, j, matrices.digits() + e);
        }
        for (std::size_t r = 0; r < matrices.digits(); ++r)
            matrices.columns[r * matrices.dimension + k] |= std::uint64_t{v[r + u]} << (63 - j);
    }
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    BinaryMatrices matrices{plan.dimension,
                            std::vector<std::uint64_t>(plan.dimension * binary_digits)};
    const auto polynomials = irreducible_polynomials(plan.dimension);
    for (std::size_t k = 0; k < plan.dimension; ++k) set_matrix(polynomials[k], k, matrices);
    return binary_sequence(std::move(matrices), plan, options);
}

}  // namespace

Generator niederreiter() {
    return {.name = "niederreiter",
            .summary = "Niederreiter sequence in base 2, plain or scrambled",
            .source = "Bratley, Fox, Niederreiter 1992, doi:10.1145/146382.146385",
            .traits = {.max_dimension = 1000, .max_index = std::uint64_t{1} << binary_digits},
            .options = Schema(binary_order, binary_scramble),
            .sequence = make,
            .uses_seed = binary_uses_seed,
            .notes = binary_notes};
}

}  // namespace stipple::generators
