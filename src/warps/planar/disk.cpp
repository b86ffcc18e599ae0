// SPDX-License-Identifier: MIT
//
// Unit square onto a disk of radius R about a centre c, by one of four methods:
//
//     polar       r = R sqrt(xi0),  theta = 2 pi xi1
//     concentric  a = 2 xi0 - 1, b = 2 xi1 - 1;  r = R a, theta = (pi / 4) b / a where |a| > |b|,
//                 else r = R b, theta = pi / 2 - (pi / 4) a / b: concentric squares become circles
//     rejection   c + R (a, b), kept if a^2 + b^2 < 1: the share kept is pi / 4 = 0.785...
//     naive       r = R xi0,  theta = 2 pi xi1: BIASED towards the centre; kept to show the bias
//
// and back. The point is c + r (cos theta, sin theta).
//
// Shape   2 unit coordinates, 2 coordinates.
// Strata  xi0 is taken as it is, not as 1 - xi0: small xi0 is near the centre (polar, naive), left
//         (concentric, rejection). xi1 turns from the x axis towards the y axis (polar, naive).
//         polar makes rings of sectors of strata, concentric keeps neighbours neighbours, rejection
//         keeps the strata as they are and loses those outside.
// Cost    O(1) a point; about 5 ns forward, 9 ns back on one core.
// Promise density 1 / (pi R^2) for all but naive: 1 / (2 pi R r), infinite at the centre. Points
//         lie in the closed disk up to the rounding stated at contains(). Forward and back again is
//         the same point within 1e-14 of |c| + R; for c = 0 also the same xi within 1e-14, save
//         that all xi1 meet in the centre (polar, naive), which goes back to xi1 = 0. The same bits
//         on every machine.
// Source  Concentric: P. Shirley, K. Chiu, "A low distortion map between disk and square",
//         J. Graphics Tools 2(3) (1997) 45-52, doi:10.1080/10867651.1997.10487479.

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "core/error.hpp"
#include "core/spec.hpp"
#include "core/wide.hpp"
#include "math/geometry/disk_maps.hpp"
#include "math/geometry/law_moments.hpp"
#include "warps/inside.hpp"
#include "warps/planar/area_share.hpp"
#include "warps/warp.hpp"

namespace stipple::warps::disk {
namespace {

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "polar",
    .choices = "polar|concentric|rejection|naive",
    .help =
        "polar: rings and sectors; concentric: squares become circles, keeps neighbours; "
        "rejection: drops the points of the square that are outside; naive: r = R xi0, BIASED "
        "towards the centre, kept to show the bias"};

constexpr Param<double> radius{.name = "radius",
                               .fallback = 1,
                               .low = 1e-150,
                               .high = 1e150,
                               .help = "Radius of the disk, above 0"};

constexpr Param<Numbers> center{
    {.name = "center", .fallback = "0,0", .help = "Centre of the disk: x,y"}};

const Schema& schema() {
    static const Schema options(method, radius, center);
    return options;
}

class DiskDomain final : public Domain, public Weighable {
  public:
    DiskDomain(double r, PlanePoint c) : radius_(r), center_(c) {
        constexpr double epsilon = std::numeric_limits<double>::epsilon();
        const double reach = r + 8 * epsilon * (r + std::abs(c.x) + std::abs(c.y));
        reach_squared_ = reach * reach;
    }

    std::string spec() const override {
        Values values = schema().defaults();
        values.put(radius.name, radius_);
        values.put(center.name, std::vector{center_.x, center_.y});
        return format_spec("disk", values, schema());
    }
    std::size_t dimension() const override { return 2; }
    double measure() const override { return std::numbers::pi * radius_ * radius_; }

    /// Up to 8 epsilon (R + |cx| + |cy|) beyond the rim: the rounding of a point that was made.
    bool contains(std::span<const double> point) const override {
        const double x = point[0] - center_.x;
        const double y = point[1] - center_.y;
        return x * x + y * y <= reach_squared_;
    }

    Box bounding_box() const override {
        return {{center_.x - radius_, center_.y - radius_},
                {center_.x + radius_, center_.y + radius_}};
    }

    /// r^2 / R^2 and the angle in turns: equal areas however the points were made.
    void to_cube(std::span<const double> point, std::span<double> cube) const override {
        const auto [x, y] = in_unit_disk(point);
        cube[0] = std::min(x * x + y * y, 1.0);
        cube[1] = turns_of(x, y);
    }
    Estimate box_mass(const Box& box) const override {
        return area_share(box, *this, [&](const stipple::Polygon& window) {
            return area_in_disk(window, {center_.x, center_.y}, radius_);
        });
    }
    std::optional<Moments> moments() const override {
        return placed_moments({.xx = 0.25, .yy = 0.25}, {center_, radius_});
    }
    std::vector<std::string> cube_axes() const override {
        return {"area fraction r^2/R^2", "angle in turns"};
    }

    /// The point where centre and radius are 0 and 1.
    PlanePoint in_unit_disk(std::span<const double> point) const {
        return {(point[0] - center_.x) / radius_, (point[1] - center_.y) / radius_};
    }

