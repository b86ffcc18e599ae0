// SPDX-License-Identifier: MIT
#include "io/formats/separated.hpp"

#include <algorithm>
#include <cmath>

#include "core/text.hpp"
#include "io/decimal.hpp"
#include "io/formats/delimited.hpp"
#include "io/provenance.hpp"

namespace stipple::io {
namespace {

/// Quotes a text if it contains a character that the reader accepts as separator.
std::string field(const std::string& text) {
    return text.find_first_of(",; \t") == std::string::npos ? text : "\"" + text + "\"";
}

template <char separator>
void head(const Layout& layout, std::string& out) {
    if (layout.meta) out += to_comment_lines(layout.provenance);
    if (!layout.header) return;
    std::vector<std::string> names = layout.columns();
    std::ranges::transform(names, names.begin(), field);
    if (layout.many_sets()) names.insert(names.begin(), "set");
    out += join(names, std::string(1, separator)) + "\n";
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

void rows_with_words(const Layout& layout, const RowStyle& style, std::span<const double> numbers,
                     std::string& out) {
    const auto words = words_of(layout);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        const std::size_t k = i % words.size();
        out += k == 0 ? style.open : style.between;
        const double x = numbers[i];
        if (words[k] && x >= 0 && x < static_cast<double>(words[k]->size()) && x == std::floor(x))
            out += field((*words[k])[static_cast<std::size_t>(x)]);
        else
            append_number(out, x, layout.precision);
        if (k + 1 == words.size()) out += style.close;
    }
}

template <char separator>
void rows(const Layout& layout, std::size_t set, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    const std::string between(1, separator);
    const std::string open = layout.many_sets() ? std::to_string(set) + between : std::string();
    const RowStyle style{open, between, "\n"};
    if (!layout.provenance.levels.empty()) return rows_with_words(layout, style, numbers, out);
    append_rows(out, numbers, layout.width(), style, layout.precision);
}

}  // namespace

Format separated_values(Format format, bool tabs) {
    format.head = tabs ? head<'\t'> : head<','>;
    format.rows = tabs ? rows<'\t'> : rows<','>;
    format.read = read_delimited;
    format.stream = stream_delimited;
    return format;
}

}  // namespace stipple::io
