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
//     efficiency      D, A and G for a polynomial model (model_efficiency.hpp), each coordinate
//                     scaled so that its lowest and highest values in the design are -1 and 1
//
// and, for comparison, the means of all criteria over random Latin hypercubes with the same number
// of points and the seeds 1, 2, ....
//
// Shape   n x d, n >= 2, d <= 1000. Sums over pairs for up to 16384 points; planes for d <= 32.
// Units   lengths of the unit cube.
// Cost    O(n^2 d) for one set, and as much for each Latin hypercube; 0.2 s for 10 of them at n =
//         1000, d = 5 on one core.
// Promise infinite values (points that coincide; maxpro where two share a coordinate) are left out.
//         The same for any number of threads.
// Source  M. D. Morris, T. J. Mitchell, J. Stat. Plan. Inference 43 (1995) 381-402,
//         doi:10.1016/0378-3758(94)00035-T; P. Audze, V. Eglais, Problems of Dynamics and Strengths
//         35 (1977) 104-107; V. R. Joseph, E. Gul, S. Ba, Biometrika 102 (2015) 371-380,
//         doi:10.1093/biomet/asv002; M. Gunzburger, J. Burkardt, "Uniformity measures for point
//         samples in hypercubes" (2004).

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "experiments/quality/model_efficiency.hpp"
#include "math/functions/logarithm.hpp"
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

/// Projection of points to some axes.
PointSet projected(const PointSet& points, const std::vector<std::size_t>& axes) {
    PointSet image(points.count(), axes.size());
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t k = 0; k < axes.size(); ++k) image[i][k] = points[i][axes[k]];
    return image;
}

/// A smallest or largest value, and the axes (from 0) at which it occurs.
struct AtAxes {
    double value = 0;
    std::vector<std::size_t> axes = {};
};

/// Sums over pairs of points.
struct PairSums {
    double powers = 0;       ///< terms (minimum / distance)^p
    double reciprocals = 0;  ///< terms 1 / distance^2
    /// Terms 1 / prod (4 difference)^2; the factor 4 keeps the product in range.
    double products = 0;

    PairSums& operator+=(const PairSums& other) {
        powers += other.powers;
        reciprocals += other.reciprocals;
        products += other.products;
        return *this;
    }
};

/// Smallest distance of two points, and the standard deviation divided by the mean of the distances
/// to the nearest neighbours.
struct Separation {
    double minimum = 0;
    double variation = 0;
};

Separation separation_of(const PointSet& points, const RunContext& run) {
    const auto neighbors = nearest_neighbors(points, straight_in_cube(points.dimension()), run);
    const auto n = static_cast<double>(neighbors.size());
    double mean = 0;
    for (const Neighbor& near : neighbors) mean += std::sqrt(near.squared) / n;
    double squares = 0;
    for (const Neighbor& near : neighbors) {
        const double deviation = std::sqrt(near.squared) - mean;
        squares += deviation * deviation / n;
    }
    return {std::sqrt(closest_pair(neighbors).second.squared),
            mean > 0 ? std::sqrt(squares) / mean : 0};
}

/// Criteria that are sums over all pairs of points.
struct PairCriteria {
    double phi_p = 0;
    double audze_eglais = 0;
    double maxpro = 0;
};

/// @param minimum the smallest distance; criteria are infinite if it is 0 or points share
/// coordinates
PairCriteria pair_criteria(const PointSet& points, double p, double minimum,
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
    const auto pairs = 0.5 * static_cast<double>(n) * static_cast<double>(n - 1);
    return {minimum > 0 ? real_power(all.powers, 1 / p) / minimum : infinite,
            minimum > 0 ? all.reciprocals : infinite,
            std::isfinite(all.products)
                ? 16 * real_power(all.products / pairs, 1 / static_cast<double>(d))
                : infinite};
}

/// Largest absolute correlation of two coordinates, and root mean square of all correlations.
/// Constant coordinates are left out; nullopt if fewer than two coordinates remain.
struct Correlation {
    AtAxes largest;
    double rms = 0;
};

std::optional<Correlation> correlation_of(const PointSet& points) {
    const std::size_t n = points.count();
    const std::size_t d = points.dimension();
    std::vector<std::size_t> axes;
    std::vector<std::vector<double>> columns;  // centred and of length 1
    for (std::size_t k = 0; k < d; ++k) {
        std::vector<double> column(n);
        double mean = 0;
        for (std::size_t i = 0; i < n; ++i)
            mean += (column[i] = points[i][k]) / static_cast<double>(n);
        const auto [low, high] = std::ranges::minmax(column);
        if (low == high) continue;
        double squares = 0;
        for (double& c : column) squares += (c - mean) * (c - mean);
        for (double& c : column) c = (c - mean) / std::sqrt(squares);
        axes.push_back(k);
        columns.push_back(std::move(column));
    }
    if (axes.size() < 2) return std::nullopt;
    Correlation found{.largest = {-1, {}}};
    double squares = 0;
    for (std::size_t a = 1; a < axes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            double sum = 0;
            for (std::size_t i = 0; i < n; ++i) sum += columns[a][i] * columns[b][i];
            squares += sum * sum;
            if (std::abs(sum) > found.largest.value)
                found.largest = {std::abs(sum), {axes[b], axes[a]}};
        }
    found.rms = std::sqrt(squares / (0.5 * static_cast<double>(axes.size() * (axes.size() - 1))));
    return found;
}

