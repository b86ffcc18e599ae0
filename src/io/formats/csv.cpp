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
// tells the set, columns called pdf or weight are no coordinates unless picked. Words stand in
// columns whose numbers have them (length,material / 0.5,steel); without provenance, the words that
// are read have the numbers 0, 1, ... in the order of their letters.
//
// Promise what was written reads back to the same doubles.
// Source  Y. Shafranovich, RFC 4180, 2005 (comments and the other separators are not in it).
#include <algorithm>
#include <cmath>

#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/delimited.hpp"
#include "io/provenance.hpp"

#include "core/text.hpp"

namespace stipple::io::csv {
namespace {

/// A text as a field.
std::string field(const std::string& text) {
    return text.find_first_of(",; \t") == std::string::npos ? text : "\"" + text + "\"";
}

void head(const Layout& layout, std::string& out) {
    if (layout.meta) out += to_comment_lines(layout.provenance);
    if (!layout.header) return;
    if (layout.many_sets()) out += "set,";
    std::vector<std::string> names = layout.columns();
    std::ranges::transform(names, names.begin(), field);
    out += join(names, ",") + "\n";
}

/// The words of each column, null where there are none.
std::vector<const std::vector<std::string>*> words_of(const Layout& layout) {
    std::vector<const std::vector<std::string>*> words;
    const auto& levels = layout.provenance.levels;
    for (const std::string& name : layout.columns()) {
        const auto found =
            std::ranges::find_if(levels, [&](const auto& column) { return column.first == name; });
        words.push_back(found == levels.end() ? nullptr : &found->second);
    }
    return words;
}

void rows_with_words(const Layout& layout, const std::string& open, std::span<const double> numbers,
                     std::string& out) {
    const auto words = words_of(layout);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t k = i % words.size();
        out += k == 0 ? open : ",";
        const double x = numbers[i];
        if (words[k] && x >= 0 && x < static_cast<double>(words[k]->size()) && x == std::floor(x))
            out += field((*words[k])[static_cast<std::size_t>(x)]);
        else
            append_number(out, x, layout.precision);
        if (k + 1 == words.size()) out += "\n";
    }
}

void rows(const Layout& layout, std::size_t set, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    const std::string open = layout.many_sets() ? std::to_string(set) + "," : std::string();
    if (!layout.provenance.levels.empty()) return rows_with_words(layout, open, numbers, out);
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
