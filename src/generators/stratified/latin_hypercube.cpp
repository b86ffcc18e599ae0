// SPDX-License-Identifier: MIT
//
// Latin hypercube of n points: along every coordinate, each of the n strata [k/n, (k+1)/n) holds
// exactly one point, anywhere in it or in its middle.
//
//     strength 1   coordinate k of point i is in stratum pi_k(i), the pi_k being independent random
//                  permutations (math/combinatorics/permutation.hpp)
//     strength 2   for n = p^2, p prime, and d <= p + 1: a Latin hypercube in which besides, for
//                  any two coordinates, each of the p x p squares holds exactly one point. It is
//                  made from an orthogonal array (orthogonal_points.hpp).
//
// Cost    O(n d); point i is found without the others, in constant memory.
// Promise each stratum holds one point in exact arithmetic, and floor(x n) says so too
//         (math/digital/stratum.hpp).
// Source  M. D. McKay, R. J. Beckman, W. J. Conover, Technometrics 21 (1979) 239-245,
//         doi:10.1080/00401706.1979.10489755; B. Tang, J. Amer. Stat. Assoc. 88 (1993) 1392-1397,
//         doi:10.1080/01621459.1993.10476423.

#include "generators/stratified/orthogonal_points.hpp"
#include "math/combinatorics/permutation.hpp"

namespace stipple::generators::latin_hypercube {
namespace {

constexpr Param<std::int64_t> strength{
    .name = "strength",
    .fallback = 1,
    .low = 1,
    .high = 2,
    .help =
        "1: one point in each of n strata along each axis; 2: and one in each of n squares for "
        "each two axes (n the square of a prime)"};

/// Points are in order, so that a coordinate's stretch of images is one of consecutive indices.
std::unique_ptr<Sequence> hypercube(const Plan& plan, bool centered) {
    return stratified_sequence(
        plan, {.centered = centered, .shuffled = false},
        [n = plan.count, keys = stratified_numbers(plan, 0)](
            std::size_t coordinate, std::span<const double> index, std::span<double> low) {
            Permutation(n, keys.bits(coordinate)).fill(static_cast<std::uint64_t>(index[0]), low);
            return n;
        });
}

constexpr const char* strong = "latin-hypercube of strength 2";

Plan plan(const Request& request, const Values& options) {
    if (options[strength] == 1) return default_plan(request);
    return plan_by_polynomials(request, 2, strong);
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const bool centered = options[centered_option];
    if (options[strength] == 1) return hypercube(plan, centered);
    const ArrayShape shape{.levels = prime_root(plan.count, 2, strong),
                           .strength = 2,
                           .columns = Columns::polynomials};
    return orthogonal_points(plan, {.centered = centered, .shuffled = true}, shape,
                             Substrata::independent);
}

}  // namespace

Generator unit() {
    return {.name = "latin-hypercube",
            .summary = "Latin hypercube: one point in each of n strata along every axis",
            .source =
                "McKay, Beckman, Conover 1979, doi:10.1080/00401706.1979.10489755; strength "
                "2: Tang 1993, doi:10.1080/01621459.1993.10476423",
            .related = {"latin", "maximin", "lhd", "lhsdesign"},
            .traits = {.prefix = false},
            .options = Schema(centered_option, strength),
            .aliases = {"lhs", "n-rooks", "nrooks"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::latin_hypercube
