// SPDX-License-Identifier: MIT
//
// Kronecker sequence. Point i = 0, 1, 2, ... is
//
//     x_k = frac(offset + i alpha_k).
//
// Unless given, alpha is that of the sequence R_d: alpha_k = g^k for k = 1, ..., d, where 1 / g is
// the generalised golden ratio, the root x > 1 of x^(d + 1) = x + 1; so g^d (1 + g) = 1.
//
// Shape   n x d; indices below 2^53.
// Cost    O(n d): an addition of two words a coordinate.
// Promise all arithmetic is in whole numbers of 127 bits, modulo 1: a coordinate is the first 53
//         bits of frac(offset + i alpha_k), at any index. A given alpha is the double that it reads
//         as. Those of R_d are within d 2^-126, so that a point i is within i d 2^-126 + 2^-53.
// Beware  R_d is a conjecture beyond d = 1; no bound of its discrepancy is known. M. Roberts adds
//         the offset 0.5 and begins with i = 1.
// Source  M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018),
//         extremelearning.com.au; for any alpha: L. Kuipers, H. Niederreiter, Uniform Distribution
//         of Sequences, Wiley 1974.

#include <bit>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "generators/generator.hpp"
#include "math/arithmetic/bits.hpp"
#include "math/arithmetic/ratio.hpp"

namespace stipple::generators::kronecker {
namespace {

constexpr Param<Numbers> alpha{{.name = "alpha",
                                .help =
                                    "What every next point adds, a number a coordinate; "
                                    "without it, powers of the generalised golden ratio (R_d)"}};
constexpr Param<double> offset{.name = "offset",
                               .fallback = 0,
                               .low = 0,
                               .high = one_minus_ulp,
                               .help = "Every coordinate of point 0; 0.5 is M. Roberts' choice"};

/// @param alphas and the offset in fractions of 127 bits
std::unique_ptr<Sequence> multiples(const std::vector<Wide>& alphas, Wide begin) {
    return sequence_of([=](std::uint64_t first, std::span<double> rows) {
        std::vector<Wide> point;
        for (const Wide a : alphas) point.push_back(begin + a * first);
        for (std::size_t at = 0; at < rows.size(); at += point.size())
            for (std::size_t k = 0; k < point.size(); ++k) {
                rows[at + k] = fraction_to_unit(static_cast<std::uint64_t>(point[k] >> 63));
                point[k] += alphas[k];
            }
    });
}

/// The high half of the product of two fractions of 128 bits.
Wide times(Wide a, Wide b) {
    const Wide a1 = a >> 64;
    const Wide b1 = b >> 64;
    const Wide a0 = static_cast<std::uint64_t>(a);
    const Wide b0 = static_cast<std::uint64_t>(b);
    const Wide left = a1 * b0;
    const Wide right = a0 * b1;
    const Wide middle =
        (a0 * b0 >> 64) + static_cast<std::uint64_t>(left) + static_cast<std::uint64_t>(right);
    return a1 * b1 + (left >> 64) + (right >> 64) + (middle >> 64);
}

Wide power(Wide base, std::size_t exponent) {  // exponent >= 1
    Wide result = base;
    for (int bit = static_cast<int>(std::bit_width(exponent)) - 2; bit >= 0; --bit) {
        result = times(result, result);
        if (exponent >> bit & 1) result = times(result, base);
    }
    return result;
}

/// The root g of g^d (1 + g) = 1 in 128 bits, bit by bit.
Wide golden(std::size_t d) {
    Wide g = 0;
    for (int bit = 127; bit >= 0; --bit) {
        const Wide larger = g | Wide{1} << bit;
        const Wide first = power(larger, d);
        const bool above = first + times(first, larger) < first;  // carried: 1 or more
        if (!above) g = larger;
    }
    return g;
}

/// frac(x) in 127 bits; what is behind them is cut off.
Wide fraction(double x) {
    const double part = std::fmod(std::abs(x), 1.0);
    const double high = std::floor(std::ldexp(part, 64));
    const double low = std::floor(std::ldexp(std::ldexp(part, 64) - high, 63));
    const Wide bits = (static_cast<Wide>(static_cast<std::uint64_t>(high)) << 63) +
                      static_cast<std::uint64_t>(low);
    return x < 0 ? -bits : bits;
}

Plan plan(const Request& request, const Values& options) {
    const std::size_t given = options[alpha].size();
    const Plan plan = default_plan(request, 1024, options.given(alpha) ? given : 2);
    if (options.given(alpha) && given < plan.dimension)
        fail(ErrorKind::usage, "--alpha: {} numbers are too few; dimension {} needs as many", given,
             plan.dimension);
    return plan;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    std::vector<Wide> steps;
    const std::vector<double> given = options[alpha];
    const Wide g = options.given(alpha) ? 0 : golden(plan.dimension);
    for (Wide next = g; steps.size() < plan.dimension; next = times(next, g))
        steps.push_back(options.given(alpha) ? fraction(given[steps.size()]) : next >> 1);
    return multiples(steps, fraction(options[offset]));
}

}  // namespace

Generator unit() {
    return {
        .name = "kronecker",
        .summary = "Kronecker sequence: multiples of a vector modulo 1; R_d unless one is given",
        .source = "Roberts 2018, extremelearning.com.au; Kuipers & Niederreiter 1974",
        .traits = {.seeded = false},
        .options = Schema(alpha, offset),
        .aliases = {"additive-recurrence", "r2", "rd", "weyl"},
        .plan = plan,
        .sequence = make};
}

}  // namespace stipple::generators::kronecker
