// SPDX-License-Identifier: MIT
//
// Grids as NPY and PNG files.
#pragma once

#include <cstdint>
#include <string>

#include "stipple/report.hpp"

namespace stipple {

/// The grid as NumPy 1.0 bytes: float64, shape (rows, columns), row-major. A grid with one row has
/// shape (columns), one with columns^2 rows (columns, columns, columns).
std::string npy_bytes(const Grid& power);

/// Style of a picture of a power spectrum or of pair differences.
struct PowerPicture {
    std::string scale = "ratio";  ///< scale of grey: ratio, linear or log
    int bits = 8;                 ///< bits per pixel: 8 or 16
    std::int64_t slice = 0;       ///< for a cube: frequency f_2 of the plane to draw
    double differences = 0;  ///< for pair differences: half-width, in mean distances; 0: spectrum
};

/// A power spectrum as a grey PNG picture, one pixel per frequency. The last row of the grid is at
/// the top, so frequencies increase to the right and upwards. The grey, from 0 to 1, is
///
///     ratio   P / (1 + P)
///     linear  P / 2, no more than 1
///     log     (10 log10 P + 20) / 40, from -20 dB to 20 dB
///
/// White noise (P = 1) is medium grey on every scale; frequencies with less power are darker, those
/// with more lighter, and the peaks of a lattice white. The centre, frequency zero, is black. A
/// text chunk in the file names the scale.
/// @throws Error(limit) if the picture is too large for PNG; Error(usage) for a slice out of range
std::string png_bytes(const Grid& power, const PowerPicture& picture = {});

/// P / (1 + P), the shade of a power on the scale "ratio"; 1 if P is infinite.
double shade_of_power(double power);

}  // namespace stipple
