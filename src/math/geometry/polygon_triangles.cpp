// SPDX-License-Identifier: MIT
#include "math/geometry/polygon_triangles.hpp"

#include "math/geometry/orientation.hpp"

namespace stipple {
namespace {

/// Indices of the corners that differ from the next one.
std::vector<std::uint32_t> different(const Ring& corners) {
    std::vector<std::uint32_t> places;
    for (std::uint32_t i = 0; i < corners.size(); ++i)
        if (corners[i] != corners[(i + 1) % corners.size()]) places.push_back(i);
    return places;
}

/// Orientation at the lowest corner: 1 counterclockwise, -1 clockwise, 0 if the corner is straight.
int direction(const Ring& ring) {
    std::size_t low = 0;
    for (std::size_t i = 1; i < ring.size(); ++i)
        if (is_before(ring[i], ring[low])) low = i;
    const std::size_t n = ring.size();
    return orientation(ring[(low + n - 1) % n], ring[low], ring[(low + 1) % n]);
}

/// True if all turns have the direction `sign` and the ring goes around once, so that a single
/// corner is lower than both neighbours. For sign 0, true if all corners are collinear.
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

    /// Returns triangles of indices into the ring.
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

    /// Removes corner i. Returns the next corner to test, which is not a neighbour of i, so that
    /// triangles do not become a fan of slivers.
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
    std::vector<std::uint32_t> blunt_;  ///< corners that are not convex
};

}  // namespace

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

}  // namespace stipple
