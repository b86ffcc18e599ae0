// SPDX-License-Identifier: MIT
//
// Pictures of a report page: those that `stipple plot` draws, as elements that take the colours of
// a light or a dark page, with the worst boxes laid over the points, and the numbers of charts beside
// them for the page's script to show.
//
// Shape  some ten kilobytes each, however many points: up to `most_dots` are marks, more are
//        the pixels of a raster.
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
inline constexpr std::size_t most_axes = 6;  ///< of which pairs are drawn

/// Colours of a page's pictures; as many series as a page has sets.
const plot::Theme& theme_of(bool dark);

/// The worst boxes that a set's measures found: star, extreme, periodic, empty.
std::vector<plot::MarkedBox> worst_boxes(const Set& set);

/// Where the points are and the worst boxes, by dimension: a line, the plane, space, and pairs of
/// the first axes. `number` is the set's number in the page and picks its colour.
std::vector<std::string> point_figures(const PointSet& points, const Set& set,
                                       std::size_t number = 0);

/// The power spectrum in the plane; empty where the set has none.
std::string spectrum_figure(const Set& set);

/// The grid in blocks of an odd number of rows and columns, so that no side is longer than
/// `most`, about the same centre; each value is the mean of its block.
Grid in_blocks(const Grid& grid, std::size_t most);

/// Radial power of the sets of these numbers, with the 95 % band of white noise where it is the
/// same for all, and pair correlation, with the band of two standard deviations of independent
/// points for one set; less what no set has.
std::string curve_figures(std::span<const Set> sets, std::span<const std::size_t> which);

}  // namespace stipple::page
