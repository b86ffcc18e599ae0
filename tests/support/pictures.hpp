// SPDX-License-Identifier: MIT
//
// Pictures and arrays as files for tests, written directly or by libpng.
#pragma once

#include <png.h>

#include <bit>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "support/temporary_file.hpp"

namespace stipple::testing {

/// An NPY file; the type in NumPy's notation ("<f8"), the shape in Python's ("(2, 3)").
inline std::string npy_of(const std::string& type, const std::string& shape,
                          std::string_view numbers, bool columns_first = false) {
    std::string head = "{'descr': '" + type +
                       "', 'fortran_order': " + (columns_first ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
    head.resize(117, ' ');
    return std::string("\x93NUMPY\x01\0v\0", 10) + head + "\n" + std::string(numbers);
}

/// An NPY file with numbers of type T, which must match `type`.
template <class T>
std::string npy_of(const std::string& type, const std::string& shape, const std::vector<T>& numbers,
                   bool columns_first = false) {
    const std::string_view bytes(reinterpret_cast<const char*>(numbers.data()),
                                 numbers.size() * sizeof(T));
    return npy_of(type, shape, bytes, columns_first);
}

/// A PFM file: kind "PF" (colour) or "Pf" (grey), rows from the bottom.
inline std::string pfm_of(const std::string& kind, std::size_t width, std::size_t height,
                          const std::vector<float>& samples, bool big_endian = false) {
    std::string bytes = kind + "\n" + std::to_string(width) + " " + std::to_string(height) + "\n" +
                        (big_endian ? "1.0" : "-1.0") + "\n";
    for (const float sample : samples) {
        const auto bits = std::bit_cast<std::uint32_t>(sample);
        for (unsigned k = 0; k < 4; ++k)
            bytes += static_cast<char>(bits >> 8 * (big_endian ? 3 - k : k) & 0xff);
    }
    return bytes;
}

/// Pixel format of a PNG.
struct PngKind {
    int colour = PNG_COLOR_TYPE_GRAY;
    int bits = 8;
    bool interlaced = false;
    std::vector<png_color> palette = {};
    std::vector<png_byte> palette_alpha = {};
};

/// Bytes of a PNG file. `samples` are row after row from the top, with the channels of a pixel
/// together; they are packed here if they have fewer than 8 bits.
inline std::string png_of(std::size_t width, std::size_t height,
                          const std::vector<std::uint16_t>& samples, const PngKind& kind = {}) {
    std::string out;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(
        png, &out,
        [](png_structp p, png_bytep bytes, std::size_t size) {
            static_cast<std::string*>(png_get_io_ptr(p))
                ->append(reinterpret_cast<const char*>(bytes), size);
        },
        [](png_structp) {});
    png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height),
                 kind.bits, kind.colour, kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 0, 0);
    if (!kind.palette.empty())
        png_set_PLTE(png, info, kind.palette.data(), static_cast<int>(kind.palette.size()));
    if (!kind.palette_alpha.empty())
        png_set_tRNS(png, info, kind.palette_alpha.data(),
                     static_cast<int>(kind.palette_alpha.size()), nullptr);
    png_write_info(png, info);
    if (kind.bits < 8) png_set_packing(png);
    std::vector<png_byte> raw;
    for (const std::uint16_t sample : samples) {
        if (kind.bits == 16) raw.push_back(static_cast<png_byte>(sample >> 8));
        raw.push_back(static_cast<png_byte>(sample & 255));
    }
    std::vector<png_bytep> rows(height);
    for (std::size_t i = 0; i < height; ++i) rows[i] = raw.data() + raw.size() / height * i;
    png_write_image(png, rows.data());
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return out;
}

}  // namespace stipple::testing
