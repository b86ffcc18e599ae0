// SPDX-License-Identifier: MIT
//
// The sets of least star discrepancy that a search finds, for a given number of points.
//
//     d = 1   (i + 1/2) / n, which is the least: 1 / (2 n)
//     d = 2   a search over the orders of the points by x and by y, each solved exactly
//             (planar_order.hpp, order_search.hpp)
//
// Shape   d = 1, 2; any n that the memory holds: 8 n^2 bytes a thread in the plane.
// Cost    a budget of steps, never the clock: by default 2^20 n^2, at most 2^35, which one core
//         takes 13 to 25 s for; 4 solved orders at least, 3 s each for n = 10 000.
// Promise the discrepancy is the least of the points' order, to 1e-12 relatively; the provenance has
//         it. Up to 20 points the default effort finds the optimum that is proven. A function of
//         count, seed and effort, for any number of threads.
// Beware  no prefix of the points is good by itself, and projections are as even as one allows.
// Source  F. Clement, C. Doerr, K. Klamroth, L. Paquete, arXiv:2311.17463 (optimal sets);
//         T. K. Rusch, N. Kirk, M. M. Bronstein, C. Lemieux, D. Rus, arXiv:2405.15059.
#include <algorithm>

#include "core/text.hpp"
#include "generators/generator.hpp"
#include "generators/optimized/order_search.hpp"

namespace stipple::generators::optimized {
namespace {

constexpr Param<double> effort{.name = "effort",
                               .fallback = 1,
                               .low = 1e-6,
                               .high = 1e6,
                               .help =
                                   "Steps of the search in the plane: this times those of some "
                                   "seconds (fewer for less than 180 points)"};

Plan plan(const Request& request, const Values& /*options*/) { return default_plan(request, 64); }

/// Steps of the search by default.
double usual_budget(double n) { return std::min(0x1p20 * n * n, 0x1p35); }

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    run.tick(0, 1);
    const auto n = static_cast<double>(plan.count);
    PointSet points(plan.count, plan.dimension);
    double value = 1 / (2 * n);
    if (plan.dimension == 1) {
        for (std::size_t i = 0; i < plan.count; ++i)
            points[i][0] = (static_cast<double>(i) + 0.5) / n;
    } else {
        const OptimizedSet found =
            least_star_discrepancy(plan.count, plan.seed, options[effort] * usual_budget(n), run);
        std::ranges::copy(found.rows, points.flat().begin());
        value = found.discrepancy;
    }
    points.provenance.found = {{"star_discrepancy", format_number(value)}};
    return points;
}

std::vector<std::string> notes(const Request& /*request*/, const Plan& plan,
                               const Values& /*options*/) {
    if (plan.dimension > 1) return {};
    return {"optimized: on the line the best set is known; seed and --effort change nothing"};
}

double seconds(double n, double d) {
    constexpr double steps_a_second = 1.5e9;
    return d < 2 ? 1e-8 * n : (usual_budget(n) + 120 * n * n) / steps_a_second;
}

}  // namespace

Generator unit() {
    return {.name = "optimized",
            .summary = "Points of least star discrepancy for their number, found by a search",
            .source = "Clement, Doerr, Klamroth, Paquete 2023, arXiv:2311.17463",
            .related = {"message-passing", "mpmc", "optimal", "low-discrepancy-set", "openevolve"},
            .traits = {.max_dimension = 2, .sequence = false, .prefix = false},
            .options = Schema(effort),
            .plan = plan,
            .set = make,
            .notes = notes,
            .cost = seconds};
}

}  // namespace stipple::generators::optimized
