// SPDX-License-Identifier: MIT
//
// Pages of data/guide, embedded in the program: one file per topic, and verbs/VERB.md for --help.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace stipple::cli {

struct GuidePage {
    std::string_view name;  ///< such as "formats" or "verbs/plot"
    std::string_view text;
};

const std::vector<GuidePage>& verb_pages();

struct CompressedText {
    std::string_view bytes;
    std::size_t size;  ///< bytes of the decompressed text
};

/// All pages except those of verbs: for each, a byte 1, a line with the page's name, and its text.
CompressedText compressed_topics();

/// All pages except those of verbs, sorted by name.
const std::vector<GuidePage>& guide();

/// A topic of `stipple help TOPIC`.
struct Topic {
    std::string name;
    std::string summary;  ///< the page's heading
    std::string text;     ///< the whole page, as plain_page() returns it
};

const std::vector<Topic>& topics();

/// Topics under a heading of the guide's index, in the order of the index.
struct TopicGroup {
    std::string heading;
    std::vector<const Topic*> topics;
};

std::vector<TopicGroup> topic_groups();

/// All terms of the glossary, with their other names, in lower case.
std::vector<std::string> glossary_terms();

/// Glossary paragraph for a term or one of its other names; empty for unknown words. Ignores case
/// and the s of a plural.
std::string glossary_entry(std::string_view word);

/// Equivalents of a name in another package (latinhypercube, qmc.Halton), from the page
/// coming-from; for a package (scipy), its section. Ignores case; empty if nothing is found.
std::string coming_from(std::string_view name);

/// Returns, as plain text, the first section of the guide's page about Python whose inline code has
/// the name, such as qmc.QMCEngine; empty if there is none.
std::string python_section(std::string_view name);

/// Page of a verb: heading, command, paragraphs, and "## Examples".
struct VerbPage {
    std::string summary;
    std::string usage;
    std::string text;
    std::string examples;  ///< one command per line, perhaps with a comment
};

VerbPage verb_page(const std::string& verb);

}  // namespace stipple::cli
