// SPDX-License-Identifier: MIT
//
// Declarations for sensitivity.cpp: inputs and results, reading of runs, methods and their tools. A
// function is in the source file of its method or task; those without one are in effects.cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
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

struct Setting {
    std::size_t bootstrap = 1000;  ///< number of resamples; 0: no bootstrap intervals
    double level = 0.95;
    std::uint64_t seed = 1;
    std::optional<std::size_t> harmonics = {};  ///< fast: harmonics M; default: from the curves
    std::optional<std::size_t> degree = {};     ///< chaos: degree; default: chosen by the fit
};

/// An index with its interval; NaN if unknown.
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
    std::string no_intervals = {};  ///< reason for missing intervals; empty if none is missing
    /// Reason for each input without indices; may be empty.
    std::vector<std::string> missing = {};
};

/// Groups of rows that a method needs; if the rows do not fit, `trouble` is the reason.
struct Layout {
    std::size_t group = 0;  ///< number of consecutive rows in a group
    /// Morris: every row of a group differs from its first row, not from the previous one.
    bool star = false;
    std::size_t harmonics = 0;  ///< fast: number M of harmonics
    std::string trouble = {};

    explicit operator bool() const { return trouble.empty(); }
};

/// Requested columns, by names or numbers from 1, separated by commas. Empty: chosen automatically.
struct ColumnsAsked {
    std::string design = {};    ///< file of the inputs; empty: the table contains them
    std::string inputs = {};    ///< columns of the design or, without a design, of the table
    std::string response = {};  ///< output columns of the table
};

struct Runs {
    Inputs inputs;
    std::vector<Response> responses;
};

/// Finds the inputs and outputs. Inputs are, by name, the coordinates of the domain in the
/// provenance of the table or of the design. If neither has a domain, they are all columns of the
/// design, or all of the table except the last. All other columns of the table are outputs, except
/// copies of inputs (same name and numbers). Notes report assumptions and unused columns.
/// @throws Error(input) if numbers of rows differ, if a column has the name of an input but other
///         numbers, or if an output contains words; Error(usage) if a column does not exist
Runs runs_of(const PointSet& table, const ColumnsAsked& asked, const RunContext& run);

// Methods for structured designs, with functions that check whether rows form such a design. Runs
// that belong together are ignored if one of them failed. @throws Error(input) if too few remain

Layout find_pick_freeze(const PointSet& design);
Effects pick_freeze(const Layout& layout, const Inputs& inputs, const Response& response,
                    const Setting& setting, const RunContext& run);

Layout find_trajectories(const PointSet& design);
Effects elementary_effects(const Layout& layout, const Inputs& inputs, const Response& response,
                           const Setting& setting, const RunContext& run);

/// Checks that on each curve the ranks of its own input have nearly all their variance at the
/// curve's frequency and its harmonics, and those of the other inputs hardly any.
/// @param harmonics number M of harmonics; if empty, derived from the first curve
Layout find_curves(const PointSet& design, std::optional<std::size_t> harmonics,
                   const RunContext& run);

/// Indices by extended FAST. @throws Error(input) if a run failed: a spectrum needs all runs
Effects fourier_amplitudes(const Layout& layout, const Inputs& inputs, const Response& response,
                           const RunContext& run);

// Methods for any design.

/// First-order indices by ranks; ignores failed runs. @throws Error(input) if too few runs remain
Effects rank_indices(const Inputs& inputs, const Response& response, const Setting& setting,
                     const RunContext& run);

/// Indices by polynomial chaos; ignores failed runs. Returns nullopt if no term predicts better
/// than the mean. @throws Error(input) if too few runs remain
std::optional<Effects> polynomial_chaos(const Inputs& inputs, const Response& response,
                                        const Setting& setting, const RunContext& run);

// Notes on rows that are not an independent sample (structure.cpp).

/// Fraction of rows that differ from another row in exactly one coordinate, if it is far above
/// chance; otherwise 0. Also 0 for full factorials, and if there are too many rows to examine.
double share_of_neighbors(const PointSet& points, const RunContext& run);

/// Warns of the two inputs with the largest rank correlation if it is too large for independence.
void note_dependence(const Inputs& in, const RunContext& run);

/// Table with one row of terms per sample.
struct TermTable {
    std::vector<double> terms;
    std::size_t width;

