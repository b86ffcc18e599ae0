// SPDX-License-Identifier: MIT
#include "plot/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "core/error.hpp"
#include "core/text.hpp"
#include "plot/drawing/letters.hpp"

namespace stipple::plot {
namespace {

constexpr double panel_gap = 12;
constexpr double legend_row = 19;
constexpr double legend_size = 12;
constexpr double swatch = 22;
constexpr std::size_t most_entries = 12;  ///< limit for the entries of a legend
constexpr double least_panels = 60;       ///< smallest total height of the panels, in units

/// Range of an axis. take() extends it to include further values.
struct Span {
    bool log = false;
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void take(double value) {
        if (!std::isfinite(value) || (log && value <= 0)) return;
        low = std::min(low, value);
        high = std::max(high, value);
    }
    void take(const std::vector<double>& values) {
        for (const double value : values) take(value);
    }
};

bool marked(std::span<const ChartPanel> panels) {
    return std::ranges::any_of(panels, [](const ChartPanel& panel) {
        return std::ranges::any_of(panel.series, &Series::marks);
    });
}

/// Extends an axis at each end by a fraction of its length, so that no value is at the ends.
void widen(Axis& axis, double share, bool keep_low = false) {
    if (axis.log) {
        const double more = std::exp(share * (std::log(axis.high) - std::log(axis.low)));
        axis.low = std::max(axis.low / more, least_shown);
        axis.high = std::min(axis.high * more, 2 * most_shown);
        return;
    }
    const double more = share * (axis.high - axis.low);
    if (!keep_low) axis.low -= more;
    axis.high += more;
}

/// Whether all curves have values only at powers of two, and at two or more of them.
bool only_powers_of_two(std::span<const ChartPanel> panels) {
    double low = HUGE_VAL;
    double high = 0;
    for (const ChartPanel& panel : panels)
        for (const Series& series : panel.series)
            for (const double x : series.x) {
                int exponent = 0;
                if (std::frexp(x, &exponent) != 0.5) return false;
                low = std::min(low, x);
                high = std::max(high, x);
            }
    return low < high;
}

Axis x_axis(std::span<const ChartPanel> panels, const PictureStyle& style) {
    const ChartPanel& last = panels.back();
    if (!last.categories.empty())
        return {.low = 0.5,
                .high = static_cast<double>(last.categories.size()) + 0.5,
                .words = last.categories,
                .name = last.x_name};
    Span span{.log = style.log_x.value_or(last.log_x)};
    for (const ChartPanel& panel : panels) {
        for (const Series& series : panel.series) span.take(series.x);
        for (const Bars& bars : panel.bars) span.take(bars.edges);
        span.take(panel.rug);
    }
    require_shown(span.low, span.high);
    Axis axis{.low = span.low,
              .high = span.high,
              .log = span.log,
              .binary = span.log && only_powers_of_two(panels),
              .whole = last.whole_x,
              .name = last.x_name};
    // An axis that would begin close to zero begins at zero.
    const bool near_zero = !span.log && span.low > 0 && span.low < 0.04 * span.high;
    if (near_zero) axis.low = 0;
    constexpr double share = 0.02;  // fraction of the axis added at each end, for marks
    if (!style.tight && marked(panels) && span.low < span.high)
        widen(axis, share, near_zero && span.low > share * span.high);
    return axis;
}

/// Whether the y axis is logarithmic: as requested, except for curves with negative numbers, such
/// as decibels.
bool log_upward(const ChartPanel& panel, const PictureStyle& style) {
    const bool below = std::ranges::any_of(panel.series, [](const Series& series) {
        return std::ranges::any_of(series.y, [](double y) { return y < 0; });
    });
    return below ? panel.log_y : style.log_y.value_or(panel.log_y);
}

Axis y_axis(const ChartPanel& panel, const PictureStyle& style) {
    Span span{.log = log_upward(panel, style)};
    for (const Series& series : panel.series) {
        span.take(series.y);
        span.take(series.low);
        span.take(series.high);
    }
    for (const Bars& bars : panel.bars) span.take(bars.heights);
    require_shown(span.low, span.high);
    // Guides far outside the data do not extend the axis.
    const double reach = span.high - span.low;
    for (const Guide& guide : panel.guides)
        for (const double y : guide.y) {
            const bool near = span.log ? y > span.low / 10 && y < span.high * 10
                                       : std::abs(y - span.low) <= 4 * reach || !(reach > 0);
            if (guide.reached || (guide.x.empty() && near)) span.take(y);
        }
    if (panel.from_zero && !span.log) span.take(0);
    if (!span.log) span.take(panel.reach_y);
    constexpr int digits = 7;  // values equal to 7 digits differ only by rounding
    Axis axis{.low = span.low, .high = span.high, .log = span.log, .name = panel.y_name};
    axis.make_valid(digits);
    if (axis.log) axis.low = std::max(axis.low, panel.least_y > 0 ? panel.least_y : 0);
    if (style.tight) return axis;
    if (axis.log)
        widen(axis, 0.05);
    else
        widen(axis, 0.06, panel.from_zero && axis.low == 0);
    return axis;
}

Dash dash_of(std::size_t series, const Theme& theme) {
    const std::size_t turn = series / theme.series.size() % 3;
    return turn == 0 ? Dash::none : turn == 1 ? Dash::dashed : Dash::dotted;
}

/// Index of a curve's colour in the theme.
std::size_t colour_of(const ChartPanel& panel, std::size_t series) {
    return panel.series[series].set.value_or(series);
}

std::vector<std::string> names_in(const ChartPanel& panel) {
    std::vector<std::string> names;
    for (const Series& series : panel.series) names.push_back(series.name);
    for (const Bars& bars : panel.bars) names.push_back(bars.name);
    return names;
}

std::vector<LegendEntry> legend_of(const Chart& chart, std::size_t number, const Theme& theme) {
    const ChartPanel& panel = chart.panels[number];
    std::vector<LegendEntry> entries;
    const bool named = needs_legend(chart, number);
    for (std::size_t i = 0; named && i < panel.series.size(); ++i)
        entries.push_back(
            {.kind = panel.categories.empty() ? LegendEntry::Kind::line : LegendEntry::Kind::box,
             .name = panel.series[i].name,
             .colour = theme.series_colour(colour_of(panel, i)),
             .dash = dash_of(colour_of(panel, i), theme)});
    for (std::size_t i = 0; named && i < panel.bars.size(); ++i)
        entries.push_back({.kind = LegendEntry::Kind::line,
                           .name = panel.bars[i].name,
                           .colour = theme.series_colour(i)});
    if (entries.size() > most_entries) {
        const std::size_t more = entries.size() - most_entries;
        entries.resize(most_entries);
        entries.push_back({.kind = LegendEntry::Kind::box,
                           .name = fmt::format("and {} more", more),
                           .colour = theme.background});
    }
    for (const Series& band : panel.bands)
        if (!band.name.empty()) entries.push_back({LegendEntry::Kind::box, band.name, theme.band});
    for (const Guide& guide : panel.guides)
        if (!guide.name.empty())
            entries.push_back(
                {LegendEntry::Kind::line, guide.name, theme.guide, Dash::dashed, 1.2});
    return entries;
}

/// Drops positions too close to be distinguished: of those within half a unit along x, keeps the
/// first, lowest, highest and last.
std::vector<Position> thinned(const std::vector<Position>& vertices) {
    if (vertices.size() < 4000) return vertices;
    std::vector<Position> out;
    for (std::size_t i = 0; i < vertices.size();) {
        std::size_t end = i;
        while (end < vertices.size() && std::abs(vertices[end].x - vertices[i].x) < 0.5) ++end;
        const auto first = vertices.begin() + static_cast<std::ptrdiff_t>(i);
        const auto last = vertices.begin() + static_cast<std::ptrdiff_t>(end);
        const auto [low, high] = std::minmax_element(
            first, last, [](const Position& a, const Position& b) { return a.y < b.y; });
        auto kept = std::vector{first, low, high, last - 1};
        std::ranges::sort(kept);
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        for (const auto it : kept) out.push_back(*it);
        i = end;
    }
    return out;
}

/// Splits a curve at its gaps.
std::vector<std::vector<Position>> pieces(const Panel& panel, const std::vector<double>& x,
                                          const std::vector<double>& y) {
    std::vector<std::vector<Position>> found(1);
    for (std::size_t i = 0; i < std::min(x.size(), y.size()); ++i) {
        if (std::isfinite(x[i]) && std::isfinite(y[i]))
            found.back().push_back(panel.at(x[i], y[i]));
        else if (!found.back().empty())
            found.emplace_back();
    }
    for (auto& piece : found) piece = thinned(piece);
    return found;
}

void draw_band(Drawing& drawing, const Panel& panel, const std::vector<double>& x,
               const std::vector<double>& low, const std::vector<double>& high, Colour colour,
               double opacity) {
    Patch patch{.colour = colour, .opacity = opacity};
    std::vector<Position> back;
    const std::size_t size = std::min({x.size(), low.size(), high.size()});
    for (std::size_t i = 0; i < size; ++i) {
        if (!std::isfinite(low[i]) || !std::isfinite(high[i])) continue;
        patch.vertices.push_back(panel.at(x[i], high[i]));
        back.push_back(panel.at(x[i], low[i]));
    }
    patch.vertices.insert(patch.vertices.end(), back.rbegin(), back.rend());
    if (patch.vertices.size() > 2) drawing.add(std::move(patch));
}

void draw_guide(Drawing& drawing, const Panel& panel, const Guide& guide, Colour colour) {
    Line line{.colour = colour, .width = 1.2, .dash = Dash::dashed};
    if (guide.x.empty()) {
        const double y = panel.y(guide.y[0]);
        line.vertices = {{panel.frame().left, y}, {panel.frame().right(), y}};
    }
    for (std::size_t i = 0; i < guide.x.size(); ++i)
        if (std::isfinite(guide.x[i]) && !std::isnan(guide.y[i]))
            line.vertices.push_back(panel.at(guide.x[i], guide.y[i]));
    drawing.add(std::move(line));
}

/// Draws only the outline of a histogram, for several that overlap.
void draw_steps(Drawing& drawing, const Panel& panel, const Bars& bars, Colour colour) {
    const double base = panel.frame().bottom();
    Line outline{.vertices = {{panel.x(bars.edges[0]), base}}, .colour = colour, .width = 1.6};
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double top = std::min(panel.y(bars.heights[i]), base);
        outline.vertices.push_back({panel.x(bars.edges[i]), top});
        outline.vertices.push_back({panel.x(bars.edges[i + 1]), top});
    }
    outline.vertices.push_back({panel.x(bars.edges.back()), base});
    drawing.add(std::move(outline));
}

void draw_bars(Drawing& drawing, const Panel& panel, const Bars& bars, Colour colour) {
    const double base = panel.frame().bottom();
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double left = panel.x(bars.edges[i]);
        const double right = panel.x(bars.edges[i + 1]);
        // Leaves a thin gap between bars that are wide enough.
        const double space = right - left > 4 ? 0.5 : 0;
        const double top = panel.y(bars.heights[i]);
        if (!(top < base)) continue;
        drawing.rectangle({left + space, top, right - left - 2 * space, base - top}, colour);
    }
}

