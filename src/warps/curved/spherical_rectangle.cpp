// SPDX-License-Identifier: MIT
//
// Unit square onto the directions from a point o to a rectangle with corner s and edges ex, ey,
// uniform in its solid angle (Urena, Fajardo, King). In coordinates along the edges, with origin o,
// the rectangle is [x0, x1] x [y0, y1] at a distance z. xi0 determines x: the part of the rectangle
// up to x has the fraction xi0 of the solid angle. Then sin(elevation) is uniform in xi1:
//
//     h(y) = y / sqrt(x^2 + y^2 + z^2),    sin(elevation) = h(y0) + xi1 (h(y1) - h(y0))
//
// The solid angle from x = -infinity to x is that of a triangle with its apex on the -x axis, where
// its angle is Delta = kappa0 - kappa1, cot(kappa_i) = y_i / z. Half of this solid angle is H with
//
//     tan H = g0 g1 z (y1 - y0) / ((w0 w1)^2 + g0 g1 (z^2 + y0 y1)),
//     g_i = x + sqrt(x^2 + w_i^2),  w_i^2 = y_i^2 + z^2
//
// and the inverse: with x = z tan(phi), G = Delta - H,
//
//     tan(phi) = sin(H - G) / (2 sqrt(sin H sin G sin(H + kappa1) sin(G + kappa1)))
//
// These forms keep the digits that differences of arc cosines lose if the rectangle is small,
// distant or seen at a grazing angle. x and y are flipped so that mostly x <= 0 <= y, and sin(H +
// kappa1) is computed as sin(G + pi - kappa0) if that angle is smaller.
//
// Shape   2 unit coordinates; 3 coordinates: the unit vector w from o, not the point that it hits,
//         which is o + t w in the plane of the rectangle.
// Strata  xi0 runs along ex, xi1 along ey, both from s; xi are used directly, not as 1 - xi. Strata
//         become quadrilaterals between planes through o and a parallel of ey.
// Cost    O(1) a point; on one core about 14 ns forward, 62 ns inverse.
// Promise density 1 / (solid angle). Directions hit the rectangle, with a tolerance of 16 epsilon
//         at the planes through o and its edges. A round trip returns the same xi within 1e-15 over
//         the smaller of the two angles at which the rectangle is seen, and the same direction
//         within 1e-14. Exception: if o is above the rectangle itself, an ulp of xi near its sides
//         changes the direction by 1e-16 / (angle). The same bits on every machine.
// Source  C. Urena, M. Fajardo, A. King, "An area-preserving parametrization for spherical
//         rectangles", Computer Graphics Forum 32(4) (2013) 59-66, doi:10.1111/cgf.12151.

#include <limits>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "math/geometry/polar_direction.hpp"
#include "warps/curved/spherical_domain.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::spherical_rectangle {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

constexpr Param<Numbers> corner{
    {.name = "corner", .fallback = "-0.5,-0.5,1", .help = "Corner s of the rectangle: x,y,z"}};

constexpr Param<Points> edges{
    {.name = "edges",
     .fallback = "1,0,0 0,1,0",
     .help = "Two edges ex ey from the corner, at right angles; xi1 runs along ex, xi2 along ey"}};

constexpr Param<Numbers> origin{{.name = "origin",
                                 .fallback = "0,0,0",
                                 .help = "Point o from which the rectangle is seen: x,y,z"}};

/// A rectangle seen from the origin: corner (x0, y0, z) in a frame along its edges, z > 0.
struct Rectangle {
    Frame frame;
    double x0, x1, y0, y1, z;

    /// Direction of the point (x, y) of the rectangle's plane, as a unit vector in space.
    Vector3 towards(double x, double y) const { return normalized(frame.out({x, y, z})); }

    std::vector<Vector3> corners() const {
        return {towards(x0, y0), towards(x1, y0), towards(x1, y1), towards(x0, y1)};
    }

