// SPDX-License-Identifier: MIT
//
// Unit square onto the directions w within a right angle of an axis n, by one of three densities in
// solid angle, with cos theta = w . n:
//
//     uniform       1 / (2 pi)                            cos theta = 1 - xi0
//     cosine        cos theta / pi                        sin^2 theta = xi0
//     cosine-power  (k + 1) cos^k theta / (2 pi)          cos theta = (1 - xi0)^(1 / (k + 1))
//
// with longitude 2 pi xi1. Cosine may also use Shirley and Chiu's concentric disk (--disk
// concentric): lifting any uniform disk onto the sphere gives the cosine density (Malley).
//
// Shape   2 unit coordinates; 3 coordinates, of unit length.
// Strata  xi0 increases from 0 on the axis to 1 at the horizon; xi1 turns from x towards y if the
//         axis is z. xi are used directly, not as 1 - xi. Strata become rectangles of heights and
//         longitudes; --disk concentric keeps neighbours adjacent.
// Cost    O(1) a point; on one core about 6 ns forward, 35 ns inverse; cosine-power 11 and 70.
// Promise a round trip returns the same direction within 1e-14; if the axis is z, also the same xi
//         within 1e-14, except that the axis returns xi1 = 0. The same bits on every machine.
// Beware  given directions near the horizon have an inverse xi0 rounded next to 1, which maps to a
//         height of the square root of that error: 1e-8.
// Source  P. Shirley, K. Chiu, J. Graphics Tools 2(3) (1997) 45-52,
//         doi:10.1080/10867651.1997.10487479 (concentric); T. Malley, M.Sc. thesis, University of
//         Utah (1988).

#include <numbers>

#include "math/functions/exponential.hpp"
#include "math/functions/logarithm.hpp"
#include "math/geometry/disk_maps.hpp"
#include "warps/curved/lobe.hpp"
#include "warps/curved/placement.hpp"

namespace stipple::warps::hemisphere {
namespace {

constexpr Param<Choice> method{
    .name = "method",
    .fallback = "uniform",
    .choices = "uniform|cosine|cosine-power",
    .help =
        "Density in solid angle: uniform; cosine: proportional to the cosine of the angle from the "
        "axis, as diffuse light; cosine-power: to its power --exponent, as a glossy lobe"};

constexpr Param<double> exponent{
    .name = "exponent",
    .fallback = 10,
    .low = 0,
    .high = 1e6,
    .help = "Exponent of method cosine-power: 0 is uniform, 1 is cosine"};

constexpr Param<Choice> disk_map{.name = "disk",
                                 .fallback = "polar",
                                 .choices = "polar|concentric",
                                 .help =
                                     "For method cosine: map from the square to the disk that is "
                                     "projected up to the hemisphere"};

/// Density proportional to cos^k of the angle from the axis, and the probability of directions
/// nearer to the axis than a given one. Directions are in the frame of the axis.
struct CosineLaw {
    static constexpr bool hemisphere = true;
    double power;

    double density(const Vector3& v) const {
        const double z = std::clamp(v[2], 0.0, 1.0);
        return (power + 1) * 0.5 * std::numbers::inv_pi * real_power(z, power);
    }

    double fraction(const Vector3& v) const {
        const double rr = v[0] * v[0] + v[1] * v[1];
        const double zz = v[2] * v[2];
        if (power == 0) return one_minus_cos(v);
        if (power == 1) return rr < zz ? rr / (rr + zz) : 1 - zz / (rr + zz);
        if (!(v[2] > 0)) return 1;
        const double log = rr < zz ? 0.5 * log_1p(0 - rr / (rr + zz)) : logarithm(v[2]);
        return 0 - exp_minus_1((power + 1) * log);
    }

    /// The height z = u^(1/p), p = k + 1, has the distribution Beta(p, 1).
    AxialMoments moments() const {
        const double p = power + 1;
        const double all = (p + 1) * (p + 2) * (p + 3);
        return {.along = {p / (p + 1), p / ((p + 1) * (p + 1) * (p + 2)),
                          2 * p * (1 - p) / ((p + 1) * (p + 1) * all)},
                .across = 1 / (p + 2),
                .across_along = -p / all};
    }
    bool level() const { return power == 0; }
};

struct Uniform {
    Frame frame;

