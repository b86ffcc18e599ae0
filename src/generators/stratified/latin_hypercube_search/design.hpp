// SPDX-License-Identifier: MIT
//
// Designs as whole numbers: row i is in stratum `level` of n along each coordinate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace stipple::latin_hypercube_search {

using Level = std::int32_t;

/// Levels 0, ..., points - 1, coordinate after coordinate. Rows behind the points hold levels that no
/// point has, or -1; a point that exchanges its level with one of them moves to that stratum.
struct Design {
    Design(std::size_t points_, std::size_t rows_, std::size_t dimension_)
        : points(points_), rows(rows_), dimension(dimension_), levels(rows_ * dimension_, -1) {}

    std::size_t points;
    std::size_t rows;
    std::size_t dimension;
    std::vector<Level> levels;

    [[nodiscard]] std::span<Level> along(std::size_t coordinate) {
        return std::span(levels).subspan(coordinate * rows, rows);
    }
    [[nodiscard]] std::span<const Level> along(std::size_t coordinate) const {
        return std::span(levels).subspan(coordinate * rows, rows);
    }
    bool operator==(const Design&) const = default;
};

/// A coordinate whose levels stand for fewer outcomes, parts of them that follow each other.
struct Axis {
    std::vector<Level> places = {};  ///< where each level counts as being; empty: where it is
    Level parts = 0;                 ///< outcomes; 0: the coordinate is continuous
    Level apart = 0;                 ///< squared distance of two categories; 0: places have it

    [[nodiscard]] Level place(Level level) const {
        return places.empty() || level < 0 ? level : places[static_cast<std::size_t>(level)];
    }
    /// Of two places.
    [[nodiscard]] Level square(Level a, Level b) const {
        return apart == 0 ? (a - b) * (a - b) : a == b ? 0 : apart;
    }
};

/// Of floor(level m / n), m = parts: levels count as the middle of such a part, rounded down.
Axis even_parts(std::size_t points, Level parts);

/// Of outcomes of the levels 0, 1, ...: those that follow each other and are the same are in their
/// middle. Categories are all as far apart that two points are as far from each other, in the mean of
/// squares, as along other axes; but never farther than n.
Axis parts_by(std::span<const double> outcomes, bool categories);

/// What exchanges of levels must leave as it is, and how levels count.
struct Rules {
    std::size_t fixed = 0;  ///< the first rows stay

    /// Ends of groups of consecutive rows; empty: one group. Only rows of one group exchange levels,
    /// and rows whose levels are in one coarse stratum, of `coarse` levels.
    std::vector<std::size_t> groups = {};
    Level coarse = 1;

    /// Of each coordinate; empty: all are continuous.
    std::vector<Axis> axes = {};

    /// Whether the point of this row may have these levels; empty: any. A pure function, called by
    /// many threads.
    std::function<bool(std::size_t row, std::span<const Level> levels)> feasible = {};

    /// Whether any exchange is allowed, and levels count as they are.
    [[nodiscard]] bool are_none() const {
        return fixed == 0 && groups.empty() && axes.empty() && !feasible;
    }
    [[nodiscard]] const Axis& axis(std::size_t coordinate) const {
        static const Axis continuous;
        return axes.empty() ? continuous : axes[coordinate];
    }
};

/// What a search finds.
struct Result {
    Design design;
    bool stopped = false;  ///< before the trials were used up, since the run keeps the best
    bool optimal = false;  ///< no design is better
};

}  // namespace stipple::latin_hypercube_search
