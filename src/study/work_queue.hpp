// SPDX-License-Identifier: MIT
//
// Pieces of work of a study. Cells whose pieces take long come first, the longest first, so that
// none is left when all others are done; the rest follows in the order of the study, so that a
// stream can write its rows soon.
//
// A piece is some sets of one cell or, if measuring a set costs more than making it again, one of
// its measures. Pieces take at most about a second if possible: an interruption loses little.
//
// Times are modelled at first, by the costs in the records of the units and n d where there is
// none, and measured after:
//
//     seconds = model x (spent / model of what is finished),   of the cell, or else of all cells.
//
// Shape   memory grows with the number of cells, not of sets.
// Beware  the model is good to a factor of ten or so.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "study/sweep.hpp"

namespace stipple {

/// Parts of a range that are not done. @param done in order, without overlaps
std::vector<UnitRange> missing(std::span<const UnitRange> done, UnitRange range);

/// Modelled seconds on one core.
struct SetCost {
    double make = 0;
    double measure = 0;  ///< with all measures
    [[nodiscard]] double all() const { return make + measure; }
};

SetCost set_cost(const Sweep& sweep, const Cell& cell);

class WorkQueue {
  public:
    /// @param done in order @param workers that will pull at once
    explicit WorkQueue(const Sweep& sweep, std::vector<UnitRange> done = {},
                       std::size_t workers = 1);

    /// The next piece; nullopt after the last.
    std::optional<std::vector<UnitRange>> pull();

    /// Takes out what was done in so many seconds of one core.
    void finish(const std::vector<UnitRange>& ranges, double seconds);

    /// About how many pieces have not been pulled.
    [[nodiscard]] std::uint64_t pieces_left() const { return pieces_left_; }

    /// Seconds of one core for all that is not finished.
    [[nodiscard]] double seconds_left() const;

  private:
    /// Modelled seconds of a cell, except `spent`, and its units that have been pulled.
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
    double grain_ = 0;  ///< seconds that a piece should take
    std::vector<CellWork> work_;
    CellWork all_;                      ///< finished and spent in all cells
    std::vector<std::uint64_t> cells_;  ///< not yet pulled, the last one first
    std::uint64_t pieces_left_ = 0;
    std::uint64_t finished_ = 0;  ///< pieces
};

}  // namespace stipple
