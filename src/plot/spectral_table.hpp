// SPDX-License-Identifier: MIT
//
// Recognizes tables saved by `periodogram --grid` and `differential --grid`, although their NPY
// files look like points: their sides have the same odd length m >= 9, and their values are not
// negative, and equal at f and -f.
//
//     (m)        power of a set on the line
//     (m, m)     power in the plane; differences of pairs if the middle is 0, since distinct points
//                do not differ by 0, whereas the power at frequency 0 is n
//     (m, m, m)  power in space
//
// Tables of the plane are drawn as pictures with frequency zero in the middle:
//
//     grey = P / (1 + P)
//
// White noise (P = 1) is medium grey in every picture. Frequencies with less power are darker,
// those with more are lighter, and no peak is clipped. Frequency zero is black.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "core/point_set.hpp"
#include "plot/chart.hpp"
#include "stipple/report.hpp"

namespace stipple::plot {

struct SpectralTable {
    std::size_t dimension = 2;
    bool differences = false;
    Grid values;  ///< one row if dimension is 1; the plane of frequencies fz = 0 if it is 3
};

/// Interprets the sets of one file as a spectral table; nullopt if they are ordinary points.
std::optional<SpectralTable> spectral_table(std::span<const PointSet* const> sets);

/// Names of a table's axes and values.
struct TableNames {
    std::string x = "frequency fx";
    std::string y = "frequency fy";
    std::string shade = "power";
    double cell = 1;  ///< side of a cell in units of the axes
    bool bar = true;  ///< draws a bar that explains the shades
};

/// Draws a table of the plane. @throws Error(input) unless the table is square with an odd side,
/// and no number is negative or NaN
Drawing draw_spectrum(const Grid& power, const std::string& title, const std::string& subtitle,
                      const PictureStyle& style, const TableNames& names = {});

/// Chart of the power at positive frequencies, from a table with one row.
Chart power_chart(const Grid& power, const std::string& title);

}  // namespace stipple::plot
