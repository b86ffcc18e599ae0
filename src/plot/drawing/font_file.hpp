// SPDX-License-Identifier: MIT
//
// A font that files can carry: outlines of the strokes that letters have (letters.hpp), as TrueType.
#pragma once

#include <string>
#include <string_view>

namespace stipple::plot {

inline constexpr int font_em = 1000;  ///< units of a font's grid

/// The advance of a letter in such units.
int font_advance(char32_t letter);

/// A font without a table of characters: glyph 0 is a box, glyph i is letter i - 1. Bold ones have a
/// broader pen.
std::string font_file(std::u32string_view letters, bool bold);

}  // namespace stipple::plot
