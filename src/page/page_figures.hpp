// SPDX-License-Identifier: MIT
//
// Pictures of a report page: elements of HTML that take their colours from the page's style sheet,
// light or dark.
//
// Shape  some ten kilobytes each, however many points: up to `most_page_dots` are marks, more are
//        the pixels of a grey picture.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/point_set.hpp"
#include "core/report.hpp"
#include "core/run_context.hpp"
#include "page/page_content.hpp"

namespace stipple {

inline constexpr std::size_t most_page_dots = 5000;
inline constexpr std::size_t most_page_axes = 6;  ///< of which pairs are drawn

/// A box that is drawn into the picture of points: of the unit cube, or of the one that the set's
/// box is mapped to, where a lower corner above the
/// upper one means that it goes on from 1 to 0.
struct MarkedBox {
    std::string kind;   ///< class of the style sheet: star, extreme, periodic, empty
    std::string label;  ///< what it is, in words
    std::vector<double> low;
    std::vector<double> high;
    bool closed = true;  ///< drawn with a whole line; else dashed
};

/// The worst boxes that a set's measures found.
std::vector<MarkedBox> worst_boxes(const PageSet& set);

/// The parts of [low, high] on an axis of the torus: one, or two for what goes on from 1 to 0.
std::vector<std::pair<double, double>> parts_of_range(double low, double high);

/// Where the points are and the worst boxes, by dimension: a line, the plane, space, and pairs of
/// the first axes.
std::vector<std::string> point_figures(const PointSet& points, const PageSet& set);

/// The power spectrum in the plane as a grey picture; empty where the set has none.
std::string spectrum_figure(const PageSet& set);

/// The grid in blocks of an odd number of rows and columns, so that none side is longer than
/// `most`, about the same centre; each value is the mean of its block.
Grid in_blocks(const Grid& grid, std::size_t most);

}  // namespace stipple
