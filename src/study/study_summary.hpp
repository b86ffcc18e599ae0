// SPDX-License-Identifier: MIT
//
// Summary of a study over its seeds: means with their errors for every generator, and comparisons
// of all pairs of generators.
//
// Promise  depends on the rows alone, which are added in the order of the study.
// Beware   p-values are corrected over the pairs of generators within one dimension, count, measure
//          and key: conclusions from several of these need a further correction.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>
#include <vector>

#include "stipple/study.hpp"
#include "study/statistics.hpp"
#include "study/study_table.hpp"

namespace stipple {

/// Mean over the sets of one generator, dimension, count, measure and key: a row of a summary. NaN
/// if unknown.
struct MeanRow {
    std::string table = "mean";
    std::string generator = {};  ///< spec
    std::uint64_t dimension = 0;
    std::string warps = {};
    std::uint64_t count = 0;
    std::string measure = {};  ///< spec
    std::string domain = {};
    std::string key = {};
    std::uint64_t sets = 0;
    std::uint64_t failed = 0;
    double mean = not_known;
    double standard_error = not_known;
    double median = not_known;
    double standard_deviation = not_known;
    double rms = not_known;      ///< root mean square
    double rms_low = not_known;  ///< interval of rms; NaN if the key is not an error
    double rms_high = not_known;
    double confidence = not_known;  ///< level of the intervals
    double t_low = not_known;       ///< Student's t interval of the mean
    double t_high = not_known;
    double bootstrap_low = not_known;
    double bootstrap_high = not_known;
    std::string study = {};
};

struct SummaryOptions {
    bool paired = false;  ///< compare seed by seed instead of by Welch's test
    double confidence = 0.95;
    std::uint64_t resamples = 2000;  ///< 0: no bootstrap intervals
    std::uint64_t seed = 1;          ///< seed of the bootstrap
};

class StudySummary {
  public:
    void add(const StudyRow& row);

    /// Seed of the first set with a result; 1 if no set has one.
    [[nodiscard]] std::uint64_t first_seed() const {
        return samples_.empty() ? 1 : samples_[0].seeds[0];
    }

    /// A row for each generator, dimension, count, measure and key. @throws Error(cancelled)
    [[nodiscard]] std::vector<MeanRow> mean_rows(const SummaryOptions& options,
                                                 const RunContext& run) const;

    /// mean_rows() as a table. @throws Error(cancelled)
    [[nodiscard]] std::string means(TableStyle style, const SummaryOptions& options,
                                    const RunContext& run) const;

    /// Table with a row for each pair of generators that have values. Warns of pairs with the same
    /// values everywhere. @throws Error(cancelled)
    [[nodiscard]] std::string comparisons(TableStyle style, const SummaryOptions& options,
                                          const RunContext& run) const;

  private:
    /// Values of one generator in one topic.
    struct Sample {
        StudyRow row;  ///< first row of the sample
        std::vector<std::uint64_t> seeds = {};
        std::vector<double> values = {};
    };

    /// Two generators in one topic.
    struct Pair {
        const Sample* a = nullptr;
        const Sample* b = nullptr;
        std::size_t sets_a = 0;  ///< number of sets compared
        std::size_t sets_b = 0;
        MeanTest test = {};
        double p_holm = 1;
    };
    /// Dimension, count, measure and key: only values of the same topic are compared.
    using Topic = std::tuple<std::uint64_t, std::uint64_t, std::string, std::string>;
    using Cell = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string>;

    [[nodiscard]] std::vector<Pair> pairs_of(const std::vector<std::size_t>& members,
                                             bool by_seed) const;

    std::vector<Sample> samples_;                   ///< ordered by their first rows in the table
    std::map<Topic, std::size_t> topic_numbers_;    ///< index in topics_
    std::vector<std::vector<std::size_t>> topics_;  ///< indices in samples_, for each topic
    struct Failed {
        StudyRow row;
        std::uint64_t sets = 0;
        bool some_went_well = false;
    };
    std::map<Cell, Failed> failed_;  ///< all cells, including those without failures
};

/// Summary of the values of a study in memory; values of analyzers that failed are left out.
StudySummary summary_of(std::span<const StudyValue> values);

/// Whether results under a key are errors, for which the distance from 0 matters.
bool is_error_key(std::string_view key);

/// Reads a study's table as StudySummary, or its summary as MeanRows; nullopt if it is neither.
/// @param keys results to keep, as KEY or ANALYZER.KEY; empty: all
/// @throws Error(input) for a line that is not a row; Error(usage) for a key that no row has;
/// Error(cancelled)
std::optional<std::variant<std::vector<MeanRow>, StudySummary>> read_study(
    std::string_view bytes, const std::string& source, const RunContext& run,
    std::span<const std::string> keys = {});

/// As read_study(), but reduces a table to its means, without bootstrap intervals.
std::optional<std::vector<MeanRow>> read_means(std::string_view bytes, const std::string& source,
                                               const RunContext& run);

/// Renames the generators: labels[i] is the name of the i-th different generator in `means`.
/// @throws Error(usage) unless there is one label for each generator
void label_generators(std::vector<MeanRow>& means, std::span<const std::string> labels);

// A wide table has a row for each measure, key, dimension and count, and columns for each
// generator: its mean, and the half-width of its t interval. For errors (keys that end with error),
// these are the root mean square and half the width of its interval.

/// The table as CSV or JSONL, with the columns GENERATOR and GENERATOR half_width.
std::string wide_table(std::span<const MeanRow> means, TableStyle style);

/// The table for LaTeX, with cells MEAN +- HALF_WIDTH. Labels that are the same in all rows become
/// comments instead of columns. @param command the user's command line, for another comment
std::string wide_latex(std::span<const MeanRow> means, const std::string& command);

}  // namespace stipple
