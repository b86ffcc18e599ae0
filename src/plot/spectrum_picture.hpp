// SPDX-License-Identifier: MIT
//
// The power spectrum in the plane, frequency zero in the middle:
//
//     grey = P / (1 + P),
//
// so that white noise (P = 1) is middle grey in every picture, what a set lacks is darker, what it
// repeats lighter, and no peak is cut off. Frequency zero is left out: black.
#pragma once

#include "plot/chart.hpp"
#include "stipple/report.hpp"

namespace stipple::plot {

/// What the axes and the colours of a table mean.
struct TableNames {
    std::string x = "frequency fx";
    std::string y = "frequency fy";
    std::string shade = "power";
    double cell = 1;  ///< side of a cell of the table, as the axes have it
};

/// @throws Error(input) for what is not square, of an odd side, and without negative numbers.
Drawing draw_spectrum(const Grid& power, const std::string& title, const std::string& subtitle,
                      const PictureStyle& style, const TableNames& names = {});

}  // namespace stipple::plot
