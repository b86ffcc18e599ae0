// SPDX-License-Identifier: MIT
//
// Points a second, on one core. Sequences fill cache-sized blocks, one after the other, with points
// of two (20) dimensions; a set is made as a whole.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "study/pipeline.hpp"

namespace stipple {
namespace {

void fill_blocks(benchmark::State& state, const std::string& name, const Settings& settings,
                 std::size_t dimension) {
    const Generator& generator = find_generator(name);
    Values values = generator.options.defaults();
    for (const auto& [option, text] : settings) generator.options.set(values, option, text);
    const Request request{.count = std::uint64_t{1} << 40, .dimension = dimension};
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

void make_set(benchmark::State& state, const Request& request, const Settings& settings) {
    std::size_t made = 0;
    for (auto _ : state)
        made += generate("poisson-disk", request, settings, {.threads = 1}).count();
    state.SetItemsProcessed(static_cast<std::int64_t>(made));
}

void search_vector(benchmark::State& state, const Request& request, const Settings& settings) {
    const Generator& generator = find_generator("rank1-lattice");
    Values values = generator.options.defaults();
    for (const auto& [option, text] : settings) generator.options.set(values, option, text);
    for (auto _ : state)
        benchmark::DoNotOptimize(
            generator.sequence(plan_for(generator, request, values), values, {}).get());
}

/// A whole array, as a peer gives it: with the time that its memory takes.
void make_array(benchmark::State& state, const std::string& name, const Settings& settings,
                std::size_t dimension) {
    const Request request{.count = std::uint64_t{1} << 20, .dimension = dimension};
    std::size_t made = 0;
    for (auto _ : state) made += generate(name, request, settings, {.threads = 1}).count();
    state.SetItemsProcessed(static_cast<std::int64_t>(made));
}

const bool registered = [] {
    const auto add = [](const std::string& label, const std::string& name,
                        const Settings& settings = {}, std::size_t dimension = 2) {
        benchmark::RegisterBenchmark(
            label.c_str(), [=](auto& state) { fill_blocks(state, name, settings, dimension); });
    };
    for (const char* rng : {"philox", "mt19937-64", "drand48", "ranlux48", "ranmar", "random"})
        add(std::string("random/") + rng, "random", {{"rng", rng}});
    for (const char* name : {"grid", "jittered", "halton", "hammersley", "kronecker"})
        add(name, name);
    for (const char* name : {"random", "grid", "jittered", "halton", "hammersley", "kronecker"})
        // 2^40 = 4^20 points: a power of two in 20 dimensions as well.
        add(std::string(name) + "/20d", name, {}, 20);
    for (const char* scramble : {"none", "digital-shift", "matrix", "owen"})
        for (const std::size_t dimension : {std::size_t{2}, std::size_t{20}})
            add(fmt::format("sobol/{}/{}d", scramble, dimension), "sobol", {{"scramble", scramble}},
                dimension);
    add("sobol/gray/2d", "sobol", {{"order", "gray"}});
    add("niederreiter/2d", "niederreiter");
    for (const char* scramble : {"none", "owen"})
        for (const std::size_t dimension : {std::size_t{2}, std::size_t{20}}) {
            const Settings settings{{"scramble", scramble}};
            benchmark::RegisterBenchmark(
                fmt::format("array/sobol/{}/{}d", scramble, dimension).c_str(),
                [=](auto& state) { make_array(state, "sobol", settings, dimension); })
                ->Unit(benchmark::kMillisecond);
        }
    for (const char* scramble : {"none", "permutation", "owen"})
        for (const std::size_t dimension : {std::size_t{2}, std::size_t{20}}) {
            const Settings settings{{"scramble", scramble}};
            benchmark::RegisterBenchmark(
                fmt::format("array/halton/{}/{}d", scramble, dimension).c_str(),
                [=](auto& state) { make_array(state, "halton", settings, dimension); })
                ->Unit(benchmark::kMillisecond);
        }

    add("van-der-corput/base_2", "van-der-corput", {}, 1);
    add("van-der-corput/base_10", "van-der-corput", {{"base", "10"}}, 1);
    for (const char* scramble : {"faure", "permutation", "owen"})
        for (const std::size_t d : {2U, 20U})
            add("halton/" + std::string(scramble) + (d == 2 ? "" : "/20d"), "halton",
                {{"scramble", scramble}}, d);
    const Settings korobov = {{"rule", "korobov"}, {"multiplier", "364981"}};
    add("rank1-lattice", "rank1-lattice", korobov);
    add("rank1-lattice/20d", "rank1-lattice", korobov, 20);
    for (const std::uint64_t n : {std::uint64_t{1} << 20, std::uint64_t{1'048'573}})
        benchmark::RegisterBenchmark(
            ("rank1-lattice/cbc/" + std::to_string(n) + "x100").c_str(),
            [n](auto& state) {
                search_vector(state, {.count = n, .dimension = 100}, {{"rule", "cbc"}});
            })
            ->Unit(benchmark::kMillisecond);

    const auto set = [](const char* label, const Request& request, const Settings& settings) {
        benchmark::RegisterBenchmark(label, [=](auto& state) {
            make_set(state, request, settings);
        })->Unit(benchmark::kMillisecond);
    };
    set("poisson-disk/1e5", {}, {{"radius", "0.00248"}});
    set("poisson-disk/1e5_exactly", {.count = 100'000}, {});
    set("poisson-disk/3d", {.dimension = 3}, {{"radius", "0.0179"}});
    return true;
}();

}  // namespace
}  // namespace stipple

BENCHMARK_MAIN();
