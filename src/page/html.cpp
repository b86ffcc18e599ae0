// SPDX-License-Identifier: MIT
#include "page/html.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/bytes/fingerprint.hpp"
#include "core/options.hpp"
#include "core/text.hpp"
#include "page/experiment.hpp"
#include "page/figures.hpp"
#include "page/measures.hpp"
#include "pipeline/units.hpp"
#include "plot/drawing/html_text.hpp"
#include "report/document.hpp"
#include "report/typical.hpp"

namespace stipple::page {

using plot::html_text;

namespace {

/// A name that may be wrapped after punctuation, but not within a word.
std::string name_of(const std::string& name) {
    std::string out;
    std::string part;
    for (const char c : name) {
        part += c;
        if (std::string_view(":,=/_@").find(c) == std::string_view::npos) continue;
        out += html_text(part) + "<wbr>";
        part.clear();
    }
    return out + html_text(part);
}

/// A mark in the set's colour.
std::string swatch(std::size_t set) {
    return fmt::format("<span class=\"swatch\" style=\"--c:var(--c{})\"></span>", set);
}

std::string plural(std::uint64_t n, const char* one, const char* many) {
    return fmt::format("{} {}", n, n == 1 ? one : many);
}

/// A domain in words: "the unit cube", "the disk", "the domain disk:center=[1,2]".
std::string domain_in_words(const std::string& spec) {
    if (is_experiment(spec)) return "named parameters";
    if (spec.find_first_of(": ") != std::string::npos) return "the domain " + spec;
    std::string words = "the " + spec;
    std::ranges::replace(words, '-', ' ');
    return words;
}

std::string source_of(const Set& set) { return set.source == "-" ? "standard input" : set.source; }

std::string facts_of(const Set& set) {
    std::string text =
        fmt::format("{} in {} on {}", plural(set.count, "point", "points"),
                    plural(set.dimension, "dimension", "dimensions"), domain_in_words(set.domain));
    if (set.source != set.name) text += fmt::format(" · from {}", source_of(set));
    if (set.number) text += fmt::format(" (set {})", *set.number);
    if (set.left_out > 0)
        text += fmt::format(" · without {} that have missing numbers",
                            plural(set.left_out, "row", "rows"));
    if (!set.replications.empty())
        text += fmt::format(" · the first of {} sets; the comparison shows their means",
                            set.replications.size() + 1);
    return html_text(text);
}

// -------------------------------------------------------------------- comparison

/// Identifies a domain for the page's script, which compares the domains of sets.
std::string mark_of_domain(const std::string& spec) {
    return is_experiment(spec) ? "parameters " + format_fingerprint(fingerprint(spec)) : spec;
}

std::string comparison_head(std::span<const Set> sets) {
    std::string out = "<thead><tr><th scope=\"col\">Measure</th>";
    for (std::size_t i = 0; i < sets.size(); ++i)
        out += fmt::format(
            "<th scope=\"col\" class=\"number\" data-set=\"{}\" data-count=\"{}\" "
            "data-domain=\"{}\">{}{}</th>",
            i, sets[i].count, html_text(mark_of_domain(sets[i].domain)), swatch(i),
            name_of(sets[i].name));
    return out + "</tr></thead>\n";
}

/// The cell of a set in a row. @param kind further classes @param more further attributes
std::string cell(std::size_t set, std::string_view text, const char* kind = "",
                 const std::string& more = {}) {
    return fmt::format("<td class=\"number{}\" data-set=\"{}\"{}>{}</td>", kind, set, more, text);
}

/// A number in JavaScript syntax.
std::string script_number(double value) {
    if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
    return format_number(value);
}

std::string cell_of(const Row& row, std::size_t set) {
    const auto& known = row.values[set];
    const bool best = row.best[set];
    if (!known) return cell(set, "–", " none");
    std::string exact = format_number(known->lower);
    if (!known->exact()) exact += " to " + format_number(known->upper);
    if (known->error > 0) exact += " ± " + format_number(known->error);
    return cell(set, html_text(shown_known(*known, row.key.key)), best ? " best" : "",
                fmt::format(" title=\"{}{}\" data-low=\"{}\" data-high=\"{}\"", exact,
                            best ? ", best of these" : "", script_number(known->least()),
                            script_number(known->most())));
}

std::string verdict_row(std::span<const Set> sets, std::string_view measure,
                        const std::string& label) {
    std::string cells;
    bool any = false;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const Report* found = sets[i].results(measure);
        any = any || found != nullptr;
        cells += found == nullptr ? cell(i, "–", " none") : cell(i, html_text(verdict_of(*found)));
    }
    if (!any) return {};
    return fmt::format("<tr><th scope=\"row\">{}</th>{}</tr>\n", label, cells);
}

std::string arrow_of(Better better) {
    if (better == Better::lower) return "&nbsp;<small title=\"lower is better\">↓</small>";
    if (better == Better::higher) return "&nbsp;<small title=\"higher is better\">↑</small>";
    return {};
}

/// Attributes from which the page's script marks the best number of a row.
std::string rule_of(const Key& key) {
    if (key.better == Better::neither) return {};
    return fmt::format(" data-better=\"{}\"{}", word_of(key.better),
                       key.any_count ? " data-any-count" : "");
}

/// A title attribute that explains a result; empty if there is no explanation.
std::string explained(const Analyzer& analyzer, std::string_view key, std::size_t dimension,
                      const GivenOptions& options) {
    const auto sentences = meaning_of(analyzer, key, dimension, options);
    if (sentences.empty()) return {};
    return fmt::format(" title=\"{}\"", html_text(join(sentences, "; ")));
}

std::string size_row(std::span<const Set> sets) {
    std::string out = "<tr><th scope=\"row\">Points</th>";
    for (std::size_t i = 0; i < sets.size(); ++i) out += cell(i, std::to_string(sets[i].count));
    return out + "</tr>\n";
}

std::string comparison_of(std::span<const Set> sets) {
    std::string out = fmt::format("<section id=\"comparison\">\n<h2>{}</h2>\n",
                                  sets.size() > 1 ? "Comparison" : "Summary");
    for (const std::string& note : notes_on(sets))
        out += fmt::format("<p class=\"note\">{}</p>\n", html_text(note));
    out +=
        "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"comparison\"><table>\n" +
        comparison_head(sets) + "<tbody>\n" + size_row(sets);
    // p-values cannot be averaged.
    const bool several =
        std::ranges::any_of(sets, [](const Set& set) { return !set.replications.empty(); });
    const std::string of_first = several ? " (first seed)" : "";
    std::string group;
    for (const Row& row : compare_sets(sets)) {
        if (group != row.key.group) {
            group = row.key.group;
            out += fmt::format(
                "<tr class=\"group\"><th colspan=\"{}\" scope=\"colgroup\">{}</th></tr>\n",
                sets.size() + 1, group);
        }
        const std::string_view key = row.key.key;
        const auto dot = key.find('.');
        const Planned& measure = *planned(key.substr(0, dot));
        out += fmt::format(
            "<tr data-key=\"{}\"{}><th scope=\"row\"{}>{}{}</th>", key, rule_of(row.key),
            explained(*measure.analyzer, key.substr(dot + 1), sets[0].dimension,
                      {measure.measure->options.begin(), measure.measure->options.end()}),
            html_text(row.key.label) + (key.ends_with("p_value") ? of_first : ""),
            arrow_of(row.key.better));
        for (std::size_t i = 0; i < sets.size(); ++i) out += cell_of(row, i);
        out += "</tr>\n";
    }
    for (const auto& [name, analyzer, measure] : planned_measures())
        for (const auto& [key, label] : measure->compared)
            if (key == "verdict") out += verdict_row(sets, name, std::string(label) + of_first);
    out += "</tbody></table></div>\n";
    if (sets.size() > 1)
        out += fmt::format(
            "<p class=\"note\">★ marks the set that is better than all others; ↓ lower is better, "
            "↑ higher is better. “a to b” are certain bounds of a value that is not known exactly; "
            "“a ± b” is the mean of several sets with its standard error, and means count as "
            "different if the intervals of two standard errors around them do not overlap. Errors "
            "of integrands are shown without sign, for several sets as root mean square.{}</p>\n",
            several ? "" : " With one set of each sampler, a difference may be due to chance.");
    return out + "</section>\n";
}

// -------------------------------------------------------------------- one set

constexpr std::size_t most_listed = 8;  ///< tables leave out lists of more numbers

std::string row_of(const Measure& measure, const std::string& key, std::size_t dimension) {
    const Report& results = *measure.results;
    std::string shown = text_of(*results.find(key));
    std::string whole;
    if (const auto list = list_at(results, key)) {
        std::vector<std::string> numbers;
        for (const double x : *list) numbers.push_back(shown_number(x, key));
        shown = list->size() > most_listed ? "" : join(numbers, ", ");
    } else if (const auto* number = std::get_if<double>(results.find(key))) {
        shown = shown_number(*number, key);
        whole = fmt::format(" title=\"{}\"", format_number(*number));
    }
    if (shown.empty()) return {};
    return fmt::format("<tr><th scope=\"row\"{}>{}</th><td class=\"number\"{}>{}</td></tr>\n",
                       explained(find_analyzer(measure.analyzer), key, dimension, measure.options),
                       html_text(key), whole, html_text(shown));
}

std::string measure_of(const Measure& measure, std::size_t dimension) {
    std::string out = fmt::format("<div class=\"measure\">\n<h3>{}</h3>\n<table><tbody>\n",
                                  html_text(measure.title));
    for (const std::string& key : measure.results->keys()) out += row_of(measure, key, dimension);
    out += "</tbody></table>\n";
    if (!measure.command.empty()) out += fmt::format("<pre>{}</pre>\n", html_text(measure.command));
    return out + "</div>\n";
}

std::string verdicts_of(const Set& set) {
    std::string out;
    for (const Measure& measure : set.measures) {
        const std::string words = verdict_in_words(measure);
        if (words.empty()) continue;
        out += fmt::format("<p><span class=\"verdict\">{}</span> {}: {}</p>\n",
                           html_text(verdict_of(*measure.results)), html_text(measure.title),
                           html_text(words));
    }
    if (out.empty()) return {};
    return "<div class=\"verdicts\">\n<h3>Uniformity</h3>\n" + out + "</div>\n";
}

std::string left_out_of(const Set& set) {
    std::string out;
    for (const Measure& measure : set.measures)
        if (!measure.results)
            out += fmt::format("<li>{}: {}</li>\n", html_text(measure.title),
                               html_text(measure.left_out));
    if (out.empty()) return {};
    return "<h3>Left out</h3>\n<ul class=\"left-out\">\n" + out + "</ul>\n";
}

std::string provenance_of(const Set& set) {
    const Provenance& from = set.provenance;
    std::string out;
    const auto add = [&out](const std::string& name, const std::string& text) {
        if (!text.empty())
            out += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_text(name), html_text(text));
    };
    add("source", source_of(set));
    if (!from.generator.empty()) {
        add("generator", from.generator);
        for (const auto& [name, value] : from.options) add(name, value);
        add("seed", std::to_string(from.seed));
        if (from.start > 0) add("first index", std::to_string(from.start));
        std::vector<std::string> warps;
        for (const std::string& warp : from.warps)
            warps.push_back(is_experiment(warp) ? "parameters" : warp);
        add("warps", join(warps, ", "));
        add("bounds", from.bounds);
        add("made by", from.version.empty() ? "" : "stipple " + from.version);
    }
    add("domain", is_experiment(set.domain) ? "named parameters" : set.domain);
    out = fmt::format("<h3>Provenance</h3>\n<dl>\n{}</dl>\n", out);
    if (!set.command.empty())
        out += fmt::format("<pre>{}</pre>\n", html_text(set.command));
    else if (from.generator.empty())
        out += "<p class=\"note\">The file does not record how its points were made.</p>\n";
    return out;
}