void draw_series(Drawing& drawing, const Panel& panel, const Series& series, Colour colour,
                 Dash dash) {
    for (auto& piece : pieces(panel, series.x, series.y)) {
        const bool alone = piece.size() == 1;
        if (series.marks || alone)
            drawing.add(
                Disks{.centres = piece, .radius = series.marks ? 2.6 : 2, .colour = colour});
        if (!alone)
            drawing.add(
                Line{.vertices = std::move(piece), .colour = colour, .width = 1.6, .dash = dash});
    }
}

/// Draws series i as bars with their intervals, one in each category.
void draw_columns(Drawing& drawing, const Panel& panel, const ChartPanel& content, std::size_t i,
                  const Theme& theme) {
    const Series& series = content.series[i];
    for (std::size_t c = 0; c < series.x.size(); ++c) {
        if (!std::isfinite(series.y[c])) continue;
        const auto edges = bar_edges(content, i, series.x[c]);
        const double left = panel.x(edges.first);
        const double right = panel.x(edges.second);
        const auto [top, bottom] = std::minmax({panel.y(0), panel.y(series.y[c])});
        drawing.rectangle({left, top, right - left, bottom - top},
                          theme.series_colour(colour_of(content, i)));
        if (series.low.empty() || !std::isfinite(series.low[c])) continue;
        const double x = (left + right) / 2;
        const double cap = std::min(4.0, (right - left) / 3);
        for (const double end : {panel.y(series.low[c]), panel.y(series.high[c])})
            drawing.add(Line{.vertices = {{x - cap, end}, {x + cap, end}}, .colour = theme.ink});
        drawing.add(Line{.vertices = {{x, panel.y(series.low[c])}, {x, panel.y(series.high[c])}},
                         .colour = theme.ink});
    }
}

