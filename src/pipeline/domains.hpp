// SPDX-License-Identifier: MIT
//
// Product domains, whose coordinates belong to several factors: parsing, factors, and densities.
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

/// All coordinates of a row: 0, 1, ..., dimension - 1.
std::vector<std::size_t> all_coordinates(std::size_t dimension);

/// Coordinates of a row of `width` numbers that are not in `taken`, in order.
std::vector<std::size_t> other_coordinates(std::size_t width, std::span<const std::size_t> taken);

/// The coordinates that a spec names, or all.
std::vector<std::size_t> named_or_all(const Spec& spec, std::size_t dimension);

/// Product of the factors and, in all other coordinates, of the unit cube.
DomainPtr filled_up(std::vector<Factor> factors, std::size_t dimension);

/// Factors of a domain, without those that are unit cubes. A box is split into one factor per axis;
/// its axes in `boxless` are omitted.
std::vector<Factor> warped_factors(const DomainPtr& domain,
                                   std::span<const std::size_t> boxless = {});

/// Parses the factors of a domain, separated by " x ". A factor that names no coordinates gets all
/// `dimension` coordinates, even if it has another dimension. @throws Error(usage)
std::vector<Factor> parse_factors(std::string_view text, std::size_t dimension,
                                  const RunContext& run = {});

/// Parses a domain: unit-cube, box:bounds=[lo..hi,...], a warp's spec, or several of these with
/// coordinates, joined by " x ".
/// @throws Error(usage); Error(input) if it does not fit points of this dimension
DomainPtr parse_domain(std::string_view text, std::size_t dimension, const RunContext& run = {});

/// Multiplies each row's density by the density at its `coordinates`: that of the mapping or, if
/// `mapping` is null, the uniform density of `domain`.
void multiply_densities(std::span<double> densities, std::span<const double> rows,
                        std::span<const std::size_t> coordinates, const Domain& domain,
                        const Mapping* mapping);

/// Density at each point, if a warp in the set's provenance makes points that are not uniform on
/// their domain; empty if there is no such warp. Warns if the density is not known.
std::vector<double> biased_densities(const PointSet& points, const RunContext& run);

}  // namespace stipple
