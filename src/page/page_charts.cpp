// SPDX-License-Identifier: MIT
#include "page/page_charts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "plot/html_text.hpp"
#include "plot/report_charts.hpp"
#include "plot/ticks.hpp"

namespace stipple {
namespace {

constexpr double plot_width = 640;
constexpr double plot_height = 300;
constexpr double plot_left = 58;
constexpr double plot_right = plot_width - 12;
constexpr double plot_top = 12;
constexpr double plot_bottom = plot_height - 42;
constexpr double log_floor = 1e-4;  ///< of a logarithmic axis: what is lower is rounding
constexpr double log_above = 12;    ///< higher peaks get one

/// The values that a chart shows.
struct Frame {
    double x0 = 0;
    double x1 = 1;
    double y0 = 0;
    double y1 = 1;
    bool log_y = false;

    [[nodiscard]] double x(double value) const {
        return plot_left + (plot_right - plot_left) * (value - x0) / (x1 - x0);
    }
    [[nodiscard]] double y(double value) const {
        double share = 0;
        if (log_y)
            share = (std::log10(std::max(value, y0)) - std::log10(y0)) /
                    (std::log10(y1) - std::log10(y0));
        else
            share = (value - y0) / (y1 - y0);
        return plot_bottom - (plot_bottom - plot_top) * std::clamp(share, 0.0, 1.0);
    }
};

Frame frame_of(const PageChart& chart) {
    Frame frame{.x0 = 0, .x1 = 0, .log_y = chart.log_y};
    double high = 1.4 * chart.guide;
    double low = chart.guide;
    for (const PageCurve& curve : chart.curves) {
        for (const double x : curve.x) frame.x1 = std::max(frame.x1, x);
        for (const double y : curve.y)
            if (std::isfinite(y)) {
                high = std::max(high, y);
                low = std::min(low, std::max(y, log_floor));
            }
    }
    if (!(frame.x1 > 0)) frame.x1 = 1;
    frame.y1 = chart.log_y ? 1.5 * high : 1.05 * high;
    frame.y0 = chart.log_y ? 0.7 * low : 0;
    return frame;
}

std::string ticks_of(const Frame& frame) {
    std::string out;
    for (const Tick& tick : linear_ticks(frame.x0, frame.x1, 9).numbers)
        out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                           frame.x(tick.value), plot_bottom + 16, tick.text);
    const Ticks ticks =
        frame.log_y ? log_ticks(frame.y0, frame.y1, 6) : linear_ticks(frame.y0, frame.y1, 6);
    for (const Tick& tick : ticks.numbers) {
        const double y = frame.y(tick.value);
        out += fmt::format(
            "<path class=\"grid\" d=\"M{} {:.1f}H{}\"/><text x=\"{}\" y=\"{:.1f}\" "
            "text-anchor=\"end\">{}</text>\n",
            plot_left, y, plot_right, plot_left - 6, y + 4, tick.text);
    }
    return out;
}

/// Numbers of ticks that are to be taken times a power of ten.
std::string times_power(int exponent) {
    return exponent == 0 ? "" : fmt::format(" (× {})", power_of_ten(exponent));
}

std::string names_of(const PageChart& chart, const Frame& frame) {
    const int of_x = linear_ticks(frame.x0, frame.x1, 9).exponent;
    const int of_y = frame.log_y ? 0 : linear_ticks(frame.y0, frame.y1, 6).exponent;
    return fmt::format(
        "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>\n"
        "<text transform=\"translate(14 {:.0f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
        (plot_left + plot_right) / 2, plot_height - 8, html_text(chart.x_name + times_power(of_x)),
        (plot_top + plot_bottom) / 2, html_text(chart.y_name + times_power(of_y)));
}

std::string path_of(const Frame& frame, const std::vector<double>& x,
                    const std::vector<double>& y) {
    std::string out;
    bool on = false;
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
        if (std::isfinite(y[i]))
            out += fmt::format("{}{:.1f} {:.1f}", on ? 'L' : 'M', frame.x(x[i]), frame.y(y[i]));
        on = std::isfinite(y[i]);
    }
    return out;
}

std::string band_of(const Frame& frame, const PageBand& band) {
    std::vector<double> x(band.x.rbegin(), band.x.rend());
    std::vector<double> low(band.low.rbegin(), band.low.rend());
    std::string back = path_of(frame, x, low);
    if (!back.empty()) back[0] = 'L';
    return fmt::format("<path class=\"band\" d=\"{}{}Z\"/>\n", path_of(frame, band.x, band.high),
                       back);
}

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

