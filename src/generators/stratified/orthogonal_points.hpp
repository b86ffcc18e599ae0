// SPDX-License-Identifier: MIT
//
// Orthogonal arrays of strength t with s levels, s^t rows and index 1, and points from them: in any
// t columns, each t-tuple of levels is in exactly one row.
//
//     polynomials  for prime s. With the base-s digits a_0, a_1, ..., a_(t-1) of i, row i has the
//                  values modulo s of  a_0 + a_1 x + ... + a_(t-1) x^(t-1)  at
//                  x = 0, infinity (that is a_(t-1)), 1, 2, ..., s - 1: up to s + 1 columns
//     digits       for any s. Row i has these t digits themselves: the whole grid
//
// The levels of a column are permuted at random. Each of the s levels is a stratum of width 1/s. It
// is divided further, so that each of the n points has its own stratum of width 1/n along every
// coordinate:
//
//     none         no division
//     independent  the points of a level are in random order, independently for every level
//                  (Tang's Latin hypercubes; multi-jittered)
//     shared       the points of a level are ordered by the levels of the other columns, permuted
//                  the same way for every level (correlated multi-jittered)
//
// Cost    O(n d t).
// Source  R. C. Bose, Sankhya 3 (1938) 323-338; K. A. Bush, Ann. Math. Stat. 23 (1952) 426-434,
//         doi:10.1214/aoms/1177729387; B. Tang, J. Amer. Stat. Assoc. 88 (1993) 1392-1397,
//         doi:10.1080/01621459.1993.10476423; W. Jarosz et al., Comput. Graph. Forum 38 (4) (2019)
//         135-147, doi:10.1111/cgf.13777.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "generators/stratified/stratified.hpp"

namespace stipple::generators {

enum class Columns { polynomials, digits };
enum class Substrata { none, independent, shared };

/// Size of an orthogonal array, and the rule for its columns.
struct ArrayShape {
    std::uint64_t levels;
    std::size_t strength;
    Columns columns;
};

std::unique_ptr<Sequence> orthogonal_points(const Plan& plan, const StratifiedStyle& style,
                                            const ArrayShape& shape, Substrata substrata);

/// Prime p with p^strength == count. @throws Error(usage) naming the two nearest such counts
std::uint64_t prime_root(std::uint64_t count, std::size_t strength, const std::string& who);

/// Plan for points from arrays by polynomials. The default count is near 1024, or higher if the
/// dimension needs more levels.
/// @throws Error(usage)
Plan plan_by_polynomials(const Request& request, std::size_t strength, const std::string& who);

}  // namespace stipple::generators
