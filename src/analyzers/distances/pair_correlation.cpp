// SPDX-License-Identifier: MIT
//
// Pair correlation function: the number of points at a distance t from a point, divided by the same
// number for independent uniform points,
//
//     g(t) = sum over pairs of w(|x_i - x_j|; t)  /  ( n (n - 1) / 2 * integral of w(s; t) dp(s) ),
//
// where p(s) is the probability that two uniform points of the box are at most s apart. It accounts
// for faces and edges exactly, at any distance (pair_counts.hpp). The weight is one of
//
//     histogram      w = 1 for distances in the bin around t, else 0
//     epanechnikov   w = 1 - ((s - t) / h)^2 for |s - t| < h, with t at the edges of bins; computed
//                    from each bin's sums of distances and their squares, without rounding them
//                    to bins
//
// Independent uniform points have g = 1 on average; where `density` is 0 there are no pairs.
// `deviation` is the standard deviation of g for the same number of such points,
//
//     sqrt( E[w^2] / E[w]^2 - 1 ) / sqrt( n (n - 1) / 2 ),
//
// on the torus, where the distances of different pairs are independent. It is left out for straight
// distances, which are dependent.
//
// Shape   n >= 2 points of the unit cube or a box, d = 1, 2, 3.
// Units   distances in the unit of the points; with --normalize-distance in (V / n)^(1/d), so that
//         sets of different n can be averaged and compared.
// Cost    O(n + pairs within max-distance). 10^6 points of the plane to 10 mean distances, 1.6e8
//         pairs, take 1.1 s on one core.
// Promise every pair within max-distance counts exactly once. Never depends on the number of
//         threads.
// Beware  distances are float64: those of a lattice may fall on either side of a bin's edge.
// Source  S. N. Chiu, D. Stoyan, W. S. Kendall, J. Mecke, "Stochastic Geometry and its
//         Applications", 3rd ed., Wiley 2013, sections 4.3 and 4.7; A. C. Oeztireli, M. Gross, ACM
//         Trans. Graph. 31:6 (2012) 170, doi:10.1145/2366145.2366189 (of sampling patterns).

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "analyzers/distances/pair_counts.hpp"
#include "core/error.hpp"
#include "core/text.hpp"

namespace stipple::analyzers::pair_correlation {
namespace {

constexpr Param<double> max_distance{
    .name = "max-distance",
    .low = 0,
    .low_open = true,
    .optional = true,
    .help =
        "Largest distance of pairs; default: 5 (V / n)^(1/d), but at most half the shortest side "
        "on the torus and the shortest side elsewhere"};

constexpr Param<std::int64_t> bin_count{.name = "bins",
                                        .fallback = 200,
                                        .low = 1,
                                        .high = 1'000'000,
                                        .help = "Number of distance bins, of equal width"};

constexpr Param<Choice> kernel{
    .name = "kernel",
    .fallback = "histogram",
    .choices = "histogram|epanechnikov",
    .help = "How pairs are counted: histogram: in bins; epanechnikov: smoothed by a parabola"};

constexpr Param<std::int64_t> bandwidth{.name = "bandwidth",
                                        .fallback = 4,
                                        .low = 1,
                                        .high = 1000,
                                        .unit = "bins",
                                        .help = "Half width of the kernel epanechnikov, in bins"};

constexpr Param<bool> normalize{
    .name = "normalize-distance",
    .help = "Give distances, and --max-distance, in units of (V / n)^(1/d)"};

/// Resolved request: `bins` bins of this `width`, and the `unit` of reported distances.
struct Plan {
    Distances distances;
    std::size_t bins;
    std::size_t spread;  ///< half width of the kernel in bins, 0 for a histogram
    double width;
    double unit;
    double pairs;  ///< number of all pairs of points
};

double default_reach(const Distances& distances, double mean) {
    const double shortest = shortest_side(*distances.box);
    return std::min(5 * mean, distances.torus ? shortest / 2 : shortest);
}

Plan plan_for(const PointSet& points, const Values& options) {
    Plan plan{
        .distances = distances_in_box(points, options[metric], "pair-correlation"),
        .bins = static_cast<std::size_t>(options[bin_count]),
        .spread = options[kernel] == "histogram" ? 0 : static_cast<std::size_t>(options[bandwidth]),
        .width = 0,
        .unit = 1,
        .pairs = 0};
    if (options.given(bandwidth) && plan.spread == 0)
        fail(ErrorKind::usage, "--bandwidth applies to --kernel epanechnikov only");
    if (plan.spread > plan.bins)
        fail(ErrorKind::usage, "--bandwidth: {} is more than the {} bins", plan.spread, plan.bins);
    const auto n = static_cast<double>(points.count());
    const Box& box = *plan.distances.box;
    const double mean = mean_distance(box, static_cast<double>(points.count()));
    if (options[normalize]) plan.unit = mean;
    const double longest = longest_distance(box, plan.distances.torus);
    double reach = default_reach(plan.distances, mean);
    if (options.given(max_distance)) {
        reach = options[max_distance] * plan.unit;
        if (!(reach <= longest * (1 + 1e-9)))
            fail(ErrorKind::usage,
                 "--max-distance: {} is more than any pair can have; expected at most {}",
                 format_number(options[max_distance]), format_number(longest / plan.unit));
    }
    plan.width = reach / static_cast<double>(plan.bins);
    if (!(reach > 1e-90 * mean))
        fail(ErrorKind::usage,
             "--max-distance: {} is too small for the probability of a pair to fit float64; "
             "expected at least {}",
             format_number(options[max_distance]), format_number(1e-90 * mean / plan.unit));
    plan.pairs = n * (n - 1) / 2;
    return plan;
}

/// Probabilities that two independent points are nearer than a distance, and farther; the latter
/// only where it is needed: near the longest distance.
struct Chance {
    double nearer;
    std::optional<double> farther;
};

/// Probability of distances between two, without cancellation at either end.
double between(const Chance& a, const Chance& b) {
    return a.farther && b.farther ? *a.farther - *b.farther : b.nearer - a.nearer;
}

/// Chances for distances of x bin widths, for x at the edges of the bins and at the nodes of Gaussian
/// quadrature inside them.
class Chances {
  public:
    static constexpr std::array<double, 4> nodes = {0.069431844202973714, 0.33000947820757187,
                                                    0.66999052179242813, 0.93056815579702629};
    static constexpr std::array<double, 4> weights = {0.17392742256872693, 0.32607257743127307,
                                                      0.32607257743127307, 0.17392742256872693};

