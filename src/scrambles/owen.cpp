// SPDX-License-Identifier: MIT
//
// Owen's nested uniform scrambling: permutes the first digit of a coordinate at random, the second
// by a permutation that depends on the first, and so on down the tree of digits.
//
// Cost     O(n d) in base 2; O(n d K b) with K digits in others.
// Promise  every point is uniform in the cube; keeps the (t,m,s)-net property in its base. Digits
//          below the last digit of a given coordinate are random, too: 53 bits in all.
// Beware   as in digital-shift. Equal points stay equal.
// Source   A. B. Owen, in Monte Carlo and Quasi-Monte Carlo Methods in Scientific Computing (1995),
//          299-317, doi:10.1007/978-1-4612-2552-2_19.

#include "scrambles/digit_scramble.hpp"

namespace stipple::scrambles::owen {
namespace {

constexpr Param<Numbers> base{{.name = "base",
                               .fallback = "2",
                               .help = "Base of the digits: one for all coordinates, or one for "
                                       "each, such as 2,3; default: the generator's, else 2"}};

}  // namespace

Scramble unit() {
    return {.name = "owen",
            .summary = "Nested uniform scrambling: a random permutation of digits for each prefix",
            .source = "Owen 1995, doi:10.1007/978-1-4612-2552-2_19",
            .related = {"laine-karras", "hash-based-owen"},
            .options = Schema(base, scramble_seed),
            .aliases = {"nested-uniform"},
            .stream_version = 2,
            .make = digit_scramble<BinaryOwen, BaseOwen>(base, false)};
}

}  // namespace stipple::scrambles::owen
