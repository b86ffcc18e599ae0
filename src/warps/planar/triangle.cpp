// SPDX-License-Identifier: MIT
//
// Unit square onto a triangle with vertices v0, v1, v2, in the plane or in space, by barycentric
// coordinates, point = lambda0 v0 + lambda1 v1 + lambda2 v2:
//
//     sqrt            lambda0 = 1 - sqrt(xi0),  lambda1 = xi1 sqrt(xi0),
//                     lambda2 = (1 - xi1) sqrt(xi0)
//     low-distortion  lambda1 = xi0 - xi1 / 2,  lambda2 = xi1 / 2      where xi0 > xi1,
//                     lambda1 = xi0 / 2,        lambda2 = xi1 - xi0 / 2    else;
//                     lambda0 = 1 - max(xi0, xi1)
//
// The inverse of sqrt is xi0 = (lambda1 + lambda2)^2, xi1 = lambda1 / (lambda1 + lambda2). That of
// low-distortion is xi0 = lambda1 + lambda2, xi1 = 2 lambda2 if lambda1 > lambda2; otherwise xi1 =
// lambda1 + lambda2, xi0 = 2 lambda1.
//
// Shape   2 unit coordinates; 2 or 3 coordinates, as the vertices have.
// Strata  xi0 and xi1 are used directly, not as 1 - xi; small xi0 (sqrt), or small xi0 and xi1
//         (low-distortion), are near v0. With sqrt, strata become trapezoids between rays from v0,
//         or triangles at v0; small xi1 is near the edge v0 v2. low-distortion maps the diagonal
//         xi0 = xi1 to the median from v0 and is linear on each side of it: strata become
//         parallelograms, and neighbours stay close.
// Cost    O(1) a point; about 1.5 ns forward, 17 ns inverse on one core.
// Promise density 1 / area. Points lie in the closed triangle up to the rounding stated at
//         contains(). A round trip returns the same point within 1e-14 of the largest coordinate,
//         times longest edge / smallest height. For the default triangle it also returns the same
//         xi within 1e-14, except that with sqrt v0 returns xi1 = 0.
// Source  G. Turk, "Generating random points in triangles", in: A. S. Glassner (ed.), Graphics Gems
//         (1990) 24-28 (sqrt). E. Heitz, "A low-distortion map between triangle and square" (2019),
//         HAL hal-02073696 (low-distortion).

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "math/geometry/law_moments.hpp"
#include "math/geometry/vector3.hpp"
#include "warps/planar/flat_domain.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::triangle {
namespace {

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "sqrt",
    .choices = "sqrt|low-distortion",
    .help =
        "sqrt: parallels of the side v1 v2, and rays from v0; low-distortion: linear on each half "
        "of the square, keeps neighbours close"};

constexpr Param<Points> vertices{
    {.name = "vertices",
     .fallback = "0,0 1,0 0,1",
     .help = "Three corners v0 v1 v2, in 2 or 3 dimensions; xi1 = xi2 = 0 is v0"}};

using Barycentrics = std::array<double, 3>;

class TriangleDomain final : public FlatDomain {
  public:
    using FlatDomain::FlatDomain;

    /// Fraction of the area between v1 and the line through the point parallel to the edge v0 v2,
    /// and the position on that line. Starts from v1, whereas the warp starts from v0: this checks
    /// equal areas independently, and the cells are not aligned with the warp's strata.
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const auto [l1, l2] = frame().coordinates(space_point(point));
        const double from_0 = std::max(1 - l1 - l2, 0.0);
        const double from_2 = std::max(l2, 0.0);
        const double rest = std::min(from_0 + from_2, 1.0);
        cube[0] = rest * rest;
        cube[1] = rest > 0 ? std::min(from_2 / (from_0 + from_2), 1.0) : 0.0;
    }
    std::optional<Moments> moments() const override {
        return triangle_moments({corners()[0], corners()[1], corners()[2]});
    }
    std::vector<std::string> cube_axes() const override {
        return {"area fraction (1 - lambda1)^2", "lambda2 / (lambda0 + lambda2)"};
    }
};

