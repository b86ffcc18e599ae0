// SPDX-License-Identifier: MIT
//
// Triangulates the faces of a mesh: a convex face becomes a fan from its first corner. Otherwise
// ears are cut off one by one (Meisters): corners whose triangle contains no other corner. All
// predicates are exact.
//
// Shape   n corners, in either direction; consecutive ones may be equal. n - 2 triangles with the
//         orientation of the face; fewer if it is not convex and has equal corners.
// Cost    O(n) for a convex polygon, otherwise O(n r) for r reflex corners, at worst O(n^2 r).
// Source  G. H. Meisters, Amer. Math. Monthly 82 (1975) 648-651, doi:10.2307/2319703.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "math/geometry/orientation.hpp"
#include "math/geometry/polygon_contact.hpp"
#include "media/triangle_mesh.hpp"

namespace stipple {
namespace {

using PolygonTriangles = std::vector<std::array<std::uint32_t, 3>>;  ///< indices of corners

/// Indices of the corners that differ from the next corner.
std::vector<std::uint32_t> different(const Ring& corners) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        if (corners[i] != corners[(i + 1) % corners.size()]) places.push_back(i);
    return places;
}

/// Orientation of the ring at its lowest corner: 1 counterclockwise, -1 clockwise, 0 straight.
int direction(const Ring& ring) {
    std::size_t low = 0;
    for (std::size_t i = 1; i < ring.size(); ++i)
        if (is_before(ring[i], ring[low])) low = i;
    const std::size_t n = ring.size();
    return orientation(ring[(low + n - 1) % n], ring[low], ring[(low + 1) % n]);
}

/// Whether all turns have the direction `sign` and the ring goes around only once, so that a single
/// corner is lower than both neighbours. For sign 0, whether all corners are collinear.
bool is_convex(const Ring& ring, int sign) {
    const std::size_t n = ring.size();
    std::size_t lowest = 0;
    for (std::size_t i = 0; i < n; ++i) {
        const PlanePoint before = ring[(i + n - 1) % n];
        const PlanePoint after = ring[(i + 1) % n];
        const int turn = orientation(before, ring[i], after);
        if (sign == 0 ? turn != 0 : sign * turn < 0) return false;
        lowest += is_before(ring[i], before) && is_before(ring[i], after);
    }
    return lowest == 1;
}

/// Cuts ears off a polygon until a triangle is left.
class EarCutter {
  public:
    EarCutter(const Ring& ring, int sign) : ring_(ring), sign_(sign) {
        const auto n = static_cast<std::uint32_t>(ring.size());
        for (std::uint32_t i = 0; i < n; ++i) {
            before_.push_back((i + n - 1) % n);
            after_.push_back((i + 1) % n);
        }
        for (std::uint32_t i = 0; i < n; ++i) {
            sharp_.push_back(is_sharp(i));
            if (!sharp_[i]) blunt_.push_back(i);
        }
    }

    /// Returns triangles as indices into the ring; fewer than n - 2 if no ear is left.
    PolygonTriangles cut(const RunContext& run) {
        PolygonTriangles triangles;
        std::uint32_t at = 0;
        std::size_t missed = 0;
        for (std::size_t left = ring_.size(); left > 3 && missed <= left;) {
            if (triangles.size() % 256 == 0) run.check_stop();
            if (!is_ear(at)) {
                ++missed;
                at = after_[at];
                continue;
            }
            triangles.push_back({before_[at], at, after_[at]});
            at = take_off(at);
            missed = 0;
            --left;
        }
        triangles.push_back({before_[at], at, after_[at]});
        return triangles;
    }

  private:
    int turn(std::uint32_t i, std::uint32_t j, std::uint32_t k) const {
        return sign_ * orientation(ring_[i], ring_[j], ring_[k]);
    }
    bool is_sharp(std::uint32_t i) const { return turn(before_[i], i, after_[i]) > 0; }

    bool is_ear(std::uint32_t i) const {
        if (!sharp_[i]) return false;
        const std::uint32_t a = before_[i];
        const std::uint32_t b = after_[i];
        for (const std::uint32_t k : blunt_) {
            if (k == a || k == b) continue;
            if (turn(a, i, k) >= 0 && turn(i, b, k) >= 0 && turn(b, a, k) >= 0) return false;
        }
        return true;
    }

    /// Removes corner i. Returns the second corner after it: an ear at the first would be a sliver.
    std::uint32_t take_off(std::uint32_t i) {
        const std::uint32_t a = before_[i];
        const std::uint32_t b = after_[i];
        after_[a] = b;
        before_[b] = a;
        for (const std::uint32_t k : {a, b})
            if (!sharp_[k] && is_sharp(k)) {
                sharp_[k] = true;
                std::erase(blunt_, k);
            }
        return after_[b];
    }

