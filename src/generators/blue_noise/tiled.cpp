// SPDX-License-Identifier: MIT
//
// A tile of blue noise, repeated and thinned to n points. On the unit square
//
//     K x K tiles of t = ceil(n / K^2) points,  K = min {k : k^2 T >= n},  T = --tile-points.
//
// The tile is toroidal Gaussian blue noise (relaxation/gaussian_relaxation.cpp) with ranked points:
// the first m of them are well spread, for every m. Ranks are given from the last to the first:
// each time, the most crowded of the remaining points is removed,
//
//     argmax over i of  sum over j of exp(-|x_i - x_j|^2 / (2 sigma^2)),
//
// as void-and-cluster removes cells; sigma is 0.47 of the mean distance of all points, and doubles
// when a quarter is left. Coordinates are multiples of 2^-28, so that those of repeated tiles are
// exact sums.
//
// Points of the set are ordered by rank: those of rank 0 in all tiles, row by row; then those of
// rank 1, and so on. The last rank has only m = n - K^2 (t - 1) points, spread evenly over the
// tiles: the j-th is in tile floor(j K^2 / m).
//
// --bounds    in a box that is not a square, K x L nearly square tiles, few more than needed. The
//             tile is optimised with the proportions that it has in the box, so the set is even and
//             periodic there. Points stay in [0, 1)^2 until they are scaled.
// --density   tiles of t = ceil((n + 2 sqrt(n)) top / K^2) points, top the largest density over its
//             mean. Ranks are thresholds (thinned_tiles.hpp): of all points with a density above 0,
//             the n with the least (rank + u) / density are kept, 0 <= u < 1 one number per tile.
//             The 2 sqrt(n) points beyond n top keep regions of large density from running out. If
//             they are too few, as for a picture as fine as the points, more tiles are used. Points
//             are ordered by tile. A constant density has no effect.
//
// Shape   2-D. A sequence: point i is a function of i, n and the seed; memory for the tile only,
//         and with a density 16 bytes for each repetition of it.
// Cost    O(t (iterations + t)) once, 1.5 seconds for t = 4096; then 2 ns a point and core. With a
//         density about 8 ns a point and core, times top.
// Promise exactly n points. No two are nearer than the nearest two of the periodic tile, scaled to
//         the set; without a density, a tile of 4096 points keeps them at least 0.5 / sqrt(n) apart
//         (times the root of a box's area).
// Beware  the set is periodic except where it is thinned: its spectrum has peaks at multiples of K,
//         which are lower and closer together for larger tiles. If a density leaves only a point or
//         two in every tile, they form rows; larger tiles keep more.
// Source  one tile for all: M. F. Cohen, J. Shade, S. Hiller, O. Deussen, "Wang tiles for image and
//         texture generation", ACM Trans. Graph. 22(3) (2003) 287-294,
//         doi:10.1145/882262.882265, of which this is the case of a single tile. Ranks for a
//         density: J. Kopf, D. Cohen-Or, O. Deussen, D. Lischinski, "Recursive Wang tiles for
//         real-time blue noise", ACM Trans. Graph. 25(3) (2006) 509-518,
//         doi:10.1145/1141911.1141916. The order: R. Ulichney, "The void-and-cluster method for
//         dither array generation", Proc. SPIE 1913 (1993) 332-343, doi:10.1117/12.152707.

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "core/machine/wide.hpp"
#include "core/rng.hpp"
#include "generators/blue_noise/relaxation/relaxation.hpp"
#include "generators/blue_noise/thinned_tiles.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "math/functions/exponential.hpp"
#include "math/neighbors/periodic_voronoi.hpp"

