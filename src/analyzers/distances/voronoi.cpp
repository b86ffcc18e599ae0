// SPDX-License-Identifier: MIT
//
// Voronoi cells of n points in the plane: how equal and how round they are, and how their
// neighbours are arranged. Coincident points count once: m distinct points in the area V.
//
//     area           a_i of each cell, in V / m, and their coefficient of variation; its square is
//                    the capacity error of Balzer et al., mean (a_i m / V - 1)^2
//     valence        k_i, the number of neighbours of each cell; 6 on average on the torus
//     bond order     psi_i = 1 / k_i * sum over neighbours j of exp(6 i theta_ij), as
//                    local   mean |psi_i|      1 if each has its neighbours in a regular hexagon
//                    global  |mean psi_i|      1 if all hexagons are also parallel
//                    bonds   |mean over all bonds of exp(6 i theta)|
//     Lloyd energy   E = 1 / V * integral of |x - nearest point|^2 dx; m E / (2 V) is the
//                    normalized second moment
//     centroids      distance of each cell's centroid from its point, in sqrt(V / m)
//
// An edge shorter than --shortest-edge counts as a corner of four cells, so the cells beside it are
// not neighbours: cells of a square lattice have 4 neighbours, and psi_i = 0. On the torus
// (default) cells cross opposite sides. With straight distances they end at the box; valences and
// bonds are then those of the cells that touch no side.
//
//     for                              variation  local  global  normalized second moment
//     hexagonal lattice                 0          1      1       5 / (36 sqrt 3) = 0.080188
//     square lattice                    0          0      0       1 / 12
//     independent points, m -> inf      0.529      0.361  0       1 / (2 pi)
//
// Shape   n >= 2 points of the unit square or a rectangle, at least two of them distinct.
// Cost    O(n log n) if points are spread roughly evenly: 10^6 random points take 3.4 s on one
//         core, 90 bytes each. Clustered points use a search tree, three times as slow.
// Promise never depends on the number of threads, nor on the order of the points.
// Source  B. I. Halperin, D. R. Nelson, Phys. Rev. Lett. 41 (1978) 121-124,
//         doi:10.1103/PhysRevLett.41.121 (bond order); M. Balzer, T. Schloemer, O. Deussen, ACM
//         Trans. Graph. 28:3 (2009) 86, doi:10.1145/1531326.1531392 (capacity error); J. H.
//         Conway, N. J. A. Sloane, "Sphere Packings, Lattices and Groups", 3rd ed., 1999, chapter
//         2 section 3 (normalized second moment); E. N. Gilbert, Ann. Math. Statist. 33 (1962)
//         958-972, doi:10.1214/aoms/1177704464 (areas for independent points).

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "analyzers/analyzer.hpp"
#include "analyzers/distances/distances.hpp"
#include "core/parallel.hpp"
#include "math/neighbors/planar_sites.hpp"

