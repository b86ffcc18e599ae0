// SPDX-License-Identifier: MIT
//
// Unit square onto an image of W x H pixels, or onto one of its pixels (i, j); the unit is a pixel:
//
//     point = (W xi0, H xi1)     or, with --pixel i,j,     point = (i + xi0, j + xi1)
//
// A point (x, y) lies in pixel (floor x, floor y), at the offset (x - floor x, y - floor y) from
// its corner. In a row of a distributed ray tracer, -d 5 -w disk@4,5 -w pixel@1,2, the first two
// coordinates are the position on the image, the third is the time, and the last two are on the
// lens. Without options the image is a single pixel: a pattern of offsets to be used in every
// pixel.
//
// Shape   2 unit coordinates, 2 coordinates: x in [0, W), y in [0, H).
// Units   pixels. Corners of pixels have whole coordinates, their centres halves; whether row 0 is
//         at the top is up to the user.
// Strata  xi0 and xi1 are used directly, not as 1 - xi: an N W x N H grid of strata is N x N in
//         each pixel.
// Cost    O(1) a point; about 1 ns forward (7 with --pixel), 7 ns inverse on one core.
// Promise density 1 / (W H), with --pixel 1. For xi below 1, x < W, y < H and points stay in
//         their pixel: sums are rounded towards its corner. A round trip returns the same point.

#include <cmath>

#include "core/error.hpp"
#include "warps/row_mapping.hpp"

namespace stipple::warps::pixel {
namespace {

constexpr Param<Extents> resolution{
    {.name = "resolution", .fallback = "1x1", .help = "Size of the image in pixels: WxH"}};

constexpr Param<Numbers> pixel_index{{.name = "pixel",
                                      .help = "Put all points into this pixel, counted from 0,0: "
                                              "i,j; default: spread them over the whole image"}};

constexpr std::int64_t most_pixels = std::int64_t{1} << 31;  // limit for the pixels along one side

/// Returns corner + x for x >= 0, rounded towards the corner so that x < size stays inside.
double offset_from(double corner, double x) {
    const double sum = corner + x;
    return sum - corner > x ? std::nextafter(sum, 0) : sum;
}

struct OnImage {
    double width;
    double height;

    std::array<double, 2> forward(const std::array<double, 2>& xi) const {
        return {width * xi[0], height * xi[1]};
    }
};

struct InPixel {
    double i;
    double j;

    std::array<double, 2> forward(const std::array<double, 2>& xi) const {
        return {offset_from(i, xi[0]), offset_from(j, xi[1])};
    }
};

/// Parses --pixel. @throws Error(usage) if it is not a pixel of the image
InPixel pixel_at(const std::vector<double>& at, std::int64_t width, std::int64_t height) {
    if (at.size() != 2)
        fail(ErrorKind::usage, "--pixel: expected 2 numbers, i,j; {} given", at.size());
    const auto w = static_cast<double>(width);
    const auto h = static_cast<double>(height);
    for (const double x : at)
        if (x != std::floor(x)) fail(ErrorKind::usage, "--pixel: {} is not a whole number", x);
    if (!(at[0] >= 0 && at[0] < w && at[1] >= 0 && at[1] < h))
        fail_with_hint(ErrorKind::usage, "--resolution WxH sets the size of the image",
                       "--pixel: {},{} is outside the image of {}x{} pixels, which start at 0,0",
                       at[0], at[1], width, height);
    return {at[0] + 0.0, at[1] + 0.0};
}

std::unique_ptr<Mapping> make(const WarpRequest& want) {
    const auto extents = want.options[resolution];
    if (extents.size() != 2)
        fail(ErrorKind::usage, "--resolution: expected 2 numbers, WxH; {} given", extents.size());
    for (const std::int64_t side : extents)
        if (side > most_pixels)
            fail(ErrorKind::usage, "--resolution: {} is outside [1, {}]", side, most_pixels);
    if (want.options.given(pixel_index)) {
        const InPixel pixel = pixel_at(want.options[pixel_index], extents[0], extents[1]);
        return row_mapping(box_domain({{pixel.i, pixel.j}, {pixel.i + 1, pixel.j + 1}}), pixel);
    }
    const OnImage image{static_cast<double>(extents[0]), static_cast<double>(extents[1])};
    return row_mapping(box_domain({{0, 0}, {image.width, image.height}}), image);
}

}  // namespace

Warp unit() {
    return {.name = "pixel",
            .summary = "Image of WxH pixels, or one pixel of it, in pixels: antialiasing patterns",
            .source = "Cook, Porter, Carpenter 1984, doi:10.1145/800031.808590 (application)",
            .related = {"antialiasing"},
            .strata =
                "xi1 is the position along the rows, xi2 along the columns; both are used "
                "directly; an N W x N H grid of strata puts N x N into each pixel",
            .options = Schema(resolution, pixel_index),
            .mapping = make};
}

}  // namespace stipple::warps::pixel
