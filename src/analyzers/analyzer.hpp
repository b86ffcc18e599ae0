// SPDX-License-Identifier: MIT
//
// Analyzers: their options, results and functions that make a report from points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/options.hpp"
#include "core/peers.hpp"
#include "core/point_set.hpp"
#include "stipple/report.hpp"
#include "stipple/run.hpp"

namespace stipple {

struct AnalyzerTraits {
    std::size_t min_dimension = 1;
    std::size_t max_dimension = 1'000'000;
    bool unit_cube = true;   ///< accepts only points of the closed unit cube
    bool boxed = false;      ///< accepts only points of the unit cube or of a box
    bool densities = false;  ///< uses the density at each point, if known
    bool table = false;      ///< accepts rows of arbitrary numbers; missing values are NaN
};

/// Direction in which a result is better.
enum class Better { neither, lower, higher };

constexpr const char* word_of(Better better) {
    return better == Better::lower ? "lower" : better == Better::higher ? "higher" : "neither";
}

/// Description of one result of a report.
struct ResultKey {
    std::string key;  ///< dotted; a part in capital letters is a placeholder for any name
    std::string help;
    bool always = true;           ///< false: reported only with some options
    std::string_view words = {};  ///< possible values, separated by |; empty: a number or any text
    Better better = Better::neither;
    bool any_count = false;  ///< comparable between sets of different sizes
    /// Each of `words` with its sentence on report pages; {}: the statistic and the p-value.
    std::vector<std::pair<std::string_view, std::string_view>> sentences = {};
};

inline ResultKey lower(ResultKey result) {
    result.better = Better::lower;
    return result;
}

inline ResultKey higher(ResultKey result) {
    result.better = Better::higher;
    return result;
}

inline constexpr std::string_view true_or_false = "true|false";

/// Set metadata available before streaming.
struct Arrival {
    DomainPtr domain;
    std::optional<std::uint64_t> count = {};  ///< number of points, if announced
    bool weighted = false;                    ///< rows have a weight after the coordinates

    [[nodiscard]] std::size_t dimension() const { return domain->dimension(); }
    [[nodiscard]] std::size_t width() const { return dimension() + (weighted ? 1 : 0); }
};

/// Analyzes a set that arrives in batches, without storing it. The report must not depend on
/// whether the count was announced.
class Accumulator {
  public:
    Accumulator() = default;
    Accumulator(const Accumulator&) = delete;
    Accumulator& operator=(const Accumulator&) = delete;
    virtual ~Accumulator() = default;

    /// Adds the next points of the set, arrival_batch() points or fewer in the last batch. May use
    /// the run's threads; the caller reports progress.
    virtual void add(std::span<const double> rows, const RunContext& run) = 0;

    /// Called once, after all points. @throws Error(input)
    virtual Report report(const RunContext& run) = 0;
};

/// Analyzes a part of a set of announced count, and merges the states of other parts.
class SharedAccumulator : public Accumulator {
  public:
    /// Called before any points if this part does not begin the set. Its first point has the index
    /// `first` in the set; `head` is the first batch of the whole set.
    virtual void begin_at(std::uint64_t first, std::span<const double> head) = 0;

    /// Serialized state, to be merged by another accumulator. add() must not be called afterwards.
    virtual std::string state(const RunContext& run) = 0;

    /// Merges the state of the accumulator for the points directly after those of this object. The
    /// report then equals, to the last bit, that of a single accumulator for all of these points.
    virtual void merge(std::string_view state, const RunContext& run) = 0;
};

/// Ways for several processes to share the work on one set: each sees a part of the points (grain),
/// or each sees all points and does a part of a search (together). At most one of the two is set.
struct Sharing {
    /// Returns a number of points; each part begins at a multiple of it. With `grain`, `accumulate`
    /// makes a SharedAccumulator. @throws Error(usage) if these options do not allow sharing
    std::function<std::uint64_t(const Arrival&, const Values&)> grain = {};

    /// Like `analyze`, but divides the work among peers that have the same points and options; all
    /// of them return the report.
    std::function<Report(const PointSet&, const Values&, Peers&, const RunContext&)> together = {};