    Chances(const Plan& plan, const RunContext& run) {
        const std::size_t last = plan.bins + plan.spread;
        const auto below = [&](double bins) {
            const auto& [torus, box, norm] = plan.distances;
            const double r = bins * plan.width;
            return Chance{pair_probability(*box, torus, r),
                          pair_probability_beyond(*box, torus, r)};
        };
        for (std::size_t i = 0; i <= last; ++i) {
            if (i % 64 == 0) run.tick(i, last);
            rims_.push_back(below(static_cast<double>(i)));
            for (std::size_t g = 0; plan.spread > 0 && g < nodes.size(); ++g)
                inside_.push_back(below(static_cast<double>(i) + nodes[g]));
        }
        run.tick(last, last);
    }
    [[nodiscard]] const Chance& below(std::size_t bins) const { return rims_[bins]; }
    [[nodiscard]] const Chance& below_node(std::size_t bin, std::size_t g) const {
        return inside_[bin * nodes.size() + g];
    }

  private:
    std::vector<Chance> rims_;
    std::vector<Chance> inside_;
};

struct Curves {
    Report::Curve distance;
    Report::Curve density;
    Report::Curve deviation;

    /// Adds g(t) and its deviation, from the sum of all weights and the moments of one weight.
    void add(double t, double sum, double mean, double mean_square, double pairs) {
        distance.push_back(t);
        density.push_back(mean > 0 ? sum / (pairs * mean) : 0);
        const double variance = std::max(0.0, mean_square - mean * mean);
        deviation.push_back(mean > 0 ? std::sqrt(variance / pairs) / mean : 0);
    }
};

Curves histogram(const Plan& plan, const PairCounts& counts, const RunContext& run) {
    const Chances chances(plan, run);
    Curves curves;
    for (std::size_t i = 0; i < plan.bins; ++i) {
        const double middle = (static_cast<double>(i) + 0.5) * plan.width / plan.unit;
        const double chance = between(chances.below(i), chances.below(i + 1));
        curves.add(middle, static_cast<double>(counts.pairs[i]), chance, chance, plan.pairs);
    }
    return curves;
}

/// Sum of 1 - ((s - t) / h)^2 over the pairs with |s - t| < h, where s is a pair's distance and t
/// the lower edge of bin `at`.
double parabola_sum(const PairCounts& counts, std::size_t at, std::size_t spread) {
    const auto h = static_cast<double>(spread);
    double sum = 0;
    for (std::size_t i = at - std::min(at, spread); i < at + spread; ++i) {
        const double off = static_cast<double>(i) + 0.5 - static_cast<double>(at);
        const auto pairs = static_cast<double>(counts.pairs[i]);
        const double squares =
            off * off * pairs + 2 * off * counts.offsets[i] + counts.squared_offsets[i];
        sum += pairs - squares / (h * h);
    }
    return sum;
}

/// Mean of max(0, 1 - ((s - t) / h)^2)^power for the distance s of two independent points. The
/// integral is done by parts, so that no density of distances is needed.
double parabola_mean(const Chances& chances, std::size_t at, std::size_t spread, int power) {
    const auto h = static_cast<double>(spread);
    const std::size_t first = at - std::min(at, spread);
    double sum = 0;
    for (std::size_t i = first; i < at + spread; ++i)
        for (std::size_t g = 0; g < Chances::nodes.size(); ++g) {
            const double bins = static_cast<double>(i) - static_cast<double>(at);
            const double u = (bins + Chances::nodes[g]) / h;
            const double slope = 2 * u / h * (power == 1 ? 1 : 2 * (1 - u * u));
            sum += Chances::weights[g] * slope *
                   between(chances.below(first), chances.below_node(i, g));
        }
    return sum;
}

Curves smooth(const Plan& plan, const PairCounts& counts, const RunContext& run) {
    const Chances chances(plan, run);
    Curves curves;
    for (std::size_t at = 0; at <= plan.bins; ++at) {
        run.check_stop();
        curves.add(static_cast<double>(at) * plan.width / plan.unit,
                   parabola_sum(counts, at, plan.spread),
                   parabola_mean(chances, at, plan.spread, 1),
                   parabola_mean(chances, at, plan.spread, 2), plan.pairs);
    }
    return curves;
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    if (points.count() < 2)
        fail(ErrorKind::input, "pair-correlation needs at least two points; this is one");
    const Plan plan = plan_for(points, options);
    if (all_equal(points))
        run.notify(fmt::format("all {} points are equal: all distances are 0", points.count()));
    const PairCounts counts =
        count_pairs(points, plan.distances, plan.width, plan.bins + plan.spread, plan.spread > 0,
                    run.stage(0, 0.98));
    if (std::ranges::count(counts.pairs, 0U) == std::ssize(counts.pairs))
        run.notify(fmt::format(
            "no two points are within the largest distance, {:.4g}: there are no pairs to count",
            static_cast<double>(plan.bins) * plan.width));
    const RunContext rest = run.stage(0.98, 1);
    Curves curves = plan.spread == 0 ? histogram(plan, counts, rest) : smooth(plan, counts, rest);
    const char* unit = options[normalize] ? "(V / n)^(1/d)" : "";
    Report::Integers pairs;
    for (std::size_t i = 0; i < plan.bins; ++i)
        pairs.push_back(static_cast<std::int64_t>(counts.pairs[i]));
    Report results;
    results.add("distance", std::move(curves.distance), unit);
    results.add("density", std::move(curves.density));
    if (plan.distances.torus) results.add("deviation", std::move(curves.deviation));
    if (plan.spread == 0) results.add("pairs", std::move(pairs));
    results.add("max_distance", static_cast<double>(plan.bins) * plan.width / plan.unit, unit);
    results.add("bin_width", plan.width / plan.unit, unit);
    results.add("mean_distance",
                mean_distance(*plan.distances.box, static_cast<double>(points.count())));
    results.add("kernel", options[kernel]);
    results.add("metric", plan.distances.name());
    return results;
}

/// Rejects functions with different bins, which cannot be averaged.
void combine(Report&, std::span<const Report> sets, const Values&) {
    if (!alike(sets, "bin_width"))
        fail_with_hint(ErrorKind::usage, "set one --max-distance, or --normalize-distance",
                       "--average: the sets differ in number of points or in box, and therefore in "
                       "their largest distances");
}

}  // namespace

Analyzer unit() {
    return {
        .name = "pair-correlation",
        .summary =
            "Pair correlation function: relative density of points at each distance from a point",
        .source = "Chiu, Stoyan, Kendall, Mecke, Stochastic Geometry and its Applications 2013",
        .related = {"pcf", "rdf", "radial-distribution", "ripley"},
        .traits = {.max_dimension = 3, .unit_cube = false, .boxed = true},
        .options = Schema(max_distance, bin_count, kernel, bandwidth, normalize, metric),
        .results =
            {{"distance", "centres of the bins (epanechnikov: their edges, from 0)"},
             {"density", "number of pairs at that distance divided by that of uniform points"},
             {"deviation",
              "standard deviation of the density for one set of uniform points; only on the torus"},
             {"pairs", "number of pairs in each bin; only for the kernel histogram"},
             {"max_distance", "upper edge of the last bin"},
             {"bin_width", "width of each bin"},
             {"mean_distance", "(V / n)^(1/d), in units of the points"},
             {"kernel", "histogram or epanechnikov", true, "histogram|epanechnikov"},
             {"metric", "torus or euclidean", true, "torus|euclidean"}},
        .curves = {{"density", "distance", "1", "", "", false,
                    "Pair correlation over distance; independent points have 1"}},
        .part = PagePart::pairs,
        .page = {{"Pair correlation"}},
        .charts = {{"pair-correlation", ""}},
        .analyze = analyze,
        .combine = combine};
}

}  // namespace stipple::analyzers::pair_correlation
