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
#pragma once

#include <optional>
#include <span>

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

/// Whether a square table can be the power at frequencies -F to F.
bool looks_like_power(const Grid& grid);

/// The power at the frequencies 1 to F of a table of one row.
Chart power_chart(const Grid& power, const std::string& title);

}  // namespace stipple::plot
