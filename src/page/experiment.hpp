// SPDX-License-Identifier: MIT
//
// Named parameters as a page shows them.
#pragma once

#include <string>

namespace stipple::page {

/// Whether a domain, as a spec, is of named parameters, each of which may have a unit of its own.
bool is_experiment(const std::string& domain);

/// A table of them: names, units, and which numbers or words each takes; and what holds of all of them
/// together. Empty for other domains.
std::string parameter_table(const std::string& domain);

}  // namespace stipple::page
