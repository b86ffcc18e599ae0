// SPDX-License-Identifier: MIT
//
// A PFM picture (portable float map) as numbers: text "PF" (colour) or "Pf" (grey), width, height
// and a scale, then 32-bit floats row after row from the bottom, with the high byte first where the
// scale is above 0 and last where it is below. Grey of a colour is its luminance by the weights of
// ITU-R BT.709, as for PNG (media/png_picture.hpp).
//
// Shape   width and height at least 1.
// Cost    24 bytes a pixel while it is read.
// Promise malformed files end in an Error.
// Beware  the scale's size is passed over, since a density has no unit.
// Source  P. Debevec, "PFM Portable FloatMap Image Format", the format of HDR Shop.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

/// Values on the cells of a grid, row after row from y = 0.
struct PlaneValues {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<double> values = {};
};

/// Whether the bytes begin as a PFM picture does.
bool looks_like_pfm(std::string_view bytes);

/// The grey of each pixel as it is, NaN included.
/// @throws Error(input) "SOURCE: what is wrong" for bytes that are no whole PFM picture,
/// Error(limit)
PlaneValues read_pfm(std::string_view bytes, const std::string& source, const RunContext& run);

}  // namespace stipple