void draw_rug(Drawing& drawing, const Panel& panel, const std::vector<double>& values,
              Colour colour) {
    constexpr std::size_t most = 4000;  // more marks, indistinguishable, are not drawn
    if (values.size() > most) return;
    for (const double value : values) {
        const double x = panel.x(value);
        drawing.add(Line{.vertices = {{x, panel.frame().bottom() - 9}, {x, panel.frame().bottom()}},
                         .colour = colour,
                         .width = 0.8});
    }
}

/// Calls draw(series, colour) for all series, each in the SVG group of its set.
template <class Draw>
void for_each_series(Drawing& drawing, const ChartPanel& content, const Draw& draw) {
    for (std::size_t i = 0; i < content.series.size(); ++i) {
        const Series& series = content.series[i];
        if (series.set) drawing.add(SvgGroup{fmt::format("data-set=\"{}\"", *series.set)});
        draw(series, colour_of(content, i));
        if (series.set) drawing.add(SvgGroup{});
    }
}

void draw_panel(Drawing& drawing, const ChartPanel& content, const Panel& panel,
                const Theme& theme) {
    panel.draw_grid(drawing, theme);
    const Area& f = panel.frame();
    drawing.add(ClipWindow{.area = f});
    for (const Series& band : content.bands)
        draw_band(drawing, panel, band.x, band.low, band.high, theme.band, 1);
    const bool several = content.bars.size() > 1;
    for (std::size_t i = 0; !several && i < content.bars.size(); ++i)
        draw_bars(drawing, panel, content.bars[i], theme.series_colour(i));
    for (std::size_t i = 0; several && i < content.bars.size(); ++i)
        draw_steps(drawing, panel, content.bars[i], theme.series_colour(i));
    if (!content.categories.empty()) {
        for (std::size_t i = 0; i < content.series.size(); ++i)
            draw_columns(drawing, panel, content, i, theme);
        drawing.add(ClipWindow{.open = true});
        return panel.draw_axes(drawing, theme, false);
    }
    for_each_series(drawing, content, [&](const Series& series, std::size_t colour) {
        draw_band(drawing, panel, series.x, series.low, series.high, theme.series_colour(colour),
                  0.25);
    });
    for (const Guide& guide : content.guides) draw_guide(drawing, panel, guide, theme.guide);
    drawing.add(ClipWindow{.area = {f.left, f.top - 3, f.width + 3, f.height + 3}});
    draw_rug(drawing, panel, content.rug, theme.ink);
    for_each_series(drawing, content, [&](const Series& series, std::size_t colour) {
        draw_series(drawing, panel, series, theme.series_colour(colour), dash_of(colour, theme));
    });
    drawing.add(ClipWindow{.open = true});
    panel.draw_axes(drawing, theme, false);
}