namespace stipple::analyzers::voronoi {
namespace {

constexpr Param<double> shortest_edge{
    .name = "shortest-edge",
    .fallback = 1e-9,
    .low = 0,
    .high = 1,
    .unit = "sqrt(V / n)",
    .help =
        "Cells whose common edge is shorter do not count as neighbours: the edge is taken as a "
        "corner of four cells"};

constexpr std::size_t fewest_neighbors = 3;
constexpr std::size_t most_neighbors = 16;  ///< the last of `valences` also counts larger ones

double length_of(const Vec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

/// Sums over cells, with lengths in sqrt(V / m).
struct Sums {
    double squared_deviation = 0;  ///< sum over areas of (a - 1)^2
    double smallest = INFINITY;
    double largest = 0;
    double second_moment = 0;
    double offset = 0;
    double squared_offset = 0;
    double farthest_offset = 0;
    std::uint64_t inner = 0;
    std::array<std::uint64_t, most_neighbors + 1> valences{};
    std::uint64_t bonds = 0;
    std::uint64_t squared_bonds = 0;
    double local_order = 0;
    std::complex<double> global_order;
    std::complex<double> bond_sum;

    void add(const Sums& part) {
        squared_deviation += part.squared_deviation;
        smallest = std::min(smallest, part.smallest);
        largest = std::max(largest, part.largest);
        second_moment += part.second_moment;
        offset += part.offset;
        squared_offset += part.squared_offset;
        farthest_offset = std::max(farthest_offset, part.farthest_offset);
        inner += part.inner;
        for (std::size_t k = 0; k < valences.size(); ++k) valences[k] += part.valences[k];
        bonds += part.bonds;
        squared_bonds += part.squared_bonds;
        local_order += part.local_order;
        global_order += part.global_order;
        bond_sum += part.bond_sum;
    }
};

/// exp(6 i theta) for the direction theta of v.
std::complex<double> sixfold(const Vec2& v) {
    const double squared = v.x * v.x + v.y * v.y;
    const std::complex<double> twice((v.x * v.x - v.y * v.y) / squared, 2 * v.x * v.y / squared);
    return twice * twice * twice;
}

void add_shape(const VoronoiCell& cell, double unit, Sums& sums) {
    const CellMoments moments = cell.moments();
    const double area = moments.mass / (unit * unit);
    sums.squared_deviation += (area - 1) * (area - 1);
    sums.smallest = std::min(sums.smallest, area);
    sums.largest = std::max(sums.largest, area);
    sums.second_moment += moments.second / (unit * unit * unit * unit);
    const double offset = length_of(moments.first) / moments.mass / unit;
    sums.offset += offset;
    sums.squared_offset += offset * offset;
    sums.farthest_offset = std::max(sums.farthest_offset, offset);
}

void add_neighbors(const VoronoiCell& cell, double shortest, Sums& sums) {
    const auto corners = cell.corners();
    std::uint64_t neighbors = 0;
    std::complex<double> sum;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const CellCorner& from = corners[k];
        const Vec2& to = corners[k + 1 < corners.size() ? k + 1 : 0].at;
        if (!(length_of({to.x - from.at.x, to.y - from.at.y}) > shortest)) continue;
        if (from.site == CellCorner::wall) return;
        sum += sixfold(from.neighbor);
        ++neighbors;
    }
    if (neighbors == 0) return;
    const std::complex<double> mean = sum / static_cast<double>(neighbors);
    ++sums.inner;
    ++sums.valences[std::min<std::uint64_t>(neighbors, most_neighbors)];
    sums.bonds += neighbors;
    sums.squared_bonds += neighbors * neighbors;
    sums.local_order += std::sqrt(std::norm(mean));
    sums.global_order += mean;
    sums.bond_sum += sum;
}

Sums sum_up(const PlanarSites& sites, double unit, double shortest, const RunContext& run) {
    constexpr std::uint64_t size = 4096;
    const PlanarCells cells(sites, run);
    std::vector<Sums> parts(block_count(sites.count(), size));
    for_each_block(run, sites.count(), size, [&](const Block& b) {
        VoronoiCell cell;
        Sums sums;  // local, to avoid false sharing between threads
        for (std::uint64_t i = b.first; i < b.last; ++i) {
            if (i % 64 == 0) run.check_stop();
            cells.cut(static_cast<std::size_t>(i), cell);
            add_shape(cell, unit, sums);
            add_neighbors(cell, shortest, sums);
        }
        parts[b.index] = sums;
    });
    Sums all;
    for (const Sums& part : parts) all.add(part);
    return all;
}

Report areas_of(const Sums& sums, double count, double mean) {
    const double variance = sums.squared_deviation / count;
    Report area;
    area.add("mean", mean);
    area.add("variation", std::sqrt(variance));
    area.add("capacity_error", variance);
    area.add("smallest", sums.smallest, "V / m");
    area.add("largest", sums.largest, "V / m");
    return area;
}

Report valences_of(const Sums& sums) {
    const auto inner = static_cast<double>(sums.inner);
    const double mean = static_cast<double>(sums.bonds) / inner;
    const double squares = static_cast<double>(sums.squared_bonds) / inner;
    Report::Integers neighbors;
    Report::Curve share;
    for (std::size_t k = fewest_neighbors; k < sums.valences.size(); ++k) {
        neighbors.push_back(static_cast<std::int64_t>(k));
        share.push_back(static_cast<double>(sums.valences[k]) / inner);
    }
    Report valence;
    valence.add("mean", mean);
    valence.add("standard_deviation", std::sqrt(std::max(0.0, squares - mean * mean)));
    valence.add("six", static_cast<double>(sums.valences[6]) / inner);
    valence.add("neighbors", std::move(neighbors));
    valence.add("share", std::move(share));
    return valence;
}

Report order_of(const Sums& sums) {
    const auto inner = static_cast<double>(sums.inner);
    Report order;
    order.add("local", sums.local_order / inner);
    order.add("global", std::sqrt(std::norm(sums.global_order)) / inner);
    order.add("bonds", std::sqrt(std::norm(sums.bond_sum)) / static_cast<double>(sums.bonds));
    return order;
}

Report analyze(const PointSet& points, const Values& options, const RunContext& run) {
    const Distances distances = distances_in_box(points, options[metric], "voronoi");
    require_places(points, "voronoi");
    run.need_memory(90 * static_cast<double>(points.count()), "the Voronoi cells");
    const PlanarSites sites =
        planar_sites(points.flat(), *distances.box, distances.torus, run.stage(0, 0.1));
    const auto count = static_cast<double>(sites.count());
    const double mean = sites.sides.x * sites.sides.y / count;
    const double unit = std::sqrt(mean);
    const Sums sums = sum_up(sites, unit, options[shortest_edge] * unit, run.stage(0.1, 1));
    Report offset;
    offset.add("mean", sums.offset / count, "sqrt(V / m)");
    offset.add("root_mean_square", std::sqrt(sums.squared_offset / count), "sqrt(V / m)");
    offset.add("maximum", sums.farthest_offset, "sqrt(V / m)");
    Report results;
    results.add("cells", static_cast<std::uint64_t>(sites.count()));
    results.add("duplicates", static_cast<std::uint64_t>(points.count() - sites.count()));
    results.add("inner_cells", sums.inner);
    results.add("area", areas_of(sums, count, mean));
    if (sums.inner > 0) {
        results.add("valence", valences_of(sums));
        results.add("bond_order", order_of(sums));
    }
    results.add("lloyd_energy", sums.second_moment / count * mean);
    results.add("normalized_second_moment", sums.second_moment / count / 2);
    results.add("centroid_offset", std::move(offset));
    results.add("mean_distance", unit);
    results.add("metric", distances.name());
    return results;
}

}  // namespace

Analyzer unit() {
    return {
        .name = "voronoi",
        .summary = "Voronoi cells: areas, numbers of neighbours, bond order, Lloyd energy",
        .source =
            "Halperin, Nelson 1978, doi:10.1103/PhysRevLett.41.121 (bond order); Balzer, "
            "Schloemer, Deussen 2009, doi:10.1145/1531326.1531392 (capacity error)",
        .related = {"bond-order", "hexatic"},
        .traits = {.min_dimension = 2, .max_dimension = 2, .unit_cube = false, .boxed = true},
        .options = Schema(shortest_edge, metric),
        .results =
            {{"cells", "m, the number of distinct places of points"},
             {"duplicates", "points at the place of an earlier point"},
             {"inner_cells", "cells that touch no side of the box; all cells on the torus"},
             {"area.mean", "V / m"},
             lower({"area.variation", "coefficient of variation: standard deviation / mean"}),
             {"area.capacity_error", "its square, as in the literature on blue noise"},
             {"area.smallest", "smallest area / mean"},
             {"area.largest", "largest area / mean"},
             {"valence.mean",
              "mean number of neighbours of an inner cell; 6 on the torus, unless four cells meet "
              "in a corner"},
             {"valence.standard_deviation", "standard deviation of the number of neighbours"},
             higher({"valence.six", "fraction of the inner cells with six neighbours"}),
             {"valence.neighbors", "numbers of neighbours: 3, 4, ..., 16; the last includes more"},
             {"valence.share", "fraction of the inner cells with that many neighbours"},
             {"bond_order.local", "mean |psi_6| of the inner cells, as in papers on sampling"},
             {"bond_order.global",
              "|mean psi_6|: also requires that all cells have the same orientation, as in "
              "physics"},
             {"bond_order.bonds", "the same, with all bonds weighted equally"},
             {"lloyd_energy", "mean squared distance from a place to the nearest point"},
             lower({"normalized_second_moment",
                    "m E / (2 V): 0.080188 for hexagons, 0.159 at random"}),
             lower({"centroid_offset.mean",
                    "mean distance from a point to the centroid of its cell, in mean distances "
                    "sqrt(V / m)"}),
             {"centroid_offset.root_mean_square", "root mean square of these distances"},
             {"centroid_offset.maximum", "largest of these distances"},
             {"mean_distance", "sqrt(V / m), in units of the points"},
             {"metric", "torus or euclidean", true, "torus|euclidean"}},
        .curves = {{"valence.share", "valence.neighbors"}},
        .analyze = analyze};
}

}  // namespace stipple::analyzers::voronoi
