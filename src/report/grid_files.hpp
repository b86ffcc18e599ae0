// SPDX-License-Identifier: MIT
//
// Grids as the bytes of files.
#pragma once

#include <cstdint>
#include <string>

#include "stipple/report.hpp"

namespace stipple {

/// The grid as NumPy 1.0 bytes: float64, shape (rows, columns), row after row; of one row
/// (columns), and of columns^2 rows (columns, columns, columns).
std::string npy_bytes(const Grid& power);

/// How a power spectrum is drawn, or an image of pair differences.
struct PowerPicture {
    std::string scale = "ratio";  ///< or "linear", "log"
    int bits = 8;                 ///< or 16
    std::int64_t slice = 0;       ///< of a cube: the frequency f_2 of the plane
    double differences = 0;       ///< up to so many mean distances; 0: it is a spectrum
};

/// A picture of a power spectrum as PNG in grey, one pixel a frequency; the last row of the grid is
/// on top, so that frequencies rise to the right and upwards. Grey is, from 0 to 1,
///
///     ratio   P / (1 + P)
///     linear  P / 2, no more than 1
///     log     (10 log10 P + 20) / 40, from -20 dB to 20 dB
///
/// White noise (P = 1) is middle grey in every picture, what a set lacks is darker, what it repeats
/// lighter; the peaks of a lattice are white. The centre, frequency zero, is left out: black. The
/// file's text tells the scale.
/// @throws Error(limit) for a picture too large for PNG; Error(usage) for a slice that is not
/// there.
std::string png_bytes(const Grid& power, const PowerPicture& picture = {});

/// P / (1 + P), the shade of a power on the scale "ratio"; 1 where it is infinite.
double shade_of_power(double power);

}  // namespace stipple
