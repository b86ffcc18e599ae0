// SPDX-License-Identifier: MIT
//
// Niederreiter sequence in a prime base b: a digital sequence in which digit j of coordinate k,
// after the radix point, is
//
//     sum_r i_r v_(r + u),    j = e Q + u,  0 <= u < e,    i = sum_r i_r b^r,
//
// modulo b. e is the degree of p_k, the k-th irreducible polynomial (in base 2: x, 1 + x,
// 1 + x + x^2, ...). v = v(k, Q) begins with e Q zeros and e ones and obeys the linear recurrence
// of p_k^(Q+1): it is the Laurent series of some g / p_k^(Q+1).
//
// Shape   n x d for d <= 1000; indices below 2^52, or the largest power of b up to 2^50.
// Cost    O(n d), in base 2 at the speed of the cache: see math/digital/binary_net.hpp and
//         base_net.hpp.
// Promise coordinates are exact to their first 53 digits (nearest doubles in bases other than 2),
//         and below 1. Any b^m points from a multiple of b^m on are a (t,m,d)-net in base b,
//         t = sum_k (deg p_k - 1), as far as there are digits; also if scrambled.
// Beware  other counts, or leaving out the first point, lose this evenness; a note reports it.
// Source  P. Bratley, B. L. Fox, H. Niederreiter, ACM Trans. Model. Comput. Simul. 2 (1992)
//         195-213, doi:10.1145/146382.146385, with the choice of v of section 3.3;
//         H. Niederreiter, J. Number Theory 30 (1988) 51-70, doi:10.1016/0022-314X(88)90025-X.
#include <algorithm>

#include "core/error.hpp"
#include "generators/net_sequence.hpp"
#include "math/functions/powers.hpp"

