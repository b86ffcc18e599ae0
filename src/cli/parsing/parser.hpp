// SPDX-License-Identifier: MIT
//
// Words of a command line, split into options and inputs.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace stipple::cli {

struct Grammar {
    struct Word {
        std::string names;  ///< "-n,--count", the long name last
        bool flag = false;
        bool repeatable = false;
    };
    std::vector<Word> options;
    std::vector<std::string> unit = {};   ///< the name and aliases of the unit that may be named
    std::vector<Word> unit_options = {};  ///< that it alone takes
    bool inputs = false;                  ///< all other words are inputs
};

struct ParsedWords {
    using Texts = std::vector<std::pair<std::string, std::string>>;  ///< long name, text
    Texts options;
    Texts unit_options;
    std::vector<std::string> inputs;
    std::vector<std::string> rest;  ///< what was not understood
    bool unit = false;              ///< the unit was named
    bool help = false;              ///< -h or --help
};

/// @throws Error(usage) for an option without its value, or given twice
ParsedWords parse_words(const Grammar& grammar, std::vector<std::string> words);

}  // namespace stipple::cli
