// SPDX-License-Identifier: MIT
//
// The work of a study, in pieces. A single worker takes the shortest pieces first, so that an early
// stop keeps rows. Several workers do so in the first twentieth of the work. Then half of their
// time goes to the longest pieces, so that none is left when everything else is done, and half to
// the shortest, so that a study that is often stopped and resumed gains rows each time. Pieces that
// take at most `grain_` seconds are in the study's order, as streams need them.
//
// A piece is some sets of one cell or, if measuring a set costs more than making it again, one
// measure of one set. Pieces take at most about a second if possible, so that little is lost by an
// interruption.
//
// Times are first modelled, by the cost functions of the units (n d for units without one), and
// later corrected by measured times:
//
//     seconds = model x (spent / model of finished work, of the cell or, if it has none, of all)
//
// Shape   memory grows with the number of cells, not of sets.
// Beware  the model is wrong by a factor of up to ten or so.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "study/sweep.hpp"

namespace stipple {

/// Returns the parts of a range that are not done.
/// @param done in order, without overlaps
std::vector<UnitRange> missing(std::span<const UnitRange> done, UnitRange range);

/// Modelled seconds on one core for a set.
struct SetCost {
    double make = 0;
    double measure = 0;  ///< seconds for all measures
    [[nodiscard]] double all() const { return make + measure; }
};

SetCost set_cost(const Sweep& sweep, const Cell& cell);

class WorkQueue {
  public:
    /// @param done units that are not to be run, in order
    /// @param workers number of threads that pull at the same time
    explicit WorkQueue(const Sweep& sweep, std::vector<UnitRange> done = {},
                       std::size_t workers = 1);

    /// Returns the next piece; nullopt after the last one.
    std::optional<std::vector<UnitRange>> pull();

    /// Removes finished units from the estimate. @param seconds that they took on one core
    void finish(const std::vector<UnitRange>& ranges, double seconds);

    /// Approximate number of pieces that have not been pulled.
    [[nodiscard]] std::uint64_t pieces_left() const { return pieces_left_; }

    /// Estimated seconds on one core for all units that are not finished.
    [[nodiscard]] double seconds_left() const;

  private:
    /// Progress of a cell: `left` and `finished` in modelled seconds, `spent` in measured ones, and
    /// the number of its units that were pulled.
    struct CellWork {
        double left = 0;
        double finished = 0;
        double spent = 0;
        std::uint64_t pulled = 0;
    };
    struct Piece {
        std::uint64_t units = 1;
        double seconds = 0;
    };

    [[nodiscard]] double measured_ratio(const CellWork& work) const;
    [[nodiscard]] Piece piece_of(std::uint64_t cell) const;
    void take_out(std::span<const UnitRange> ranges, std::optional<double> seconds);
    void sort();

    const Sweep& sweep_;
    std::vector<UnitRange> done_;
    double workers_;
    double early_ = 0;  ///< modelled seconds of work left in the early phase, shortest pieces first
    double grain_ = 0;  ///< seconds that a piece should take
    double ahead_ = 0;  ///< seconds of the short pieces pulled, minus those of the long ones
    std::vector<CellWork> work_;
    CellWork all_;                      ///< `finished` and `spent` of all cells
    std::vector<std::uint64_t> cells_;  ///< cells with units left, in the order of sort()
    std::size_t within_grain_ = 0;      ///< number of cells, first in cells_, with short pieces
    std::uint64_t pieces_left_ = 0;
    std::uint64_t finished_ = 0;  ///< number of finished pieces
};

}  // namespace stipple