namespace stipple::generators::niederreiter {
namespace {

constexpr Param<std::int64_t> base_option{.name = "base",
                                          .fallback = 2,
                                          .low = 2,
                                          .high = BaseNet::largest_base,
                                          .help = "Base of the digits, a prime"};

/// Coefficients of a polynomial modulo a prime, from the constant to the leading 1.
using Polynomial = std::vector<std::uint32_t>;

/// The monic polynomial whose lower coefficients are the digits of `number`.
Polynomial monic(std::uint64_t number, std::size_t degree, std::uint32_t base) {
    Polynomial p(degree + 1);
    for (std::size_t j = 0; j < degree; ++j, number /= base)
        p[j] = static_cast<std::uint32_t>(number % base);
    p[degree] = 1;
    return p;
}

bool divides(const Polynomial& divisor, Polynomial rest, std::uint64_t base) {
    for (; rest.size() >= divisor.size(); rest.pop_back()) {
        const std::uint64_t factor = base - rest.back();
        const std::size_t low = rest.size() - divisor.size();
        for (std::size_t j = 0; j < divisor.size(); ++j)
            rest[low + j] =
                static_cast<std::uint32_t>((rest[low + j] + factor * divisor[j]) % base);
    }
    return std::ranges::all_of(rest, [](std::uint32_t c) { return c == 0; });
}

/// Whether p is irreducible; `smaller` has all irreducible polynomials of lower degrees.
bool is_irreducible(const Polynomial& p, const std::vector<Polynomial>& smaller,
                    std::uint32_t base) {
    for (const Polynomial& q : smaller) {
        if (2 * (q.size() - 1) > p.size() - 1) break;
        if (divides(q, p, base)) return false;
    }
    return true;
}

/// First irreducible polynomials, by degree, then by the number with their coefficients as digits.
std::vector<Polynomial> irreducible_polynomials(std::size_t count, std::uint32_t base) {
    std::vector<Polynomial> found;
    for (std::size_t degree = 1; found.size() < count; ++degree) {
        const std::uint64_t all = saturating_power(base, degree);
        for (std::uint64_t number = 0; number < all && found.size() < count; ++number) {
            Polynomial p = monic(number, degree, base);
            if (is_irreducible(p, found, base)) found.push_back(std::move(p));
        }
    }
    return found;
}

Polynomial product(const Polynomial& a, const Polynomial& b, std::uint64_t base) {
    Polynomial result(a.size() + b.size() - 1);
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j)
            result[i + j] =
                static_cast<std::uint32_t>((result[i + j] + std::uint64_t{a[i]} * b[j]) % base);
    return result;
}

/// v_0, ..., v_(length-1) by the recurrence of `power`, starting with `zeros` zeros, then ones.
std::vector<std::uint32_t> recurrence(const Polynomial& power, std::size_t zeros,
                                      std::size_t length, std::uint64_t base) {
    const std::size_t m = power.size() - 1;
    std::vector<std::uint32_t> v(std::max(length, m));
    for (std::size_t r = zeros; r < m; ++r) v[r] = 1;
    for (std::size_t r = m; r < v.size(); ++r) {
        std::uint64_t sum = 0;
        for (std::size_t i = 0; i < m; ++i) sum = (sum + (base - power[i]) * v[r - m + i]) % base;
        v[r] = static_cast<std::uint32_t>(sum);
    }
    return v;
}

/// Digits of a coordinate: 64 in base 2, more than a double has, because scrambling uses them.
std::size_t rows_in(std::uint32_t base) { return base == 2 ? 64 : net_digits(base); }

DigitMatrix matrix_of(const Polynomial& p, std::uint32_t base) {
    const std::size_t e = p.size() - 1;
    DigitMatrix matrix(rows_in(base), net_digits(base));
    Polynomial power{1};
    std::vector<std::uint32_t> v;
    for (std::size_t j = 0; j < matrix.rows; ++j) {
        const std::size_t u = j % e;
        if (u == 0) {
            power = product(power, p, base);
            v = recurrence(power, j, matrix.columns + e, base);
        }
        for (std::size_t r = 0; r < matrix.columns; ++r) matrix.at(j, r) = v[r + u];
    }
    return matrix;
}

Plan plan(const Request& request, const Values& options) {
    const Plan decided = default_plan(request);
    const std::uint32_t base = prime_base(options[base_option]);
    if (base != 2 && options[binary_order] != binary_order.fallback)
        fail(ErrorKind::usage, "--order: {} is for base 2; the base here is {}",
             options[binary_order], base);
    check_net_end(request, decided, base, "niederreiter");
    return decided;
}

std::unique_ptr<Sequence> make(const Plan& decided, const Values& options, const RunContext&) {
    const auto base = static_cast<std::uint32_t>(options[base_option]);
    std::vector<DigitMatrix> matrices;
    for (const Polynomial& p : irreducible_polynomials(decided.dimension, base))
        matrices.push_back(matrix_of(p, base));
    return net_sequence(base, std::move(matrices), decided, options);
}

std::vector<std::uint32_t> bases(const Plan& /*decided*/, const Values& options) {
    return {static_cast<std::uint32_t>(options[base_option])};
}

std::vector<std::string> notes(const Request& request, const Plan& decided, const Values& options) {
    return net_notes(static_cast<std::uint64_t>(options[base_option]), request, decided);
}

}  // namespace

Generator unit() {
    return {.name = "niederreiter",
            .summary = "Niederreiter sequence in base 2 or another prime, plain or scrambled",
            .source = "Bratley, Fox, Niederreiter 1992, doi:10.1145/146382.146385",
            .related = {"niederreiter-xing"},
            .traits = {.max_dimension = 1000, .max_index = std::uint64_t{1} << binary_digits},
            .options = Schema(base_option, binary_order, binary_scramble),
            .plan = plan,
            .sequence = make,
            .uses_seed = binary_uses_seed,
            .notes = notes,
            .bases = bases};
}

}  // namespace stipple::generators::niederreiter
