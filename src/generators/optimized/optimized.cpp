// SPDX-License-Identifier: MIT
//
// Sets of a given number of points, made as even as possible by a search for one measure:
//
//     star, extreme, periodic   the largest local discrepancy of a kind of boxes
//     dispersion                the volume of the largest empty box
//     l2-KIND                   an L2 discrepancy of math/l2/kinds.hpp
//
// The method depends on the measure and the numbers of axes d and points n:
//
//     d = 1        (i + 1/2) / n, or for the dispersion (i + 1) / (n + 1): optimal
//     n = 1        boxes at the origin: (x, ..., x) with x + x^d = 1; other boxes: the centre.
//                  Optimal
//     star, d = 2  a search over the orders of the points by x and by y, each solved exactly
//                  (planar_order.hpp, order_search.hpp); without --from, --initial and --weights
//     others       descents along the gradient from many sets (coordinate_search.hpp). The value
//                  covers all boxes for the star discrepancy of two or three axes, boxes near the
//                  worst for other measures of boxes, and all pairs of points for L2 kinds
//     --lattice    all lattices of Korobov's form (coordinate_search.hpp)
//
// Shape   d <= 6 for boxes, up to 100 for L2 kinds. The search over orders needs 8 n^2 bytes per
//         thread; the search over coordinates takes up to 2^16 points.
// Cost    a budget of steps, independent of the clock: some 20 s of one core by default, more if a
//         single step of the search takes longer.
// Promise the value in the provenance is exact and equals that of the analyzers; it is given as
//         bounds if finding the worst box takes too long (many points in many dimensions). In the
//         plane the star discrepancy is the least for the points' order, to a relative 1e-12; up to
//         20 points the default effort finds the proven optimum. The points depend only on the
//         request and the options, not on the number of threads.
// Beware  prefixes of the points are not good sets, except with --order; projections are as even as
//         the measure requires.
// Source  F. Clement, C. Doerr, K. Klamroth, L. Paquete, arXiv:2311.17463 (optimal sets);
//         T. K. Rusch, N. Kirk, M. M. Bronstein, C. Lemieux, D. Rus, arXiv:2405.15059.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/generator.hpp"
#include "generators/given_points.hpp"
#include "generators/optimized/coordinate_search.hpp"
#include "generators/optimized/order_search.hpp"
#include "io/files.hpp"
#include "math/l2/squares.hpp"

