// SPDX-License-Identifier: MIT
//
// Latin hypercubes with parts that are Latin hypercubes of fewer strata, computed point by point.
//
//     sliced   n = m K points in K slices, one after the other. In coordinate k, point j of slice s
//              is in the stratum  K c + phi_kc(s)  of n,  c = pi_ks(j)  being its stratum of m; pi
//              and phi are independent random permutations, of m strata and of K slices.
//     nested   the first N1 of n = N1 t points. In coordinate k they are in the strata
//              t c + o_kc,  c = pi_k(i),  with random o in {0, ..., t - 1}; the other points are in
//              the remaining strata, in random order.
//
// Promise  whole and parts are Latin hypercubes for every seed.
// Cost     O(1) a coordinate of a point, in constant memory.
// Source   P. Z. G. Qian, J. Amer. Statist. Assoc. 107 (2012) 393-399,
//          doi:10.1080/01621459.2011.644132 (sliced); P. Z. G. Qian, Biometrika 96 (2009) 957-970,
//          doi:10.1093/biomet/asp045 (nested).
#pragma once

#include "generators/stratified/stratified.hpp"

namespace stipple::generators {

/// @param slices divides the plan's count
StrataOf sliced_strata(const Plan& plan, std::uint64_t slices);

/// @param first divides the plan's count
StrataOf nested_strata(const Plan& plan, std::uint64_t first);

}  // namespace stipple::generators
