// SPDX-License-Identifier: MIT
//
// Criteria of designs of experiments, of n points x_i in the unit cube (a box is scaled to it),
// with straight distances d_ij = |x_i - x_j|:
//
//     minimum         min d_ij, the maximin criterion
//     phi_p           (sum_{i<j} d_ij^-p)^(1/p), near 1 / minimum for a large p (Morris, Mitchell)
//     audze_eglais    sum_{i<j} 1 / d_ij^2
//     maxpro          ((n choose 2)^-1 sum_{i<j} prod_k (x_ik - x_jk)^-2)^(1/d) (Joseph, Gul, Ba)
//     variation       deviation / mean of the distances to the nearest neighbours: the coverage
//                     measure of Gunzburger and Burkardt, 0 for a grid
//     correlation     of two coordinates: the largest absolute value, and the root mean square
//     line, plane     smallest distance of two points in any projection to one axis or to two
//     efficiency      D, A and G for estimating the p coefficients of a polynomial model
//
// and the means of all criteria over random Latin hypercubes of n points, with the seeds 1, 2, ....
//
// Each coordinate is scaled for the model, so that its lowest and highest values in the design are
// -1 and 1. With f(x) the row of the model's terms at x, X the matrix of the rows of all runs, and
// M = X^T X,
//
//     D = det(M)^(1/p) / n,     A = p / (n trace(M^-1)),     G = p / (n max_x f(x)^T M^-1 f(x)),
//
// which are 1 for an orthogonal design with all coordinates at -1 and 1, and 0 if M is singular: a
// term is a combination of others, within about 1e-7.
//
// Shape   n x d, n >= 2, d <= 1000. Sums over pairs for up to 16384 points; planes for d <= 32.
// Units   lengths of the unit cube.
// Cost    O(n^2 d) for one set, and as much for each Latin hypercube; 0.2 s for 10 of them at n =
//         1000, d = 5 on one core; O(n p^2 + p^3 + c p^2) for c candidates x of the maximum in G.
// Promise infinite values (points that coincide; maxpro where two share a coordinate) are left out,
//         as is `plane` if squares of distances underflow. The same for any number of threads.
// Source  M. D. Morris, T. J. Mitchell, J. Stat. Plan. Inference 43 (1995) 381-402,
//         doi:10.1016/0378-3758(94)00035-T; P. Audze, V. Eglais, Problems of Dynamics and Strengths
//         35 (1977) 104-107; V. R. Joseph, E. Gul, S. Ba, Biometrika 102 (2015) 371-380,
//         doi:10.1093/biomet/asv002; M. Gunzburger, J. Burkardt, "Uniformity measures for point
//         samples in hypercubes" (2004); A. C. Atkinson, A. N. Donev, R. D. Tobias, "Optimum
//         Experimental Designs, with SAS", Oxford 2007, chapters 9 to 11 (efficiencies).

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "math/functions/cholesky.hpp"
#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/functions/powers.hpp"
#include "stipple/generate.hpp"

