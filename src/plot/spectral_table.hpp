// SPDX-License-Identifier: MIT
//
// The tables that `periodogram --grid` and `differential --grid` save, found among what was read as
// points: nowhere negative, of an odd side of 9 or more, and alike at f and -f. Their NPY files say
// no more than that.
//
//     (m)        power of a set on the line
//     (m, m)     power in the plane; differences of pairs where the middle is 0, as no point
//                differs from itself, while the power at frequency 0 is n
//     (m, m, m)  power in space
//
// In the plane they are pictures, frequency zero in the middle:
//
//     grey = P / (1 + P),
//
// so that white noise (P = 1) is middle grey in every picture, what a set lacks is darker, what it
// repeats lighter, and no peak is cut off. Frequency zero is left out: black.
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
    Grid values;  ///< of one row on the line; in space the plane fz = 0
};

/// What the sets of one file hold; nothing if they are points.
std::optional<SpectralTable> spectral_table(std::span<const PointSet* const> sets);

/// What the axes and the colours of a table mean.
struct TableNames {
    std::string x = "frequency fx";
    std::string y = "frequency fy";
    std::string shade = "power";
    double cell = 1;  ///< side of a cell of the table, as the axes have it
    bool bar = true;  ///< says beside the table what its shades mean
};

/// @throws Error(input) for what is not square, of an odd side, and without negative numbers.
Drawing draw_spectrum(const Grid& power, const std::string& title, const std::string& subtitle,
                      const PictureStyle& style, const TableNames& names = {});

/// The power at the frequencies 1 to F of a table of one row.
Chart power_chart(const Grid& power, const std::string& title);

}  // namespace stipple::plot