    /// Inward unit normals of the planes through the origin and the edge after each of corners().
    std::vector<Vector3> inward() const {
        const auto normal = [this](double x, double y, double height) {
            return normalized(frame.out({x, y, height}));
        };
        return {normal(0, z, -y0), normal(-z, 0, x1), normal(0, -z, y1), normal(z, 0, -x0)};
    }

    Rectangle transposed() const { return {{frame.y, frame.x, frame.z}, y0, y1, x0, x1, z}; }
};

class Urena {
  public:
    explicit Urena(const Rectangle& rectangle) : seen_(rectangle) {
        // To keep digits, x and y are negated if necessary, so that mostly x <= 0 and y >= 0.
        const auto turn = [](double& low, double& high, Vector3& along) {
            low = -std::exchange(high, -low);
            along = times(along, -1);
        };
        if (seen_.x0 + seen_.x1 > 0) {
            from_x_ = 1;
            sign_x_ = -1;
            turn(seen_.x0, seen_.x1, seen_.frame.x);
        }
        if (seen_.y0 + seen_.y1 < 0) {
            from_y_ = 1;
            sign_y_ = -1;
            turn(seen_.y0, seen_.y1, seen_.frame.y);
        }
        const double z = seen_.z;
        w0_ = std::sqrt(seen_.y0 * seen_.y0 + z * z);
        w1_ = std::sqrt(seen_.y1 * seen_.y1 + z * z);
        before_ = half_up_to(seen_.x0);
        behind_ = half_up_to(-seen_.x1);
        // A small solid angle is the sum of two triangles, which loses no digits. The diagonal of a
        // large rectangle may be near 180 degrees, where triangles are ill-conditioned.
        const auto c = seen_.corners();
        half_ = half_area_turns(c[0], c[1], c[2]) + half_area_turns(c[0], c[2], c[3]);
        if (half_ > 0.01) half_ = half_up_to(seen_.x1) - before_;
        low_ = {-seen_.y0 / w0_, z / w0_};
        high_ = {seen_.y1 / w1_, z / w1_};
        both_ = {low_.cos * high_.cos - low_.sin * high_.sin,
                 low_.sin * high_.cos + low_.cos * high_.sin};
    }

    Vector3 forward(const std::array<double, 2>& xi) const {
        const double u = from_x_ + sign_x_ * xi[0];
        const CosSin h_itself = cos_sin_turns(before_ + half_ * u);
        const CosSin g_itself = cos_sin_turns(behind_ + half_ * (1 - u));
        const CosSin h = h_itself.cos < 0 ? rest_of(g_itself) : h_itself;
        const CosSin g = g_itself.cos < 0 ? rest_of(h_itself) : g_itself;
        double along = h.sin * g.cos - h.cos * g.sin;  // sin(H - G)
        const double root =
            h.sin * g.sin * sine_of_sum(h, g, low_, high_) * sine_of_sum(g, h, low_, high_);
        double across = 2 * std::sqrt(std::max(root, 0.0));
        const bool before = along * seen_.z < across * seen_.x0;  // x < x0, by rounding only
        const bool behind = along * seen_.z > across * seen_.x1;
        along = before ? seen_.x0 : behind ? seen_.x1 : along;
        across = before || behind ? seen_.z : across;
        const double scale = 1 / std::sqrt(along * along + across * across);
        const double sin_phi = along * scale;
        const double cos_phi = across * scale;
        const double v = from_y_ + sign_y_ * xi[1];
        const Gaps from = gaps(seen_.y0, cos_phi);
        const Gaps to = gaps(seen_.y1, cos_phi);
        const double below = (1 - v) * from.below + v * to.below;
        const double above = (1 - v) * from.above + v * to.above;
        const double cos_up = std::sqrt(below * above);
        return seen_.frame.out({sin_phi * cos_up, 0.5 * (above - below), cos_phi * cos_up});
    }

    double solid_angle() const { return 4 * std::numbers::pi * half_; }

