// SPDX-License-Identifier: MIT
//
// A picture as a list of shapes. A unit is one pixel on an ordinary screen; x is to the right, y
// downwards. Drawings are written as SVG (svg_bytes, svg_element), PDF, or pixels (png_bytes_of).
//
// Promise the same drawing gives the same bytes.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
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

/// Blends two colours: a + share (b - a).
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

/// An axis-parallel rectangle.
struct Area {
    double left = 0;
    double top = 0;
    double width = 0;
    double height = 0;

    [[nodiscard]] double right() const { return left + width; }
    [[nodiscard]] double bottom() const { return top + height; }
};

enum class Dash { none, dashed, dotted };

/// A polyline. If `crisp`, it is aligned to whole pixels, for lines parallel to the axes.
struct Line {
    std::vector<Position> vertices = {};
    Colour colour = {};
    double width = 1;
    Dash dash = Dash::none;
    bool crisp = false;
};

/// The interior of a closed line.
struct Patch {
    std::vector<Position> vertices = {};
    Colour colour = {};
    double opacity = 1;
};

/// Disks of equal size.
struct Disks {
    std::vector<Position> centres = {};
    double radius = 1;
    Colour colour = {};
    double opacity = 1;
};

enum class Anchor { start, middle, end };

/// A line of text; `at` is its anchor on the baseline. If `upward`, it reads from bottom to top,
/// for the left axis.
struct Label {
    std::string text;
    Position at;
    double size = 12;
    Colour colour = {};
    Anchor anchor = Anchor::start;
    bool upward = false;
    bool bold = false;
};

/// Pixels in row-major order from the top, scaled to an area without smoothing.
struct PixelImage {
    Area area;
    std::size_t columns = 0;
    std::size_t rows = 0;
    std::vector<Colour> pixels = {};
};

/// Clips the following shapes to an area, up to the next ClipWindow.
struct ClipWindow {
    Area area = {};
    bool open = false;  ///< true: ends clipping
};

/// Puts the following shapes into a group of a page's SVG, up to the next SvgGroup; not in files.
struct SvgGroup {
    std::string attributes;  ///< attributes of the group element, class="box star"; empty: no group
};

using Shape = std::variant<Line, Patch, Disks, Label, PixelImage, ClipWindow, SvgGroup>;

struct Drawing {
    double width = 0;
    double height = 0;
    Colour background = {255, 255, 255};
    std::string title;  ///< title in the file's metadata, also for screen readers
    std::vector<Shape> shapes = {};

    /// Constructed in place: GCC 12 warns that a moved variant is uninitialized.
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

/// Metadata in a picture's file besides its title: keyword and text.
using PictureNotes = std::vector<std::pair<std::string, std::string>>;

/// An SVG 1.1 file; text remains text. One unit is `scale` pixels.
std::string svg_bytes(const Drawing& drawing, double scale, const PictureNotes& notes = {});

/// An SVG element for a page: the first drawing's colours on light pages, the second drawing's on
/// dark pages. Both must have the same shapes. `label` describes it to screen readers.
std::string svg_element(const Drawing& light, const Drawing& dark, const std::string& label);

/// A number of units rounded to hundredths, which are finer than visible.
std::string short_number(double x);

/// One page of PDF 1.4 with embedded fonts; one unit is `scale` times 3/4 of a point.
std::string pdf_bytes(const Drawing& drawing, double scale, const PictureNotes& notes = {});

/// The note that pdf_bytes() wrote under this keyword; empty if the file has none.
std::string pdf_note(std::string_view pdf, const std::string& keyword);

/// A PNG file of pixels. If `grey`, writes only one channel; red, green and blue must be equal.
std::string png_bytes_of(const PixelImage& image, bool grey, const PictureNotes& notes = {});

/// A PNG file of a drawing; one unit is `scale` pixels. @throws Error(limit) if it is too large
std::string png_bytes_of(const Drawing& drawing, double scale, const PictureNotes& notes = {});

// Colours. Series use the palette of M. Okabe and K. Ito, which colour-blind readers can
// distinguish. Its order also alternates lightness, for greyscale print.

struct Theme {
    Colour background;
    Colour ink;    ///< titles
    Colour text;   ///< numbers and names on axes
    Colour frame;  ///< axes
    Colour grid;   ///< lines behind the data
    Colour band;   ///< range of random variation
    Colour guide;  ///< reference lines
    std::span<const Colour> series;

    [[nodiscard]] Colour series_colour(std::size_t i) const { return series[i % series.size()]; }
};

inline constexpr Colour light_series[] = {{0, 114, 178},   {213, 94, 0},  {0, 158, 115},
                                          {204, 121, 167}, {230, 159, 0}, {86, 180, 233},
                                          {0, 0, 0}};
inline constexpr Colour dark_series[] = {{86, 180, 233},  {240, 128, 48}, {26, 188, 144},
                                         {222, 150, 190}, {240, 190, 60}, {110, 140, 255},
                                         {245, 245, 245}};

/// Colour for a share of the largest value: from the background through the first series' colour to
/// the ink.
inline Colour shade_of(const Theme& theme, double share) {
    const Colour middle = theme.series[0];
    return share < 0.6 ? mixed(theme.background, middle, share / 0.6)
                       : mixed(middle, theme.ink, (share - 0.6) / 0.4);
}

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
