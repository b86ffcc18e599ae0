// SPDX-License-Identifier: MIT
//
// Grids as the bytes of files.
#pragma once

#include <string>

#include "core/report.hpp"

namespace stipple {

/// The grid as NumPy 1.0 bytes: float64, shape (rows, columns), row after row.
std::string npy_bytes(const Grid& power);

/// A picture of a power spectrum as PNG, 8 bits of grey, one pixel a frequency; the last row of the
/// grid is on top, so that frequencies rise to the right and upwards.
///
///     grey = 255 P / (1 + P)
///
/// White noise (P = 1) is middle grey in every picture, what a set lacks is darker, what it repeats
/// lighter; the peaks of a lattice are white. The centre, frequency zero, is left out: black.
/// @throws Error(limit) for a picture too large for PNG.
std::string png_bytes(const Grid& power);

}  // namespace stipple
