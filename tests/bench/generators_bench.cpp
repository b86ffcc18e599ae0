// SPDX-License-Identifier: MIT
//
// Points per second on one core. Sequences fill cache-sized blocks one after the other, with points
// of 2 (20) dimensions; sets are made as a whole.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "pipeline/pipeline.hpp"

namespace stipple {
namespace {

void fill_blocks(benchmark::State& state, const std::string& name, const Settings& settings,
                 std::size_t dimension) {
    const Generator& generator = find_generator(name);
    Values values = generator.options.defaults();
    bool square = false;  // the square of a prime
    for (const auto& [option, text] : settings) {
        generator.options.set(values, option, text);
        square = square || text == "bose";
    }
    const std::uint64_t count = square ? 1'048'573ULL * 1'048'573 : std::uint64_t{1} << 40;
    const Request request{.count = count, .dimension = dimension};
    const auto sequence = generator.sequence(plan_for(generator, request, values), values, {});

    std::vector<double> rows(8192 / dimension * dimension);
    const std::size_t block = rows.size() / dimension;
    std::uint64_t first = 0;
    for (auto _ : state) {
        sequence->fill(first, rows);
        benchmark::DoNotOptimize(rows.data());
        benchmark::ClobberMemory();
        first += block;
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(first));
}

void make_set(benchmark::State& state, const std::string& name, const Request& request,
              const Settings& settings) {
    std::size_t made = 0;
    for (auto _ : state) made += generate(name, request, settings, {.threads = 1}).count();
    state.SetItemsProcessed(static_cast<std::int64_t>(made));
}

void search_vector(benchmark::State& state, const std::string& name, const Request& request,
                   const Settings& settings) {
    const Generator& generator = find_generator(name);
    Values values = generator.options.defaults();
    for (const auto& [option, text] : settings) generator.options.set(values, option, text);
    for (auto _ : state)
        benchmark::DoNotOptimize(
            generator.sequence(plan_for(generator, request, values), values, {}).get());
}

/// Makes a whole array, as other libraries do, including the time for its memory.
void make_array(benchmark::State& state, const std::string& name, const Settings& settings,
                std::size_t dimension) {
    const Request request{.count = std::uint64_t{1} << 20, .dimension = dimension};
    std::size_t made = 0;
    for (auto _ : state) made += generate(name, request, settings, {.threads = 1}).count();
    state.SetItemsProcessed(static_cast<std::int64_t>(made));
}

std::string label_of(const std::string& name, const Settings& settings, std::size_t dimension) {
    std::string label = name;
    for (const auto& [option, text] : settings) label += "/" + text;
    return fmt::format("{}/{}d", label, dimension);
}

/// Benchmarks in blocks that fit into the cache.
void add_blocks(const std::string& name, const std::vector<std::size_t>& dimensions,
                const Settings& settings = {}) {
    for (const std::size_t d : dimensions)
        benchmark::RegisterBenchmark(label_of(name, settings, d).c_str(),
                                     [=](auto& state) { fill_blocks(state, name, settings, d); });
}

/// Benchmarks as whole arrays; compare_scipy.py uses their names.
void add_arrays(const std::string& name, const Settings& settings = {}) {
    for (const std::size_t d : {2U, 20U})
        benchmark::RegisterBenchmark(("array/" + label_of(name, settings, d)).c_str(),
                                     [=](auto& state) { make_array(state, name, settings, d); })
            ->Unit(benchmark::kMillisecond);
}

void add_sequences() {
    for (const char* rng : {"philox", "mt19937-64", "drand48", "ranlux48", "ranmar", "random"})
        add_blocks("random", {2}, {{"rng", rng}});
    // 2^40 = 4^20 points, so that the count is also a 20th power.
    for (const char* name : {"random", "grid", "jittered", "hammersley", "kronecker", "faure",
                             "niederreiter", "latin-hypercube"})
        add_blocks(name, {2, 20});
    for (const char* scramble : {"none", "digital-shift", "matrix", "owen"})
        add_blocks("sobol", {2, 20}, {{"scramble", scramble}});
    add_blocks("sobol", {2}, {{"order", "gray"}});
    for (const char* scramble : {"none", "faure", "permutation", "owen"})
        add_blocks("halton", {2, 20}, {{"scramble", scramble}});
    for (const char* scramble : {"digital-shift", "matrix", "owen"})
        add_blocks("faure", {3, 20}, {{"scramble", scramble}});
    for (const char* base : {"2", "10"}) add_blocks("van-der-corput", {1}, {{"base", base}});
    add_blocks("rank1-lattice", {2, 20}, {{"rule", "korobov"}, {"multiplier", "364981"}});
    for (const char* name : {"multi-jittered", "correlated-multi-jittered", "pmj", "pmj02"})
        add_blocks(name, {2});
    for (const char* construction : {"bose", "cmj"})
        add_blocks("orthogonal-array", {4}, {{"construction", construction}});
}

void add_searches() {
    const auto add = [](const std::string& name, std::uint64_t n) {
        benchmark::RegisterBenchmark(fmt::format("{}/cbc/{}x100", name, n).c_str(), [=](auto&
                                                                                            state) {
            search_vector(state, name, {.count = n, .dimension = 100}, {{"rule", "cbc"}});
        })->Unit(benchmark::kMillisecond);
    };
    for (const std::uint64_t n : {1'048'576U, 1'048'573U}) add("rank1-lattice", n);
    add("polynomial-lattice", 1'048'576);
}

/// About 10^5 points; 4096 for methods that move points many times.
void add_sets() {
    const auto add = [](const std::string& name, const char* label, const Request& request,
                        const Settings& settings) {
        benchmark::RegisterBenchmark((name + label).c_str(), [=](auto& state) {
            make_set(state, name, request, settings);
        })->Unit(benchmark::kMillisecond);
    };
    add("poisson-disk", "/1e5", {}, {{"radius", "0.00248"}});
    add("poisson-disk", "/1e5_exactly", {.count = 100'000}, {});
    add("poisson-disk", "/3d", {.dimension = 3}, {{"radius", "0.0179"}});
    for (const char* name : {"best-candidate", "dart-throwing", "sample-elimination"})
        add(name, "/1e5", {.count = 100'000}, {});
    for (const char* name : {"lloyd", "farthest-point", "capacity-constrained",
                             "gaussian-blue-noise", "tiled", "void-and-cluster"})
        add(name, "/4096", {.count = 4096}, {});
}

const bool registered = [] {
    add_sequences();
    for (const char* scramble : {"none", "matrix", "owen"})
        add_arrays("sobol", {{"scramble", scramble}});
    for (const char* scramble : {"none", "permutation", "owen"})
        add_arrays("halton", {{"scramble", scramble}});
    add_arrays("latin-hypercube");
    add_arrays("random");
    add_searches();
    add_sets();
    return true;
}();

}  // namespace
}  // namespace stipple

BENCHMARK_MAIN();
