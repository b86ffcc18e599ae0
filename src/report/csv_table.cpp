// SPDX-License-Identifier: MIT
//
// Two or more lists of equal length in one group of a report are curves, columns of a table with a
// row for each entry, if they are longer than the points have coordinates, or if one of them holds
// whole numbers. All other lists (a corner, a grid's extents, a mean for each axis) are numbers of
// their own: columns KEY.0, KEY.1... Tables of different groups or lengths follow each other and
// are empty where another's rows are, as after pandas.concat; what is no curve is repeated on every
// row.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "report/document.hpp"
#include "report/table_line.hpp"

namespace stipple {
namespace {

/// Cells of a list; nothing for what is no list.
std::vector<std::string> list_cells(const Report::Item& item) {
    std::vector<std::string> cells;
    if (const auto* curve = std::get_if<Report::Curve>(&item))
        for (const double x : *curve) cells.push_back(format_number(x));
    if (const auto* list = std::get_if<Report::Integers>(&item))
        for (const std::int64_t i : *list) cells.push_back(std::to_string(i));
    return cells;
}

bool is_list(const Report::Item& item) {
    return std::holds_alternative<Report::Curve>(item) ||
           std::holds_alternative<Report::Integers>(item);
}

std::string single_cell(const Report::Item& item) {
    if (const auto* flag = std::get_if<bool>(&item)) return *flag ? "true" : "false";
    if (const auto* whole = std::get_if<std::int64_t>(&item)) return std::to_string(*whole);
    if (const auto* number = std::get_if<double>(&item)) return format_number(*number);
    if (const auto* text = std::get_if<std::string>(&item)) return *text;
    return {};
}

/// Columns by name, in the order in which they first come.
class Columns {
  public:
    void add(const std::string& name) {
        if (seen_.insert(name).second) names_.push_back(name);
    }
    [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

  private:
    std::vector<std::string> names_;
    std::set<std::string> seen_;
};

/// The rows of one measurement.
struct ValueRows {
    std::vector<std::pair<std::string, std::string>> single;  ///< the same on each row
    std::vector<std::vector<std::pair<std::string, std::vector<std::string>>>> tables;

    /// Lists are curves where those of `like`, under the same keys, are.
    void add(const Report& report, const Report& like, const std::string& prefix,
             std::size_t dimension);
};

/// Sorts the entries of a report into single cells and tables.
void ValueRows::add(const Report& report, const Report& like, const std::string& prefix,
                    std::size_t dimension) {
    const auto keys = report.keys();
    struct Alike {
        std::size_t lists = 0;
        bool whole = false;  ///< one of them holds whole numbers

        [[nodiscard]] bool table(bool more_than_axes) const {
            return lists > 1 && (more_than_axes || whole);
        }
    };
    std::map<std::pair<std::string, std::size_t>, Alike> alike;  // of group and length
    const auto place = [&](const std::string& key, std::size_t length) {
        const auto dot = key.rfind('.');
        return std::pair(dot == std::string::npos ? "" : key.substr(0, dot), length);
    };
    for (const auto& key : like.keys()) {
        const Report::Item& item = *like.find(key);
        if (!is_list(item)) continue;
        Alike& same = alike[place(key, list_cells(item).size())];
        ++same.lists;
        same.whole |= std::holds_alternative<Report::Integers>(item);
    }
    std::map<std::pair<std::string, std::size_t>, std::size_t> table_of;
    for (const auto& key : keys) {
        const Report::Item& item = *report.find(key);
        if (!is_list(item)) {
            single.emplace_back(prefix + key, single_cell(item));
            continue;
        }
        auto cells = list_cells(item);
        const auto at = place(key, cells.size());
        if (!alike[at].table(cells.size() > dimension)) {
            for (std::size_t i = 0; i < cells.size(); ++i)
                single.emplace_back(fmt::format("{}{}.{}", prefix, key, i), std::move(cells[i]));
            continue;
        }
        const auto [table, fresh] = table_of.emplace(at, tables.size());
        if (fresh) tables.emplace_back();
        tables[table->second].emplace_back(prefix + key, std::move(cells));
    }
}

/// Standard errors of curves belong to the rows of these curves.
void join_errors(ValueRows& rows, ValueRows errors, const std::string& prefix) {
    rows.single.insert(rows.single.end(), errors.single.begin(), errors.single.end());
    for (auto& table : errors.tables) {
        const std::string key = table.front().first.substr(prefix.size());
        const auto same = std::ranges::find_if(rows.tables, [&](const auto& of) {
            return std::ranges::any_of(of, [&](const auto& column) { return column.first == key; });
        });
        auto& target = same != rows.tables.end() ? *same : rows.tables.emplace_back();
        std::ranges::move(table, std::back_inserter(target));
    }
}

ValueRows rows_of(const Measurement& m) {
    ValueRows rows;
    rows.single = {{"analyzer", m.analyzer},
                   {"source", m.source},
                   {"set", m.set ? std::to_string(*m.set) : ""},
                   {"count", std::to_string(m.count)},
                   {"dimension", std::to_string(m.dimension)},
                   {"domain", m.domain}};
    rows.add(m.results, m.results, "", m.dimension);
    const std::string prefix = "standard_error.";
    ValueRows errors;
    if (m.standard_error) errors.add(*m.standard_error, m.results, prefix, m.dimension);
    join_errors(rows, std::move(errors), prefix);
    return rows;
}

void write_row(const std::map<std::string, std::string>& cells,
               const std::vector<std::string>& columns, std::string& text) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        const auto cell = cells.find(columns[i]);
        if (i > 0) text += ',';
        if (cell != cells.end()) text += csv_field(cell->second);
    }
    text += '\n';
}

}  // namespace

std::string to_csv(std::span<const Measurement> measurements) {
    if (measurements.empty()) return {};
    std::vector<ValueRows> all;
    Columns columns;
    for (const Measurement& m : measurements) all.push_back(rows_of(m));
    for (const ValueRows& rows : all) {
        for (const auto& [name, cell] : rows.single) columns.add(name);
        for (const auto& table : rows.tables)
            for (const auto& [name, cells] : table) columns.add(name);
    }
    std::string text = join(columns.names(), ",") + "\n";
    for (const ValueRows& rows : all) {
        const std::map<std::string, std::string> single(rows.single.begin(), rows.single.end());
        if (rows.tables.empty()) write_row(single, columns.names(), text);
        for (const auto& table : rows.tables)
            for (std::size_t i = 0; i < table.front().second.size(); ++i) {
                auto cells = single;
                for (const auto& [name, list] : table) cells[name] = list[i];
                write_row(cells, columns.names(), text);
            }
    }
    return text;
}

}  // namespace stipple
