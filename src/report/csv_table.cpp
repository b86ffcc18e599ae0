// SPDX-License-Identifier: MIT
//
// Measurements as a CSV table. Two or more lists of equal length in one group of a report are
// curves, if they are longer than the number of coordinates, or if one of them holds integers.
// Curves are columns with a row for each entry. All other lists (a corner, a grid's extents, a mean
// for each axis) become separate columns KEY.0, KEY.1... Tables of different groups or lengths
// follow each other, with empty cells in the columns of other tables, as after pandas.concat.
// Single values are repeated on every row.
#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "core/text.hpp"
#include "report/document.hpp"
#include "report/table_line.hpp"

namespace stipple {
namespace {

/// Cells of a list; nullopt for other items.
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

using Cells = std::vector<std::pair<std::string, std::string>>;  // pairs of column and cell

/// Lists of equal length in one group of the results.
struct Lists {
    std::size_t count = 0;
    bool whole = false;            ///< whether one of the lists holds integers
    std::vector<Cells> rows = {};  ///< cells of each entry, if the lists are curves
};

class MeasurementCells {
  public:
    explicit MeasurementCells(const Measurement& m)
        : dimension_(m.dimension),
          single_{{"analyzer", m.analyzer},
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
        add(m.results, "");
        if (m.standard_error) add(*m.standard_error, "standard_error.");
    }

    [[nodiscard]] std::vector<Cells> rows() const {
        if (tables_.empty()) return {single_};
        std::vector<Cells> rows;
        for (const Lists* table : tables_)
            for (const Cells& row : table->rows) {
                rows.push_back(single_);
                rows.back().insert(rows.back().end(), row.begin(), row.end());
            }
        return rows;
    }

  private:
    Lists& lists_of(const std::string& key, std::size_t length) {
        const auto dot = key.rfind('.');
        return lists_[{dot == std::string::npos ? "" : key.substr(0, dot), length}];
    }

    void add(const Report& report, const std::string& prefix) {
        for (const auto& key : report.keys()) {
            const Report::Item& item = *report.find(key);
            const auto cells = list_cells(item);
            if (!cells) {
                single_.emplace_back(prefix + key, single_cell(item));
                continue;
            }
            Lists& lists = lists_of(key, cells->size());
            const bool curve = lists.count > 1 && (cells->size() > dimension_ || lists.whole);
            if (curve && lists.rows.empty()) tables_.push_back(&lists);
            if (curve) lists.rows.resize(cells->size());
            for (std::size_t i = 0; i < cells->size(); ++i)
                if (curve)
                    lists.rows[i].emplace_back(prefix + key, (*cells)[i]);
                else
                    single_.emplace_back(fmt::format("{}{}.{}", prefix, key, i), (*cells)[i]);
        }
    }

    std::size_t dimension_;
    Cells single_;  ///< cells that are repeated on each row
    std::map<std::pair<std::string, std::size_t>, Lists> lists_;
    std::vector<const Lists*> tables_;  ///< tables in order of appearance
};

}  // namespace

std::string to_csv(std::span<const Measurement> measurements) {
    std::vector<Cells> rows;
    std::vector<std::string> columns;  // in order of first appearance
    std::map<std::string, std::size_t> places;
    for (const Measurement& m : measurements)
        for (Cells& row : MeasurementCells(m).rows()) {
            for (const auto& [name, cell] : row)
                if (places.try_emplace(name, columns.size()).second)
                    columns.push_back(csv_field(name));
            rows.push_back(std::move(row));
        }
    std::string text = columns.empty() ? "" : join(columns, ",") + "\n";
    for (const Cells& row : rows) {
        std::vector<std::string> fields(columns.size());
        for (const auto& [name, cell] : row)
            if (std::string& field = fields[places[name]]; field.empty()) field = csv_field(cell);
        text += join(fields, ",") + "\n";
    }
    return text;
}

}  // namespace stipple
