// SPDX-License-Identifier: MIT
#include "analyzers/distances/distances.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyzers/outside.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "math/functions/logarithm.hpp"
#include "math/neighbors/grid_nearest.hpp"

namespace stipple::analyzers {
namespace {

Outside outside_of(const PointSet& points) {
    Outside outside;
    for (std::size_t i = 0; i < points.count(); ++i)
        if (!points.domain->contains(points[i])) outside.add(i, points[i]);
    return outside;
}

/// Bounds of a domain that is a box or the unit cube; nullopt for other domains.
std::optional<Box> box_of(const Domain& domain) {
    const std::string spec = domain.spec();
    if (spec != "unit-cube" && !spec.starts_with("box:")) return std::nullopt;
    return domain.bounding_box();
}

Norm norm_of(const std::string& metric) {
    if (metric.ends_with("manhattan")) return Norm::manhattan;
    return metric.ends_with("chebyshev") ? Norm::chebyshev : Norm::euclidean;
}

/// Squares below this have lost digits.
constexpr double least_square = 0x1p-960;

constexpr const char* scale_hint = "divide all coordinates by the same number";

/// @throws Error(input) if squared distances within the box overflow float64, or all underflow
void require_squares(const Box& box, Norm norm, const char* too_wide) {
    double sum = 0;
    double squares = 0;
    std::size_t widest = 0;
    for (std::size_t k = 0; k < box.dimension(); ++k) {
        sum += box.extent(k);
        squares += box.extent(k) * box.extent(k);
        if (box.extent(k) > box.extent(widest)) widest = k;
    }
    if (!std::isfinite(norm == Norm::manhattan ? sum * sum : squares))
        fail(ErrorKind::input, "{} for squared distances in float64: x{} from {} to {}", too_wide,
             widest + 1, format_number(box.low[widest]), format_number(box.high[widest]));
    const double side = box.extent(widest);
    if (side > 0 && side * side < least_square)
        fail_with_hint(ErrorKind::input, scale_hint,
                       "the box is too narrow for squared distances in float64: x{} from {} to {}",
                       widest + 1, format_number(box.low[widest]), format_number(box.high[widest]));
}

/// @throws Error(input) for a side whose fourth power, or the product of several, may leave float64
void require_powers(const Box& box) {
    for (std::size_t k = 0; k < box.dimension(); ++k)
        if (!(box.extent(k) > 1e-70 && box.extent(k) < 1e70))
            fail_with_hint(
                ErrorKind::input, scale_hint,
                "the box is too {} for powers of distances in float64: x{} from {} to {}",
                box.extent(k) < 1 ? "narrow" : "wide", k + 1, format_number(box.low[k]),
                format_number(box.high[k]));
}

/// @throws Error(input) if the squared distance of two different points underflows; coordinates so
/// close to each other are close to 0
void require_apart(const PointSet& points, Norm norm) {
    constexpr double small = 0x1p-427;
    const auto is_small = [](double x) { return x != 0 && std::abs(x) < small; };
    if (std::ranges::none_of(points.flat(), is_small)) return;
    const auto neighbors = KdTree(points.flat(), points.dimension(), {}, {}, norm).all_nearest({});
    for (std::size_t i = 0; i < points.count(); ++i) {
        const auto [squared, j] = neighbors[i];
        if (squared >= least_square || std::ranges::equal(points[i], points[j])) continue;
        std::size_t k = 0;
        while (points[i][k] == points[j][k]) ++k;
        fail_with_hint(ErrorKind::input, scale_hint,
                       "points {} and {} are too close for squared distances in float64: x{} is {} "
                       "and {}",
                       i, j, k + 1, format_number(points[i][k]), format_number(points[j][k]));
    }
}

void require_squares(const PointSet& points, Norm norm) {
    require_finite(points);
    require_squares(bounding_box(points.flat(), points.dimension()), norm,
                    "the points are too far apart");
    require_apart(points, norm);
}

/// @throws Error(input) for points outside their domain, or with coordinates that are not finite
[[noreturn]] void refuse_places(const Outside& outside, const PointSet& points, const char* hint) {
    require_finite(points);
    refuse(outside, points.count(), *points.domain, hint);
}

}  // namespace

std::string Distances::name() const {
    if (norm == Norm::euclidean) return torus ? "torus" : "euclidean";
    return std::string(torus ? "torus-" : "") +
           (norm == Norm::manhattan ? "manhattan" : "chebyshev");
}

std::vector<double> Distances::sides() const {
    std::vector<double> sides;
    for (std::size_t k = 0; torus && k < box->dimension(); ++k) sides.push_back(box->extent(k));
    return sides;
}

Distances distances_of(const PointSet& points, const std::string& asked) {
    Distances distances{.torus = asked.empty() || asked.starts_with("torus"),
                        .box = box_of(*points.domain),
                        .norm = norm_of(asked)};
    if (!distances.box) {
        if (asked.starts_with("torus"))
            fail(ErrorKind::usage,
                 "--metric: a torus joins the faces of a unit cube or a box; the domain of the "
                 "points is {}",
                 points.domain->title());
        distances.torus = false;
        require_squares(points, distances.norm);
        return distances;
    }
    const Outside outside = outside_of(points);
    if (outside.count == 0) {
        require_squares(*distances.box, distances.norm, "the box is too wide");
        require_apart(points, distances.norm);
        return distances;
    }
    if (distances.torus)
        refuse_places(
            outside, points,
            "--domain names the domain of the points; --metric euclidean accepts points anywhere");
    distances.box.reset();
    require_squares(points, distances.norm);
    return distances;
}

Distances distances_in_box(const PointSet& points, const std::string& asked, const char* analyzer) {
    const std::optional<Box> box = box_of(*points.domain);
    if (!box) {
        static_cast<void>(distances_of(points, asked));  // throws a more specific error for a torus
        fail_with_hint(ErrorKind::input,
                       "'stipple warp NAME --inverse' takes points back to the unit cube",
                       "{} requires points of the unit cube or a box; the domain is {}", analyzer,
                       points.domain->title());
    }
    const Outside outside = outside_of(points);
    if (outside.count > 0)
        refuse_places(outside, points, "--domain 'box:bounds=[lo..hi,...]' names another box");
    require_squares(*box, Norm::euclidean, "the box is too wide");
    require_powers(*box);
    require_apart(points, Norm::euclidean);
    return {.torus = asked != "euclidean", .box = box};
}

double shortest_side(const Box& box) {
    double shortest = box.extent(0);
    for (std::size_t k = 1; k < box.dimension(); ++k) shortest = std::min(shortest, box.extent(k));
    return shortest;
}

double mean_distance(const Box& box, double n) {
    const double share = 1 / static_cast<double>(box.dimension());
    const double volume = volume_of(box);
    if (volume > 1e-280 && volume < 1e280) return real_power(volume / n, share);
    double distance = 1 / real_power(n, share);
    for (std::size_t k = 0; k < box.dimension(); ++k) distance *= real_power(box.extent(k), share);
    return distance;
}

bool all_equal(const PointSet& points) {
    for (std::size_t i = 1; i < points.count(); ++i)
        if (!std::ranges::equal(points[i], points[0])) return false;
    return true;
}

void require_places(const PointSet& points, const char* analyzer) {
    if (points.count() < 2)
        fail(ErrorKind::input, "{} needs at least two points; this is one", analyzer);
    if (all_equal(points))
        fail(ErrorKind::input, "{} needs points at two or more places; all {} are at one", analyzer,
             points.count());
}

std::vector<Neighbor> nearest_neighbors(const PointSet& points, const Distances& distances,
                                        const RunContext& run) {
    if (points.count() == 1) {
        run.tick(1, 1);
        if (!distances.torus) return {{std::numeric_limits<double>::infinity(), KdTree::none}};
        const double side = shortest_side(*distances.box);
        return {{side * side, 0}};
    }
    run.need_memory(
        static_cast<double>(points.count()) * (48 + 10 * static_cast<double>(points.dimension())),
        "the search for nearest neighbours");
    if (points.dimension() <= 3 && distances.norm == Norm::euclidean) {
        const Box box =
            distances.torus ? *distances.box : bounding_box(points.flat(), points.dimension());
        auto found = all_nearest_by_grid(points.flat(), box, distances.torus, run);
        if (found) return std::move(*found);
    }
    const KdTree tree(points.flat(), points.dimension(), distances.sides(), run.stage(0, 0.5),
                      distances.norm);
    return tree.all_nearest(run.stage(0.5, 1));
}

ClosestPair closest_pair(const std::vector<Neighbor>& neighbors) {
    const auto first = std::ranges::min_element(neighbors, {}, &Neighbor::squared);
    return {static_cast<std::size_t>(first - neighbors.begin()), *first};
}

}  // namespace stipple::analyzers
