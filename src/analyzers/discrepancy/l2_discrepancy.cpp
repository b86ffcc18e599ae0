// SPDX-License-Identifier: MIT
//
// L2 discrepancies of n points x_i in the unit cube: root mean squares of local discrepancies,
// which are also norms of integration errors. Each has a kernel k on one axis,
//
//     star        1 - max(x, y)                                  boxes [0, c)
//     extreme     min(x, y) - x y                                boxes [a, b)
//     periodic    1/2 - t + t^2,  t = |x - y|                    boxes that wrap around
//     centered    (|x - 1/2| + |y - 1/2| - t) / 2                boxes towards the nearest corner
//     wraparound  1/2 - t + t^2
//     mixture     7/8 - (|x - 1/2| + |y - 1/2| + 3 t) / 4 + t^2 / 2
//     modified    1 - max(x, y)
//     diaphony    2 pi^2 (1/6 - t + t^2) = sum over m != 0 of cos(2 pi m t) / m^2
//     average     (1 - t) / 2                                    boxes at a corner, mean of all 2^d
//     symmetric   1 - 2 t                                        unions of boxes, even minus odd
//
// Let K be the product over the axes of k for star, extreme, periodic and average, and of 1 + k for
// the others (so that every projection counts). Then
//
//     squared = int int K  -  2/n sum_i int K(x_i, y) dy  +  n^-2 sum_i sum_k K(x_i, x_k),
//     value   = sqrt(squared).
//
// With product weights w_j >= 0, given or j^-decay, K is the product of 1 + w_j k for every kind:
// squared is the sum, over all sets of axes, of the product of their weights times the square for k
// on these axes alone. (So star with weights is modified with weights, and periodic is wraparound;
// weights of 1 change nothing for kinds of 1 + k. Without weights symmetric is 2^d times average.)
//
// Shape   points n x d in [0, 1];  results >= 0, pure numbers, smaller is more even.
// Cost    d <= 2: O(n log n) for all kinds together (about 0.4 s at n = 10^6 on one core).
//         d > 2: O(n^2 d) for each kind. For many points, O(n log^2 n) in three dimensions; in
//         four, O(n log^3 n) for the kinds star, extreme, centered and modified.
// Promise the same for any number of threads. d <= 2: exact sums, rounded once at the end, of
//         coordinates rounded to multiples of 2^-63. d > 2: `value` is off by at most `error`. This
//         is below a relative 1e-12 (usually the rounding of the value) unless all but 2^-38 of the
//         sum cancels.
// Beware  SciPy's CD, WD and MD are `squared` of centered, wraparound and mixture; its L2-star is
//         `value` of star. Diaphony is not divided by its largest value, sqrt((1 + pi^2/3)^d - 1).
// Source  T. T. Warnock, in "Applications of Number Theory to Numerical Analysis" (1972) 319-343
//         (star). F. J. Hickernell, Math. Comp. 67 (1998) 299-322 (centered, modified, symmetric);
//         "Lattice rules: how well do they measure up?" (1998) (wraparound). Y.-D. Zhou, K.-T.
//         Fang, J.-H. Ning, J. Complexity 29 (2013) 283-301 (mixture). W. J. Morokoff, R. E.
//         Caflisch, SIAM J. Sci. Comput. 15 (1994) 1251-1279 (extreme). arXiv:2508.04926 (average).
//         P. Zinterhof, Sitzungsber. Oesterr. Akad. Wiss. II 185 (1976) 121-132 (diaphony). I. H.
//         Sloan, H. Wozniakowski, J. Complexity 14 (1998) 1-33 (weights). S. Heinrich, Math. Comp.
//         65 (1996) 1621-1633 (fewer than n^2).

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyzers/analyzer.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "math/decaying_weights.hpp"
#include "math/l2/kinds.hpp"
#include "math/l2/squares.hpp"

