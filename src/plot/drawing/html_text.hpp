// SPDX-License-Identifier: MIT
//
// Text and bytes as they stand in HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace stipple::plot {

/// Text between tags: UTF-8 without control characters.
std::string xml_text(std::string_view text);

/// The same, also for an attribute in double quotes.
std::string html_text(std::string_view text);

/// RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace stipple::plot
