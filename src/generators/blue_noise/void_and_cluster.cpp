// SPDX-License-Identifier: MIT
//
// Points on the first cells that void-and-cluster fills (math/neighbors/void_and_cluster.hpp), on a
// torus of W x H cells:
//
//     point i = (c_i + 1/2) / (W, H),    c_i the cell of rank i
//
// --bounds      distances are those in the box, in which cells need not be squares.
// --density     dithers the picture with the ranks: takes the n cells with the smallest
//               (rank + 1/2) / (mean density of the cell), in that order.
// --mask-image  the ranks as a dither mask, 16 bits of grey: floor((rank + 1/2) 65536 / (W H)). A
//               pixel of a picture, its grey in [0, 65536), becomes white if it is above the mask.
//
// Shape   2-D, n <= W H. Without --size: a square whose side is the smallest power of two with at
//         least 16 cells a point; with a density, 4 a point at its maximum. In a box that is not a
//         square, the shorter side is a power of two, the longer as many as make cells squares.
// Promise point i does not depend on n when --size is given and --density is not.
// Beware  points are on a grid: their spectrum repeats with periods W and H. --cell random avoids
//         that, at some cost in evenness. A cell c with n density(c) > W H gets too few points.
// Source  R. Ulichney, "The void-and-cluster method for dither array generation", Proc. SPIE 1913
//         (1993) 332-343, doi:10.1117/12.152707.

#include "math/neighbors/void_and_cluster.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/rng.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/generator.hpp"
#include "media/density_map.hpp"
#include "media/png_picture.hpp"

namespace stipple::generators::void_and_cluster {
namespace {

constexpr Param<Extents> size{{.name = "size",
                               .unit = "cells",
                               .help = "Number of cells of the torus, such as 256x256; default: "
                                       "square cells, at least 16 per point"}};
constexpr Param<Choice> cell{.name = "cell",
                             .fallback = "center",
                             .choices = "center|random",
                             .help = "Position of a point in its cell"};
constexpr Param<Path> mask_image{
    {.name = "mask-image",
     .help = "Also write the ranks of all cells to this file, as a PNG dither mask"}};

struct Torus {
    std::size_t width;
    std::size_t height;
    [[nodiscard]] std::size_t cells() const { return width * height; }

