// SPDX-License-Identifier: MIT
//
// Poisson-disk set: points thrown at random, none nearer than a radius to any other, until no
// further point fits (generators/poisson_disk/maximal_disks.hpp).
//
// --radius R     as many points as fit.
// --n-approx N   about N points: as many as fit with the radius that gives N on average.
// --count N      exactly N points: a search finds a radius with which N points fit. The same darts
//                mostly leave fewer points for a larger radius, and nearly the same points for a
//                similar one, so that a few tries, each as long as a run with --radius, find
//                exactly N. The radius in the provenance is the minimum distance of the points, and
//                they are maximal for it, too. If the tries skip N, other darts are used. If eight
//                sets of darts fail, which may happen with a few points only, the surplus of the
//                best set is removed: then the set is not maximal, as a note reports.
//
// In 2-D radii may vary (generators/poisson_disk/varying/varied_disks.hpp). Two points x and y keep
// the distance min(r(x), r(y)), and every position x at which points are allowed has a point y that
// is nearer than that:
//
// --density     r(x) = radius * sqrt(largest density / density(x)), no points where it is 0.
// --radius-map  r(x) as given; scaled to a minimum radius with --radius, --count and --n-approx.
// --mask        points only where it is not 0.
//
// Shape   d = 2 ... 6; distances are those in the box of --bounds, across its faces (torus) or
//         bounded.
// Cost    see maximal_disks.hpp; --count takes about ten runs.
// Promise sum_k d_k^2 >= radius^2 for every pair, in float64, from the coordinates as stored;
//         d_k = |x_k - y_k|, on the torus min(d_k, side_k - d_k). Every position in the box
//         is nearer than the radius to a point, unless a note reports that points were removed.
//         The provenance has the radius.
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927 (the process).

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/box_space.hpp"
#include "generators/density_options.hpp"
#include "generators/poisson_disk/maximal_disks.hpp"
#include "generators/poisson_disk/radius_search.hpp"
#include "generators/poisson_disk/varying/radius_field.hpp"
#include "generators/poisson_disk/varying/varied_disks.hpp"
#include "generators/spread_order.hpp"
#include "math/combinatorics/draws.hpp"
#include "math/combinatorics/permutation.hpp"
#include "math/neighbors/kd_tree.hpp"

