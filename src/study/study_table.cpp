// SPDX-License-Identifier: MIT
#include "study/study_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/text.hpp"

namespace stipple {
namespace {

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

std::vector<TableCell> cells_of(const StudyRow& row, bool seconds) {
    std::vector<TableCell> cells = {{"generator", row.generator},
                                    {"generator_options", row.generator_options},
                                    {"dimension", std::to_string(row.dimension), true},
                                    {"warps", row.warps},
                                    {"count", std::to_string(row.count), true},
                                    {"points", row.points ? std::to_string(*row.points) : "", true},
                                    {"seed", std::to_string(row.seed), true},
                                    {"measure", row.measure},
                                    {"measure_options", row.measure_options},
                                    {"domain", row.domain},
                                    {"key", row.key},
                                    {"value", value_text(row), true},
                                    {"status", row.status},
                                    {"reason", row.reason},
                                    {"study", row.study}};
    if (!seconds) return cells;
    cells.push_back({"generate_seconds", seconds_text(row.generate_seconds), true});
    cells.push_back({"seconds", seconds_text(row.seconds), true});
    return cells;
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
                 .status = cells[12],
                 .reason = cells[13],
                 .study = cells[14]};
    row.whole = row.value && cells[11].find_first_not_of("-0123456789") == std::string::npos;
    if (cells.size() > 15) row.generate_seconds = maybe_number(cells[15]);
    if (cells.size() > 16) row.seconds = maybe_number(cells[16]);
    return row;
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

bool belongs(const StudyRow& row, const StudyRow& unit) {
    return row.generator == unit.generator && row.generator_options == unit.generator_options &&
           row.dimension == unit.dimension && row.warps == unit.warps && row.count == unit.count &&
           row.seed == unit.seed && row.measure == unit.measure &&
           row.measure_options == unit.measure_options && row.study == unit.study;
}

StudyTable::StudyTable(TableStyle style, bool seconds)
    : style_(style), seconds_(seconds), columns_(cells_of({}, seconds)) {}

std::string StudyTable::head() const { return table_head(style_, columns_); }

std::string StudyTable::line(const StudyRow& row) const {
    return table_line(style_, cells_of(row, seconds_));
}

std::optional<StudyRow> StudyTable::parse(std::string_view line) const {
    const auto cells = parse_table_line(style_, line, columns_);
    return cells ? row_from(*cells) : std::nullopt;
}

bool StudyTable::is_head(std::string_view line) const {
    if (style_ == Style::csv) return line.starts_with("generator,generator_options,dimension,");
    const auto has = [line](std::string_view key) { return line.find(key) != line.npos; };
    return line.starts_with("{") && has("\"measure\":") && has("\"study\":");
}

}  // namespace stipple
