// SPDX-License-Identifier: MIT
//
// Lines of a table, as CSV with a header or as JSON objects.
//
// Promise  a row is one line, and reads back as the same texts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

enum class TableStyle { csv, jsonl };

struct TableCell {
    std::string_view name;  ///< name of the column
    std::string text;
    bool number = false;  ///< whether the text is digits, "inf", "nan", or empty if missing
};

/// A CSV field, quoted if necessary.
std::string csv_field(std::string_view text);

/// The header line; empty for JSON.
std::string table_head(TableStyle style, std::span<const TableCell> cells);

/// A row with its line end. JSON keeps the digits of numbers, writes missing numbers and NaN as
/// null, and "inf" as text.
std::string table_line(TableStyle style, std::span<const TableCell> cells);

/// Parses a line without its line end; nullopt if it is not a complete row with these columns.
std::optional<std::vector<std::string>> parse_table_line(TableStyle style, std::string_view line,
                                                         std::span<const TableCell> columns);

}  // namespace stipple
