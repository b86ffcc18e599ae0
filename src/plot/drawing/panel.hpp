// SPDX-License-Identifier: MIT
//
// A frame with two axes, and the way from data to its place in a drawing; a bar beside a picture
// that says what its colours mean.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "plot/drawing/drawing.hpp"
#include "plot/drawing/ticks.hpp"

namespace stipple::plot {

inline constexpr double number_size = 12;  ///< of the numbers on axes
inline constexpr double name_size = 13;    ///< of the axes' names

struct Axis {
    double low = 0;
    double high = 1;
    bool log = false;
    bool binary = false;                  ///< logarithmic, with numbers at powers of two
    bool whole = false;                   ///< numbers are whole
    std::vector<std::string> words = {};  ///< in place of the numbers from first_word on
    double first_word = 1;
    std::string name = {};  ///< empty: none
    bool numbers = true;    ///< false: marks only, where the panel below has them
    bool tight = false;     ///< numbers stay within the frame, where another one is beside it

    /// Numbers that fit along so many units: side by side, or one above the other.
    [[nodiscard]] Ticks ticks(double length, bool upright) const;

    /// The place of a value between low (0) and high (1).
    [[nodiscard]] double share(double value) const;

    /// Makes [low, high] a range whose ends differ to so many digits, and what is logarithmic positive; a
    /// range that was narrower is named so. @throws Error(input) beyond what axes reach
    void make_valid(int digits = shown_digits);
};

class Panel {
  public:
    Panel(const Area& frame, Axis x, Axis y);

    [[nodiscard]] const Area& frame() const { return frame_; }
    [[nodiscard]] double x(double value) const;
    [[nodiscard]] double y(double value) const;
    [[nodiscard]] Position at(double x_value, double y_value) const {
        return {x(x_value), y(y_value)};
    }

    /// Faint lines behind the data.
    void draw_grid(Drawing& drawing, const Theme& theme) const;

    /// The frame with its numbers and names; closed: on all four sides.
    void draw_axes(Drawing& drawing, const Theme& theme, bool closed) const;

    /// Room that numbers and name take beside a frame of that height, and below one of that width.
    static double room_left(const Axis& y, double height);
    static double room_below(const Axis& x, double width);

  private:
    void draw_x(Drawing& drawing, const Theme& theme) const;
    void draw_y(Drawing& drawing, const Theme& theme) const;

    Area frame_;
    Axis x_;
    Axis y_;
    Ticks x_ticks_;
    Ticks y_ticks_;
};

inline constexpr double colour_bar_room = 62;  ///< to the right of the picture, with its numbers

/// Colours from the bottom (0) to the top (1); values of the ticks are such shares.
void draw_colour_bar(Drawing& drawing, const Area& area, const std::string& name,
                     const Theme& theme, const std::function<Colour(double)>& colour,
                     const std::vector<Tick>& ticks);

}  // namespace stipple::plot
