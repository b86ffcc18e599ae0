// SPDX-License-Identifier: MIT
//
// Poisson-disk set: points thrown at random, none nearer than a radius to any other, until hardly
// a place is left for one more.
//
// --radius R   as many points as fit, by Bridson's method (generators/bridson.hpp).
// --count N    exactly N points. Sets are made for radii about the one that gives N on average:
// each
//              try corrects the radius by its own surplus, r <- r (1 + (count / N - 1) / d). Of
//              those with N points or more the one with the largest radius is taken, and its
//              surplus is removed at random. Of up to 30 tries (6 for N > 16 666) the first with a
//              surplus of at most sqrt(N) / 4 ends the search, once N > 1000. The radius stays
//              within 0.5 % of the one that gives N on average, from N = 1000 on; below, it is
//              mostly larger.
//
// Shape   d = 2, 3; distances hold in the box of --bounds, across its faces too (torus) or not.
// Cost    --radius: O(n k) time, about 50 bytes a point. --count: some 3 times as much for large N.
// Promise sum_k d_k^2 >= radius^2 for every pair, in float64, from the coordinates as stored;
//         d_k = |x_k - y_k|, on the torus min(d_k, side_k - d_k). The provenance has the radius.
// Source  R. Bridson, SIGGRAPH 2007 sketches, doi:10.1145/1278780.1278807.

#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "generators/bridson.hpp"
#include "generators/generator.hpp"
#include "math/spaced_points.hpp"

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
constexpr Param<std::int64_t> attempts{
    .name = "k",
    .fallback = 30,
    .low = 1,
    .high = 1'000'000,
    .unit = "attempts",
    .help = "Throws around a point before it is given up; more leave fewer gaps"};
constexpr Param<bool> torus{.name = "torus",
                            .help = "Distances go across opposite faces (so they do by default)"};
constexpr Param<bool> bounded{.name = "bounded", .help = "Distances end at the faces"};

Box box_of(const Plan& plan) {
    if (plan.bounds) return *plan.bounds;
    return {std::vector<double>(plan.dimension, 0.0), std::vector<double>(plan.dimension, 1.0)};
}

double diagonal(const Box& box) {
    double squared = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) squared += box.extent(k) * box.extent(k);
    return std::sqrt(squared);
}

Plan plan(const Request& request, const Values& options) {
    if (options[torus] && options[bounded])
        fail(ErrorKind::usage, "--torus contradicts --bounded; give one of them");
    const std::size_t dimension = request.bounds ? request.bounds->dimension() : 2;
    Plan plan = default_plan(request, 1024, dimension);
    const Box box = box_of(plan);
    if (box.dimension() != plan.dimension)
        fail(ErrorKind::usage, "--bounds: {} ranges for {} coordinates", box.dimension(),
             plan.dimension);
    const double most = diagonal(box);
    if (!(most > 1e-140 && most < 1e150))
        fail(ErrorKind::usage, "--bounds: {} has no distances that float64 can square",
             format_box(box));
    if (!options.given(radius)) return plan;
    if (request.count)
        fail(ErrorKind::usage, "--radius {} contradicts --count {}; give one of them",
             format_number(options[radius]), *request.count);
    if (!(options[radius] > 0 && options[radius] <= most))
        fail(ErrorKind::usage,
             "--radius: {} is outside (0, {}]; no two points of the box are farther apart",
             format_number(options[radius]), format_number(most));
    plan.count = 0;
    return plan;
}

/// Largest radius whose square is at most the squared distance of every pair; the box's diagonal
/// for a single point. O(n^2).
double smallest_distance(const std::vector<double>& rows, const DiskSpace& space) {
    const std::size_t d = space.box.dimension();
    const double most = diagonal(space.box);
    double squared = most * most;
    for (std::size_t i = 0; i < rows.size(); i += d)
        for (std::size_t j = 0; j < i; j += d) {
            const double* p = rows.data() + i;
            const double* q = rows.data() + j;
            const auto side = [&](std::size_t k) { return space.box.extent(k); };
            const double distance =
                d == 2 ? squared_distance<2>(p, q, {side(0), side(1)}, space.torus)
                       : squared_distance<3>(p, q, {side(0), side(1), side(2)}, space.torus);
            squared = std::min(squared, distance);
        }
    const double root = std::sqrt(squared);
    return root * root <= squared ? root : std::nextafter(root, 0.0);
}

/// Points with a radius that they verify.
struct Packing {
    std::vector<double> rows = {};
    double radius = 0;
};