namespace stipple::generators::poisson_disk {
namespace {

using namespace stipple::poisson_disk;

constexpr Param<double> radius{.name = "radius",
                               .low = 0,
                               .low_open = true,
                               .optional = true,
                               .unit = "length",
                               .help =
                                   "Minimum distance between points; makes as many points as fit. "
                                   "Without it, a radius is searched that gives --count points"};
constexpr Param<std::int64_t> about{
    .name = "n-approx",
    .low = 1,
    .high = std::int64_t{1} << 53,
    .optional = true,
    .unit = "points",
    .help =
        "Approximate number of points, instead of --count; made in one pass. On the torus mostly "
        "within 2 %, from 1000 points on; bounded boxes get fewer, varying radii up to 70 % more"};
constexpr Param<Path> density{
    {.name = "density",
     .help = "Picture (PNG, PFM) or array (NPY, row 0 at y = 0); points per area follow its "
             "values, with none where it is 0. --radius is the radius at the largest value; two "
             "points keep the smaller of their radii. 2-D only, like the next three options"}};
constexpr Param<Path> radius_map{
    {.name = "radius-map",
     .help = "Array (NPY, row 0 at y = 0) of radii; two points keep the smaller of theirs. Scaled "
             "so that the smallest is --radius, or to fit --count or --n-approx"}};
constexpr Param<Path> mask{
    {.name = "mask",
     .help =
         "Picture (PNG) or array (NPY, row 0 at y = 0); points are only placed where it is not 0"}};
constexpr Param<Choice> order{
    .name = "order",
    .fallback = "random",
    .choices = "random|progressive",
    .help = "Order of the points; progressive: for every n, the first n points are well spread"};

/// Whether radii vary, or points are not allowed everywhere.
bool is_varied(const Values& options) {
    return options.given(density) || options.given(radius_map) || options.given(mask);
}

void check_varied(const Values& options, std::size_t dimension) {
    check_invert(options);
    if (options.given(density) && options.given(radius_map))
        fail(ErrorKind::usage, "--radius-map contradicts --density; give one of them");
    if (is_varied(options) && dimension != 2)
        fail(ErrorKind::usage, "--dimension: {} is not 2, the dimension of a --{}", dimension,
             options.given(density)      ? "density"
             : options.given(radius_map) ? "radius-map"
                                         : "mask");
}

Plan plan(const Request& request, const Values& options) {
    Plan plan = plan_in_box(request, options);
    check_varied(options, plan.dimension);
    if (options.given(radius) && options.given(about))
        fail(ErrorKind::usage, "--radius {} contradicts --n-approx {}; give one of them",
             format_number(options[radius]), options[about]);
    if (!options.given(radius) && !options.given(about)) {
        if (options.given(radius_map) && !request.count) plan.count = 0;  // 0: the map decides
        return plan;
    }
    if (request.count)
        fail(ErrorKind::usage, "{} contradicts --count {}; give one of them",
             options.given(radius) ? "--radius " + format_number(options[radius])
                                   : fmt::format("--n-approx {}", options[about]),
             *request.count);
    const double most = space_of(plan, false).largest_distance();
    if (options.given(radius) && !(options[radius] > 0 && options[radius] <= most))
        fail(ErrorKind::usage,
             "--radius: {} is outside (0, {}]; no two points of the box are farther apart",
             format_number(options[radius]), format_number(most));
    plan.count = 0;
    return plan;
}

/// Radius for which expected_disks() is `wanted`.
double typical_radius(const BoxSpace& space, double wanted) {
    double low = 0;
    double high = space.largest_distance();
    if (expected_disks(space, high) >= wanted) return high;
    for (int i = 0; i < 100; ++i) {
        const double middle = (low + high) / 2;
        (expected_disks(space, middle) > wanted ? low : high) = middle;
    }
    return high;
}

/// Largest radius whose square is at most the squared distance of every pair; for a single point,
/// the largest distance in the box.
double least_distance(const Rows& rows, const BoxSpace& space, const RunContext& run) {
    const std::size_t d = space.box.dimension();
    if (rows.numbers().size() <= d) return space.largest_distance();
    std::vector<double> sides;
    for (std::size_t k = 0; space.torus && k < d; ++k) sides.push_back(space.box.extent(k));
    double squared = std::numeric_limits<double>::infinity();
    for (const Neighbor& n : KdTree(rows.numbers(), d, sides, run).all_nearest(run))
        squared = std::min(squared, n.squared);
    const double root = std::sqrt(squared);
    return root * root <= squared ? root : std::nextafter(root, 0.0);
}

RadiusField read_field(const BoxSpace& space, const Values& options, const RunContext& run) {
    FieldSource source;
    if (options.given(density))
        source.density = read_density(options[density], options[invert_option], run);
    if (options.given(radius_map)) source.lengths = read_lengths(options[radius_map], run);
    if (options.given(mask)) source.mask = read_mask(options[mask], false, run);
    return {space.box, source, run};
}

/// Makes points with varying radii; the packing's radius is the smallest radius.
Packing pack_varied(const BoxSpace& space, const RadiusField& field, const Plan& plan,
                    const Values& options, const RunContext& run) {
    const auto fill = [&](double r, double cells, std::uint64_t seed, const RunContext& part) {
        return varied_disks(space, field, r / field.least(), cells / field.least(), seed, part);
    };
    const auto once = [&](double r) { return Packing{fill(r, r, plan.seed, run), r}; };
    const auto typical = [&](double count) {
        return std::min(
            space.largest_distance(),
            field.least() / field.unit() * std::sqrt(saturated_density[2] * field.darts() / count));
    };
    if (options.given(radius)) return once(options[radius]);
    if (options.given(about)) return once(typical(static_cast<double>(options[about])));
    if (plan.count == 0) return once(field.least());
    const SearchGoal goal{plan.count, 2, typical(static_cast<double>(plan.count)),
                          space.largest_distance()};
    return search_radius(goal, plan.seed, fill, run);
}

/// A random point, with the largest distance in the box as its radius.
Packing single(const BoxSpace& space, std::uint64_t seed) {
    std::vector<double> point(space.box.dimension());
    DrawStream(Rng(seed)).point(space.box, point.data());
    return {Rows(std::move(point)), space.largest_distance()};
}

Packing pack(const BoxSpace& space, const Plan& plan, const Values& options,
             const RunContext& run) {
    if (plan.count == 0) {
        const double r = options.given(radius)
                             ? options[radius]
                             : typical_radius(space, static_cast<double>(options[about]));
        return {maximal_disks(space, r, r, plan.seed, run), r};
    }
    if (plan.count == 1) return single(space, plan.seed);
    // The search starts below the largest distance in the box: a disk of that radius would leave
    // only isolated points uncovered, which rounding may hide.
    const double most = space.largest_distance();
    const double typical = typical_radius(space, static_cast<double>(plan.count));
    const SearchGoal goal{plan.count, plan.dimension, std::min(typical, 0.99 * most), most};
    const auto fill = [&](double r, double cells, std::uint64_t seed, const RunContext& part) {
        return maximal_disks(space, r, cells, seed, part);
    };
    Packing packing = search_radius(goal, plan.seed, fill, run);
    packing.radius = least_distance(packing.rows, space, run);
    return packing;
}

/// The points in an order that is independent of their positions.
Rows shuffled(const Rows& rows, const Plan& plan, const RunContext& run) {
    constexpr std::uint64_t block = 4096;
    const std::size_t d = plan.dimension;
    const auto from = rows.numbers();
    Rows out = Rows::unwritten(from.size() / d, d);
    const auto to = out.numbers();
    const std::uint64_t count = from.size() / d;
    const Permutation permutation(count, Rng(plan.seed, ~std::uint64_t{1}).bits(0));
    for_each_block(silent(worth_threads(run, 3e-8 * static_cast<double>(count))), count, block,
                   [&](const Block& b) {
                       std::array<double, block> images;
                       permutation.fill(b.first, std::span(images).first(b.last - b.first));
                       for (std::uint64_t i = b.first; i < b.last; ++i)
                           std::copy_n(
                               from.begin() + static_cast<std::ptrdiff_t>(i * d), d,
                               to.begin() + static_cast<std::ptrdiff_t>(images[i - b.first]) *
                                                static_cast<std::ptrdiff_t>(d));
                   });
    return out;
}

std::vector<std::pair<std::string, std::string>> notes(const Values& options, const BoxSpace& space,
                                                       double found) {
    std::vector<std::pair<std::string, std::string>> notes{
        {"radius", format_number(found)},
        {space.torus ? "torus" : "bounded", "true"},
        {"order", options[order]}};
    for (const auto* file : {&density, &radius_map, &mask})
        if (options.given(*file)) notes.emplace_back(file->name, options[*file]);
    if (options[invert_option]) notes.emplace_back("invert", "true");
    return notes;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& given) {
    const RunContext run = given.rising();
    const bool progressive = options[order] == "progressive";
    const double packed = progressive ? 0.5 : 1;  // fraction of the time for packing
    const BoxSpace space = space_of(plan, !options[bounded_option]);
    std::optional<RadiusField> field;
    if (is_varied(options)) field = read_field(space, options, run);
    const RunContext packing_run = run.stage(0, packed);
    Packing packing = field ? pack_varied(space, *field, plan, options, packing_run)
                            : pack(space, plan, options, packing_run);
    Rows rows = shuffled(packing.rows, plan, run);
    packing.rows = {};
    if (progressive && field)
        rows = spread_varied(rows.numbers(), space, *field, packing.radius / field->least(),
                             run.stage(packed, 1));
    else if (progressive)
        rows = spread_out(rows.numbers(), space, packing.radius, run.stage(packed, 1));
    run.tick(1, 1);
    PointSet points(std::move(rows), plan.dimension);
    if (plan.bounds) points.domain = box_domain(*plan.bounds);
    points.provenance.options = notes(options, space, packing.radius);
    return points;
}

}  // namespace

Generator unit() {
    return {
        .name = "poisson-disk",
        .summary = "Random points with a minimum distance, added until no more fit (blue noise)",
        .source =
            "Cook 1986, doi:10.1145/7529.8927; Ebeida et al. 2012, "
            "doi:10.1111/j.1467-8659.2012.03059.x",
        .related = {"blue-noise", "maximal-poisson-disk", "bridson", "minimum-distance",
                    "hard-core"},
        .traits = {.min_dimension = 2,
                   .max_dimension = 6,
                   .sequence = false,
                   .prefix = false,
                   .boxed = true},
        .options = Schema(radius, about, density, invert_option, radius_map, mask, torus_option,
                          bounded_option, order),
        .aliases = {"poisson", "poisson-disc"},
        .stream_version = 6,
        .plan = plan,
        .set = make};
}

}  // namespace stipple::generators::poisson_disk
