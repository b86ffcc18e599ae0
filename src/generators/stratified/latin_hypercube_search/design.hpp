// SPDX-License-Identifier: MIT
//
// Designs as integers: a row has one level, the index of its stratum, along each coordinate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "math/combinatorics/splitmix64.hpp"

namespace stipple::latin_hypercube_search {

using Level = std::int32_t;

/// Levels 0, ..., points - 1 of all rows, one coordinate after the other. Rows after the points are
/// spare: they hold unused levels, or -1. A point may exchange its level with that of a spare row.
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

/// Design close to a rank-1 lattice, with a large minimum distance. Of some random lattices with
/// n <= N <= 4 n / 3 + 1 points, the one with the largest minimum distance, as estimated for n of
/// its points, is shifted at random on the torus. The n points nearest to the middle are kept, by a
/// maximum norm with random weights. Levels are the ranks of coordinates. If N = n + 1, nothing is
/// shifted, and the point 0 is removed, which changes no distances between the others.
Design lattice_start(std::size_t points, std::size_t dimension, SplitMix64& draws);

/// Coordinate whose levels represent outcomes of a parameter; equal outcomes are consecutive.
struct Axis {
    std::vector<Level> places = {};  ///< position of a level, for distances; empty: its number
    Level parts = 0;                 ///< number of outcomes; 0: the coordinate is continuous
    Level apart = 0;                 ///< squared distance of two categories; 0: no categories

    [[nodiscard]] Level place(Level level) const {
        return places.empty() || level < 0 ? level : places[static_cast<std::size_t>(level)];
    }
    /// Squared distance of two positions.
    [[nodiscard]] Level square(Level a, Level b) const {
        return apart == 0 ? (a - b) * (a - b) : a == b ? 0 : apart;
    }
};

/// Axis with m = parts outcomes floor(x m), x the middle of the level's stratum; the position of each
/// level is the middle of the levels with its outcome, rounded down.
Axis even_parts(std::size_t points, Level parts);

/// Axis whose levels 0, 1, ... have the given outcomes: consecutive levels of one outcome have
/// their middle as position. Categories are equally far apart, at a distance that gives two points
/// the mean squared distance along other axes, but not farther than n.
Axis parts_by(std::span<const double> outcomes, bool categories);

/// Constraints on exchanges of levels, and the meaning of levels.
struct Rules {
    std::size_t fixed = 0;  ///< number of leading rows that never change

    /// Ends of groups of consecutive rows; empty: one group. Levels are exchanged only within a
    /// group, or within a coarse stratum of `coarse` consecutive levels.
    std::vector<std::size_t> groups = {};
    Level coarse = 1;

    /// One axis for each coordinate; empty: all are continuous.
    std::vector<Axis> axes = {};

    /// Whether the point of this row may have these levels; empty: always. Pure and thread-safe.
    std::function<bool(std::size_t row, std::span<const Level> levels)> feasible = {};

    /// True if there are no rules: any exchange is allowed, and levels are their own positions.
    [[nodiscard]] bool are_none() const {
        return fixed == 0 && groups.empty() && axes.empty() && !feasible;
    }
    [[nodiscard]] const Axis& axis(std::size_t coordinate) const {
        static const Axis continuous;
        return axes.empty() ? continuous : axes[coordinate];
    }
};

struct Result {
    Design design;
    bool stopped = false;  ///< a stop request ended the search early, in a run that keeps the best
    bool optimal = false;  ///< no design is better
};

}  // namespace stipple::latin_hypercube_search
