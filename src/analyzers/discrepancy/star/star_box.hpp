// SPDX-License-Identifier: MIT
//
// What all searches for the worst box of a point set share: the grid of corners that need a look,
// and the worst box found so far, compared without rounding.
//
//     open box   [0,c):  vol(c) - #{x < c} / n         closed box  [0,c]:  #{x <= c} / n - vol(c)
//
// with c made of coordinates of points and of 1. Half-open boxes [0,c) alone have the same
// supremum, but for points with a coordinate 1, which are in none of them: c is at most 1. The
// closed box up to (1,...,1), which is never too full, is the one place where such a point does no
// harm, so it is moved there.
//
// Source  H. Niederreiter, "Discrepancy and convex programming", Ann. Mat. Pura Appl. 93 (1972)
//         89-97, doi:10.1007/BF02412017 (the finite grid).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point_set.hpp"
#include "core/run_context.hpp"
#include "math/functions/dyadic.hpp"

namespace stipple::analyzers::star {

enum class Side { open, closed };

/// Which boxes count: those of both sides, or the half-open ones and their limits.
enum class Boxes { closed, half_open };

/// The distinct coordinates on each axis, and the points as places among them.
struct CornerGrid {
    std::size_t count = 0;
    std::vector<std::vector<double>> values;        ///< of each axis, ascending; the last is 1
    std::vector<std::vector<std::uint32_t>> ranks;  ///< of each axis: place of every point

    [[nodiscard]] std::size_t dimension() const { return values.size(); }
};

/// Bytes that a grid takes for each point and axis.
constexpr std::size_t axis_bytes = sizeof(double) + sizeof(std::uint32_t);

CornerGrid corner_grid(const PointSet& points, const RunContext& run, Boxes boxes = Boxes::closed);

/// Places on the axes of a grid.
using Corner = std::vector<std::uint32_t>;

/// The worst box offered so far; of boxes that are equally bad, the first. Before any offer: the
/// cube, closed, with a discrepancy of 0.
class WorstBox {
  public:
    /// Keeps a reference to the grid.
    explicit WorstBox(const CornerGrid& grid);

    /// Takes the box, with the number of points in it, if it is worse than the one before.
    void offer(Side side, std::span<const std::uint32_t> corner, std::uint64_t points);

    /// Takes the other's box if it is worse.
    void offer(const WorstBox& other);

    /// Discrepancy of the box, rounded to the nearest double.
    [[nodiscard]] double value() const { return value_; }

    /// A box whose discrepancy comes out smaller than this in floating point is not worse.
    [[nodiscard]] double threshold() const { return value_ - rounding_; }

    [[nodiscard]] Side side() const { return side_; }
    [[nodiscard]] std::uint64_t points() const { return points_; }
    [[nodiscard]] const Corner& places() const { return corner_; }
    [[nodiscard]] std::vector<double> corner() const;

    /// Volume of the box, rounded to the nearest double.
    [[nodiscard]] double volume() const;

  private:
    [[nodiscard]] double approximate(Side side, std::span<const std::uint32_t> corner,
                                     std::uint64_t points) const;
    [[nodiscard]] Integer scaled_volume(std::span<const std::uint32_t> corner) const;

    const CornerGrid* grid_;
    std::vector<unsigned> places_;  ///< binary places of the coordinates of each axis
    unsigned all_places_ = 0;       ///< sum of these
    double rounding_;
    double value_ = 0;
    Integer scaled_value_ = 0;  ///< value * count * 2^all_places, exact
    Side side_ = Side::closed;
    Corner corner_;
    std::uint64_t points_ = 0;
};

}  // namespace stipple::analyzers::star
