// SPDX-License-Identifier: MIT
#include "page/page_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "page/page_figures.hpp"
#include "plot/html_text.hpp"
#include "plot/report_charts.hpp"

namespace stipple {
namespace {

constexpr double chart_width = 640;
constexpr double chart_height = 300;

/// Numbers as short as eyes need them.
Json short_numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double v : values) {
        if (!std::isfinite(v))
            list.push_back(nullptr);
        else
            list.push_back(std::stod(fmt::format("{:.4g}", v)));
    }
    return list;
}

/// What the page's script needs to show values under the pointer.
std::string numbers_of(std::span<const PageSet> sets, const Chart& chart, const Area& frame) {
    const ChartPanel& panel = chart.panels.front();
    const Axis x = chart_axes(chart, 0, {}).first;
    Json curves = Json::array();
    for (const Series& series : panel.series)
        curves.push_back({{"set", *series.set},
                          {"name", sets[*series.set].name},
                          {"x", short_numbers(series.x)},
                          {"y", short_numbers(series.y)}});
    const Json all = {{"x", panel.x_name},
                      {"left", frame.left},
                      {"right", frame.right()},
                      {"top", frame.top},
                      {"bottom", frame.bottom()},
                      {"width", chart_width},
                      {"from", x.low},
                      {"to", x.high},
                      {"curves", curves}};
    return html_json(all.dump(-1, ' ', false, Json::error_handler_t::replace));
}

/// The first panel of the chart of a measure of these sets, as far as they have the curve.
std::string chart_figure(std::span<const PageSet> sets, std::span<const std::size_t> which,
                         const char* measure, const char* curve, const std::string& what,
                         const std::string& caption) {
    std::vector<Measurement> found;
    std::vector<std::size_t> numbers;
    for (const std::size_t i : which) {
        const Report* results = sets[i].results(measure);
        if (results == nullptr || results->find(curve) == nullptr) continue;
        found.push_back({.analyzer = measure,
                         .source = sets[i].name,
                         .count = sets[i].count,
                         .dimension = sets[i].dimension,
                         .domain = sets[i].domain,
                         .results = *results});
        numbers.push_back(i);
    }
    if (found.empty()) return {};
    Chart chart = chart_of(found);
    chart.title = chart.subtitle = {};
    chart.panels.resize(1);
    ChartPanel& panel = chart.panels.front();
    for (Series& series : panel.series) series.set = numbers[series.measurement];
    std::vector<Area> frames;
    const auto drawn = [&](bool dark) {
        return draw_chart(
            chart, {.theme = &page_theme(dark), .width = chart_width, .height = chart_height},
            &frames);
    };
    const std::string of =
        found.size() == 1 ? found[0].source : fmt::format("{} sets", found.size());
    const std::string svg =
        svg_element(drawn(false), drawn(true), fmt::format("{} of {}", what, of));
    return fmt::format(
        "<figure class=\"chart\">\n{}<output class=\"tip\" hidden></output>\n<script "
        "type=\"application/json\">{}</script>\n<figcaption>{}{}.</figcaption>\n</figure>\n",
        svg, numbers_of(sets, chart, frames.front()), html_text(caption),
        panel.log_y ? "; logarithmic" : "");
}

}  // namespace

std::string radial_power_figure(std::span<const PageSet> sets, std::span<const std::size_t> which) {
    return chart_figure(sets, which, "periodogram", "radial.power", "radial power",
                        "Radial power over frequency; white noise has 1");
}

std::string pair_correlation_figure(std::span<const PageSet> sets,
                                    std::span<const std::size_t> which) {
    return chart_figure(sets, which, "pair-correlation", "density", "pair correlation",
                        "Pair correlation over distance; independent points have 1");
}

}  // namespace stipple
