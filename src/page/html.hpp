// SPDX-License-Identifier: MIT
//
// A report as one page of HTML that needs nothing else: no network, no fonts, no scripts but its
// own. And the same content as JSON.
//
// Promise  the same content gives the same bytes; nothing of it depends on the time or the place.
#pragma once

#include <string>

#include "page/content.hpp"

namespace stipple::page {

std::string to_html(const Page& page);

/// {"format": "stipple.comparison", "version": 1, "sets": [...], "comparison": [...]}; numbers that
/// JSON cannot hold become null.
std::string to_json(const Page& page);

/// page.css and page.js.
const char* style_sheet();
const char* script();

}  // namespace stipple::page