/// Position of a legend's entry, relative to the legend, and the lines of its name.
struct LegendPlace {
    Position at;
    std::vector<std::string> lines;

    [[nodiscard]] double height() const { return legend_row * static_cast<double>(lines.size()); }
};

std::vector<LegendPlace> legend_places(const std::vector<LegendEntry>& entries, double width) {
    std::vector<LegendPlace> places;
    double x = 0;
    double y = 0;
    for (const LegendEntry& entry : entries) {
        auto lines = wrapped(entry.name, legend_size, width - swatch - 6);
        if (lines.empty()) lines.emplace_back();
        double widest = 0;
        for (const std::string& line : lines)
            widest = std::max(widest, room_of({.text = line, .at = {}, .size = legend_size}).width);
        const double wide = swatch + 6 + widest;
        if (x > 0 && x + wide > width) {
            x = 0;
            y += places.back().height();
        }
        places.push_back({{x, y}, std::move(lines)});
        x += wide + 18;
    }
    return places;
}

}  // namespace

std::string words_of(std::string name) {
    std::ranges::replace(name, '_', ' ');
    std::ranges::replace(name, '-', ' ');
    std::ranges::replace(name, '.', ' ');
    return name;
}

bool needs_legend(const Chart& chart, std::size_t panel) {
    const auto names = names_in(chart.panels[panel]);
    return names.size() > 1 && (panel == 0 || names != names_in(chart.panels[panel - 1]));
}

