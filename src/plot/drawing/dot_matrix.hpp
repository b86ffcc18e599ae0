// SPDX-License-Identifier: MIT
//
// Pictures made of characters, for terminals: each Braille pattern has 2 x 4 dots.
//
// Source  The Unicode Standard, Braille Patterns: U+2800 and a bit for each of the dots 1 to 8,
//         which are numbered 1 2 3 7 in the left column, 4 5 6 8 in the right one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stipple::plot {

class DotMatrix {
  public:
    /// Creates an empty field of columns x rows characters.
    DotMatrix(std::size_t columns, std::size_t rows);

    [[nodiscard]] std::size_t width() const { return 2 * columns_; }  ///< in dots
    [[nodiscard]] std::size_t height() const { return 4 * rows_; }    ///< in dots

    /// Selects the pen (set or curve) of the following dots; a character has the colour of the dot
    /// drawn last.
    void take_pen(std::size_t pen) { pen_ = pen; }

    /// Sets the dot at a relative position in [0, 1] x [0, 1], to the right and upwards; ignores
    /// other positions.
    void set(double right, double up);

    /// Draws a straight line between two relative positions.
    void draw(double right0, double up0, double right1, double up1);

    /// The characters of a row, where row 0 is the top; if `coloured`, with terminal colour codes.
    [[nodiscard]] std::string row(std::size_t row, bool coloured = false) const;

  private:
    std::size_t columns_;
    std::size_t rows_;
    std::vector<unsigned char> letters_;
    std::vector<unsigned char> pens_;  ///< pen of each character
    std::size_t pen_ = 0;
};

/// A text in the colour of a pen; unchanged unless `coloured`.
std::string in_colour(const std::string& text, std::size_t pen, bool coloured);

/// Number of characters in a line of text, without colour codes.
std::size_t shown_width(std::string_view line);

/// Decoration of a field: names and ranges of the axes below and on the left.
struct TextFrame {
    std::string low_x = {}, high_x = {}, name_x = {};
    std::string low_y = {}, high_y = {}, name_y = {};
    std::vector<std::string> beside = {};  ///< text to the right of each row; may be empty
    bool coloured = false;
};
std::string framed(const DotMatrix& dots, const TextFrame& frame);

}  // namespace stipple::plot
