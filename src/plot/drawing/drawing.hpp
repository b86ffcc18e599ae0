// SPDX-License-Identifier: MIT
//
// A picture as a list of shapes, in units of which one is a pixel on a plain screen; x to the
// right, y downward. It is written as SVG (svg_bytes, svg_element), as PDF, or as pixels
// (png_bytes_of).
//
// Promise the same drawing gives the same bytes.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace stipple::plot {

struct Colour {
    std::uint8_t red = 0;
    std::uint8_t green = 0;
    std::uint8_t blue = 0;
    bool operator==(const Colour&) const = default;
};

/// a + share (b - a).
inline Colour mixed(Colour a, Colour b, double share) {
    const auto mix = [share](std::uint8_t from, std::uint8_t to) {
        return static_cast<std::uint8_t>(std::lround(from + share * (to - from)));
    };
    return {mix(a.red, b.red), mix(a.green, b.green), mix(a.blue, b.blue)};
}

struct Position {
    double x = 0;
    double y = 0;
    bool operator==(const Position&) const = default;
};

/// An upright rectangle.
struct Area {
    double left = 0;
    double top = 0;
    double width = 0;
    double height = 0;

    [[nodiscard]] double right() const { return left + width; }
    [[nodiscard]] double bottom() const { return top + height; }
};

enum class Dash { none, dashed, dotted };

/// A polyline; crisp: of whole pixels, for lines along the axes.
struct Line {
    std::vector<Position> vertices = {};
    Colour colour = {};
    double width = 1;
    Dash dash = Dash::none;
    bool crisp = false;
};

/// The inside of a closed line.
struct Patch {
    std::vector<Position> vertices = {};
    Colour colour = {};
    double opacity = 1;
};

/// Disks of one size.
struct Disks {
    std::vector<Position> centres = {};
    double radius = 1;
    Colour colour = {};
    double opacity = 1;
};

enum class Anchor { start, middle, end };

/// A line of text; `at` is on its base line. Upward: read from below, for the axis on the left.
struct Label {
    std::string text;
    Position at;
    double size = 12;
    Colour colour = {};
    Anchor anchor = Anchor::start;
    bool upward = false;
    bool bold = false;
};

/// Pixels, row after row from the top, stretched to an area; each stays a sharp square.
struct PixelImage {
    Area area;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<Colour> pixels = {};
};

/// Clips the shapes that follow, up to the next one, to an area.
struct ClipWindow {
    Area area = {};
    bool open = false;  ///< no clipping
};

/// What follows is one group of a page's SVG, up to the next one; of files it changes nothing.
struct SvgGroup {
    std::string attributes;  ///< of its element: class="box star"; empty: no group
};

using Shape = std::variant<Line, Patch, Disks, Label, PixelImage, ClipWindow, SvgGroup>;

struct Drawing {
    double width = 0;
    double height = 0;
    Colour background = {255, 255, 255};
    std::string title;  ///< for readers of screens, and the file's text chunk
    std::vector<Shape> shapes = {};

    /// Made in its place: GCC 12 takes a moved variant for one that was not initialized.
    template <class S>
    void add(S shape) {
        shapes.emplace_back(std::in_place_type<S>, std::move(shape));
    }
    void line(Position from, Position to, Colour colour) {
        add(Line{.vertices = {from, to}, .colour = colour, .crisp = true});
    }
    void rectangle(const Area& area, Colour colour) {
        add(Patch{.vertices = {{area.left, area.top},
                               {area.right(), area.top},
                               {area.right(), area.bottom()},
                               {area.left, area.bottom()}},
                  .colour = colour});
    }
};

/// What a picture's file says about itself, besides its title: keyword and text.
using PictureNotes = std::vector<std::pair<std::string, std::string>>;

/// As SVG 1.1; text is text. One unit is `scale` pixels.
std::string svg_bytes(const Drawing& drawing, double scale, const PictureNotes& notes = {});

/// As an element of a page, in the colours of the first where the page is light, of the second
/// where it is dark; the label describes it to screen readers. Both have the same shapes.
std::string svg_element(const Drawing& light, const Drawing& dark, const std::string& label);

/// A number to hundredths of a unit, which are more than eyes see.
std::string short_number(double x);

/// As one page of PDF 1.4, which carries its fonts; one unit is `scale` times 3/4 of a point.
std::string pdf_bytes(const Drawing& drawing, double scale, const PictureNotes& notes = {});

/// Pixels as PNG; grey: of one part, where all three are the same.
std::string png_bytes_of(const PixelImage& image, bool grey, const PictureNotes& notes = {});

/// As PNG, one unit `scale` pixels. @throws Error(limit) for one that is too large.
std::string png_bytes_of(const Drawing& drawing, double scale, const PictureNotes& notes = {});

// Colours of pictures. Series take M. Okabe and K. Ito's colours, which colour-blind readers can
// tell apart, in an order that differs in lightness as well, for print in grey.

struct Theme {
    Colour background;
    Colour ink;    ///< titles
    Colour text;   ///< numbers and names on axes
    Colour frame;  ///< axes
    Colour grid;   ///< lines behind the data
    Colour band;   ///< what chance allows
    Colour guide;  ///< lines to compare with
    std::span<const Colour> series;

    [[nodiscard]] Colour series_colour(std::size_t i) const { return series[i % series.size()]; }
};

inline constexpr Colour light_series[] = {{0, 114, 178},   {213, 94, 0},  {0, 158, 115},
                                          {204, 121, 167}, {230, 159, 0}, {86, 180, 233},
                                          {0, 0, 0}};
inline constexpr Colour dark_series[] = {{86, 180, 233},  {240, 128, 48}, {26, 188, 144},
                                         {222, 150, 190}, {240, 190, 60}, {110, 140, 255},
                                         {245, 245, 245}};

inline constexpr Theme light_theme{.background = {255, 255, 255},
                                   .ink = {26, 26, 26},
                                   .text = {64, 64, 64},
                                   .frame = {112, 112, 112},
                                   .grid = {230, 230, 230},
                                   .band = {222, 222, 222},
                                   .guide = {107, 107, 107},
                                   .series = light_series};

inline constexpr Theme dark_theme{.background = {22, 24, 28},
                                  .ink = {236, 236, 236},
                                  .text = {190, 193, 198},
                                  .frame = {128, 132, 140},
                                  .grid = {48, 51, 57},
                                  .band = {58, 62, 69},
                                  .guide = {150, 154, 162},
                                  .series = dark_series};

}  // namespace stipple::plot