std::pair<double, double> bar_edges(const ChartPanel& panel, std::size_t series, double x) {
    const auto several = static_cast<double>(panel.series.size());
    const double width = 0.8 / several;
    const double middle = x + width * (static_cast<double>(series) - (several - 1) / 2);
    return {middle - 0.45 * width, middle + 0.45 * width};
}

std::vector<Guide> falling_guides(const Series& series) {
    const auto first = std::ranges::find_if(series.y, [](double y) { return y > 0; });
    if (first == series.y.end() || series.x.size() < 3) return {};
    const double n = series.x[static_cast<std::size_t>(first - series.y.begin())];
    if (!(n > 0)) return {};
    constexpr double aside = 1.5;  // factor between the curve's first value and the guides
    std::vector<Guide> guides;
    for (const double power : {0.5, 1.0}) {
        Guide guide{.name = guides.empty() ? "falling as 1/√n and as 1/n" : ""};
        for (const double x : {n, series.x.back()}) {
            guide.x.push_back(x);
            guide.y.push_back(aside * *first * std::pow(n / x, power));
        }
        guides.push_back(std::move(guide));
    }
    return guides;
}

void name_slope(Series& series) {
    const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
    const std::size_t size = series.x.size();
    if (size < 2 || !std::ranges::all_of(series.y, positive)) return;
    const auto m = static_cast<double>(size);
    const auto sum = [&](const auto& term) {
        double total = 0;
        for (std::size_t i = 0; i < size; ++i)
            total += term(std::log(series.x[i]), std::log(series.y[i]));
        return total;
    };
    const double u = sum([](double x, double) { return x; }) / m;
    const double v = sum([](double, double y) { return y; }) / m;
    const double spread = sum([&](double x, double) { return (x - u) * (x - u); });
    if (!(spread > 0)) return;
    const double slope = sum([&](double x, double y) { return (x - u) * (y - v); }) / spread;
    const double rest = sum([&](double x, double y) {
        const double residual = y - v - slope * (x - u);
        return residual * residual;
    });
    const double error = size < 3 ? 0 : std::sqrt(rest / (m - 2) / spread);
    const bool fine = error < 0.005 && error >= 5e-5;  // too small for two digits after the point
    const int digits = fine ? static_cast<int>(-std::floor(std::log10(error))) : 2;
    const std::string deviation = size < 3 ? "" : " ± " + printed(error, digits);
    series.name += fmt::format(" (slope {}{})", printed(slope, digits), deviation);
}

