// SPDX-License-Identifier: MIT
//
// Gaussian blue noise: random points of a torus of volume V, moved down the energy
//
//     E = sum over pairs i < j of  exp(-(n / V)^(2/d) |x_i - x_j|^2 / 2)
//
// by --iterations accelerated gradient steps (relaxation/gaussian_relaxation.cpp). Up to constants,
// E is the integral of the square of s, the points convolved with Gaussians of standard deviation
// sqrt(1/2) (V / n)^(1/d). At the minimum of E, s is nearly constant, so the spectrum vanishes
// below the frequency (n / V)^(1/d) / 2.
//
// With a --density, kernels are as wide as the local spacing of points, and the density attracts as
// much as the points repel (relaxation/density_relaxation.cpp).
//
// Shape   d = 1 ... 4, distances on the torus. The torus is the unit cube, or a box with no side a
//         thousand times another. A density in 2-D only.
// Cost    O(n) a step: 4096 points in 2-D and 1000 steps take 5 s of processor time; about 10 and
//         100 times as much in 3-D and 4-D, and 10 times as much with a density.
// Promise the same bits for any number of threads.
// Beware  in a box whose shortest side is below (V / n)^(1/d), points line up farther apart than
//         Gaussians reach, and stay as random as they were.
// Source  A. G. M. Ahmed, J. Ren, P. Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6), 260
//         (2022), doi:10.1145/3550454.3555519, with sigma = 1.

#include <algorithm>

#include "core/error.hpp"
#include "core/machine/first_touch.hpp"
#include "core/rng.hpp"
#include "generators/blue_noise/relaxation/relaxation.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "media/density_map.hpp"

namespace stipple::generators::gaussian_blue_noise {
namespace {

constexpr std::int64_t usual_steps = 1000;
constexpr std::int64_t usual_steps_to_density = 300;  // fewer, as a step takes ten times as long

constexpr Param<std::int64_t> iterations{.name = "iterations",
                                         .low = 0,
                                         .high = 1'000'000,
                                         .optional = true,
                                         .unit = "steps",
                                         .help =
                                             "Gradient steps; more steps leave less power at low "
                                             "frequencies. Default: 1000, or 300 with a density"};

Plan plan(const Request& request, const Values& options) {
    const Plan plan = plan_in_proportion(request);
    check_density(options, plan.dimension);
    return plan;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    constexpr double most = 0x1p32;  // indices have 32 bits
    if (static_cast<double>(plan.count) >= most)
        fail(ErrorKind::limit, "gaussian-blue-noise makes fewer than 2^32 points; {} are too many",
             plan.count);
    const auto map = given_density(options, run);
    const double working = map ? density_relaxation_bytes(plan.count, *map)
                               : relaxation_bytes(plan.count, plan.dimension);
    const auto numbers = static_cast<double>(plan.count * plan.dimension);
    run.need_memory(8 * numbers + working, "gaussian-blue-noise");

    const auto extents = proportions_of(plan);
    const std::int64_t usual = map ? usual_steps_to_density : usual_steps;
    const std::int64_t steps = options.given(iterations) ? options[iterations] : usual;
    std::vector<double> rows;
    grow(rows, plan.count * plan.dimension, run);
    PointSet points(std::move(rows), plan.dimension);
    Rng(plan.seed).fill(0, points.flat());
    if (map) {
        for (std::size_t i = 0; i < points.count(); ++i)
            std::ranges::copy(map->place(points[i][0], points[i][1]), points[i].begin());
        relax_to_density(points.flat(), *map, static_cast<std::uint64_t>(steps), run, extents);
    } else {
        relax_gaussian(points.flat(), plan.dimension, static_cast<std::uint64_t>(steps), run,
                       extents);
    }
    put_in_box(plan, points);
    points.provenance.options = {{"iterations", std::to_string(steps)}};
    note_density(options, points);
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "gaussian-blue-noise",
            .summary = "Random points pushed apart by Gaussian kernels (blue noise)",
            .source = "Ahmed, Ren, Wonka 2022, doi:10.1145/3550454.3555519",
            .related = {"blue-noise"},
            .traits = {.max_dimension = relaxation_dimensions,
                       .sequence = false,
                       .prefix = false,
                       .boxed = true},
            .options = Schema(iterations, density_option, invert_option),
            .aliases = {"gbn"},
            .plan = plan,
            .set = make};
}

}  // namespace stipple::generators::gaussian_blue_noise
