// SPDX-License-Identifier: MIT
//
// Faure sequence. With the digits a_0, a_1, ... of index i in a prime base b, lowest first,
// coordinate k = 0, ..., d - 1 is
//
//     x = sum_r y_r b^(-r-1)    where    y_r = sum_j C(j, r) k^(j-r) a_j  mod b,
//
// the radical inverse after k multiplications of the digits by Pascal's triangle modulo b.
//
// Shape   n x d; b is the smallest prime >= d, or a larger one; indices below the largest power of
//         b up to 2^50, and in base 2 below 2^52.
// Cost    O(n d): five nanoseconds a coordinate.
// Promise every coordinate is correctly rounded, and below 1. A (0, d)-sequence in base b: any b^m
//         points from an index that b^m divides are a (0, m, d)-net, which meets each of the b^m
//         equal boxes with sides b^-k_1, ..., b^-k_d, k_1 + ... + k_d = m, exactly once.
// Beware  the first b points lie on the diagonal; a base much above the dimension has long
//         stretches of points on lines.
// Source  H. Faure, Acta Arith. 41 (1982) 337-351, doi:10.4064/aa-41-4-337-351.

#include "core/error.hpp"
#include "generators/generator.hpp"
#include "generators/net_sequence.hpp"
#include "math/combinatorics/primes.hpp"

namespace stipple::generators::faure {
namespace {

constexpr Param<std::int64_t> base_option{
    .name = "base",
    .low = 2,
    .high = BaseNet::largest_base,
    .optional = true,
    .help = "Base of the digits, a prime not below the dimension; default: the smallest one"};

std::uint32_t base_for(std::size_t dimension, const Values& options) {
    if (!options.given(base_option)) return static_cast<std::uint32_t>(next_prime(dimension));
    const std::uint32_t base = prime_base(options[base_option]);
    if (base < dimension)
        fail(ErrorKind::usage,
             "--base: {} is below the dimension {}; expected a prime not below it", base,
             dimension);
    return base;
}

Plan plan(const Request& request, const Values& options) {
    const Plan decided = default_plan(request);
    check_net_end(request, decided, base_for(decided.dimension, options), "faure");
    return decided;
}

/// Pascal's triangle to the power `k` modulo the base: entry (r, c) is C(c, r) k^(c-r).
DigitMatrix pascal_power(std::uint32_t base, std::size_t size, std::uint64_t k) {
    DigitMatrix matrix(size, size);
    for (std::size_t c = 0; c < size; ++c) {
        matrix.at(c, c) = 1;
        for (std::size_t r = 0; r < c; ++r) {
            const std::uint64_t above = r > 0 ? matrix.at(r - 1, c - 1) : 0;
            matrix.at(r, c) = static_cast<std::uint32_t>((k * matrix.at(r, c - 1) + above) % base);
        }
    }
    return matrix;
}

std::unique_ptr<Sequence> make(const Plan& decided, const Values& options, const RunContext&) {
    const std::uint32_t base = base_for(decided.dimension, options);
    std::vector<DigitMatrix> matrices;
    for (std::size_t k = 0; k < decided.dimension; ++k)
        matrices.push_back(pascal_power(base, net_digits(base), k));
    return net_sequence(base, std::move(matrices), decided, options);
}

std::vector<std::uint32_t> bases(const Plan& decided, const Values& options) {
    return {base_for(decided.dimension, options)};
}

std::vector<std::string> notes(const Request& request, const Plan& decided, const Values& options) {
    return net_notes(base_for(decided.dimension, options), request, decided);
}

}  // namespace

Generator unit() {
    return {.name = "faure",
            .summary = "Faure sequence: a (0, d)-sequence in the smallest prime base not below d",
            .source = "Faure 1982, doi:10.4064/aa-41-4-337-351",
            .traits = {.max_dimension = BaseNet::largest_base},
            .options = Schema(base_option, binary_scramble),
            .plan = plan,
            .sequence = make,
            .uses_seed = binary_uses_seed,
            .notes = notes,
            .bases = bases};
}

}  // namespace stipple::generators::faure
