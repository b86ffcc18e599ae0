// SPDX-License-Identifier: MIT
//
// What the searches for the worst of all axis-parallel boxes share: the grid of coordinates at
// which boxes begin and end, on the cube or on the torus, and the worst box found so far, compared
// without rounding. A box is worth
//
//     open:    scale vol - weight #{points inside}        closed:    the negative of that,
//
// with scale n and weight 1 for discrepancies, and open boxes, scale 1 and a weight that forbids
// any point, for the largest empty box. An open box has no points on its faces, a closed one has
// all of them. On the torus 1 is 0, and a side may wrap: from its lower end up to 1 and on from 0
// to its upper end, which is below the lower one.
//
// Source  H. Niederreiter, "Discrepancy and convex programming", Ann. Mat. Pura Appl. 93 (1972)
//         89-97, doi:10.1007/BF02412017 (the finite grid).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/point_set.hpp"
#include "core/run_context.hpp"
#include "math/functions/dyadic.hpp"

namespace stipple::analyzers::extreme {

enum class Side { open, closed };
enum class Space { cube, torus };
enum class Measure { discrepancy, emptiness };

/// The distinct coordinates on each axis (on the cube 0 and 1 too), and the points as places among
/// them.
struct BoxGrid {
    std::size_t count = 0;
    Space space = Space::cube;
    Measure measure = Measure::discrepancy;
    std::uint64_t scale = 1;
    std::uint64_t weight = 1;
    std::vector<std::vector<double>> values;        ///< of each axis, ascending
    std::vector<std::vector<std::uint32_t>> ranks;  ///< of each axis: place of every point
    std::vector<std::vector<std::uint32_t>> order;  ///< of each axis: the points, ascending
    std::vector<unsigned> places;                   ///< binary places of each axis's coordinates
    unsigned all_places = 0;                        ///< sum of these

    [[nodiscard]] std::size_t dimension() const { return values.size(); }

    /// What a box's worth may be off by when it is worked out in doubles; 0 where that is exact.
    [[nodiscard]] double rounding() const;
};

/// Bytes that a grid takes for each point and axis.
constexpr std::size_t axis_bytes = sizeof(double) + 2 * sizeof(std::uint32_t);

BoxGrid box_grid(const PointSet& points, Space space, Measure measure, const RunContext& run);

/// Places on one axis where a box begins and ends.
struct Interval {
    std::uint32_t lower = 0;
    std::uint32_t upper = 0;

    /// Whether it goes across 1 (torus): an open one whose ends meet is the circle less a point.
    [[nodiscard]] bool wraps(Side side) const {
        return side == Side::open ? lower >= upper : lower > upper;
    }

    [[nodiscard]] bool contains(std::uint32_t place, Side side) const {
        const bool above = side == Side::open ? place > lower : place >= lower;
        const bool below = side == Side::open ? place < upper : place <= upper;
        return wraps(side) ? above || below : above && below;
    }
};

struct GridBox {
    Side side = Side::open;
    std::vector<Interval> axes;
};

/// Length of an interval, as a double.
double length(const BoxGrid& grid, std::size_t axis, Interval interval, Side side);

/// The worst box offered so far; of boxes that are equally bad, the first.
class WorstBox {
  public:
    /// Keeps a reference to the grid.
    explicit WorstBox(const BoxGrid& grid) : grid_(&grid) {}

    /// Counts the points in the box, and takes it if it is worse than the one before.
    void offer(const GridBox& box);

    /// Takes the other's box if it is worse.
    void offer(const WorstBox& other);

    /// The box's worth over the scale, rounded to the nearest double; 0 before the first offer.
    [[nodiscard]] double value() const;

    /// The box's worth, rounded to the nearest double.
    [[nodiscard]] double worth() const { return worth_; }

    /// worth * 2^all_places, exact.
    [[nodiscard]] const Integer& exact_worth() const { return exact_; }

    [[nodiscard]] const GridBox& box() const { return box_; }
    [[nodiscard]] std::uint64_t points() const { return points_; }
    [[nodiscard]] std::vector<double> lower_corner() const;
    [[nodiscard]] std::vector<double> upper_corner() const;

    /// Volume of the box, rounded to the nearest double.
    [[nodiscard]] double volume() const;

  private:
    const BoxGrid* grid_;
    Integer exact_ = 0;
    double worth_ = 0;
    GridBox box_;
    std::uint64_t points_ = 0;
};

/// Length of an interval times 2^places of its axis, exact.
Integer exact_length(const BoxGrid& grid, std::size_t axis, Interval interval, Side side);

}  // namespace stipple::analyzers::extreme
