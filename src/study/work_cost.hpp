// SPDX-License-Identifier: MIT
//
// How long the parts of a study will take: a model first, then the model corrected by what the
// parts that are done took.
//
//     left = sum over generators and measures, and over dimensions, of
//            (model of what is left) x (spent / model of what is done)
//
// Where nothing is done yet in a dimension, the correction is that of the generator or measure in
// others; where there is none, that of all that is done.
//
// Beware  the model is made to order work and to cut it, within a factor of some ten.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "study/sweep.hpp"
#include "study/unit_runner.hpp"

namespace stipple {

/// Seconds to make a set, on one core.
double generate_cost(const Sweep& sweep, const Cell& cell);

/// Seconds to measure a set, on one core.
double measure_cost(const Sweep& sweep, const Cell& cell, std::size_t measure);

/// What is left of a study, in seconds of one core.
class WorkLeft {
  public:
    /// All of it.
    explicit WorkLeft(const Sweep& sweep);

    /// Takes out what was done before, or elsewhere.
    void forget(const std::vector<UnitRange>& ranges);

    /// Takes out what was done in so many seconds, for making sets and for each measure.
    void finish(const std::vector<UnitRange>& ranges, const std::vector<double>& seconds);

    [[nodiscard]] double seconds() const;

  private:
    /// One generator or one measure, in one dimension.
    struct Part {
        double left = 0;
        double modelled = 0;  ///< of what is done
        double spent = 0;

        void add(const Part& other) {
            modelled += other.modelled;
            spent += other.spent;
        }
        [[nodiscard]] double correction(double otherwise) const {
            return modelled > 0 ? spent / modelled : otherwise;
        }
    };

    /// The part of a generator or, behind them, a measure for a cell.
    [[nodiscard]] std::size_t part(std::size_t unit, std::uint64_t cell) const;

    /// Model costs of ranges, by part.
    [[nodiscard]] std::vector<double> model(const std::vector<UnitRange>& ranges) const;

    void take_out(std::span<const double> costs);

    /// Shares seconds out to those of some parts that have costs.
    void spend(double seconds, std::span<const double> costs, std::size_t first, std::size_t count);

    const Sweep& sweep_;
    std::size_t dimensions_;
    std::vector<Part> parts_;  ///< generators, then measures; each in all dimensions
};

}  // namespace stipple
