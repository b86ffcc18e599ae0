// SPDX-License-Identifier: MIT
//
// Reader for PFM pictures (portable float map): text "PF" (colour) or "Pf" (grey), width, height
// and a scale, then 32-bit floats row by row from the bottom. A positive scale means big-endian, a
// negative one little-endian. Colours are converted to luminance by the weights of ITU-R BT.709, as
// for PNG (media/png_picture.hpp).
//
// Shape   width and height at least 1.
// Cost    24 bytes a pixel while reading.
// Promise malformed files throw an Error.
// Beware  the magnitude of the scale is ignored, since a density has no unit.
// Source  P. Debevec, "PFM Portable FloatMap Image Format", the format of HDR Shop.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// Values on the cells of a grid, in row-major order from y = 0.
struct PlaneValues {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<double> values = {};
};

/// Whether the bytes begin like a PFM picture.
bool looks_like_pfm(std::string_view bytes);

/// Returns the grey of each pixel; it is NaN or negative if a component of the colour is.
/// @throws Error(input) "SOURCE: error" if the bytes are not a complete PFM picture; Error(limit)
PlaneValues read_pfm(std::string_view bytes, const std::string& source, const RunContext& run);

}  // namespace stipple
