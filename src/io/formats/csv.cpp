// SPDX-License-Identifier: MIT
//
// Comma-separated values: a header, then one point per line.
//
//     x,y            set,x,y         (several sets)       x1,x2,x3,x4       (d > 3)
//     0,0            0,0,0                                0,0,0,0
//     0.5,0.25       1,0.5,0.25
//
// Densities and other extras follow the coordinates (x,y,pdf). The reader accepts commas,
// semicolons, tabs and blanks, with or without header and quotes, comments, CRLF and a byte-order
// mark. A first line without numbers is a header. A first column `set` is the set number; columns
// pdf and weight are coordinates only if picked. Categorical columns hold their level names
// (length,material / 0.5,steel); without provenance, these are numbered 0, 1, ... in alphabetical
// order.
//
// Promise written points read back as the same doubles.
// Source  Y. Shafranovich, RFC 4180, 2005 (without comments and the other separators).
#include "io/formats/separated.hpp"

namespace stipple::io::csv {

Format unit() {
    return separated_values(
        {.name = "csv",
         .summary = "Comma-separated values with a header; reads all kinds of columns",
         .source = "RFC 4180",
         .extensions = {".csv"},
         .traits = {}},
        false);
}

}  // namespace stipple::io::csv
