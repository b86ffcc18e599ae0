// SPDX-License-Identifier: MIT
//
// What all searches for the worst box share: the grid of coordinates at which boxes begin and end,
// and the worst box found so far, compared without rounding. A box of volume V with P points inside
// has the excess, its signed discrepancy times n,
//
//     open box:  scale V - weight P        closed box:  weight P - scale V
//
// with scale n and weight 1 for discrepancies; for the largest empty box open boxes alone, scale 1
// and a weight that forbids any point. An open box has no points on its faces, but for faces of an
// anchored box at 0, a closed one has all of them. Half-open boxes [0,c) alone have the same
// supremum as anchored open and closed ones, but for points with a coordinate 1, which are in none
// of them, as c is at most 1. The closed box up to (1,...,1), which is never too full, is the one
// place where such a point does no harm, so it is moved there.
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

/// x * 2^places for an x in [0, 1] that has no more binary places than that.
Integer scaled(double x, unsigned places);

enum class Side { open, closed };

/// Which boxes there are.
enum class Family {
    anchored,   ///< at 0, [0,c) and [0,c]
    half_open,  ///< [0,c) and their limits
    cube,       ///< all axis-parallel boxes
    torus,      ///< the same where 1 is 0: a side may wrap, from its lower end to 1 and on from 0
};

enum class Measure { discrepancy, emptiness };

/// Ranks on one axis where a box begins and ends. An anchored box begins at 0, whatever `lower` is.
struct Interval {
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;

    /// Whether it goes across 1 (torus): an open one whose ends meet is the circle less a point.
    [[nodiscard]] bool wraps(Side side) const {
        return side == Side::open ? lower >= upper : lower > upper;
    }
};

/// The ranks inside an interval: `size` of them from `first` on, or all but those.
struct RankSet {
    std::uint32_t first = 0;
    std::uint32_t size = 0;
    bool complement = false;

    [[nodiscard]] bool contains(std::uint32_t rank) const {
        return (rank - first < size) != complement;
    }
};

/// Those between two ends, or if it wraps, above the lower or below the upper one.
RankSet ranks_between(Interval ends, Side side, bool wraps);

/// The distinct coordinates on each axis (with 1, and for boxes of the cube with 0), and the points
/// as ranks among them.
struct BoxGrid {
    std::size_t count = 0;
    Family family = Family::anchored;
    Measure measure = Measure::discrepancy;
    std::uint64_t scale = 1;
    std::uint64_t weight = 1;
    std::vector<std::vector<double>> values;        ///< of each axis, ascending
    std::vector<std::vector<std::uint32_t>> ranks;  ///< of each axis: rank of every point
    std::vector<std::vector<std::uint32_t>> order;  ///< the points, ascending; not if anchored
    std::vector<unsigned> digits;                   ///< binary ones of each axis's coordinates
    unsigned all_digits = 0;                        ///< sum of these

    [[nodiscard]] std::size_t dimension() const { return values.size(); }
    [[nodiscard]] bool anchored() const { return family <= Family::half_open; }
    [[nodiscard]] bool torus() const { return family == Family::torus; }

    /// What an excess may be off by when it is worked out in doubles; 0 where that is exact.
    [[nodiscard]] double rounding() const;

    /// Length of an interval, as a double.
    [[nodiscard]] double length(std::size_t axis, Interval interval, Side side) const;

    /// The same times 2^digits of the axis, exact.
    [[nodiscard]] Integer exact_length(std::size_t axis, Interval interval, Side side) const;

    /// Ranks inside an interval.
    [[nodiscard]] RankSet inside(Interval interval, Side side) const;
};

/// Bytes that a grid takes for each point and axis.
constexpr std::size_t axis_bytes(bool anchored) {
    return sizeof(double) + (anchored ? 1 : 2) * sizeof(std::uint32_t);
}

BoxGrid box_grid(const PointSet& points, Family family, const RunContext& run,
                 Measure measure = Measure::discrepancy);

/// Points of each rank on an axis.
std::vector<std::uint32_t> points_at(const BoxGrid& grid, std::size_t axis);

struct GridBox {
    Side side = Side::closed;
    std::vector<Interval> axes;
};

/// The worst box offered so far; of boxes that are equally bad, the first. Before any offer: none,
/// or if boxes are anchored the cube, closed; the value is 0.
class WorstBox {
  public:
    /// Keeps a reference to the grid.
    explicit WorstBox(const BoxGrid& grid);

    /// Takes the box, with the number of points in it, if it is worse than the one before; nothing
    /// where it is none.
    void offer(const GridBox& box, std::uint64_t points);

    /// Counts the points in the box first.
    void offer(const GridBox& box);

    /// The same for an anchored box, given the ranks of its upper corner.
    void offer(Side side, std::span<const std::uint32_t> corner, std::uint64_t points);

    /// Takes the other's box if it is worse.
    void offer(const WorstBox& other);

    /// Discrepancy or volume of the box: its excess over the scale, rounded to the nearest double.
    [[nodiscard]] double value() const { return value_; }

    /// A box whose value comes out smaller than this in doubles is not worse.
    [[nodiscard]] double threshold() const { return value_ - rounding_; }

    /// Its excess, rounded to the nearest double.
    [[nodiscard]] double excess() const { return excess_; }

    /// Its excess times 2^all_digits, exact.
    [[nodiscard]] const Integer& exact_excess() const { return exact_; }

    [[nodiscard]] const GridBox& box() const { return box_; }
    [[nodiscard]] bool closed() const { return box_.side == Side::closed; }
    [[nodiscard]] std::uint64_t points() const { return points_; }

    /// &Interval::lower or &Interval::upper.
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