std::string numbers_of(const PageChart& chart, const Frame& frame) {
    Json curves = Json::array();
    for (const PageCurve& curve : chart.curves)
        curves.push_back({{"set", curve.set},
                          {"name", curve.name},
                          {"x", short_numbers(curve.x)},
                          {"y", short_numbers(curve.y)}});
    const Json all = {{"x", chart.x_name},   {"left", plot_left}, {"right", plot_right},
                      {"width", plot_width}, {"from", frame.x0},  {"to", frame.x1},
                      {"curves", curves}};
    return html_json(all.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::optional<std::vector<double>> list_at(const Report* found, std::string_view key) {
    const Report::Item* item = found == nullptr ? nullptr : found->find(key);
    if (item == nullptr) return std::nullopt;
    if (const auto* curve = std::get_if<Report::Curve>(item)) return *curve;
    if (const auto* whole = std::get_if<Report::Integers>(item))
        return std::vector<double>(whole->begin(), whole->end());
    return std::nullopt;
}

/// Curves of one measure, and whether all have the same x.
std::vector<PageCurve> curves_of(std::span<const PageSet> sets, std::span<const std::size_t> which,
                                 const char* measure, const char* x, const char* y) {
    std::vector<PageCurve> curves;
    for (const std::size_t i : which) {
        const auto xs = list_at(sets[i].results(measure), x);
        const auto ys = list_at(sets[i].results(measure), y);
        if (xs && ys && !xs->empty() && xs->size() == ys->size())
            curves.push_back({i, sets[i].name, *xs, *ys});
    }
    return curves;
}

std::string alt_of(const std::string& what, const std::vector<PageCurve>& curves) {
    if (curves.size() == 1) return what + " of " + curves[0].name;
    return fmt::format("{} of {} sets", what, curves.size());
}

}  // namespace

std::string chart_figure(const PageChart& chart) {
    if (chart.curves.empty()) return {};
    const Frame frame = frame_of(chart);
    std::string out = fmt::format(
        "<figure class=\"chart\">\n<svg viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" "
        "aria-label=\"{}\">\n",
        plot_width, plot_height, html_text(chart.alt));
    for (const PageBand& band : chart.bands) out += band_of(frame, band);
    out += ticks_of(frame) + names_of(chart, frame);
    out += fmt::format("<path class=\"guide\" d=\"M{} {:.1f}H{}\"/>\n", plot_left,
                       frame.y(chart.guide), plot_right);
    out += fmt::format("<path class=\"frame\" d=\"M{} {}V{}H{}\"/>\n", plot_left, plot_top,
                       plot_bottom, plot_right);
    for (const PageCurve& curve : chart.curves)
        out += fmt::format(
            "<path class=\"curve\" data-set=\"{0}\" style=\"stroke:var(--c{0})\" "
            "d=\"{1}\"/>\n",
            curve.set, path_of(frame, curve.x, curve.y));
    out += fmt::format("<path class=\"rule\" d=\"M0 {}V{}\"/>\n</svg>\n", plot_top, plot_bottom);
    std::string caption = chart.title;
    for (const PageBand& band : chart.bands) caption += "; grey: " + band.name;
    if (chart.log_y) caption += "; logarithmic";
    return out + fmt::format(
                     "<output class=\"tip\" hidden></output>\n<script "
                     "type=\"application/json\">{}</script>\n<figcaption>{}.</figcaption>\n"
                     "</figure>\n",
                     numbers_of(chart, frame), html_text(caption));
}

std::string radial_power_figure(std::span<const PageSet> sets, std::span<const std::size_t> which) {
    PageChart chart{
        .title = "Radial power over frequency; white noise has 1",
        .x_name = "frequency",
        .y_name = "power",
        .alt = {},
        .curves = curves_of(sets, which, "periodogram", "radial.frequency", "radial.power")};
    if (chart.curves.empty()) return {};
    chart.alt = alt_of("radial power", chart.curves);
    PageBand band{.name = "95 % of the rings of white noise", .x = {}, .low = {}, .high = {}};
    std::size_t longest = 0;  // sets of one dimension have the same rings, as far as they go
    for (std::size_t i = 0; i < chart.curves.size(); ++i) {
        if (chart.curves[i].x.size() > chart.curves[longest].x.size()) longest = i;
        for (const double y : chart.curves[i].y) chart.log_y = chart.log_y || y > log_above;
    }
    const auto cells =
        list_at(sets[chart.curves[longest].set].results("periodogram"), "radial.cells");
    if (cells && cells->size() == chart.curves[longest].x.size()) {
        band.x = chart.curves[longest].x;
        for (const double ring : *cells) {
            const auto [low, high] = white_noise_band(ring, 1);
            band.low.push_back(low);
            band.high.push_back(high);
        }
        chart.bands.push_back(std::move(band));
    }
    return chart_figure(chart);
}

std::string pair_correlation_figure(std::span<const PageSet> sets,
                                    std::span<const std::size_t> which) {
    PageChart chart{.title = "Pair correlation over distance; independent points have 1",
                    .x_name = "distance",
                    .y_name = "density of pairs",
                    .alt = {},
                    .curves = curves_of(sets, which, "pair-correlation", "distance", "density")};
    if (chart.curves.empty()) return {};
    chart.alt = alt_of("pair correlation", chart.curves);
    for (const PageCurve& curve : chart.curves)
        for (const double y : curve.y) chart.log_y = chart.log_y || y > log_above;
    const auto spread = list_at(sets[chart.curves[0].set].results("pair-correlation"), "deviation");
    if (chart.curves.size() == 1 && spread && spread->size() == chart.curves[0].x.size()) {
        PageBand band{.name = "two standard deviations of independent points",
                      .x = chart.curves[0].x,
                      .low = {},
                      .high = {}};
        for (const double s : *spread) {
            band.low.push_back(1 - 2 * s);
            band.high.push_back(1 + 2 * s);
        }
        chart.bands.push_back(std::move(band));
    }
    return chart_figure(chart);
}

}  // namespace stipple