/// Looks for exactly `count` points, as the header says.
class Search {
  public:
    Search(const DiskSpace& space, std::uint64_t count, std::uint64_t seed, const RunContext& run)
        : space_(space),
          seed_(seed),
          run_(run),
          dimension_(space.box.dimension()),
          count_(count),
          wanted_(static_cast<double>(count)) {}

    Packing find() {
        const std::uint64_t tries = std::clamp<std::uint64_t>(100'000 / count_, 6, 30);
        const double most = diagonal(space_.box);
        double r = first_radius();
        for (std::uint64_t i = 0; i < tries || best_.rows.empty(); ++i) {
            const double found = attempt(r, i);
            const double surplus = found - wanted_;
            if (count_ > 1000 && surplus >= 0 && surplus * surplus <= wanted_ / 16) break;
            const double change = surplus / wanted_ / static_cast<double>(dimension_);
            // Late tries are those of a box with hardly a place for so many: they go down only.
            r = i < tries ? std::min(most, r * (1 + std::clamp(change, -0.5, 0.5))) : 0.9 * r;
        }
        trim();
        if (count_ <= few) best_.radius = smallest_distance(best_.rows, space_);
        return std::move(best_);
    }

  private:
    static constexpr std::uint64_t few = 2000;  ///< so many points can be compared pair by pair

    /// Where the expected number is the one that is wanted, to start with.
    [[nodiscard]] double first_radius() const {
        constexpr double typical = 0.8;  // of what is expected, which is rather too many
        double low = 0;
        double high = diagonal(space_.box);
        for (int i = 0; i < 100; ++i) {
            const double middle = (low + high) / 2;
            (typical * expected_disks(space_, middle) > wanted_ ? low : high) = middle;
        }
        return high;
    }

    /// Number of points for the radius; keeps them if they are the best so far.
    double attempt(double r, std::uint64_t stream) {
        RunContext part = run_;
        const double share = (1 - done_) / 3;
        part.progress = [&](double fraction) {
            if (run_.progress) run_.progress(done_ + share * fraction);
        };
        auto rows = bridson(space_, r, Rng(seed_, stream), part);
        done_ += share;
        const std::size_t found = rows.size() / dimension_;
        if (found >= count_ && r > best_.radius) best_ = {std::move(rows), r};
        return static_cast<double>(found);
    }

    /// Removes the surplus, each point with the same chance.
    void trim() {
        const Rng rng(seed_, ~std::uint64_t{0});
        auto& rows = best_.rows;
        for (std::uint64_t i = 0; rows.size() > count_ * dimension_; ++i) {
            const std::uint64_t victim = rng.below(i, rows.size() / dimension_) * dimension_;
            std::copy_n(rows.end() - static_cast<std::ptrdiff_t>(dimension_), dimension_,
                        rows.begin() + static_cast<std::ptrdiff_t>(victim));
            rows.resize(rows.size() - dimension_);
        }
    }

    const DiskSpace& space_;
    std::uint64_t seed_;
    const RunContext& run_;
    std::size_t dimension_;
    std::uint64_t count_;
    double wanted_;
    double done_ = 0;  ///< fraction of the work, as far as one can know
    Packing best_;
};

PointSet make(const Plan& plan, const Values& options, const RunContext& run) {
    const DiskSpace space{box_of(plan), !options[bounded], options[attempts]};
    Packing packing =
        options.given(radius)
            ? Packing{bridson(space, options[radius], Rng(plan.seed), run), options[radius]}
            : Search(space, plan.count, plan.seed, run).find();
    run.tick(1, 1);
    PointSet points(std::move(packing.rows), plan.dimension);
    if (plan.bounds) points.domain = box_domain(*plan.bounds);
    points.provenance.options = {{"radius", format_number(packing.radius)},
                                 {"k", std::to_string(space.attempts)},
                                 {space.torus ? "torus" : "bounded", "true"}};
    return points;
}

}  // namespace

Generator poisson_disk() {
    return {.name = "poisson-disk",
            .summary = "Random points that keep a distance from each other (blue noise)",
            .source = "Bridson 2007, doi:10.1145/1278780.1278807",
            .traits = {.min_dimension = 2,
                       .max_dimension = 3,
                       .sequence = false,
                       .prefix = false,
                       .boxed = true},
            .options = Schema(radius, attempts, torus, bounded),
            .aliases = {"poisson", "poisson-disc"},
            .plan = plan,
            .set = make};
}

}  // namespace stipple::generators
