// SPDX-License-Identifier: MIT
#include "study/wide_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/json.hpp"
#include "core/text.hpp"
#include "report/latex.hpp"

namespace stipple {
namespace {

struct WideCell {
    double value = not_known;
    double half_width = not_known;
};

WideCell cell_of(const MeanRow& row) {
    return is_error_key(row.key) ? WideCell{row.rms, (row.rms_high - row.rms_low) / 2}
                                 : WideCell{row.mean, (row.t_high - row.t_low) / 2};
}

/// Means by row and generator. Measures, keys and generators are in the order of the study.
struct Wide {
    /// Indices of measure and key, dimension, count.
    using Key = std::tuple<std::size_t, std::size_t, std::uint64_t, std::uint64_t>;

    std::vector<std::string> measures;
    std::vector<std::string> keys;
    std::vector<std::string> generators;
    std::map<Key, std::map<std::size_t, WideCell>> rows;

    explicit Wide(std::span<const MeanRow> means) {
        const auto index = [](std::vector<std::string>& known, const std::string& name) {
            auto it = std::ranges::find(known, name);
            if (it == known.end()) it = known.insert(it, name);
            return static_cast<std::size_t>(it - known.begin());
        };
        for (const MeanRow& row : means) {
            if (row.key.empty()) continue;  // all measurements failed
            auto& cells = rows[{index(measures, row.measure), index(keys, row.key), row.dimension,
                                row.count}];
            cells[index(generators, row.generator)] = cell_of(row);
        }
    }

    /// Texts of the first columns: measure, key, dimension, count.
    [[nodiscard]] std::vector<std::string> labels(const Key& row) const {
        return {measures[std::get<0>(row)], keys[std::get<1>(row)],
                std::to_string(std::get<2>(row)), std::to_string(std::get<3>(row))};
    }
};

constexpr std::size_t label_columns = 4;

}  // namespace

std::string wide_table(std::span<const MeanRow> means, TableStyle style) {
    const Wide wide(means);
    std::vector<std::string> names = {"measure", "key", "dimension", "count"};
    for (const std::string& generator : wide.generators)
        for (const char* what : {"", " half_width"}) names.push_back(generator + what);
    std::vector<TableCell> cells;
    for (const std::string& name : names) cells.push_back({.name = name, .text = name});
    std::string text = style == TableStyle::csv ? table_line(style, cells) : "";
    for (std::size_t i = 2; i < cells.size(); ++i) cells[i].number = true;
    const auto number = [](double x) { return std::isnan(x) ? "" : format_number(x); };
    for (const auto& [row, found] : wide.rows) {
        const auto labels = wide.labels(row);
        for (std::size_t i = 0; i < cells.size(); ++i)
            cells[i].text = i < label_columns ? labels[i] : "";
        for (const auto& [generator, cell] : found) {
            cells[label_columns + 2 * generator].text = number(cell.value);
            cells[label_columns + 2 * generator + 1].text = number(cell.half_width);
        }
        text += table_line(style, cells);
    }
    return text;
}

std::string wide_latex(std::span<const MeanRow> means, const std::string& command) {
    const Wide wide(means);
    LatexTable table{.comments = {fmt::format("stipple {}: {}", STIPPLE_VERSION, command)}};
    const std::vector<std::string> heads = {"measure", "key", "$d$", "$n$"};
    std::vector<std::size_t> shown;  // columns of labels that vary, or n
    for (std::size_t k = 0; k < label_columns; ++k) {
        const std::string first = wide.rows.empty() ? "" : wide.labels(wide.rows.begin()->first)[k];
        const bool varies = std::ranges::any_of(
            wide.rows, [&](const auto& row) { return wide.labels(row.first)[k] != first; });
        if (varies || (k == label_columns - 1 && shown.empty()))
            shown.push_back(k);
        else
            table.comments.push_back(fmt::format("{}: {}", heads[k], first));
    }
    if (!means.empty())
        table.comments.push_back(
            fmt::format("means (of errors: root mean squares) +- half of the {} % interval",
                        format_number(100 * means.front().confidence)));
    for (const std::size_t k : shown) {
        table.head.push_back(heads[k]);
        table.words += k < 2 ? 1 : 0;
    }
    for (const std::string& generator : wide.generators)
        table.head.push_back(latex_text(generator));
    for (const auto& [key, found] : wide.rows) {
        auto& row = table.rows.emplace_back();
        for (const std::size_t k : shown) row.push_back(latex_text(wide.labels(key)[k]));
        for (std::size_t g = 0; g < wide.generators.size(); ++g) {
            const auto cell = found.find(g);
            row.push_back(cell == found.end()
                              ? "--"
                              : latex_number(cell->second.value, cell->second.half_width));
        }
    }
    return latex_packages + table.text();
}

}  // namespace stipple
