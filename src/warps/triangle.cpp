// SPDX-License-Identifier: MIT
//
// Unit square onto a triangle with vertices v0, v1, v2, in the plane or in space:
//
//     lambda0 = 1 - sqrt(xi0),  lambda1 = xi1 sqrt(xi0),  lambda2 = (1 - xi1) sqrt(xi0)
//     point   = lambda0 v0 + lambda1 v1 + lambda2 v2
//
// and back: xi0 = (lambda1 + lambda2)^2, xi1 = lambda1 / (lambda1 + lambda2). The barycentrics of a
// point p are lambda_i = g_i . (p - v0), i = 1, 2, where g_i lies in the plane of the triangle and
// g_i . (v_j - v0) = 1 if i = j, else 0.
//
// Shape   2 unit coordinates; 2 or 3 coordinates, as the vertices have.
// Strata  xi0 and xi1 are taken as they are, not as 1 - xi: small xi0 is near v0, small xi1 near
// the
//         edge v0 v2. Strata become trapezoids between rays from v0, triangles where they touch it.
// Cost    O(1) a point; about 3 ns forward, 7 ns back on one core.
// Promise density 1 / area. Points lie in the closed triangle up to the rounding stated at
//         contains(). Forward and back again is the same point within 1e-14 of the largest
//         coordinate, times longest edge / smallest height; for the default triangle also the same
//         xi within 1e-14, save that all xi1 meet in v0, which goes back to xi1 = 0.
// Source  G. Turk, "Generating random points in triangles", in: A. S. Glassner (ed.), Graphics Gems
//         (1990) 24-28.

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/wide.hpp"
#include "warps/warp.hpp"

