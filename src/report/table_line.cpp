// SPDX-License-Identifier: MIT
#include "report/table_line.hpp"

#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"

namespace stipple {
namespace {

std::string json_value(const TableCell& cell) {
    const std::string& text = cell.text;
    if (cell.number && (text.empty() || text == "nan")) return "null";
    if (cell.number && text != "inf" && text != "-inf") return text;
    return json_text(Json(text));
}

std::string json_name(std::string_view name) {
    if (name.find_first_of("\\\"") != name.npos) return json_text(Json(name));
    return std::string("\"").append(name).append("\"");
}

std::string text_in(const Json& value) {
    if (value.is_string()) return value.get<std::string>();
    if (value.is_null()) return {};
    if (value.is_number_float()) return format_number(value.get<double>());
    return value.dump();
}

std::optional<std::vector<std::string>> json_fields(std::string_view line,
                                                    std::span<const TableCell> columns) {
    const Json object = try_parse_json(line);
    if (!object.is_object()) return std::nullopt;
    std::vector<std::string> fields;
    for (const TableCell& column : columns) {
        const auto it = object.find(std::string(column.name));
        if (it == object.end()) return std::nullopt;
        fields.push_back(text_in(*it));
    }
    return object.size() == columns.size() ? std::optional(fields) : std::nullopt;
}

}  // namespace

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
    std::string quoted(text);
    replace_all(quoted, "\"", "\"\"");
    return "\"" + quoted + "\"";
}

std::string table_head(TableStyle style, std::span<const TableCell> cells) {
    if (style == TableStyle::jsonl) return {};
    std::string text;
    for (const TableCell& cell : cells) text.append(text.empty() ? "" : ",").append(cell.name);
    return text + "\n";
}

std::string table_line(TableStyle style, std::span<const TableCell> cells) {
    const bool csv = style == TableStyle::csv;
    std::string text = csv ? "" : "{";
    for (const TableCell& cell : cells) {
        if (&cell != cells.data()) text += ',';
        if (csv)
            text += csv_field(cell.text);
        else
            text.append(json_name(cell.name)).append(":").append(json_value(cell));
    }
    return text + (csv ? "\n" : "}\n");
}

std::optional<std::vector<std::string>> parse_table_line(TableStyle style, std::string_view line,
                                                         std::span<const TableCell> columns) {
    auto fields = style == TableStyle::csv ? io::csv_fields(line) : json_fields(line, columns);
    return fields && fields->size() == columns.size() ? std::move(fields) : std::nullopt;
}

}  // namespace stipple