    std::array<double, 2> inverse(std::span<const double> point) const {
        const auto [x, y, z] = seen_.frame.in(vector_of(point));
        const double rr = x * x + z * z;
        const double size = std::sqrt(rr + y * y);
        const double cos_phi = z / std::sqrt(rr);
        const double u = (half_up_to(seen_.z * (x / z)) - before_) / half_;
        const double least = rr / (size * (size + std::abs(y)));
        const Gaps from = gaps(seen_.y0, cos_phi);
        const double range = from.below - gaps(seen_.y1, cos_phi).below;
        const double v = (y > 0 ? from.below - least : least - from.above) / range;
        return {from_x_ + sign_x_ * u, from_y_ + sign_y_ * v};
    }

  private:
    /// Half the solid angle from x = -infinity to x, in turns.
    [[gnu::always_inline]] double half_up_to(double x) const {
        const double z = seen_.z;
        const double m = z * z + seen_.y0 * seen_.y1;
        const double n = z * (seen_.y1 - seen_.y0);
        const double r0 = std::sqrt(x * x + w0_ * w0_);
        const double r1 = std::sqrt(x * x + w1_ * w1_);
        const double g0 = x > 0 ? r0 + x : w0_ * w0_ / (r0 - x);
        const double g1 = x > 0 ? r1 + x : w1_ * w1_ / (r1 - x);
        if (m >= 0) return turns_of(w0_ * w0_ * (w1_ * w1_) + g0 * g1 * m, g0 * g1 * n);
        // For m < 0, w0 w1 + m loses digits; n^2 / (w0 w1 - m) is equal, as (w0 w1)^2 = m^2 + n^2.
        const double more0 = x * (g0 + w0_) / (r0 + w0_);  // g0 - w0
        const double more1 = x * (g1 + w1_) / (r1 + w1_);
        const double sum = (more0 * g1 + w0_ * more1) + n * n / (w0_ * w1_ - m);
        return turns_of(m * sum + n * n, g0 * g1 * n);
    }

    /// Returns H if p is G, and G if p is H: H + G = pi - low - high. Used for angles above pi / 2,
    /// because sines lose digits near pi, where o is almost above the rectangle.
    CosSin rest_of(const CosSin& p) const {
        return {p.sin * both_.sin - p.cos * both_.cos, p.sin * both_.cos + p.cos * both_.sin};
    }

    /// sin(p + low) = sin(q + high), since the angles sum to pi, by the form that loses no digits.
    static double sine_of_sum(const CosSin& p, const CosSin& q, const CosSin& low,
                              const CosSin& high) {
        const double first = p.sin * low.cos + p.cos * low.sin;
        const double second = q.sin * high.cos + q.cos * high.sin;
        return p.cos * low.cos > p.sin * low.sin ? first : second;
    }

    /// 1 - h(y) and 1 + h(y), where h is the sine of an elevation.
    struct Gaps {
        double below;
        double above;
    };

    /// Gaps for the elevation of the point (z tan(phi), y) of the rectangle's plane.
    Gaps gaps(double y, double cos_phi) const {
        const double up = y * cos_phi;
        const double size = std::sqrt(up * up + seen_.z * seen_.z);
        const double least = seen_.z * seen_.z / (size * (size + std::abs(up)));
        const double most = 2 - least;
        return {up > 0 ? least : most, up > 0 ? most : least};
    }

    Rectangle seen_;
    double from_x_ = 0;  ///< the map uses from_x_ + sign_x_ xi0: xi0, or 1 - xi0 if x is flipped
    double sign_x_ = 1;
    double from_y_ = 0;  ///< likewise for xi1 and y
    double sign_y_ = 1;
    double half_ = 0;    ///< half the solid angle, in turns
    double before_ = 0;  ///< H at x0
    double behind_ = 0;  ///< G at x1
    double w0_ = 0;
    double w1_ = 0;
    CosSin low_{};   ///< cosine and sine of pi - kappa0
    CosSin high_{};  ///< cosine and sine of kappa1
    CosSin both_{};  ///< cosine and sine of pi - kappa0 + kappa1
};

