// SPDX-License-Identifier: MIT
//
// Cranley-Patterson rotation: one random vector u is added to all points, modulo 1.
//
//     y = x + u mod 1,    u uniform in [0, 1)^d.
//
// Cost     O(n d).
// Promise  differences of points modulo 1 stay, to rounding: a lattice stays a (shifted) lattice.
//          Never 1: where x + u reaches 1 it wraps.
// Beware   the net property of digital nets is lost; use digital-shift, matrix or owen for them.
// Source   R. Cranley, T. N. L. Patterson, SIAM J. Numer. Anal. 13 (1976) 904-914,
//          doi:10.1137/0713071.

#include "math/digital/scramble_stream.hpp"
#include "scrambles/scramble.hpp"

namespace stipple::scrambles::cranley_patterson {
namespace {

Randomization make(const Values&, const ScrambleRequest& request) {
    const Rng rng = scramble_numbers(request.seed, ScrambleStream::rotation);
    std::vector<double> offsets;
    for (const std::size_t k : request.coordinates) offsets.push_back(rng.uniform(k));
    return coordinate_wise(offsets.size(), [offsets](std::size_t k, std::span<double> x) {
        for (double& value : x) {
            const double sum = value + offsets[k];
            value = sum < 1 ? sum : sum - 1;
        }
    });
}

}  // namespace

Scramble unit() {
    return {.name = "cranley-patterson",
            .summary = "Rotation of all points by one random vector, modulo 1; for lattices",
            .source = "Cranley, Patterson 1976, doi:10.1137/0713071",
            .options = Schema(scramble_seed),
            .aliases = {"rotation", "random-shift"},
            .make = make};
}

}  // namespace stipple::scrambles::cranley_patterson