namespace stipple::analyzers::design {
namespace {

constexpr Param<double> exponent{
    .name = "p", .fallback = 15, .low = 1, .high = 1000, .help = "Exponent p of phi_p"};

constexpr Param<Choice> model{.name = "model",
                              .fallback = "linear",
                              .choices = "none|linear|interaction|quadratic",
                              .help =
                                  "Terms of the polynomial to be fitted: linear: 1 and all x; "
                                  "interaction: also products of two; quadratic: also squares"};

constexpr Param<std::int64_t> compare{
    .name = "compare",
    .fallback = 10,
    .low = 0,
    .high = 100'000,
    .unit = "sets",
    .help = "Number of random Latin hypercubes of the same size to compare with"};

constexpr std::size_t most_paired = 16384;
constexpr std::size_t most_planes = 32;

constexpr double infinite = std::numeric_limits<double>::infinity();

Distances straight_in_cube(std::size_t dimension) {
    return {.torus = false, .box = unit_cube(dimension)->bounding_box()};
}

std::vector<double> column_of(const PointSet& points, std::size_t k) {
    std::vector<double> column;
    for (std::size_t i = 0; i < points.count(); ++i) column.push_back(points[i][k]);
    return column;
}

/// A smallest or largest value, and the axes (from 0) at which it occurs.
struct AtAxes {
    double value = 0;
    std::vector<std::size_t> axes = {};
};

/// Smallest distance of two points in any projection to one axis.
AtAxes closest_on_axis(const PointSet& points) {
    AtAxes closest{infinite, {}};
    for (std::size_t k = 0; k < points.dimension(); ++k) {
        auto column = column_of(points, k);
        std::ranges::sort(column);
        for (std::size_t i = 1; i < column.size(); ++i)
            if (column[i] - column[i - 1] < closest.value)
                closest = {column[i] - column[i - 1], {k}};
    }
    return closest;
}

struct PairSums {
    double powers = 0;       ///< sum of (minimum / distance)^p
    double reciprocals = 0;  ///< sum of 1 / distance^2
    /// Sum of 1 / prod (4 difference)^2; the factor 4 avoids underflow of the product.
    double products = 0;