    double size() const { return radius_; }
    PlanePoint middle() const { return center_; }

  private:
    double radius_;
    PlanePoint center_;
    double reach_squared_;
};

// The methods on the unit disk: xi to point, point to xi, density from r^2 > 0.

struct Polar : PolarDisk {
    static double density(double /*rr*/) { return std::numbers::inv_pi; }
};

struct Naive {
    static PlanePoint forward(double u, double v) {
        const auto [c, s] = cos_sin_turns(v);
        return {u * c, u * s};
    }
    static PlanePoint inverse(double x, double y) {
        return {std::sqrt(x * x + y * y), turns_of(x, y)};
    }
    static double density(double rr) { return 0.5 * std::numbers::inv_pi / std::sqrt(rr); }
};

struct Concentric : ConcentricDisk {
    static double density(double /*rr*/) { return std::numbers::inv_pi; }
};

struct Rejection {
    static PlanePoint forward(double u, double v) { return {2 * u - 1, 2 * v - 1}; }
    static PlanePoint inverse(double x, double y) { return {0.5 + 0.5 * x, 0.5 + 0.5 * y}; }
    static double density(double /*rr*/) { return std::numbers::inv_pi; }
};

template <class Method>
STIPPLE_WIDE void map_rows(std::span<const double> cube, std::span<double> image, double r,
                           PlanePoint c) {
    for (std::size_t i = 0; i + 1 < cube.size(); i += 2) {
        const auto [x, y] = Method::forward(cube[i], cube[i + 1]);
        image[i] = c.x + r * x;
        image[i + 1] = c.y + r * y;
    }
}

template <class Method>
STIPPLE_WIDE void unmap_rows(std::span<const double> image, std::span<double> cube, double r,
                             PlanePoint c) {
    for (std::size_t i = 0; i + 1 < image.size(); i += 2) {
        const auto [u, v] = Method::inverse((image[i] - c.x) / r, (image[i + 1] - c.y) / r);
        cube[i] = std::max(0.0, std::min(u, 1.0));
        cube[i + 1] = std::max(0.0, std::min(v, 1.0));
    }
}

template <class Method>
class Disk final : public Mapping {
  public:
    Disk(double r, PlanePoint c) : disk_(std::make_shared<DiskDomain>(r, c)) {}

    DomainPtr domain() const override { return disk_; }
    std::size_t cube_dimension() const override { return 2; }

    void forward(std::span<const double> cube, std::span<double> image,
                 std::span<std::uint8_t> keep) const override {
        map_rows<Method>(cube, image, disk_->size(), disk_->middle());
        if constexpr (std::is_same_v<Method, Rejection>) {
            for (std::size_t i = 0; i < keep.size(); ++i) {
                const auto [x, y] = Method::forward(cube[2 * i], cube[2 * i + 1]);
                keep[i] = x * x + y * y < 1;
            }
        }
    }

    bool drops() const override { return std::is_same_v<Method, Rejection>; }

    void inverse(std::span<const double> image, std::span<double> cube) const override {
        expect_inside(*disk_, image);
        unmap_rows<Method>(image, cube, disk_->size(), disk_->middle());
    }

    double density(std::span<const double> point) const override {
        if (!disk_->contains(point)) return 0;
        const auto [x, y] = disk_->in_unit_disk(point);
        return Method::density(x * x + y * y) / disk_->size() / disk_->size();
    }

  private:
    std::shared_ptr<const DiskDomain> disk_;
};

std::unique_ptr<Mapping> make(const Values& options, std::size_t /*given*/,
                              const RunContext& /*run*/) {
    const double r = options[radius];
    const auto at = options[center];
    if (at.size() != 2)
        fail(ErrorKind::usage, "--center: 2 numbers are needed, x,y; {} given", at.size());
    for (const double x : at)
        if (x + r == x || x - r == x)
            fail(ErrorKind::usage, "--center: {} is so far that a radius of {} is lost in rounding",
                 x, r);
    const PlanePoint c{at[0] + 0.0, at[1] + 0.0};  // -0 would show in points
    const std::string how = options[method];
    if (how == "concentric") return std::make_unique<Disk<Concentric>>(r, c);
    if (how == "rejection") return std::make_unique<Disk<Rejection>>(r, c);
    if (how == "naive") return std::make_unique<Disk<Naive>>(r, c);
    return std::make_unique<Disk<Polar>>(r, c);
}

}  // namespace

Warp unit() {
    return {.name = "disk",
            .summary = "Disk, uniform by area (but method naive: biased, kept to show its bias)",
            .source = "Shirley, Chiu 1997, doi:10.1080/10867651.1997.10487479 (concentric)",
            .strata =
                "polar: xi1 is the share of the area within the radius, xi2 the angle, both as "
                "they are; concentric: squares about the centre become rings, left stays left",
            .traits = {.invertible = true, .drops = true, .biased = true},
            .options = schema(),
            .aliases = {"disc"},
            .make = make};
}

}  // namespace stipple::warps::disk
