// SPDX-License-Identifier: MIT
//
// Warps on one core: random points of the cube in blocks of 4096, forward and back.
#include <benchmark/benchmark.h>

#include "core/rng.hpp"
#include "core/spec.hpp"
#include "pipeline/pipeline.hpp"
#include "support/temporary_file.hpp"

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

/// Warps and methods of interest that need no file.
const std::vector<std::string> specs = {
    "annulus",
    "ball",
    "circle",
    "circle:method=square-normalize",
    "cone",
    "cylinder",
    "cylinder:caps=true",
    "discrete",
    "discrete:method=alias",
    "disk:method=polar",
    "disk:method=concentric",
    "disk:method=rejection",
    "disk:method=naive",
    "ellipse:method=polar,rotation=30",
    "ellipse:method=concentric,rotation=30",
    "exponential",
    "expression-1d:density=1+x",
    "expression-2d:density=1+x*y",
    "hemisphere:method=uniform",
    "hemisphere:method=cosine",
    "hemisphere:method=cosine,disk=concentric",
    "hemisphere:method=cosine-power",
    "henyey-greenstein",
    "mixture",
    "normal",
    "normal:covariance=[2,1,1,2]",
    "parallelogram",
    "parallelogram:edges=[1,0,0 0,1,1]",
    "pixel:resolution=640x480",
    "pixel:resolution=640x480,pixel=[17,4]",
    "polygon",
    "power:exponent=1",
    "power:exponent=2,range=[-1,1]",
    "power:exponent=2.5",
    "power:exponent=-1,range=[1,3]",
    "regular-polygon:sides=7",
    "rejection:density=x+y,bound=2",
    "sector:inner=0.5",
    "sphere:method=z",
    "sphere:method=rejection",
    "sphere:method=naive-lat-long",
    "spherical-rectangle",
    "spherical-triangle",
    "table-1d",
    "table-1d:interpolation=constant",
    "tent",
    "torus-surface",
    "torus-surface:minor-radius=1",
    "triangle:method=sqrt",
    "triangle:method=low-distortion",
    "triangle:method=low-distortion,vertices=[1,0,0 0,2,0 0,0,3]",
    "von-mises-fisher",
};

/// A square array of random bytes, as an NPY file.
std::string noise_npy(std::size_t side) {
    std::string head = "{'descr': '|u1', 'fortran_order': False, 'shape': (" +
                       std::to_string(side) + ", " + std::to_string(side) + "), }";
    head.resize(117, ' ');
    std::string bytes =
        std::string("\x93NUMPY\x01\x00", 8) + std::string("\x76\x00", 2) + head + '\n';
    const Rng rng(3);
    for (std::size_t i = 0; i < side * side; ++i) bytes += static_cast<char>(rng.bits(i) & 0xff);
    return bytes;
}

/// Cycles through many blocks of points, so that table entries used by one block are no longer in
/// the cache for the next.
void image(benchmark::State& state) {
    const testing::TemporaryFile file(noise_npy(static_cast<std::size_t>(state.range(0))), ".npy");
    const auto map = mapping_of("image:file=" + file.path());
    constexpr std::size_t blocks = 256;
    std::vector<double> cube(2 * block * blocks), rows(2 * block);
    Rng(1).fill(0, cube);
    std::size_t next = 0;
    for (auto _ : state) {
        map->forward(std::span<const double>(cube).subspan(2 * block * next, 2 * block), rows, {});
        next = (next + 1) % blocks;
        benchmark::DoNotOptimize(rows.data());
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(static_cast<std::int64_t>(block) * state.iterations());
}
BENCHMARK(image)->Name("warp/image/forward")->Arg(256)->Arg(4096);

bool has_inverse(const std::string& text) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    if (!warp.traits.invertible || mapping_of(text)->drops()) return false;
    return text != "discrete:method=alias" && text != "circle:method=square-normalize";
}

const bool registered = [] {
    for (const std::string& spec : specs) {
        benchmark::RegisterBenchmark(("warp/" + spec + "/forward").c_str(),
                                     [=](auto& state) { forward(state, spec); });
        if (!has_inverse(spec)) continue;
        benchmark::RegisterBenchmark(("warp/" + spec + "/inverse").c_str(),
                                     [=](auto& state) { inverse(state, spec); });
    }
    return true;
}();

}  // namespace
}  // namespace stipple
