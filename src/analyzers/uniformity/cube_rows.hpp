// SPDX-License-Identifier: MIT
//
// Points as points of the cube of their domain, on which what is uniform there is uniform here.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "analyzers/outside.hpp"
#include "core/domain.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers {

/// @throws Error(input) where the domain's coordinates do not preserve probability
void require_even(const Domain& domain, std::string_view analyzer);

/// Adds "axes" with the names of the cube's axes, where they are more than x1, x2, ...
void tell_axes(const Domain& domain, Report& report);

/// Coordinates of the cube for points of which the first is point `first`; those outside the domain
/// are counted, and get numbers that mean nothing.
std::vector<double> cube_rows(const Domain& domain, std::span<const double> rows,
                              std::uint64_t first, Outside& outside, const RunContext& run);

}  // namespace stipple::analyzers
