// SPDX-License-Identifier: MIT
//
// What `stipple help TOPIC` explains.
#pragma once

#include <string>
#include <vector>

namespace stipple::cli {

struct Topic {
    const char* name;
    const char* summary;
    /// Paragraphs. A line of four blanks and `stipple` is an example that runs, in its order.
    const char* text;
};

const std::vector<Topic>& topics();

}  // namespace stipple::cli
