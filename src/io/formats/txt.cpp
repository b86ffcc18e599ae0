// SPDX-License-Identifier: MIT
//
// Plain text: one point per line, coordinates separated by one blank, no header; a line `#`
// separates two sets. The reader is that of csv.
//
// Promise written points read back as the same doubles.
// Source  the format of UTK and other sampling programs; also read by gnuplot and numpy.loadtxt.
#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/delimited.hpp"
#include "io/provenance.hpp"

namespace stipple::io::txt {
namespace {

void head(const Layout& layout, std::string& out) {
    if (layout.meta) out += to_comment_lines(layout.provenance);
}

void begin_set(const Layout&, std::size_t set, std::string& out) {
    if (set > 0) out += "#\n";
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_rows(out, numbers, layout.width(), {"", " ", "\n"}, layout.precision);
}

}  // namespace

Format unit() {
    return {.name = "txt",
            .summary = "One point per line, coordinates separated by blanks, sets by a line '#'",
            .source = "UTK, gnuplot, numpy.loadtxt",
            .extensions = {".txt", ".dat"},
            .traits = {},
            .head = head,
            .begin_set = begin_set,
            .rows = rows,
            .read = read_delimited,
            .stream = stream_delimited};
}

}  // namespace stipple::io::txt