double legend_height(const std::vector<LegendEntry>& entries, double width) {
    if (entries.empty()) return 0;
    const LegendPlace last = legend_places(entries, width).back();
    return last.at.y + last.height() + 5;
}

void draw_legend(Drawing& drawing, const std::vector<LegendEntry>& entries, Position top_left,
                 double width, const Theme& theme) {
    using Kind = LegendEntry::Kind;
    const auto places = legend_places(entries, width);
    for (std::size_t i = 0; i < entries.size(); ++i) {
        const LegendEntry& entry = entries[i];
        const double x = top_left.x + places[i].at.x;
        const double y = top_left.y + places[i].at.y + legend_row / 2;
        if (entry.kind == Kind::line)
            drawing.add(Line{.vertices = {{x, y}, {x + swatch, y}},
                             .colour = entry.colour,
                             .width = entry.width,
                             .dash = entry.dash});
        else if (entry.kind == Kind::disk)
            drawing.add(
                Disks{.centres = {{x + swatch - 6, y}}, .radius = 4, .colour = entry.colour});
        else
            drawing.rectangle({x, y - 5, swatch, 10}, entry.colour);
        const double below = places[i].height() - legend_row;
        add_lines(drawing,
                  {.text = {},
                   .at = {x + swatch + 6, y + 0.36 * legend_size + below},
                   .size = legend_size,
                   .colour = theme.text},
                  places[i].lines, legend_row);
    }
}

SquareDrawing square_drawing(TitledDrawing titled, const std::vector<LegendEntry>& legend,
                             const Axis& x, const Axis& y, bool bar, const PictureStyle& style) {
    constexpr double least = 60;
    constexpr double above = 14;  // space for the colour bar's name
    Drawing& drawing = titled.drawing;
    double top = titled.top;
    const double whole_width = drawing.width - 2 * picture_margin;
    for (const LegendEntry& entry : legend) {
        draw_legend(drawing, {entry}, {picture_margin, top}, whole_width, *style.theme);
        top += legend_height({entry}, whole_width) - 5;
    }
    if (!legend.empty()) top += 5;
    const double beside = bar ? colour_bar_room : picture_margin / 2;
    double left = 0;
    double below = 0;
    double wide = 500;
    double side = wide;
    for (int rounds = 0; rounds < 3; ++rounds) {  // side and wrapped names affect each other
        left = std::max(left, std::ceil(picture_margin / 2 +
                                        Panel::room_left(y, std::clamp(side, least, 500.0))));
        below =
            std::max(below, Panel::room_below(x, std::clamp(side, least, 200.0)) + picture_margin);
        wide = std::floor(drawing.width - left - beside - picture_margin);
        side = wide;
        if (style.height > 0) side = std::min(side, std::floor(style.height - top - below - above));
    }
    side = std::max(side, least);
    drawing.width = std::max(drawing.width, left + side + beside + picture_margin);
    drawing.height = std::ceil(top + above + side + below);
    const double aside = std::max(std::floor((wide - side) / 2), 0.0);
    return {.drawing = std::move(drawing),
            .frame = {left + aside, std::ceil(top) + above, side, side}};
}

TitledDrawing titled_drawing(const std::string& title, const std::string& subtitle,
                             const PictureStyle& style, double usual_width) {
    const std::string& first = style.title.value_or(title);
    Drawing drawing{.width = style.width > 0 ? style.width : usual_width,
                    .height = style.height,
                    .background = style.theme->background,
                    .title = first.empty() ? "stipple plot" : first};
    double y = picture_margin;
    const double width = drawing.width - 2 * picture_margin;
    const auto put = [&](const std::string& text, double size, bool bold, Colour colour) {
        for (const std::string& line : wrapped(text, size, width, bold)) {
            drawing.add(Label{.text = line,
                              .at = {picture_margin, y + 0.8 * size},
                              .size = size,
                              .colour = colour,
                              .bold = bold});
            y += 1.45 * size;
        }
    };
    put(letter_of(style.letter) + first, 15, true, style.theme->ink);
    const bool untitled = style.title && style.title->empty();
    if (!untitled) put(subtitle, 12, false, style.theme->text);
    return {std::move(drawing), y == picture_margin ? y : y + 5};
}