    [[nodiscard]] std::size_t rows() const { return terms.size() / width; }
};

/// Computes statistics from the means of the terms.
using Statistics = std::function<void(std::span<const double> means, std::span<double> values)>;

/// Probability that an effect may have, at this level, in addition to the `shown` of `rows` rows that
/// show it; 0 if these are five or more.
double unseen_chance(std::size_t rows, std::size_t shown, double level);

/// Returns the first `count` statistics, computed from all rows, with their bootstrap intervals.
std::vector<Index> bootstrapped(const TermTable& table, std::size_t count,
                                const Statistics& statistics, double caution,
                                const Setting& setting, const RunContext& run);

inline std::vector<Index> part_of(std::span<const Index> all, std::size_t first,
                                  std::size_t count) {
    const auto part = all.subspan(first, count);
    return {part.begin(), part.end()};
}

inline constexpr std::size_t most_terms = 300;  ///< largest number of terms in a fit
/// Candidate terms: the columns of a table, stored row by row. The fit uses only the given rows.
struct Candidates {
    std::span<const double> values;
    std::size_t columns;
    std::span<const std::size_t> rows;
};

struct SparseFit {
    double error = 0;  ///< selection criterion, relative to the variance of z
    double constant = 0;
    std::vector<std::size_t> chosen = {};  ///< columns, in the order of their choice
    std::vector<double> coefficients = {};
};

/// Fits z, which has one number per row of the table, by a constant and columns, by orthogonal
/// matching pursuit. Uses only the constant if no column improves the criterion.
SparseFit matching_pursuit(const Candidates& candidates, std::span<const double> z,
                           const RunContext& run);

/// Numbers scaled to mean 0 and largest magnitude 1, so that squares fit a double.
struct Centred {
    std::vector<double> z;
    double mean = 0;
    double unit = 1;  ///< original numbers are mean + unit z

    /// Mean square of z; the variance of the original numbers is unit^2 times this.
    [[nodiscard]] double variance() const;
};

/// The variance, or NaN if it is too large or too small for float64.
double held(double variance);

/// Whether numbers differ at most by rounding, so that there is no variance to explain.
bool is_constant(std::span<const double> y);
Centred centred(std::span<const double> y);

/// Indices of the runs that did not fail, and the outputs of selected runs.
std::vector<std::size_t> succeeded(std::span<const double> y);
std::vector<double> picked(std::span<const double> y, std::span<const std::size_t> runs);

/// Indices of the groups of `group` consecutive runs without failed runs. @throws Error(input) if
/// there are fewer than two; `what` is the name of groups in the message
std::vector<std::size_t> complete_groups(const Response& response, std::size_t group,
                                         const char* what);

/// Outputs of the given groups of `group` runs, one after another.
std::vector<double> joined(std::span<const double> y, std::size_t group,
                           std::span<const std::size_t> groups);

/// Whether half of the outputs or more are equal.
bool mostly_equal(std::vector<double> y);

/// Smallest number of runs for intervals of the methods for any design.
inline constexpr std::size_t least_for_intervals = 20;
std::string too_few_for_intervals(std::size_t count, std::size_t least, const char* of_what);

/// Reason why bootstrapped() gives no intervals; empty if it gives some, or none are requested.
/// @param of_what name of the rows in the message, such as "base rows"
std::string no_bootstrap(std::size_t rows, const char* of_what, const Setting& setting);

/// Student's quantile for a two-sided interval of this level.
double interval_quantile(double level, std::size_t freedom);

/// Inputs in [0, 1]; uniform if their distributions are known.
struct UnitInputs {
    PointSet u;
    const char* scale;  ///< how inputs were scaled: "cube", "box", "distributions" or "range"
};

/// Maps inputs to [0, 1] by the distributions of their domain. If it is unknown, inputs remain
/// unchanged if all are in [0, 1], and are otherwise scaled by their extremes.
UnitInputs unit_inputs(const Inputs& inputs);

std::vector<double> column_of(const PointSet& points, std::size_t j);
double dot(std::span<const double> a, std::span<const double> b);

/// (rank - 1/2) / n of each of n numbers; equal numbers have the mean of their ranks.
std::vector<double> ranks_of(std::span<const double> values);

}  // namespace stipple::analyzers::sensitivity
