// SPDX-License-Identifier: MIT
//
// Conversion between structures and the cells of a table. A row is given by for_each(visit), which
// calls visit(name, field) for every column in order.
#pragma once

#include <charconv>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "core/text.hpp"
#include "report/table_line.hpp"

namespace stipple::columns {

inline std::string text_of(const std::string& text) { return text; }
inline std::string text_of(std::uint64_t number) { return std::to_string(number); }
/// An unknown number is NaN in a structure, and becomes an empty cell of the table.
inline std::string text_of(double number) {
    return std::isnan(number) ? "" : format_number(number);
}
/// In optional fields, an unknown number is nullopt, and a measured NaN becomes the cell "nan".
inline std::string text_of(const std::optional<double>& field) {
    return field ? format_number(*field) : "";
}
inline std::string text_of(const std::optional<std::uint64_t>& field) {
    return field ? std::to_string(*field) : "";
}

// Overloads of read() parse the text of a cell. They return false if it does not fit the field.
inline bool read(const std::string& text, std::string& field) {
    field = text;
    return true;
}
inline bool read(const std::string& text, std::optional<std::uint64_t>& field) {
    field = parse_unsigned(text);
    return field || text.empty();
}
inline bool read(const std::string& text, std::uint64_t& field) {
    const auto number = parse_unsigned(text);
    field = number.value_or(0);
    return number.has_value();
}
inline bool read(const std::string& text, double& field) {
    field = std::nan("");
    const char* end = text.data() + text.size();
    return text.empty() || std::from_chars(text.data(), end, field).ptr == end;
}
inline bool read(const std::string& text, std::optional<double>& field) {
    return text.empty() || read(text, field.emplace());
}

template <class ForEach>
std::vector<TableCell> cells_of(const ForEach& for_each) {
    std::vector<TableCell> cells;
    for_each([&]<class Field>(const char* name, const Field& field) {
        cells.push_back({name, text_of(field), !std::is_same_v<Field, std::string>});
    });
    return cells;
}

/// Reads the cells of a row into its fields. Returns false if a cell does not fit its field.
template <class ForEach>
bool read_cells(const std::vector<std::string>& cells, const ForEach& for_each) {
    bool whole = true;
    auto cell = cells.begin();
    for_each([&](const char*, auto& field) { whole = read(*cell++, field) && whole; });
    return whole;
}

}  // namespace stipple::columns