namespace stipple::warps {
namespace {

constexpr Param<Points> vertices{
    {.name = "vertices",
     .fallback = "0,0 1,0 0,1",
     .help = "Three corners v0 v1 v2, in 2 or 3 dimensions; xi0 = 0 is v0"}};

const Schema& schema() {
    static const Schema options(vertices);
    return options;
}

/// A point in space; the plane is z = 0.
using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector times(const Vector& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
Vector cross(const Vector& a, const Vector& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector vector_of(std::span<const double> point) {
    return {point[0], point[1], point.size() > 2 ? point[2] : 0};
}

struct Barycentrics {
    double l0;
    double l1;
    double l2;
};

class TriangleDomain final : public Domain {
  public:
    /// @throws Error(usage) when the corners are not those of a triangle.
    explicit TriangleDomain(const Table& corners) : corners_(corners) {
        if (corners.size() != 3 || corners[0].size() < 2 || corners[0].size() > 3)
            fail(ErrorKind::usage,
                 "--vertices: {} points of dimension {}; 3 points of dimension 2 or 3 are needed",
                 corners.size(), corners[0].size());
        double size = 0;  // largest coordinate
        for (const auto& corner : corners)
            for (const double x : corner) size = std::max(size, std::abs(x));
        if (size > 1e150)
            fail(ErrorKind::usage, "--vertices: a coordinate is outside [-1e150, 1e150]");
        for (std::size_t k = 0; k < 3; ++k) vertices_[k] = vector_of(corners[k]);
        lay_out(size);
    }

    std::string spec() const override {
        Values values = schema().defaults();
        values.put(vertices.name, corners_);
        return format_spec("triangle", values, schema());
    }
    std::size_t dimension() const override { return corners_[0].size(); }
    std::size_t cube_dimension() const override { return 2; }
    double measure() const override { return area_; }

    /// Up to 16 epsilon (largest coordinate) (longest edge / smallest height) away from the
    /// triangle or its plane: the rounding of a point that was made.
    bool contains(std::span<const double> point) const override {
        const auto [l0, l1, l2] = barycentrics(point);
        return l0 * heights_[0] >= -slack_ && l1 * heights_[1] >= -slack_ &&
               l2 * heights_[2] >= -slack_ &&
               std::abs(dot(normal_, minus(vector_of(point), vertices_[0]))) <= slack_;
    }

    Box bounding_box() const override {
        Box box{corners_[0], corners_[0]};
        for (const auto& corner : corners_) box = stipple::bounding_box(corner, box);
        return box;
    }

    /// Area left between v1 and the line through the point parallel to the edge v0 v2, and the
    /// place on that line. From v1, where the warp starts from v0, so that equal areas are known
    /// without it, and cells do not line up with its strata.
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const auto [l0, l1, l2] = barycentrics(point);
        const double from_0 = std::max(l0, 0.0);
        const double from_2 = std::max(l2, 0.0);
        const double rest = std::min(from_0 + from_2, 1.0);
        cube[0] = rest * rest;
        cube[1] = rest > 0 ? std::min(from_2 / (from_0 + from_2), 1.0) : 0.0;
    }
    std::vector<std::string> cube_axes() const override {
        return {"area fraction (1 - lambda1)^2", "lambda2 / (lambda0 + lambda2)"};
    }

    Barycentrics barycentrics(std::span<const double> point) const {
        const Vector d = minus(vector_of(point), vertices_[0]);
        const double l1 = dot(gradients_[0], d);
        const double l2 = dot(gradients_[1], d);
        return {1 - l1 - l2, l1, l2};
    }

    const std::array<Vector, 3>& corners() const { return vertices_; }

  private:
    void lay_out(double size) {
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        const Vector a = minus(vertices_[1], vertices_[0]);
        const Vector b = minus(vertices_[2], vertices_[0]);
        const double longest = std::max({length(a), length(b), length(minus(b, a))});
        // In units of a power of 2 near the longest edge nothing over- or underflows or is rounded.
        const double unit = longest > 1e-140 ? std::ldexp(1.0, std::ilogb(longest)) : 1;
        const Vector e = times(a, 1 / unit);
        const Vector f = times(b, 1 / unit);
        const Vector n = cross(e, f);
        const double twice = length(n);  // the area
        const double height = twice * unit * (unit / longest);
        if (!(longest > 1e-140 && height > 64 * epsilon * size))
            fail(ErrorKind::usage, "--vertices: the triangle {} has no area",
                 format_value(corners_));
        area_ = 0.5 * twice * unit * unit;
        slack_ = 16 * epsilon * size * (longest / height);
        normal_ = times(n, 1 / twice);
        gradients_[0] = times(cross(f, normal_), 1 / (twice * unit));
        gradients_[1] = times(cross(normal_, e), 1 / (twice * unit));
        heights_ = {twice * unit / length(minus(f, e)), twice * unit / length(f),
                    twice * unit / length(e)};
    }

    Table corners_;
    std::array<Vector, 3> vertices_{};
    std::array<Vector, 2> gradients_{};  ///< of lambda1 and lambda2
    std::array<double, 3> heights_{};    ///< of each vertex above the edge opposite
    Vector normal_{};
    double area_ = 0;
    double slack_ = 0;
};

template <std::size_t d>
STIPPLE_WIDE void map_rows(std::span<const double> cube, std::span<double> image,
                           const std::array<Vector, 3>& vertex) {
    const auto [v0, v1, v2] = vertex;
    for (std::size_t i = 0; i < cube.size() / 2; ++i) {
        const double root = std::sqrt(cube[2 * i]);
        const double l0 = 1 - root;
        const double l1 = root * cube[2 * i + 1];
        const double l2 = root * (1 - cube[2 * i + 1]);
        for (std::size_t k = 0; k < d; ++k) image[d * i + k] = l0 * v0[k] + l1 * v1[k] + l2 * v2[k];
    }
}

class Triangle final : public Mapping {
  public:
    explicit Triangle(const Table& corners)
        : triangle_(std::make_shared<TriangleDomain>(corners)) {}

    DomainPtr domain() const override { return triangle_; }
    std::size_t cube_dimension() const override { return 2; }

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> /*keep*/) const override {
        if (triangle_->dimension() == 2)
            map_rows<2>(cube, image, triangle_->corners());
        else
            map_rows<3>(cube, image, triangle_->corners());
    }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        const std::size_t d = triangle_->dimension();
        for (std::size_t i = 0; i < image.size() / d; ++i) {
            const auto point = image.subspan(i * d, d);
            if (!triangle_->contains(point))
                fail(ErrorKind::input, "the point ({}) is outside the {}", fmt::join(point, ", "),
                     triangle_->spec());
            const auto weights = triangle_->barycentrics(point);
            const double l1 = std::max(weights.l1, 0.0);
            const double l2 = std::max(weights.l2, 0.0);
            const double root = std::min(l1 + l2, 1.0);
            cube[2 * i] = root * root;
            cube[2 * i + 1] = root > 0 ? std::min(l1 / (l1 + l2), 1.0) : 0.0;
        }
    }

  private:
    std::shared_ptr<const TriangleDomain> triangle_;
};

std::unique_ptr<Mapping> make(const Values& options, std::size_t /*given*/,
                              const RunContext& /*run*/) {
    return std::make_unique<Triangle>(options[vertices]);
}

}  // namespace

Warp triangle() {
    return {.name = "triangle",
            .summary = "Triangle in the plane or in space, uniform by area",
            .source = "Turk 1990, in: Graphics Gems",
            .strata =
                "xi1 is the share of the area between the first vertex and a parallel of the "
                "opposite side, xi2 the place along it, both as they are",
            .traits = {},
            .options = schema(),
            .make = make};
}

}  // namespace stipple::warps
