// SPDX-License-Identifier: MIT
//
// Saltelli's design for Sobol' indices of k factors. For each base row i, with two independent
// points A_i and B_i of the cube, the runs are, in the same order as SALib's,
//
//     A_i,  AB_i1, ..., AB_ik,  [BA_i1, ..., BA_ik,]  B_i
//
// where AB_ij is A_i with coordinate j from B_i, and BA_ij is B_i with coordinate j from A_i. The
// latter runs are included with --second-order, for indices of second order.
//
// Shape   n = N (k + 2) runs for N base rows, or N (2 k + 2) with --second-order.
// Promise base rows do not depend on their number: a larger design extends a smaller one.
// Beware  Sobol' points as the base work best if N is a power of two.
// Source  A. Saltelli, P. Annoni, I. Azzini, F. Campolongo, M. Ratto, S. Tarantola, Comput. Phys.
//         Commun. 181 (2010) 259-270, doi:10.1016/j.cpc.2009.09.018; A. Saltelli, Comput. Phys.
//         Commun. 145 (2002) 280-297, doi:10.1016/S0010-4655(02)00280-1 (second order).

#include "experiments/designs/levels.hpp"
#include "experiments/designs/radial.hpp"

namespace stipple::generators::saltelli {
namespace {

constexpr Param<bool> second_order{
    .name = "second-order",
    .help = "Add the runs for indices of pairs of factors: N (2 k + 2) in all"};

constexpr Param<Text> base{
    {.name = "base",
     .fallback = usual_base,
     .unit = "generator",
     .help = "Spec of the sequence in 2 k dimensions that gives the two points of each base row"}};

std::size_t runs_of_row(std::size_t dimension, const Values& options) {
    return (options[second_order] ? 2 * dimension : dimension) + 2;
}

Plan plan(const Request& request, const Values& options) {
    const std::size_t k = request.dimension.value_or(2);
    const std::size_t runs = runs_of_row(k, options);
    const Plan plan = default_plan(request, 1024 * runs, k);
    require_whole_blocks(plan, runs,
                         options[second_order] ? "saltelli --second-order" : "saltelli");
    return plan;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const std::size_t k = plan.dimension;
    const std::size_t runs = runs_of_row(k, options);
    const auto write_run = [k, runs](std::size_t j, std::span<const double> b,
                                     std::span<double> row) {
        if (j == 0) return;
        if (j <= k) {
            row[j - 1] = b[j - 1];
            return;
        }
        // The only coordinate from A in this run; k, for none, in the last run, which is B.
        const std::size_t kept = j + 1 < runs ? j - k - 1 : k;
        for (std::size_t i = 0; i < k; ++i)
            if (i != kept) row[i] = b[i];
    };
    return radial_sequence({.dimension = k, .runs = runs}, options[base], plan.seed, write_run);
}

}  // namespace

Generator unit() {
    return {.name = "saltelli",
            .summary = "Saltelli's runs for estimating Sobol' sensitivity indices",
            .source = "Saltelli et al. 2010, doi:10.1016/j.cpc.2009.09.018",
            .related = {"sensitivity", "sobol-indices", "gsa", "salib", "total-effects",
                        "variance-based"},
            .traits = {.max_dimension = 10'600},
            .options = Schema(second_order, base),
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::saltelli
