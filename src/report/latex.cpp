// SPDX-License-Identifier: MIT
#include "report/latex.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/text.hpp"

namespace stipple {
namespace {

std::string escaped(char c) {
    switch (c) {
        case '&':
        case '%':
        case '$':
        case '#':
        case '_':
        case '{':
        case '}':
            return {'\\', c};
        case '\\':
            return "\\textbackslash{}";
        case '~':
            return "\\textasciitilde{}";
        case '^':
            return "\\textasciicircum{}";
        case '<':
            return "\\textless{}";
        case '>':
            return "\\textgreater{}";
        case '|':
            return "\\textbar{}";
        default:
            return {c};
    }
}

/// Decimal exponent of the first digit after rounding to `digits` digits.
int exponent_of(double x, int digits) {
    const std::string text = fmt::format("{:.{}e}", x, std::clamp(digits, 1, 17) - 1);
    return std::stoi(text.substr(text.find('e') + 1));
}

/// value / 10^exponent with `digits` digits after the point, even if the power of ten is beyond the
/// range of double; without the sign of 0.
std::string shifted(double value, int exponent, int digits) {
    const int half = exponent / 2;
    const double number = value / std::pow(10.0, half) / std::pow(10.0, exponent - half);
    std::string text = fmt::format("{:.{}f}", number, digits);
    if (text.find_first_not_of("-0.") == std::string::npos && text[0] == '-') text.erase(0, 1);
    return text;
}

}  // namespace

std::string latex_text(std::string_view text) {
    std::string out;
    for (const char c : printable(text)) {
        if (c == '-' && out.ends_with('-')) out += "{}";  // "--" would become a dash
        out += escaped(c);
    }
    return out;
}

std::string latex_number(double value, double half_width) {
    if (std::isnan(value)) return "--";
    if (std::isinf(value)) return value > 0 ? "$\\infty$" : "$-\\infty$";
    const bool spread = std::isfinite(half_width) && half_width > 1e-12 * std::abs(value);
    if (value == 0 && !spread) return "$0$";
    const bool whole = value == std::floor(value) && std::abs(value) < 1e6;
    if (whole && !spread) return fmt::format("${:.0f}$", value);
    const double largest = std::max(std::abs(value), spread ? half_width : 0);
    const int width = spread ? exponent_of(half_width, 2) : 0;
    const int first = exponent_of(largest, spread ? exponent_of(largest, 17) - width + 2 : 4);
    const int last = spread ? width - 1 : first - 3;
    const bool scaled = first < -3 || first > 5;
    const int unit = scaled ? first : 0;
    const int digits = std::clamp(unit - last, 0, 15);
    std::string text =
        scaled && !spread ? fmt::format("{:.3e}", value) : shifted(value, unit, digits);
    text.resize(std::min(text.find('e'), text.size()));
    if (spread) text += " \\pm " + shifted(half_width, unit, digits);
    if (!scaled) return "$" + text + "$";
    if (spread) text = "(" + text + ")";
    return fmt::format("${} \\times 10^{{{}}}$", text, first);
}

std::string LatexTable::text() const {
    std::string out;
    for (const std::string& comment : comments) out += "% " + printable(comment) + "\n";
    out += fmt::format("\\begin{{tabular}}{{{}{}}}\n\\toprule\n", std::string(words, 'l'),
                       std::string(head.size() - words, 'r'));
    const auto line = [](const std::vector<std::string>& cells) {
        return join(cells, " & ") + " \\\\\n";
    };
    out += line(head) + "\\midrule\n";
    for (const auto& row : rows) out += line(row);
    return out + "\\bottomrule\n\\end{tabular}\n";
}

namespace {

void add_new(std::vector<std::string>& words, const std::string& word) {
    if (std::ranges::find(words, word) == words.end()) words.push_back(word);
}

/// Numbers of a report by key, and those of its short lists as KEY[I].
std::map<std::string, double> numbers_in(const Report& report, std::vector<std::string>& keys) {
    constexpr std::size_t few = 9;
    std::map<std::string, double> found;
    const auto add = [&](const std::string& key, double number) {
        found[key] = number;
        add_new(keys, key);
    };
    for (const std::string& key : report.keys()) {
        if (const auto number = number_at(report, key)) add(key, *number);
        const auto list = list_at(report, key).value_or(Report::Curve());
        for (std::size_t i = 0; i < list.size() && list.size() <= few; ++i)
            add(fmt::format("{}[{}]", key, i), list[i]);
    }
    return found;
}

/// Position of a number in a table with a row for each group and each list entry: the number
/// y.x.first is in row y.x, column first, and mean[0] is in row [0], column mean.
struct Position {
    std::string group = {};
    std::string entry = {};  ///< index in a list, such as "[0]"; or empty
    std::string column = {};

