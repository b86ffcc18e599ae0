// SPDX-License-Identifier: MIT
//
// Differential domain analysis: the differences of all ordered pairs of n points of the plane,
// counted in square pixels D around 0 and divided by the mean counts of independent uniform points,
//
//     density(D) = #{ (i, j) : i != j, x_j - x_i in D }  /  ( n (n - 1) * P(D) ),
//
// where P(D) is the probability that the difference of two uniform points is in D: the area of D
// over V on the torus; the integral over D of (L_1 - |x|) (L_2 - |y|) / V^2 for straight distances.
// So independent points have density 1 everywhere. The image complements the power spectrum: near 0
// it shows what the spectrum shows at high frequencies. The image is summarized by
//
//     radial density     mean over the pixels with centres in the ring k - 1/2 <= |x| / w < k + 1/2
//     anisotropy         variance of the pixels over the ring / squared mean, in dB; independent
//                        points have -10 log10(differences per pixel), less if sets are averaged
//
// where w is the side of a pixel; k = 0 is the central pixel.
//
// Shape   n >= 2 points of the unit square or a rectangle. Image of B x B pixels, B odd, reaching
//         from -r to r, x to the right and y upward: row = y.
// Units   distances in sqrt(V / n), the mean distance.
// Cost    O(n + pairs nearer than the square's corners): 10^6 points within 5 mean distances, 5e7
//         pairs, take 2 s on one core.
// Promise every pair counts twice, once on either side of 0: the image is its own mirror image
//         exactly. Never depends on the number of threads.
// Beware  a difference on an edge of two pixels counts in only one of them, so each peak of a
//         lattice is a single pixel.
// Source  L.-Y. Wei, R. Wang, ACM Trans. Graph. 30:4 (2011) 50, doi:10.1145/2010324.1964945.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "analyzers/rings.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::analyzers::differential {
namespace {

constexpr Param<double> max_distance{.name = "max-distance",
                                     .low = 1e-90,
                                     .optional = true,
                                     .unit = "sqrt(V / n)",
                                     .help =
                                         "The image covers -r to r along each axis; default: r is "
                                         "5, but at most half the shortest side"};

constexpr Param<std::int64_t> pixel_count{
    .name = "pixels",
    .fallback = 255,
    .low = 3,
    .high = 4095,
    .help = "Pixels along each side of the image, an odd number"};

constexpr Param<Path> grid_file{
    {.name = "grid",
     .help = "Save the image to this .npy file: row = y, column = x, from -r to r"}};

constexpr Param<Path> image_file{
    {.name = "image",
     .help = "Draw the image to this .png file, grey = density / (1 + density), 1 middle grey"}};

struct Plan {
    Distances distances;
    std::size_t pixels;
    double reach;
    double unit;

    [[nodiscard]] double side() const { return 2 * reach / static_cast<double>(pixels); }
};

Plan plan_for(const PointSet& points, const Values& options) {
    Plan plan{.distances = distances_in_box(points, options[metric], "differential"),
              .pixels = static_cast<std::size_t>(options[pixel_count]),
              .reach = 0,
              .unit = 0};
    if (plan.pixels % 2 == 0)
        fail(ErrorKind::usage,
             "--pixels: {} is even; expected an odd number, so that one pixel is in the middle",
             plan.pixels);
    const Box& box = *plan.distances.box;
    plan.unit = mean_distance(box, static_cast<double>(points.count()));
    const double half = shortest_side(box) / 2;
    if (!options.given(max_distance)) {
        plan.reach = std::min(5 * plan.unit, half);
        return plan;
    }
    plan.reach = options[max_distance] * plan.unit;
    if (!(plan.reach <= half * (1 + 1e-9)))
        fail(ErrorKind::usage, "--max-distance: {} is more than half the shortest side, {}",
             format_number(options[max_distance]), format_number(half / plan.unit));
    return plan;
}

/// Counts of differences in the pixels, row by row.
using Counts = std::vector<std::uint64_t>;

/// Limit for the number of blocks, each with its own counts: as many as fit 1 GiB, from 4 to 64.
std::uint64_t most_blocks(std::size_t pixels) {
    constexpr std::uint64_t most_counts = std::uint64_t{1} << 27;
    return std::clamp<std::uint64_t>(most_counts / (pixels * pixels), 4, 64);
}

class DifferenceCounter {
  public:
    DifferenceCounter(const PointSet& points, const Plan& plan, const RunContext& run)
        : plan_(plan),
          run_(run),
          sides_{plan.distances.box->extent(0), plan.distances.box->extent(1)},
          points_(GridFrame<2>(*plan.distances.box, plan.distances.torus,
                               std::max(plan.reach / 4, plan.unit),
                               static_cast<double>(points.count()) + 64),
                  points.flat(), run) {}

