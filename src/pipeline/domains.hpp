// SPDX-License-Identifier: MIT
//
// Domains of rows whose coordinates are on several: their texts, their factors, and densities on them.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/domain.hpp"
#include "core/point_set.hpp"
#include "core/spec.hpp"
#include "warps/warp.hpp"

namespace stipple {

/// Prefix of a provenance's entry for a warp whose inverse was applied.
inline constexpr std::string_view inverse_of = "inverse ";

/// The coordinates 0, 1, ... of a row.
std::vector<std::size_t> all_coordinates(std::size_t dimension);

/// Coordinates of a row of `width` numbers that are not in `taken`, in order.
std::vector<std::size_t> other_coordinates(std::size_t width, std::span<const std::size_t> taken);

/// The coordinates that a spec names, or all.
std::vector<std::size_t> named_or_all(const Spec& spec, std::size_t dimension);

/// The product of factors and of the unit cube in all other coordinates.
DomainPtr filled_up(std::vector<Factor> factors, std::size_t dimension);

/// Factors of a domain except those of the unit cube. The axes of a box are factors of their own,
/// those `boxless` left out.
std::vector<Factor> warped_factors(const DomainPtr& domain,
                                   std::span<const std::size_t> boxless = {});

/// The domain that a text means: unit-cube, box:bounds=[lo..hi,...], a warp's spec, or several with
/// coordinates joined by " x ". @throws Error(usage)
DomainPtr parse_domain(std::string_view text, std::size_t dimension, const RunContext& run = {});

/// Multiplies by the density of each row's `coordinates`, which are on a domain: that of the mapping
/// that made them or, if there is none, the domain's.
void multiply_densities(std::span<double> densities, std::span<const double> rows,
                        std::span<const std::size_t> coordinates, const Domain& domain,
                        const Mapping* mapping);

/// Density of each point where the set's provenance names a warp whose points do not have that of
/// the domain; empty where it names none. Tells the user where it is not known.
std::vector<double> biased_densities(const PointSet& points, const RunContext& run);

}  // namespace stipple
