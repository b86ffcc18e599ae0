// SPDX-License-Identifier: MIT
#include "io/columns.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/decimal.hpp"

namespace stipple::io {
namespace {

bool measures_points(const std::string& name) { return name == "pdf" || name == "weight"; }

/// Whether readers take a header field for a coordinate name; pdf and weight only if `table`.
bool is_name(const std::string& name, bool table) {
    return is_word(name) && name != "set" && (table || !measures_points(name));
}

/// Gives column pdf or, if missing, column weight the index after the coordinates. `density` gets
/// the name; "pdf,weight" if both exist.
void add_density(Columns& columns, const std::vector<std::string>& names) {
    for (const char* name : {"pdf", "weight"}) {
        const auto it = std::ranges::find(names, name);
        if (it == names.end()) continue;
        std::size_t& role = columns.role[static_cast<std::size_t>(it - names.begin())];
        if (role != Columns::checked) continue;
        if (columns.density.empty()) role = columns.dimension++;
        columns.density += (columns.density.empty() ? "" : ",") + std::string(name);
    }
}

/// Whether the first column has no name: R and pandas write row names so.
bool has_row_names(const std::vector<std::string>& names, const ReadOptions& options) {
    return names[0].empty() && !options.all_columns;
}

void pick(Columns& columns, const std::vector<std::string>& names, const ReadOptions& options,
          const std::string& place) {
    for (const std::string& wanted : options.columns) {
        std::size_t& role = columns.role[find_column(wanted, names, place)];
        if (role < columns.dimension)
            fail(ErrorKind::usage, "--column: '{}' is picked twice; pick each column once", wanted);
        role = columns.dimension++;
    }
}

}  // namespace

bool is_word(const std::string& text) {
    constexpr std::size_t longest = 200;
    double number = 0;
    const char* const last = text.data() + text.size();
    return !text.empty() && text.size() <= longest && text == printable(text) &&
           text == trim(text) && text.find('"') == std::string::npos &&
           std::string_view("#[{").find(text[0]) == std::string_view::npos &&
           read_number(text.data(), last, number) != last;
}

std::optional<std::vector<std::string>> csv_fields(std::string_view line) {
    std::vector<std::string> fields(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
            fields.back() += c;
            ++i;
        } else if (c == '"' && (quoted || trim(fields.back()).empty())) {
            quoted = !quoted;
        } else if (c == ',' && !quoted) {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return quoted ? std::nullopt : std::optional(fields);
}

std::vector<std::string> parse_names(std::string_view text, std::string_view option) {
    auto names = csv_fields(text);
    if (!names) fail(ErrorKind::usage, "--{}: a quote is not closed in '{}'", option, text);
    for (std::string& name : *names) name = trim(name);
    return *names;
}

std::vector<std::string> replace_names(std::vector<std::string>& names, bool table) {
    const auto defaults = coordinate_names(names.size());
    std::vector<std::string> sentences;
    for (std::size_t c = 0; c < names.size(); ++c) {
        if (is_name(names[c], table)) continue;
        const std::string refused = std::exchange(names[c], "");
        std::string name = defaults[c];
        while (std::ranges::find(names, name) != names.end()) name += '_';
        sentences.push_back(
            refused.empty()
                ? fmt::format("a column has no name; it is called {}", name)
                : fmt::format(
                      "the column {} is called {}; a name is printable, no number and not set, pdf "
                      "or weight, and has no quotation marks nor a leading #, [ or {{",
                      shown(refused), name));
        names[c] = std::move(name);
    }
    return sentences;
}

std::size_t find_column(const std::string& wanted, const std::vector<std::string>& names,
                        const std::string& place, const char* option) {
    const auto it = std::ranges::find(names, wanted);
    if (const auto alike = std::ranges::count(names, wanted); alike > 1)
        fail(ErrorKind::usage, "--{}: {} has {} columns '{}'; pick one by its number", option,
             place, alike, wanted);
    if (it != names.end()) return static_cast<std::size_t>(it - names.begin());
    const auto number = parse_integer(wanted);
    if (number && *number >= 1 && static_cast<std::size_t>(*number) <= names.size())
        return static_cast<std::size_t>(*number) - 1;
    fail_with_hint(ErrorKind::usage, suggest(wanted, names),
                   "--{}: {} has no column '{}'; its columns are 1 to {}", option, place, wanted,
                   names.size());
}

bool Columns::plain() const { return dimension == width() && std::ranges::is_sorted(role); }

bool Columns::has(std::size_t wanted) const {
    return std::ranges::find(role, wanted) != role.end();
}

Columns choose_columns(std::vector<std::string> names, std::size_t width,
                       const ReadOptions& options, const std::string& place) {
    const auto is_there = [&](const std::string& name) {
        return std::ranges::find(names, name) != names.end();
    };
    const auto missing = std::ranges::find_if_not(options.expected, is_there);
    if (options.columns.empty() && !options.expected.empty() && missing == options.expected.end()) {
        ReadOptions picked = options;
        picked.columns = options.expected;
        return choose_columns(std::move(names), width, picked, place);
    }
    // Default names (x, y, ...) carry no meaning: columns with such names are taken in order.
    auto kept = names;
    replace_names(kept, true);
    if (options.columns.empty() && missing != options.expected.end() && !kept_names(kept).empty())
        fail_with_hint(ErrorKind::input, suggest(*missing, names), "{}: there is no column '{}'",
                       place, *missing);
    Columns columns{.role = std::vector<std::size_t>(width, Columns::skipped)};
    const bool named = !names.empty();
    if (!named) names = coordinate_names(width);
    if (names[0] == "set") columns.role[0] = Columns::set_number;
    const bool strong = !options.strengths.empty();
    const std::size_t strength =
        strong ? find_column(options.strengths, names, place, "weights") : Columns::skipped;
    if (!options.columns.empty()) {
        pick(columns, names, options, place);
    } else {
        const std::size_t first = has_row_names(names, options) ? 1 : 0;
        for (std::size_t c = first; c < width; ++c)
            if (c == strength ||
                (measures_points(names[c]) && !options.all_columns && !options.gaps))
                columns.role[c] = Columns::checked;
            else if (columns.role[c] != Columns::set_number)
                columns.role[c] = columns.dimension++;
    }
    if (named) columns.names.resize(columns.dimension);
    for (std::size_t c = 0; named && c < width; ++c)
        if (columns.role[c] < columns.dimension) columns.names[columns.role[c]] = names[c];
    if (columns.dimension == 0)
        fail_with_hint(ErrorKind::input, "--column picks columns by name or number",
                       "{}: no column holds coordinates; the columns are {}", place,
                       join(names, ", "));
    if (strong && columns.role[strength] < columns.dimension)
        fail(ErrorKind::usage,
             "--weights: '{}' is also a coordinate; pick the coordinates by --column",
             options.strengths);
    if (options.dimension && *options.dimension != columns.dimension &&
        !(strong && *options.dimension == columns.dimension + 1))
        fail_with_hint(ErrorKind::input, "--column picks columns by name or number",
                       "{}: points have {} coordinates; --dimension is {}", place,
                       columns.dimension, *options.dimension);
    if (strong) columns.role[strength] = columns.dimension++;
    if (options.densities && options.columns.empty()) add_density(columns, names);
    return columns;
}

std::vector<std::string> kept_names(std::vector<std::string> names) {
    if (names == coordinate_names(names.size())) names.clear();
    return names;
}

DensityColumns density_columns(const Provenance& provenance) {
    const std::string& names = provenance.density_column;
    return {.pdf = names.starts_with("pdf"), .weight = names.ends_with("weight")};
}

void take_densities(PointSet& set) {
    const std::string& column = set.provenance.density_column;
    if (column.empty() || !set.densities.empty()) return;
    const std::size_t d = set.dimension() - 1;
    PointSet points(set.count(), d);
    points.densities.reserve(set.count());
    const bool pdf = density_columns(set.provenance).pdf;
    for (std::size_t i = 0; i < set.count(); ++i) {
        std::ranges::copy(set[i].first(d), points[i].begin());
        const double number = set[i][d];
        const double density = pdf ? number : 1 / number;
        if (!(pdf ? number > 0 : number == 0 || (number > 0 && std::isfinite(density))))
            fail(ErrorKind::input, "point {}: its {} is {}; expected a number {}", i, column,
                 number,
                 pdf          ? "above 0"
                 : number < 0 ? "not below 0"
                              : "whose inverse is a double");
        points.densities.push_back(density);
    }
    points.domain = std::move(set.domain);
    points.provenance = std::move(set.provenance);
    set = std::move(points);
}

std::vector<double> keep_coordinates(std::vector<double> table, const Columns& columns) {
    if (columns.plain()) return table;
    const std::size_t count = table.size() / columns.width();
    std::vector<double> row(columns.width());
    for (std::size_t i = 0; i < count; ++i) {
        std::copy_n(table.begin() + static_cast<std::ptrdiff_t>(i * row.size()), row.size(),
                    row.begin());
        for (std::size_t c = 0; c < row.size(); ++c)
            if (columns.role[c] < columns.dimension)
                table[i * columns.dimension + columns.role[c]] = row[c];
    }
    table.resize(count * columns.dimension);
    return table;
}

bool is_set_number(double value) {
    return value >= 0 && value <= 0x1p53 && value == std::floor(value);
}

std::vector<PointSet> gather_sets(std::vector<double> rows, std::size_t dimension,
                                  std::vector<Mark> marks, const Provenance& provenance) {
    // `#` lines do not separate the sets of a table.
    std::erase_if(marks, [](const Mark& mark) { return std::isnan(mark.number); });
    std::unordered_map<double, std::size_t> order;
    std::vector<std::uint64_t> numbers;
    for (const Mark& mark : marks)
        if (order.try_emplace(mark.number, order.size()).second)
            numbers.push_back(static_cast<std::uint64_t>(mark.number));
    std::vector<std::vector<double>> sets(order.size());
    for (std::size_t m = 0; m < marks.size() && order.size() > 1; ++m) {
        const std::size_t first = marks[m].row * dimension;
        const std::size_t last = m + 1 < marks.size() ? marks[m + 1].row * dimension : rows.size();
        const auto part = std::span(rows).subspan(first, last - first);
        auto& set = sets[order.at(marks[m].number)];
        set.insert(set.end(), part.begin(), part.end());
    }
    if (sets.size() == 1) sets[0] = std::move(rows);
    std::vector<PointSet> result;
    for (auto& set : sets) result.emplace_back(std::move(set), dimension);
    tell_origin(result, provenance, numbers);
    return result;
}

std::uint64_t seed_of_set(const Provenance& first, std::uint64_t set) {
    const bool scrambled = std::ranges::any_of(first.warps, [](const std::string& spec) {
        return spec.find("seed=") != std::string::npos;
    });
    return first.generator.empty() || scrambled ? first.seed : first.seed + set;
}

void tell_origin(std::vector<PointSet>& sets, const Provenance& provenance,
                 const std::vector<std::uint64_t>& numbers) {
    for (std::size_t r = 0; r < sets.size(); ++r) {
        sets[r].provenance = provenance;
        sets[r].provenance.seed = seed_of_set(provenance, numbers.empty() ? r : numbers.at(r));
    }
}

std::vector<PointSet> cut_sets(std::vector<double> rows, std::size_t dimension,
                               const std::vector<std::uint64_t>& starts,
                               const Provenance& provenance) {
    std::vector<PointSet> sets;
    if (starts.size() <= 1) {
        sets.emplace_back(std::move(rows), dimension);
    } else {
        for (std::size_t s = 0; s < starts.size(); ++s) {
            const auto at = [&](std::uint64_t row) {
                return rows.begin() + static_cast<std::ptrdiff_t>(row * dimension);
            };
            const auto last = s + 1 < starts.size() ? at(starts[s + 1]) : rows.end();
            sets.emplace_back(std::vector<double>(at(starts[s]), last), dimension);
        }
    }
    tell_origin(sets, provenance);
    return sets;
}

}  // namespace stipple::io
