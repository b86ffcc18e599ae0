// SPDX-License-Identifier: MIT
//
// Unit cube onto the whole line, each coordinate independently, by inversion:
//
//     x = location + scale t,    P(T > t) = I_z(nu / 2, 1 / 2) / 2,    z = nu / (nu + t^2)
//     for nu degrees of freedom; nu = 1 is Cauchy's distribution
//
// Shape   any number of coordinates; each parameter is one number for all of them, or one for each.
// Strata  xi is used directly, not as 1 - xi: strata become intervals of equal probability, in
//         order. The first and the last are unbounded; 0 is replaced by 2^-54 and 1 by 1 - 2^-55.
// Cost    O(1) a coordinate; about 4 us on one core.
// Promise quantiles within a relative 1e-13 in both tails. The same bits on every machine for the
//         same release of Boost, whose functions are computed through math/functions.

#include "warps/marginal_mapping.hpp"

namespace stipple::warps::student_t {

Warp unit() {
    return {.name = "student-t",
            .summary = "Student's t distribution on each coordinate, by inversion",
            .source = "Inverse of the regularised incomplete beta function",
            .related = {"cauchy"},
            .strata = "xi is the probability below x, used directly: small xi is far below",
            .options = Schema(parameter("student-t", "degrees"), parameter("student-t", "location"),
                              parameter("student-t", "scale")),
            .stream_version = 2,
            .mapping = family_mapping};
}

}  // namespace stipple::warps::student_t
