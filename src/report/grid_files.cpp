// SPDX-License-Identifier: MIT
#include "report/grid_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bytes/npy_header.hpp"
#include "core/bytes/raw_numbers.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "media/png_picture.hpp"

namespace stipple {
namespace {

/// Grey of a power, in [0, 1]; an infinite power is white.
double grey(double power, const std::string& scale) {
    if (!(power < 1e300)) return 1;
    if (scale == "linear") return std::min(power / 2, 1.0);
    if (scale == "log")
        return power > 0 ? std::clamp((10 * std::log10(power) + 20) / 40, 0.0, 1.0) : 0;
    return shade_of_power(power);
}

std::string formula(const std::string& scale) {
    if (scale == "linear") return "grey = P / 2, at most 1 (white)";
    if (scale == "log") return "grey = (10 log10 P + 20) / 40: black -20 dB, white 20 dB";
    return "grey = P / (1 + P)";
}

/// First row of the plane to be drawn.
std::size_t first_row(const Grid& power, const PowerPicture& picture) {
    const auto last = static_cast<std::int64_t>(power.columns / 2);
    if (power.rows <= power.columns) return 0;
    if (picture.slice < -last || picture.slice > last)
        fail(ErrorKind::usage, "--slice: {} is outside [{}, {}]", picture.slice, -last, last);
    return static_cast<std::size_t>(picture.slice + last) * power.columns;
}

/// Describes the pixels, for the file's text chunk.
std::string description(const Grid& power, const PowerPicture& picture, double white) {
    const auto last = static_cast<std::int64_t>(power.columns / 2);
    const bool plane = power.rows > power.columns;
    std::string text =
        picture.differences > 0
            ? fmt::format(", independent points P = 1, from -{0} to {0} mean distances",
                          format_number(picture.differences))
            : fmt::format(", white noise P = 1, at the frequencies {} to {}", -last, last);
    text +=
        fmt::format(" from left to right and from bottom to top{}; {}, from 0 to {:.0f}.",
                    picture.differences > 0 ? "" : ", one a pixel", formula(picture.scale), white);
    if (plane) text += fmt::format(" Plane fz = {}.", picture.slice);
    if (picture.differences > 0) return text + " Difference 0, in the centre, is left out.";
    return plane && picture.slice != 0 ? text : text + " Frequency 0, in the centre, is left out.";
}

}  // namespace

double shade_of_power(double power) { return power < 1e300 ? power / (1 + power) : 1; }

std::string npy_bytes(const Grid& power) {
    const std::uint64_t side = power.columns;
    std::vector<std::uint64_t> shape = {power.rows, side};
    if (power.rows == 1)
        shape = {side};
    else if (power.rows == side * side)
        shape = {side, side, side};
    std::string bytes = npy_head(shape, false);
    append_raw(bytes, power.values, false);
    return bytes;
}

std::string png_bytes(const Grid& power, const PowerPicture& picture) {
    const std::size_t first = first_row(power, picture);
    const std::size_t rows = std::min(power.rows, power.columns);
    const double white = picture.bits == 16 ? 65535 : 255;
    std::vector<std::uint16_t> pixels;
    pixels.reserve(rows * power.columns);
    for (std::size_t row = first + rows; row-- > first;)
        for (std::size_t column = 0; column < power.columns; ++column) {
            const std::size_t at = row * power.columns + column;
            const double value =
                at == power.values.size() / 2 ? 0 : grey(power.values[at], picture.scale);
            pixels.push_back(static_cast<std::uint16_t>(std::lround(white * value)));
        }
    const std::string title = picture.differences > 0 ? "Pair differences" : "Power spectrum";
    const std::vector<PngText> texts = {{"Title", title},
                                        {"Description", title + description(power, picture, white)},
                                        {"Scale", picture.scale},
                                        {"Software", "stipple"}};
    return encode_png({power.columns, rows, picture.bits},
                      png_bytes_of_samples(pixels, picture.bits), texts);
}

}  // namespace stipple
