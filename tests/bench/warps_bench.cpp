// SPDX-License-Identifier: MIT
//
// Warps, on one core: random points of the cube in blocks of 4096, forward and back.
#include <benchmark/benchmark.h>

#include "core/rng.hpp"
#include "core/spec.hpp"
#include "study/pipeline.hpp"

namespace stipple {
namespace {

constexpr std::size_t block = 4096;

std::unique_ptr<Mapping> mapping_of(const std::string& text) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    return warp.make(spec.values(warp.options), 2, {});
}

struct Rows {
    std::vector<double> cube;
    std::vector<double> image;
    std::vector<std::uint8_t> keep = std::vector<std::uint8_t>(block, 1);

    explicit Rows(const Mapping& map)
        : cube(block * map.cube_dimension()), image(block * map.domain()->dimension()) {
        Rng(1).fill(0, cube);
    }
};

void forward(benchmark::State& state, const std::string& text) {
    const auto map = mapping_of(text);
    Rows rows(*map);
    for (auto _ : state) {
        map->forward(rows.cube, rows.image, rows.keep);
        benchmark::DoNotOptimize(rows.image.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(block) * state.iterations());
}

void inverse(benchmark::State& state, const std::string& text) {
    const auto map = mapping_of(text);
    Rows rows(*map);
    map->forward(rows.cube, rows.image, rows.keep);
    for (auto _ : state) {
        map->inverse(rows.image, rows.cube);
        benchmark::DoNotOptimize(rows.cube.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(block) * state.iterations());
}

/// All warps and methods there is something to say of.
const std::vector<std::string> specs = {
    "annulus",
    "disk:method=polar",
    "disk:method=concentric",
    "disk:method=rejection",
    "disk:method=naive",
    "ellipse:method=polar,rotation=30",
    "ellipse:method=concentric,rotation=30",
    "parallelogram",
    "parallelogram:edges=[1,0,0 0,1,1]",
    "pixel:resolution=640x480",
    "pixel:resolution=640x480,pixel=[17,4]",
    "polygon",
    "regular-polygon:sides=7",
    "sector:inner=0.5",
    "tent",
    "triangle:method=sqrt",
    "triangle:method=low-distortion",
    "triangle:method=low-distortion,vertices=[1,0,0 0,2,0 0,0,3]",
};

const bool registered = [] {
    for (const std::string& spec : specs) {
        benchmark::RegisterBenchmark(("warp/" + spec + "/forward").c_str(),
                                     [=](auto& state) { forward(state, spec); });
        if (spec == "disk:method=rejection") continue;  // the points outside have no way back
        benchmark::RegisterBenchmark(("warp/" + spec + "/inverse").c_str(),
                                     [=](auto& state) { inverse(state, spec); });
    }
    return true;
}();

}  // namespace
}  // namespace stipple