    /// Width over height of a cell in the box.
    /// @param proportions sides of the box relative to the shortest; empty if all are equal
    [[nodiscard]] double stretch(const std::vector<double>& proportions) const {
        if (proportions.empty()) return 1;
        return proportions[0] / static_cast<double>(width) /
               (proportions[1] / static_cast<double>(height));
    }
};

constexpr double most_cells = 0x1p31;

/// @throws Error(usage)
Torus torus_of(const std::vector<std::int64_t>& extents, const std::string& text) {
    if (extents.size() != 2)
        fail(ErrorKind::usage, "--size: {} is not two numbers; expected, for example, 64x64", text);
    const auto whole = static_cast<double>(extents[0]) * static_cast<double>(extents[1]);
    if (whole >= most_cells)
        fail(ErrorKind::usage, "--size: {} is outside 1x1 to 2^31 cells", text);
    return {static_cast<std::size_t>(extents[0]), static_cast<std::size_t>(extents[1])};
}

/// Torus with at least `cells` cells per point, which are nearly square in a box of these sides.
/// @throws Error(limit)
Torus torus_for(double points, double cells, const std::vector<double>& proportions) {
    const double longer = proportions.empty() ? 1 : std::ranges::max(proportions);
    const auto along = [&](std::size_t side) {
        return static_cast<std::size_t>(std::floor(static_cast<double>(side) * longer + 0.5));
    };
    const auto all = [&](std::size_t side) { return static_cast<double>(side * along(side)); };
    std::size_t side = 4;
    while (all(side) < cells * points && all(2 * side) < most_cells) side *= 2;
    if (all(side) < points)
        fail(ErrorKind::limit, "void-and-cluster makes at most 2^30 points; {:.0f} are too many",
             points);
    if (proportions.empty() || proportions[1] == 1) return {along(side), side};
    return {side, along(side)};
}

Plan plan(const Request& request, const Values& options) {
    Plan plan = plan_in_proportion(request);
    check_invert(options);
    if (!options.given(size)) return plan;
    const std::string text = format_value(options.find(size.name).value);
    const Torus torus = torus_of(options[size], text);
    if (!request.count) plan.count = std::min<std::uint64_t>(plan.count, torus.cells());
    if (plan.count > torus.cells())
        fail(ErrorKind::usage, "--size: {} has {} cells, too few for {} points", text,
             torus.cells(), plan.count);
    const double stretch = torus.stretch(proportions_of(plan));
    if (!(stretch <= most_stretch && 1 / stretch <= most_stretch))
        fail(ErrorKind::usage,
             "--size: {} makes cells {:.4g} times as wide as they are high; expected a ratio from "
             "{:.2f} to {:.0f}",
             text, stretch, 1 / most_stretch, most_stretch);
    return plan;
}

/// 16-bit PNG of the scaled ranks, top row first.
std::string mask_png(const Torus& torus, const std::vector<std::uint32_t>& order) {
    std::vector<std::uint16_t> samples(order.size());
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const std::size_t y = torus.height - 1 - order[rank] / torus.width;
        samples[y * torus.width + order[rank] % torus.width] =
            static_cast<std::uint16_t>((2 * rank + 1) * 32768 / order.size());
    }
    return encode_png({.width = torus.width, .height = torus.height, .bits = 16, .linear = true},
                      png_bytes_of_samples(samples, 16), {});
}

/// Calls visit(part, overlap) for those of `parts` equal intervals of [0, 1) that overlap
/// [number / all, (number + 1) / all). The overlap's length is in units of 1 / (parts all).
template <class Visit>
void for_overlaps(std::uint64_t number, std::uint64_t all, std::uint64_t parts,
                  const Visit& visit) {
    const std::uint64_t low = number * parts;
    const std::uint64_t high = low + parts;
    for (std::uint64_t part = low / all; part * all < high; ++part)
        visit(part, std::min(high, (part + 1) * all) - std::max(low, part * all));
}

/// Mean density of a cell of the torus.
double mean_density(const DensityMap& map, const Torus& torus, std::uint32_t number) {
    double sum = 0;
    for_overlaps(number / torus.width, torus.height, map.height(), [&](auto j, auto tall) {
        for_overlaps(number % torus.width, torus.width, map.width(), [&](auto i, auto wide) {
            sum += map.values()[j * map.width() + i] * static_cast<double>(wide * tall);
        });
    });
    return sum / static_cast<double>(map.width() * map.height());
}

/// The first `count` cells in the order in which dithering fills them.
std::vector<std::uint32_t> dithered(const Torus& torus, const std::vector<std::uint32_t>& order,
                                    const DensityMap& map, std::size_t count,
                                    const std::string& file) {
    struct Scored {
        double score;
        std::uint32_t rank;
        auto operator<=>(const Scored&) const = default;
    };
    std::vector<Scored> scored;
    for (std::uint32_t rank = 0; rank < order.size(); ++rank) {
        const double value = mean_density(map, torus, order[rank]);
        if (value > 0) scored.push_back({(rank + 0.5) / value, rank});
    }
    if (scored.size() < count)
        fail(ErrorKind::input,
             "{}: only {} of {} x {} cells have a density above 0; {} points "
             "need a larger --size",
             file, scored.size(), torus.width, torus.height, count);
    std::ranges::sort(scored);
    std::vector<std::uint32_t> chosen(count);
    for (std::size_t i = 0; i < count; ++i) chosen[i] = order[scored[i].rank];
    return chosen;
}

PointSet place(const Torus& torus, const std::vector<std::uint32_t>& cells, std::size_t count,
               bool centered, std::uint64_t seed) {
    PointSet points(count, 2);
    const Rng rng(seed, 2);
    const auto inside = [&](std::uint64_t number) { return centered ? 0.5 : rng.uniform(number); };
    const auto below_one = [](double x) { return std::min(x, one_minus_ulp); };
    for (std::size_t i = 0; i < count; ++i) {
        const auto x = static_cast<double>(cells[i] % torus.width) + inside(2 * i);
        const auto y = static_cast<double>(cells[i] / torus.width) + inside(2 * i + 1);
        points[i][0] = below_one(x / static_cast<double>(torus.width));
        points[i][1] = below_one(y / static_cast<double>(torus.height));
    }
    return points;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    const auto map = given_density(options, run);
    const auto wanted = static_cast<double>(plan.count);
    const auto proportions = proportions_of(plan);
    const Torus torus = options.given(size) ? torus_of(options[size], {})
                                            : torus_for(wanted * (map ? map->largest() : 1),
                                                        map ? 4 : 16, proportions);
    const bool all = map || options.given(mask_image);
    const std::size_t count = plan.count;
    const std::vector<std::uint32_t> order =
        void_and_cluster_order(torus.width, torus.height, all ? torus.cells() : count, plan.seed,
                               run.stage(0, 0.99), torus.stretch(proportions));

    const bool centered = options[cell] == "center";
    PointSet points =
        place(torus, map ? dithered(torus, order, *map, count, options[density_option]) : order,
              count, centered, plan.seed);
    put_in_box(plan, points);
    const Value extents = std::vector<std::int64_t>{static_cast<std::int64_t>(torus.width),
                                                    static_cast<std::int64_t>(torus.height)};
    points.provenance.options = {{"size", format_value(extents)}, {"cell", options[cell]}};
    note_density(options, points);
    if (options.given(mask_image))
        points.side_files.push_back({options[mask_image], mask_png(torus, order)});
    run.tick(1, 1);
    return points;
}

}  // namespace

Generator unit() {
    return {.name = "void-and-cluster",
            .summary = "Cells of a torus in void-and-cluster order; also makes a dither mask",
            .source = "Ulichney 1993, doi:10.1117/12.152707",
            .related = {"blue-noise-mask", "ordered-dither", "dithering"},
            .traits = planar_traits,
            .options = Schema(size, cell, density_option, invert_option, mask_image),
            .aliases = {"dither"},
            .writes = {std::string(mask_image.name)},
            .plan = plan,
            .set = make};
}

}  // namespace stipple::generators::void_and_cluster
