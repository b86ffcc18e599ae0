// SPDX-License-Identifier: MIT
//
// Poisson-disk set: points thrown at random, none nearer than a radius to any other, until no place
// is left for one more (generators/maximal_disks.hpp).
//
// --radius R   as many points as fit.
// --n-approx N about N points: as many as fit with the radius that gives N in the mean.
// --count N    exactly N points, as many as fit with some radius, which is searched for: the same
//              darts leave fewer points for a larger radius, mostly, and hardly other points for
//              one that hardly differs, so that a few tries, each as long as a run with --radius,
//              come to exactly N. Where N is passed over other darts are tried; of eight in vain,
//              which happens to a few points only, the surplus of the best is removed. The radius
//              that is noted is the least distance that the points have, and they are maximal for
//              that, too.
//
// Shape   d = 2 ... 6; distances hold in the box of --bounds, across its faces too (torus) or not.
// Cost    see maximal_disks.hpp; --count takes some ten runs.
// Promise sum_k d_k^2 >= radius^2 for every pair, in float64, from the coordinates as stored;
//         d_k = |x_k - y_k|, on the torus min(d_k, side_k - d_k). No place of the box is as far as
//         the radius from all points. The provenance has the radius.
// Source  R. L. Cook, ACM Trans. Graph. 5 (1986) 51-72, doi:10.1145/7529.8927 (the process).

#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/rng.hpp"
#include "core/text.hpp"
#include "generators/box_space.hpp"
#include "generators/maximal_disks.hpp"
#include "generators/spread_order.hpp"
#include "math/kd_tree.hpp"
#include "math/permutation.hpp"

