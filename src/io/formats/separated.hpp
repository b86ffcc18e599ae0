// SPDX-License-Identifier: MIT
//
// Reading and writing a header and one point per line, shared by csv and tsv.
#pragma once

#include "io/format.hpp"

namespace stipple::io {

/// Adds functions to `format`: they read any separator, and write tabs if `tabs`, else commas.
Format separated_values(Format format, bool tabs);

}  // namespace stipple::io
