// SPDX-License-Identifier: MIT
//
// Pictures of a report page: those that `stipple plot` draws, as elements that take the colours of
// a light or a dark page, with the worst boxes laid over the points.
//
// Shape  some ten kilobytes each, however many points: up to `most_page_dots` are marks, more are
//        the pixels of a raster.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/point_set.hpp"
#include "page/page_content.hpp"
#include "plot/theme.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple {

inline constexpr std::size_t most_page_dots = 5000;
inline constexpr std::size_t most_page_axes = 6;  ///< of which pairs are drawn

/// Colours of a page's pictures; as many series as a page has sets.
const Theme& page_theme(bool dark);

/// A box that a measure found, in shares of the set's box: a lower corner above the upper one
/// means that it goes on from 1 to 0.
struct PageBox {
    std::string kind;   ///< class of the style sheet: star, extreme, periodic, empty
    std::string label;  ///< what it is, in words
    std::vector<double> low;
    std::vector<double> high;
    bool closed = true;  ///< drawn with a solid line; else dashed
};

/// The worst boxes that a set's measures found.
std::vector<PageBox> worst_boxes(const PageSet& set);

/// The parts of [low, high] on an axis of the torus: one, or two for what goes on from 1 to 0.
std::vector<std::pair<double, double>> parts_of_range(double low, double high);

/// Where the points are and the worst boxes, by dimension: a line, the plane, space, and pairs of
/// the first axes. `number` is the set's number in the page and picks its colour.
std::vector<std::string> point_figures(const PointSet& points, const PageSet& set,
                                       std::size_t number = 0);

/// The power spectrum in the plane; empty where the set has none.
std::string spectrum_figure(const PageSet& set);

/// The grid in blocks of an odd number of rows and columns, so that no side is longer than
/// `most`, about the same centre; each value is the mean of its block.
Grid in_blocks(const Grid& grid, std::size_t most);

}  // namespace stipple
