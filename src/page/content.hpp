// SPDX-License-Identifier: MIT
//
// Content of a report page before it is formatted: sets, the results of their measures with the
// commands that reproduce them, and a table that compares the sets.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "analyzers/analyzer.hpp"
#include "core/point_set.hpp"
#include "stipple/report.hpp"

namespace stipple::page {

inline constexpr std::size_t most_sets = 12;  ///< limited by the number of distinct colours

/// One measure of a set: its results, or the reason why there are none.
struct Measure {
    std::string name;   ///< first part of its keys: "star-discrepancy", "extreme-discrepancy"
    std::string title;  ///< displayed name
    std::string analyzer;
    std::vector<std::pair<std::string, std::string>> options = {};  ///< options that have a value
    std::string command = {};  ///< command that reproduces the results; empty if there is none
    std::optional<Report> results = {};
    std::string left_out = {};  ///< reason if there are no results
};

/// A set with everything that the page shows of it.
struct Set {
    std::string name;  ///< name, unique on the page
    std::string source;
    std::optional<std::size_t> number = {};  ///< index in its file, if that has several sets
    std::uint64_t count = 0;
    std::uint64_t left_out = 0;  ///< rows of its file that were left out for missing numbers
    std::size_t dimension = 0;
    std::string domain = {};
    std::optional<std::uint64_t> fingerprint = {};  ///< fingerprint of the coordinates
    Provenance provenance = {};
    std::string command = {};  ///< command that makes the points; empty if unknown
    std::vector<Measure> measures = {};
    std::vector<std::string> figures = {};  ///< pictures, as HTML
    /// all_results() of further sets of the same kind. If there are any, the comparison uses means.
    std::vector<Report> replications = {};

    /// Results of the measure with this name; nullptr if there are none.
    [[nodiscard]] const Report* results(std::string_view measure) const;

    /// Results of all measures, under keys such as "star-discrepancy.value".
    [[nodiscard]] Report all_results() const;
};

struct Page {
    std::string title;
    std::string version;       ///< version of stipple
    std::string command = {};  ///< command that makes the page
    std::vector<Set> sets = {};
};

/// Whether all sets have the same number of points.
bool same_count(std::span<const Set> sets);

/// Sentences on why the sets are not directly comparable: different n or domains.
std::vector<std::string> notes_on(std::span<const Set> sets);

/// A measure with its analyzer.
struct Planned {
    std::string_view name;
    const Analyzer* analyzer;
    const PageMeasure* measure;
};

/// All measures, in the order of the page.
std::span<const Planned> planned_measures();

/// The measure with this name; nullptr if there is none.
const Planned* planned(std::string_view measure);

/// A number in the comparison; `key` is MEASURE.RESULT. If it is an error, its magnitude
/// is compared or, for a set with replications, its root mean square.
struct Key {
    std::string key;
    std::string_view label;
    std::string_view group;
    Better better = Better::lower;
    bool any_count = false;  ///< whether sets of different n can be compared
};

/// All compared numbers, in the order of the table.
std::span<const Key> compared_keys();

/// Verdict of a test, such as "uniform"; empty if the results have none.
std::string verdict_of(const Report& results);

/// A number: exact, between bounds, or a mean with its standard error.
struct Known {
    double value = 0;
    double lower = 0;
    double upper = 0;
    double error = 0;  ///< standard error of a mean
    [[nodiscard]] bool exact() const { return lower == upper; }

    /// Interval used in comparisons; a mean is extended by two standard errors.
    [[nodiscard]] double least() const { return lower - 2 * error; }
    [[nodiscard]] double most() const { return upper + 2 * error; }
};

struct Row {
    Key key;
    std::vector<std::optional<Known>> values = {};  ///< one per set
    std::vector<bool> best = {};  ///< whether no other set can be better; several sets may tie
};

/// The number under a key of a set's results, with its bounds if it is not exact; if the set has
/// replications, the mean over all sets.
std::optional<Known> known_under(const Set& set, const Key& key);

/// Marks each number that is certainly no worse than any other; overlapping bounds decide nothing.
/// Nothing is marked if there is only one number, or if all are the same.
std::vector<bool> best_of(std::span<const std::optional<Known>> values, Better better);

/// Rows of the comparison for which at least one set has a number.
std::vector<Row> compare_sets(std::span<const Set> sets);

/// The result of a uniformity test as a sentence; empty for other measures.
std::string verdict_in_words(const Measure& measure);

/// A number as shown in tables; p-values below 1e-16 become "< 1e-16".
std::string shown_number(double value, std::string_view key = {});
/// Like shown_number(), with bounds or standard error unless exact: "0.036 to 0.159", "0.1 ± 0.02".
std::string shown_known(const Known& known, std::string_view key = {});

}  // namespace stipple::page