std::string section_of(std::span<const Set> sets, std::size_t i) {
    const Set& set = sets[i];
    const std::size_t which[] = {i};
    std::string out = fmt::format(
        "<section class=\"set\" id=\"set-{0}\" data-set=\"{0}\">\n<h2>{1}{2}</h2>\n<p "
        "class=\"facts\">{3}</p>\n<div class=\"figures\">\n",
        i, swatch(i), name_of(set.name), facts_of(set));
    for (const std::string& figure : set.figures) out += figure;
    out +=
        curve_figures(sets, which) + "</div>\n" + verdicts_of(set) + "<div class=\"measures\">\n";
    for (const Measure& measure : set.measures)
        if (measure.results) out += measure_of(measure, set.dimension);
    const std::string parameters = parameter_table(set.domain);
    return out + "</div>\n" + left_out_of(set) +
           (parameters.empty() ? "" : "<h3>Parameters</h3>\n" + parameters) + provenance_of(set) +
           "</section>\n";
}

// -------------------------------------------------------------------- the page

std::string navigation(std::span<const Set> sets) {
    std::string out = "<nav aria-label=\"Sets\">\n";
    for (std::size_t i = 0; i < sets.size(); ++i)
        out += fmt::format(
            "<label style=\"--c:var(--c{0})\"><input type=\"checkbox\" value=\"{0}\" checked "
            "aria-label=\"show {1}\"><a href=\"#set-{0}\">{1}</a></label>\n",
            i, html_text(sets[i].name));
    return out + "</nav>\n";
}

