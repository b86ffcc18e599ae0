// SPDX-License-Identifier: MIT
//
// Base of all searches for the worst box: the grid of coordinates at which boxes begin and end, and
// the worst box found so far, compared without rounding. The excess of a box is its signed
// discrepancy times n, the number of points. With volume V and P points inside, it is
//
//     open box:  scale V - weight P        closed box:  weight P - scale V
//
// where scale is n and weight is 1 for discrepancies. The search for the largest empty box uses
// only open boxes, scale 1 and a weight that excludes boxes with points. An open box contains no
// points on its faces, except on faces of an anchored box at 0; a closed box contains all points on
// its faces. Half-open boxes [0,c) have the same supremum as anchored open and closed boxes if no
// point has a coordinate 1. A point with a coordinate 1 is in no half-open box, since c is at most
// 1. Such a point is moved to (1,...,1): of the anchored boxes, only the closed unit cube contains
// it, and this cube never has too many points.
//
// Source  H. Niederreiter, "Discrepancy and convex programming", Ann. Mat. Pura Appl. 93 (1972)
//         89-97, doi:10.1007/BF02412017 (the finite grid).
#pragma once

#include <boost/multiprecision/cpp_int.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point_set.hpp"
#include "stipple/run.hpp"

namespace stipple::discrepancy {

using Integer = boost::multiprecision::cpp_int;

/// x * 2^places, for x in [0, 1] with at most `places` binary digits.
Integer scaled(double x, unsigned places);

enum class Side { open, closed };

/// The boxes to search.
enum class Family {
    anchored,   ///< from 0: [0,c) and [0,c]
    half_open,  ///< [0,c) and limits of such boxes
    cube,       ///< all axis-parallel boxes
    torus,      ///< boxes of the torus, where 1 is 0: a side may wrap from 1 to 0
};

enum class Measure { discrepancy, emptiness };

/// Interval of a box on one axis; its ends are ranks, indices into BoxGrid::values. Anchored boxes
/// begin at 0 and ignore `lower`.
struct Interval {
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;

    /// True if the interval contains 1 = 0 on the torus. An open interval with equal ends is the
    /// circle without that point.
    [[nodiscard]] bool wraps(Side side) const {
        return side == Side::open ? lower >= upper : lower > upper;
    }
};

/// A set of ranks on one axis: `size` ranks from `first` on, or all others if `complement`.
struct RankSet {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
    bool complement = false;

    [[nodiscard]] bool contains(std::uint32_t rank) const {
        return (rank - first < size) != complement;
    }
};

/// Ranks inside an interval: those between its ends or, if it wraps, all except those.
RankSet ranks_between(Interval ends, Side side, bool wraps);

/// Distinct coordinates on each axis, and the ranks of the points' coordinates among them. The
/// distinct coordinates include 1, except on the torus, and 0 for boxes of the cube.
struct BoxGrid {
    std::size_t count = 0;
    Family family = Family::anchored;
    Measure measure = Measure::discrepancy;
    std::uint64_t scale = 1;
    std::uint64_t weight = 1;
    std::vector<std::vector<double>> values;        ///< by axis: distinct coordinates, ascending
    std::vector<std::vector<std::uint32_t>> ranks;  ///< by axis: rank of every point
    /// By axis: points sorted by their coordinate; empty if boxes are anchored.
    std::vector<std::vector<std::uint32_t>> order;
    std::vector<unsigned> digits;  ///< by axis: maximum number of binary digits of a coordinate
    unsigned all_digits = 0;       ///< sum of `digits`

    [[nodiscard]] std::size_t dimension() const { return values.size(); }
    [[nodiscard]] bool anchored() const { return family <= Family::half_open; }
    [[nodiscard]] bool torus() const { return family == Family::torus; }

    /// Bound on the rounding error of an excess computed in doubles; 0 if it is exact.
    [[nodiscard]] double rounding() const;
    [[nodiscard]] double length(std::size_t axis, Interval interval, Side side) const;

    /// Length of an interval times 2^digits[axis], exact.
    [[nodiscard]] Integer exact_length(std::size_t axis, Interval interval, Side side) const;

    /// Ranks of the coordinates inside an interval.
    [[nodiscard]] RankSet inside(Interval interval, Side side) const;
};

/// Bytes of a grid per point and axis.
constexpr std::size_t axis_bytes(bool anchored) {
    return sizeof(double) + (anchored ? 1 : 2) * sizeof(std::uint32_t);
}

BoxGrid box_grid(const PointSet& points, Family family, const RunContext& run,
                 Measure measure = Measure::discrepancy);

/// Number of points at each rank of an axis.
std::vector<std::uint32_t> points_at(const BoxGrid& grid, std::size_t axis);

struct GridBox {
    Side side = Side::closed;
    std::vector<Interval> axes;
};

/// Worst box offered so far; the first of equally bad ones. Before any offer its value is 0, and
/// box() has no axes or, if boxes are anchored, is the closed cube.
class WorstBox {
  public:
    /// Keeps a reference to the grid.
    explicit WorstBox(const BoxGrid& grid);

    /// Replaces the worst box by `box`, with `points` points inside, if it is worse. Ignores a box
    /// without axes.
    void offer(const GridBox& box, std::uint64_t points);

    /// Offers the box after counting the points in it.
    void offer(const GridBox& box);

    /// Offers an anchored box, given the ranks of its upper corner.
    void offer(Side side, std::span<const std::uint32_t> corner, std::uint64_t points);

    /// Replaces the worst box by the other's if that is worse.
    void offer(const WorstBox& other);

    /// Discrepancy or volume of the box: excess divided by scale, rounded to the nearest double.
    [[nodiscard]] double value() const { return value_; }

    /// A box whose value, computed in doubles, is below this threshold cannot be worse.
    [[nodiscard]] double threshold() const { return value_ - rounding_; }

    /// Excess of the box, rounded to the nearest double.
    [[nodiscard]] double excess() const { return excess_; }

    /// Excess of the box times 2^all_digits, exact.
    [[nodiscard]] const Integer& exact_excess() const { return exact_; }

    [[nodiscard]] const GridBox& box() const { return box_; }
    [[nodiscard]] bool closed() const { return box_.side == Side::closed; }
    [[nodiscard]] std::uint64_t points() const { return points_; }

    /// Lower or upper corner. @param end &Interval::lower or &Interval::upper
    [[nodiscard]] std::vector<double> corner(std::uint32_t Interval::*end) const;

    /// Volume of the box, rounded to the nearest double.
    [[nodiscard]] double volume() const;

  private:
    [[nodiscard]] double approximate(Side side, double volume, std::uint64_t points) const;
    [[nodiscard]] Integer exact_volume(const GridBox& box) const;

    const BoxGrid* grid_;
    double rounding_;
    Integer exact_ = 0;
    double value_ = 0;
    double excess_ = 0;
    GridBox box_;
    std::uint64_t points_;
};

}  // namespace stipple::discrepancy
