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

/// Exponent of the first digit.
int exponent_of(double x) { return static_cast<int>(std::floor(std::log10(std::abs(x)))); }

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
    const int first = exponent_of(std::max(std::abs(value), spread ? half_width : 0));
    const int last = spread ? exponent_of(half_width) - 1 : first - 3;
    const bool scaled = first < -3 || first > 5;
    const double unit = scaled ? std::pow(10.0, first) : 1;
    const int digits = std::clamp((scaled ? first : 0) - last, 0, 15);
    std::string text = fmt::format("{:.{}f}", value / unit, digits);
    if (spread) text += fmt::format(" \\pm {:.{}f}", half_width / unit, digits);
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

/// Numbers of a report by key, and those of its short lists as KEY[I].
std::map<std::string, double> numbers_in(const Report& report, std::vector<std::string>& keys) {
    constexpr std::size_t few = 9;
    std::map<std::string, double> found;
    const auto add = [&](const std::string& key, double number) {
        found[key] = number;
        if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    };
    for (const std::string& key : report.keys()) {
        if (const auto number = number_at(report, key)) add(key, *number);
        const auto list = list_at(report, key).value_or(Report::Curve());
        for (std::size_t i = 0; i < list.size() && list.size() <= few; ++i)
            add(fmt::format("{}[{}]", key, i), list[i]);
    }
    return found;
}

/// Table of one analyzer's measurements.
LatexTable table_of(std::span<const Measurement> all, const std::string& analyzer) {
    LatexTable table{.comments = {analyzer}, .head = {"set", "$n$"}, .words = 1};
    std::vector<std::string> keys;
    std::vector<std::string> unused;
    for (const Measurement& m : all)
        if (m.analyzer == analyzer) numbers_in(m.results, keys);
    for (const std::string& key : keys) table.head.push_back(latex_text(key));
    for (const Measurement& m : all) {
        if (m.analyzer != analyzer) continue;
        std::string source = m.source == "-" ? "standard input" : m.source;
        if (m.set) source += fmt::format(", set {}", *m.set);
        auto& row = table.rows.emplace_back();
        row = {latex_text(source), std::to_string(m.count)};
        const auto values = numbers_in(m.results, unused);
        const auto errors = numbers_in(m.standard_error.value_or(Report()), unused);
        const auto at = [](const auto& numbers, const std::string& key) {
            const auto it = numbers.find(key);
            return it == numbers.end() ? std::nan("") : it->second;
        };
        for (const std::string& key : keys)
            row.push_back(latex_number(at(values, key), at(errors, key)));
        if (m.standard_error) table.comments = {analyzer, "means +- standard errors"};
    }
    return table;
}

}  // namespace

std::string to_latex(std::span<const Measurement> measurements) {
    std::vector<std::string> analyzers;
    std::string text = latex_packages;
    for (const Measurement& m : measurements) {
        if (std::ranges::find(analyzers, m.analyzer) != analyzers.end()) continue;
        analyzers.push_back(m.analyzer);
        text += table_of(measurements, m.analyzer).text();
    }
    return text;
}

}  // namespace stipple
