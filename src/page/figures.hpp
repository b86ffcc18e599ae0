// SPDX-License-Identifier: MIT
//
// Pictures of a report page: drawings as by `stipple plot`, embedded in light and dark colours,
// with the worst boxes over the points. The numbers of charts are included for the page's script.
//
// Shape  about ten kilobytes each, for any number of points: up to `most_dots` are drawn as marks,
//        more as a raster picture.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "page/content.hpp"
#include "plot/drawing/drawing.hpp"
#include "plot/points_picture.hpp"
#include "stipple/report.hpp"

namespace stipple::page {

inline constexpr std::size_t most_dots = 5000;
inline constexpr std::size_t most_axes = 6;  ///< maximum number of (first) axes drawn in pairs

/// Colours of a page's pictures, with a series for each set.
const plot::Theme& theme_of(bool dark);

/// The worst boxes among a set's results: star, extreme, periodic, empty.
std::vector<plot::MarkedBox> worst_boxes(const Set& set);

/// Pictures of the points with the worst boxes, by dimension: a line, the plane, space, or pairs of
/// the first axes. `number` is the set's index on the page and selects its colour.
std::vector<std::string> point_figures(const PointSet& points, const Set& set,
                                       std::size_t number = 0);

/// The power spectrum in the plane; empty if the set has none.
std::string spectrum_figure(const Set& set);

/// Averages the grid over blocks with an odd side, around the same centre, so that no side of the
/// result is longer than `most`.
Grid in_blocks(const Grid& grid, std::size_t most);

/// Charts of curves for the sets with these indices. Radial power has the 95 % band of white noise
/// if that band is the same for all sets. Pair correlation of a single set has a band of two
/// standard deviations for independent points. Curves that no set has are omitted.
std::string curve_figures(std::span<const Set> sets, std::span<const std::size_t> which);

}  // namespace stipple::page
