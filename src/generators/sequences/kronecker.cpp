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
// Promise all arithmetic is in integers of 127 bits, modulo 1: a coordinate is the first 53 bits of
//         frac(offset + i alpha_k), at any index. A given alpha is rounded to a double. The alphas
//         of R_d are within d 2^-126, so that point i is within i d 2^-126 + 2^-53; square roots
//         of primes are within 2^-100.
// Beware  for d > 1, the evenness of R_d is a conjecture; no bound of its discrepancy is known.
//         M. Roberts adds the offset 0.5 and begins with i = 1.
// Source  M. Roberts, "The unreasonable effectiveness of quasirandom sequences" (2018),
//         extremelearning.com.au; for any alpha: L. Kuipers, H. Niederreiter, Uniform Distribution
//         of Sequences, Wiley 1974.

#include <fmt/format.h>

#include <bit>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/generator.hpp"
#include "math/arithmetic/bits.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/combinatorics/primes.hpp"

namespace stipple::generators::kronecker {
namespace {

constexpr Param<Text> alpha{
    {.name = "alpha",
     .fallback = "golden",
     .help = "Step between points: golden, powers of the generalised golden ratio (R_d); "
             "square-roots or richtmyer, those of the primes; or one number per coordinate, also "
             "as a formula: 'sqrt(2),pi'"}};
constexpr Param<double> offset{
    .name = "offset",
    .fallback = 0,
    .low = 0,
    .high = one_minus_ulp,
    .help = "Value of every coordinate of point 0; 0.5 is M. Roberts' choice"};

/// @param alphas, begin fractions of 127 bits
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

/// High half of the product of two fractions of 128 bits.
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

/// Root g of g^d (1 + g) = 1 in 128 bits, bit by bit.
Wide golden(std::size_t d) {
    Wide g = 0;
    for (int bit = 127; bit >= 0; --bit) {
        const Wide larger = g | Wide{1} << bit;
        const Wide first = power(larger, d);
        const bool above = first + times(first, larger) < first;  // a carry: the sum is 1 or more
        if (!above) g = larger;
    }
    return g;
}

/// frac(x) in 127 bits, truncated.
Wide fraction(double x) {
    const double part = std::fmod(std::abs(x), 1.0);
    const double high = std::floor(std::ldexp(part, 64));
    const double low = std::floor(std::ldexp(std::ldexp(part, 64) - high, 63));
    const Wide bits = (static_cast<Wide>(static_cast<std::uint64_t>(high)) << 63) +
                      static_cast<std::uint64_t>(low);
    return x < 0 ? -bits : bits;
}

/// Fractional part of an integer's square root: that of the root in float64, plus the root's error.
Wide fraction_of_root(std::uint64_t p) {
    const auto square = static_cast<double>(p);
    const double root = std::sqrt(square);
    return fraction(root) + fraction(-std::fma(root, root, -square) / (2 * root));
}

/// Values of formulas that are separated by commas. @throws Error(usage)
std::vector<double> numbers_of(std::string_view text) {
    std::vector<double> numbers;
    for (const auto part : split_outside("()", text, ",")) {
        const auto plain = parse_number(part);
        numbers.push_back(plain ? *plain : formula_value(alpha.name, part));
        if (!std::isfinite(numbers.back()))
            fail(ErrorKind::usage, "--alpha: '{}' is not a finite number", part);
    }
    return numbers;
}

bool is_preset(const std::string& text) {
    return text == "golden" || text == "square-roots" || text == "richtmyer";
}

/// Step of each coordinate, in 127 bits.
std::vector<Wide> steps_of(const std::string& text, std::size_t dimension) {
    std::vector<Wide> steps;
    if (text == "golden") {
        const Wide g = golden(dimension);
        for (Wide next = g; steps.size() < dimension; next = times(next, g))
            steps.push_back(next >> 1);
    } else if (is_preset(text)) {
        for (std::uint64_t p = 2; steps.size() < dimension; p = next_prime(p + 1))
            steps.push_back(fraction_of_root(p));
    } else {
        for (const double number : numbers_of(text)) steps.push_back(fraction(number));
    }
    return steps;
}

Plan plan(const Request& request, const Values& options) {
    const std::string text = options[alpha];
    const std::size_t given = is_preset(text) ? 0 : numbers_of(text).size();
    const Plan plan = default_plan(request, 1024, given > 0 ? given : 2);
    if (given > 0 && given < plan.dimension)
        fail(ErrorKind::usage, "--alpha: {} numbers are too few for dimension {}", given,
             plan.dimension);
    return plan;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    std::vector<Wide> steps = steps_of(options[alpha], plan.dimension);
    steps.resize(plan.dimension);
    return multiples(steps, fraction(options[offset]));
}

/// The steps and the first point, as high and low halves of fractions of 128 bits.
std::vector<Constants> constants(const Plan& plan, const Values& options, const RunContext&) {
    const auto put = [](Constants& to, Wide x) {
        to.numbers.push_back(static_cast<std::uint64_t>(x >> 63));
        to.numbers.push_back(static_cast<std::uint64_t>(x << 1));
    };
    Constants steps{"steps", {}};
    Constants begin{"begin", {}};
    const auto all = steps_of(options[alpha], plan.dimension);
    for (std::size_t k = 0; k < plan.dimension; ++k) put(steps, all[k]);
    put(begin, fraction(options[offset]));
    return {steps, begin};
}

/// Returns a note if points repeat within the count, because all steps are multiples of some 2^-k.
std::vector<std::string> notes(const Request& /*request*/, const Plan& plan,
                               const Values& options) {
    Wide bits = 0;
    const std::vector<Wide> steps = steps_of(options[alpha], plan.dimension);
    for (std::size_t k = 0; k < plan.dimension; ++k) bits |= steps[k] << 1;
    std::uint64_t period = 1;
    for (; bits != 0 && period < plan.count; bits <<= 1) period *= 2;
    if (period >= plan.count) return {};
    return {fmt::format("the points repeat after {}, since all of --alpha are multiples of 1/{}",
                        period, period)};
}

}  // namespace

Generator unit() {
    return {.name = "kronecker",
            .summary = "Kronecker sequence: multiples of a vector modulo 1, R_d if none is given",
            .source = "Roberts 2018, extremelearning.com.au; Kuipers & Niederreiter 1974",
            .related = {"golden-ratio", "plastic-number", "richtmyer"},
            .traits = {.seeded = false},
            .options = Schema(alpha, offset),
            .aliases = {"additive-recurrence", "r2", "rd", "weyl"},
            .plan = plan,
            .sequence = make,
            .notes = notes,
            .constants = constants};
}

}  // namespace stipple::generators::kronecker
