// SPDX-License-Identifier: MIT
//
// Analyzers on one core: time per set, and its growth with the number of points.
#include <benchmark/benchmark.h>

#include <cmath>
#include <string>

#include "pipeline/pipeline.hpp"

namespace {

using namespace stipple;

void measure(benchmark::State& state, const char* analyzer, const char* generator,
             const Settings& settings = {}) {
    const auto count = static_cast<std::uint64_t>(state.range(0));
    const auto dimension = static_cast<std::size_t>(state.range(1));
    const PointSet points = generate(generator, {.count = count, .dimension = dimension});
    for (auto _ : state)
        benchmark::DoNotOptimize(analyze(analyzer, points, settings, {.threads = 1}));
    state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}

/// In two dimensions, where the time grows as n^(4/3).
void star_discrepancy_random(benchmark::State& state) {
    measure(state, "star-discrepancy", "random");
    state.SetComplexityN(state.range(0));
}
double to_the_four_thirds(benchmark::IterationCount n) {
    return std::pow(static_cast<double>(n), 4.0 / 3);
}
void star_discrepancy_halton(benchmark::State& state) {
    measure(state, "star-discrepancy", "halton");
}
void l2_discrepancy(benchmark::State& state) { measure(state, "l2-discrepancy", "sobol"); }
void l2_star(benchmark::State& state) {
    measure(state, "l2-discrepancy", "sobol", {{"kind", "star"}});
}
void l2_centered(benchmark::State& state) {
    measure(state, "l2-discrepancy", "sobol", {{"kind", "centered"}});
}
void l2_wraparound(benchmark::State& state) {
    measure(state, "l2-discrepancy", "sobol", {{"kind", "wraparound"}});
}
void l2_mixture(benchmark::State& state) {
    measure(state, "l2-discrepancy", "sobol", {{"kind", "mixture"}});
}
void extreme_discrepancy_random(benchmark::State& state) {
    measure(state, "star-discrepancy", "random", {{"kind", "extreme"}});
}
void extreme_discrepancy_halton(benchmark::State& state) {
    measure(state, "star-discrepancy", "halton", {{"kind", "extreme"}});
}
void periodic_discrepancy_halton(benchmark::State& state) {
    measure(state, "star-discrepancy", "halton", {{"kind", "periodic"}});
}
void dispersion_random(benchmark::State& state) { measure(state, "dispersion", "random"); }
void dispersion_on_torus(benchmark::State& state) {
    measure(state, "dispersion", "random", {{"torus", "true"}});
}
void star_discrepancy_sobol(benchmark::State& state) {
    measure(state, "star-discrepancy", "sobol");
}
void star_discrepancy_of_many_axes(benchmark::State& state) {
    measure(state, "star-discrepancy", "random");
}
void star_discrepancy_bounds(benchmark::State& state) {
    measure(state, "star-discrepancy", "sobol", {{"method", "bounds"}, {"tolerance", "0.1"}});
}
/// Two dimensions; arguments are the maximum frequency, the tolerance's exponent and the threads.
void periodogram(benchmark::State& state) {
    const auto count = static_cast<std::uint64_t>(state.range(0));
    const PointSet points = generate("random", {.count = count, .dimension = 2});
    const Settings settings = {{"max-frequency", std::to_string(state.range(1))},
                               {"tolerance", "1e-" + std::to_string(state.range(2))}};
    const RunContext run{.threads = static_cast<unsigned>(state.range(3))};
    for (auto _ : state) benchmark::DoNotOptimize(analyze("periodogram", points, settings, run));
    state.SetItemsProcessed(static_cast<std::int64_t>(count) * state.iterations());
}
/// For comparison the direct sum, at as many frequencies as take about a second.
void periodogram_direct(benchmark::State& state) {
    measure(state, "periodogram", "random", {{"max-frequency", "32"}, {"method", "direct"}});
}
void periodogram_beside_direct(benchmark::State& state) {
    measure(state, "periodogram", "random", {{"max-frequency", "32"}});
}
void chi_square(benchmark::State& state) { measure(state, "chi-square", "random"); }
void nearest_neighbor(benchmark::State& state) { measure(state, "nearest-neighbor", "random"); }
void nearest_neighbor_halton(benchmark::State& state) {
    measure(state, "nearest-neighbor", "halton");
}
/// 10^6 points, distances up to 10 mean distances: 1.6e8 pairs.
void pair_correlation(benchmark::State& state) {
    measure(state, "pair-correlation", "random",
            {{"max-distance", "10"}, {"normalize-distance", "true"}});
}
void coverage(benchmark::State& state) { measure(state, "coverage", "random"); }
void t_value_of_a_net(benchmark::State& state) { measure(state, "t-value", "hammersley"); }
void t_value_of_halton(benchmark::State& state) { measure(state, "t-value", "halton"); }

}  // namespace