namespace stipple::generators::tiled {
namespace {

constexpr Param<std::int64_t> tile_points{
    .name = "tile-points",
    .fallback = 4096,
    .low = 16,
    .high = 65536,
    .unit = "points",
    .help = "Maximum number of points in the tile; the actual number is chosen to fit n"};
constexpr Param<std::int64_t> iterations{.name = "iterations",
                                         .fallback = 250,
                                         .low = 0,
                                         .high = 1'000'000,
                                         .unit = "steps",
                                         .help = "Optimization steps that make the tile even"};

double difference(double a, double b) {
    const double t = std::abs(a - b);
    return std::min(t, 1 - t);
}

/// Ranks the points of the torus: those removed last come first.
std::vector<Vec2> ranked(std::vector<Vec2> points, Vec2 sides, const RunContext& run) {
    const Vec2 torus{std::sqrt(sides.x / sides.y), std::sqrt(sides.y / sides.x)};  // of area 1
    const auto felt = [&](const Vec2& p, const Vec2& q, double sharpness) {
        const double x = torus.x * difference(p.x, q.x);
        const double y = torus.y * difference(p.y, q.y);
        return exponential(-sharpness * (x * x + y * y));
    };
    std::vector<double> energies(points.size());
    std::size_t widen = points.size();
    // 4 / (2 sigma^2) for the first sigma, 0.47 of the mean distance; the first round divides by 4.
    double sharpness = 4 * 0.5 * static_cast<double>(points.size()) / (0.47 * 0.47);
    for (std::size_t left = points.size(); left > 0; --left) {
        run.tick(points.size() - left, points.size());
        if (left == widen) {
            sharpness /= 4;
            widen /= 4;
            for (std::size_t i = 0; i < left; ++i) {
                if (i % 64 == 0) run.check_stop();
                energies[i] = 0;
                for (std::size_t j = 0; j < left; ++j)
                    energies[i] += felt(points[i], points[j], sharpness);
            }
        }
        const auto end = energies.begin() + static_cast<std::ptrdiff_t>(left);
        const auto fullest =
            static_cast<std::size_t>(std::max_element(energies.begin(), end) - energies.begin());
        std::swap(points[fullest], points[left - 1]);
        std::swap(energies[fullest], energies[left - 1]);
        for (std::size_t i = 0; i + 1 < left; ++i)
            energies[i] -= felt(points[i], points[left - 1], sharpness);
    }
    return points;
}

/// row[j] = ((column + j + x) / columns, y) for j < count.
STIPPLE_WIDE void place_row(double* row, std::size_t count, double column, double x, double y,
                            double columns) {
    for (std::size_t j = 0; j < count; ++j) {
        row[2 * j] = ((column + static_cast<double>(j)) + x) / columns;
        row[2 * j + 1] = y;
    }
}

/// Writes points of one rank in one row of tiles; returns the number of points written.
std::uint64_t fill_row(const std::vector<Vec2>& tile, const Tiling& tiling, std::uint64_t first,
                       std::uint64_t most, double* out) {
    const std::uint64_t row = first / tiling.columns;
    const std::uint64_t column = first % tiling.columns;
    const Vec2& point = tile[row / tiling.rows];
    const std::uint64_t count = std::min(most, tiling.columns - column);
    const double y =
        (static_cast<double>(row % tiling.rows) + point.y) / static_cast<double>(tiling.rows);
    place_row(out, count, static_cast<double>(column), point.x, y,
              static_cast<double>(tiling.columns));
    return count;
}

/// Points of all ranks in all tiles; of the last rank, only as many as are needed.
std::unique_ptr<Sequence> repeated(const std::vector<Vec2>& tile, const Tiling& tiling,
                                   std::uint64_t count) {
    const std::uint64_t whole = tiling.tiles() * (tile.size() - 1);
    return sequence_of([=](std::uint64_t first, std::span<double> rows) {
        for (std::size_t at = 0; at < rows.size();) {
            std::uint64_t done = 1;
            if (first < whole) {
                done = fill_row(tile, tiling, first, (rows.size() - at) / 2, &rows[at]);
            } else {
                const auto place = static_cast<std::uint64_t>(Uint128{first - whole} *
                                                              tiling.tiles() / (count - whole));
                rows[at] = (static_cast<double>(place % tiling.columns) + tile.back().x) /
                           static_cast<double>(tiling.columns);
                rows[at + 1] = (static_cast<double>(place / tiling.columns) + tile.back().y) /
                               static_cast<double>(tiling.rows);
            }
            first += done;
            at += 2 * done;
        }
    });
}

/// Tiling of at least `least` nearly square tiles, but few more, in a box with the given sides.
Tiling tiling_of(std::uint64_t least, Vec2 sides) {
    const double longer = std::max(sides.x, sides.y) / std::min(sides.x, sides.y);
    auto across =
        static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(least) / longer)));
    if (sides.x == sides.y) return {across, across};
    const auto along = [&](std::uint64_t b) { return (least - 1) / b + 1; };
    const auto badness = [&](std::uint64_t b) {
        const double shape = longer * static_cast<double>(b) / static_cast<double>(along(b));
        return std::pair(b * along(b), std::max(shape, 1 / shape));
    };
    if (across > 1 && badness(across - 1) <= badness(across)) --across;
    return sides.x > sides.y ? Tiling{along(across), across} : Tiling{across, along(across)};
}

