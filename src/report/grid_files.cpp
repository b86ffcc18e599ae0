// SPDX-License-Identifier: MIT
#include "report/grid_files.hpp"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/error.hpp"

namespace stipple {
namespace {

/// Grey of a power, [0, 255]; an infinite power is white.
png_byte grey(double power) {
    const double value = power < 1e300 ? power / (1 + power) : 1;
    return static_cast<png_byte>(std::lround(255 * value));
}

void append_little_endian(std::string& out, double value) {
    auto bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) out.push_back(static_cast<char>(bits & 255));
}

}  // namespace

std::string npy_bytes(const Grid& power) {
    std::string header =
        fmt::format("{{'descr': '<f8', 'fortran_order': False, 'shape': ({}, {}), }}", power.rows,
                    power.columns);
    // Magic, version and length are 10 bytes; the numbers begin at a multiple of 64.
    header.append((64 - (10 + header.size() + 1) % 64) % 64, ' ');
    header += '\n';
    std::string bytes("\x93NUMPY\x01\x00", 8);
    bytes.push_back(static_cast<char>(header.size() & 255));
    bytes.push_back(static_cast<char>(header.size() >> 8));
    bytes += header;
    bytes.reserve(bytes.size() + 8 * power.values.size());
    for (const double value : power.values) append_little_endian(bytes, value);
    return bytes;
}

std::string png_bytes(const Grid& power) {
    std::vector<png_byte> pixels;
    pixels.reserve(power.values.size());
    for (std::size_t row = power.rows; row-- > 0;)
        for (std::size_t column = 0; column < power.columns; ++column) {
            const bool centre = row == power.rows / 2 && column == power.columns / 2;
            pixels.push_back(centre ? png_byte{0}
                                    : grey(power.values[row * power.columns + column]));
        }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(power.columns);
    image.height = static_cast<png_uint_32>(power.rows);
    image.format = PNG_FORMAT_GRAY;
    png_alloc_size_t size = 0;
    std::string bytes;
    // The first call tells the size, the second writes.
    bool done =
        png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr) != 0;
    bytes.resize(size);
    done = done && png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0,
                                             nullptr) != 0;
    if (!done)
        fail(ErrorKind::limit, "a PNG picture of {} x {} pixels: {}", power.columns, power.rows,
             image.message);
    bytes.resize(size);
    return bytes;
}

}  // namespace stipple
