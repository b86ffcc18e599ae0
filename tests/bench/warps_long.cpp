// SPDX-License-Identifier: MIT
//
// Tests every warp, with every method, on ten million random and hostile points each:
//
//     stipple_warps_long [POINTS [SPEC...]]
//
// Half of the coordinates are random; the others are ends of [0, 1], numbers next to them at any
// scale including denormals, and simple fractions with their neighbours. Every image must be finite
// and in the domain, have a nonnegative density, and have coordinates in [0, 1] in the domain's
// cube. If there is an inverse, it must return a point of the closed cube that equals the original
// or has the same image within 1e-12, relative to 1 or the domain's size, or to the image's size in
// infinite domains. Prints one line per warp; exit code 1 if one fails. Takes minutes on two cores,
// so it is not among the tests.

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <mutex>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/spec.hpp"
#include "core/text.hpp"
#include "pipeline/pipeline.hpp"
#include "places.hpp"
#include "warps/warp.hpp"

using namespace stipple;

namespace {

constexpr double tolerance = 1e-12;

double hostile(std::uint64_t bits) {
    const double any = to_unit(bits);
    const auto scale = static_cast<int>(bits / 16 % 64);
    const double fraction = static_cast<double>(scale % 25) / 24;
    switch (bits % 16) {
        case 0:
            return scale < 32 ? 0 : 1 - 0x1p-53;
        case 1:
        case 2:
            return std::ldexp(any, -scale);
        case 3:
            return std::ldexp(any, -17 * scale);  // including denormals
        case 4:
        case 5:
            return std::min(1 - std::ldexp(any, -scale), 1 - 0x1p-53);
        case 6:
            return std::nextafter(fraction, 0);
        case 7:
            return std::min({fraction, std::nextafter(fraction, 2), 1 - 0x1p-53});
        case 8:
            return std::min(std::nextafter(fraction, 2), 1 - 0x1p-53);
        default:
            return any;
    }
}

struct Findings {
    std::uint64_t kept = 0;
    std::uint64_t wild = 0;       ///< not finite
    std::uint64_t outside = 0;    ///< of the domain
    std::uint64_t densities = 0;  ///< negative or NaN
    std::uint64_t cells = 0;      ///< not in the domain's cube
    std::uint64_t backs = 0;      ///< not in the unit cube
    double worst = 0;             ///< largest relative error of the image of an inverse
    std::vector<double> at;       ///< point with the largest error or another failure

    void add(const Findings& other) {
        kept += other.kept;
        wild += other.wild;
        outside += other.outside;
        densities += other.densities;
        cells += other.cells;
        backs += other.backs;
        if (other.worst > worst || at.empty()) at = other.at;
        worst = std::max(worst, other.worst);
    }
    [[nodiscard]] bool fine() const {
        return wild + outside + densities + cells + backs == 0 && worst <= tolerance;
    }
};

bool in_cube(std::span<const double> point) {
    return std::ranges::all_of(point, [](double u) { return u >= 0 && u <= 1; });
}

/// Largest coordinate of the domain; 0 if it is infinite.
double size_of(const Domain& domain) {
    if (!(domain.measure() < std::numeric_limits<double>::infinity())) return 0;
    const Box box = domain.bounding_box();
    double size = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k)
        size = std::max({size, std::abs(box.low[k]), std::abs(box.high[k])});
    return size;
}

/// One block of points with their images and inverses.
struct Batch {
    Batch(const Mapping& by, bool way_back, std::uint64_t first, std::uint64_t last)
        : map(by),
          in(by.cube_dimension()),
          out(by.domain()->dimension()),
          count(last - first),
          rows(count * in),
          image(count * out),
          keep(count, 1),
          returns(way_back) {
        const Rng rng(29);
        for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = hostile(rng.bits(first * in + i));
        map.forward(rows, image, keep);
    }

    Findings judge() {
        std::vector<std::uint8_t> good(count);
        for (std::size_t i = 0; i < count; ++i) good[i] = keep[i] && is_good(i);
        if (returns) go_back(good);
        return found;
    }

