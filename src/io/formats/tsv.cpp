// SPDX-License-Identifier: MIT
//
// Tab-separated values: as csv, with tabs instead of commas.
//
// Promise written points read back as the same doubles.
// Source  IANA, text/tab-separated-values, 1993 (without quotes and comments).
#include "io/formats/separated.hpp"

namespace stipple::io::tsv {

Format unit() {
    return separated_values({.name = "tsv",
                             .summary = "As csv, with tabs instead of commas",
                             .source = "IANA text/tab-separated-values",
                             .extensions = {".tsv"},
                             .traits = {}},
                            true);
}

}  // namespace stipple::io::tsv
