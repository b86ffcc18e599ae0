// SPDX-License-Identifier: MIT
//
// Pages of the guide as a terminal shows them.
#pragma once

#include <string>
#include <string_view>

namespace stipple::cli {

/// Markdown of a page as plain text. Code is indented by four blanks, and code within a sentence is
/// quoted if it has blanks. Links keep their words, followed after "See" by the `stipple help`
/// command of the page; after "Read on:" they become that command. Pictures, comments and inserted
/// tables are left out. Headings and other tables stay as they are.
std::string plain_page(std::string_view page);

}  // namespace stipple::cli
