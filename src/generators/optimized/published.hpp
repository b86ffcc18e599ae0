// SPDX-License-Identifier: MIT
//
// Published star discrepancies of point sets in the plane.
//
// Source  [1] F. Clement, C. Doerr, K. Klamroth, L. Paquete, arXiv:2311.17463: proven optima;
//         [2] the same, arXiv:2407.11533; [3] T. K. Rusch, N. Kirk, M. M. Bronstein, C. Lemieux,
//         D. Rus, arXiv:2405.15059.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace stipple::optimized {

struct PublishedStar {
    std::uint64_t count;
    double value;  ///< rounded to the digits given here
    bool optimal;  ///< whether it is proven to be optimal
    std::string_view source() const {
        return optimal ? "arXiv:2311.17463" : "arXiv:2311.17463, 2405.15059, 2407.11533";
    }
};

inline constexpr std::array published_stars = std::to_array<PublishedStar>(
    {{1, .6180, true},      {2, .3660, true},      {3, .2847, true},      {4, .2500, true},
     {5, .2000, true},      {6, .1667, true},      {7, .1500, true},      {8, .1328, true},
     {9, .1235, true},      {10, .1111, true},     {11, .1030, true},     {12, .0952, true},
     {13, .0889, true},     {14, .0837, true},     {15, .0782, true},     {16, .0739, true},
     {20, .0604, true},     {30, .04240, false},   {40, .03313, false},   {50, .027415, false},
     {60, .022887, false},  {80, .017827, false},  {100, .014916, false}, {140, .010963, false},
     {180, .009011, false}, {200, .008109, false}, {260, .006399, false}, {300, .007407, false},
     {380, .006375, false}, {420, .005625, false}, {500, .005086, false}, {580, .003772, false},
     {660, .003600, false}, {780, .003104, false}, {900, .002957, false}, {1020, .002450, false}});

/// Least published value for `count` points; nullopt if the table has none.
inline std::optional<PublishedStar> published_star(std::uint64_t count, std::size_t dimension) {
    const auto* const found = std::ranges::find(published_stars, count, &PublishedStar::count);
    if (dimension != 2 || found == published_stars.end()) return {};
    return *found;
}

}  // namespace stipple::optimized
