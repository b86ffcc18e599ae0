// SPDX-License-Identifier: MIT
#include "math/polytopes/polytope.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"

namespace stipple {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

bool joins(const HalfSpace& cut, std::size_t k) { return cut.normal[k] != 0; }

/// Groups of coordinates that inequalities couple, directly or through others. Coordinates without
/// an inequality are in no group.
std::vector<std::vector<std::size_t>> joined(std::size_t d, const std::vector<HalfSpace>& cuts) {
    std::vector<std::size_t> first(d);  // for each coordinate, the smallest one of its group
    std::iota(first.begin(), first.end(), std::size_t{0});
    std::vector<bool> named(d);
    for (const HalfSpace& cut : cuts) {
        std::size_t least = d;
        for (std::size_t k = 0; k < d; ++k)
            if (joins(cut, k)) least = std::min(least, first[k]);
        const std::vector<std::size_t> before = first;
        for (std::size_t k = 0; k < d; ++k)
            if (joins(cut, k)) {
                named[k] = true;
                for (std::size_t i = 0; i < d; ++i)
                    if (before[i] == before[k]) first[i] = least;
            }
    }
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t k = 0; k < d; ++k) {
        std::vector<std::size_t> group;
        for (std::size_t i = k; i < d; ++i)
            if (first[i] == k && named[i]) group.push_back(i);
        if (!group.empty()) groups.push_back(std::move(group));
    }
    return groups;
}

/// Minimum ratio of a frame's extent to its largest coordinate. It keeps rounding errors below the
/// limit for flat polytopes.
constexpr double finest = 1e-3;

/// Shortens a side of a box if more than half of it is outside a half-space. Returns whether the
/// box changed.
bool tighten(Box& box, const HalfSpace& cut) {
    const std::size_t d = box.dimension();
    double least = 0;  // minimum of normal . x over the box
    const auto least_of = [&](std::size_t k) {
        return cut.normal[k] * (cut.normal[k] > 0 ? box.low[k] : box.high[k]);
    };
    for (std::size_t k = 0; k < d; ++k) least += least_of(k);
    bool changed = false;
    for (std::size_t k = 0; k < d; ++k) {
        const double reach = (cut.bound - least) / std::abs(cut.normal[k]) * 1.02;
        if (!joins(cut, k) || !(reach > 0 && reach < box.extent(k) / 2)) continue;
        const Box before = box;
        (cut.normal[k] > 0 ? box.high[k] : box.low[k]) =
            cut.normal[k] > 0 ? box.low[k] + reach : box.high[k] - reach;
        if (box.extent(k) < finest * std::max(std::abs(box.low[k]), std::abs(box.high[k])))
            box = before;
        else
            changed = true;
    }
    return changed;
}

/// A box that contains the intersection of a box and half-spaces, and is not much larger.
Box frame_of(Box box, const std::vector<HalfSpace>& cuts) {
    bool changed = true;
    for (int pass = 0; pass < 100 && changed; ++pass) {
        changed = false;
        for (const HalfSpace& cut : cuts) changed = tighten(box, cut) || changed;
    }
    return box;
}

/// The half-space in coordinates of a frame, in which the frame is the unit cube.
HalfSpace framed(const HalfSpace& cut, const Box& frame) {
    HalfSpace to{.normal = {}, .bound = cut.bound, .text = cut.text};
    for (std::size_t k = 0; k < frame.dimension(); ++k) {
        to.normal.push_back(cut.normal[k] * frame.extent(k));
        to.bound -= cut.normal[k] * frame.low[k];
    }
    const bool finite = std::isfinite(to.bound) &&
                        std::ranges::all_of(to.normal, [](double a) { return std::isfinite(a); });
    if (!finite || std::ranges::none_of(to.normal, [](double a) { return std::abs(a) > 1e-300; }))
        fail(ErrorKind::usage, "'{}' has numbers that are too large or too small for its box",
             cut.text);
    return to;
}

