// SPDX-License-Identifier: MIT
//
// Charts of curves: panels one above another, usually with a common x axis, each below its legend.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "plot/drawing/drawing.hpp"
#include "plot/drawing/panel.hpp"

namespace stipple::plot {

/// Space between a picture's edge and its content, in drawing units.
constexpr double picture_margin = 14;

/// Style of a picture. Width and height are in drawing units; 0: automatic. Pictures with equal
/// scales on both axes may be less high than requested. Pictures that need more room are larger.
struct PictureStyle {
    const Theme* theme = &light_theme;
    double width = 0;
    double height = 0;
    double scale = 1;                       ///< pixels per unit
    std::optional<std::string> title = {};  ///< replaces the picture's own title
    /// Number of the first panel's letter, from 0 for (a); nullopt: panels have no letters.
    std::optional<std::size_t> letter = {};
    std::optional<bool> log_x = {};
    std::optional<bool> log_y = {};
    bool tight = false;  ///< whether axes of charts end exactly at the data
};

/// A curve, or bars with one value for each category. Values that are not finite are gaps.
struct Series {
    std::string name;
    std::vector<double> x = {};
    std::vector<double> y = {};
    std::vector<double> low = {};  ///< lower limit of a band around the curve; empty: no band
    std::vector<double> high = {};
    bool marks = false;           ///< draws a disk at each value
    std::size_t measurement = 0;  ///< index of the measurement that the curve shows, if any
    /// Index of the set, which determines the colour and the group in a page.
    std::optional<std::size_t> set = {};
};

/// A reference line.
struct Guide {
    std::string name = {};
    std::vector<double> x = {};  ///< empty: a horizontal line at y[0]
    std::vector<double> y = {};
    bool reached = false;  ///< whether the y axis always includes the line
};

/// Bars of a histogram. There is one more edge than there are heights.
struct Bars {
    std::string name = {};
    std::vector<double> edges = {};
    std::vector<double> heights = {};
};

struct ChartPanel {
    std::string x_name;
    std::string y_name;
    std::vector<Series> series = {};
    std::vector<Series> bands = {};  ///< ranges of random variation, filled from `low` to `high`
    std::vector<Guide> guides = {};
    std::vector<Bars> bars = {};
    /// Names along the x axis, at 1, 2, ... If not empty, the series are drawn as bars from 0, side
    /// by side at each name, with intervals from low to high.
    std::vector<std::string> categories = {};
    std::vector<double> rug = {};  ///< values marked by short lines at the bottom
    bool log_x = false;
    bool log_y = false;
    std::size_t values = 0;    ///< number of values in a histogram, with those off the axis
    std::size_t off_axis = 0;  ///< number of values of 0 or less
    bool whole_x = false;
    bool from_zero = false;  ///< whether the y axis starts at 0
    double reach_y =
        -std::numeric_limits<double>::infinity();  ///< value that a linear y axis includes
    /// Limit below which a logarithmic y axis does not extend.
    double least_y = -std::numeric_limits<double>::infinity();
    double share = 1;  ///< height relative to other panels
};

struct Chart {
    std::string title;
    std::string subtitle = {};
    std::vector<ChartPanel> panels = {};
    bool own_x = false;  ///< whether each panel has its own x axis
};

/// Whether a panel has several curves or bars whose names differ from those of the panel above.
bool needs_legend(const Chart& chart, std::size_t panel);

/// Left and right end of a series' bar along x, in the category at x.
std::pair<double, double> bar_edges(const ChartPanel& panel, std::size_t series, double x);

/// "(a) ", "(b) ", ...; empty without a letter.
std::string letter_of(const std::optional<std::size_t>& letter);

/// Draws all panels with their legends. @param frames if not null, receives the panels' frames
Drawing draw_chart(const Chart& chart, const PictureStyle& style,
                   std::vector<Area>* frames = nullptr);

/// The x and y axis of a panel, with their final ranges.
std::pair<Axis, Axis> chart_axes(const Chart& chart, std::size_t panel, const PictureStyle& style);

/// A drawing with title lines at the top left.
struct TitledDrawing {
    Drawing drawing;
    double top = 0;  ///< height of the title lines
};
TitledDrawing titled_drawing(const std::string& title, const std::string& subtitle,
                             const PictureStyle& style, double usual_width);

struct LegendEntry {
    enum class Kind { line, box, disk };
    Kind kind = Kind::line;
    std::string name;
    Colour colour = {};
    Dash dash = Dash::none;
    double width = 2;  ///< width of a line
};

/// A drawing with titles and a legend above an empty square, and space for axes and, if `bar`, a
/// colour bar.
struct SquareDrawing {
    Drawing drawing;
    Area frame;  ///< the square
};
SquareDrawing square_drawing(TitledDrawing titled, const std::vector<LegendEntry>& legend,
                             const Axis& x, const Axis& y, bool bar, const PictureStyle& style);

/// Position of the colour bar beside the square.
inline Area bar_beside(const Area& frame) {
    return {frame.right() + 14, frame.top, 14, frame.height};
}

/// Last part of a dotted key: "power" for "radial.power".
inline std::string_view last_part(std::string_view key) { return key.substr(key.rfind('.') + 1); }

/// A result's name on an axis: "radial power" for "radial.power".
std::string words_of(std::string name);

/// Guides falling as n^(-1/2) and n^(-1), from slightly above the curve's first positive value.
std::vector<Guide> falling_guides(const Series& series);

/// Adds the exponent of n in a power law, fitted to the curve by least squares of logarithms, to
/// its name: "halton (slope −0.98 ± 0.02)". The standard error needs three values. Curves with
/// fewer than two values, or with values that are not positive, have no slope.
void name_slope(Series& series);

/// Height of a legend wrapped to `width`.
double legend_height(const std::vector<LegendEntry>& entries, double width);
void draw_legend(Drawing& drawing, const std::vector<LegendEntry>& entries, Position top_left,
                 double width, const Theme& theme);

/// Histogram with `bins` equal bins over [low, high]; heights are fractions of the values per bin
/// width. If `log`, bins and their widths are equal in logarithms.
Bars histogram_of(std::span<const double> values, double low, double high, std::size_t bins,
                  bool log = false);

/// Removes values of 0 or less from the sets of a histogram on a logarithmic axis, and counts them
/// in the panel. Returns a range for the other values. @throws Error(input) if there are no others
std::pair<double, double> keep_positive(std::vector<std::vector<double>>& sets, ChartPanel& panel);

/// Whether all values are whole, and so small that halves between them are exact.
bool are_whole(std::span<const double> values);

/// Histogram of the whole numbers from `low` to `high`, with edges halfway between them: one bin
/// for each number. If there are more than `most` numbers and more than 20, bins have equally many
/// of them (the last may have fewer) or, if `log`, are about equal in logarithms.
Bars whole_histogram(std::span<const double> values, double low, double high, std::size_t most,
                     bool log = false);

}  // namespace stipple::plot
