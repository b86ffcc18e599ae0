// SPDX-License-Identifier: MIT
//
// Inputs and results of the methods of sensitivity analysis.
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

/// Inputs of all runs of a model, one row per run.
struct Inputs {
    std::vector<std::string> names = {};
    PointSet values;
    std::string generator = {};  ///< generator of the inputs; empty if unknown

    DomainPtr domain = {};  ///< domain with the inputs as coordinates; null if unknown
    PointSet points = {};   ///< all coordinates of the domain, one row per run
    /// Positions of the inputs among the domain's coordinates.
    std::vector<std::size_t> coordinates = {};

    [[nodiscard]] std::size_t runs() const { return values.count(); }
    [[nodiscard]] std::size_t size() const { return values.dimension(); }
};

/// One output of a model in all runs; NaN where the run failed.
struct Response {
    std::string name;
    std::vector<double> y;
};

/// Options of the estimates.
struct Setting {
    std::size_t bootstrap = 1000;  ///< number of resamples; 0: no bootstrap intervals
    double level = 0.95;
    std::uint64_t seed = 1;
    std::optional<std::size_t> harmonics = {};  ///< fast: harmonics M; default: from the curves
    std::optional<std::size_t> degree = {};     ///< chaos: degree; default: chosen by the fit
};

/// An index with its interval; unknown values are NaN.
struct Index {
    double value = 0;
    double low = none;
    double high = none;
};

/// One kind of index, such as "first", for every input.
struct IndexKind {
    std::string name;
    std::vector<Index> of;
};

struct PairIndex {
    std::size_t first;
    std::size_t second;
    Index index;
};

/// Results of a method for one output.
struct Effects {
    std::uint64_t used = 0;     ///< number of runs used
    std::uint64_t samples = 0;  ///< number of independent samples, such as base rows, in these runs
    double mean = none;
    double variance = none;
    std::vector<IndexKind> kinds = {};
    std::vector<PairIndex> pairs = {};
    Report details = {};            ///< further results of the method
    std::string no_intervals = {};  ///< why intervals are left out; empty if they are given
    /// Reason for each input without indices; may be empty.
    std::vector<std::string> missing = {};
};

/// How a method groups the rows of a design; if the rows do not fit, the reason.
struct Layout {
    std::size_t group = 0;  ///< number of consecutive rows in a group
    /// Morris: every row of a group differs from its first row, not from the previous one.
    bool star = false;
    std::size_t harmonics = 0;  ///< fast: number M of harmonics
    std::string trouble = {};

    explicit operator bool() const { return trouble.empty(); }
};

/// Numbers scaled to mean 0 and largest magnitude 1, so that their squares fit a double.
struct Centred {
    std::vector<double> z;
    double mean = 0;
    double unit = 1;  ///< original numbers are mean + unit z

    /// Mean square of z; the variance of the original numbers is unit^2 times this.
    [[nodiscard]] double variance() const;
};

/// Whether numbers differ at most by rounding, so that there is no variance to explain.
bool is_constant(std::span<const double> y);

Centred centred(std::span<const double> y);

/// Indices of the runs that did not fail, and the outputs of selected runs.
std::vector<std::size_t> succeeded(std::span<const double> y);
std::vector<double> picked(std::span<const double> y, std::span<const std::size_t> runs);

/// Indices of the groups of `group` consecutive runs in which no run failed.
std::vector<std::size_t> complete_groups(std::span<const double> y, std::size_t group);

/// Smallest number of runs with which the methods for any design compute intervals.
inline constexpr std::size_t least_for_intervals = 20;
std::string too_few_for_intervals(std::size_t count, std::size_t least, const char* of_what);

/// Student's quantile for a two-sided interval of this level.
double interval_quantile(double level, std::size_t freedom);

/// Inputs in [0, 1], run after run; uniform if their distributions are known.
struct UnitInputs {
    std::vector<double> u;
    const char* scale;  ///< how inputs were scaled: "cube", "box", "distributions" or "range"
};

/// Maps inputs to [0, 1] by the distributions of their domain, if known. Otherwise inputs remain
/// unchanged if all are in [0, 1], like points without provenance, or are scaled by their extremes.
UnitInputs unit_inputs(const Inputs& inputs);

/// (rank - 1/2) / n of each of n numbers; equal numbers have the mean of their ranks.
std::vector<double> ranks_of(std::span<const double> values);

/// ranks_of() for each coordinate.
std::vector<double> ranks_of(const PointSet& points);

}  // namespace stipple::analyzers::sensitivity