std::pair<Axis, Axis> chart_axes(const Chart& chart, std::size_t panel, const PictureStyle& style) {
    const std::span panels(chart.panels);
    std::pair axes{x_axis(chart.own_x ? panels.subspan(panel, 1) : panels, style),
                   y_axis(panels[panel], style)};
    axes.first.make_valid();
    axes.second.make_valid();
    return axes;
}

std::string letter_of(const std::optional<std::size_t>& letter) {
    return letter ? fmt::format("({}) ", static_cast<char>('a' + *letter % 26)) : "";
}

namespace {

/// Positions and sizes of a chart's panels.
struct Layout {
    double left = 0;
    double width = 0;
    double unit = 0;  ///< height of a panel with share 1
    double gap = 0;   ///< space between panels
    double below = 0;
    double needed = 0;  ///< height of everything except the panels' frames
    double height = 0;
};

/// Layout for a drawing of this width, if titles and legends take the height `used`. Iterates,
/// since names of axes are wrapped to the panels' size, and more rows of them leave less space for
/// the panels.
Layout layout_of(const Chart& chart, const PictureStyle& style, double width, double used) {
    constexpr double least = 40;  // minimum width of a panel
    constexpr double first_panel = 305;
    constexpr double other_panel = 158;
    double shares = 0;
    for (const ChartPanel& panel : chart.panels) shares += panel.share;
    const auto more_panels = static_cast<double>(chart.panels.size() - 1);
    Layout found{.width = width - 2 * picture_margin};
    for (int rounds = 0; rounds < 4; ++rounds) {
        for (std::size_t i = 0; i < chart.panels.size(); ++i)
            found.below = std::max(
                found.below, Panel::room_below(chart_axes(chart, i, style).first, found.width));
        found.gap = panel_gap + (chart.own_x ? found.below : 0);
        found.needed = used + found.below + picture_margin + found.gap * more_panels;
        found.height = style.height > 0 ? std::max(style.height, found.needed + least_panels)
                                        : found.needed + first_panel + other_panel * more_panels;
        found.unit = (found.height - found.needed) / shares;
        for (const ChartPanel& panel : chart.panels)
            found.left = std::max(
                found.left,
                std::ceil(picture_margin / 2 +
                          Panel::room_left(y_axis(panel, style), found.unit * panel.share)));
        found.width = std::max(least, std::floor(width - found.left - picture_margin - 8));
    }
    return found;
}

}  // namespace

Drawing draw_chart(const Chart& chart, const PictureStyle& style, std::vector<Area>* frames) {
    const Theme& theme = *style.theme;
    const bool lettered = style.letter && chart.panels.size() > 1;
    PictureStyle titles = style;
    if (lettered) titles.letter.reset();
    auto [drawing, y] = titled_drawing(chart.title, chart.subtitle, titles, 720);
    const double whole_width = drawing.width - 2 * picture_margin;
    const double letter_row = lettered ? 20 : 0;
    double used = y + letter_row * static_cast<double>(chart.panels.size());
    std::vector<std::vector<LegendEntry>> legends;
    for (std::size_t i = 0; i < chart.panels.size(); ++i) {
        legends.push_back(legend_of(chart, i, theme));
        used += legend_height(legends.back(), whole_width);
    }
    const Layout layout = layout_of(chart, style, drawing.width, used);
    drawing.height = std::ceil(layout.height);
    drawing.width = std::max(drawing.width, layout.left + layout.width + picture_margin + 8);
    for (std::size_t i = 0; i < chart.panels.size(); ++i) {
        const ChartPanel& panel = chart.panels[i];
        draw_legend(drawing, legends[i], {picture_margin, y}, whole_width, theme);
        y = std::ceil(y + legend_height(legends[i], whole_width) + letter_row);
        if (lettered)
            drawing.add(Label{.text = std::string(trim(letter_of(*style.letter + i))),
                              .at = {picture_margin, y - 8},
                              .size = 13,
                              .colour = theme.ink,
                              .bold = true});
        auto [across, upward] = chart_axes(chart, i, style);
        across.numbers = chart.own_x || i + 1 == chart.panels.size();
        const Area frame{layout.left, y, layout.width, std::floor(layout.unit * panel.share)};
        if (frames != nullptr) frames->push_back(frame);
        draw_panel(drawing, panel, Panel(frame, across, upward), theme);
        y = frame.bottom() + layout.gap;
    }
    return std::move(drawing);
}