namespace stipple::generators::optimized {
namespace {

using namespace stipple::optimized;

constexpr Param<Choice> objective{
    .name = "objective",
    .fallback = "star",
    .choices =
        "star|extreme|periodic|dispersion|l2-star|l2-centered|l2-wraparound|l2-mixture|"
        "l2-average",
    .help =
        "Measure to minimize: the largest discrepancy of boxes at the origin (star), anywhere "
        "(extreme) or on the torus (periodic), the largest empty box (dispersion), or an L2 "
        "discrepancy"};
constexpr Param<double> effort{.name = "effort",
                               .fallback = 1,
                               .low = 1e-6,
                               .high = 1e6,
                               .help =
                                   "Search steps as a multiple of the default: some 20 seconds of "
                                   "one core, less for few points"};
constexpr Param<Text> initial{
    {.name = "initial",
     .unit = "generator",
     .help = "Generator to start from instead of lattices and nets, such as sobol:scramble=owen"}};
constexpr Param<Path> from{{.name = "from",
                            .unit = "file",
                            .help = "Start from the points of a file; random ones are added if "
                                    "they are fewer than the count"}};
constexpr Param<std::int64_t> keep{.name = "keep",
                                   .low = 1,
                                   .optional = true,
                                   .unit = "points",
                                   .help = "Number of first points of the file to keep unchanged"};
constexpr Param<Numbers> axis_weights{
    {.name = "weights",
     .help = "Weight of each coordinate, in [1e-30, 1000]. star: a box has the product of the "
             "weights of the coordinates that it bounds; L2 kinds: a projection has the product of "
             "its coordinates' weights"}};
constexpr Param<bool> lattice{
    .name = "lattice",
    .help =
        "Find the best lattice i (1, g, g^2, ...) / n modulo 1 over all g, for the objective "
        "periodic or l2-wraparound; the seed is unused"};
constexpr Param<bool> order{.name = "order",
                            .help = "Order the points so that their prefixes are even, too"};

bool is_l2(const Values& options) { return options[objective].starts_with("l2-"); }

l2::Kind kind_of(const std::string& name) { return l2::parse_kinds(name).front(); }

discrepancy::Family family_of(const Values& options) {
    const std::string what = options[objective];
    if (what == "star") return discrepancy::Family::anchored;
    return what == "periodic" ? discrepancy::Family::torus : discrepancy::Family::cube;
}

/// L2 kind whose discrepancy --order makes small for every prefix.
l2::Kind order_kind(const Values& options) {
    const std::string what = options[objective];
    if (is_l2(options)) return kind_of(what.substr(3));
    return kind_of(what == "dispersion" ? "periodic" : what);
}

l2::AxisWeights weights_of(const Values& options) {
    return options.given(axis_weights) ? options[axis_weights] : l2::AxisWeights();
}

std::size_t kept(const Values& options) {
    return options.given(keep) ? static_cast<std::size_t>(options[keep]) : 0;
}

PointSet given_points(const Values& options, const RunContext& run) {
    PointSet points = io::read_given(from.name, options[from], {}, run);
    require_in_cube(points, options[from]);
    return points;
}

/// Request with count and dimension taken from the file's points. @throws Error(usage)
Request fitted(Request request, const Values& options) {
    if (options.given(initial))
        fail(ErrorKind::usage, "--initial contradicts --from; give one of them");
    const PointSet points = given_points(options, {});
    require_dimension(request, points.dimension(), options[from]);
    request.dimension = points.dimension();
    if (!request.count) request.count = points.count();
    if (*request.count < points.count())
        fail(ErrorKind::usage, "--count: {} is less than the {} points of {}", *request.count,
             points.count(), options[from]);
    if (options.given(keep) && options[keep] > static_cast<std::int64_t>(points.count()))
        fail(ErrorKind::usage, "--keep: {} is more than the {} points of {}", options[keep],
             points.count(), options[from]);
    return request;
}

void check_weights(const Values& options, std::size_t dimension) {
    if (!options.given(axis_weights)) return;
    const std::vector<double> weights = options[axis_weights];
    if (!is_l2(options) && options[objective] != "star")
        fail(ErrorKind::usage, "--weights: objective {} takes no weights; star and the L2 kinds do",
             options[objective]);
    if (weights.size() != dimension)
        fail(ErrorKind::usage, "--weights: {} numbers for {} coordinates; give one for each",
             weights.size(), dimension);
    for (const double weight : weights)
        if (!(weight >= 1e-30 && weight <= 1000))
            fail(ErrorKind::usage, "--weights: {} is outside [1e-30, 1000]", format_number(weight));
}

/// Rejects --lattice for objectives that depend on the lattice's shift, or with initial points.
void check_lattice(const Values& options) {
    if (!options[lattice]) return;
    const std::string what = options[objective];
    if (what != "periodic" && what != "l2-wraparound")
        fail(ErrorKind::usage,
             "--lattice: objective {} depends on a shift of the lattice; periodic and "
             "l2-wraparound do not",
             what);
    if (options.given(from) || options.given(initial))
        fail(ErrorKind::usage, "--lattice tries all lattices; it takes no points to start from");
}

Plan plan(const Request& request, const Values& options) {
    constexpr std::size_t most_box_axes = 6;
    if (options.given(keep) && !options.given(from))
        fail(ErrorKind::usage, "--keep applies to the points of a file; give --from too");
    const Plan plan = default_plan(options.given(from) ? fitted(request, options) : request, 64);
    if (!is_l2(options) && plan.dimension > most_box_axes)
        fail(ErrorKind::usage,
             "optimized: objective {} takes 1 to {} dimensions; L2 kinds take more",
             options[objective], most_box_axes);
    check_weights(options, plan.dimension);
    check_lattice(options);
    return plan;
}

/// Whether the best set is known in closed form.
bool is_known(const Plan& plan, const Values& options) {
    if (options.given(keep)) return false;
    return plan.dimension == 1 ||
           (plan.count == 1 && !is_l2(options) && !options.given(axis_weights));
}

/// Whether the search varies the orders of planar points (order_search.hpp) instead of coordinates.
bool by_orders(const Plan& plan, const Values& options) {
    return options[objective] == "star" && plan.dimension == 2 && !options.given(from) &&
           !options.given(initial) && !options.given(axis_weights);
}

std::unique_ptr<Objective> make_objective(const Plan& plan, const Values& options) {
    const std::string what = options[objective];
    const std::vector<double> weights = weights_of(options);
    const std::size_t n = plan.count;
    const std::size_t d = plan.dimension;
    if (is_l2(options)) return l2_objective(kind_of(what.substr(3)), weights, n, d);
    if (what == "star" && (d == 2 || d == 3)) return anchored_objective(weights, n, d);
    return box_objective(family_of(options), what == "dispersion", weights, n, d);
}

/// Function that returns the rows of the i-th start.
using Start = std::function<std::vector<double>(std::uint64_t, SplitMix64&)>;

/// Start with the rows of a file, followed by random rows.
Start start_from(const PointSet& points, const Plan& plan, std::size_t fixed) {
    std::vector<double> given(points.flat().begin(), points.flat().end());
    for (std::size_t i = fixed * plan.dimension; i < given.size(); ++i)
        given[i] = std::min(given[i], one_minus_ulp);
    return [given = std::move(given), size = plan.count * plan.dimension](std::uint64_t,
                                                                          SplitMix64& draws) {
        std::vector<double> rows = given;
        while (rows.size() < size) rows.push_back(to_unit(draws.next()));
        return rows;
    };
}

Start start_without_file(const Plan& plan, const Values& options, const RunContext& run) {
    const std::size_t n = plan.count;
    const std::size_t d = plan.dimension;
    if (options.given(initial))
        return [=, spec = options[initial], seed = plan.seed, quiet = silent(run)](std::uint64_t i,
                                                                                   SplitMix64&) {
            const PointSet points =
                generate(spec, {.count = n, .dimension = d, .seed = seed + i}, {}, quiet);
            return std::vector<double>(points.flat().begin(), points.flat().end());
        };
    // Alternates between lattices and other sets, because the count decides which of them lead to
    // lower values. For the periodic discrepancy in the plane, no start is a lattice.
    const bool lattices = d > 2 || (d == 2 && options[objective] != "periodic");
    return [=, quiet = silent(run)](std::uint64_t i, SplitMix64& draws) {
        if (lattices && i % 2 == 0) return lattice_rows(n, d, draws, quiet);
        return d > 2 ? net_rows(n, d, draws) : golden_rows(n, d, draws);
    };
}

/// Approximate steps (see Objective::steps) of one value of an L2 objective.
double l2_steps(const Plan& plan) {
    const auto n = static_cast<double>(plan.count);
    return n * n * static_cast<double>(plan.dimension) / 3;
}

/// Default budget in steps, at most those of 10^6 objective values per point.
double usual_budget(const Plan& plan, const Values& options) {
    const double most =
        1e6 * static_cast<double>(plan.count) * make_objective(plan, options)->steps();
    if (is_l2(options)) return std::min(most, std::max(5e9, 800.0 * l2_steps(plan)));
    return std::min(most, options[objective] == "star" && plan.dimension > 2 ? 2e10 : 8e9);
}

CoordinateSearch search_for(const Plan& plan, const Values& options, const RunContext& run) {
    const double unit = 1 / static_cast<double>(plan.count);
    const bool l2 = is_l2(options);
    CoordinateSearch search{
        .count = plan.count,
        .dimension = plan.dimension,
        .kept = kept(options),
        .objective = [&plan, &options] { return make_objective(plan, options); },
        .start = {},
        .from_start = {150, 0.5 * unit, 0.02 * unit, 50, 1000},
        .from_hop = {50, 0.25 * unit, 0.02 * unit, 100, 1000},
        .hop = 1.5 * unit,
        .seed = plan.seed,
        .budget = options[effort] * usual_budget(plan, options)};
    if (l2) {
        search.from_start.first_rate = 2 * unit;
        search.from_hop.first_rate = 0.5 * unit;
        search.hop = 0.7 * unit;
        search.sets_a_start = 1;
    }
    if (!options.given(from)) {
        search.start = start_without_file(plan, options, run);
        return search;
    }
    const PointSet points = given_points(options, run);
    search.start = start_from(points, plan, kept(options));
    search.one_start = points.count() == plan.count;
    return search;
}

/// Projection of points on a set of axes, given as bits.
PointSet projection(const PointSet& points, std::uint64_t axes) {
    std::vector<double> rows;
    for (std::size_t i = 0; i < points.count(); ++i)
        for (std::size_t j = 0; j < points.dimension(); ++j)
            if ((axes >> j & 1) != 0) rows.push_back(points[i][j]);
    return {std::move(rows), static_cast<std::size_t>(std::popcount(axes))};
}

/// Bounds of the weighted star discrepancy: the maximum, over sets of axes, of the product of their
/// weights and the star discrepancy of the projection on them. Removing axes never increases the
/// discrepancy, so some projections need no search.
Bounds weighted_star(const PointSet& points, const std::vector<double>& weights, std::uint64_t work,
                     const RunContext& run) {
    const std::size_t d = weights.size();
    const std::uint64_t all = (std::uint64_t{1} << d) - 1;
    const auto product = [&](std::uint64_t axes) {
        double times = 1;
        for (std::size_t j = 0; j < d; ++j)
            if ((axes >> j & 1) != 0) times *= weights[j];
        return times;
    };
    std::vector<double> upper(all + 1, 1);  // upper bounds, indexed by set of axes
    Bounds worst{0, 0};
    for (std::uint64_t axes = all; axes > 0; --axes) {
        for (std::size_t j = 0; j < d; ++j)
            upper[axes] = std::min(upper[axes], upper[axes | std::uint64_t{1} << j]);
        if (product(axes) * upper[axes] <= worst.lower) continue;
        const Bounds of = bounds_of(axes == all ? points : projection(points, axes),
                                    discrepancy::Family::anchored, false, run, work);
        upper[axes] = of.upper;
        worst.lower = std::max(worst.lower, product(axes) * of.lower);
        worst.upper = std::max(worst.upper, product(axes) * of.upper);
    }
    return worst;
}

/// Bounds of the objective for the points, computed as by the analyzers.
/// @param work comparisons that a search for the worst box may take
Bounds judged(const PointSet& points, const Values& options, std::uint64_t work,
              const RunContext& run) {
    const std::string what = options[objective];
    const std::size_t d = points.dimension();
    const std::vector<double> weights = weights_of(options);
    if (is_l2(options)) {
        const l2::Kind kind = kind_of(what.substr(3));
        const double square = d <= 2
                                  ? l2::plane_square(l2::plane_sums(points, run), d, kind, weights)
                                  : l2::pair_square(points, kind, weights, run).squared;
        const double value = std::sqrt(std::max(square, 0.0));
        return {value, value};
    }
    if (!weights.empty()) return weighted_star(points, weights, work, run);
    return bounds_of(points, family_of(options), what == "dispersion", run, work);
}

/// Published star discrepancy of a point set in the plane.
/// Source  [1] F. Clement, C. Doerr, K. Klamroth, L. Paquete, arXiv:2311.17463: proven optima;
///         [2] the same, arXiv:2407.11533; [3] T. K. Rusch, N. Kirk, M. M. Bronstein, C. Lemieux,
///         D. Rus, arXiv:2405.15059.
struct PublishedStar {
    std::uint64_t count;
    double value;  ///< rounded to the digits given here
    bool optimal;  ///< whether it is proven to be optimal
    std::string_view source() const {
        return optimal ? "arXiv:2311.17463" : "arXiv:2311.17463, 2405.15059, 2407.11533";
    }
};

constexpr std::array published_stars = std::to_array<PublishedStar>(
    {{1, .6180, true},      {2, .3660, true},      {3, .2847, true},      {4, .2500, true},
     {5, .2000, true},      {6, .1667, true},      {7, .1500, true},      {8, .1328, true},
     {9, .1235, true},      {10, .1111, true},     {11, .1030, true},     {12, .0952, true},
     {13, .0889, true},     {14, .0837, true},     {15, .0782, true},     {16, .0739, true},
     {20, .0604, true},     {30, .04240, false},   {40, .03313, false},   {50, .027415, false},
     {60, .022887, false},  {80, .017827, false},  {100, .014916, false}, {140, .010963, false},
     {180, .009011, false}, {200, .008109, false}, {260, .006399, false}, {300, .007407, false},
     {380, .006375, false}, {420, .005625, false}, {500, .005086, false}, {580, .003772, false},
     {660, .003600, false}, {780, .003104, false}, {900, .002957, false}, {1020, .002450, false}});

/// Published value for `count` points; nullopt if the table has none or the dimension is not 2.
std::optional<PublishedStar> published_star(std::uint64_t count, std::size_t dimension) {
    const auto* const found = std::ranges::find(published_stars, count, &PublishedStar::count);
    if (dimension != 2 || found == published_stars.end()) return {};
    return *found;
}

/// @param least whether a search for a lattice has found that no other one is better
void record(PointSet& points, const Plan& plan, const Values& options, const Bounds& value,
            bool least) {
    std::string name = options[objective];
    std::ranges::replace(name, '-', '_');
    const bool box = !is_l2(options) && options[objective] != "dispersion";
    auto& found = points.provenance.found;
    if (is_l2(options) || box) name += "_discrepancy";
    found = {{name, format_number(value.lower)}};
    if (value.upper > value.lower)
        found = {{name + "_lower", format_number(value.lower)},
                 {name + "_upper", format_number(value.upper)}};
    if (options[lattice] && least && value.upper == value.lower)
        found.emplace_back("certificate", "optimal-of-lattices");
    if (options[objective] != "star" || options.given(axis_weights)) return;
    const auto known = published_star(plan.count, plan.dimension);
    const bool proven = known && known->optimal && value.upper <= known->value + 5.1e-5;
    if (is_known(plan, options) || proven)
        found.emplace_back("certificate", "optimal");
    else if (by_orders(plan, options))
        found.emplace_back("certificate", "optimal-for-its-order");
    if (known) {
        found.emplace_back("published", format_number(known->value));
        found.emplace_back("published_in", std::string(known->source()));
    }
}

/// Optimal set in one dimension: for the dispersion if `empty`, else for the other measures.
std::vector<double> on_the_line(std::size_t n, bool empty, const RunContext& run) {
    constexpr std::size_t often = 1U << 20;
    std::vector<double> rows;
    rows.reserve(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (i % often == 0) run.check_stop();
        rows.push_back(empty ? static_cast<double>(i + 1) / static_cast<double>(n + 1)
                             : (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    }
    return rows;
}

/// Coordinate x of the best single point (x, ..., x) for boxes at the origin. The largest empty box
/// has the volume x; the closed box up to the point has the volume x^d and holds all points. Both
/// discrepancies, x and 1 - x^d, are equal if x + x^d = 1.
double coordinate_for_star(std::size_t dimension) {
    double low = 0;
    double high = 1;
    for (int step = 0; step < 60; ++step) {
        const double x = (low + high) / 2;
        double power = x;
        for (std::size_t j = 1; j < dimension; ++j) power *= x;
        (x + power < 1 ? low : high) = x;
    }
    return low;
}

std::vector<double> known_rows(const Plan& plan, const Values& options, const RunContext& run) {
    const std::string what = options[objective];
    if (plan.dimension == 1) return on_the_line(plan.count, what == "dispersion", run);
    const double x = what == "star" ? coordinate_for_star(plan.dimension) : 0.5;
    return std::vector<double>(plan.dimension, x);
}

/// Run context with only as many threads as memory allows. For the star discrepancy in two or three
/// dimensions, each set that is searched holds a plane of boxes per thread.
RunContext fitting(const Plan& plan, const Values& options, const RunContext& run) {
    constexpr std::uint64_t most = std::uint64_t{1} << 16;
    if (plan.count > most)
        fail(ErrorKind::limit, "optimized: {} points; a search over coordinates takes up to {}",
             plan.count, most);
    if (options[objective] != "star" || plan.dimension > 3) return run;
    const double plane = anchored_memory(plan.count, plan.dimension);
    run.need_memory(plane, "the search for coordinates");
    const double planes = static_cast<double>(run.memory_left()) / plane;
    RunContext fit = run;
    fit.threads = static_cast<unsigned>(std::min(plan.dimension == 3 ? std::sqrt(planes) : planes,
                                                 static_cast<double>(run.thread_count())));
    return fit;
}

/// Whether a pass over all pairs of points takes almost no time, as required after a stop.
bool has_few_pairs(const Plan& plan) {
    const auto n = static_cast<double>(plan.count);
    return n * n * static_cast<double>(plan.dimension) <= 5e7;
}

/// Whether the value of the points can be computed in almost no time.
bool is_soon_judged(const Plan& plan, const Values& options) {
    const bool swept = is_l2(options) || options[objective] == "star";
    return has_few_pairs(plan) || (plan.dimension <= 2 && swept);
}

/// Orders the points and records their value; after a stop, does only what is quick.
PointSet finished(OptimizedRows found, const Plan& plan, const Values& options,
                  const RunContext& run) {
    const RunContext last = found.stopped ? unstopped(run) : run;
    const bool ordered = options[order] && (!found.stopped || has_few_pairs(plan));
    const bool valued = !found.stopped || is_soon_judged(plan, options);
    if (found.stopped)
        run.notify(fmt::format("interrupted: these are the best points so far{}{}",
                               valued ? "" : ", without their value",
                               options[order] && !ordered ? ", not ordered" : ""));
    if (ordered)
        found.rows = in_even_order(found.rows, plan.dimension, kept(options), order_kind(options),
                                   weights_of(options), last);
    PointSet points(std::move(found.rows), plan.dimension);
    const std::uint64_t work = std::uint64_t{1} << (found.stopped ? 24U : 37U);
    if (valued) {
        const Bounds value = judged(points, options, work, last);
        // A search value is a lower bound if the worst box was not found in time.
        const bool sure = is_l2(options) || value.upper <= found.value * (1 + 1e-12);
        record(points, plan, options, value, sure && !found.stopped);
    }
    if (found.stopped) points.provenance.found.emplace_back(interrupted);
    return points;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    run.tick(0, 1);
    const auto n = static_cast<double>(plan.count);
    OptimizedRows found;
    if (is_known(plan, options)) {
        found.rows = known_rows(plan, options, run);
    } else if (by_orders(plan, options)) {
        const double budget = options[effort] * std::min(0x1p20 * n * n, 0x1p35);
        found = least_star_discrepancy(plan.count, plan.seed, budget, run);
    } else if (options[lattice]) {
        found = least_lattice(
            plan.count, plan.dimension, [&] { return make_objective(plan, options); },
            options[objective], fitting(plan, options, run));
    } else {
        found = search_coordinates(search_for(plan, options, run), options[objective],
                                   fitting(plan, options, run));
    }
    return finished(std::move(found), plan, options, run);
}

std::vector<std::string> notes(const Request& /*request*/, const Plan& plan,
                               const Values& options) {
    if (!is_known(plan, options)) return {};
    return {
        "optimized: for one point or one dimension the best set is known; the seed and --effort "
        "have no effect"};
}

double seconds(double n, double d) { return d < 2 ? 1e-8 * n : 20 + 1e-7 * n * n; }

}  // namespace

Generator unit() {
    return {.name = "optimized",
            .summary = "Points whose discrepancy or dispersion is minimized by a search",
            .source = "Clement, Doerr, Klamroth, Paquete 2023, arXiv:2311.17463",
            .related = {"message-passing", "mpmc", "optimal", "low-discrepancy-set", "openevolve",
                        "minimal", "design-augmentation"},
            .traits = {.max_dimension = 100, .sequence = false, .prefix = false},
            .options = Schema(objective, effort, initial, from, keep, axis_weights, lattice, order),
            .stream_version = 3,
            .plan = plan,
            .set = make,
            .notes = notes,
            .cost = seconds};
}

}  // namespace stipple::generators::optimized
