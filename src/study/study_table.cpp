// SPDX-License-Identifier: MIT
#include "study/study_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "study/table_columns.hpp"

namespace stipple {
namespace {

std::string options_text(const std::vector<std::pair<std::string, std::string>>& options) {
    std::string text;
    for (const auto& [name, value] : options)
        text += fmt::format("{}{}={}", text.empty() ? "" : ";", name, value);
    return text;
}

/// Visits the columns of a row in order: name and field.
template <class Row, class Visit>
void for_each_column(Row& row, bool seconds, const Visit& visit) {
    visit("generator", row.generator);
    visit("generator_options", row.generator_options);
    visit("dimension", row.dimension);
    visit("warps", row.warps);
    visit("count", row.count);
    visit("points", row.points);
    visit("seed", row.seed);
    visit("measure", row.measure);
    visit("measure_options", row.measure_options);
    visit("domain", row.domain);
    visit("key", row.key);
    visit("value", row.value);
    visit("status", row.status);
    visit("reason", row.reason);
    visit("study", row.study);
    if (!seconds) return;
    visit("generate_seconds", row.generate_seconds);
    visit("seconds", row.seconds);
}

std::vector<TableCell> cells_of(const StudyRow& row, bool seconds) {
    return columns::cells_of([&](const auto& visit) { for_each_column(row, seconds, visit); });
}

std::optional<StudyRow> row_from(const std::vector<std::string>& cells, bool seconds) {
    StudyRow row;
    bool whole = columns::read_cells(
        cells, [&](const auto& visit) { for_each_column(row, seconds, visit); });
    whole = whole && (row.status == "ok" || row.status == "failed") && row.study.size() == 16;
    return whole ? std::optional(std::move(row)) : std::nullopt;
}

}  // namespace

StudyRow row_of(const Sweep& sweep, const Unit& unit) {
    const Cell cell = sweep.cell(unit.cell);
    const auto& generator = sweep.generators()[cell.generator];
    const auto& measure = sweep.measures()[unit.measure];
    return {.generator = generator.spec,
            .generator_options = options_text(generator.options),
            .dimension = cell.dimension,
            .warps = sweep.warp_names(),
            .count = cell.count,
            .seed = sweep.request().first_seed + unit.seed_index,
            .measure = measure.spec,
            .measure_options = options_text(measure.options),
            .study = sweep.fingerprint()};
}

std::vector<StudyRow> rows_of(const Sweep& sweep, const Unit& unit, const UnitResult& result) {
    // Digits below microseconds would be noise.
    const auto rounded = [](double seconds) { return std::round(seconds * 1e6) / 1e6; };
    StudyRow row = row_of(sweep, unit);
    row.domain = result.domain;
    row.points = result.points;
    row.generate_seconds = rounded(result.generate_seconds);
    row.seconds = rounded(result.seconds);
    if (!result.failure.empty()) {
        row.status = "failed";
        row.reason = result.failure;
        return {row};
    }
    std::vector<StudyRow> rows;
    for (const auto& [key, value] : result.numbers) {
        row.key = key;
        row.value = value;
        rows.push_back(row);
    }
    return rows;
}

bool belongs(const StudyRow& row, const StudyRow& unit) {
    return row.generator == unit.generator && row.generator_options == unit.generator_options &&
           row.dimension == unit.dimension && row.warps == unit.warps && row.count == unit.count &&
           row.seed == unit.seed && row.measure == unit.measure &&
           row.measure_options == unit.measure_options && row.study == unit.study;
}

std::optional<std::uint64_t> unit_of(const Sweep& sweep, const StudyRow& row) {
    const auto index =
        sweep.index_of(row.generator, row.dimension, row.count, row.seed, row.measure);
    const bool known = index && belongs(row, row_of(sweep, sweep.unit(*index)));
    return known ? index : std::nullopt;
}

std::string study_preface(TableStyle style, const std::string& command) {
    const std::string text = json_text(Json(command));
    return style == TableStyle::csv
               ? fmt::format("# tool: \"stipple\"\n# version: \"{}\"\n# command: {}\n",
                             STIPPLE_VERSION, text)
               : fmt::format(
                     "{{\"format\":\"stipple.study\",\"version\":1,\"meta\":{{\"tool\":"
                     "\"stipple\",\"version\":\"{}\",\"command\":{}}}}}\n",
                     STIPPLE_VERSION, text);
}

bool is_study_preface(std::string_view line) {
    for (const char* begin :
         {"# tool: \"stipple\"", "# version: ", "# command: ", "{\"format\":\"stipple.study\","})
        if (line.starts_with(begin)) return true;
    return false;
}

std::string_view without_preface(std::string_view text) {
    while (is_study_preface(text))
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    return text;
}

StudyTable::StudyTable(TableStyle style, bool seconds, std::string preface)
    : style_(style),
      seconds_(seconds),
      preface_(std::move(preface)),
      columns_(cells_of({}, seconds)) {}

std::string StudyTable::names() const { return table_head(style_, columns_); }

std::string StudyTable::line(const StudyRow& row) const {
    return table_line(style_, cells_of(row, seconds_));
}

std::optional<StudyRow> StudyTable::parse(std::string_view line) const {
    const auto cells = parse_table_line(style_, line, columns_);
    return cells ? row_from(*cells, seconds_) : std::nullopt;
}

bool StudyTable::is_head(std::string_view line) const {
    if (style_ == TableStyle::csv)
        return line.starts_with("generator,generator_options,dimension,");
    const auto has = [line](std::string_view key) { return line.find(key) != line.npos; };
    return line.starts_with("{") && has("\"measure\":") && has("\"study\":");
}

}  // namespace stipple