    const Ring& ring_;
    int sign_;
    std::vector<std::uint32_t> before_;
    std::vector<std::uint32_t> after_;
    std::vector<bool> sharp_;
    std::vector<std::uint32_t> blunt_;  ///< reflex and straight corners
};

/// Triangulates a plane polygon; nullopt if its edges cross, overlap or touch.
std::optional<PolygonTriangles> polygon_triangles(const Ring& corners, const RunContext& run) {
    const auto places = different(corners);
    Ring ring;
    for (const std::uint32_t place : places) ring.push_back(corners[place]);
    PolygonTriangles triangles;
    const int sign = ring.size() < 3 ? 0 : direction(ring);
    if (ring.size() < 3 || is_convex(ring, sign)) {
        for (std::uint32_t k = 2; k < corners.size(); ++k) triangles.push_back({0, k - 1, k});
        return triangles;
    }
    if (sign == 0 || find_contact({ring}, run)) return std::nullopt;
    triangles = EarCutter(ring, sign).cut(run);
    if (triangles.size() != ring.size() - 2) return std::nullopt;
    for (auto& triangle : triangles)
        for (std::uint32_t& corner : triangle) corner = places[corner];
    return triangles;
}

/// Newell's normal; for a flat polygon its length is twice the area.
Vector3 normal_of(const std::vector<Vector3>& corners) {
    Vector3 normal{};
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        normal =
            plus(normal, cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0])));
    return normal;
}

/// Whether all corners lie in one plane, up to rounding of coordinates to single precision.
bool is_flat(const std::vector<Vector3>& corners, const Vector3& normal) {
    const Vector3 up = normalized(normal);
    double extent = 0;
    double height = 0;
    double size = 0;
    for (const Vector3& corner : corners) {
        const Vector3 step = minus(corner, corners[0]);
        extent = std::max(extent, largest(step));
        height = std::max(height, std::abs(dot(step, up)));
        size = std::max(size, largest(corner));
    }
    return height <= 1e-5 * extent + 0x1p-22 * size;
}

/// Projects the corners along the axis with the largest normal component.
Ring dropped(const std::vector<Vector3>& corners, const Vector3& normal) {
    std::size_t axis = 0;
    for (const std::size_t k : {1U, 2U})
        if (std::abs(normal[k]) > std::abs(normal[axis])) axis = k;
    Ring ring;
    for (const Vector3& p : corners) ring.push_back({p[(axis + 1) % 3], p[(axis + 2) % 3]});
    return ring;
}

std::optional<PolygonTriangles> cut(const std::vector<Vector3>& corners, const Vector3& normal,
                                    const RunContext& run) {
    if (largest(normal) > 0) return polygon_triangles(dropped(corners, normal), run);
    // Zero normal: no area, or a self-intersection with equal areas on both sides.
    PolygonTriangles fan;
    for (std::uint32_t k = 2; k < corners.size(); ++k) {
        const Vector3 part =
            cross(minus(corners[k - 1], corners[0]), minus(corners[k], corners[0]));
        if (largest(part) > 0) return std::nullopt;
        fan.push_back({0, k - 1, k});
    }
    return fan;
}

}  // namespace

void MeshFaces::add(std::span<const std::uint32_t> polygon) {
    corners_.insert(corners_.end(), polygon.begin(), polygon.end());
    ends_.push_back(corners_.size());
}

std::vector<std::array<std::uint32_t, 3>> MeshFaces::triangles(const std::vector<Vector3>& vertices,
                                                               const std::string& name,
                                                               const RunContext& run) const {
    std::vector<std::array<std::uint32_t, 3>> all;
    std::vector<Vector3> corners;
    std::size_t bent = 0;
    std::size_t first_bent = 0;
    std::size_t begin = 0;
    for (std::size_t face = 0; face < ends_.size(); ++face) {
        if (face % 65536 == 0) run.check_stop();
        const auto places = std::span(corners_).subspan(begin, ends_[face] - begin);
        begin = ends_[face];
        if (places.size() == 3) {
            all.push_back({places[0], places[1], places[2]});
            continue;
        }
        corners.clear();
        for (const std::uint32_t place : places) corners.push_back(vertices[place]);
        const Vector3 normal = normal_of(corners);
        const auto triangles = cut(corners, normal, run);
        if (!triangles)
            fail(ErrorKind::input,
                 "{}: face {}: edges of its {} corners cross or touch; a simple polygon is needed",
                 name, face + 1, places.size());
        if (largest(normal) > 0 && !is_flat(corners, normal) && bent++ == 0) first_bent = face + 1;
        for (const auto& [a, b, c] : *triangles) all.push_back({places[a], places[b], places[c]});
    }
    if (bent > 0)
        run.notify(
            fmt::format("{}: {} of {} faces are not flat, the first is face {}; they are replaced "
                        "by triangles between their corners",
                        name, bent, ends_.size(), first_bent));
    return all;
}

}  // namespace stipple
