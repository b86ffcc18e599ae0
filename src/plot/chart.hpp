// SPDX-License-Identifier: MIT
//
// Charts of curves: panels one above the other, mostly over the same x axis, with a legend above each.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "plot/drawing/drawing.hpp"
#include "plot/drawing/panel.hpp"

namespace stipple::plot {

/// Space between a picture's edge and what is drawn, in units of a drawing.
constexpr double picture_margin = 14;

/// How a picture looks. Sizes in units of a drawing; 0: automatic. What has lengths along both axes
/// alike may need less height.
struct PictureStyle {
    const Theme* theme = &light_theme;
    double width = 0;
    double height = 0;
    double scale = 1;                       ///< pixels in a unit
    double rows = 1;                        ///< of such pictures in the height that was asked for
    std::optional<std::string> title = {};  ///< instead of the picture's own
    std::optional<bool> log_x = {};
    std::optional<bool> log_y = {};
    bool tight = false;  ///< charts' axes end with what they show
};

/// One curve, or the bars of a histogram. Not finite values are gaps.
struct Series {
    std::string name;
    std::vector<double> x = {};
    std::vector<double> y = {};
    std::vector<double> low = {};  ///< a band around it; empty: none
    std::vector<double> high = {};
    bool marks = false;                   ///< a disk at each value
    std::size_t measurement = 0;          ///< that it is of, where it is of one
    std::optional<std::size_t> set = {};  ///< gives its colour, and its group in a page
};

/// A line to compare with.
struct Guide {
    std::string name = {};
    std::vector<double> x = {};  ///< empty: across the panel, at y[0]
    std::vector<double> y = {};
    bool reached = false;  ///< the axis goes as far, whatever the curves do
};

/// Bars of a histogram: edges are one more than heights.
struct Bars {
    std::string name = {};
    std::vector<double> edges = {};
    std::vector<double> heights = {};
};

struct ChartPanel {
    std::string x_name;
    std::string y_name;
    std::vector<Series> series = {};
    std::vector<Series> bands = {};  ///< behind the curves: what chance allows, low and high alone
    std::vector<Guide> guides = {};
    std::vector<Bars> bars = {};
    /// Names along the x axis, at 1, 2, ...: the series are bars side by side there, from 0 on, each
    /// with an interval from low to high.
    std::vector<std::string> categories = {};
    std::vector<double> rug = {};  ///< marks below, one for each value
    bool log_x = false;
    bool log_y = false;
    bool whole_x = false;
    bool from_zero = false;  ///< the y axis starts there
    double reach_y =
        -std::numeric_limits<double>::infinity();  ///< a linear y axis goes up to it at least
    double least_y = -std::numeric_limits<double>::infinity();  ///< the axis shows no less
    double share = 1;  ///< of the height, relative to the other panels'
};

struct Chart {
    std::string title;
    std::string subtitle = {};
    std::vector<ChartPanel> panels = {};
    bool own_x = false;  ///< each panel has its own x axis
};

/// Whether the names of a panel's curves are not those of the panel above.
bool needs_legend(const Chart& chart, std::size_t panel);

/// Where the bar of a series begins and ends along x, in the category at x.
std::pair<double, double> bar_edges(const ChartPanel& panel, std::size_t series, double x);

/// @throws Error(usage) where the height asked for is less than what a picture needs
void require_height(const PictureStyle& style, double needed);

/// @param frames if not null, gets where the panels are
/// @throws Error(usage) where the height asked for leaves no room.
Drawing draw_chart(const Chart& chart, const PictureStyle& style,
                   std::vector<Area>* frames = nullptr);

/// The axes of a panel, as they are drawn.
std::pair<Axis, Axis> chart_axes(const Chart& chart, std::size_t panel, const PictureStyle& style);

/// A drawing with its title lines at the top left.
struct TitledDrawing {
    Drawing drawing;
    double top = 0;  ///< height that they take
};
TitledDrawing titled_drawing(const std::string& title, const std::string& subtitle,
                             const PictureStyle& style, double usual_width);

/// What a legend explains.
struct LegendEntry {
    enum class Kind { line, box, disk };
    Kind kind = Kind::line;
    std::string name;
    Colour colour = {};
    Dash dash = Dash::none;
    double width = 2;  ///< of a line
};

/// A drawing with titles and a legend, row by row, above a square, which has room for its axes and,
/// beside it, a bar of colours.
struct SquareDrawing {
    Drawing drawing;
    Area frame;  ///< the square
};
SquareDrawing square_drawing(TitledDrawing titled, const std::vector<LegendEntry>& legend,
                             const Axis& x, const Axis& y, bool bar, const PictureStyle& style);

/// Where the bar of colours stands beside the square.
inline Area bar_beside(const Area& frame) {
    return {frame.right() + 14, frame.top, 14, frame.height};
}

/// A result's name as an axis has it: "radial power" of "radial.power".
std::string words_of(std::string name);

/// Lines through the first value of a curve above 0 that fall as n^(-1/2) and n^(-1).
std::vector<Guide> falling_guides(const Series& series);

/// Height of a legend in rows as wide as `width`.
double legend_height(const std::vector<LegendEntry>& entries, double width);
void draw_legend(Drawing& drawing, const std::vector<LegendEntry>& entries, Position top_left,
                 double width, const Theme& theme);

/// A histogram in so many bins of one width, over [low, high]; heights are shares over the width.
Bars histogram_of(const std::vector<double>& values, double low, double high, std::size_t bins);

}  // namespace stipple::plot
