// SPDX-License-Identifier: MIT
//
// Reads the runs of a model: outputs with a separate file of inputs, or both in one table.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/domain.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "experiments/sensitivity/methods.hpp"
#include "io/columns.hpp"
#include "io/files.hpp"
#include "stipple/warp.hpp"

namespace stipple::analyzers::sensitivity {
namespace {

using Names = std::vector<std::string>;
using Numbers = std::vector<std::size_t>;

struct Columns {
    const PointSet& table;
    Names names;
    std::string place;  ///< name of the table in messages
};

bool in(const Numbers& columns, std::size_t c) {
    return std::ranges::find(columns, c) != columns.end();
}

Numbers without(Numbers columns, const Numbers& those) {
    std::erase_if(columns, [&](std::size_t c) { return in(those, c); });
    return columns;
}

std::string names_of(const Numbers& columns, const Names& names) {
    Names some;
    for (const std::size_t c : columns) some.push_back(names[c]);
    return join(some, ", ");
}

Numbers all_columns(const PointSet& table) {
    Numbers all(table.dimension());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

Numbers picked_columns(const std::string& wanted, const Columns& from, const char* option) {
    Numbers columns;
    for (const std::string& name : io::parse_names(wanted, option)) {
        const auto c = io::find_column(name, from.names, from.place, option);
        if (in(columns, c)) fail(ErrorKind::usage, "--{}: '{}' is given twice", option, name);
        columns.push_back(c);
    }
    return columns;
}

PointSet columns_of(const PointSet& table, const Numbers& columns) {
    PointSet part(table.count(), columns.size());
    for (std::size_t i = 0; i < table.count(); ++i)
        for (std::size_t j = 0; j < columns.size(); ++j) part[i][j] = table[i][columns[j]];
    return part;
}

/// Domain of the inputs, with the names of its coordinates; null if unknown.
struct Known {
    DomainPtr domain;
    Names names;
};

/// Domain from the provenance; without names if neither the domain nor a generator gives them.
Known known_inputs(const Provenance& told, std::size_t inputs, const RunContext& run) {
    const bool made = !told.generator.empty();
    if (told.domain.empty() || (told.domain == "unit-cube" && !made)) return {};
    const std::size_t k = told.dimension > 0 ? told.dimension : inputs;
    Known known{domain_named(told.domain, k, run), {}};
    known.names = known.domain->names();
    if (known.names.empty() && made) known.names = coordinate_names(k, told);
    return known;
}

/// Columns with these names, in the same order; empty if some are missing.
Numbers named_columns(const Names& wanted, const Names& names) {
    Numbers columns;
    for (const auto& name : wanted) {
        const auto it = std::ranges::find(names, name);
        if (it == names.end()) return {};
        columns.push_back(static_cast<std::size_t>(it - names.begin()));
    }
    return columns;
}

/// Columns with the known names. @throws Error(input) if some are missing
Numbers known_columns(const Known& known, const Columns& from) {
    Numbers columns = named_columns(known.names, from.names);
    if (!columns.empty()) return columns;
    Names missing;
    for (const auto& name : known.names)
        if (std::ranges::find(from.names, name) == from.names.end()) missing.push_back(name);
    fail_with_hint(ErrorKind::input, "--inputs selects the inputs",
                   "{} has no column {} for the inputs of its design; its columns are {}",
                   from.place, join(missing, ", "), join(from.names, ", "));
}

/// Columns with the domain's coordinates; empty if some are missing. @throws Error(usage) if the
/// domain has no names and not as many coordinates as there are `columns`
Numbers coordinates_of(const Known& known, const Columns& from, const Numbers& columns,
                       const RunContext& run) {
    const std::size_t k = known.domain->dimension();
    Numbers coordinates = named_columns(known.names, from.names);
    if (!coordinates.empty()) return coordinates;
    if (columns.size() == k) return columns;
    if (known.names.empty())
        fail(ErrorKind::usage, "--bounds and --domain: {} coordinates, but {} inputs: {}", k,
             columns.size(), names_of(columns, from.names));
    run.notify(fmt::format("{}: some of {} are missing, so that their distribution is ignored",
                           from.place, join(known.names, ", ")));
    return {};
}

/// Whether the coordinates are independent: two points that exchange a coordinate then keep the
/// product of their densities.
bool independent(const Domain& domain, const PointSet& points) {
    constexpr std::size_t most = 100;
    constexpr double rounding = 1e-9;
    const std::size_t n = points.count();
    for (std::size_t t = 0; t < std::min(n, most); ++t) {
        const auto x = points[t * n / std::min(n, most)];
        const auto y = points[(t * n / std::min(n, most) + n / 2 + t) % n];
        for (std::size_t j = 0; j < points.dimension(); ++j) {
            std::vector<double> a(x.begin(), x.end()), b(y.begin(), y.end());
            std::swap(a[j], b[j]);
            try {
                const double before = std::log(domain.density(x)) + std::log(domain.density(y));
                const double after = std::log(domain.density(a)) + std::log(domain.density(b));
                if (!std::isfinite(before)) continue;  // density 0 or infinite, as at ends
                if (!(std::abs(after - before) <= rounding * (1 + std::abs(before)))) return false;
            } catch (const Error&) {  // the density is unknown, as with constraints
                return false;
            }
        }
    }
    return true;
}

void require_finite(const Inputs& inputs) {
    for (std::size_t i = 0; i < inputs.runs(); ++i)
        for (std::size_t j = 0; j < inputs.size(); ++j)
            if (!std::isfinite(inputs.values[i][j]))
                fail(ErrorKind::input,
                     "the input {} of point {} is missing; only outputs may be missing",
                     inputs.names[j], i);
}

/// Inputs in the given columns, with their domain if it is known and contains them.
Inputs inputs_of(const Columns& from, const Numbers& columns, const Known& known,
                 const RunContext& run) {
    Inputs inputs{.values = columns_of(from.table, columns)};
    for (const std::size_t c : columns) inputs.names.push_back(from.names[c]);
    inputs.generator = from.table.provenance.generator;
    require_finite(inputs);
    if (!known.domain) return inputs;
    const Numbers coordinates = coordinates_of(known, from, columns, run);
    for (const std::size_t c : columns) {
        const auto it = std::ranges::find(coordinates, c);
        if (it == coordinates.end()) return inputs;
        inputs.coordinates.push_back(static_cast<std::size_t>(it - coordinates.begin()));
    }
    inputs.points = columns_of(from.table, coordinates);
    for (std::size_t i = 0; i < inputs.runs(); ++i)
        if (!known.domain->contains(inputs.points[i])) {
            run.notify(fmt::format("the inputs of point {} are outside {}; this domain is ignored",
                                   i, known.domain->title()));
            return inputs;
        }
    if (independent(*known.domain, inputs.points))
        inputs.domain = known.domain;
    else
        run.notify(
            "a constraint or a correlation makes the inputs depend on each other, but the indices "
            "assume independent inputs: take them for a rough ranking");
    return inputs;
}

/// Outputs in the given columns. @throws Error(input) if one of them contains words
std::vector<Response> responses_of(const Columns& from, const Numbers& columns) {
    std::vector<Response> responses;
    for (const std::size_t c : columns) {
        for (const auto& [column, words] : from.table.provenance.levels)
            if (column == from.names[c])
                fail_with_hint(ErrorKind::input, "--response selects outputs",
                               "the output {} contains words, such as {}; expected numbers", column,
                               words.empty() ? "" : words.front());
        responses.push_back({from.names[c], column_of(from.table, c)});
    }
    return responses;
}

/// First point at which columns c and j differ by more than `rounding` times the number or column
/// j's range, whichever is larger; the number of points if there is none.
std::size_t first_difference(const PointSet& table, std::size_t c, const PointSet& design,
                             std::size_t j, double rounding) {
    double room = 0;
    if (rounding > 0) {
        const auto [low, high] = std::ranges::minmax(column_of(design, j));
        room = rounding * (high - low);
    }
    std::size_t i = 0;
    while (i < table.count() && std::abs(table[i][c] - design[i][j]) <=
                                    std::max(room, rounding * std::abs(design[i][j])))
        ++i;
    return i;
}

/// Columns of the table that are not copies of candidates, which are columns of the design.
Numbers other_columns(const Columns& table, const Columns& design, const Numbers& candidates,
                      const RunContext& run) {
    const bool named = !table.table.provenance.columns.empty();
    const std::size_t n = table.table.count();
    Numbers others;
    for (std::size_t c = 0; c < table.names.size(); ++c) {
        bool copy = false;
        for (const std::size_t j : candidates) {
            const bool same_name = table.names[c] == design.names[j];
            const std::size_t i =
                first_difference(table.table, c, design.table, j, same_name ? 1e-5 : 0);
            copy = copy || (i == n && same_name);
            if (named && same_name && i < n)
                fail_with_hint(ErrorKind::input,
                               "are the rows in another order? --response selects outputs",
                               "the column {} has the name of an input, but other numbers: {} in "
                               "point {}, where {} has {}",
                               table.names[c], format_number(table.table[i][c]), i, design.place,
                               format_number(design.table[i][j]));
            if (i == n && !same_name)
                run.notify(fmt::format("the output {} is equal to the input {}", table.names[c],
                                       design.names[j]));
        }
        if (!copy) others.push_back(c);
    }
    if (others.empty())
        fail_with_hint(ErrorKind::input, "--response selects outputs",
                       "all columns of the table are copies of inputs: {}",
                       join(table.names, ", "));
    return others;
}

void note_unused(const Columns& table, const Numbers& inputs, const Numbers& outputs,
                 const RunContext& run) {
    const Numbers unused = without(without(all_columns(table.table), inputs), outputs);
    if (unused.empty()) return;
    run.notify(fmt::format("{}: columns that are neither input nor output: {}", table.place,
                           names_of(unused, table.names)));
}

/// Names of the columns; a single output without a name is called "y".
Names output_names(const PointSet& table) {
    if (table.dimension() == 1 && table.provenance.columns.empty()) return {"y"};
    return coordinate_names(table.dimension(), table.provenance);
}

/// Whether columns are assumed to be the domain's coordinates in order, since names are missing.
bool by_position(const Known& known, const PointSet& table) {
    return known.names.empty() ||
           (table.provenance.columns.empty() && known.names.size() == table.dimension());
}

Runs with_design(const PointSet& outputs, const ColumnsAsked& asked, const RunContext& run) {
    const PointSet design =
        io::read_given("design", asked.design, {.levels = outputs.provenance.levels}, run);
    if (design.count() != outputs.count())
        fail(ErrorKind::input, "{}: {} rows; the outputs have {}", asked.design, design.count(),
             outputs.count());
    const Columns table{outputs, output_names(outputs), "the table"};
    const Columns from{design, coordinate_names(design.dimension(), design.provenance),
                       asked.design};
    Numbers candidates = all_columns(design);
    Numbers inputs =
        asked.inputs.empty() ? candidates : picked_columns(asked.inputs, from, "inputs");
    Known known = known_inputs(outputs.provenance, inputs.size(), run);
    if (!known.domain) known = known_inputs(design.provenance, inputs.size(), run);
    if (asked.inputs.empty() && known.domain && !by_position(known, design)) {
        candidates = inputs = known_columns(known, from);
        note_unused(from, inputs, {}, run);
    }
    Inputs found = inputs_of(from, inputs, known, run);
    const Numbers outs = asked.response.empty() ? other_columns(table, from, candidates, run)
                                                : picked_columns(asked.response, table, "response");
    return {std::move(found), responses_of(table, outs)};
}

Runs without_design(const PointSet& all, const ColumnsAsked& asked, const RunContext& run) {
    const Columns table{all, coordinate_names(all.dimension(), all.provenance), "the table"};
    const Numbers columns = all_columns(all);
    Numbers inputs, outputs;
    if (!asked.inputs.empty()) inputs = picked_columns(asked.inputs, table, "inputs");
    if (!asked.response.empty()) outputs = picked_columns(asked.response, table, "response");
    const std::size_t others = columns.size() - std::max<std::size_t>(outputs.size(), 1);
    const Known known = known_inputs(all.provenance, inputs.empty() ? others : inputs.size(), run);
    const bool told = known.domain && !known.names.empty() && asked.inputs.empty();
    const Numbers candidates = told ? known_columns(known, table) : columns;
    if (asked.response.empty())
        outputs = told ? without(columns, candidates) : Numbers{columns.back()};
    if (asked.inputs.empty()) inputs = without(candidates, outputs);
    for (const std::size_t c : outputs)
        if (in(inputs, c))
            fail_with_hint(ErrorKind::usage, "--response selects outputs",
                           "--inputs: '{}' is also an output", table.names[c]);
    if (inputs.empty() || outputs.empty())
        fail_with_hint(
            ErrorKind::input,
            inputs.empty() ? "--design names the file of the inputs" : "--response selects outputs",
            "a table of {} column{} has no {}", columns.size(), columns.size() == 1 ? "" : "s",
            inputs.empty() ? "inputs besides the outputs" : "outputs besides the inputs");
    if (asked.inputs.empty() && asked.response.empty() && !told)
        run.notify(
            fmt::format("the last column is used as the output, {}, and the others as inputs, {}; "
                        "--response and --inputs select others",
                        table.names[outputs[0]], names_of(inputs, table.names)));
    note_unused(table, inputs, outputs, run);
    return {inputs_of(table, inputs, known, run), responses_of(table, outputs)};
}

}  // namespace

Runs runs_of(const PointSet& table, const ColumnsAsked& asked, const RunContext& run) {
    return asked.design.empty() ? without_design(table, asked, run)
                                : with_design(table, asked, run);
}

}  // namespace stipple::analyzers::sensitivity
