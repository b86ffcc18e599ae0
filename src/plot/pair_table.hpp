// SPDX-License-Identifier: MIT
//
// A heat map of one number for each pair of coordinates, such as the discrepancy of the projections
// to two of them: a square at (i, j), i < j, with its number if there is room for it.
//
// Shape   d (d - 1) / 2 numbers in the order (1,2), (1,3), (2,3), (1,4), ...
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "plot/chart.hpp"
#include "report/document.hpp"

namespace stipple::plot {

struct PairTable {
    std::string key = {};     ///< key of the table's list in the report
    std::string source = {};  ///< source of the points
    std::string title = {};
    std::string subtitle = {};
    std::size_t dimension = 0;
    std::vector<double> values = {};

    /// The number for the pair of coordinates i < j, where i and j count from 0.
    [[nodiscard]] double at(std::size_t i, std::size_t j) const {
        return values[j * (j - 1) / 2 + i];
    }
    /// The largest of the finite numbers, or 0 if none is finite.
    [[nodiscard]] double largest() const;
};

/// The table in a report, found by its analyzer's record; nullopt if the analyzer has none.
std::optional<PairTable> pair_table(const Measurement& measurement);

/// @param largest number at the upper end of the colours, which begin at 0
/// @param bar draws the colour bar
Drawing draw_pair_table(const PairTable& table, double largest, bool bar,
                        const PictureStyle& style);

}  // namespace stipple::plot
