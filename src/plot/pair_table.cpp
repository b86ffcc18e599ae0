// SPDX-License-Identifier: MIT
#include "plot/pair_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analyzers/analyzer.hpp"
#include "core/text.hpp"
#include "plot/drawing/letters.hpp"
#include "plot/report_charts.hpp"

namespace stipple::plot {
namespace {

constexpr double text_size = 11;

/// Adds the number in each square: as it is if it fits, otherwise as a multiple of `unit`.
void add_numbers(Drawing& drawing, const PairTable& table, const Panel& panel, double largest,
                 double unit, const Theme& theme) {
    const double side = panel.x(2) - panel.x(1);
    const double size = std::min(text_size, 0.42 * side);
    for (std::size_t j = 1; j < table.dimension; ++j)
        for (std::size_t i = 0; i < j; ++i) {
            const double value = table.at(i, j);
            if (!std::isfinite(value)) continue;
            const Position at = panel.at(static_cast<double>(i + 1), static_cast<double>(j + 1));
            drawing.add(
                Label{.text = unit == 1 ? rounded(value, 2) : rounded(std::round(value / unit), 3),
                      .at = {at.x, at.y + 0.36 * size},
                      .size = size,
                      .colour = value < 0.5 * largest ? theme.ink : theme.background,
                      .anchor = Anchor::middle});
        }
}

/// Unit for numbers in squares of this side: 1 if they fit, else a power of ten; 0 if none fits.
double number_unit(const PairTable& table, double largest, double side) {
    double widest = 0;
    for (const double value : table.values)
        widest = std::max(widest, text_width(rounded(value, 2), std::min(text_size, 0.42 * side)));
    if (side < 12 || !(largest > 0)) return 0;
    if (1.16 * widest < side - 2) return 1;
    return std::pow(10, std::floor(std::log10(largest)) - 1);  // at most two digits
}

}  // namespace

double PairTable::largest() const {
    double most = 0;
    for (const double value : values)
        if (std::isfinite(value)) most = std::max(most, value);
    return most;
}

std::optional<PairTable> pair_table(const Measurement& m) {
    const auto& all = analyzers::all();
    const auto analyzer = std::ranges::find(all, m.analyzer, &Analyzer::name);
    if (analyzer == all.end() || m.dimension < 3) return std::nullopt;
    for (const CurveKey& curve : analyzer->curves) {
        auto values = list_at(m.results, curve.key);
        const std::size_t d = m.dimension;
        if (!curve.over.empty() || !values || values->size() != d * (d - 1) / 2) continue;
        PairTable table{.key = std::string(curve.key),
                        .source = m.source,
                        .title = capitalised(std::string(curve.title)) + " of pairs of coordinates",
                        .dimension = d,
                        .values = *std::move(values)};
        const auto worst = std::ranges::find(table.values, table.largest());
        std::size_t i = static_cast<std::size_t>(worst - table.values.begin());
        std::size_t j = 1;
        while (i >= j) i -= j++;
        table.subtitle = fmt::format("n = {}, d = {} · largest {}, of {} and {}", m.count, d,
                                     rounded(table.largest(), 3), i + 1, j + 1);
        return table;
    }
    return std::nullopt;
}

Drawing draw_pair_table(const PairTable& table, double largest, bool bar,
                        const PictureStyle& style) {
    const Theme& theme = *style.theme;
    const std::size_t side = table.dimension - 1;
    const auto last = static_cast<double>(side) + 0.5;
    const Axis x{.low = 0.5, .high = last, .whole = true, .name = "coordinate"};
    const Axis y{.low = 1.5, .high = last + 1, .whole = true, .name = "coordinate"};
    constexpr double around = 130;  // axes, bar and margins
    const double usual = std::max(640.0, 22 * static_cast<double>(side) + around);
    const double wide = style.width > 0 ? style.width : usual;
    double unit = number_unit(table, largest, (wide - around) / static_cast<double>(side));
    const std::string note =
        unit == 0 || unit == 1
            ? ""
            : fmt::format(" · numbers ×{}",
                          power_of_ten(static_cast<int>(std::lround(std::log10(unit)))));
    auto [drawing, frame] = square_drawing(
        titled_drawing(table.title, table.subtitle + note, style, usual), {}, x, y, bar, style);
    PixelImage image{.area = frame, .columns = side, .rows = side};
    const auto shade = [&](double share) { return shade_of(theme, share); };
    for (std::size_t j = side; j >= 1; --j)
        for (std::size_t i = 0; i < side; ++i) {
            const bool known = i < j && std::isfinite(table.at(i, j));
            image.pixels.push_back(known && largest > 0 ? shade(table.at(i, j) / largest)
                                                        : theme.background);
        }
    drawing.add(std::move(image));
    const Panel panel(frame, x, y);
    if (unit > 0) add_numbers(drawing, table, panel, largest, unit, theme);
    panel.draw_axes(drawing, theme, true);
    if (bar && largest > 0) {
        Ticks ticks = linear_ticks(0, largest, 6);
        for (Tick& tick : ticks.numbers) tick.value /= largest;
        draw_colour_bar(drawing, bar_beside(frame),
                        ticks.exponent == 0 ? "" : fmt::format("×{}", power_of_ten(ticks.exponent)),
                        theme, shade, ticks.numbers);
    }
    return std::move(drawing);
}

}  // namespace stipple::plot
