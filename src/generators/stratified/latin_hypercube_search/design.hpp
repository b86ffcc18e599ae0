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

/// What exchanges of levels must leave as it is, and how levels count.
struct Rules {
    std::size_t fixed = 0;  ///< the first rows stay

    /// Ends of groups of consecutive rows; empty: one group. Only rows of one group exchange levels,
    /// and rows whose levels are in one coarse stratum, of `coarse` levels.
    std::vector<std::size_t> groups = {};
    Level coarse = 1;

    /// Of each coordinate, the categories or numeric levels m that floor(level m / n) stands for; 0:
    /// none, the coordinate is continuous. Empty: all are continuous.
    std::vector<Level> parts = {};

    /// Whether a point may have these levels; empty: any. A pure function, called by many threads.
    std::function<bool(std::span<const Level>)> feasible = {};
};

/// Where along a coordinate of m parts a level counts as being: in the middle of the levels of its
/// part, rounded down.
inline Level place_of(Level level, Level parts, std::size_t points) {
    if (parts == 0 || level < 0) return level;
    const auto n = static_cast<std::int64_t>(points);
    const std::int64_t part = level * std::int64_t{parts} / n;
    return static_cast<Level>((n * (2 * part + 1) - parts) / (2 * std::int64_t{parts}));
}

inline Level parts_of(const Rules& rules, std::size_t coordinate) {
    return rules.parts.empty() ? 0 : rules.parts[coordinate];
}

}  // namespace stipple::latin_hypercube_search