    PairSums& operator+=(const PairSums& other) {
        powers += other.powers;
        reciprocals += other.reciprocals;
        products += other.products;
        return *this;
    }
};

/// Adds the criteria of the distances to the nearest neighbours; returns the smallest distance.
double add_separation(Report& report, const PointSet& points, const RunContext& run) {
    const auto neighbors = nearest_neighbors(points, straight_in_cube(points.dimension()), run);
    const auto n = static_cast<double>(neighbors.size());
    double mean = 0;
    for (const Neighbor& near : neighbors) mean += std::sqrt(near.squared) / n;
    double squares = 0;
    for (const Neighbor& near : neighbors) {
        const double deviation = std::sqrt(near.squared) - mean;
        squares += deviation * deviation / n;
    }
    const double minimum = std::sqrt(closest_pair(neighbors).second.squared);
    report.add("minimum", minimum);
    report.add("minimum_squared", minimum * minimum);
    report.add("variation", mean > 0 ? std::sqrt(squares) / mean : 0);
    return minimum;
}

/// maxpro by logarithms, for sums of products beyond float64; no two points share a coordinate.
double maxpro_by_logarithms(const PointSet& points, double pairs, const RunContext& run) {
    double sum = 0;
    double largest = 0;  // the sum is that of exp(largest) times `sum`
    for (std::size_t i = 0; i < points.count(); ++i) {
        run.check_stop();
        for (std::size_t j = 0; j < i; ++j) {
            double term = 0;
            for (std::size_t k = 0; k < points.dimension(); ++k)
                term -= 2 * logarithm(std::abs(points[i][k] - points[j][k]));
            const double above = std::max(largest, term);
            sum = sum * exponential(largest - above) + exponential(term - above);
            largest = above;
        }
    }
    const double power =
        (largest + logarithm(sum / pairs)) / static_cast<double>(points.dimension());
    return power > 709 ? infinite : exponential(power);
}

/// Adds the criteria that are sums over all pairs of points, unless they are infinite.
/// @param minimum the smallest distance
void add_pair_criteria(Report& report, const PointSet& points, double p, double minimum,
                       const RunContext& run) {
    constexpr std::uint64_t size = 16;
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    const double* x = points.flat().data();
    std::vector<PairSums> parts(block_count(n, size));
    for_each_block(run, n, size, [&](const Block& block) {
        PairSums sums;
        for (std::size_t i = block.first; i < block.last; ++i)
            for (std::size_t j = 0; j < i; ++j) {
                double squared = 0;
                double product = 1;
                for (std::size_t k = 0; k < d; ++k) {
                    const double difference = x[i * d + k] - x[j * d + k];
                    squared += difference * difference;
                    product *= 4 * difference;
                }
                const double ratio = minimum * minimum / squared;
                sums += {real_power(ratio, p / 2), 1 / squared, 1 / (product * product)};
            }
        parts[block.index] = sums;
    });
    PairSums all;
    for (const PairSums& part : parts) all += part;
    const auto add = [&](const char* name, double value) {
        if (std::isfinite(value)) report.add(name, value);
    };
    if (minimum > 0) {
        add("phi_p", real_power(all.powers, 1 / p) / minimum);
        add("audze_eglais", all.reciprocals);
    }
    const auto pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    if (all.products > 1e-290 && std::isfinite(all.products))
        add("maxpro", 16 * real_power(all.products / pairs, 1 / static_cast<double>(d)));
    else if (closest_on_axis(points).value > 0)
        add("maxpro", maxpro_by_logarithms(points, pairs, run));
}

/// Adds the value and the axes, numbered from 1.
void add_at(Report& report, const char* name, const char* name_of_axes, const AtAxes& at) {
    Report::Integers numbers;
    for (const std::size_t k : at.axes) numbers.push_back(static_cast<std::int64_t>(k + 1));
    report.add(name, at.value);
    report.add(name_of_axes, std::move(numbers));
}

/// Subtracts the mean of numbers that are not all equal, and makes the sum of their squares 1.
void standardize(std::vector<double>& column) {
    const auto n = static_cast<double>(column.size());
    const auto [low, high] = std::ranges::minmax(column);
    constexpr double narrow = 0x1p-20;  // the mean's rounding error matters to narrower columns
    if (const double width = high - low; width < narrow)
        for (double& c : column) c = (c - low) / unit_for(width);
    double mean = 0;
    for (const double c : column) mean += c / n;
    double squares = 0;
    for (const double c : column) squares += (c - mean) * (c - mean);
    for (double& c : column) c = (c - mean) / std::sqrt(squares);
}

/// Adds the correlations of all coordinates that vary, if there are at least two.
void add_correlations(Report& report, const PointSet& points) {
    const std::size_t n = points.count();
    std::vector<std::size_t> axes;
    std::vector<std::vector<double>> columns;  // centred and of length 1
    for (std::size_t k = 0; k < points.dimension(); ++k) {
        auto column = column_of(points, k);
        if (std::ranges::min(column) == std::ranges::max(column)) continue;
        standardize(column);
        axes.push_back(k);
        columns.push_back(std::move(column));
    }
    if (axes.size() < 2) return;
    AtAxes largest{-1, {}};
    double squares = 0;
    for (std::size_t a = 1; a < axes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) sum += columns[a][i] * columns[b][i];
            squares += sum * sum;
            const double size = std::min(std::abs(sum), 1.0);
            if (size > largest.value) largest = {size, {axes[b], axes[a]}};
        }
    add_at(report, "largest_correlation", "largest_correlation_axes", largest);
    const auto pairs = 0.5 * static_cast<double>(axes.size() * (axes.size() - 1));
    report.add("rms_correlation", std::min(std::sqrt(squares / pairs), 1.0));
}

/// Smallest distance of two points in any projection to two axes, in O(n log n) for each; infinite
/// if squared distances of different projections underflow.
AtAxes closest_on_plane(const PointSet& points, const RunContext& run) {
    constexpr double least = 1e-290;
    AtAxes closest{infinite, {}};
    PointSet plane(points.count(), 2);
    for (std::size_t a = 1; a < points.dimension(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            run.check_stop();
            for (std::size_t i = 0; i < points.count(); ++i) {
                plane[i][0] = points[i][b];
                plane[i][1] = points[i][a];
            }
            const auto neighbors = nearest_neighbors(plane, straight_in_cube(2), silent(run));
            const auto [first, second] = closest_pair(neighbors);
            if (second.squared < least && !std::ranges::equal(plane[first], plane[second.index]))
                return {infinite, {}};
            const double distance = std::sqrt(second.squared);
            if (distance < closest.value) closest = {distance, {b, a}};
        }
    return closest;
}

/// Coordinates scaled so that the lowest value of each is -1 and the highest is 1.
std::vector<double> coded(const PointSet& cube) {
    const std::size_t d = cube.dimension();
    const Box range = bounding_box(cube.flat(), d);
    std::vector<double> rows(cube.flat().begin(), cube.flat().end());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t k = i % d;
        const double extent = range.extent(k);
        rows[i] = extent > 0 ? ((rows[i] - range.low[k]) - (range.high[k] - rows[i])) / extent : 0;
    }
    return rows;
}

enum class Model { none, linear, interaction, quadratic };  // in the order of --model

Model model_of(const Values& options) {
    const auto names = describe(model).choices;
    return static_cast<Model>(std::ranges::find(names, options[model]) - names.begin());
}

std::size_t model_terms(Model kind, std::size_t d) {
    if (kind <= Model::linear) return kind == Model::none ? 0 : 1 + d;
    return 1 + d + d * (d - 1) / 2 + (kind == Model::quadratic ? d : 0);
}

void terms_of(std::span<const double> x, Model kind, std::vector<double>& f) {
    f.assign(1, 1);
    f.insert(f.end(), x.begin(), x.end());
    if (kind == Model::linear) return;
    for (std::size_t i = 0; i < x.size(); ++i)
        for (std::size_t j = kind == Model::quadratic ? i : i + 1; j < x.size(); ++j)
            f.push_back(x[i] * x[j]);
}

/// Lower triangle of M.
std::vector<double> information(std::span<const double> coded, std::size_t dimension, Model kind,
                                const RunContext& run) {
    const std::size_t p = model_terms(kind, dimension);
    const std::size_t n = coded.size() / dimension;
    std::vector<double> m(p * p);
    std::vector<double> f;
    for (std::size_t i = 0; i < n; ++i) {
        terms_of(coded.subspan(i * dimension, dimension), kind, f);
        for (std::size_t a = 0; a < p; ++a)
            for (std::size_t b = 0; b <= a; ++b) m[a * p + b] += f[a] * f[b];
        if (i % 256 == 0) run.check_stop();
    }
    return m;
}

/// Replaces f by L^-1 f, where L is `factor`; returns the squared length. f is 0 before `first`.
double solve(std::span<const double> factor, std::size_t first, std::vector<double>& f) {
    const std::size_t p = f.size();
    double squares = 0;
    for (std::size_t i = first; i < p; ++i) {
        double rest = f[i];
        for (std::size_t j = first; j < i; ++j) rest -= factor[i * p + j] * f[j];
        f[i] = rest / factor[i * p + i];
        squares += f[i] * f[i];
    }
    return squares;
}

double trace_of_inverse(std::span<const double> factor, std::size_t p, const RunContext& run) {
    double trace = 0;
    std::vector<double> column(p);
    for (std::size_t k = 0; k < p; ++k) {
        std::ranges::fill(column, 0.0);
        column[k] = 1;
        trace += solve(factor, k, column);
        run.check_stop();
    }
    return trace;
}

/// Largest f(x)^T M^-1 f(x) over `count` points x; place(i, x) writes point i to x.
template <class Place>
double largest_variance(std::span<const double> factor, std::size_t dimension, Model kind,
                        std::uint64_t count, const Place& place, const RunContext& run) {
    constexpr std::uint64_t size = 64;
    std::vector<double> largest(block_count(count, size));
    for_each_block(run, count, size, [&](const Block& block) {
        std::vector<double> x(dimension);
        std::vector<double> f;
        for (std::uint64_t i = block.first; i < block.last; ++i) {
            place(i, x);
            terms_of(x, kind, f);
            largest[block.index] = std::max(largest[block.index], solve(factor, 0, f));
        }
    });
    return std::ranges::max(largest);
}

/// Adds the efficiencies. The maximum in G is over corners of the cube or, for quadratic models,
/// the grid of -1, 0, 1; over the design's own points if these are too many.
void add_efficiencies(Report& report, const PointSet& cube, Model kind, const RunContext& run) {
    constexpr double most_steps = 2e9;
    const auto rows = coded(cube);
    const std::size_t d = cube.dimension();
    const std::size_t p = model_terms(kind, d);
    const std::uint64_t levels = kind == Model::quadratic ? 3 : 2;
    const std::uint64_t grid = saturating_power(levels, d);
    const bool all = static_cast<double>(grid) * static_cast<double>(p * p) < most_steps;
    const auto add = [&](double of_d, double of_a, double of_g) {
        report.add("d_efficiency", of_d);
        report.add("a_efficiency", of_a);
        report.add("g_efficiency", of_g);
        report.add("g_places", !all ? "points" : levels == 2 ? "corners" : "grid");
    };
    const Cholesky root = cholesky(information(rows, d, kind, run), p);
    if (root.failed != 0) return add(0, 0, 0);
    double log_determinant = 0;
    for (std::size_t i = 0; i < p; ++i) log_determinant += 2 * logarithm(root.factor[i * p + i]);
    const auto place = [&](std::uint64_t i, std::vector<double>& x) {
        if (!all) std::ranges::copy(std::span(rows).subspan(i * d, d), x.begin());
        for (std::size_t k = 0; all && k < d; ++k, i /= levels)
            x[k] = 2 * static_cast<double>(i % levels) / static_cast<double>(levels - 1) - 1;
    };
    const double variance =
        largest_variance(root.factor, d, kind, all ? grid : cube.count(), place, run);
    const auto n = static_cast<double>(cube.count());
    const auto terms = static_cast<double>(p);
    add(exponential(log_determinant / terms) / n,
        terms / (n * trace_of_inverse(root.factor, p, run)), terms / (n * variance));
}

Report criteria_of(const PointSet& cube, const Values& options, const RunContext& run) {
    Report report;
    const double minimum = add_separation(report, cube, run.stage(0, 0.1));
    if (cube.count() <= most_paired)
        add_pair_criteria(report, cube, options[exponent], minimum, run.stage(0.1, 0.7));
    add_correlations(report, cube);
    add_at(report, "line_minimum", "line_axis", closest_on_axis(cube));
    if (cube.dimension() >= 2 && cube.dimension() <= most_planes)
        if (const AtAxes plane = closest_on_plane(cube, run); std::isfinite(plane.value))
            add_at(report, "plane_minimum", "plane_axes", plane);
    if (const Model fitted = model_of(options); fitted != Model::none)
        add_efficiencies(report, cube, fitted, run.stage(0.7, 1));
    return report;
}

/// Means of the criteria over random Latin hypercubes.
Report of_hypercubes(const PointSet& cube, const Values& options, const RunContext& run) {
    const auto sets = static_cast<std::uint64_t>(options[compare]);
    Report mean;
    for (std::uint64_t s = 0; s < sets; ++s) {
        const auto part = [&](double share) {
            return (static_cast<double>(s) + share) / static_cast<double>(sets);
        };
        const RunContext stage = run.stage(part(0), part(1));
        const PointSet other =
            stipple::generate("latin-hypercube",
                              {.count = cube.count(), .dimension = cube.dimension(), .seed = s + 1},
                              {}, silent(stage));
        const Report criteria = criteria_of(other, options, stage);
        for (const auto& entry : criteria.entries())
            if (const double* value = std::get_if<double>(&entry.value)) {
                const double before = mean.find(entry.name) ? mean.number(entry.name) : 0;
                mean.add(entry.name, before + *value / static_cast<double>(sets));
            }
    }
    return mean;
}

PointSet in_cube(const PointSet& points) {
    PointSet cube(points.count(), points.dimension());
    for (std::size_t i = 0; i < points.count(); ++i) points.domain->to_cube(points[i], cube[i]);
    cube.domain = unit_cube(points.dimension());
    return cube;
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    static_cast<void>(distances_in_box(points, "euclidean", "design"));
    const std::size_t n = points.count();
    if (n == 1) fail(ErrorKind::input, "design needs at least two points; this is one");
    const std::size_t terms = model_terms(model_of(options), points.dimension());
    if (n < terms)
        fail_with_hint(ErrorKind::input, "--model none omits the efficiencies",
                       "{} points are fewer than the {} terms of --model {}", n, terms,
                       options[model]);
    run.need_memory(16.0 * static_cast<double>(terms * terms) +
                        40.0 * static_cast<double>(n * points.dimension()),
                    "the criteria of design");
    const PointSet cube = in_cube(points);
    const double share = 1 / (1 + static_cast<double>(options[compare]));
    Report report = criteria_of(cube, options, run.stage(0, share));
    if (terms > 0) report.add("terms", terms);
    if (options[compare] > 0)
        report.add("latin_hypercube", of_hypercubes(cube, options, run.stage(share, 1)));
    run.tick(1, 1);
    return report;
}

}  // namespace