struct Roots {
    static Barycentrics forward(double u, double v) {
        const double root = std::sqrt(u);
        return {1 - root, root * v, root * (1 - v)};
    }
    static PlanePoint inverse(double l1, double l2) {
        const double root = std::min(l1 + l2, 1.0);
        return {root * root, root > 0 ? l1 / (l1 + l2) : 0.0};
    }
};

struct LowDistortion {
    static Barycentrics forward(double u, double v) {
        const bool lower = u > v;
        const double most = lower ? u : v;
        const double half = 0.5 * (lower ? v : u);
        return {1 - most, lower ? most - half : half, lower ? half : most - half};
    }
    static PlanePoint inverse(double l1, double l2) {
        const double most = l1 + l2;
        return l1 > l2 ? PlanePoint{most, 2 * l2} : PlanePoint{2 * l1, most};
    }
};

template <class Method, std::size_t d>
struct OnTriangle {
    std::array<Vector3, 3> vertex;
    EdgeFrame frame;

    std::array<double, d> forward(const std::array<double, 2>& xi) const {
        const auto [l0, l1, l2] = Method::forward(xi[0], xi[1]);
        std::array<double, d> point;
        for (std::size_t k = 0; k < d; ++k)
            point[k] = l0 * vertex[0][k] + l1 * vertex[1][k] + l2 * vertex[2][k];
        return point;
    }
    std::array<double, 2> inverse(std::span<const double> point) const {
        const auto [l1, l2] = frame.coordinates(space_point(point));
        const auto [u, v] = Method::inverse(std::max(l1, 0.0), std::max(l2, 0.0));
        return {u, v};
    }
};

/// @throws Error(usage) unless there are three corners of dimension 2 or 3
std::array<Vector3, 3> corners_of(const Table& table) {
    if (table.size() != 3 || table[0].size() < 2 || table[0].size() > 3)
        fail(ErrorKind::usage,
             "--vertices: {} points of dimension {}; expected 3 points of dimension 2 or 3",
             table.size(), table[0].size());
    return {space_point(table[0]), space_point(table[1]), space_point(table[2])};
}

/// Frame of the triangle's edges. @throws Error(usage) if its area is lost in rounding
EdgeFrame frame_of(const std::array<Vector3, 3>& v, const Table& table) {
    const double size = std::max({largest(v[0]), largest(v[1]), largest(v[2])});
    if (size > 1e150) fail(ErrorKind::usage, "--vertices: a coordinate is outside [-1e150, 1e150]");
    const EdgeFrame frame(v[0], exact_edge(v[0], v[1]), exact_edge(v[0], v[2]), size);
    if (frame.flat())
        fail(ErrorKind::usage, "--vertices: the area of the triangle {} is 0 or lost in rounding",
             format_value(table));
    return frame;
}

template <class Method>
std::unique_ptr<Mapping> mapping_by(const WarpRequest& want) {
    const Table table = want.options[vertices];
    const auto corners = corners_of(table);
    const EdgeFrame frame = frame_of(corners, table);
    const auto triangle =
        std::make_shared<TriangleDomain>(want.spec({vertices.name}), table, frame);
    if (triangle->dimension() == 2)
        return row_mapping(triangle, OnTriangle<Method, 2>{corners, frame});
    return row_mapping(triangle, OnTriangle<Method, 3>{corners, frame});
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    if (want.options[method] == "low-distortion") return mapping_by<LowDistortion>(want);
    return mapping_by<Roots>(want);
}

}  // namespace

Warp unit() {
    return {.name = "triangle",
            .summary = "Triangle in the plane or in space, uniform by area",
            .source =
                "Turk 1990, in: Graphics Gems (sqrt); Heitz 2019, HAL hal-02073696 "
                "(low-distortion)",
            .related = {"simplex", "barycentric"},
            .strata =
                "sqrt: xi1 is the fraction of the area between the first vertex and a parallel of "
                "the opposite side, xi2 the position along it, both used directly; low-distortion: "
                "the diagonal becomes the median from the first vertex, linear on each side",
            .options = Schema(method, vertices, orientation),
            .mapping = make};
}

}  // namespace stipple::warps::triangle
