// SPDX-License-Identifier: MIT
#include "page/figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "core/json.hpp"
#include "core/text.hpp"
#include "plot/drawing/html_text.hpp"
#include "plot/drawing/ticks.hpp"
#include "plot/report_charts.hpp"
#include "plot/spectral_table.hpp"

namespace stipple::page {

using namespace plot;

namespace {

constexpr double picture_width = 520;
constexpr double pairs_width = 1000;
constexpr double line_width = 720;

constexpr Colour light_sets[] = {{0, 114, 178}, {213, 94, 0},   {0, 137, 95},   {176, 80, 138},
                                 {176, 125, 0}, {47, 159, 208}, {60, 60, 60},   {122, 79, 192},
                                 {160, 48, 48}, {95, 127, 31},  {15, 143, 143}, {143, 111, 95}};
constexpr Colour dark_sets[] = {{86, 180, 233},  {240, 128, 48},  {26, 188, 144},  {222, 150, 190},
                                {240, 190, 60},  {143, 208, 245}, {208, 208, 208}, {182, 154, 240},
                                {240, 138, 138}, {169, 201, 90},  {79, 208, 208},  {205, 176, 160}};

constexpr Theme with_sets(Theme theme, std::span<const Colour> colours) {
    theme.series = colours;
    return theme;
}

constexpr Theme light_page = with_sets(light_theme, light_sets);
constexpr Theme dark_page = with_sets(dark_theme, dark_sets);

/// Legend of the boxes, with a checkbox for each; projected boxes are hidden initially.
std::string box_legend(const std::vector<MarkedBox>& boxes, bool projections) {
    if (boxes.empty()) return {};
    std::string out = "<ul class=\"boxes\">\n";
    for (const MarkedBox& box : boxes)
        out += fmt::format(
            "<li><label><input type=\"checkbox\" data-box=\"{0}\"{3}> <span class=\"key {0}{1}\">"
            "</span> {2}</label></li>\n",
            box.kind, box.closed ? "" : " open", html_text(box.label),
            !projections && (box.kind == "star" || box.kind == "empty") ? " checked" : "");
    return out + "</ul>\n";
}

/// Draws once in light and once in dark colours. @param label description of the picture
template <class Draw>
std::string themed(const Draw& draw, const std::string& label) {
    return svg_element(draw(light_page), draw(dark_page), label);
}

/// The drawing of a set's points, with its boxes. @param number selects the colour
template <class Draw>
std::string figure_of(const Set& set, const PointSet& points, std::size_t number, const char* where,
                      const Draw& draw) {
    const PointsPicture picture{.sets = {&points},
                                .names = {set.name},
                                .boxes = worst_boxes(set),
                                .most_disks = most_dots,
                                .most_coordinates = most_axes};
    const double width = points.dimension() == 1  ? line_width
                         : points.dimension() > 3 ? pairs_width
                                                  : picture_width;
    const auto drawn = [&](Theme theme) {
        theme.series = theme.series.subspan(number % theme.series.size(), 1);
        return draw(picture, PictureStyle{.theme = &theme, .width = width}, RunContext());
    };
    return themed(drawn, fmt::format("{} point{} of {} {}", points.count(),
                                     points.count() == 1 ? "" : "s", set.name, where));
}

std::string figure(const std::string& kind, const std::string& body, const std::string& caption) {
    return fmt::format("<figure class=\"{}\">\n{}<figcaption>{}</figcaption>\n</figure>\n", kind,
                       body, caption);
}

/// The drawing of the points with the legend of the worst boxes.
std::string boxes_figure(const char* kind, const std::string& drawing, const Set& set,
                         std::string caption, bool projections) {
    const auto boxes = worst_boxes(set);
    if (!boxes.empty())
        caption += projections ? ". A worst box is drawn as its projections: a point is in the box "
                                 "only if it is in all of them"
                               : ", with the worst boxes";
    return figure(kind, drawing + box_legend(boxes, projections), caption + ".");
}

/// Smallest odd side of blocks such that at most `most` blocks cover `rows` rows.
std::size_t block_side(std::size_t rows, std::size_t most) {
    std::size_t block = 1;
    while ((rows + block - 1) / block > most) block += 2;
    return block;
}

// -------------------------------------------------------------------- charts

constexpr double chart_width = 640;
constexpr double chart_height = 300;

/// Numbers rounded to the precision that a chart shows.
Json short_numbers(const std::vector<double>& values) {
    Json list = Json::array();
    for (const double v : values) {
        const auto number = parse_number(fmt::format("{:.4g}", v));  // unset if not finite
        list.push_back(number ? Json(*number) : Json());
    }
    return list;
}

/// Data for the page's script, which shows the values of curves under the pointer.
std::string numbers_of(std::span<const Set> sets, const Chart& chart, const Area& frame) {
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
                      {"log", x.log},
                      {"from", x.low},
                      {"to", x.high},
                      {"curves", curves}};
    std::string text = json_text(all);
    replace_all(text, "<", "\\u003c");  // "</script" in a name would end the element
    return text;
}

/// Chart of a measure of the given sets, omitting sets without the curve; only its first panel.
std::string chart_figure(std::span<const Set> sets, std::span<const std::size_t> which,
                         const Planned& plan, const CurveKey& curve) {
    std::vector<Measurement> found;
    std::vector<std::size_t> numbers;
    std::vector<std::string> without;
    bool several = false;
    for (const std::size_t i : which) {
        const Report* results = sets[i].results(plan.name);
        if (results == nullptr || results->find(curve.key) == nullptr) {
            without.push_back(sets[i].name);
            continue;
        }
        several = several || !sets[i].replications.empty();
        found.push_back({.analyzer = plan.analyzer->name,
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
    const auto drawn = [&](const Theme& theme) {
        return draw_chart(chart, {.theme = &theme, .width = chart_width, .height = chart_height},
                          &frames);
    };
    const std::string of =
        found.size() == 1 ? found[0].source : fmt::format("{} sets", found.size());
    const std::string what =
        curve.title.empty() ? plot::words_of(plan.analyzer->name) : std::string(curve.title);
    const std::string svg = themed(drawn, fmt::format("{} of {}", what, of));
    return figure("chart",
                  fmt::format("{}<output class=\"tip\" hidden></output>\n<script "
                              "type=\"application/json\">{}</script>\n",
                              svg, numbers_of(sets, chart, frames.front())),
                  std::string(curve.caption) + (panel.log_y ? "; logarithmic" : "") +
                      (several ? "; for the first seed" : "") +
                      (without.empty() ? "" : "; without " + html_text(join(without, ", "))) + ".");
}

}  // namespace

const Theme& theme_of(bool dark) { return dark ? dark_page : light_page; }

std::vector<MarkedBox> worst_boxes(const Set& set) {
    static const std::map<std::string, const char*> titles = {
        {"star", "worst box from the origin"},
        {"extreme", "worst box of all"},
        {"periodic", "worst box on the torus"}};
    std::vector<MarkedBox> boxes;
    for (const Measure& measure : set.measures) {
        if (!measure.results) continue;
        const Report& found = *measure.results;
        const std::string kind = option_of(measure.options, "kind");
        if (const auto corner = list_at(found, "worst_box.corner")) {
            // A measure of prefixes finds the box of the whole set again; `boxes` has it already.
            if (std::ranges::find(boxes, kind, &MarkedBox::kind) != boxes.end()) continue;
            MarkedBox box{.kind = kind, .high = *corner};
            box.low = list_at(found, "worst_box.lower_corner")
                          .value_or(std::vector<double>(box.high.size(), 0));
            if (const auto* closed = std::get_if<bool>(found.find("worst_box.closed")))
                box.closed = *closed;
            const double share = found.number("worst_box.points") / static_cast<double>(set.count);
            box.label =
                fmt::format("{}: {} of the points in {} of the volume", titles.at(kind),
                            rounded(share, 4), rounded(found.number("worst_box.volume"), 4));
            boxes.push_back(std::move(box));
        } else if (found.find("box.lower_corner") != nullptr) {
            boxes.push_back({.kind = "empty",
                             .label = fmt::format("largest empty box: volume {}",
                                                  rounded(found.number("lower"), 4)),
                             .low = found.curve("box.lower_corner"),
                             .high = found.curve("box.upper_corner")});
        }
    }
    return boxes;
}

std::vector<std::string> point_figures(const PointSet& points, const Set& set, std::size_t number) {
    const auto drawing = [&](const char* where, const auto& draw) {
        return figure_of(set, points, number, where, draw);
    };
    const std::size_t d = points.dimension();
    if (d == 1) return {figure("wide", drawing("on a line", draw_points), "Points on the line.")};
    if (d == 2)
        return {boxes_figure("picture", drawing("in the plane", draw_points), set,
                             points.count() > most_dots ? "Points, as pixels" : "Points", false)};
    const std::string pairs =
        boxes_figure(d == 3 ? "picture" : "wide", drawing("by pairs of axes", draw_pairs), set,
                     d > most_axes ? fmt::format("Pairs of the first {} of {} axes", most_axes, d)
                                   : "Projections on every pair of axes",
                     true);
    if (d > 3) return {pairs};
    return {figure("picture", drawing("in space", draw_points),
                   "Points in space, seen from a fixed direction."),
            pairs};
}

Grid in_blocks(const Grid& grid, std::size_t most) {
    const std::size_t block = block_side(grid.rows, most);
    if (block == 1) return grid;
    // The centre remains the centre of its block; incomplete blocks at the edge are omitted.
    const std::size_t half = (grid.rows / 2 - block / 2) / block;
    const std::size_t first = grid.rows / 2 - block / 2 - half * block;
    const std::size_t side = 2 * half + 1;
    Grid small{.rows = side, .columns = side, .values = std::vector<double>(side * side)};
    for (std::size_t row = 0; row < side * block; ++row)
        for (std::size_t column = 0; column < side * block; ++column)
            small.values[row / block * side + column / block] +=
                grid.values[(first + row) * grid.columns + first + column] /
                static_cast<double>(block * block);
    return small;
}

std::string spectrum_figure(const Set& set) {
    constexpr std::size_t most_pixels = 255;
    const Grid* grid = nullptr;
    for (const Measure& measure : set.measures)
        if (measure.results && grid == nullptr)
            grid = std::get_if<Grid>(measure.results->find("grid"));
    if (grid == nullptr || set.dimension != 2 || grid->rows != grid->columns || grid->rows % 2 == 0)
        return {};
    Grid centred = *grid;
    centred.values[centred.values.size() / 2] = 0;  // frequency zero would dominate its block
    const Grid small = in_blocks(centred, most_pixels);
    const std::size_t block = block_side(grid->rows, most_pixels);
    const TableNames names{
        .x = "frequency along x", .y = "frequency along y", .cell = static_cast<double>(block)};
    const auto draw = [&](const Theme& theme) {
        return draw_spectrum(small, "", "", {.theme = &theme, .width = picture_width}, names);
    };
    std::string caption =
        fmt::format("Power at frequencies −{0} to {0}: black 0, grey 1 (white noise), white ∞",
                    small.rows * block / 2);
    if (block > 1) caption += fmt::format("; a pixel is the mean of {0} × {0}", block);
    return figure(
        "picture",
        themed(draw, fmt::format("power spectrum of {}, frequency zero in the middle", set.name)),
        caption + ".");
}

std::string curve_figures(std::span<const Set> sets, std::span<const std::size_t> which) {
    std::vector<std::pair<const Planned*, const CurveKey*>> all;
    for (const Planned& plan : planned_measures())
        for (const CurveKey& curve : plan.analyzer->curves)
            if (!curve.caption.empty()) all.emplace_back(&plan, &curve);
    // Curves over the number of points, whose axes are logarithmic, come last.
    std::ranges::stable_sort(all, {}, [](const auto& one) { return one.second->log; });
    std::string out;
    for (const auto& [plan, curve] : all) out += chart_figure(sets, which, *plan, *curve);
    return out;
}

}  // namespace stipple::page