/// CSS for the colours of the sets, and for hiding sets with the navigation's checkboxes.
std::string rules_of_sets(std::size_t sets) {
    std::string out;
    for (std::size_t i = 0; i < sets; ++i) {
        const auto hex = [i](bool dark) {
            const plot::Colour c = theme_of(dark).series_colour(i);
            return fmt::format("#{:02x}{:02x}{:02x}", c.red, c.green, c.blue);
        };
        out += fmt::format(
            ":root{{--c{0}:{1}}}@media screen and "
            "(prefers-color-scheme:dark){{:root{{--c{0}:{2}}}}}"
            "\n.hide-{0} [data-set=\"{0}\"]{{display:none}}\n",
            i, hex(false), hex(true));
    }
    return out;
}

std::string overlays_of(std::span<const Set> sets) {
    if (sets.size() < 2) return {};
    std::vector<std::size_t> all(sets.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
    const std::string figures = curve_figures(sets, all);
    if (figures.empty()) return {};
    return "<section>\n<h2>Curves of all sets</h2>\n<div class=\"figures\">\n" + figures +
           "</div>\n</section>\n";
}

std::string head_of(const Page& page) {
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'unsafe-inline'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
        "<meta name=\"color-scheme\" content=\"light dark\">\n"
        "<meta name=\"generator\" content=\"stipple {}\">\n<title>{}</title>\n<style>{}{}</style>\n"
        "</head>\n",
        html_text(page.version), html_text(page.title), style_sheet(),
        rules_of_sets(page.sets.size()));
}

}  // namespace

std::string to_html(const Page& page) {
    const std::span<const Set> sets = page.sets;
    const Set& first = sets.front();
    std::string size = fmt::format("{}, {}", plural(sets.size(), "set", "sets"),
                                   plural(first.dimension, "dimension", "dimensions"));
    if (same_count(sets))
        size += fmt::format(", {}{}", plural(first.count, "point", "points"),
                            sets.size() > 1 ? " each" : "");
    std::string out = head_of(page);
    out += fmt::format("<body>\n<header>\n<h1>{}</h1>\n<p class=\"facts\">{}</p>\n</header>\n",
                       html_text(page.title), html_text(size));
    out += navigation(sets) + "<main>\n" + comparison_of(sets) + overlays_of(sets);
    for (std::size_t i = 0; i < sets.size(); ++i) out += section_of(sets, i);
    out += fmt::format(
        "</main>\n<footer>\n<p>Made by stipple {}. The same command makes the same page:</p>\n"
        "<pre>{}</pre>\n</footer>\n<script>{}</script>\n</body>\n</html>\n",
        html_text(page.version), html_text(page.command), script());
    return out;
}

}  // namespace stipple::page