/// Builds the polytope in its frame. Computes the volume twice, with vertices in opposite orders.
/// The results differ if planes are so close that rounding decides which of them meet in a vertex.
FaceTree checked_tree(PolytopeVertices vertices) {
    FaceTree tree(vertices);
    std::ranges::reverse(vertices.all);
    const double volume = FaceTree(vertices).volume();
    if (!(std::abs(volume - tree.volume()) <= 1e-9 * volume && volume > 0))
        fail(ErrorKind::limit,
             "inequalities differ by so little that the polytope's vertices are lost in rounding");
    return tree;
}

/// Rounding error of a point's distance from a plane: plane coefficients and box ends are rounded.
double rounding_of(const PolytopePlane& plane, const Box& frame) {
    double sum = 1;
    for (std::size_t k = 0; k < frame.dimension(); ++k) {
        const double far = std::max(std::abs(frame.low[k]), std::abs(frame.high[k]));
        sum += std::abs(plane.normal[k]) * (1 + far / frame.extent(k));
    }
    return 32 * epsilon * sum;
}

}  // namespace

Polytope::Polytope(Box box, const std::vector<HalfSpace>& cuts)
    : box_(std::move(box)),
      around_(box_),
      moments_{std::vector<double>(dimension()), std::vector<double>(dimension() * dimension()),
               std::vector<double>(dimension())} {
    for (const HalfSpace& cut : cuts)
        if (cut.bound < 0 && std::ranges::none_of(cut.normal, [](double a) { return a != 0; }))
            fail(ErrorKind::usage, "no point satisfies '{}'", cut.text);
    const std::size_t d = dimension();
    std::vector<bool> grouped(d);
    for (const auto& coordinates : joined(d, cuts)) {
        add_group(coordinates, cuts);
        for (const std::size_t k : coordinates) grouped[k] = true;
    }
    for (std::size_t k = 0; k < d; ++k) {
        if (grouped[k]) continue;
        const double extent = box_.extent(k);
        volume_ *= extent;
        moments_.mean[k] = box_.low[k] + extent / 2;
        moments_.covariance[k * d + k] = extent * extent / 12;
    }
    if (!(volume_ > 1e-300 && volume_ < 1e300))
        fail(ErrorKind::usage, "the volume is {:.3g}; expected one in [1e-300, 1e+300]", volume_);
}

void Polytope::add_group(const std::vector<std::size_t>& coordinates,
                         const std::vector<HalfSpace>& cuts) {
    if (coordinates.size() > most_polytope_dimensions)
        fail(ErrorKind::limit, "inequalities couple {} coordinates; at most {} are possible",
             coordinates.size(), most_polytope_dimensions);
    std::vector<HalfSpace> own;
    for (const HalfSpace& cut : cuts) {
        if (!joins(cut, coordinates[0]) &&
            std::ranges::none_of(coordinates, [&](std::size_t k) { return joins(cut, k); }))
            continue;
        own.push_back({.normal = {}, .bound = cut.bound, .text = cut.text});
        for (const std::size_t k : coordinates) own.back().normal.push_back(cut.normal[k]);
    }
    Box frame;
    for (const std::size_t k : coordinates) {
        frame.low.push_back(box_.low[k]);
        frame.high.push_back(box_.high[k]);
    }
    frame = frame_of(std::move(frame), own);
    for (HalfSpace& cut : own) cut = stipple::framed(cut, frame);
    const PolytopeVertices vertices = polytope_vertices(coordinates.size(), own);
    Group group{coordinates, frame, checked_tree(vertices), vertices.planes, {}};
    for (const PolytopePlane& plane : group.planes)
        group.rounding.push_back(rounding_of(plane, frame));
    take_moments(group);
    groups_.push_back(std::move(group));
}

