// SPDX-License-Identifier: MIT
//
// JSON lines: one object that describes a set, then one point per line.
//
//     {"format":"stipple.points","version":1,"meta":{...},"dimension":2,"count":2}
//     [0,0]
//     [0.5,0.25]
//
// Each of several sets has such an object before its points, with its number under "set". The
// reader also accepts points without any object, and objects without some of the keys.
//
// Source  https://jsonlines.org; points are parsed like rows of csv.
#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/decimal.hpp"
#include "io/format.hpp"
#include "io/formats/delimited.hpp"
#include "io/formats/json_head.hpp"
#include "io/provenance.hpp"

namespace stipple::io::jsonl {
namespace {

void begin_set(const Layout& layout, std::size_t set, std::string& out) {
    out += json_head(layout, {layout.counts[set]}, set);
    if (layout.many_sets()) out += fmt::format(",\"set\":{}", set);
    out += "}\n";
}

void rows(const Layout& layout, std::size_t, std::uint64_t, std::span<const double> numbers,
          std::string& out) {
    append_rows(out, numbers, layout.width(), {"[", ",", "]\n"}, layout.precision);
}

JsonHead head_at(const SourceText& text, const char* line) {
    const std::string_view object = trim(line_at(text, line));
    JsonHead head;
    if (!object.starts_with('{')) return head;
    const nlohmann::ordered_json keys = parse_piece(text, object);
    for (const auto& [key, value] : keys.items()) take_key(text, object.data(), key, value, head);
    return head;
}

/// The first line at or after `line` that is neither blank nor an object.
const char* first_row(const SourceText& text, const char* line) {
    for (; line != text.end(); line = next_line(text, line)) {
        const std::string_view content = trim(line_at(text, line));
        if (!content.empty() && content.front() != '{') return line;
    }
    text.refuse_whole("the file holds no points; expected lines such as [0.1,0.2]");
}

std::vector<PointSet> read(std::string_view bytes, const ReadOptions& options,
                           const RunContext& run) {
    const SourceText text(bytes, options.source);
    const Top top = read_top(text);
    JsonHead head = head_at(text, top.first);
    const char* const model = first_row(text, top.first);
    const std::string_view row = line_at(text, model);
    const auto width = static_cast<std::size_t>(std::ranges::count(row, ',')) + 1;
    const Columns columns = json_columns(text, head, width, options, run);
    const Dialect dialect{.separator = ',', .brackets = true, .model_line = text.line_of(model)};
    Rows rows = read_rows(text, top.first, columns, dialect, run);

    if (columns.has(Columns::set_number))
        return gather_sets(std::move(rows.numbers), columns.dimension, std::move(rows.marks),
                           head.provenance);
    const std::vector<std::uint64_t> starts = set_starts(text, rows, columns.dimension);
    std::vector<PointSet> sets =
        cut_sets(std::move(rows.numbers), columns.dimension, starts, head.provenance);
    for (const Mark& mark : rows.marks) {
        const auto start = std::ranges::lower_bound(starts, mark.row);
        PointSet& set = sets[static_cast<std::size_t>(start - starts.begin())];
        JsonHead own = head_at(text, mark.at);
        if (!own.columns.empty() && own.columns != head.columns)
            text.refuse(mark.at, fmt::format("the columns are {}; those of the first set are {}",
                                             join(own.columns, ", "), join(head.columns, ", ")));
        if (!options.any_count) check_counts(text, own, {set.count()});
        if (&set == &sets[0] || own.provenance.generator.empty()) continue;
        tell_columns(own.provenance, columns, options);
        own.provenance.named = set.provenance.named;
        set.provenance = std::move(own.provenance);
    }
    return sets;
}

}  // namespace

Format unit() {
    return {.name = "jsonl",
            .summary = "A line of provenance, then one point [x,y] per line",
            .source = "https://jsonlines.org",
            .extensions = {".jsonl"},
            .traits = {.counts_first = true},
            .begin_set = begin_set,
            .rows = rows,
            .read = read};
}

}  // namespace stipple::io::jsonl