namespace stipple::generators {
namespace {

constexpr Param<double> radius{.name = "radius",
                               .low = 0,
                               .low_open = true,
                               .optional = true,
                               .unit = "length",
                               .help =
                                   "Least distance of two points; as many as fit are made. "
                                   "Instead of --count, which finds the radius"};
constexpr Param<std::int64_t> about{.name = "n-approx",
                                    .low = 1,
                                    .optional = true,
                                    .unit = "points",
                                    .help =
                                        "About so many points, made in one go: mostly within "
                                        "1 % (from 1000 on). Instead of --count"};
constexpr Param<Choice> order{.name = "order",
                              .fallback = "random",
                              .choices = "random|progressive",
                              .help =
                                  "progressive: the first n points are well spread, too, for "
                                  "every n"};

Plan plan(const Request& request, const Values& options) {
    Plan plan = plan_in_box(request, options);
    if (options.given(radius) && options.given(about))
        fail(ErrorKind::usage, "--radius {} contradicts --n-approx {}; give one of them",
             format_number(options[radius]), options[about]);
    if (!options.given(radius) && !options.given(about)) return plan;
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

/// Points with a radius that they keep, and leave no place for more.
struct Packing {
    Rows rows = {};
    double radius = 0;
};

/// Where expected_disks is the number that is wanted.
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

/// Looks for the radius at which the darts of one seed leave exactly `count` points.
class Search {
  public:
    Search(const BoxSpace& space, std::uint64_t count, const RunContext& run)
        : space_(space), run_(run), dimension_(space.box.dimension()), count_(count) {}

    /// Sets of the streams of a seed are searched one after the other, until one comes to exactly
    /// the count. If none does, the surplus of the one with the largest radius is removed.
    Packing find(std::uint64_t seed) {
        constexpr std::uint64_t streams = 8;
        for (std::uint64_t stream = 0; stream < streams; ++stream)
            if (found_in(stream == 0 ? seed : Rng(seed, stream).bits(0))) return std::move(best_);
        trim(seed);
        return std::move(best_);
    }

  private:
    bool found_in(std::uint64_t seed) {
        constexpr int tries = 60;
        const double largest = space_.largest_distance();
        double r = typical_radius(space_, static_cast<double>(count_));
        cells_ = 0.9 * r;
        enough_ = 0;
        few_ = std::nextafter(largest, 2 * largest);
        for (int i = 0; i < tries && few_ > enough_ * (1 + 1e-9); ++i) {
            const std::uint64_t found = attempt(r, seed);
            if (found == count_) return true;
            r = next(r, found);
        }
        return false;
    }

    /// Number of points for the radius; keeps them if they are what is wanted, or the best so far.
    std::uint64_t attempt(double r, std::uint64_t seed) {
        constexpr double typical = 8;  // tries that it takes
        cells_ = std::min(cells_, r);
        const double part = (1 - done_) / typical;
        Rows rows = maximal_disks(space_, r, cells_, seed, run_.stage(done_, done_ + part));
        done_ += part;
        const std::uint64_t found = rows.numbers().size() / dimension_;
        (found >= count_ ? enough_ : few_) = r;
        if (found == count_ || (found > count_ && r > best_.radius)) best_ = {std::move(rows), r};
        return found;
    }

    /// The radius that would take or give the rest in the mean, if that may be; else a middle one.
    [[nodiscard]] double next(double r, std::uint64_t found) const {
        const double ratio = static_cast<double>(found) / static_cast<double>(count_);
        const double step = (ratio - 1) / static_cast<double>(dimension_);
        const double guess = r * (1 + std::clamp(step, -0.3, 0.3));
        const double low = enough_ > 0 ? enough_ : few_ / 2;
        return guess > low && guess < few_ ? guess : (low + few_) / 2;
    }

    /// Removes the surplus, each point with the same chance.
    void trim(std::uint64_t seed) {
        const Rng rng(seed, ~std::uint64_t{0});
        const auto rows = best_.rows.numbers();
        std::vector<double> left(rows.begin(), rows.end());
        for (std::uint64_t i = 0; left.size() > count_ * dimension_; ++i) {
            const auto victim =
                static_cast<std::ptrdiff_t>(rng.below(i, left.size() / dimension_) * dimension_);
            const auto last = left.end() - static_cast<std::ptrdiff_t>(dimension_);
            std::copy(last, left.end(), left.begin() + victim);
            left.erase(last, left.end());
        }
        best_.rows = Rows(std::move(left));
    }

    const BoxSpace& space_;
    const RunContext& run_;
    std::size_t dimension_;
    std::uint64_t count_;
    double cells_ = 0;   ///< radius that the cells are made for, the same for all tries
    double enough_ = 0;  ///< the last radius that left enough points
    double few_ = 0;     ///< the last that left too few
    double done_ = 0;    ///< fraction of the work, as far as one can know
    Packing best_;
};

/// Largest radius whose square is at most the squared distance of every pair; for a single point,
/// that of the farthest place.
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

Packing pack(const BoxSpace& space, const Plan& plan, const Values& options,
             const RunContext& run) {
    if (plan.count == 0) {
        const double r = options.given(radius)
                             ? options[radius]
                             : typical_radius(space, static_cast<double>(options[about]));
        return {maximal_disks(space, r, r, plan.seed, run), r};
    }
    Packing packing = Search(space, plan.count, run).find(plan.seed);
    packing.radius = least_distance(packing.rows, space, run);
    return packing;
}

/// The points in an order that tells nothing of where they are.
Rows shuffled(const Rows& rows, const Plan& plan, const RunContext& run) {
    constexpr std::uint64_t block = 4096;
    const std::size_t d = plan.dimension;
    const auto from = rows.numbers();
    Rows out = Rows::unwritten(from.size());
    const auto to = out.numbers();
    const std::uint64_t count = from.size() / d;
    const Permutation permutation(count, Rng(plan.seed, ~std::uint64_t{1}).bits(0));
    for_each_block(
        worth_threads(run, 3e-8 * static_cast<double>(count)), count, block,
        [&](const Block& b) {
            std::array<double, block> images;
            permutation.fill(b.first, std::span(images).first(b.last - b.first));
            for (std::uint64_t i = b.first; i < b.last; ++i)
                std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(i * d), d,
                            to.begin() + static_cast<std::ptrdiff_t>(images[i - b.first]) *
                                             static_cast<std::ptrdiff_t>(d));
        },
        true);
    return out;
}

PointSet make(const Plan& plan, const Values& options, const RunContext& given) {
    const RunContext run = given.rising();
    const bool progressive = options[order] == "progressive";
    const double packed = progressive ? 0.5 : 1;  // of the time
    const BoxSpace space = space_of(plan, !options[bounded_option]);
    Packing packing = pack(space, plan, options, run.stage(0, packed));
    Rows rows = shuffled(packing.rows, plan, run);
    packing.rows = {};
    if (progressive) rows = spread_out(rows.numbers(), space, packing.radius, run.stage(packed, 1));
    run.tick(1, 1);
    PointSet points(std::move(rows), plan.dimension);
    if (plan.bounds) points.domain = box_domain(*plan.bounds);
    points.provenance.options = {{"radius", format_number(packing.radius)},
                                 {space.torus ? "torus" : "bounded", "true"},
                                 {"order", options[order]}};
    return points;
}

}  // namespace

Generator poisson_disk() {
    return {.name = "poisson-disk",
            .summary = "Random points that keep a distance, until no place is left (blue noise)",
            .source =
                "Cook 1986, doi:10.1145/7529.8927; Ebeida et al. 2012, "
                "doi:10.1111/j.1467-8659.2012.03059.x",
            .traits = {.min_dimension = 2,
                       .max_dimension = 6,
                       .sequence = false,
                       .prefix = false,
                       .boxed = true},
            .options = Schema(radius, about, torus_option, bounded_option, order),
            .aliases = {"poisson", "poisson-disc"},
            .plan = plan,
            .set = make};
}

}  // namespace stipple::generators
