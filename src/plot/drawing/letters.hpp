// SPDX-License-Identifier: MIT
//
// Letters as pen strokes, for PNG pictures and for the fonts in PDF files.
//
// Units   an em is 28 units of the glyph grid; y upwards from the baseline; capitals are 20 high.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

inline constexpr double em_units = 28;

/// Superscript letters are smaller and raised.
inline constexpr double raised_size = 0.6;
inline constexpr double raised_by = 8.5;

/// The plain letter for a superscript: 2 for ²; nullopt if the letter is not a superscript.
std::optional<char32_t> lowered(char32_t letter);

/// Advance of a letter in grid units, as in Helvetica.
double advance_of(char32_t letter);

/// Strokes of a letter, as polylines in grid units; a box for unknown letters.
std::vector<std::vector<Position>> strokes_of(char32_t letter);

/// Width of a line of text at this font size.
double text_width(std::string_view text, double size);

/// Space that a label takes in DejaVu Sans, a wide font by which viewers of SVG replace Helvetica.
Area room_of(const Label& label);

/// Wraps text to lines of at most this width, also in wider fonts, after blanks and signs such as -
/// and /, not within decimal numbers. Longer words are broken anywhere or, if `shorten`, end with
/// an ellipsis.
std::vector<std::string> wrapped(std::string_view text, double size, double width,
                                 bool bold = false, bool shorten = false);

/// Adds a label with several lines, the last of them at the label's position; the other lines are
/// above or, if upward, to the left.
void add_lines(Drawing& drawing, const Label& label, const std::vector<std::string>& lines,
               double leading);

}  // namespace stipple::plot
