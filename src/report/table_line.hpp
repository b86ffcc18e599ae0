// SPDX-License-Identifier: MIT
//
// The lines of a table, as CSV with a line of names above them or as JSON objects.
//
// Promise  a row is one line, and reads back to the same texts.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

enum class TableStyle { csv, jsonl };

struct TableCell {
    std::string_view name;  ///< of the column
    std::string text;
    bool number = false;  ///< digits, "inf", "nan"; empty where there is none
};

/// A field of CSV, in quotes where it needs them.
std::string csv_field(std::string_view text);

/// The line of names above the rows; empty for JSON.
std::string table_head(TableStyle style, std::span<const TableCell> cells);

/// A row, with the end of its line. JSON has the very digits of numbers, null for those that are
/// missing or NaN, and "inf" as a text.
std::string table_line(TableStyle style, std::span<const TableCell> cells);

/// The texts of a line without its end, for columns such as these; nothing where it is no whole row.
std::optional<std::vector<std::string>> parse_table_line(TableStyle style, std::string_view line,
                                                         std::span<const TableCell> columns);

}  // namespace stipple