namespace stipple::analyzers::l2_discrepancy {
namespace {

constexpr Param<Text> kind{{.name = "kind",
                            .fallback = "all",
                            .help = "Kinds, separated by commas: all, or some of star, extreme, "
                                    "periodic, centered, wraparound, mixture, modified, diaphony, "
                                    "average, symmetric; defined in stipple help definitions"}};

constexpr Param<Numbers> axis_weights{
    {.name = "weights",
     .help = "Product weights, one for each coordinate, from 0 to 10^6: K = prod (1 + weight k) "
             "for every kind, so that each projection counts by the product of its weights. "
             "Without this option star, extreme, periodic and average have K = prod k, which "
             "differs from weights 1"}};

constexpr Param<std::int64_t> weight_decay{
    .name = "decay",
    .low = 0,
    .high = 20,
    .optional = true,
    .help = "Instead of --weights: coordinate j has the weight j^-decay"};

/// Limit beyond any machine's memory; indices of points fit 32 bits.
constexpr std::size_t max_count = std::size_t{1} << 29;

std::vector<double> checked_weights(const Values& options, std::size_t dimension) {
    if (options.given(weight_decay) && options.given(axis_weights))
        fail(ErrorKind::usage, "--weights contradicts --decay; give one of them");
    if (options.given(weight_decay)) return decaying_weights(options[weight_decay], dimension);
    if (!options.given(axis_weights)) return {};
    const std::vector<double> weights = options[axis_weights];
    if (weights.size() != dimension)
        fail(ErrorKind::usage,
             "--weights: {} numbers for points of {} coordinates; expected one for each",
             weights.size(), dimension);
    constexpr double most = 1e6;
    for (const double weight : weights)
        if (!(weight >= 0 && weight <= most))
            fail(ErrorKind::usage, "--weights: {} is outside [0, 1e6]", format_number(weight));
    return weights;
}

Report result_of(double squared, const char* method) {
    Report result;
    const double square = squared > 0 ? squared : 0;
    return result.add("value", std::sqrt(square)).add("squared", square).add("method", method);
}

Report in_plane(const PointSet& points, const std::vector<l2::Kind>& kinds,
                const l2::AxisWeights& weights, const RunContext& run) {
    run.need_memory(static_cast<double>(points.count()) * 48, "the sums of l2-discrepancy");
    const l2::PlaneSums sums = l2::plane_sums(points, run);
    Report results;
    for (const l2::Kind which : kinds) {
        const double squared = l2::plane_square(sums, points.dimension(), which, weights);
        results.add(l2::record_of(which).name, result_of(squared, "exact-sums"));
    }
    return results;
}

/// Largest error of sqrt(squared), if `squared` is off by at most `error`.
double error_of_root(double squared, double error) {
    const double value = std::sqrt(std::max(squared, 0.0));
    if (squared > error) return value - std::sqrt(squared - error) + 0x1p-51 * value;
    return std::sqrt(std::max(squared, 0.0) + error);
}

/// Warns if computing all pairs takes about ten minutes or more on one core.
void warn_of_pairs(std::size_t n, std::size_t d, l2::Kind which, const RunContext& run) {
    const double pairs = static_cast<double>(n) * static_cast<double>(n) / 2;
    const double seconds = 0.6e-9 * pairs * static_cast<double>(d);
    if (seconds < 600) return;
    run.notify(
        fmt::format("{} l2-discrepancy computes all pairs of {} points in {} dimensions, about "
                    "{:.0f} minutes on one core",
                    l2::record_of(which).name, n, d, seconds / 60));
}

/// Report of the root of `square` with its largest error; warns if few of its digits are certain.
Report off_by(const l2::Square& square, l2::Kind which, const char* method, const RunContext& run) {
    constexpr double few_digits = 1e-9;
    constexpr double smallest = std::numeric_limits<double>::min();
    const double error = error_of_root(square.squared, square.error + smallest);
    if (error > few_digits * std::sqrt(std::max(square.squared, 0.0)))
        run.notify(fmt::format(
            "l2-discrepancy: {} of {} {}; its value has an error up to {:.2g}",
            square.error < smallest ? "the square" : "nearly all digits", l2::record_of(which).name,
            square.error < smallest ? "is below the smallest double" : "cancel", error));
    return result_of(square.squared, method).add("error", error);
}

/// Discrepancy of one kind in three or more dimensions. @throws Error(limit) if the value is not
/// finite and no other kind is requested (`alone`)
Report in_space(const PointSet& points, l2::Kind which, const l2::AxisWeights& weights, bool alone,
                const RunContext& run) {
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    if (l2::divides(d, which, weights) && l2::divide_wins(n, d, which, weights)) {
        run.need_memory(l2::divide_memory(n, d, which, weights), "the tables of l2-discrepancy");
        return off_by(l2::divide_square(points, which, weights, run), which, "divide-and-conquer",
                      run);
    }
    warn_of_pairs(n, d, which, run);
    run.need_memory(l2::pair_memory(n, d), "the tables of l2-discrepancy");
    const l2::Square square = l2::pair_square(points, which, weights, run);
    if (std::isfinite(square.squared)) return off_by(square, which, "all-pairs", run);
    const std::string why =
        fmt::format("in {} dimensions its square is beyond the largest double", d);
    if (alone)
        fail_with_hint(ErrorKind::limit, "--kind selects others", "{} discrepancy: {}",
                       l2::record_of(which).name, why);
    return Report().add("missing", why);
}

Report in_spaces(const PointSet& points, const std::vector<l2::Kind>& kinds,
                 const l2::AxisWeights& weights, const RunContext& run) {
    Report results;
    const auto parts = static_cast<double>(kinds.size());
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        const auto at = static_cast<double>(i);
        const RunContext part = run.stage(at / parts, (at + 1) / parts);
        results.add(l2::record_of(kinds[i]).name,
                    in_space(points, kinds[i], weights, kinds.size() == 1, part));
    }
    run.tick(1, 1);
    return results;
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    if (points.count() > max_count)
        fail(ErrorKind::limit, "l2-discrepancy accepts up to {} points; these are {}", max_count,
             points.count());
    const std::vector<l2::Kind> kinds = l2::parse_kinds(options[kind]);
    const std::vector<double> weights = checked_weights(options, points.dimension());
    return points.dimension() <= 2 ? in_plane(points, kinds, weights, run)
                                   : in_spaces(points, kinds, weights, run);
}

}  // namespace

