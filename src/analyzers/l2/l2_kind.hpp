// SPDX-License-Identifier: MIT
//
// The kinds of L2 discrepancy, each by the kernel k that it has on every axis.
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyzers/l2/l2_plane.hpp"

namespace stipple::analyzers::l2 {

enum class Kind { star, extreme, periodic, centered, wraparound, mixture, modified, diaphony };

inline constexpr Kind all_kinds[] = {Kind::star,     Kind::extreme,    Kind::periodic,
                                     Kind::centered, Kind::wraparound, Kind::mixture,
                                     Kind::modified, Kind::diaphony};

/// The diaphony's kernel over the second Bernoulli polynomial.
inline constexpr double diaphony = 2 * std::numbers::pi * std::numbers::pi;

struct KindRecord {
    std::string_view name;
    AxisKernel kernel;  ///< k, or k / scale
    double scale = 1;
    bool projections = true;  ///< 1 + k on every axis, not k: all projections count
};

const KindRecord& record_of(Kind kind);

struct Square {
    double squared;
    double error;  ///< `squared` is off by at most this
};

/// @throws Error(limit) where sums on the way to a square were too large.
void require_finite(double squared, Kind kind, std::size_t dimension);

/// Of words separated by commas, each kind once and in the order of all_kinds; `all` is every kind.
/// @throws Error(usage) naming the word that is none
std::vector<Kind> parse_kinds(std::string_view words);

/// The squared discrepancy of a set on a line or in the plane from its exact projections.
/// @param weights of the axes, or none
double plane_square(const PlaneSums& sums, std::size_t dimension, Kind kind,
                    const std::vector<double>& weights);

}  // namespace stipple::analyzers::l2