  private:
    bool is_good(std::size_t i) {
        ++found.kept;
        const auto point = std::span<const double>(image).subspan(i * out, out);
        cell.resize(map.domain()->cube_dimension());
        const bool finite = std::ranges::all_of(point, [](double x) { return std::isfinite(x); });
        const bool inside = finite && map.domain()->contains(point);
        if (inside) map.domain()->to_cube(point, cell);
        const bool dense = !inside || map.density(point) >= 0;
        const bool placed = !inside || in_cube(cell);
        found.wild += !finite;
        found.outside += finite && !inside;
        found.densities += !dense;
        found.cells += !placed;
        if (!(inside && dense && placed)) blame(i);
        return inside && dense && placed;
    }

    void blame(std::size_t i) {
        found.at.assign(rows.begin() + static_cast<std::ptrdiff_t>(i * in),
                        rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * in));
    }

    void go_back(const std::vector<std::uint8_t>& good) {
        std::vector<double> there;
        std::vector<std::size_t> which;
        for (std::size_t i = 0; i < count; ++i) {
            if (!good[i]) continue;
            which.push_back(i);
            there.insert(there.end(), &image[i * out], &image[i * out] + out);
        }
        std::vector<double> back(which.size() * in), again(there.size());
        std::vector<std::uint8_t> kept(which.size(), 1);
        map.inverse(there, back);
        map.forward(back, again, kept);
        const double size = size_of(*map.domain());
        for (std::size_t i = 0; i < which.size(); ++i) {
            if (!in_cube(std::span<const double>(back).subspan(i * in, in))) {
                ++found.backs;
                blame(which[i]);
            }
            double off = 0;
            double scale = size;
            for (std::size_t k = 0; k < out; ++k) {
                off = std::max(off, std::abs(again[i * out + k] - there[i * out + k]));
                if (size == 0) scale = std::max(scale, std::abs(there[i * out + k]));
            }
            // Near zeros of the density, neighbouring coordinates have distant images.
            const double error = std::min(off / scale, coordinate_error(back, i, which[i]));
            if (off == 0 || error <= found.worst) continue;
            found.worst = error;
            blame(which[i]);
        }
    }

    [[nodiscard]] double coordinate_error(const std::vector<double>& back, std::size_t i,
                                          std::size_t from) const {
        double error = 0;
        for (std::size_t k = 0; k < in; ++k)
            error = std::max(error, std::abs(back[i * in + k] - rows[from * in + k]));
        return error;
    }

    const Mapping& map;
    std::size_t in;
    std::size_t out;
    std::size_t count;
    std::vector<double> rows;
    std::vector<double> image;
    std::vector<std::uint8_t> keep;
    bool returns;
    std::vector<double> cell;
    Findings found;
};

/// A picture file that exists while the program runs.
class PictureFile {
  public:
    PictureFile() {
        std::ofstream file(path_, std::ios::binary);
        file << "Pf\n3 2\n-1.0\n";
        for (const float x : {1.0F, 0.0F, 3.0F, 4.0F, 2.0F, 1e-6F})
            file.write(reinterpret_cast<const char*>(&x), sizeof x);
    }
    PictureFile(const PictureFile&) = delete;
    PictureFile& operator=(const PictureFile&) = delete;
    ~PictureFile() { std::filesystem::remove(path_); }
    [[nodiscard]] const std::string& path() const { return path_; }

  private:
    std::string path_ =
        (std::filesystem::temp_directory_path() / fmt::format("warps_long.{}.pfm", ::getpid()))
            .string();
};

