// SPDX-License-Identifier: MIT
//
// Hammersley set of n points. Point i = 0, ..., n - 1 is
//
//     (i / n, phi_2(i), phi_3(i), phi_5(i), ...),
//
// phi_b being the radical inverse in base b. The sweep i / n is the first coordinate and starts
// at 0.
//
// Shape   n x d for d <= 1001; n <= 2^53.
// Cost    O(n d).
// Promise every coordinate is correctly rounded, and below 1.
// Source  J. M. Hammersley, Ann. N. Y. Acad. Sci. 86 (1960) 844-874,
//         doi:10.1111/j.1749-6632.1960.tb42846.x.

#include "generators/generator.hpp"
#include "math/primes.hpp"
#include "math/radical_inverse.hpp"

namespace stipple::generators {
namespace {

class Hammersley final : public Sequence {
  public:
    explicit Hammersley(const Plan& plan) : count_(static_cast<double>(plan.count)) {
        for (std::size_t k = 0; k + 1 < plan.dimension; ++k) inverses_.emplace_back(primes[k]);
    }
    void fill(std::uint64_t first, std::span<double> rows) override {
        const std::size_t dimension = inverses_.size() + 1;
        const std::size_t count = rows.size() / dimension;
        for (std::size_t j = 0; j < count; ++j)
            rows[j * dimension] = static_cast<double>(first + j) / count_;
        for (std::size_t k = 1; k < dimension; ++k)
            inverses_[k - 1].fill(first, count, rows.data() + k, dimension);
    }

  private:
    double count_;
    std::vector<RadicalInverse> inverses_;
};

std::unique_ptr<Sequence> make(const Plan& plan, const Values&) {
    return std::make_unique<Hammersley>(plan);
}

}  // namespace

Generator hammersley() {
    return {.name = "hammersley",
            .summary = "Hammersley set: i/n, then radical inverses in the first primes",
            .source = "Hammersley 1960, doi:10.1111/j.1749-6632.1960.tb42846.x",
            .traits = {.max_dimension = primes.size() + 1, .prefix = false, .seeded = false},
            .options = Schema(),
            .sequence = make};
}

}  // namespace stipple::generators
