// SPDX-License-Identifier: MIT
//
// A PNG picture as numbers. Grey of a colour is its luminance by the weights of ITU-R BT.709,
//
//     Y = 0.2126 R + 0.7152 G + 0.0722 B,
//
// of the samples as they stand in the file: taken as linear, no gamma is undone.
//
// Shape   any PNG: 1 to 16 bits, grey, colour or palette, opaque or not, interlaced or not.
// Cost    24 bytes a pixel while it is read, at most.
// Promise malformed files end in an Error; nothing is printed.
// Beware  colour profiles and gamma chunks are passed over.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "stipple/run.hpp"

namespace stipple {

struct PngPicture {
    std::size_t width = 0;
    std::size_t height = 0;
    std::vector<double> grey;     ///< in [0, 1], row after row from the top
    std::vector<double> opacity;  ///< the same of alpha; empty: opaque
};

inline constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

/// @throws Error(input) "SOURCE: what is wrong" for bytes that are no whole PNG picture,
/// Error(limit)
PngPicture read_png(std::string_view bytes, const std::string& source, const RunContext& run);

/// The shape of a picture without colour profile.
struct PngShape {
    std::size_t width = 0;
    std::size_t height = 0;
    int bits = 8;         ///< of a sample: 8 or 16
    bool colour = false;  ///< red, green and blue samples; else grey
    bool linear = false;  ///< says that samples are proportional to light; else no gamma is said
};

/// A keyword (1 to 79 letters of Latin-1) and what it says, in UTF-8; an iTXt chunk.
using PngText = std::pair<std::string, std::string>;

/// Such a picture with texts; samples row after row from the top, the high byte first.
/// @throws Error(limit) for a picture too large for PNG.
std::string encode_png(const PngShape& shape, std::string_view bytes,
                       std::span<const PngText> texts);

/// Samples as bytes for that; of 8 bits: at most 255.
std::string png_bytes_of_samples(std::span<const std::uint16_t> samples, int bits);

/// The picture with a text chunk behind its header; ASCII.
std::string png_with_text(std::string_view png, std::string_view keyword, std::string_view text);

/// The text of the first such chunk, if there is one.
std::optional<std::string> text_of_png(std::string_view png, std::string_view keyword);

}  // namespace stipple