    /// Adds the counts of all blocks. Their order does not matter, since counts are integers.
    [[nodiscard]] Counts count() const {
        const std::uint64_t n = points_.count();
        const std::uint64_t size = std::max<std::uint64_t>(1024, n / most_blocks(plan_.pixels) + 1);
        std::vector<Counts> parts(block_count(n, size));
        const double reach = plan_.reach * std::numbers::sqrt2;
        for_each_block(run_, n, size, [&](const Block& b) {
            Counts counts(plan_.pixels * plan_.pixels);
            points_.visit_pairs(b.first, b.last, reach, run_,
                                [&](std::size_t s, std::size_t first, std::size_t last) {
                                    for (std::size_t t = first; t < last; ++t)
                                        add(points_[s], points_[t], counts);
                                });
            parts[b.index] = std::move(counts);
        });
        Counts all(plan_.pixels * plan_.pixels);
        for (const Counts& part : parts)
            for (std::size_t i = 0; i < all.size(); ++i) all[i] += part[i];
        return all;
    }

  private:
    /// Counts the difference of two points and its opposite.
    void add(const double* p, const double* q, Counts& counts) const {
        const auto size = static_cast<double>(plan_.pixels);
        const double column = across(q[0] - p[0], 0) * scale_ + size / 2;
        const double row = across(q[1] - p[1], 1) * scale_ + size / 2;
        if (!(column >= 0 && column < size && row >= 0 && row < size)) return;
        const std::size_t at =
            static_cast<std::size_t>(row) * plan_.pixels + static_cast<std::size_t>(column);
        ++counts[at];
        ++counts[counts.size() - 1 - at];
    }

    [[nodiscard]] double across(double d, std::size_t k) const {
        if (!plan_.distances.torus) return d;
        if (d > sides_[k] / 2) return d - sides_[k];
        return d < -sides_[k] / 2 ? d + sides_[k] : d;
    }

