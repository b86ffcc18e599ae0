// SPDX-License-Identifier: MIT
//
// Van der Corput sequence in base b: the digits of i, mirrored at the radix point,
//
//     phi_b(i) = sum_j a_j b^(-j-1)    where    i = sum_j a_j b^j,  0 <= a_j < b.
//
// Shape   n x 1; b in [2, 65536]; indices below 2^53.
// Cost    O(n): a table of reversed low digits makes it one division a point.
// Promise correctly rounded, and below 1. Points c b^m to (c + 1) b^m - 1, for any integer c, are
//         the multiples of b^-m in some order, plus a common shift below b^-m.
// Source  J. G. van der Corput, Proc. Akad. Wet. Amsterdam 38 (1935) 813-821; any base:
//         J. H. Halton, Numer. Math. 2 (1960) 84-90, doi:10.1007/BF01386213.

#include "generators/generator.hpp"
#include "math/digital/radical_inverse.hpp"

namespace stipple::generators::van_der_corput {
namespace {

constexpr Param<std::int64_t> base{.name = "base",
                                   .fallback = 2,
                                   .low = 2,
                                   .high = 65536,
                                   .help = "Base of the digits, prime or not"};

Plan plan(const Request& request, const Values&) { return default_plan(request, 1024, 1); }

std::unique_ptr<Sequence> make(const Plan&, const Values& options, const RunContext&) {
    const RadicalInverse inverse(static_cast<std::uint32_t>(options[base]));
    return sequence_of([inverse](std::uint64_t first, std::span<double> rows) {
        inverse.fill(first, rows.size(), rows.data(), 1);
    });
}

}  // namespace

Generator unit() {
    return {.name = "van-der-corput",
            .summary = "Van der Corput sequence: radical inverse in any base, one-dimensional",
            .source = "van der Corput 1935; Halton 1960, doi:10.1007/BF01386213",
            .traits = {.max_dimension = 1, .seeded = false},
            .options = Schema(base),
            .aliases = {"radical-inverse", "vdc"},
            .plan = plan,
            .sequence = make,
            .bases = [](const Plan&, const Values& options) {
                return std::vector{static_cast<std::uint32_t>(options[base])};
            }};
}

}  // namespace stipple::generators::van_der_corput
