// SPDX-License-Identifier: MIT
//
// Number variance: how the number N of points in a ball of radius R varies as the ball's centre
// moves over the whole torus of volume V, and how this variance grows with R,
//
//     variance = <N^2> - <N>^2,   <N> = n v(R) / V,   <N^2> = 1 / V * sum over i, j of
//                                                             overlap(|x_i - x_j|; R),
//
// where v is the volume of a ball and overlap(r; R) that of the intersection of two balls of radius
// R at a distance r. So the mean over all centres is exact: it needs only the pairs nearer than 2
// R, and no windows are drawn. The exponent is the slope of log variance against log R, by least
// squares over the given radii:
//
//     independent points    variance = mean (1 - v / V)       exponent d
//     jittered grids        variance ~ R^(d-1)                exponent d - 1
//     lattices              variance ~ R^(d-1), oscillating   exponent about d - 1
//
// Sets with exponents between d - 1 and d are hyperuniform, too. Since n is fixed, the variance of
// every set contains the factor 1 - v / V of independent points. `dispersion` = variance / (mean (1
// - v / V)) and the fit leave it out, so independent points have dispersion 1 at every radius.
//
// With --metric euclidean, balls may extend beyond the box, which has no points there. So --windows
// random centres are drawn, the same in every run, such that the largest ball is inside the box.
// Each centre is used for all radii. Mean and variance are those of their counts, with equal
// weights; the variance would be unbiased for independent windows. A point is in a window if its
// distance^2, as float64 computes it, is at most R^2.
//
// Shape   n >= 2 points of the unit cube or a box, d = 1, 2, 3, on the torus unless --metric says
//         otherwise; R up to a quarter of the shortest side, so that no two balls overlap twice.
// Units   radii in (V / n)^(1/d), the mean distance.
// Cost    O(n + pairs nearer than 2 R): 10^6 points of the plane to 10 mean distances, 6.3e8 pairs,
//         take 5 s on one core. By windows O(n + windows * points in the largest window).
// Promise on the torus the variance is off by at most the reported error, up to rounding. The error
//         is negligible for lattices, for other sets some 1e-11 of the largest window's <N>^2.
//         Pairs are summed in narrow bins, with the mean m and the variance s^2 of their distances.
//         The third derivative of the overlap is nonnegative. So the sum over distances in [a, b]
//         with these moments is between two extremes: some pairs at a and the others at m + s^2 /
//         (m - a), or some at b and the others at m - s^2 / (b - m). Never depends on the number of
//         threads.
// Beware  the residuals of the fit do not measure the exponent's error, since neighbouring radii
//         share most of their pairs. The standard error comes from --average: the standard
//         deviation of the single sets' exponents, divided by the square root of their number,
//         although the exponent is that of the mean variance. A lattice's oscillations need many
//         radii. The variance over M windows has a relative error of sqrt(2 / M) or more, as they
//         overlap.
// Source  S. Torquato, F. H. Stillinger, Phys. Rev. E 68 (2003) 041113,
//         doi:10.1103/PhysRevE.68.041113 (variance by pairs, hyperuniformity).
//         S. Karlin, W. J. Studden, "Tchebycheff Systems", Wiley 1966 (the two extreme sums are
//         those of the lower and the upper principal representation of the moments).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "analyzers/distances/pair_counts.hpp"
#include "core/error.hpp"
#include "core/machine/int128.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"
#include "math/functions/radians.hpp"
#include "math/geometry/ball_volume.hpp"
#include "math/neighbors/point_grid.hpp"

namespace stipple::analyzers::hyperuniformity {
namespace {

constexpr Param<double> max_radius{
    .name = "max-radius",
    .low = 1e-90,
    .optional = true,
    .unit = "(V / n)^(1/d)",
    .help = "Largest radius; default: 10, but at most an eighth of the shortest side"};

constexpr Param<double> min_radius{
    .name = "min-radius",
    .low = 1e-90,
    .optional = true,
    .unit = "(V / n)^(1/d)",
    .help = "Smallest radius; default: 1, but at most half the largest"};

constexpr Param<std::int64_t> radius_count{
    .name = "radii",
    .fallback = 40,
    .low = 3,
    .high = 1000,
    .help = "Number of radii, evenly spaced in their logarithms; in small ranges some coincide"};

constexpr Param<std::int64_t> window_count{
    .name = "windows",
    .fallback = 10'000,
    .low = 2,
    .high = 1'000'000'000,
    .help =
        "Number of random windows with --metric euclidean; on the torus all positions are counted"};

/// Number of bins within twice the smallest radius, unless the number of bins within twice the
/// largest radius would be below `fewest_bins` or above `most_bins`.
constexpr double bins_in_smallest = 400;
constexpr double fewest_bins = 4096;
constexpr double most_bins = 16384;

struct Ball {
    std::size_t dimension;