/// @throws Error(usage) unless edges of these lengths and cosine of their angle form a rectangle
void check_edges(const Table& table, double size_x, double size_y, double cosine) {
    if (!(size_x > 0 && size_y > 0))
        fail(ErrorKind::usage, "--edges: {} has an edge of length 0", format_value(table));
    if (!(std::abs(cosine) <= 1e-6))
        fail(ErrorKind::usage,
             "--edges: {} are not at right angles; the cosine of their angle is {:.3g}",
             format_value(table), cosine);
}

/// The rectangle given by the options, in units of the largest coordinate. @throws Error(usage)
Rectangle rectangle_of(const Values& options) {
    const Table table = options[edges];
    if (table.size() != 2 || table[0].size() != 3)
        fail(ErrorKind::usage, "--edges: {} vectors of dimension {}; expected 2 vectors x,y,z",
             table.size(), table[0].size());
    const Vector3 ex = {table[0][0], table[0][1], table[0][2]};
    const Vector3 ey = {table[1][0], table[1][1], table[1][2]};
    const Vector3 to_corner =
        minus(vector_of(corner, options[corner]), vector_of(origin, options[origin]));
    const double unit = std::max({largest(ex), largest(ey), largest(to_corner)});
    if (!(unit >= 1e-150 && unit <= 1e150))
        fail(ErrorKind::usage, "--edges: the largest coordinate {} is outside [1e-150, 1e150]",
             unit);
    const double size_x = length(times(ex, 1 / unit));
    const double size_y = length(times(ey, 1 / unit));
    check_edges(table, size_x, size_y, 0);
    const Vector3 x = normalized(ex);
    check_edges(table, size_x, size_y, dot(x, normalized(ey)));
    const Vector3 y = normalized(minus(ey, times(x, dot(x, ey))));
    Vector3 z = cross(x, y);
    const Vector3 at = times(to_corner, 1 / unit);
    if (dot(at, z) < 0) z = times(z, -1);
    const Rectangle seen{{x, y, z},  dot(at, x),          dot(at, x) + size_x,
                         dot(at, y), dot(at, y) + size_y, dot(at, z)};
    const double reach = std::max(
        {std::abs(seen.x0), std::abs(seen.x1), std::abs(seen.y0), std::abs(seen.y1), seen.z});
    const auto seen_corners = seen.corners();
    const double narrow = std::min(length(minus(seen_corners[1], seen_corners[0])),
                                   length(minus(seen_corners[3], seen_corners[0])));
    const bool above = seen.x0 <= 0 && seen.x1 >= 0 && seen.y0 <= 0 && seen.y1 >= 0;
    if (!(seen.z > (above ? 1e-100 : 1e-10) * reach) || !(narrow > 256 * epsilon))
        fail(ErrorKind::usage,
             "--origin: the solid angle of the rectangle from {} is 0 or too small; move the point "
             "out of its plane, or nearer",
             format_value(options[origin]));
    return seen;
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const Rectangle rectangle = rectangle_of(want.options);
    // Cells come from the inverse of Urena's map with x and y exchanged.
    const Urena turned(rectangle.transposed());
    const auto cells = [turned](std::span<const double> point) {
        const auto [v, u] = turned.inverse(point);
        return std::array{u, v};
    };
    const auto domain = std::make_shared<SphericalDomain>(
        want.spec(), rectangle.corners(), rectangle.inward(), cells, turned.solid_angle(),
        16 * epsilon,
        std::vector<std::string>{"position along ex, as sine of the angle",
                                 "fraction of the solid angle along ey"});
    return row_mapping(domain, Urena(rectangle));
}

}  // namespace

Warp unit() {
    return {.name = "spherical-rectangle",
            .summary = "Directions from a point to a rectangle, uniform in solid angle",
            .source = "Urena, Fajardo, King 2013, doi:10.1111/cgf.12151",
            .strata =
                "xi1 is the fraction of the solid angle along the first edge, xi2 the position "
                "along the second, as sine of the elevation; both are used directly",
            .options = Schema(corner, edges, origin),
            .stream_version = 2,
            .mapping = make};
}

}  // namespace stipple::warps::spherical_rectangle