Analyzer unit() {
    return {.name = "l2-discrepancy",
            .summary =
                "L2 discrepancies: star, extreme, periodic, centered, wraparound, mixture, "
                "modified, diaphony, average and symmetric",
            .source =
                "Hickernell 1998, doi:10.1090/S0025-5718-98-00894-1; Heinrich 1996, "
                "doi:10.1090/S0025-5718-96-00756-4",
            .related = {"discrepancy", "cd2", "wd2", "md2", "l2", "l2-star", "l2-centered",
                        "warnock", "diaphony", "centered"},
            .traits = {.max_dimension = 10'000},
            .options = Schema(kind, axis_weights, weight_decay),
            .results = {lower({"KIND.value", "the discrepancy of that kind"}),
                        {"KIND.squared", "its square"},
                        {"KIND.method", "exact-sums, divide-and-conquer or all-pairs", true,
                         "exact-sums|divide-and-conquer|all-pairs"},
                        {"KIND.error",
                         "bound on the rounding error of the value (in three or more dimensions; "
                         "exact in fewer)",
                         false},
                        {"KIND.missing",
                         "reason why the kind has no value, instead of its other results", false}},
            .part = PagePart::means,
            .page = {{"L2 discrepancies",
                      {{"star.value", "L2 star"},
                       {"extreme.value", "L2 extreme"},
                       {"periodic.value", "L2 periodic"},
                       {"centered.value", "L2 centered"},
                       {"wraparound.value", "L2 wraparound"},
                       {"mixture.value", "L2 mixture"},
                       {"modified.value", "L2 modified"},
                       {"diaphony.value", "Diaphony"}}}},
            .pairs = {.above = 2, .steps = 20},
            .analyze = analyze,
            .cost = [](double n, double d) {
                return d <= 2 ? 5e-7 * n : d * std::min(1e-10 * n * n * d, 1e-5 * n);
            }};
}

}  // namespace stipple::analyzers::l2_discrepancy
