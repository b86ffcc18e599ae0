// SPDX-License-Identifier: MIT
#include "study/study_table.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "core/text.hpp"

namespace stipple {
namespace {

constexpr std::array names = {
    "generator", "generator_options", "dimension", "warps", "count", "points", "seed",
    "measure",   "measure_options",   "domain",    "key",   "value", "status", "reason",
    "study",     "generate_seconds",  "seconds"};
constexpr std::size_t timed = 2;  // the last ones

std::string options_text(const std::vector<std::pair<std::string, std::string>>& options) {
    std::string text;
    for (const auto& [name, value] : options)
        text += fmt::format("{}{}={}", text.empty() ? "" : ";", name, value);
    return text;
}

std::string value_text(const StudyRow& row) {
    if (!row.value) return {};
    if (row.whole) return fmt::format("{:.0f}", *row.value);
    return format_number(*row.value);
}

/// Seconds to the microsecond: more would be noise.
std::string seconds_text(const std::optional<double>& seconds) {
    return seconds ? format_number(std::round(*seconds * 1e6) / 1e6) : std::string();
}

std::vector<std::string> cells_of(const StudyRow& row) {
    return {row.generator,
            row.generator_options,
            std::to_string(row.dimension),
            row.warps,
            std::to_string(row.count),
            row.points ? std::to_string(*row.points) : "",
            std::to_string(row.seed),
            row.measure,
            row.measure_options,
            row.domain,
            row.key,
            value_text(row),
            row.status,
            row.reason,
            row.study,
            seconds_text(row.generate_seconds),
            seconds_text(row.seconds)};
}

/// The fields of a line of CSV; nothing where a quote is not closed.
std::optional<std::vector<std::string>> csv_fields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += c;
            ++i;
        } else if (c == '"') {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return quoted ? std::nullopt : std::optional(fields);
}

double number_in(const std::string& text) {
    if (text == "inf" || text == "-inf") return text == "inf" ? HUGE_VAL : -HUGE_VAL;
    return parse_number(text).value_or(std::nan(""));
}

std::optional<double> maybe_number(const std::string& text) {
    return text.empty() ? std::nullopt : std::optional(number_in(text));
}

/// The row of its cells; the seconds may be left out.
std::optional<StudyRow> row_from(const std::vector<std::string>& cells) {
    const auto dimension = parse_unsigned(cells[2]);
    const auto count = parse_unsigned(cells[4]);
    const auto seed = parse_unsigned(cells[6]);
    const bool status = cells[12] == "ok" || cells[12] == "failed";
    if (!dimension || !count || !seed || !status || cells[14].size() != 16) return std::nullopt;
    StudyRow row{.generator = cells[0],
                 .generator_options = cells[1],
                 .dimension = *dimension,
                 .warps = cells[3],
                 .count = *count,
                 .points = parse_unsigned(cells[5]),
                 .seed = *seed,
                 .measure = cells[7],
                 .measure_options = cells[8],
                 .domain = cells[9],
                 .key = cells[10],
                 .value = maybe_number(cells[11]),
                 .whole = false,
                 .status = cells[12],
                 .reason = cells[13],
                 .study = cells[14],
                 .generate_seconds = {},
                 .seconds = {}};
    row.whole = row.value && cells[11].find_first_not_of("-0123456789") == std::string::npos;
    if (cells.size() > 15) row.generate_seconds = maybe_number(cells[15]);
    if (cells.size() > 16) row.seconds = maybe_number(cells[16]);
    return row;
}

bool is_number(std::size_t column) {
    return column == 2 || (column >= 4 && column <= 6) || column == 11 || column > 14;
}

/// A cell as JSON: its very digits, since doubles hold no 64-bit seeds; null where there is none.
std::string json_cell(std::size_t column, const std::string& text) {
    if (!is_number(column)) return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace);
    if (text.empty() || text == "nan") return "null";
    if (text == "inf" || text == "-inf") return Json(text).dump();
    return text;
}

std::string text_in(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return {};
    if (value.is_number_float()) return format_number(value.get<double>());
    return value.dump();
}

std::optional<std::vector<std::string>> json_cells(std::string_view line, std::size_t columns) {
    const Json object = Json::parse(line, nullptr, false);
    if (!object.is_object() || object.size() != columns) return std::nullopt;
    std::vector<std::string> cells;
    for (std::size_t k = 0; k < columns; ++k) {
        const auto it = object.find(names[k]);
        if (it == object.end()) return std::nullopt;
        cells.push_back(text_in(*it));
    }
    return cells;
}

}  // namespace

std::string csv_field(const std::string& text) {
    if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

StudyRow row_of(const Sweep& sweep, const Unit& unit) {
    const Cell cell = sweep.cell(unit.cell);
    const auto& generator = sweep.generators()[cell.generator];
    const auto& measure = sweep.measures()[unit.measure];
    StudyRow row;
    row.generator = generator.spec;
    row.generator_options = options_text(generator.options);
    row.dimension = cell.dimension;
    row.warps = sweep.warp_names();
    row.count = cell.count;
    row.seed = sweep.request().first_seed + unit.seed_index;
    row.measure = measure.spec;
    row.measure_options = options_text(measure.options);
    row.status = "ok";
    row.study = sweep.fingerprint();
    return row;
}

bool belongs(const StudyRow& row, const StudyRow& unit) {
    return row.generator == unit.generator && row.generator_options == unit.generator_options &&
           row.dimension == unit.dimension && row.warps == unit.warps && row.count == unit.count &&
           row.seed == unit.seed && row.measure == unit.measure &&
           row.measure_options == unit.measure_options && row.study == unit.study;
}

std::string StudyTable::head() const {
    if (style_ == Style::jsonl) return {};
    const std::size_t columns = names.size() - (seconds_ ? 0 : timed);
    return fmt::format("{}\n", fmt::join(names.begin(), names.begin() + columns, ","));
}

std::string StudyTable::line(const StudyRow& row) const {
    const auto cells = cells_of(row);
    const std::size_t columns = names.size() - (seconds_ ? 0 : timed);
    std::string text;
    for (std::size_t k = 0; k < columns; ++k) {
        if (k > 0) text += ',';
        text += style_ == Style::csv ? csv_field(cells[k])
                                     : fmt::format("\"{}\":{}", names[k], json_cell(k, cells[k]));
    }
    return style_ == Style::csv ? text + "\n" : fmt::format("{{{}}}\n", text);
}

std::optional<StudyRow> StudyTable::parse(std::string_view line) const {
    const std::size_t columns = names.size() - (seconds_ ? 0 : timed);
    const auto cells = style_ == Style::csv ? csv_fields(line) : json_cells(line, columns);
    if (!cells || cells->size() != columns) return std::nullopt;
    return row_from(*cells);
}

bool StudyTable::is_head(std::string_view line) const {
    if (style_ == Style::csv) return line.starts_with("generator,generator_options,dimension,");
    const Json object = Json::parse(line, nullptr, false);
    return object.is_object() && object.contains("study") && object.contains("measure");
}

}  // namespace stipple