    const Plan& plan_;
    const RunContext& run_;
    double scale_ = 1 / plan_.side();  ///< pixels per unit of distance
    std::array<double, 2> sides_;
    SortedPoints<2> points_;
};

/// For each pixel along an axis, the probability that the difference of two points is in it.
std::vector<double> chances(const Plan& plan, std::size_t axis) {
    const double side = plan.distances.box->extent(axis);
    const double width = plan.side();
    std::vector<double> chance(plan.pixels);
    const auto below = [&](double x) {  // probability that a straight difference is in [0, x]
        return x / side * (1 - x / side / 2);
    };
    const auto middle = static_cast<double>(plan.pixels / 2);
    for (std::size_t i = 0; i < plan.pixels; ++i) {
        const double off = std::abs(static_cast<double>(i) - middle);
        if (plan.distances.torus)
            chance[i] = width / side;
        else if (off == 0)
            chance[i] = 2 * below(width / 2);
        else
            chance[i] = below((off + 0.5) * width) - below((off - 0.5) * width);
    }
    return chance;
}

Grid densities(const Plan& plan, const Counts& counts, double pairs) {
    const std::vector<double> across = chances(plan, 0);
    const std::vector<double> up = chances(plan, 1);
    Grid grid{.rows = plan.pixels, .columns = plan.pixels, .values = {}};
    grid.values.reserve(counts.size());
    for (std::size_t i = 0; i < counts.size(); ++i) {
        const double expected = pairs * across[i % plan.pixels] * up[i / plan.pixels];
        grid.values.push_back(static_cast<double>(counts[i]) / expected);
    }
    return grid;
}

/// Adds the radial mean and the anisotropy of the image to the report.
void summarize(Report& report, const Grid& grid, double pixel) {
    const Rings rings = rings_of(grid, {});
    const double middle = grid.values[grid.values.size() / 2];
    Report::Curve distance{0}, density{middle}, anisotropy{anisotropy_db(0, middle)};
    Report::Integers cells{1};
    for (std::size_t i = 0; i < rings.power.size(); ++i) {
        distance.push_back(static_cast<double>(i + 1) * pixel);
        density.push_back(rings.power[i]);
        anisotropy.push_back(anisotropy_db(rings.variance[i], rings.power[i]));
        cells.push_back(rings.cells[i]);
    }
    Report radial;
    radial.add("distance", std::move(distance), "sqrt(V / n)");
    radial.add("density", std::move(density));
    radial.add("anisotropy_db", std::move(anisotropy), "dB");
    radial.add("cells", std::move(cells));
    report.add("radial", std::move(radial));
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Plan plan = plan_for(points, options);
    require_places(points, "differential");
    const auto n = static_cast<double>(points.count());
    const auto pixels = static_cast<double>(plan.pixels * plan.pixels);
    const auto images = static_cast<double>(most_blocks(plan.pixels) + 3);
    run.need_memory(24 * n + 8 * pixels * images, "the counts of differences");
    const Counts counts = DifferenceCounter(points, plan, run).count();
    Grid grid = densities(plan, counts, n * (n - 1));
    const double pixel = plan.side() / plan.unit;
    Report report;
    report.add("max_distance", plan.reach / plan.unit, "sqrt(V / n)");
    report.add("pixel", pixel, "sqrt(V / n)");
    report.add("expected_differences", (n - 1) * pixel * pixel);
    summarize(report, grid, pixel);
    report.add("mean_distance", plan.unit);
    report.add("metric", plan.distances.name());
    report.add("grid", std::move(grid));
    return report;
}

void refine(Report& mean, std::size_t, const Values&) {
    if (const auto* grid = mean.find("grid"))
        summarize(mean, std::get<Grid>(*grid), mean.number("pixel"));
}

/// Rejects images with pixels of different sizes, which cannot be averaged.
void combine(Report&, std::span<const Report> sets, const Values&) {
    if (!alike(sets, "pixel"))
        fail_with_hint(ErrorKind::usage, "set one --max-distance for all",
                       "--average: the images of the sets cover different distances, which depend "
                       "on the numbers of points");
}

}  // namespace

Analyzer unit() {
    return {.name = "differential",
            .summary = "Image of the differences of all pairs, its radial mean and anisotropy",
            .source = "Wei, Wang 2011, doi:10.1145/2010324.1964945",
            .traits = {.min_dimension = 2, .max_dimension = 2, .unit_cube = false, .boxed = true},
            .options = Schema(max_distance, pixel_count, metric, grid_file, image_file),
            .results = {{"max_distance", "r: the image covers -r to r, in mean distances"},
                        {"pixel", "side of a pixel, in mean distances"},
                        {"expected_differences",
                         "expected number per pixel, for independent points on the torus"},
                        {"radial.distance", "distance of each ring of pixels, in mean distances"},
                        {"radial.density", "mean over the ring; 1 for independent points"},
                        {"radial.anisotropy_db",
                         "variance over the ring / squared mean, in dB, at least -100; independent "
                         "points have -10 log10(expected_differences x sets averaged); for "
                         "averaged sets, that of their mean image, without a standard error"},
                        {"radial.cells", "pixels in the ring"},
                        {"mean_distance", "sqrt(V / n), in units of the points"},
                        {"metric", "torus or euclidean", true, "torus|euclidean"}},
            .curves = {{"radial.density", "radial.distance", "1", "", "distance / mean distance"},
                       {"radial.anisotropy_db", "radial.distance", "", "anisotropy (dB)",
                        "distance / mean distance"}},
            .charts = {{"differential", "Pair differences"}},
            .analyze = analyze,
            .refine = refine,
            .combine = combine};
}

}  // namespace stipple::analyzers::differential
