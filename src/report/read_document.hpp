// SPDX-License-Identifier: MIT
//
// The way back from the JSON that to_json of document.hpp writes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "report/document.hpp"

namespace stipple {

/// Whether the bytes are JSON of reports as far as their front tells: an object, or an array of
/// objects, that names the format.
bool looks_like_reports(std::string_view bytes);

/// The measurements of one report, of an array of them, or of several texts one after the other.
/// null is NaN. `source` is for messages.
/// @throws Error(input) for what is no such JSON, and for none at all.
std::vector<Measurement> read_reports(std::string_view bytes, const std::string& source);

}  // namespace stipple
