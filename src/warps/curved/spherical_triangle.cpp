// SPDX-License-Identifier: MIT
//
// Unit square onto the directions in a spherical triangle with corners a, b, c, uniform in solid
// angle (Arvo). The great circle through b that cuts off the fraction xi0 of the area A, on the
// side of the edge ab, meets the edge ac at c'. With q the distance from a to c':
//
//     tan(q/2) = sin(A xi0 / 2) / (tan(ab/2) sin(alpha - A xi0 / 2)),    alpha the angle at a
//
// The point w is on the arc from b to c', with 1 - cos(bw) = xi1 (1 - cos(bc')). Differences of
// vectors and tangents of half angles are used throughout, since Arvo's cosines lose the digits of
// small triangles. The first formula follows from tan(A/2) = tan(p/2) tan(q/2) sin(alpha) / (1 +
// tan(p/2) tan(q/2) cos(alpha)), for a triangle with sides p and q that enclose the angle alpha.
//
// Shape   2 unit coordinates; 3 coordinates, of unit length. Sides below 180 degrees.
// Strata  xi0 is the fraction of the area from the edge ab towards c; xi1 is the fraction of the
//         area along the arc from b. xi are used directly, not as 1 - xi. Strata become
//         quadrilaterals between arcs through b, or triangles if they touch b.
// Cost    O(1) a point; on one core about 11 ns forward, 46 ns inverse.
// Promise density 1 / A. Directions lie in the triangle up to the rounding stated at slack_of(). A
//         round trip returns the same direction within 1e-14; for near-hemispheres, within 1e-14
//         divided by the smallest from_opposite(). The same bits on every machine.
// Source  J. Arvo, "Stratified sampling of spherical triangles", SIGGRAPH 95, 437-438,
//         doi:10.1145/218380.218500.

#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "math/geometry/polar_direction.hpp"
#include "warps/curved/spherical_domain.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::spherical_triangle {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

constexpr Param<Points> vertices{
    {.name = "vertices",
     .fallback = "1,0,0 0,1,0 0,0,1",
     .help =
         "Three directions a b c, of any length above 0; xi1 = 0 is the edge ab, xi2 = 0 is b"}};

/// Arvo's map for the corners a, b, c.
class Arvo {
  public:
    Arvo(const Vector3& a, const Vector3& b, const Vector3& c)
        : a_(a), b_(b), ab_(minus(b, a)), bc_(minus(c, b)), half_area_(half_area_turns(a, b, c)) {
        const Vector3 ac = minus(c, a);
        to_c_ = tangent(a, c);
        sin_ = length(ac);
        cos_ = length(plus(a, c));
        // tan(ab/2) times the cosine and sine of alpha.
        const double volume = corner_volume(a, b, c);
        const Vector3 sum = plus(a, b);
        along_ = length(ab_) / length(sum) * dot(tangent(a, b), to_c_);
        across_ = 4 * std::abs(volume) / (dot(sum, sum) * sin_ * cos_);
        turn_ = std::copysign(1.0, volume);
    }

    Vector3 forward(const std::array<double, 2>& xi) const {
        const auto [c, s] = cos_sin_turns(half_area_ * xi[0]);
        const double x = across_ * c - along_ * s;
        const bool beyond = s * cos_ >= x * sin_;  // c' is at c, or beyond it by rounding
        const Vector3 arc = beyond ? bc_ : arc_from_b(x, s);
        const double whole = 0.25 * dot(arc, arc);  // sin^2 of half the arc from b to c'
        const double part = xi[1] * whole;
        const Vector3 across = plus(arc, times(b_, 2));
        const double rest = 0.25 * dot(across, across);  // 1 - whole
        const double scale = std::sqrt(xi[1] * ((1 - xi[1]) + xi[1] * rest) / rest);
        const double lift = 2 * (scale * whole - part);
        return {b_[0] + (scale * arc[0] + lift * b_[0]) + 0.0,
                b_[1] + (scale * arc[1] + lift * b_[1]) + 0.0,
                b_[2] + (scale * arc[2] + lift * b_[2]) + 0.0};
    }

    std::array<double, 2> inverse(std::span<const double> point) const {
        const Vector3 way = minus(vector_of(point), b_);
        const Vector3 plane = cross(b_, way);
        // x and y are cos q and sin q, times a common length, for the point c' on the edge ac that
        // is in one plane with b and w.
        const double x = 0 - turn_ * dot(plane, to_c_);
        const double y = std::max(0.0, 0 - turn_ * dot(plane, ab_));
        if (x * x + y * y == 0) return {0, 0};  // the direction is b
        const auto [share, arc] = at(x, y);
        const Vector3& whole = share < 1 ? arc : bc_;
        const double part = dot(way, way) / dot(whole, whole);
        if (part < 1) return {share, part};
        // The direction is on the edge ac and thus c' itself. The plane is not used, since it is
        // ill-conditioned if a is next to b.
        const Vector3 off = minus(vector_of(point), a_);
        return {at(dot(vector_of(point), a_), std::max(0.0, dot(off, to_c_))).share, 1};
    }

