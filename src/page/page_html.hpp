// SPDX-License-Identifier: MIT
//
// A report as one page of HTML that needs nothing else: no network, no fonts, no scripts but its
// own. And the same content as JSON.
//
// Promise  the same content gives the same bytes; nothing of it depends on the time or the place.
#pragma once

#include <span>
#include <string>

#include "page/page_content.hpp"

namespace stipple {

inline constexpr std::size_t most_page_sets = 12;  ///< as many as there are colours

struct Page {
    std::string title;
    std::string version;  ///< of stipple
    std::string command;  ///< that makes the page
    std::vector<PageSet> sets;
};

std::string page_html(const Page& page);

/// {"format": "stipple.comparison", "version": 1, "sets": [...], "comparison": [...]}; numbers that
/// JSON cannot hold become null.
std::string page_json(const Page& page);

/// Sentences on what keeps the sets from being compared as they are: different n, domains.
std::vector<std::string> page_notes(std::span<const PageSet> sets);

/// The page's style sheet and its script.
const char* page_style();
const char* page_script();

}  // namespace stipple
