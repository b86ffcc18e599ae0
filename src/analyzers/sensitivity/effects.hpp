// SPDX-License-Identifier: MIT
//
// What the methods of sensitivity analysis take and give.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/point_set.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple::analyzers::sensitivity {

inline constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// The inputs of a model in its runs: a row each.
struct Inputs {
    std::vector<std::string> names = {};
    PointSet values;
    std::string generator = {};  ///< that made them; empty: not known

    DomainPtr domain = {};                      ///< that they are coordinates of; null: not known
    PointSet points = {};                       ///< all coordinates on it
    std::vector<std::size_t> coordinates = {};  ///< of these, the inputs

    [[nodiscard]] std::size_t runs() const { return values.count(); }
    [[nodiscard]] std::size_t size() const { return values.dimension(); }
};

/// One output of the model in these runs; NaN where a run failed.
struct Response {
    std::string name;
    std::vector<double> y;
};

/// How the methods estimate.
struct Setting {
    std::size_t bootstrap = 1000;  ///< resamples; 0: no intervals from them
    double level = 0.95;
    std::uint64_t seed = 1;
    std::optional<std::size_t> harmonics = {};  ///< of fast; else as the curves show
    std::optional<std::size_t> degree = {};     ///< of chaos; else chosen
};

/// A number with its interval; NaN where it has none.
struct Index {
    double value = 0;
    double low = none;
    double high = none;
};

/// One kind of index, of every input.
struct IndexKind {
    std::string name;
    std::vector<Index> of;
};

struct PairIndex {
    std::size_t first;
    std::size_t second;
    Index index;
};

/// What a method found of one output.
struct Effects {
    std::uint64_t used = 0;     ///< runs
    std::uint64_t samples = 0;  ///< what of them is independent, such as base rows
    double mean = none;
    double variance = none;
    std::vector<IndexKind> kinds = {};
    std::vector<PairIndex> pairs = {};
    Report details = {};                    ///< further numbers, of the method's own
    std::string no_intervals = {};          ///< the reason, if intervals are left out; else empty
    std::vector<std::string> missing = {};  ///< for each input, why it has no indices; may be empty
};

/// Whether a design has the rows that a method needs; where not, why.
struct Layout {
    std::size_t group = 0;      ///< rows that belong together
    bool star = false;          ///< of morris: all rows of a group differ from its first
    std::size_t harmonics = 0;  ///< of fast
    std::string trouble = {};

    explicit operator bool() const { return trouble.empty(); }
};

/// Numbers with mean 0 whose largest is 1 in size: their squares fit a double.
struct Centred {
    std::vector<double> z;
    double mean = 0;
    double unit = 1;  ///< of z

    /// Mean square.
    [[nodiscard]] double variance() const;
};

/// Whether numbers differ by no more than rounding may: there are no shares of their variance.
bool is_constant(std::span<const double> y);

Centred centred(std::span<const double> y);

/// The values of the runs that did not fail, and the numbers of these runs.
std::vector<std::size_t> succeeded(std::span<const double> y);
std::vector<double> picked(std::span<const double> y, std::span<const std::size_t> runs);

/// The groups of so many consecutive runs none of which failed, by number.
std::vector<std::size_t> complete_groups(std::span<const double> y, std::size_t group);

/// Runs below which methods of any design give no intervals.
inline constexpr std::size_t least_for_intervals = 20;
std::string too_few_for_intervals(std::size_t count, std::size_t least, const char* of_what);

/// Student's quantile of an interval of that level.
double interval_quantile(double level, std::size_t freedom);

/// Inputs in [0, 1], run after run, where they are uniform as far as that is known.
struct UnitInputs {
    std::vector<double> u;
    const char* scale;  ///< "cube", "box", "distributions", "range"
};

/// As the distributions of the inputs' domain say; else as they are where all are in [0, 1], as points
/// without provenance are taken to be; else scaled by their extremes.
UnitInputs unit_inputs(const Inputs& inputs);

/// (rank - 1/2) / n of each of n numbers; equal ones have the mean of theirs.
std::vector<double> ranks_of(std::span<const double> values);

/// The same of each coordinate of points among those of all.
std::vector<double> ranks_of(const PointSet& points);

}  // namespace stipple::analyzers::sensitivity