BENCHMARK(star_discrepancy_random)
    ->RangeMultiplier(4)
    ->Ranges({{1 << 10, 1 << 22}, {2, 2}})
    ->Complexity(to_the_four_thirds)
    ->Unit(benchmark::kMillisecond);
BENCHMARK(star_discrepancy_halton)
    ->Args({65'536, 2})
    ->Args({1'000'000, 2})
    ->Args({4096, 3})
    ->Args({16'384, 3})
    ->Args({1000, 4})
    ->Args({1000, 5})
    ->Args({1000, 6})
    ->Args({300, 8})
    ->Args({200, 10})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(l2_discrepancy)
    ->Args({1024, 2})
    ->Args({16'384, 2})
    ->Args({262'144, 2})
    ->Args({1'000'000, 2})
    ->Args({4'194'304, 2})
    ->Unit(benchmark::kMillisecond);
// Growth with n in five dimensions, and the sizes that are compared with SciPy.
BENCHMARK(l2_star)
    ->Args({1024, 5})
    ->Args({4096, 5})
    ->Args({16'384, 5})
    ->Args({65'536, 5})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(l2_centered)->Args({16'384, 5})->Unit(benchmark::kMillisecond);
BENCHMARK(l2_wraparound)
    ->Args({1024, 5})
    ->Args({4096, 5})
    ->Args({16'384, 5})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(l2_mixture)->Args({16'384, 5})->Unit(benchmark::kMillisecond);
BENCHMARK(extreme_discrepancy_random)
    ->Args({1024, 2})
    ->Args({4096, 2})
    ->Args({16'384, 2})
    ->Args({32, 3})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(extreme_discrepancy_halton)
    ->Args({512, 2})
    ->Args({1024, 2})
    ->Args({2048, 2})
    ->Args({4096, 2})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(periodic_discrepancy_halton)
    ->Args({256, 2})
    ->Args({512, 2})
    ->Args({1024, 2})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dispersion_random)
    ->Args({10'000, 2})
    ->Args({100'000, 2})
    ->Args({1'000'000, 2})
    ->Args({100, 3})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(dispersion_on_torus)
    ->Args({10'000, 2})
    ->Args({100'000, 2})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(star_discrepancy_sobol)
    ->Args({128, 9})
    ->Args({128, 12})
    ->Args({100, 15})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(star_discrepancy_of_many_axes)
    ->Args({50, 20})
    ->Args({100, 20})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(star_discrepancy_bounds)->Args({128, 12})->Args({256, 12})->Unit(benchmark::kMillisecond);
BENCHMARK(periodogram)
    ->ArgNames({"n", "F", "digits", "threads"})
    ->Args({4096, 320, 9, 1})
    ->Args({1'000'000, 512, 6, 1})
    ->Args({10'000'000, 512, 6, 1})
    ->Args({10'000'000, 512, 9, 1})
    ->Args({10'000'000, 512, 6, 2})
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(periodogram_direct)->Args({4096, 2})->Unit(benchmark::kMillisecond);
BENCHMARK(periodogram_beside_direct)->Args({4096, 2})->Unit(benchmark::kMillisecond);
BENCHMARK(chi_square)->Args({1'000'000, 2})->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_neighbor)
    ->Args({100'000, 2})
    ->Args({1'000'000, 2})
    ->Args({1'000'000, 3})
    ->Args({1'000'000, 5})
    ->Args({100'000, 6})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(nearest_neighbor_halton)->Args({1'000'000, 2})->Unit(benchmark::kMillisecond);
BENCHMARK(pair_correlation)
    ->Args({10'000, 2})
    ->Args({1'000'000, 2})
    ->Args({10'000, 3})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(coverage)
    ->Args({100'000, 2})
    ->Args({1'000'000, 2})
    ->Args({10'000, 3})
    ->Args({300, 6})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(t_value_of_a_net)->Args({16'384, 2})->Args({1 << 20, 2})->Unit(benchmark::kMillisecond);
BENCHMARK(t_value_of_halton)->Args({16'384, 2})->Args({16'384, 10})->Unit(benchmark::kMillisecond);