/// Adds a group to moments, volume and bounding box.
void Polytope::take_moments(const Group& group) {
    const auto& coordinates = group.coordinates;
    const Box& frame = group.frame;
    const FaceTree& tree = group.tree;
    const Moments own = tree.moments();
    const std::size_t size = coordinates.size();
    volume_ *= tree.volume();
    for (std::size_t i = 0; i < size; ++i) {
        const std::size_t k = coordinates[i];
        volume_ *= frame.extent(i);
        moments_.mean[k] = frame.low[i] + own.mean[i] * frame.extent(i);
        moments_.skewness[k] = own.skewness[i];
        for (std::size_t j = 0; j < size; ++j)
            moments_.covariance[k * dimension() + coordinates[j]] =
                own.covariance[i * size + j] * frame.extent(i) * frame.extent(j);
        double least = 1, most = 0;
        for (const PolytopePoint& vertex : tree.vertices()) {
            least = std::min(least, vertex[i]);
            most = std::max(most, vertex[i]);
        }
        around_.low[k] = frame.low[i] + least * frame.extent(i);
        around_.high[k] = most < 1 ? frame.low[i] + most * frame.extent(i) : frame.high[i];
    }
}

PolytopePoint Polytope::framed(const Group& group, std::span<const double> point) {
    PolytopePoint at{};
    for (std::size_t i = 0; i < group.coordinates.size(); ++i)
        at[i] = (point[group.coordinates[i]] - group.frame.low[i]) / group.frame.extent(i);
    return at;
}

bool Polytope::contains(std::span<const double> point) const {
    for (std::size_t k = 0; k < dimension(); ++k)
        if (!(point[k] >= box_.low[k] && point[k] <= box_.high[k])) return false;
    return std::ranges::all_of(groups_, [&](const Group& group) {
        const PolytopePoint at = framed(group, point);
        for (std::size_t j = 0; j < group.planes.size(); ++j)
            if (!(group.planes[j].slack(at.data(), group.coordinates.size()) >= -group.rounding[j]))
                return false;
        return true;
    });
}

std::string Polytope::cube_axis(std::size_t k) const {
    for (const Group& group : groups_) {
        if (group.coordinates[0] == k) return "fraction of the volume before";
        if (std::ranges::find(group.coordinates, k) != group.coordinates.end())
            return fmt::format("position in the simplex, x{}", k + 1);
    }
    return fmt::format("x{}", k + 1);
}

void Polytope::from_cube(std::span<const double> cube, std::span<double> image) const {
    const std::size_t d = dimension();
    for (std::size_t i = 0; i < cube.size(); ++i) image[i] = cube[i];
    scale_into(box_, image);
    const std::size_t block = d * FaceTree::some_rows;
    for (std::size_t first = 0; first < cube.size(); first += block) {
        const std::size_t size = std::min(block, cube.size() - first);
        for (const Group& group : groups_)
            map_some(group, cube.subspan(first, size), image.subspan(first, size));
    }
}

void Polytope::map_some(const Group& group, std::span<const double> cube,
                        std::span<double> image) const {
    const std::size_t d = dimension();
    const std::size_t rows = cube.size() / d;
    const std::size_t size = group.coordinates.size();
    std::array<std::array<double, FaceTree::some_rows>, most_polytope_dimensions> gathered;
    std::array<double*, most_polytope_dimensions> columns;
    for (std::size_t j = 0; j < size; ++j) {
        columns[j] = gathered[j].data();
        for (std::size_t i = 0; i < rows; ++i) gathered[j][i] = cube[i * d + group.coordinates[j]];
    }
    group.tree.forward(std::span(columns).first(size), rows);
    for (std::size_t j = 0; j < size; ++j) {
        const std::size_t k = group.coordinates[j];
        const double extent = group.frame.extent(j);
        for (std::size_t i = 0; i < rows; ++i)
            image[i * d + k] = std::clamp(group.frame.low[j] + gathered[j][i] * extent,
                                          around_.low[k], around_.high[k]);
    }
}

void Polytope::to_cube(std::span<const double> point, std::span<double> cube) const {
    for (std::size_t k = 0; k < dimension(); ++k)
        cube[k] = std::clamp((point[k] - box_.low[k]) / box_.extent(k), 0.0, 1.0);
    for (const Group& group : groups_) {
        const PolytopePoint at = framed(group, point);
        PolytopePoint own{};
        group.tree.inverse(at.data(), own.data());
        for (std::size_t i = 0; i < group.coordinates.size(); ++i)
            cube[group.coordinates[i]] = own[i];
    }
}

}  // namespace stipple
