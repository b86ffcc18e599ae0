// SPDX-License-Identifier: MIT
//
// A report as one self-contained HTML page: no network access, no fonts, no external scripts. Also
// the same content as JSON.
//
// Promise  the same content gives the same bytes, regardless of time and machine.
#pragma once

#include <string>

#include "page/content.hpp"

namespace stipple::page {

std::string to_html(const Page& page);

/// {"format": "stipple.comparison", "version": 1, "sets": [...], "comparison": [...]}; infinities
/// and NaN become null.
std::string to_json(const Page& page);

/// The text of page.css; script() returns that of page.js.
const char* style_sheet();
const char* script();

}  // namespace stipple::page
