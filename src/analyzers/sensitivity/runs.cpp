// SPDX-License-Identifier: MIT
#include "analyzers/sensitivity/runs.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

using Numbers = std::vector<std::size_t>;

Numbers picked_columns(const std::string& wanted, const std::vector<std::string>& names,
                       const std::string& place, const char* option) {
    Numbers columns;
    for (const auto word : split(wanted, ',')) {
        const auto c = io::find_column(std::string(trim(word)), names, place, option);
        if (std::ranges::find(columns, c) != columns.end())
            fail(ErrorKind::usage, "--{}: '{}' is named twice", option, trim(word));
        columns.push_back(c);
    }
    return columns;
}

std::vector<double> column_of(const PointSet& table, std::size_t c) {
    std::vector<double> values(table.count());
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = table[i][c];
    return values;
}

/// Those columns of a table, which is kept whole where they are all.
Inputs inputs_of(PointSet table, const std::vector<std::string>& names, const Numbers& columns) {
    Inputs inputs;
    for (const std::size_t c : columns) inputs.names.push_back(names[c]);
    if (columns.size() == table.dimension() && std::ranges::is_sorted(columns)) {
        inputs.values = std::move(table);
        return inputs;
    }
    inputs.values = PointSet(table.count(), columns.size());
    for (std::size_t i = 0; i < table.count(); ++i)
        for (std::size_t j = 0; j < columns.size(); ++j) inputs.values[i][j] = table[i][columns[j]];
    return inputs;
}

Numbers all_columns(const PointSet& table) {
    Numbers all(table.dimension());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

/// Columns of the table that are no copy of an input, by name where the table has its own, or by
/// their numbers; the last one where there is no other.
Numbers other_columns(const PointSet& table, const std::vector<std::string>& names,
                      const PointSet& design, const std::vector<std::string>& design_names) {
    const bool named = !table.provenance.columns.empty();
    Numbers others;
    for (std::size_t c = 0; c < table.dimension(); ++c) {
        bool copy = named && std::ranges::find(design_names, names[c]) != design_names.end();
        for (std::size_t j = 0; j < design.dimension() && !copy; ++j) {
            std::size_t i = 0;
            while (i < table.count() && table[i][c] == design[i][j]) ++i;
            copy = i == table.count();
        }
        if (!copy) others.push_back(c);
    }
    if (others.empty()) others.push_back(table.dimension() - 1);
    return others;
}

/// Names of the coordinates or, of a single output that has none, "y".
std::vector<std::string> output_names(const PointSet& table) {
    if (table.dimension() == 1 && table.provenance.columns.empty()) return {"y"};
    return coordinate_names(table.dimension(), table.provenance);
}

void require_inputs_finite(const Inputs& inputs) {
    for (std::size_t i = 0; i < inputs.runs(); ++i)
        for (std::size_t j = 0; j < inputs.size(); ++j)
            if (!std::isfinite(inputs.values[i][j]))
                fail(ErrorKind::input, "the input {} of point {} is missing; only outputs may be",
                     inputs.names[j], i);
}

Runs with_design(const PointSet& table, const ColumnsAsked& asked, const RunContext& run) {
    PointSet design = io::read_given("design", asked.design, {}, run);
    if (design.count() != table.count())
        fail(ErrorKind::input, "{}: {} rows; the outputs have {}", asked.design, design.count(),
             table.count());
    const auto names = output_names(table);
    const auto design_names = coordinate_names(design.dimension(), design.provenance);
    const Numbers outputs = asked.response.empty()
                                ? other_columns(table, names, design, design_names)
                                : picked_columns(asked.response, names, "the table", "response");
    const Numbers inputs = asked.inputs.empty()
                               ? all_columns(design)
                               : picked_columns(asked.inputs, design_names, asked.design, "inputs");
    Runs runs{.inputs = inputs_of(std::move(design), design_names, inputs), .responses = {}};
    for (const std::size_t c : outputs) runs.responses.push_back({names[c], column_of(table, c)});
    return runs;
}

Runs without_design(const PointSet& table, const ColumnsAsked& asked) {
    const auto names = coordinate_names(table.dimension(), table.provenance);
    Numbers inputs = asked.inputs.empty()
                         ? Numbers()
                         : picked_columns(asked.inputs, names, "the table", "inputs");
    Numbers outputs = asked.response.empty()
                          ? Numbers{table.dimension() - 1}
                          : picked_columns(asked.response, names, "the table", "response");
    const auto in = [](const Numbers& columns, std::size_t c) {
        return std::ranges::find(columns, c) != columns.end();
    };
    for (const std::size_t c : all_columns(table))
        if (asked.inputs.empty() && !in(outputs, c)) inputs.push_back(c);
    for (const std::size_t c : outputs)
        if (in(inputs, c))
            fail_with_hint(ErrorKind::usage, "--response picks outputs",
                           "--inputs: '{}' is an output, too", names[c]);
    if (inputs.empty())
        fail_with_hint(ErrorKind::input, "--design names the file of the inputs",
                       "a table of {} column{} holds no inputs beside the outputs",
                       table.dimension(), table.dimension() == 1 ? "" : "s");
    Runs runs{.inputs = inputs_of(table, names, inputs), .responses = {}};
    for (const std::size_t c : outputs) runs.responses.push_back({names[c], column_of(table, c)});
    return runs;
}

}  // namespace

Runs runs_of(const PointSet& table, const ColumnsAsked& asked, const RunContext& run) {
    Runs runs =
        asked.design.empty() ? without_design(table, asked) : with_design(table, asked, run);
    require_inputs_finite(runs.inputs);
    return runs;
}

}  // namespace stipple::analyzers::sensitivity
