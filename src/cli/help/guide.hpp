// SPDX-License-Identifier: MIT
//
// Pages of data/guide, embedded in the program: one file per topic, and verbs/VERB.md for --help.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stipple::cli {

struct GuidePage {
    const char* name;  ///< such as "formats" or "verbs/plot"
    const char* text;
};

/// All pages, sorted by name.
const std::vector<GuidePage>& guide();

/// A topic of `stipple help TOPIC`.
struct Topic {
    std::string name;
    std::string summary;  ///< the page's heading
    std::string text;     ///< the whole page; its indented `stipple` lines can be run in order
};

const std::vector<Topic>& topics();

/// Equivalents of a name in another package (latinhypercube, qmc.Halton), from the page
/// coming-from; for a package (scipy), all its rows. Ignores case; empty if nothing is found.
std::string coming_from(std::string_view name);

/// Page of a verb: heading, command, paragraphs, and "## Examples".
struct VerbPage {
    std::string summary;
    std::string usage;
    std::string text;
    std::string examples;  ///< one command per line
};

VerbPage verb_page(const std::string& verb);

}  // namespace stipple::cli
