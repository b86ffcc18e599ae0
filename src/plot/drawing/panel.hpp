// SPDX-License-Identifier: MIT
//
// A frame with two axes, which maps data to positions in a drawing, and a colour bar, which
// explains the colours of a picture.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "plot/drawing/drawing.hpp"
#include "plot/drawing/ticks.hpp"

namespace stipple::plot {

inline constexpr double number_size = 12;  ///< font size of numbers on axes
inline constexpr double name_size = 13;    ///< font size of axis names

/// Cell of a relative position: one of `cells` equal cells, which have their lower edges, and the
/// last one both. nullopt outside [0, 1].
std::optional<std::size_t> cell_at(double share, std::size_t cells);

struct Axis {
    double low = 0;
    double high = 1;
    bool log = false;
    bool binary = false;                  ///< logarithmic, with numbers at powers of two
    bool whole = false;                   ///< whether numbers are only at integers
    std::vector<std::string> words = {};  ///< texts of the numbers first_word, first_word + 1, ...
    double first_word = 1;
    std::string name = {};  ///< empty: no name
    bool numbers = true;    ///< false: only tick marks, since another panel has the numbers
    bool tight = false;     ///< keeps texts of numbers within the frame, for frames side by side

    /// Ticks that fit into this length. `upright`: the axis is vertical, with numbers one above the
    /// other.
    [[nodiscard]] Ticks ticks(double length, bool upright) const;

    /// Relative position of a value between low (0) and high (1).
    [[nodiscard]] double share(double value) const;

    /// Ensures that low and high are finite, differ in the first `digits` digits, and are positive
    /// if logarithmic. If a range is too narrow, widens it and says so in the name.
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

    /// Draws faint lines behind the data.
    void draw_grid(Drawing& drawing, const Theme& theme) const;

    /// Draws the frame with numbers and names; if `closed`, on all four sides.
    void draw_axes(Drawing& drawing, const Theme& theme, bool closed) const;

    /// Space for the numbers and the name of a vertical axis; room_below(): of a horizontal one.
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

inline constexpr double colour_bar_room = 62;  ///< width of the bar with its numbers

/// Draws a bar from colour(0) at the bottom to colour(1) at the top, with ticks in [0, 1].
void draw_colour_bar(Drawing& drawing, const Area& area, const std::string& name,
                     const Theme& theme, const std::function<Colour(double)>& colour,
                     const std::vector<Tick>& ticks);

}  // namespace stipple::plot
