// SPDX-License-Identifier: MIT
//
// Reading and writing a header and one point per line, shared by csv and tsv.
#pragma once

#include "io/format.hpp"

namespace stipple::io {

/// Adds the functions that read any separator, and write commas or tabs.
Format separated_values(Format format, bool tabs);

}  // namespace stipple::io