    [[nodiscard]] double volume(double r) const {
        double volume = unit_ball_volume(dimension);
        for (std::size_t k = 0; k < dimension; ++k) volume *= r;
        return volume;
    }

    /// Volume of the intersection of two balls of radius R at the distance r; 0 if r >= 2 R.
    [[nodiscard]] double overlap(double r, double radius) const {
        const double gap = 2 * radius - r;
        if (!(gap > 0)) return 0;
        if (dimension == 1) return gap;
        if (dimension == 2)
            return 2 * radius * radius * arc_cosine(r / (2 * radius)) -
                   r * std::sqrt(gap * (2 * radius + r)) / 2;
        return std::numbers::pi / 12 * (4 * radius + r) * gap * gap;
    }
};

/// Radii R and bins of distances. R is a multiple of half a bin's width, so 2 R is a bin's edge.
struct Plan {
    double unit;                      ///< mean distance (V / n)^(1/d)
    double width;                     ///< width of a bin
    std::vector<std::size_t> halves;  ///< for each radius R the number of bins in 2 R, ascending

    [[nodiscard]] double radius(std::size_t i) const {
        return static_cast<double>(halves[i]) * width / 2;
    }
};

Plan plan_for(const PointSet& points, const Box& box, const Values& options) {
    Plan plan{
        .unit = mean_distance(box, static_cast<double>(points.count())), .width = 0, .halves = {}};
    const double side = shortest_side(box) / plan.unit;
    const double most = options.given(max_radius) ? options[max_radius] : std::min(10.0, side / 8);
    const double least = options.given(min_radius) ? options[min_radius] : std::min(1.0, most / 2);
    if (!(most <= side / 4 * (1 + 1e-9)))
        fail(ErrorKind::usage,
             "--max-radius: {} is more than a quarter of the shortest side, which is {} mean "
             "distances",
             format_number(most), format_number(side / 4));
    if (!(least < most))
        fail(ErrorKind::usage, "--min-radius: {} is not below the largest radius, {}",
             format_number(least), format_number(most));
    const double bins =
        std::round(std::clamp(bins_in_smallest * most / least, fewest_bins, most_bins));
    plan.width = 2 * most * plan.unit / bins;
    const auto steps = static_cast<double>(options[radius_count] - 1);
    for (double i = 0; i <= steps; ++i) {
        const double radius = least * real_power(most / least, i / steps);
        const auto half =
            static_cast<std::size_t>(std::clamp(std::round(radius / most * bins), 1.0, bins));
        if (plan.halves.empty() || half > plan.halves.back()) plan.halves.push_back(half);
    }
    if (plan.halves.size() < 3)
        fail(ErrorKind::usage,
             "--min-radius: {} is too close to the largest radius, {}, to fit a slope",
             format_number(least), format_number(most));
    return plan;
}

/// Distance that represents a group of a bin's pairs, and the number of pairs in the group.
struct Stand {
    double at;
    double pairs;
};

/// Representatives of a bin's pairs that bound sums over them. For a function with a nonnegative
/// third derivative, the sum over all pairs is between the sums over `least` and over `most`.
struct BinPairs {
    std::array<Stand, 2> least;
    std::array<Stand, 2> most;
};

/// Represents a bin's pairs by two distances, one of them `end`, of the same mean and variance.
std::array<Stand, 2> with_end(double pairs, double mean, double variance, double end) {
    const double off = mean - end;
    const double share = variance / (variance + off * off);
    return {{{end, pairs * share}, {mean + variance / off, pairs * (1 - share)}}};
}

std::vector<BinPairs> bins_of(const PairCounts& counts, double width) {
    std::vector<BinPairs> bins(counts.pairs.size());
    for (std::size_t b = 0; b < bins.size(); ++b) {
        const auto pairs = static_cast<double>(counts.pairs[b]);
        if (pairs == 0) continue;
        const auto low = static_cast<double>(b) * width;
        const double offset = std::clamp(counts.offsets[b] / pairs, -0.5, 0.5);
        const double spread = counts.squared_offsets[b] / pairs - offset * offset;
        const double mean = low + (offset + 0.5) * width;
        bins[b].least = bins[b].most = {{{mean, pairs}, {mean, 0}}};
        // One distance suffices if, up to rounding, the variance is 0 or all pairs are at an end.
        if (spread < 1e-14 || !(std::abs(offset) < 0.5 - 1e-7)) continue;
        bins[b].least = with_end(pairs, mean, spread * width * width, low);
        bins[b].most = with_end(pairs, mean, spread * width * width, low + width);
    }
    return bins;
}

/// Sum of the overlaps over all pairs of points, with its error bound.
Estimate overlaps(std::span<const BinPairs> bins, const Plan& plan, std::size_t at,
                  const Ball& ball) {
    const double radius = plan.radius(at);
    const auto sum = [&](const std::array<Stand, 2>& stands) {
        const double first = stands[0].pairs * ball.overlap(stands[0].at, radius);
        if (stands[1].pairs == 0) return first;
        return first + stands[1].pairs * ball.overlap(stands[1].at, radius);
    };
    double least = 0;
    double most = 0;
    for (std::size_t b = plan.halves[at]; b-- > 0;) {  // adds the smallest overlaps first
        if (bins[b].least[0].pairs + bins[b].least[1].pairs == 0) continue;
        const double one = sum(bins[b].least);
        least += one;
        most += bins[b].least[1].pairs > 0 ? sum(bins[b].most) : one;
    }
    return {.value = (least + most) / 2, .error = (most - least) / 2};
}

struct Curves {
    Report::Curve radius;
    Report::Curve mean;
    Report::Curve variance;
    Report::Curve error = {};  ///< bound of the variance's error; empty for windows
    Report::Curve dispersion;
};

/// Adds the slope of log variance against log radius by least squares. Skips radii where the
/// variance is 0 up to rounding, as happens in one dimension.
void add_exponent(Report& report) {
    const auto& variance = report.curve("variance");
    const auto& mean = report.curve("mean");
    const bool exact = report.find("variance_error") == nullptr;  // counted in windows, in integers
    std::vector<std::array<double, 2>> logs;
    for (std::size_t i = 0; i < variance.size(); ++i)
        if (variance[i] >
            (exact ? 0 : std::max(report.curve("variance_error")[i], 1e-12 * mean[i] * mean[i])))
            logs.push_back({logarithm(report.curve("radius")[i]),
                            logarithm(report.curve("dispersion")[i] * mean[i])});
    if (logs.size() < 3) return drop(report, {"exponent"});
    const auto count = static_cast<double>(logs.size());
    double mx = 0;
    double my = 0;
    for (const auto& [u, v] : logs) {
        mx += u / count;
        my += v / count;
    }
    double xx = 0;
    double xy = 0;
    for (const auto& [u, v] : logs) {
        xx += (u - mx) * (u - mx);
        xy += (u - mx) * (v - my);
    }
    report.add("exponent", xy / xx);
}

/// Adds the results at one radius; `share` is the ball's fraction of the box's volume.
void add(Curves& curves, double radius, double mean, double variance, double share) {
    curves.radius.push_back(radius);
    curves.mean.push_back(mean);
    curves.variance.push_back(variance);
    curves.dispersion.push_back(mean > 0 ? variance / (mean * (1 - share)) : 0);
}

Curves by_pairs(const PointSet& points, const Plan& plan, const Distances& distances,
                const RunContext& run) {
    const PairCounts counts =
        count_pairs(points, distances, plan.width, plan.halves.back(), true, run.stage(0, 0.98));
    const std::vector<BinPairs> bins = bins_of(counts, plan.width);
    const Ball ball{points.dimension()};
    const double volume = volume_of(*distances.box);
    Curves curves;
    for (std::size_t i = 0; i < plan.halves.size(); ++i) {
        run.check_stop();
        const double share = ball.volume(plan.radius(i)) / volume;
        const double mean = static_cast<double>(points.count()) * share;
        const Estimate sum = overlaps(bins, plan, i, ball);
        const double squares = mean + 2 * sum.value / volume;
        add(curves, plan.radius(i) / plan.unit, mean, std::max(0.0, squares - mean * mean), share);
        curves.error.push_back(2 * sum.error / volume);
    }
    run.tick(1, 1);
    return curves;
}

/// Sums over windows, for each radius; integers, so that the order of windows does not matter.
struct WindowSums {
    std::vector<std::uint64_t> counts;
    std::vector<Int128> squares;
};

constexpr std::uint64_t windows_in_block = 256;

/// Counts the points within each radius of the window's centre, and adds the counts to the sums.
template <std::size_t D>
void add_window(const SortedPoints<D>& points, const Box& box, std::span<const double> radii,
                std::uint64_t window, WindowSums& sums) {
    const Rng places(0, 0);
    std::array<double, D> center;
    for (std::size_t k = 0; k < D; ++k) {
        const double room = box.extent(k) - 2 * radii.back();
        center[k] = box.low[k] + radii.back() + room * places.uniform(window * D + k);
    }
    const auto squared_radius = [](double radius) { return radius * radius; };
    std::vector<std::uint64_t> shells(radii.size());
    points.visit(center.data(), radii.back(), [&](std::size_t, double squared) {
        const auto at = std::ranges::lower_bound(radii, squared, {}, squared_radius);
        if (at != radii.end()) ++shells[static_cast<std::size_t>(at - radii.begin())];
    });
    std::uint64_t inside = 0;
    for (std::size_t k = 0; k < shells.size(); ++k) {
        inside += shells[k];
        sums.counts[k] += inside;
        sums.squares[k] += static_cast<Int128>(inside) * static_cast<Int128>(inside);
    }
}

template <std::size_t D>
WindowSums count_in_windows(const PointSet& points, const Box& box, std::span<const double> radii,
                            std::size_t windows, const RunContext& run) {
    const SortedPoints<D> sorted(
        GridFrame<D>(box, false, radii.back() / 4, static_cast<double>(points.count())),
        points.flat(), run);
    const WindowSums none{std::vector<std::uint64_t>(radii.size()),
                          std::vector<Int128>(radii.size())};
    std::vector<WindowSums> parts(block_count(windows, windows_in_block), none);
    for_each_block(run, windows, windows_in_block, [&](const Block& b) {
        for (std::uint64_t w = b.first; w < b.last; ++w) {
            run.check_stop();
            add_window(sorted, box, radii, w, parts[b.index]);
        }
    });
    WindowSums all = none;
    for (const WindowSums& part : parts)
        for (std::size_t k = 0; k < radii.size(); ++k) {
            all.counts[k] += part.counts[k];
            all.squares[k] += part.squares[k];
        }
    return all;
}

Curves by_windows(const PointSet& points, const Plan& plan, const Box& box, std::size_t windows,
                  const RunContext& run) {
    std::vector<double> radii;
    for (std::size_t i = 0; i < plan.halves.size(); ++i) radii.push_back(plan.radius(i));
    const auto n = static_cast<double>(points.count());
    const auto sums = static_cast<double>(block_count(windows, windows_in_block) * radii.size());
    run.need_memory(n * (16 * static_cast<double>(points.dimension()) + 12) + 24 * sums,
                    "the counts in windows");
    const WindowSums all = with_dimension<3>(points.dimension(), [&]<std::size_t D>() {
        return count_in_windows<D>(points, box, radii, windows, run);
    });
    const Ball ball{points.dimension()};
    const auto number = static_cast<double>(windows);
    Curves curves;
    for (std::size_t i = 0; i < radii.size(); ++i) {
        const double mean = static_cast<double>(all.counts[i]) / number;
        // At most 2^30 windows of 2^32 points: the products fit 128 bits.
        const Int128 spread = all.squares[i] * static_cast<Int128>(windows) -
                              static_cast<Int128>(all.counts[i]) * all.counts[i];
        const double variance = static_cast<double>(spread) / number / (number - 1);
        add(curves, radii[i] / plan.unit, mean, variance, ball.volume(radii[i]) / volume_of(box));
    }
    return curves;
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Distances distances = distances_in_box(points, options[metric], "hyperuniformity");
    require_places(points, "hyperuniformity");
    if (options.given(window_count) && distances.torus)
        fail(ErrorKind::usage, "--windows applies to --metric euclidean only");
    const Plan plan = plan_for(points, *distances.box, options);
    const auto windows = static_cast<std::size_t>(options[window_count]);
    Curves curves = distances.torus ? by_pairs(points, plan, distances, run)
                                    : by_windows(points, plan, *distances.box, windows, run);
    Report results;
    results.add("exponent", 0.0);
    results.add("fit_from", curves.radius.front(), "(V / n)^(1/d)");
    results.add("fit_to", curves.radius.back(), "(V / n)^(1/d)");
    results.add("radius", std::move(curves.radius), "(V / n)^(1/d)");
    results.add("mean", std::move(curves.mean));
    results.add("variance", std::move(curves.variance));
    if (!curves.error.empty()) results.add("variance_error", std::move(curves.error));
    results.add("dispersion", std::move(curves.dispersion));
    results.add("mean_distance", plan.unit);
    results.add("method", distances.torus ? "pairs" : "windows");
    results.add("metric", distances.name());
    add_exponent(results);
    return results;
}

/// @throws Error(usage) because reports with different radii cannot be averaged
[[noreturn]] void refuse_mean() {
    fail_with_hint(ErrorKind::usage, "set one --min-radius and --max-radius for all",
                   "--average: the sets have windows of different radii, because their numbers of "
                   "points differ");
}

/// Recomputes the exponent from the mean variance: it scatters less than the mean of exponents.
void refine(Report& mean, std::size_t, const Values&) {
    if (!mean.find("radius")) refuse_mean();
    add_exponent(mean);
}

/// Adds the standard error of the exponent; rejects sets with windows of different radii.
void combine(Report& mean, std::span<const Report> sets, const Values&) {
    if (!alike(sets, "fit_from") || !alike(sets, "fit_to")) refuse_mean();
    std::vector<double> exponents;
    for (const Report& set : sets)
        if (const auto* exponent = std::get_if<double>(set.find("exponent")))
            exponents.push_back(*exponent);
    if (sets.size() < 2 || exponents.size() < sets.size() || !mean.find("exponent")) return;
    const auto count = static_cast<double>(sets.size());
    const double center = std::accumulate(exponents.begin(), exponents.end(), 0.0) / count;
    double squares = 0;
    for (const double exponent : exponents) squares += whole_power(exponent - center, 2);
    mean.add("exponent_standard_error", std::sqrt(squares / (count - 1) / count));
}

}  // namespace

Analyzer unit() {
    return {
        .name = "hyperuniformity",
        .summary = "Variance of the number of points in growing windows, with its exponent",
        .source = "Torquato, Stillinger 2003, doi:10.1103/PhysRevE.68.041113",
        .related = {"number-variance"},
        .traits = {.max_dimension = 3, .unit_cube = false, .boxed = true},
        .options = Schema(max_radius, min_radius, radius_count, window_count, metric),
        .results = {lower({"exponent",
                           "slope of log variance against log radius (on the torus, of variance / "
                           "(1 - window volume / V)): d for independent points, d - 1 for the most "
                           "even ones"}),
                    {"exponent_standard_error",
                     "standard error of the exponent over several sets, with --average", false},
                    {"fit_from", "smallest radius of the fit, in mean distances"},
                    {"fit_to", "largest radius of the fit, in mean distances"},
                    {"radius", "radius of the windows, in mean distances"},
                    {"mean", "mean number of points in a window"},
                    {"variance", "variance of that number over all positions of the window"},
                    {"variance_error",
                     "bound on the error of the variance, besides rounding; only on the torus, "
                     "without random windows"},
                    {"dispersion",
                     "variance divided by that of n independent points, mean (1 - v / V)"},
                    {"mean_distance", "(V / n)^(1/d), in units of the points"},
                    {"method",
                     "pairs: computed from pairs, over all positions of the window; windows: over "
                     "random windows",
                     true, "pairs|windows"},
                    {"metric", "torus or euclidean", true, "torus|euclidean"}},
        .curves = {{"variance", "radius", "mean", "", "radius / mean distance", true},
                   {"variance_error", "radius", "", "", "radius / mean distance"},
                   {"dispersion", "radius", "1", "", "radius / mean distance", true}},
        .analyze = analyze,
        .refine = refine,
        .combine = combine};
}

}  // namespace stipple::analyzers::hyperuniformity
