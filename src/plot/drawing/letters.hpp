// SPDX-License-Identifier: MIT
//
// Letters of pictures: every letter as strokes of a pen, for pictures that are drawn without a font.
//
// Units   an em is 28 units of the glyph's grid; y upward from the base line, capitals 20 high.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "plot/drawing/drawing.hpp"

namespace stipple::plot {

inline constexpr double em_units = 28;

/// Raised letters are small ones, higher up.
inline constexpr double raised_size = 0.6;
inline constexpr double raised_by = 8.5;

/// The plain letter of a raised one: 2 of ².
std::optional<char32_t> lowered(char32_t letter);

/// Units from a letter's origin to the next one's: those of Helvetica.
double advance_of(char32_t letter);

/// The letter's strokes; a box for one that is not known.
std::vector<std::vector<Position>> strokes_of(char32_t letter);

/// Width of a line of text of that size.
double text_width(std::string_view text, double size);

/// The text in lines that are no wider: broken at blanks and behind other signs or, within longer
/// words, anywhere.
std::vector<std::string> wrapped(std::string_view text, double size, double width);

/// A label's text as its lines, the last of which is where the label is; upward ones to the left of each
/// other.
void add_lines(Drawing& drawing, const Label& label, const std::vector<std::string>& lines,
               double leading);

}  // namespace stipple::plot