/// Makes the tile for a tiling: points of [0, 1)^2 by rank.
std::vector<Vec2> tile_for(std::size_t count, const Tiling& tiling, Vec2 sides, const Plan& plan,
                           const Values& options, const RunContext& run) {
    constexpr double grain = 0x1p28;
    const Vec2 own{sides.x / static_cast<double>(tiling.columns),
                   sides.y / static_cast<double>(tiling.rows)};
    run.need_memory(relaxation_bytes(count, 2) + 56 * static_cast<double>(count), "the tile");
    std::vector<double> rows(2 * count);
    Rng(plan.seed).fill(0, rows);
    relax_gaussian(rows, 2, static_cast<std::uint64_t>(options[iterations]), run.stage(0, 0.7),
                   std::array{own.x, own.y});
    std::vector<Vec2> points(count);
    for (std::size_t i = 0; i < count; ++i)
        points[i] = {std::floor(rows[2 * i] * grain) / grain,
                     std::floor(rows[2 * i + 1] * grain) / grain};
    return ranked(std::move(points), own, run.stage(0.7, 1));
}

std::unique_ptr<Sequence> make_even(const Plan& plan, const Values& options, Vec2 sides,
                                    const RunContext& run) {
    const auto most = static_cast<std::uint64_t>(options[tile_points]);
    const Tiling tiling = tiling_of((plan.count - 1) / most + 1, sides);
    const std::uint64_t points = (plan.count - 1) / tiling.tiles() + 1;
    return repeated(tile_for(points, tiling, sides, plan, options, run.stage(0, 0.99)), tiling,
                    plan.count);
}

std::unique_ptr<Sequence> make_thinned(const Plan& plan, const Values& options, Vec2 sides,
                                       std::shared_ptr<const DensityMap> density,
                                       const RunContext& run) {
    const auto most = static_cast<double>(options[tile_points]);
    const auto n = static_cast<double>(plan.count);
    const double needed = (n + 2 * std::sqrt(n)) * density->largest();
    if (!(needed < 0x1p53))
        fail(ErrorKind::limit,
             "{}: thinning to {} points needs {:.3g} points, because the largest density is {:.3g} "
             "times the mean; at most 2^53 are possible",
             options[density_option], plan.count, needed, density->largest());
    Tiling tiling = tiling_of(static_cast<std::uint64_t>(std::ceil(needed / most)), sides);
    const double share = needed / static_cast<double>(tiling.tiles());
    const RunContext steady = run.rising();
    const auto tile = tile_for(static_cast<std::uint64_t>(std::ceil(share)), tiling, sides, plan,
                               options, steady.stage(0, 0.7));
    for (;;) {
        if (auto made = thinned_tiles(tile, tiling, density, plan.count, plan.seed,
                                      steady.stage(0.7, 0.99)))
            return made;
        tiling.columns += (tiling.columns + 7) / 8;
        tiling.rows += (tiling.rows + 7) / 8;
    }
}

bool is_constant(const DensityMap& density) {
    const auto [least, largest] = std::ranges::minmax(density.values());
    return least == largest;
}

std::unique_ptr<Sequence> make(const Plan& plan, const Values& options, const RunContext& run) {
    const auto extents = proportions_of(plan);
    const Vec2 sides = extents.empty() ? Vec2{1, 1} : Vec2{extents[0], extents[1]};
    auto density = given_density(options, run);
    if (!density || is_constant(*density)) return make_even(plan, options, sides, run);
    return make_thinned(plan, options, sides,
                        std::make_shared<const DensityMap>(std::move(*density)), run);
}

Plan plan(const Request& request, const Values& options) {
    check_invert(options);
    return plan_in_proportion(request);
}

}  // namespace

Generator unit() {
    return {.name = "tiled",
            .summary = "One tile of blue noise, repeated and thinned to any number of points",
            .source = "Cohen, Shade, Hiller, Deussen 2003, doi:10.1145/882262.882265",
            .related = {"tiles", "polyominoes", "wang-tiles"},
            .traits = {.min_dimension = 2, .max_dimension = 2, .prefix = false},
            .options = Schema(tile_points, iterations, density_option, invert_option),
            .plan = plan,
            .sequence = make};
}

}  // namespace stipple::generators::tiled
