// SPDX-License-Identifier: MIT
//
// Encoding of text and bytes for HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace stipple::plot {

/// Escapes text between tags; the result is valid UTF-8 without control characters.
std::string xml_text(std::string_view text);

/// As xml_text(), and escapes double quotes, for attributes.
std::string html_text(std::string_view text);

/// Base64 encoding (RFC 4648).
std::string base64(std::string_view bytes);

}  // namespace stipple::plot
