// SPDX-License-Identifier: MIT
//
// Text and bytes as they stand in a page of HTML.
#pragma once

#include <string>
#include <string_view>

namespace stipple {

/// Text between tags or in an attribute's double quotes: UTF-8 without control letters.
std::string html_text(std::string_view text);

/// JSON as it may stand within a script element, which a "</script" in a string would end.
std::string html_json(std::string_view json);

/// RFC 4648.
std::string base64(std::string_view bytes);

}  // namespace stipple
