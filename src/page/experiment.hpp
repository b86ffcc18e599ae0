// SPDX-License-Identifier: MIT
//
// Named parameters on a report page.
#pragma once

#include <string>
#include <vector>

#include "core/point_set.hpp"

namespace stipple::page {

/// Whether a domain's spec is that of named parameters.
bool is_experiment(const std::string& domain);

/// Whether each coordinate of points is a parameter on a log scale, or log-uniform.
std::vector<bool> log_axes(const PointSet& points);

/// The unit of each coordinate; empty if it is not a parameter with a unit.
std::vector<std::string> units_of(const PointSet& points);

/// Table of the parameters: names, units and possible values; followed by their constraints and
/// correlations. Empty for domains without parameters.
std::string parameter_table(const std::string& domain);

}  // namespace stipple::page
