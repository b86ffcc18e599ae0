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

class Rotation final : public CoordinateWise {
  public:
    explicit Rotation(const ScrambleRequest& request) : CoordinateWise(request.coordinates.size()) {
        const Rng rng = scramble_numbers(request.seed, ScrambleStream::rotation);
        for (const std::size_t k : request.coordinates) offsets_.push_back(rng.uniform(k));
    }

  private:
    void move(std::size_t k, std::span<double> x) const override {
        const double offset = offsets_[k];
        for (double& value : x) {
            const double sum = value + offset;
            value = sum < 1 ? sum : sum - 1;
        }
    }

    std::vector<double> offsets_;
};

}  // namespace

Scramble unit() {
    return {.name = "cranley-patterson",
            .summary = "Rotation of all points by one random vector, modulo 1; for lattices",
            .source = "Cranley, Patterson 1976, doi:10.1137/0713071",
            .options = Schema(scramble_seed),
            .aliases = {"rotation", "random-shift"},
            .make = [](const Values&, const ScrambleRequest& request)
                -> std::unique_ptr<Randomization> { return std::make_unique<Rotation>(request); }};
}

}  // namespace stipple::scrambles::cranley_patterson