Analyzer unit() {
    return {
        .name = "design",
        .summary = "Criteria of designs of experiments: distances, correlations, efficiencies",
        .source =
            "Morris, Mitchell 1995, doi:10.1016/0378-3758(94)00035-T; Joseph, Gul, Ba 2015, "
            "doi:10.1093/biomet/asv002; Atkinson, Donev, Tobias 2007",
        .related = {"doe", "experiment", "phi-p", "maximin", "maxpro", "audze-eglais", "optimality",
                    "d-optimal", "efficiency", "correlation", "projection",
                    "design-of-experiments"},
        .traits = {.max_dimension = 1000, .unit_cube = false, .boxed = true},
        .options = Schema(exponent, model, compare),
        .results =
            {{"minimum", "smallest distance between two points (maximin: larger is better)"},
             {"minimum_squared", "its square"},
             {"variation",
              "standard deviation / mean of the distances to the nearest neighbours; 0 for a grid"},
             {"phi_p", "(sum over pairs of distance^-p)^(1/p), smaller is better"},
             {"audze_eglais", "sum over pairs of 1 / distance^2, smaller is better"},
             {"maxpro",
              "maximum projection criterion, smaller is better; absent if two points share a "
              "coordinate"},
             {"largest_correlation", "largest absolute correlation of two coordinates"},
             {"largest_correlation_axes", "axes of these coordinates, from 1"},
             {"rms_correlation", "root mean square of all correlations"},
             {"line_minimum", "smallest distance between two points along one axis, over all axes"},
             {"line_axis", "that axis, from 1"},
             {"plane_minimum",
              "smallest distance between two points projected to two axes, over all pairs of axes"},
             {"plane_axes", "these axes, from 1"},
             {"d_efficiency", "det(M)^(1/p) / n for p terms; 1 is orthogonal, 0 singular"},
             {"a_efficiency", "p / (n trace(M^-1))"},
             {"g_efficiency", "p / (n times the largest variance of prediction)"},
             {"g_places",
              "points at which that variance is maximised: corners: of the cube, where the maximum "
              "is; grid: of -1, 0 and 1; points: those of the design, if the others would be too "
              "many",
              true, "corners|grid|points"},
             {"terms", "number p of terms of the model"},
             {"latin_hypercube.CRITERION", "mean of that criterion over random Latin hypercubes"}},
        .analyze = analyze,
        .cost = [](double n,
                   double d) { return 11 * (n < 16384 ? 2e-8 * n * n : 1e-6 * n) * (1 + d / 8); },
        .refine = [](Report& mean, std::size_t sets, const Values&) {  // axes cannot be averaged
            if (sets > 1) drop(mean, {"largest_correlation_axes", "line_axis", "plane_axes"});
        }};
}

}  // namespace stipple::analyzers::design
