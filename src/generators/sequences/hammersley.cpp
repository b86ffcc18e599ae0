// SPDX-License-Identifier: MIT
//
// Hammersley set of n points. Point i = 0, ..., n - 1 is
//
//     (s, phi_2(i), phi_3(i), ...)    with the sweep    s = i / n    or    s = (2 i + 1) / 2n,
//
// phi_b being the radical inverse in base b. By default, the sweep is the first coordinate and
// starts at 0; options make it the last one, or let it start at 1 / 2n.
//
// Shape   n x d for d <= 1001; n <= 2^53.
// Cost    O(n d).
// Promise every coordinate is correctly rounded, and below 1.
// Source  J. M. Hammersley, Ann. N. Y. Acad. Sci. 86 (1960) 844-874,
//         doi:10.1111/j.1749-6632.1960.tb42846.x.

#include "generators/generator.hpp"
#include "math/arithmetic/ratio.hpp"
#include "math/combinatorics/primes.hpp"
#include "math/digital/radical_inverse.hpp"

namespace stipple::generators::hammersley {
namespace {

constexpr Param<Choice> sweep{.name = "sweep",
                              .fallback = "first",
                              .choices = "first|last",
                              .help = "Coordinate that increases evenly from 0 to 1"};
constexpr Param<Choice> offset{
    .name = "offset",
    .fallback = "0",
    .choices = "0|half",
    .help = "Values of the sweep: i / n, or half a step further, (i + 1/2) / n"};

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const bool last = options[sweep] == "last";
    const bool half = options[offset] == "half";
    std::vector<RadicalInverse> inverses;
    for (std::size_t k = 0; k + 1 < plan.dimension; ++k) inverses.emplace_back(primes[k]);
    return sequence_of([=, n = plan.count](std::uint64_t first, std::span<double> rows) {
        const std::size_t dimension = inverses.size() + 1;
        const std::size_t count = rows.size() / dimension;
        const std::uint64_t scale = half ? 2 : 1;
        fill_ratios(scale * first + (half ? 1 : 0), scale, scale * n, count,
                    rows.data() + (last ? dimension - 1 : 0), dimension);
        for (std::size_t k = 0; k + 1 < dimension; ++k)
            inverses[k].fill(first, count, rows.data() + k + (last ? 0 : 1), dimension);
    });
}

/// Base of each coordinate. The base of the sweep is p if n is a power of a prime p <= 7919: the
/// sweep is then a coordinate of a net in base p. Otherwise it is 2.
std::vector<std::uint32_t> bases(const Plan& plan, const Values& options) {
    std::vector<std::uint32_t> all(
        primes.begin(), primes.begin() + static_cast<std::ptrdiff_t>(plan.dimension - 1));
    const std::uint64_t factor = plan.count > 1 ? smallest_factor(plan.count) : 2;
    std::uint64_t rest = plan.count;
    while (rest % factor == 0) rest /= factor;
    const bool power = rest == 1 && factor <= primes.back();
    all.insert(options[sweep] == "last" ? all.end() : all.begin(),
               power ? static_cast<std::uint32_t>(factor) : 2);
    return all;
}

}  // namespace

Generator unit() {
    return {.name = "hammersley",
            .summary = "Hammersley set: i/n, then radical inverses in the first primes",
            .source = "Hammersley 1960, doi:10.1111/j.1749-6632.1960.tb42846.x",
            .traits = {.max_dimension = primes.size() + 1, .prefix = false, .seeded = false},
            .options = Schema(sweep, offset),
            .sequence = make,
            .bases = bases};
}

}  // namespace stipple::generators::hammersley
