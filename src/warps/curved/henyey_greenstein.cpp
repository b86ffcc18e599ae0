// SPDX-License-Identifier: MIT
//
// Unit square onto directions scattered about an axis by the phase function of Henyey and
// Greenstein, whose mean cosine is g:
//
//     density (1 - g^2) / (4 pi (1 + g^2 - 2 g cos theta)^(3/2))
//
// The cone within theta about the axis has the probability u = xi0. With w = 1 - u and
// D = (1 + g) w + (1 - g) u,
//
//     1 - cos theta = 2 (1 - g)^2 u ((1 + g) w + u) / D^2
//     1 + cos theta = 2 (1 + g)^2 w ((1 - g) u + w) / D^2,      longitude 2 pi xi1,
//
// This is the usual inverse, factored into sums of positive numbers: g = 0 is no special case, and
// no digits are lost at either pole.
//
// Shape   2 unit coordinates; 3 coordinates, a unit vector. g > 0 scatters forward, along the axis.
// Strata  xi0 is used directly, not as 1 - xi (textbooks do both): 0 is the axis, small xi0 are
//         near it. xi1 turns about the axis; for +z from x towards y. Strata become sectors of
//         rings.
// Cost    O(1) a point; on one core about 7 ns forward, 25 ns inverse.
// Promise unit vectors up to 8 epsilon. A round trip returns the same vector within 1e-14 and,
//         except at the poles, the same xi within 1e-13; 1e-12 about oblique axes. The same bits on
//         every machine.
// Source  L. G. Henyey, J. L. Greenstein, "Diffuse radiation in the Galaxy", Astrophysical J. 93
//         (1941) 70-83, doi:10.1086/144246.

#include "warps/curved/lobe.hpp"
#include "warps/curved/placement.hpp"

namespace stipple::warps::henyey_greenstein {
namespace {

constexpr Param<double> asymmetry{
    .name = "g",
    .fallback = 0.5,
    .low = -0.999999,
    .high = 0.999999,
    .help = "Mean cosine of the angle from the axis: above 0 scatters forward, below 0 backward"};

struct Phase {
    static constexpr bool hemisphere = false;
    double g;

    CosSin forward(double u) const {
        const double rest = 1 - u;
        const double below = (1 + g) * rest + (1 - g) * u;
        const double near = (1 - g) / below;
        const double far = (1 + g) / below;
        const double v = 2 * near * near * (u * ((1 + g) * rest + u));
        const double c = 2 * far * far * (rest * ((1 - g) * u + rest));
        const double small = std::min(v, c);
        return {v < c ? 1 - small : small - 1, std::sqrt(small * (2 - small))};
    }

    /// sqrt(1 + g^2 - 2 g cos theta). @param v, c 1 - cos theta and 1 + cos theta
    double distance(double v, double c) const {
        const double square = g > 0 ? (1 - g) * (1 - g) + 2 * g * v : (1 + g) * (1 + g) - 2 * g * c;
        return std::sqrt(square);
    }
    double fraction(const Vector3& w) const {
        const double v = one_minus_cos(w);
        const double c = one_plus_cos(w);
        const double t = distance(v, c);
        const double near = (1 + g) * v / (t * (t + (1 - g)));
        const double far = (1 - g) * c / (t * (t + (1 + g)));
        return near < 0.5 ? near : 1 - far;
    }
    /// The mean of the Legendre polynomial P_l of the cosine is g^l.
    AxialMoments moments() const {
        const double rest = (1 - g) * (1 + g);
        return {.along = {g, rest / 3, -0.4 * g * rest},
                .across = rest / 3,
                .across_along = -2 / 15.0 * g * rest};
    }
    double density(const Vector3& w) const {
        const double t = distance(one_minus_cos(w), one_plus_cos(w));
        return (1 - g) * (1 + g) / (4 * std::numbers::pi * t * t * t);
    }
};

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    return lobe_mapping(Phase{want.options[asymmetry]}, frame_of(want.options), want.spec());
}

}  // namespace

Warp unit() {
    return {.name = "henyey-greenstein",
            .summary = "Directions about an axis with the phase function of Henyey and Greenstein",
            .source = "Henyey, Greenstein 1941, doi:10.1086/144246",
            .strata =
                "xi1 is the probability of the cone about the axis, 0 on the axis; xi2 turns about "
                "the axis; both are used directly",
            .options = Schema(asymmetry, axis_option),
            .mapping = make};
}

}  // namespace stipple::warps::henyey_greenstein
