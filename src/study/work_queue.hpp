// SPDX-License-Identifier: MIT
//
// A study cut into pieces of work by their cost: first those that take long however they are cut,
// the most expensive of them first, so that none is left over when all others are done; then the
// rest in the order of the study, so that rows can be written soon.
//
// A piece is some sets of one cell or, where the measures of one set cost more than to make it
// again, some of a set's measures. Pieces take about a second at most where that can be, so that an
// interrupted study has lost little.
//
// What is left takes, summed over generators and dimensions,
//
//     (model of what is left) x (spent / model of what is done),
//
// the correction being that of all that is done where nothing is done there yet.
//
// Shape   memory goes with the number of cells, not of sets.
// Beware  the model is good to a factor of ten or so: it orders work and cuts it.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "study/sweep.hpp"
#include "study/unit_runner.hpp"

namespace stipple {

/// The parts of a range that are not done. @param done in order, none within another
std::vector<UnitRange> missing(std::span<const UnitRange> done, UnitRange range);

/// Seconds on one core to make a set.
double generate_cost(const Sweep& sweep, const Cell& cell);

/// Seconds on one core to measure a set.
double measure_cost(const Sweep& sweep, const Cell& cell, std::size_t measure);

/// What is left of a study, in seconds of one core.
class WorkLeft {
  public:
    /// All but what was done before.
    explicit WorkLeft(const Sweep& sweep, const std::vector<UnitRange>& done = {});

    /// Takes out what was done, and learns from the seconds that it took, if they are known.
    void finish(const std::vector<UnitRange>& ranges, std::optional<double> seconds);

    [[nodiscard]] double seconds() const;

  private:
    /// One generator in one dimension.
    struct Part {
        double left = 0;
        double modelled = 0;  ///< of what is done
        double spent = 0;
    };

    [[nodiscard]] Part& part_of(std::uint64_t cell);

    const Sweep& sweep_;
    std::vector<Part> parts_;
};

class WorkQueue {
  public:
    /// @param workers that will pull at once
    WorkQueue(const Sweep& sweep, std::vector<UnitRange> done, std::size_t workers);

    /// The next piece; nothing when all was given out.
    std::optional<std::vector<UnitRange>> pull();

    /// Pieces that were not given out yet; some may turn out to be done.
    [[nodiscard]] std::uint64_t pieces_left() const { return pieces_left_; }

  private:
    /// How the units of a cell are cut.
    struct Cut {
        std::uint64_t cell = 0;
        std::uint64_t units = 1;  ///< of a piece
        std::uint64_t pieces = 0;
        double cost = 0;  ///< of a piece
    };

    [[nodiscard]] Cut cut_of(std::uint64_t cell, double grain) const;

    const Sweep& sweep_;
    std::vector<UnitRange> done_;
    std::vector<Cut> cuts_;
    std::size_t cut_ = 0;
    std::uint64_t piece_ = 0;
    std::uint64_t pieces_left_ = 0;
};

}  // namespace stipple
