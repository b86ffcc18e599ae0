// SPDX-License-Identifier: MIT
//
// Embeddable TrueType fonts, made from the strokes of letters (letters.hpp).
#pragma once

#include <string>
#include <string_view>

namespace stipple::plot {

inline constexpr int font_em = 1000;  ///< units per em

/// Advance width of a letter in font units.
int font_advance(char32_t letter);

/// A TrueType font without a character map: glyph 0 is a box, glyph i > 0 is letters[i - 1]. Bold
/// fonts have a broader pen.
std::string font_file(std::u32string_view letters, bool bold);

}  // namespace stipple::plot
