// SPDX-License-Identifier: MIT
//
// Directions in the plane: points of the circle of radius R about a centre c, by one of two
// methods:
//
//     angle             theta = 2 pi xi,  point = c + R (cos theta, sin theta)
//     square-normalize  v = 2 xi - 1 in [-1, 1]^2, point = c + R v / |v|: BIASED towards the
//                       diagonals, with density 1 / (8 R cos^2 theta), theta the angle from the
//                       nearer axis; E cos 4 theta = 3 - pi. Kept to show the bias
//
// and the inverse of method angle (square-normalize has none).
//
// Shape   1 unit coordinate, square-normalize 2; 2 coordinates.
// Strata  xi turns from the x axis towards the y axis; it is used directly, not as 1 - xi; strata
//         become arcs. square-normalize projects the strata of the square from its centre, which is
//         dropped.
// Cost    O(1) a point; on one core about 5 ns forward, 30 ns inverse.
// Promise density 1 / (2 pi R) for angle. Points lie on the circle up to the rounding stated at
//         contains(). A round trip returns the same point within 1e-14 of |c| + R and, for c = 0,
//         the same xi within 1e-15, except that xi = 1 returns 0. The same bits on every machine.
// Source  L. Devroye, Non-Uniform Random Variate Generation (1986), chapter V.4,
//         doi:10.1007/978-1-4613-8643-8.

#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "math/functions/trigonometry.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/curved/placement.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::circle {
namespace {

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "angle",
    .choices = "angle|square-normalize",
    .help =
        "angle: uses one coordinate; square-normalize: direction of a point of the square, uses 2 "
        "coordinates, BIASED towards the diagonals, kept to show the bias"};

constexpr Param<Numbers> middle{{.name = "center", .fallback = "0,0", .help = "Centre: x,y"}};

using Pair = std::array<double, 2>;

class CircleDomain final : public NamedDomain {
  public:
    CircleDomain(const Placement& at, std::string spec)
        : NamedDomain(std::move(spec), 2, 1),
          at_(at),
          slack_(8 * std::numeric_limits<double>::epsilon() *
                 (1 + std::max(std::abs(at.center.x), std::abs(at.center.y)) / at.size)) {}

    double measure() const override { return 2 * std::numbers::pi * at_.size; }

    /// Allows a distance of 8 epsilon (R + largest |c|), the rounding error of generated points.
    bool contains(std::span<const double> point) const override {
        const auto [x, y] = at_.to_frame(point[0], point[1]);
        return std::abs(std::sqrt(x * x + y * y) - 1) <= slack_;
    }
    Box bounding_box() const override {
        const auto [x, y] = at_.center;
        return {{x - at_.size, y - at_.size}, {x + at_.size, y + at_.size}};
    }
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const auto [x, y] = at_.to_frame(point[0], point[1]);
        cube[0] = turns_of(x, y);
    }
    std::optional<Moments> moments() const override {
        return placed_moments({.xx = 0.5, .yy = 0.5}, at_);
    }
    std::vector<std::string> cube_axes() const override { return {"angle in turns"}; }

  private:
    Placement at_;
    double slack_;
};

struct ByAngle {
    Placement at;

    Pair forward(const std::array<double, 1>& xi) const {
        const auto [c, s] = cos_sin_turns(xi[0]);
        const auto [x, y] = at.to_world({c, s});
        return {x, y};
    }
};

struct BySquare {
    static constexpr const char* no_way_back =
        "method square-normalize maps 2 coordinates to 1; it has no inverse";

    Placement at;

    static Pair scaled(const Pair& xi) { return {2 * xi[0] - 1, 2 * xi[1] - 1}; }
    Pair forward(const Pair& xi) const {
        const auto [u, v] = scaled(xi);
        const double size = std::sqrt(u * u + v * v);
        const double scale = 1 / (size > 0 ? size : 1);
        const auto [x, y] = at.to_world({u * scale, v * scale});
        return {x, y};
    }
    bool keeps(const Pair& xi) const {
        const auto [x, y] = scaled(xi);
        return x != 0 || y != 0;
    }
    double density(std::span<const double> point) const {
        const auto [x, y] = at.to_frame(point[0], point[1]);
        return 0.125 / (std::max(x * x, y * y) * at.size);
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const double r = want.options[radius];
    const auto center = want.options[middle];
    if (center.size() != 2)
        fail(ErrorKind::usage, "--center: expected 2 numbers, x,y; {} given", center.size());
    for (const double x : center) refuse_far(x, r);
    const Placement at{{center[0] + 0.0, center[1] + 0.0}, r};  // + 0.0 avoids -0 in the points
    const auto circle = std::make_shared<CircleDomain>(at, want.spec({radius.name, middle.name}));
    if (want.options[method] == "angle") return row_mapping(circle, ByAngle{at});
    return row_mapping(circle, BySquare{at});
}

}  // namespace

Warp unit() {
    return {.name = "circle",
            .summary = "Circle, directions in the plane (square-normalize is biased, to show it)",
            .source = "Devroye 1986, doi:10.1007/978-1-4613-8643-8, chapter V.4",
            .strata = "xi1 turns from the x axis towards the y axis; it is used directly",
            .traits = {.drops = true, .biased = true},
            .options = Schema(method, radius, middle),
            .mapping = make};
}

}  // namespace stipple::warps::circle
