// SPDX-License-Identifier: MIT
//
// Pictures of characters, for terminals: a Braille pattern has 2 x 4 dots.
//
// Source  The Unicode Standard, Braille Patterns: U+2800 and a bit for each of the dots 1 to 8,
//         which stand 1 2 3 7 in the left column, 4 5 6 8 in the right one.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stipple::plot {

class DotMatrix {
  public:
    /// A field of so many characters.
    DotMatrix(std::size_t columns, std::size_t rows);

    [[nodiscard]] std::size_t width() const { return 2 * columns_; }  ///< dots
    [[nodiscard]] std::size_t height() const { return 4 * rows_; }    ///< dots

    /// Dots that follow are of this set or curve; a letter has the colour of its last dot.
    void take_pen(std::size_t pen) { pen_ = pen; }

    /// Sets the dot at shares of the field, to the right and upward; nothing outside of [0, 1].
    void set(double right, double up);

    /// Dots on the straight way between two places.
    void draw(double right0, double up0, double right1, double up1);

    /// The characters of a row, from the top; coloured: with a terminal's codes for colours.
    [[nodiscard]] std::string row(std::size_t row, bool coloured = false) const;

  private:
    std::size_t columns_;
    std::size_t rows_;
    std::vector<unsigned char> letters_;
    std::vector<unsigned char> pens_;  ///< of each letter
    std::size_t pen_ = 0;
};

/// A text in the colour of a pen, on terminals that have colours.
std::string in_colour(const std::string& text, std::size_t pen, bool coloured);

/// Letters that a line of text takes, less codes for colours.
std::size_t shown_width(std::string_view line);

/// The field in a frame, with a title above, and what the axes range over below and beside.
struct TextFrame {
    std::string title = {};
    std::string low_x = {}, high_x = {}, name_x = {};
    std::string low_y = {}, high_y = {}, name_y = {};
    std::vector<std::string> beside = {};  ///< on the right of each row; empty: nothing
    bool coloured = false;
};
std::string framed(const DotMatrix& dots, const TextFrame& frame);

}  // namespace stipple::plot