    explicit operator bool() const { return grain || together; }
};

/// Points per call of Accumulator::add(), the same in every run, so that sums are reproducible.
constexpr std::size_t arrival_batch(std::size_t dimension) {
    constexpr std::size_t numbers = std::size_t{1} << 18;
    return dimension < numbers ? numbers / dimension : 1;
}

/// A list among the results that is drawn as a curve.
struct CurveKey {
    std::string_view key;
    std::string_view over;  ///< key of the list of its abscissas; empty: pairs of coordinates
    /// Values for independent points: a number, or the key of a list; empty: unknown.
    std::string_view reference = {};
    std::string_view title = {};  ///< title of the axis of ordinates; empty: derived from `key`
    /// Title of the axis of abscissas; empty: derived from `over`.
    std::string_view over_title = {};
    bool log = false;               ///< whether the axes are logarithmic
    std::string_view caption = {};  ///< caption on a report page; empty: not shown there
};

/// Sections of a report page, in their order there.
enum class PagePart { discrepancy, means, gaps, distances, spectrum, pairs, integration, tests };

/// One measure of a report page: the analyzer with these options.
struct PageMeasure {
    std::string_view title;
    /// Keys of results that appear in the comparison of sets, with their titles there.
    std::vector<std::pair<std::string_view, std::string_view>> compared = {};
    /// Options with their values; for an empty value (max-work, prefixes) the page chooses one.
    std::vector<std::pair<std::string_view, std::string_view>> options = {};
    /// First part of the keys of the measure's results; empty: the analyzer's name.
    std::string_view name = {};
};

/// Cost of comparing all pairs of points, which a report page limits by its --max-work.
struct AllPairs {
    std::size_t above = 0;  ///< all pairs are compared in more dimensions than this; 0: never
    double steps = 0;       ///< the comparison takes n^2 d / steps units of --max-work
};

struct Analyzer {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< family name such as "blue noise", set by the registry
    /// Search words such as the analyzer's kind or uses; no names of analyzers, warps, generators.
    std::vector<std::string> related = {};
    AnalyzerTraits traits;
    Schema options;
    std::vector<ResultKey> results;
    std::vector<CurveKey> curves = {};
    PagePart part = {};
    std::vector<PageMeasure> page = {};
    AllPairs pairs = {};
    /// Values of `stipple plot --chart` that show results with default options. The second string
    /// is the title if the result is a grid in the plane, and empty if it is a curve.
    std::vector<std::pair<std::string_view, std::string_view>> charts = {};
    /// Option that names the column of weights; empty: no such option.
    std::string_view strengths = {};

    /// Analyzes a set whose domain and dimension fit the traits. Empty if `accumulate` is set.
    std::function<Report(const PointSet&, const Values&, const RunContext&)> analyze = {};

    /// Makes an accumulator for a set of any size, in constant memory if possible. The accumulator
    /// checks that the points are in their domain. Empty if all points are needed at once.
    std::function<std::unique_ptr<Accumulator>(const Arrival&, const Values&, const RunContext&)>
        accumulate = {};

    /// Seconds on one core for n points of d dimensions, within a factor of ten; null: 5e-7 n d.
    double (*cost)(double n, double d) = nullptr;

    /// Ways for several processes to share the work on one set; empty: there are none.
    Sharing sharing = {};

    /// Called with the mean of `sets` reports (numbers, curves and grids averaged): recomputes
    /// results that are not means, such as an anisotropy. May be empty.
    std::function<void(Report& mean, std::size_t sets, const Values&)> refine = {};

    /// Called with the first of the reports to be averaged: fixes options that otherwise depend on
    /// the size of a set, so that reports on sets of other sizes can be averaged. May be empty.
    std::function<void(const Report& first, Values&)> follow = {};

    /// Called after `refine` with the averaged reports, without their curves and grids: adds
    /// results computed from all of them, such as a combined p-value. May be empty.
    std::function<void(Report& mean, std::span<const Report> sets, const Values&)> combine = {};
};

/// Returns the size of one batch, for Sharing::grain.
std::uint64_t batch_grain(const Arrival& arrival, const Values&);

/// Number of parts of a key that are placeholders for any name.
std::size_t free_parts(const ResultKey& result);

/// Record of the result with a dotted key; nullptr if no record matches.
const ResultKey* find_result(const Analyzer& analyzer, std::string_view key);

/// @throws Error(input) if the analyzer does not accept points of this dimension
void check_dimension(const Analyzer& analyzer, std::size_t dimension);

/// Whether all reports to be averaged have the same value under a key, up to rounding.
bool alike(std::span<const Report> sets, std::string_view key);

/// Removes the results with these names, such as positions and pairs, which cannot be averaged.
void drop(Report& report, std::initializer_list<std::string_view> names);

namespace analyzers {
/// All analyzers, in alphabetical order.
const std::vector<Analyzer>& all();
}  // namespace analyzers

}  // namespace stipple
