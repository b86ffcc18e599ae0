// SPDX-License-Identifier: MIT
//
// Named parameters on a page.
#pragma once

#include <string>
#include <vector>

namespace stipple::page {

/// Whether a domain's spec is that of named parameters.
bool is_experiment(const std::string& domain);

/// Names of the parameters on a log scale; empty for other domains.
std::vector<std::string> log_parameters(const std::string& domain);

/// Table of the parameters: names, units and possible values; followed by their constraints and
/// correlations. Empty for other domains.
std::string parameter_table(const std::string& domain);

}  // namespace stipple::page
