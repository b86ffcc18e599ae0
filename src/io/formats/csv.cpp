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
#include <algorithm>
#include <cmath>

#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/delimited.hpp"
#include "io/provenance.hpp"

#include "core/text.hpp"

namespace stipple::io::csv {
namespace {

/// Quotes a text if it contains a separator of the reader.
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

/// Level names of each column; null for numeric columns.
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
