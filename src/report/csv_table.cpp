// SPDX-License-Identifier: MIT
//
// Two or more lists of equal length in one group of a report are curves, columns of a table with a
// row for each entry, if they are longer than the points have coordinates, or if one of them holds
// whole numbers. All other lists (a corner, a grid's extents, a mean for each axis) are numbers of
// their own: columns KEY.0, KEY.1... Tables of different groups or lengths follow each other and
// are empty where another's rows are, as after pandas.concat; what is no curve is repeated on every
// row.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "report/document.hpp"
#include "report/table_line.hpp"

namespace stipple {
namespace {

/// Cells of a list; nothing for what is no list.
std::optional<std::vector<std::string>> list_cells(const Report::Item& item) {
    std::vector<std::string> cells;
    if (const auto* curve = std::get_if<Report::Curve>(&item))
        for (const double x : *curve) cells.push_back(format_number(x));
    else if (const auto* list = std::get_if<Report::Integers>(&item))
        for (const std::int64_t i : *list) cells.push_back(std::to_string(i));
    else
        return std::nullopt;
    return cells;
}

std::string single_cell(const Report::Item& item) {
    if (const auto* flag = std::get_if<bool>(&item)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::int64_t>(&item)) return std::to_string(*whole);
    if (const auto* number = std::get_if<double>(&item)) return format_number(*number);
    if (const auto* text = std::get_if<std::string>(&item)) return *text;
    return {};
}

/// The rows of one measurement.
class ValueRows {
  public:
    using Column = std::pair<std::string, std::vector<std::string>>;

    explicit ValueRows(const Measurement& m)
        : single{{"analyzer", m.analyzer},
                 {"source", m.source},
                 {"set", m.set ? std::to_string(*m.set) : ""},
                 {"count", std::to_string(m.count)},
                 {"dimension", std::to_string(m.dimension)},
                 {"domain", m.domain}} {
        for (const auto& key : m.results.keys()) {
            const Report::Item& item = *m.results.find(key);
            const auto cells = list_cells(item);
            if (!cells) continue;
            Lists& lists = lists_of(key, cells->size());
            ++lists.count;
            lists.whole |= std::holds_alternative<Report::Integers>(item);
        }
        add(m.results, "", m.dimension);
        if (m.standard_error) add(*m.standard_error, "standard_error.", m.dimension);
    }

    std::vector<std::pair<std::string, std::string>> single;  ///< the same on each row
    std::vector<std::vector<Column>> tables;

  private:
    /// Lists of one length in one group of the results.
    struct Lists {
        std::size_t count = 0;
        bool whole = false;  ///< one of them holds whole numbers
        std::optional<std::size_t> table = {};
    };

    Lists& lists_of(const std::string& key, std::size_t length) {
        const auto dot = key.rfind('.');
        return lists_[{dot == std::string::npos ? "" : key.substr(0, dot), length}];
    }

    void add(const Report& report, const std::string& prefix, std::size_t dimension) {
        for (const auto& key : report.keys()) {
            const Report::Item& item = *report.find(key);
            auto cells = list_cells(item);
            if (!cells) {
                single.emplace_back(prefix + key, single_cell(item));
                continue;
            }
            Lists& lists = lists_of(key, cells->size());
            if (lists.count > 1 && (cells->size() > dimension || lists.whole)) {
                if (!lists.table) {
                    lists.table = tables.size();
                    tables.emplace_back();
                }
                tables[*lists.table].emplace_back(prefix + key, std::move(*cells));
            } else {
                for (std::size_t i = 0; i < cells->size(); ++i)
                    single.emplace_back(fmt::format("{}{}.{}", prefix, key, i), (*cells)[i]);
            }
        }
    }

    std::map<std::pair<std::string, std::size_t>, Lists> lists_;
};

/// The columns of all rows, in the order in which they first come.
std::vector<std::string> columns_of(const std::vector<ValueRows>& all) {
    std::vector<std::string> columns;
    std::set<std::string> seen;
    const auto add = [&](const std::string& name) {
        if (seen.insert(name).second) columns.push_back(name);
    };
    for (const ValueRows& rows : all) {
        for (const auto& [name, cell] : rows.single) add(name);
        for (const auto& table : rows.tables)
            for (const auto& [name, cells] : table) add(name);
    }
    return columns;
}

std::string row(const std::map<std::string, std::string>& cells,
                const std::vector<std::string>& columns) {
    std::vector<std::string> fields;
    for (const std::string& column : columns) {
        const auto cell = cells.find(column);
        fields.push_back(cell == cells.end() ? "" : csv_field(cell->second));
    }
    return join(fields, ",") + "\n";
}

}  // namespace

std::string to_csv(std::span<const Measurement> measurements) {
    if (measurements.empty()) return {};
    const std::vector<ValueRows> all(measurements.begin(), measurements.end());
    const auto columns = columns_of(all);
    std::string text = join(columns, ",") + "\n";
    for (const ValueRows& rows : all) {
        const std::map<std::string, std::string> single(rows.single.begin(), rows.single.end());
        if (rows.tables.empty()) text += row(single, columns);
        for (const auto& table : rows.tables)
            for (std::size_t i = 0; i < table.front().second.size(); ++i) {
                auto cells = single;
                for (const auto& [name, list] : table) cells[name] = list[i];
                text += row(cells, columns);
            }
    }
    return text;
}

}  // namespace stipple