std::vector<std::string> specs(const PictureFile& picture) {
    std::vector<std::string> list = {
        "parallelogram:edges=[1,0.5,0 0,1,2]",
        "triangle:method=low-distortion",
        "triangle:vertices=[0,0,1 2,0,0 0,1,0]",
        "polygon:vertices=[0,0 4,0 4,4 0,4 / 1,1 3,1 3,3 1,3]",
        "disk:method=concentric",
        "disk:method=rejection",
        "disk:method=naive",
        "disk:center=[1000,-3],radius=0.01",
        "annulus:inner=0.999999",
        "ellipse:method=concentric,rotation=33,axes=[1,0.001]",
        "sector:angles=[-170,175],inner=0.25",
        "regular-polygon:sides=3",
        "regular-polygon:sides=1000",
        "pixel:resolution=1920x1080",
        "tent:radius=3,center=100",
        "circle:method=square-normalize",
        "sphere:method=rejection",
        "sphere:method=naive-lat-long",
        "hemisphere:method=cosine,axis=[1,2,-3]",
        "hemisphere:method=cosine,disk=concentric",
        "hemisphere:method=cosine-power,exponent=0.25",
        "hemisphere:method=cosine-power,exponent=1000",
        "cone:half-angle=0.001",
        "cone:half-angle=179.9,axis=[1,1,1]",
        "spherical-triangle:vertices=[1,0,0 1,0.001,0 1,0,0.001]",
        "spherical-rectangle:corner=[-100,-100,0.5],edges=[200,0,0 0,200,0]",
        "ball:radius=3,center=[1,2,3]",
        "normal:mean=[1,2],covariance=[4,1.9,1.9,1]",
        "exponential:rate=1000",
        "power:exponent=2,range=[-1,1]",
        "power:exponent=-0.5",
        "power:exponent=300",
        "power:exponent=-2,range=[1,1e6]",
        "discrete:probabilities=[0.1,0,0.9],method=alias",
        "table-1d:rows=[0,0 1,2 1,5 3,0],interpolation=linear",
        "table-1d:rows=[0,1 1,0 3,2 4,0],interpolation=constant",
        "henyey-greenstein:g=0.999",
        "henyey-greenstein:g=-0.999999",
        "von-mises-fisher:kappa=1e-9",
        "von-mises-fisher:kappa=1e8",
        "mixture:components=[disk|disk:center=[2,0]]"};
    for (const Warp& warp : warps::all()) list.push_back(warp.name);
    const std::vector<std::pair<std::string, std::string>> needed = {
        {"expression-1d", "expression-1d:density=1+x"},
        {"expression-2d", "expression-2d:density=1+x*y"},
        {"image", "image:file=" + picture.path()},
        {"mesh", "mesh:file=" STIPPLE_SOURCE_DIR "/tests/support/tetrahedron.obj"},
        {"rejection", "rejection:density=x+y,bound=2"}};
    for (const auto& [name, example] : needed) std::ranges::replace(list, name, example);
    std::ranges::sort(list);
    return list;
}

/// Whether the method has an inverse; other methods of the warp may differ.
bool has_way_back(const Warp& warp, const Mapping& map) {
    if (!warp.traits.invertible || map.drops()) return false;
    try {
        map.inverse({}, {});
        return true;
    } catch (const Error& e) {
        if (e.kind() != ErrorKind::usage) throw;
        return false;
    }
}

/// Tests a warp and prints its line; returns whether it passed.
bool stands(const std::string& text, std::uint64_t points, const RunContext& run) {
    const Spec spec = parse_spec(text);
    const Warp& warp = find_warp(spec.name);
    const auto map = warp.make(spec.values(warp.options), 2, run);
    const bool back = has_way_back(warp, *map);
    Findings all;
    std::mutex adding;
    for_each_block(run, points, 4096, [&](const Block& block) {
        const Findings some = Batch(*map, back, block.first, block.last).judge();
        const std::lock_guard lock(adding);
        all.add(some);
    });
    const std::string worst = back ? fmt::format("back within {:.1e}", all.worst) : "no way back";
    fmt::print("{:4} {:60} {} images, {}", all.fine() ? "ok" : "BAD", text, all.kept, worst);
    if (!all.fine())
        fmt::print(
            "; {} not finite, {} outside, {} bad densities, {} bad cells, {} back outside; "
            "at {}",
            all.wild, all.outside, all.densities, all.cells, all.backs, fmt::join(all.at, ", "));
    fmt::print("\n");
    std::fflush(stdout);
    return all.fine();
}

}  // namespace

int main(int count, char** words) {
    const std::vector<std::string> given(words + 1, words + count);
    try {
        const auto points = given.empty() ? 1e7 : parse_number(given[0]).value_or(0);
        if (!(points >= 1 && points <= 1e12))
            fail(ErrorKind::usage, "stipple_warps_long [POINTS [SPEC...]]: '{}' is not a number",
                 given[0]);
        const PictureFile picture;
        const auto list = given.size() > 1
                              ? std::vector<std::string>(given.begin() + 1, given.end())
                              : specs(picture);
        const RunContext run;
        bool fine = true;
        for (const auto& spec : list)
            fine = stands(spec, static_cast<std::uint64_t>(points), run) && fine;
        return fine ? 0 : 1;
    } catch (const Error& error) {
        fmt::print(stderr, "stipple_warps_long: {}\n", error.what());
        return 2;
    }
}
