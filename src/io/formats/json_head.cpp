// SPDX-License-Identifier: MIT
#include "io/formats/json_head.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/json.hpp"
#include "io/provenance.hpp"

namespace stipple::io {
namespace {

std::vector<std::uint64_t> whole_numbers(const SourceText& text, const char* at,
                                         const Json& value) {
    std::vector<std::uint64_t> numbers;
    for (const Json& number : value.is_array() ? value : Json::array({value})) {
        if (!number.is_number_unsigned())
            text.refuse(at, "the count is not a number of points such as 1024");
        numbers.push_back(number.get<std::uint64_t>());
    }
    return numbers;
}

}  // namespace

std::string json_head(const Layout& layout, const Counts& counts, std::uint64_t number) {
    Json head{{"format", "stipple.points"}, {"version", 1}};
    Provenance provenance = layout.provenance;
    provenance.seed = seed_of_set(provenance, number);
    head["meta"] = to_json(provenance);
    head["dimension"] = layout.dimension;
    Json& count = head["count"] = Json::array();
    if (counts.are_equal() && counts.size() > 0)
        count = counts[0];
    else
        for (std::uint64_t set = 0; set < counts.size(); ++set) count.push_back(counts[set]);
    if (!layout.extras.empty()) head["columns"] = layout.columns();
    std::string text = json_text(head);
    text.pop_back();
    return text;
}

void take_key(const SourceText& text, const char* at, std::string_view key, const Json& value,
              JsonHead& head) {
    if (key == "format" && value != "stipple.points")
        text.refuse(at, "the format is " + json_text(value).substr(0, 40) +
                            "; expected \"stipple.points\"");
    if (key == "version" && value != 1)
        text.refuse(at,
                    "version " + json_text(value).substr(0, 40) + " of stipple.points; expected 1");
    if (key == "meta") head.provenance = provenance_from(value);
    if (key == "dimension") {
        if (!value.is_number_unsigned() || value == 0)
            text.refuse(at, "the dimension is not a number such as 2");
        head.dimension = value.get<std::uint64_t>();
        head.dimension_at = at;
    }
    if (key == "count") {
        head.counts = whole_numbers(text, at, value);
        head.counts_at = at;
    }
    if (key == "columns") {
        if (!value.is_array() ||
            !std::ranges::all_of(value, [](const Json& name) { return name.is_string(); }))
            text.refuse(at, "the columns are not names such as [\"x\",\"y\"]");
        head.columns = value.get<std::vector<std::string>>();
    }
}

Json parse_piece(const SourceText& text, std::string_view piece) {
    try {
        return parse_json(piece);
    } catch (const JsonError& error) {
        text.refuse(piece.data() + error.at,
                    error.what() + std::string("; expected a value such as 1, \"word\" or {}"));
    }
}

Columns json_columns(const SourceText& text, JsonHead& head, std::size_t width,
                     const ReadOptions& options, const RunContext& run) {
    if (head.columns.empty() && head.provenance.columns.size() == width)
        head.columns = head.provenance.columns;
    if (!head.columns.empty() && head.columns.size() != width)
        text.refuse_whole(fmt::format("{} columns are named; the points have {} numbers",
                                      head.columns.size(), width));
    ReadOptions inner = options;
    if (head.dimension && options.columns.empty()) {
        inner.dimension.reset();
        inner.all_columns = inner.densities = false;
        const Columns columns = choose_columns(head.columns, width, inner, text.source());
        if (columns.dimension != *head.dimension)
            text.refuse(head.dimension_at,
                        fmt::format("the dimension is {}, but the points have {} coordinates",
                                    *head.dimension, columns.dimension));
    }
    Columns columns = choose_columns(head.columns, width, options, text.source());
    for (const std::string& sentence : replace_names(columns.names, options.gaps))
        run.notify(fmt::format("{}: {}", text.source(), sentence));
    tell_columns(head.provenance, columns, options);
    head.provenance.named = !columns.names.empty();
    return columns;
}

void check_counts(const SourceText& text, const JsonHead& head,
                  const std::vector<std::uint64_t>& found) {
    if (head.counts.empty()) return;
    if (head.counts.size() != 1 && head.counts.size() != found.size())
        text.refuse(head.counts_at, fmt::format("the count is given for {} sets, but {} follow",
                                                head.counts.size(), found.size()));
    for (std::size_t s = 0; s < found.size(); ++s) {
        const std::uint64_t said = head.counts[head.counts.size() == 1 ? 0 : s];
        if (said != found[s])
            text.refuse(head.counts_at,
                        fmt::format("the count is {}, but {} points follow", said, found[s]));
    }
}

}  // namespace stipple::io
