// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "cli/parsing/arguments.hpp"

namespace stipple::cli {

/// What --help says for the program, a verb, or a unit of a verb; made from the records.
std::string help_text(const Arguments& arguments, const std::vector<Kind>& kinds);

/// stipple and the libraries it is linked with.
std::string version_text();

}  // namespace stipple::cli
