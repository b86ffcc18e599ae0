// SPDX-License-Identifier: MIT
//
// What a report page says, before it is a page: sets, what was measured of each and how to measure
// it again, and a table that compares them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/point_set.hpp"
#include "stipple/report.hpp"

namespace stipple::page {

inline constexpr std::size_t most_sets = 12;  ///< as many as there are colours

/// One measure of a set: what came of it, or why there is nothing.
struct Measure {
    std::string name;   ///< of its keys: "star-discrepancy", "extreme-discrepancy"
    std::string title;  ///< for people
    std::string analyzer;
    std::vector<std::pair<std::string, std::string>> options = {};  ///< that have a value
    std::string command = {};  ///< that measures it again; empty: none does
    std::optional<Report> results = {};
    std::string left_out = {};  ///< why there are no results
};

/// A set with all that the page says of it.
struct Set {
    std::string name;  ///< no other set of the page has it
    std::string source;
    std::optional<std::size_t> number = {};  ///< in its file, of several
    std::uint64_t count = 0;
    std::uint64_t left_out = 0;  ///< rows of its file with missing numbers
    std::size_t dimension = 0;
    std::string domain = {};
    std::optional<std::uint64_t> fingerprint = {};  ///< of the coordinates
    Provenance provenance = {};
    std::string command = {};  ///< that makes the points; empty: not known
    std::vector<Measure> measures = {};
    std::vector<std::string> figures = {};  ///< HTML
    /// What was found of other sets of the same kind, as all_results() has it: the comparison is then
    /// of means.
    std::vector<Report> replications = {};

    /// The measure of that name; nullptr if there is none, or nothing came of it.
    [[nodiscard]] const Report* results(std::string_view measure) const;

    /// All results under the names of their measures: "star-discrepancy.value".
    [[nodiscard]] Report all_results() const;
};

struct Page {
    std::string title;
    std::string version;       ///< of stipple
    std::string command = {};  ///< that makes the page
    std::vector<Set> sets = {};
};

/// Whether all sets have as many points.
bool same_count(std::span<const Set> sets);

/// Sentences on what keeps the sets from being compared as they are: different n, domains.
std::vector<std::string> notes_on(std::span<const Set> sets);

/// Which of two numbers is the better one.
enum class Better { lower, higher, neither };

/// A number that is compared: KEY is MEASURE.RESULT.
struct Key {
    const char* key;
    const char* label;
    const char* group;
    Better better = Better::lower;
    bool any_count = false;  ///< sets of different n can be compared by it
    bool magnitude = false;  ///< its sign does not matter: of several sets, the root mean square
};

/// All numbers that are compared, in the order of the table.
std::span<const Key> compared_keys();

/// What is known of a number: a point, or bounds; or of the mean of several.
struct Known {
    double value = 0;
    double lower = 0;
    double upper = 0;
    double error = 0;  ///< standard error of a mean
    [[nodiscard]] bool exact() const { return lower == upper; }

    /// What it is taken to be between where it is compared: a mean by two standard errors.
    [[nodiscard]] double least() const { return lower - 2 * error; }
    [[nodiscard]] double most() const { return upper + 2 * error; }
};

/// A row of the comparison.
struct Row {
    Key key;
    std::vector<std::optional<Known>> values = {};  ///< of each set
    std::vector<bool> best = {};                    ///< no other set can be better; several may tie
};

/// The number under a key of a set's results, with the bounds beside it where there are some; of
/// several sets their mean.
std::optional<Known> known_under(const Set& set, const Key& key);

/// Marks what no other one can be better than: bounds must be apart, or both sets be best.
/// Nothing is best where there is one number only, or all are the same.
std::vector<bool> best_of(std::span<const std::optional<Known>> values, Better better);

/// Rows for which some set has a number.
std::vector<Row> compare_sets(std::span<const Set> sets);

/// What a test of uniformity found, in a sentence; empty for what is no such test.
std::string verdict_in_words(const Measure& measure);

/// A number as a table shows it; of a p-value that is too small to tell, "< 1e-16".
std::string shown_number(double value, std::string_view key = {});
/// The same with its bounds, where it is not exact, or its error: "0.036 to 0.159", "0.1 ± 0.02".
std::string shown_known(const Known& known, std::string_view key = {});

}  // namespace stipple::page
