// SPDX-License-Identifier: MIT
//
// Comma-separated values: a header, then a point a line.
//
//     x,y            set,x,y         (several sets)       x1,x2,x3,x4       (d > 3)
//     0,0            0,0,0                                0,0,0,0
//     0.5,0.25       1,0.5,0.25
//
// Numbers of the density and other extras stand behind the coordinates (x,y,pdf). The reader takes
// commas, semicolons, tabs and blanks, with a header or without, quoted or not, comments, CRLF and
// a byte-order mark. A header is a first line that holds no number; a first column called `set`
// tells the set, columns called pdf or weight are no coordinates unless picked.
//
// Promise what was written reads back to the same doubles.
// Source  Y. Shafranovich, RFC 4180, 2005 (comments and the other separators are not in it).
#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/delimited.hpp"
#include "io/provenance.hpp"

#include "core/text.hpp"

namespace stipple::io::csv {
namespace {

void head(const Layout& layout, std::string& out) {
    if (layout.meta) out += to_comment_lines(layout.provenance);
    if (!layout.header) return;
    if (layout.many_sets()) out += "set,";
    std::vector<std::string> names = layout.columns();
    for (std::string& name : names)
        if (name.find_first_of(",;") != std::string::npos) name = "\"" + name + "\"";
    out += join(names, ",") + "\n";
}

void rows(const Layout& layout, std::size_t set, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    const std::string open = layout.many_sets() ? std::to_string(set) + "," : std::string();
    append_rows(out, numbers, layout.width(), {open, ",", "\n"}, layout.precision);
}

}  // namespace

Format unit() {
    return {.name = "csv",
            .summary = "Comma-separated values with a header; reads all kinds of columns",
            .source = "RFC 4180",
            .extensions = {".csv", ".tsv"},
            .traits = {},
            .head = head,
            .rows = rows,
            .read = read_delimited,
            .stream = stream_delimited};
}

}  // namespace stipple::io::csv
