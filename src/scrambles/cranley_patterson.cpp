// SPDX-License-Identifier: MIT
//
// Cranley-Patterson rotation: adds one vector u to all points, modulo 1.
//
//     y = x + u mod 1,    u uniform in [0, 1)^d, or given.
//
// Cost     O(n d).
// Promise  keeps differences of points modulo 1, up to rounding: a lattice stays a (shifted)
//          lattice. Coordinates never become 1: sums of 1 and more wrap.
// Beware   the net property of digital nets is lost; use digital-shift, matrix or owen for them.
// Source   R. Cranley, T. N. L. Patterson, SIAM J. Numer. Anal. 13 (1976) 904-914,
//          doi:10.1137/0713071.

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "math/digital/scramble_stream.hpp"
#include "scrambles/scramble.hpp"

namespace stipple::scrambles::cranley_patterson {
namespace {

constexpr Param<Numbers> shift{
    {.name = "shift",
     .help = "Shift vector, one number per coordinate, taken modulo 1; default: random"}};

/// The given shifts modulo 1, in [0, 1).
std::vector<double> fractions(std::vector<double> numbers, std::size_t coordinates) {
    if (numbers.size() != coordinates)
        fail(ErrorKind::usage, "--shift: {} numbers for {} coordinates", numbers.size(),
             coordinates);
    for (double& x : numbers) x = std::min(x - std::floor(x), one_minus_ulp);
    return numbers;
}

Randomization make(const Values& options, const ScrambleRequest& request) {
    const Rng rng = scramble_numbers(request.seed, ScrambleStream::rotation);
    std::vector<double> offsets;
    for (const std::size_t k : request.coordinates) offsets.push_back(rng.uniform(k));
    if (options.given(shift)) offsets = fractions(options[shift], offsets.size());
    return coordinate_wise(offsets.size(), [offsets](std::size_t k, std::span<double> x) {
        for (double& value : x) {
            const double sum = value + offsets[k];
            value = sum < 1 ? sum : std::min(sum - 1, one_minus_ulp);  // sums may round to 2
        }
    });
}

}  // namespace

Scramble unit() {
    return {.name = "cranley-patterson",
            .summary = "Shift of all points by one random or given vector, modulo 1; for lattices",
            .source = "Cranley, Patterson 1976, doi:10.1137/0713071",
            .related = {"toroidal-shift", "modulo-shift"},
            .options = Schema(scramble_seed, shift),
            .aliases = {"rotation", "random-shift", "shift"},
            .make = make};
}

}  // namespace stipple::scrambles::cranley_patterson