/// Smallest distance of two points in any projection to one axis.
AtAxes closest_on_axis(const PointSet& points) {
    AtAxes closest{infinite, {}};
    std::vector<double> column(points.count());
    for (std::size_t k = 0; k < points.dimension(); ++k) {
        for (std::size_t i = 0; i < column.size(); ++i) column[i] = points[i][k];
        std::ranges::sort(column);
        for (std::size_t i = 1; i < column.size(); ++i)
            if (column[i] - column[i - 1] < closest.value)
                closest = {column[i] - column[i - 1], {k}};
    }
    return closest;
}

/// Smallest distance of two points in any projection to two axes, in O(n log n) for each.
AtAxes closest_on_plane(const PointSet& points, const RunContext& run) {
    AtAxes closest{infinite, {}};
    for (std::size_t a = 1; a < points.dimension(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
            run.check_stop();
            const auto neighbors =
                nearest_neighbors(projected(points, {b, a}), straight_in_cube(2), silent(run));
            const double distance = std::sqrt(closest_pair(neighbors).second.squared);
            if (distance < closest.value) closest = {distance, {b, a}};
        }
    return closest;
}

/// Adds a criterion unless it is infinite, which happens if two points share a coordinate.
void add_finite(Report& report, const char* name, double value) {
    if (std::isfinite(value)) report.add(name, value);
}

/// Axis numbers from 1, as shown to users.
Report::Integers from_one(const std::vector<std::size_t>& axes) {
    Report::Integers numbers;
    for (const std::size_t k : axes) numbers.push_back(static_cast<std::int64_t>(k + 1));
    return numbers;
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

Model model_of(const Values& options) {
    const std::string name = options[model];
    return name == "linear"        ? Model::linear
           : name == "interaction" ? Model::interaction
                                   : Model::quadratic;
}

void add_efficiency(Report& report, const PointSet& cube, const Values& options,
                    const RunContext& run) {
    if (options[model] == "none") return;
    const Efficiency found =
        model_efficiency(coded(cube), cube.dimension(), model_of(options), run);
    report.add("d_efficiency", found.d);
    report.add("a_efficiency", found.a);
    report.add("g_efficiency", found.g);
    report.add("g_places", found.places);
}

Report criteria_of(const PointSet& cube, const Values& options, const RunContext& run) {
    Report report;
    const Separation separation = separation_of(cube, run.stage(0, 0.1));
    report.add("minimum", separation.minimum);
    report.add("minimum_squared", separation.minimum * separation.minimum);
    report.add("variation", separation.variation);
    if (cube.count() <= most_paired) {
        const PairCriteria pairs =
            pair_criteria(cube, options[exponent], separation.minimum, run.stage(0.1, 0.7));
        add_finite(report, "phi_p", pairs.phi_p);
        add_finite(report, "audze_eglais", pairs.audze_eglais);
        add_finite(report, "maxpro", pairs.maxpro);
    }
    if (const auto correlation = correlation_of(cube)) {
        report.add("largest_correlation", correlation->largest.value);
        report.add("largest_correlation_axes", from_one(correlation->largest.axes));
        report.add("rms_correlation", correlation->rms);
    }
    const AtAxes line = closest_on_axis(cube);
    report.add("line_minimum", line.value);
    report.add("line_axis", from_one(line.axes));
    if (cube.dimension() >= 2 && cube.dimension() <= most_planes) {
        const AtAxes plane = closest_on_plane(cube, run);
        report.add("plane_minimum", plane.value);
        report.add("plane_axes", from_one(plane.axes));
    }
    add_efficiency(report, cube, options, run.stage(0.7, 1));
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
    const bool modelled = options[model] != "none";
    const std::size_t terms = modelled ? model_terms(model_of(options), points.dimension()) : 0;
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
    if (modelled) report.add("terms", terms);
    if (options[compare] > 0)
        report.add("latin_hypercube", of_hypercubes(cube, options, run.stage(share, 1)));
    run.tick(1, 1);
    return report;
}

/// Axes cannot be averaged.
void refine(Report& mean, std::size_t sets, const Values&) {
    if (sets > 1) drop(mean, {"largest_correlation_axes", "line_axis", "plane_axes"});
}

double seconds(double n, double d) {
    return 11 * (n < 16384 ? 2e-8 * n * n : 1e-6 * n) * (1 + d / 8);
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
        .cost = seconds,
        .refine = refine};
}

}  // namespace stipple::analyzers::design
