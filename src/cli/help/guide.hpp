// SPDX-License-Identifier: MIT
//
// The pages of data/guide, which are embedded in the program: a topic in each file, and what
// --help says of a verb in verbs/VERB.md.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stipple::cli {

struct GuidePage {
    const char* name;  ///< "formats", "verbs/plot"
    const char* text;
};

/// All pages, sorted by name.
const std::vector<GuidePage>& guide();

/// What `stipple help TOPIC` explains.
struct Topic {
    std::string name;
    std::string summary;  ///< the page's heading
    std::string text;     ///< the page; lines of four blanks and `stipple` run in their order
};

const std::vector<Topic>& topics();

/// What the page coming-from tells of another package (scipy), of what it calls something
/// (latinhypercube, qmc.Halton), or, for its own name, of all; whatever the case. Empty where that is
/// nothing.
std::string coming_from(std::string_view name);

/// What a verb's page says: its heading, the command, paragraphs, and "## Examples".
struct VerbPage {
    std::string summary;
    std::string usage;
    std::string text;
    std::string examples;  ///< a command a line
};

VerbPage verb_page(const std::string& verb);

}  // namespace stipple::cli
