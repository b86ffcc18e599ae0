// SPDX-License-Identifier: MIT
//
// Analyzers: the record of one, with its function from points to a report.
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
    bool densities = false;  ///< uses known densities of the points
    bool table = false;      ///< accepts rows of any numbers; missing ones are NaN
};

/// Which of two values is the better one.
enum class Better { neither, lower, higher };

constexpr const char* word_of(Better better) {
    return better == Better::lower ? "lower" : better == Better::higher ? "higher" : "neither";
}

/// One key of the results.
struct ResultKey {
    std::string key;  ///< dotted; a part in capitals stands for any name
    std::string help;
    bool always = true;           ///< false: only with some options
    std::string_view words = {};  ///< possible values, separated by |; empty: numbers, or any text
    Better better = Better::neither;
    bool any_count = false;  ///< comparable between sets of different sizes
    /// Sentences for these words on a report page; {}: the numbers behind the word.
    std::vector<std::pair<std::string_view, std::string_view>> sentences = {};
};

/// A result of which the lower value is better.
inline ResultKey lower(ResultKey result) {
    result.better = Better::lower;
    return result;
}

/// A result of which the higher value is better.
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

/// Analyzes a set that arrives in pieces, without storing it. The report must not depend on whether
/// the count was announced.
class Accumulator {
  public:
    Accumulator() = default;
    Accumulator(const Accumulator&) = delete;
    Accumulator& operator=(const Accumulator&) = delete;
    virtual ~Accumulator() = default;

    /// Takes the next points of the set: arrival_batch() of them, fewer only at its end. It may use
    /// the run's threads; the caller reports progress.
    virtual void add(std::span<const double> rows, const RunContext& run) = 0;

    /// Called once, after all points. @throws Error(input)
    virtual Report report(const RunContext& run) = 0;
};

/// Analyzes a part of a set whose count was announced, and merges the states of other parts.
class SharedAccumulator : public Accumulator {
  public:
    /// Called before any points if this part is not the set's first. Its first point is point
    /// `first` of the set; `head` is the first batch of the whole set.
    virtual void begin_at(std::uint64_t first, std::span<const double> head) = 0;

    /// Serialized state, for the accumulator that merges it. No points may follow.
    virtual std::string state(const RunContext& run) = 0;

    /// Merges the state of the accumulator for the points directly after its own. The report then
    /// equals, to the last bit, that of a single accumulator for all of these points.
    virtual void merge(std::string_view state, const RunContext& run) = 0;
};

/// How several processes share the work on one set: each sees a part of the points (grain), or each
/// sees all points and does a part of a search (together). At most one of the two is set.
struct Sharing {
    /// Alignment of parts: each begins at a multiple of this number of points. `accumulate` then
    /// makes a SharedAccumulator. @throws Error(usage) if these options do not allow sharing
    std::function<std::uint64_t(const Arrival&, const Values&)> grain = {};

    /// Like `analyze`, with peers that were given the same points and options; all get the report.
    std::function<Report(const PointSet&, const Values&, Peers&, const RunContext&)> together = {};

    explicit operator bool() const { return grain || together; }
};

/// Points per call of Accumulator::add(). Depends only on the dimension, so that sums do, too.
constexpr std::size_t arrival_batch(std::size_t dimension) {
    constexpr std::size_t numbers = std::size_t{1} << 18;
    return dimension < numbers ? numbers / dimension : 1;
}

/// A list of the results that is drawn as a curve.
struct CurveKey {
    std::string_view key;
    std::string_view over;  ///< key of the list of its abscissas
    /// Values for independent points: a number, or the key of a list. Empty: unknown.
    std::string_view reference = {};
    std::string_view title = {};       ///< name on its axis; empty: the key in words
    std::string_view over_title = {};  ///< likewise of the abscissas
    bool log = false;                  ///< logarithmic axes
    std::string_view caption = {};     ///< on a report page; empty: not shown there
};

/// Parts of a report page, in its order.
enum class PagePart { discrepancy, means, gaps, distances, spectrum, pairs, integration, tests };

/// One measure of a report page: the analyzer with these options.
struct PageMeasure {
    std::string_view title;
    /// Keys of results in the comparison of sets, with their names there.
    std::vector<std::pair<std::string_view, std::string_view>> compared = {};
    /// Options with their values; the page chooses an empty value (max-work, prefixes).
    std::vector<std::pair<std::string_view, std::string_view>> options = {};
    std::string_view name = {};  ///< first part of its keys; empty: the analyzer's name
};

/// How long a comparison of all pairs takes.
struct AllPairs {
    std::size_t above = 0;  ///< all pairs are compared in more dimensions than this
    double steps = 0;       ///< values of n^2 d that take as long as a comparison in a search
};

struct Analyzer {
    std::string name;
    std::string summary;
    std::string source;
    std::string family = {};  ///< family name such as "blue noise", set by the registry
    /// Search words that are not names of it: a kind, a part or a use.
    std::vector<std::string> related = {};
    AnalyzerTraits traits;
    Schema options;
    std::vector<ResultKey> results;
    std::vector<CurveKey> curves = {};
    PagePart part = {};
    std::vector<PageMeasure> page = {};
    AllPairs pairs = {};
    /// Values of `stipple plot --chart` that show results with default options, each with the title
    /// of the grid in the plane; empty: the curve.
    std::vector<std::pair<std::string_view, std::string_view>> charts = {};
    std::string_view strengths = {};  ///< option that names the column of weights, if there is one

    /// Analyzes one set, whose dimension and domain have been checked against the traits. Empty if
    /// `accumulate` is set.
    std::function<Report(const PointSet&, const Values&, const RunContext&)> analyze = {};

    /// Makes an accumulator for a set of any size, in constant memory if possible. It checks that
    /// the points are on their domain. Empty if all points are needed at once.
    std::function<std::unique_ptr<Accumulator>(const Arrival&, const Values&, const RunContext&)>
        accumulate = {};

    /// Seconds on one core for a set of n points, within a factor of ten; empty: 5e-7 n d.
    double (*cost)(double n, double d) = nullptr;

    /// How several processes share the work on one set; empty: they cannot.
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

/// Grain of one batch of points, for Sharing.
std::uint64_t batch_grain(const Arrival& arrival, const Values&);

/// Number of parts of a key that stand for any name.
std::size_t free_parts(const ResultKey& result);

/// Record of the result with a dotted key; nullptr if there is none.
const ResultKey* find_result(const Analyzer& analyzer, std::string_view key);

/// @throws Error(input) if the analyzer does not accept points of this dimension
void check_dimension(const Analyzer& analyzer, std::size_t dimension);

/// Whether all reports to be averaged have the same number under a key, up to rounding.
bool alike(std::span<const Report> sets, std::string_view key);

/// Removes entries that cannot be averaged from a report, such as positions and pairs.
void drop(Report& report, std::initializer_list<std::string_view> names);

namespace analyzers {
/// All analyzers, in alphabetical order.
const std::vector<Analyzer>& all();
}  // namespace analyzers

}  // namespace stipple