namespace {

Bars histogram_between(std::vector<double> edges, std::span<const double> values, bool log) {
    Bars bars{.edges = std::move(edges)};
    bars.heights.resize(bars.edges.size() - 1);
    double inside = 0;
    for (const double value : values) {
        if (!(value >= bars.edges.front() && value <= bars.edges.back())) continue;
        ++inside;
        auto above = std::ranges::upper_bound(bars.edges, value);
        constexpr double slack = 1e-9;  // of a bin: edges are rounded, and values on them are above
        if (above != bars.edges.end() && *above - value < slack * (*above - *std::prev(above)))
            ++above;
        const auto bin = static_cast<std::size_t>(above - bars.edges.begin());
        ++bars.heights[std::min(bin, bars.heights.size()) - 1];
    }
    for (std::size_t i = 0; i < bars.heights.size(); ++i) {
        const double low = bars.edges[i];
        const double high = bars.edges[i + 1];
        bars.heights[i] /= std::max(1.0, inside) * (log ? std::log(high / low) : high - low);
    }
    return bars;
}

}  // namespace

Bars histogram_of(std::span<const double> values, double low, double high, std::size_t bins,
                  bool log) {
    const double reach = log ? std::log(high / low) : high - low;
    std::vector<double> edges = {low};
    for (std::size_t i = 1; i < bins; ++i) {
        const double along = static_cast<double>(i) * (reach / static_cast<double>(bins));
        edges.push_back(log ? low * std::exp(along) : low + along);
    }
    edges.push_back(high);
    return histogram_between(std::move(edges), values, log);
}

std::pair<double, double> keep_positive(std::vector<std::vector<double>>& sets, ChartPanel& panel) {
    double low = HUGE_VAL;
    double high = 0;
    for (auto& values : sets) {
        panel.values += values.size();
        panel.off_axis += std::erase_if(values, [](double x) { return !(x > 0); });
        for (double& value : values) {
            value = std::max(value, least_shown);
            low = std::min(low, value);
            high = std::max(high, value);
        }
    }
    if (!(low <= high))
        fail(ErrorKind::input, "--x-scale: a logarithmic axis cannot show {}: no value is above 0",
             panel.x_name);
    require_shown(low, high);
    if (!flaw_of_range(low, high).empty() || low == high) return {low / 2, 2 * high};
    return {low, high};
}

bool are_whole(std::span<const double> values) {
    constexpr double most = 1e15;  // halves of larger numbers are rounded
    return std::ranges::all_of(values,
                               [](double x) { return std::abs(x) < most && x == std::floor(x); });
}

Bars whole_histogram(std::span<const double> values, double low, double high, std::size_t most,
                     bool log) {
    constexpr std::size_t few = 20;
    std::vector<double> edges = {std::ceil(low) - 0.5};
    const double begin = edges[0];
    const double end = std::floor(high) + 0.5;
    const auto bins = static_cast<double>(std::max(few, most));
    const bool merged = log && end - begin > bins;
    const double width = merged ? std::log(end / begin) / bins : std::ceil((end - begin) / bins);
    for (double i = 1; edges.back() < end; ++i) {
        const double next =
            merged ? std::floor(begin * std::exp(i * width)) + 0.5 : begin + i * width;
        if (next > edges.back()) edges.push_back(std::min(next, end));
    }
    return histogram_between(std::move(edges), values, log);
}

}  // namespace stipple::plot
