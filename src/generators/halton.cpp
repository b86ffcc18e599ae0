// SPDX-License-Identifier: MIT
//
// Halton sequence. Coordinate k of point i is the radical inverse of i in the k-th prime b:
//
//     phi_b(i) = sum_j a_j b^(-j-1)    where    i = sum_j a_j b^j,  0 <= a_j < b.
//
// Shape   n x d for d <= 1000; indices below 2^53.
// Cost    O(n d): a table of reversed low digits makes it one division a coordinate.
// Promise every coordinate is correctly rounded, and below 1. Any b_1^m1 * ... * b_d^md consecutive
//         points meet every box of that grid exactly once.
// Beware  dimensions above 10 are strongly correlated at small counts; nothing here repairs that.
// Source  J. H. Halton, Numer. Math. 2 (1960) 84-90, doi:10.1007/BF01386213.

#include "generators/generator.hpp"
#include "math/primes.hpp"
#include "math/radical_inverse.hpp"

namespace stipple::generators {
namespace {

class Halton final : public Sequence {
  public:
    explicit Halton(const Plan& plan) {
        for (std::size_t k = 0; k < plan.dimension; ++k) inverses_.emplace_back(primes[k]);
    }
    void fill(std::uint64_t first, std::span<double> rows) override {
        const std::size_t dimension = inverses_.size();
        for (std::size_t k = 0; k < dimension; ++k)
            inverses_[k].fill(first, rows.size() / dimension, rows.data() + k, dimension);
    }

  private:
    std::vector<RadicalInverse> inverses_;
};

std::unique_ptr<Sequence> make(const Plan& plan, const Values&) {
    return std::make_unique<Halton>(plan);
}

}  // namespace

Generator halton() {
    return {.name = "halton",
            .summary = "Halton sequence: radical inverses in the first primes",
            .source = "Halton 1960, doi:10.1007/BF01386213",
            .traits = {.max_dimension = primes.size(), .seeded = false},
            .options = Schema(),
            .sequence = make};
}

}  // namespace stipple::generators