    Vector3 forward(const std::array<double, 2>& xi) const {
        return frame.out(polar_direction(xi[0], 1 + (1 - xi[0]), xi[1]));
    }
};

struct Cosine {
    Frame frame;

    Vector3 forward(const std::array<double, 2>& xi) const {
        const auto [x, y] = PolarDisk::forward(xi[0], xi[1]);
        return frame.out({x, y, std::sqrt(1 - xi[0])});
    }
};

struct CosinePower {
    Frame frame;
    double power;

    Vector3 forward(const std::array<double, 2>& xi) const {
        const double u = std::min(xi[0], one_minus_ulp);
        const double log = log_1p(0 - u) / (power + 1);  // logarithm of cos theta
        const double less = xi[0] < 1 ? exp_minus_1(log) : -1;
        const double z = 1 + less;
        const double r = std::sqrt(0 - less * (1 + z));
        const auto [c, s] = cos_sin_turns(xi[1]);
        return frame.out({r * c, r * s, z});
    }
};

struct CosineConcentric {
    Frame frame;

    Vector3 forward(const std::array<double, 2>& xi) const {
        const auto [x, y] = ConcentricDisk::forward(xi[0], xi[1]);
        const double r = std::max(std::abs(2 * xi[0] - 1), std::abs(2 * xi[1] - 1));
        return frame.out({x, y, std::sqrt((1 - r) * (1 + r))});
    }

    /// Inverse of the concentric disk map, except that the radius is computed from the height,
    /// which is more accurate near the horizon.
    std::array<double, 2> inverse(std::span<const double> point) const {
        const auto [x, y, z] = frame.in(vector_of(point));
        const bool wide = std::abs(x) > std::abs(y);
        const double along = wide ? x : y;
        const double across = wide ? y : x;
        const double rr = x * x + y * y;
        const double zz = z * z / (rr + z * z);
        const double size = rr < z * z ? std::sqrt(rr) : 1 - zz / (1 + std::sqrt(1 - zz));
        const double eighths = 8 * turns_of(std::abs(along), std::abs(across));
        // Keeps xi below 1 for directions above the horizon, since xi = 1 would map onto it.
        const double last = size < 1 ? one_minus_ulp : 1;
        const double first = std::min(0.5 + 0.5 * std::copysign(size, along), last);
        const double second = std::min(0.5 + 0.5 * std::copysign(size * eighths, across), last);
        return {wide ? first : second, wide ? second : first};
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const Frame frame = frame_of(want.options);
    const std::string how = want.options[method];
    const bool powered = how == "cosine-power";
    const CosineLaw law{powered ? want.options[exponent] : (how == "cosine" ? 1.0 : 0.0)};
    std::string spec = powered ? want.spec({method.name, exponent.name, axis_option.name})
                               : want.spec({method.name, axis_option.name});
    const auto domain = std::make_shared<LobeDomain<CosineLaw>>(law, frame, std::move(spec));
    if (powered) return row_mapping(domain, CosinePower{frame, law.power});
    if (how == "uniform") return row_mapping(domain, Uniform{frame});
    if (want.options[disk_map] == "polar") return row_mapping(domain, Cosine{frame});
    return row_mapping(domain, CosineConcentric{frame});
}

}  // namespace

Warp unit() {
    return {
        .name = "hemisphere",
        .summary = "Directions of a hemisphere, uniform or weighted by a power of the cosine",
        .source =
            "Shirley, Chiu 1997, doi:10.1080/10867651.1997.10487479 (concentric); Malley "
            "1988 (cosine from a disk)",
        .related = {"cosine-hemisphere", "lambert", "cosine"},
        .strata =
            "xi1 is the probability from 0 on the axis to 1 at the horizon; xi2 is the longitude; "
            "with --disk concentric, squares about the centre become rings; all are used directly",
        .options = Schema(method, exponent, axis_option, disk_map, orientation),
        .mapping = make};
}

}  // namespace stipple::warps::hemisphere
