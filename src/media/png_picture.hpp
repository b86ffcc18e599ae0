// SPDX-License-Identifier: MIT
//
// Reading and writing PNG pictures as numbers. Colours are converted to luminance by the weights of
// ITU-R BT.709,
//
//     Y = 0.2126 R + 0.7152 G + 0.0722 B,
//
// applied to the stored samples, which are taken as linear (no gamma correction).
//
// Shape   any PNG: 1 to 16 bits; grey, colour or palette; with or without alpha and interlacing.
// Cost    at most 24 bytes a pixel while reading.
// Promise malformed files throw an Error; nothing is printed.
// Beware  colour profiles and gamma chunks are ignored.
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
    std::vector<double> grey;     ///< in [0, 1], in row-major order from the top
    std::vector<double> opacity;  ///< alpha in [0, 1], same order; empty: all pixels opaque
};

inline constexpr std::string_view png_magic = "\x89PNG\r\n\x1a\n";

/// Decodes a PNG. @throws Error(input) "SOURCE: error" if it is damaged or cut off; Error(limit)
PngPicture read_png(std::string_view bytes, const std::string& source, const RunContext& run);

/// Size and sample format of a picture without colour profile.
struct PngShape {
    std::size_t width = 0;
    std::size_t height = 0;
    int bits = 8;         ///< bits per sample: 8 or 16
    bool colour = false;  ///< samples are red, green, blue; false: grey
    bool linear = false;  ///< declares samples proportional to light; false: no gamma is stored
};

/// Keyword (1 to 79 letters of Latin-1) and UTF-8 text of an iTXt chunk.
using PngText = std::pair<std::string, std::string>;

/// Encodes a picture with texts. Samples are in row-major order from the top, high byte first.
/// @throws Error(limit) if the picture is too large for PNG
std::string encode_png(const PngShape& shape, std::string_view bytes,
                       std::span<const PngText> texts);

/// Converts samples to bytes for encode_png(); with 8 bits, samples must be at most 255.
std::string png_bytes_of_samples(std::span<const std::uint16_t> samples, int bits);

/// Inserts an ASCII text chunk after the header of a PNG.
std::string png_with_text(std::string_view png, std::string_view keyword, std::string_view text);

/// Text of the first chunk with this keyword; nullopt if there is none.
std::optional<std::string> text_of_png(std::string_view png, std::string_view keyword);

}  // namespace stipple