  private:
    /// Unit tangent of the sphere at `from`, towards `to`.
    static Vector3 tangent(const Vector3& from, const Vector3& to) {
        const Vector3 chord = minus(to, from);
        return normalized(plus(chord, times(from, 0.5 * dot(chord, chord))));
    }

    struct Foot {
        double share;  ///< fraction of the area between ab and the arc bc'
        Vector3 arc;   ///< the chord from b to c'
    };

    /// @param x, y cos q and sin q times a common length
    Foot at(double x, double y) const {
        const double size = std::sqrt(x * x + y * y);
        const double c = x >= 0 ? size + x : y;  // cos(q/2) and sin(q/2), times a common length
        const double s = x >= 0 ? y : size - x;
        return {turns_of(c + along_ * s, across_ * s) / half_area_, arc_from_b(c, s)};
    }

    /// The chord from b to c'. @param c, s cos(q/2) and sin(q/2) times a common length
    Vector3 arc_from_b(double c, double s) const {
        const double scale = 2 * s / (c * c + s * s);
        return {scale * (c * to_c_[0] - s * a_[0]) - ab_[0],
                scale * (c * to_c_[1] - s * a_[1]) - ab_[1],
                scale * (c * to_c_[2] - s * a_[2]) - ab_[2]};
    }

    Vector3 a_;
    Vector3 b_;
    Vector3 ab_;
    Vector3 bc_;
    double half_area_;
    Vector3 to_c_{};  ///< unit tangent at a, towards c
    double sin_ = 0;  ///< 2 sin(ac/2)
    double cos_ = 0;  ///< 2 cos(ac/2)
    double along_ = 0;
    double across_ = 0;
    double turn_ = 1;  ///< orientation of a, b, c: 1 counter-clockwise, seen from outside
};

using Corners = std::array<Vector3, 3>;

/// Distance of a corner's antipode from the edge between p and q.
double from_opposite(const Vector3& corner, const Vector3& p, const Vector3& q) {
    const Vector3 normal = normalized(cross(p, minus(q, p)));
    const double height = dot(normal, corner);
    const Vector3 foot = minus(times(normal, height), corner);
    const bool beside = dot(cross(p, foot), normal) > 0 && dot(cross(foot, q), normal) > 0;
    return beside ? std::abs(height) : std::min(length(plus(p, corner)), length(plus(q, corner)));
}

/// Tolerance: 16 epsilon, divided by the smallest of 1 and the distances from_opposite().
double slack_of(const Corners& v) {
    return 16 * epsilon /
           std::min({1.0, from_opposite(v[0], v[1], v[2]), from_opposite(v[1], v[2], v[0]),
                     from_opposite(v[2], v[0], v[1])});
}

/// @throws Error(usage) unless the table has the corners of a triangle
Corners corners_of(const Table& table) {
    if (table.size() != 3 || table[0].size() != 3)
        fail(ErrorKind::usage, "--vertices: {} points of dimension {}; expected 3 directions x,y,z",
             table.size(), table[0].size());
    Corners corners;
    for (std::size_t k = 0; k < 3; ++k) {
        corners[k] = {table[k][0], table[k][1], table[k][2]};
        if (largest(corners[k]) == 0) fail(ErrorKind::usage, "--vertices: 0,0,0 has no direction");
        corners[k] = normalized(corners[k]);
    }
    double longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector3& next = corners[(k + 1) % 3];
        longest = std::max(longest, length(minus(next, corners[k])));
        if (length(plus(next, corners[k])) < 1e-7)
            fail(ErrorKind::usage,
                 "--vertices: two of {} are opposite, so that no unique arc joins them",
                 format_value(table));
    }
    const auto& [a, b, c] = corners;
    const double height = std::abs(dot(a, cross(minus(b, a), minus(c, a)))) / longest;
    if (!(height > 64 * epsilon))
        fail(ErrorKind::usage, "--vertices: {} lie on one great circle; they span no triangle",
             format_value(table));
    return corners;
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const Corners v = corners_of(want.options[vertices]);
    // Cells come from the inverse of Arvo's map about the next corner.
    const auto cells = [next = Arvo(v[1], v[2], v[0])](std::span<const double> point) {
        return next.inverse(point);
    };
    const auto domain = std::make_shared<SphericalDomain>(
        want.spec(), std::vector<Vector3>(v.begin(), v.end()), std::vector<Vector3>{}, cells,
        4 * std::numbers::pi * half_area_turns(v[0], v[1], v[2]), slack_of(v),
        std::vector<std::string>{"fraction of the area next to bc", "fraction of the way from c"});
    return row_mapping(domain, Arvo(v[0], v[1], v[2]));
}

}  // namespace

Warp unit() {
    return {.name = "spherical-triangle",
            .summary = "Directions in a spherical triangle, uniform in solid angle",
            .source = "Arvo 1995, doi:10.1145/218380.218500",
            .strata =
                "xi1 is the fraction of the area from the edge of the first two corners towards "
                "the third, xi2 the fraction of the area along the arc from the second corner; "
                "both are used directly",
            .options = Schema(vertices),
            .stream_version = 2,
            .mapping = make};
}

}  // namespace stipple::warps::spherical_triangle
