// SPDX-License-Identifier: MIT
//
// Digital shift: adds the same random digits to the digits of all points, modulo the base, without
// carries.
//
// Cost     O(n d) in base 2, O(n d log 2^50 / log b) in others.
// Promise  keeps the (t,m,s)-net property in its base, for every net.
// Beware   in other bases than 2 a coordinate is first rounded to a multiple of b^-K, where b^K is
//          the largest power up to 2^50. This recovers the exact digits of Halton's points.
// Source   see math/digital/base_scramble.hpp.

#include "scrambles/digit_scramble.hpp"

namespace stipple::scrambles::digital_shift {
namespace {

constexpr Param<Numbers> base{{.name = "base",
                               .fallback = "2",
                               .help = "Base of the digits: one for all coordinates, or one for "
                                       "each; default: the generator's, else 2"}};

class BinaryShift {
  public:
    BinaryShift(std::uint64_t seed, std::size_t coordinate)
        : shift_(binary_shift(seed, coordinate)) {}
    void apply(std::span<std::uint64_t> fractions) const {
        for (std::uint64_t& fraction : fractions) fraction ^= shift_;
    }

  private:
    std::uint64_t shift_;
};

}  // namespace

Scramble unit() {
    return {.name = "digital-shift",
            .summary = "Adds the same random digits to those of all points, without carries",
            .source = "Owen 1995, doi:10.1007/978-1-4612-2552-2_19",
            .related = {"xor", "random-digits"},
            .options = Schema(base, scramble_seed),
            .stream_version = 2,
            .make = digit_scramble<BinaryShift, BaseShift>(base, false)};
}

}  // namespace stipple::scrambles::digital_shift
