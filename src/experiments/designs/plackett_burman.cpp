// SPDX-License-Identifier: MIT
//
// Plackett-Burman design: n runs of up to n - 1 factors with two levels, in which any two factors
// have each of the four pairs of levels n / 4 times. The columns are those of a Hadamard matrix
// except its column of 1 (hadamard.hpp). If n - 1 is prime or n = 36, the design is the published
// cyclic one: each run is the previous one shifted by one, and the last has all low levels.
//
// Shape   n x k, k < n; n a multiple of 4 for which hadamard.hpp has a matrix. The default count is
//         the smallest for k factors; the default k is n - 1.
// Beware  main effects are aliased in part with interactions of two other factors.
// Source  R. L. Plackett, J. P. Burman, Biometrika 33 (1946) 305-325,
//         doi:10.1093/biomet/33.4.305.

#include "core/error.hpp"
#include "experiments/designs/hadamard.hpp"
#include "experiments/designs/levels.hpp"

namespace stipple::generators::plackett_burman {
namespace {

std::uint64_t nearest_below(std::uint64_t count) {
    std::uint64_t n = std::min(count, most_hadamard) / 4 * 4;
    while (n >= 4 && !has_hadamard(n)) n -= 4;
    return n;
}

/// Smallest available order of a Hadamard matrix, `count` or more; 0 if all are smaller.
std::uint64_t nearest_above(std::uint64_t count) {
    if (count > most_hadamard) return 0;
    std::uint64_t n = std::max<std::uint64_t>(4, (count + 3) / 4 * 4);
    while (!has_hadamard(n)) n += 4;  // ends at 2^20 at the latest, for which a matrix exists
    return n;
}

Plan plan(const Request& request, const Values& /*options*/) {
    if (!request.count) {
        const std::size_t k = request.dimension.value_or(11);
        return default_plan(request, nearest_above(k + 1), k);
    }
    const std::uint64_t n = *request.count;
    if (!has_hadamard(n)) {
        const std::uint64_t above = nearest_above(n);
        refuse_count(n,
                     n % 4 == 0 ? "the order of an available Hadamard matrix" : "a multiple of 4",
                     "plackett-burman", nearest_below(n), above == 0 ? ~std::uint64_t{0} : above);
    }
    const std::size_t k = request.dimension.value_or(n - 1);
    if (k >= n)
        fail(ErrorKind::usage,
             "--dimension: {} factors need more than {} runs, which allow up to {}; {} runs are "
             "the fewest that suffice",
             k, n, n - 1, nearest_above(k + 1));
    return default_plan(request, n, k);
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const bool ends = options[ends_option];
    const Hadamard matrix(plan.count);
    return level_sequence(
        plan, level_places(2, ends),
        [matrix](std::uint64_t i, std::size_t k) -> std::size_t {
            return matrix.positive(i, k + 1) ? 1 : 0;
        },
        {{"coded_bounds", coded_range(2, ends)}, {"construction", matrix.construction()}});
}

}  // namespace

Generator unit() {
    return {.name = "plackett-burman",
            .summary = "Screening design: n runs for up to n - 1 two-level factors",
            .source = "Plackett, Burman 1946, doi:10.1093/biomet/33.4.305",
            .related = {"doe", "experiment", "screening", "hadamard", "paley", "two-level"},
            .traits = level_traits(1, most_hadamard - 1),
            .options = Schema(ends_option),
            .aliases = {"pbdesign"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::plackett_burman