    explicit Position(const std::string& key, bool whole) : column(key) {
        if (whole) return;
        const std::size_t end = key.ends_with(']') ? key.rfind('[') : key.size();
        const std::size_t name = key.rfind('.', end) + 1;  // 0 without a group
        group = key.substr(0, name);
        column = key.substr(name, end - name);
        entry = key.substr(end);
    }
    [[nodiscard]] std::string key(std::string_view end = "") const {
        return fmt::format("{}{}{}{}", group, column, end, entry);
    }
    [[nodiscard]] std::string row() const {
        return group.substr(0, std::max<std::size_t>(group.size(), 1) - 1) + entry;
    }
    /// Depth of the group, and whether the number is in a list. Each kind has its own table.
    [[nodiscard]] std::pair<std::ptrdiff_t, bool> kind() const {
        return {std::ranges::count(group, '.'), !entry.empty()};
    }
};

/// Adds a row for each group and list entry in `positions` for which a measurement has numbers.
void add_rows(LatexTable& table, const Measurement& m, std::span<const Position> positions,
              std::span<const std::string> columns) {
    std::vector<std::string> unused;
    const auto values = numbers_in(m.results, unused);
    const auto errors = numbers_in(m.standard_error.value_or(Report()), unused);
    const auto at = [](const auto& numbers, const std::string& key) {
        const auto it = numbers.find(key);
        return it == numbers.end() ? std::nan("") : it->second;
    };
    std::string source = m.source == "-" ? "standard input" : m.source;
    if (m.set) source += fmt::format(", set {}", *m.set);
    std::vector<std::string> rows;
    for (Position cell : positions) {
        const std::size_t before = rows.size();
        if (values.contains(cell.key())) add_new(rows, cell.row());
        if (rows.size() == before) continue;
        auto& row = table.rows.emplace_back(std::vector{latex_text(source)});
        if (table.words > 1) row.push_back(latex_text(cell.row()));
        row.push_back(std::to_string(m.count));
        for (const std::string& column : columns) {
            cell.column = column;
            row.push_back(latex_number(at(values, cell.key()), at(errors, cell.key())));
            if (values.contains(cell.key("_low")) && values.contains(cell.key("_high")))
                row.back() +=
                    fmt::format(" [{}, {}]", latex_number(at(values, cell.key("_low")), 0),
                                latex_number(at(values, cell.key("_high")), 0));
        }
    }
}

/// Tables of one analyzer's measurements: with a column for each number or, if these are too many,
/// a table for each kind of numbers.
std::string tables_of(std::span<const Measurement> all, const std::string& analyzer) {
    constexpr std::size_t most = 6;  // limit for numbers beside each other
    std::vector<std::string> keys;
    for (const Measurement& m : all)
        if (m.analyzer == analyzer) numbers_in(m.results, keys);
    const auto is_end = [&](Position at, std::string_view end) {
        if (!at.column.ends_with(end)) return false;
        at.column.resize(at.column.size() - end.size());
        return std::ranges::find(keys, at.key()) != keys.end();
    };
    std::map<std::pair<std::ptrdiff_t, bool>, std::vector<Position>> kinds;
    for (const std::string& key : keys) {
        const Position at(key, keys.size() <= most);
        if (!is_end(at, "_low") && !is_end(at, "_high")) kinds[at.kind()].push_back(at);
    }
    std::string text;
    for (const auto& [kind, positions] : kinds) {
        LatexTable table{.comments = {analyzer}, .head = {"set"}, .words = 1};
        if (kind != std::pair(std::ptrdiff_t{0}, false)) table.head.emplace_back("part");
        table.words = table.head.size();
        table.head.emplace_back("$n$");
        std::vector<std::string> columns;
        for (const Position& at : positions) add_new(columns, at.column);
        for (const std::string& column : columns) table.head.push_back(latex_text(column));
        for (const Measurement& m : all) {
            if (m.analyzer != analyzer) continue;
            add_rows(table, m, positions, columns);
            if (m.standard_error) table.comments = {analyzer, "means +- standard errors"};
        }
        text += table.text();
    }
    return text;
}

}  // namespace

std::string to_latex(std::span<const Measurement> measurements) {
    std::vector<std::string> analyzers;
    std::string text = latex_packages;
    for (const Measurement& m : measurements) {
        if (std::ranges::find(analyzers, m.analyzer) != analyzers.end()) continue;
        analyzers.push_back(m.analyzer);
        text += tables_of(measurements, m.analyzer);
    }
    return text;
}

}  // namespace stipple
