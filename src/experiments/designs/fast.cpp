// SPDX-License-Identifier: MIT
//
// Design of the extended Fourier amplitude sensitivity test: for each of k factors one curve of N
// runs j = 0, ..., N - 1 through the cube. M is --harmonics;
//
//     x_i = 1/2 + asin(sin(2 pi (w_i j / N + phi_i))) / pi,
//
// which is a straight line that is reflected at the faces. On its own curve a factor has the
// frequency w = floor((N - 1) / (2 M)). The other factors have frequencies from 1, ..., m = floor(w
// / (2 M)): evenly spaced if there are enough of them, otherwise reused in turn. The phases phi_i
// are random, drawn anew for each curve and factor.
//
// Shape   n = N k, the curve of the first factor first; N at least 4 M^2 + 1.
// Promise x_i is within 1e-15 of the exact value.
// Source  A. Saltelli, S. Tarantola, K. P.-S. Chan, Technometrics 41 (1999) 39-56,
//         doi:10.1080/00401706.1999.10485594.

#include <algorithm>

#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "core/rng.hpp"
#include "experiments/designs/levels.hpp"

namespace stipple::generators::fast {
namespace {

constexpr Param<std::int64_t> harmonics{.name = "harmonics",
                                        .fallback = 4,
                                        .low = 1,
                                        .high = 1000,
                                        .help =
                                            "Number M of harmonics of a factor's frequency that "
                                            "count as the factor's; the analysis needs the same"};

constexpr std::uint64_t usual_curve = 1025;  // runs: 2 M w + 1 for M = 4, frequency w = 128

Plan plan(const Request& request, const Values& options) {
    const std::size_t k = request.dimension.value_or(2);
    const auto m = static_cast<std::uint64_t>(options[harmonics]);
    const std::uint64_t least = 4 * m * m + 1;
    const Plan plan = default_plan(request, std::max(usual_curve, least) * k, k);
    if (plan.count % k != 0 || plan.count / k < least)
        refuse_count(plan.count,
                     fmt::format("a multiple of {} (at least {} curves of {} runs)", k, k, least),
                     "fast", plan.count / k < least ? 0 : plan.count / k * k,
                     std::max(least, plan.count / k + 1) * k);
    return plan;
}

/// Frequencies, from 1 to `most`, of the `count` factors to which a curve does not belong.
std::vector<std::uint64_t> other_frequencies(std::size_t count, std::uint64_t most) {
    std::vector<std::uint64_t> others;
    for (std::uint64_t i = 0; i < count; ++i)
        others.push_back(most < count ? 1 + i % most
                         : count == 1 ? 1
                                      : 1 + i * (most - 1) / (count - 1));
    return others;
}

/// 1/2 + asin(sin(2 pi t)) / pi for t in [0, 2), kept below 1.
double triangle_wave(double t) {
    const double u = t < 1 ? t : t - 1;
    const double x = u <= 0.25 ? 0.5 + 2 * u : u <= 0.75 ? 1.5 - 2 * u : 2 * u - 1.5;
    return std::min(x, one_minus_ulp);
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext&) {
    const std::size_t k = plan.dimension;
    const std::uint64_t n = plan.count / k;
    const auto m = static_cast<std::uint64_t>(options[harmonics]);
    const std::uint64_t own = (n - 1) / (2 * m);
    const auto others = other_frequencies(k - 1, own / (2 * m));
    auto points =
        sequence_of([=, phases = Rng(plan.seed, 0)](std::uint64_t run, std::span<double> rows) {
            for (; !rows.empty(); rows = rows.subspan(k), ++run) {
                const std::uint64_t curve = run / n;
                const std::uint64_t j = run % n;
                for (std::size_t i = 0; i < k; ++i) {
                    const std::uint64_t w = i == curve ? own : others[i < curve ? i : i - 1];
                    const double turns = static_cast<double>(low_half(wide_product(w, j) % n)) /
                                         static_cast<double>(n);
                    rows[i] = triangle_wave(turns + phases.uniform(curve * k + i));
                }
            }
        });
    points->set_found([=] {
        Findings findings{{"frequency", std::to_string(own)}};
        if (!others.empty())
            findings.emplace_back("highest_other_frequency",
                                  std::to_string(std::ranges::max(others)));
        return findings;
    });
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "fast",
            .summary = "Curves of the extended Fourier amplitude sensitivity test (eFAST)",
            .source = "Saltelli, Tarantola, Chan 1999, doi:10.1080/00401706.1999.10485594",
            .related = {"sensitivity", "efast", "fourier-amplitude", "gsa", "salib"},
            .traits = {.max_dimension = 10'000, .prefix = false},
            .options = Schema(harmonics),
            .aliases = {"efast"},
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::fast
