// SPDX-License-Identifier: MIT
//
// Gaussian blue noise: random points of the unit torus, moved down the energy
//
//     E = sum over pairs i < j of  exp(-n^(2/d) |x_i - x_j|^2 / 2)
//
// by --iterations accelerated gradient steps (math/gaussian_relaxation.hpp). Points convolved with
// Gaussians of standard deviation sqrt(1/2) n^(-1/d), whose squares E adds up, come as near to
// a constant as they can: what is below the frequency n^(1/d) / 2 vanishes from the spectrum.
//
// Shape   d = 1 ... 4, distances on the torus.
// Cost    O(n) a step: 4096 points in 2-D and 1000 steps take 4.5 s of processor time; some 10 and
//         100 times as much in 3-D and 4-D.
// Promise the same bits for any number of threads.
// Beware  on the unit square; --bounds that are no square squash what is even.
// Source  A. G. M. Ahmed, J. Ren, P. Wonka, "Gaussian blue noise", ACM Trans. Graph. 41(6), 260
//         (2022), doi:10.1145/3550454.3555519; its sigma of 1 is this one.

#include "core/error.hpp"
#include "core/rng.hpp"
#include "generators/generator.hpp"
#include "math/gaussian_relaxation.hpp"

namespace stipple::generators {
namespace {

constexpr Param<std::int64_t> iterations{
    .name = "iterations",
    .fallback = 1000,
    .low = 0,
    .high = 1'000'000,
    .unit = "steps",
    .help = "Steps down the energy; the more, the emptier the spectrum below its peak"};

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    constexpr double most = 0x1p32;  // indices have 32 bits
    if (static_cast<double>(plan.count) >= most)
        fail(ErrorKind::limit, "gaussian-blue-noise makes fewer than 2^32 points; {} are too many",
             plan.count);
    const auto numbers = static_cast<double>(plan.count * plan.dimension);
    run.need_memory(8 * numbers + relaxation_bytes(plan.count, plan.dimension),
                    "gaussian-blue-noise");
    PointSet points(plan.count, plan.dimension);
    Rng(plan.seed).fill(0, points.flat());
    relax_gaussian(points.flat(), plan.dimension, static_cast<std::uint64_t>(options[iterations]),
                   run);
    return points;
}

}  // namespace

Generator gaussian_blue_noise() {
    return {.name = "gaussian-blue-noise",
            .summary = "Random points that Gaussian kernels have pushed apart (blue noise)",
            .source = "Ahmed, Ren, Wonka 2022, doi:10.1145/3550454.3555519",
            .traits = {.max_dimension = relaxation_dimensions, .sequence = false, .prefix = false},
            .options = Schema(iterations),
            .aliases = {"gbn"},
            .set = make};
}

}  // namespace stipple::generators
