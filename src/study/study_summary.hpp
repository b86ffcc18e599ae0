// SPDX-License-Identifier: MIT
//
// What the seeds of a study say together: means with their errors for every generator, and
// generators against each other, pair by pair.
//
// Promise  depends on the rows alone, which come in the order of the study.
// Beware   p-values are corrected over the pairs of generators for one dimension, count, measure
//          and key alone: conclusions from several of these need a further correction.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "study/statistics.hpp"
#include "study/study_table.hpp"

namespace stipple {

/// What the sets of one generator, dimension, count, measure and key have together: a row of a
/// summary. NaN is not known.
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
    double rms = not_known;      ///< the root of the mean of the squares, as of errors
    double rms_low = not_known;  ///< of errors, and where there are values below 0
    double rms_high = not_known;
    double confidence = not_known;  ///< of these intervals
    double t_low = not_known;       ///< of the mean
    double t_high = not_known;
    double bootstrap_low = not_known;
    double bootstrap_high = not_known;
    std::string study = {};
};

struct SummaryOptions {
    bool paired = false;  ///< compare by seed; else Welch's test
    double confidence = 0.95;
    std::uint64_t resamples = 2000;  ///< 0: no bootstrap intervals
    std::uint64_t seed = 1;          ///< of the bootstrap
};

class StudySummary {
  public:
    void add(const StudyRow& row);

    /// One for each generator, dimension, count, measure and key.
    /// @throws Error(cancelled)
    [[nodiscard]] std::vector<MeanRow> mean_rows(const SummaryOptions& options,
                                                 const RunContext& run) const;

    /// The same as a table.
    /// @throws Error(cancelled)
    [[nodiscard]] std::string means(TableStyle style, const SummaryOptions& options,
                                    const RunContext& run) const;

    /// A row for each pair of generators, if there are two that some set of went well. Notifies of
    /// two that have the same values everywhere.
    /// @throws Error(cancelled)
    [[nodiscard]] std::string comparisons(TableStyle style, const SummaryOptions& options,
                                          const RunContext& run) const;

  private:
    /// What is said of one generator under one key.
    struct Sample {
        StudyRow row;  ///< the first one
        std::vector<std::uint64_t> seeds = {};
        std::vector<double> values = {};
    };

    /// Two generators under one key.
    struct Pair {
        const Sample* a = nullptr;
        const Sample* b = nullptr;
        std::size_t sets_a = 0;  ///< that were compared
        std::size_t sets_b = 0;
        MeanTest test = {};
        double p_holm = 1;
    };
    /// What is compared: dimension, count, measure, key.
    using Topic = std::tuple<std::uint64_t, std::uint64_t, std::string, std::string>;
    using Cell = std::tuple<std::string, std::uint64_t, std::uint64_t, std::string>;

    [[nodiscard]] std::vector<Pair> pairs_of(const Topic& topic, bool by_seed) const;

    std::vector<Sample> samples_;  ///< in the order in which they came
    std::map<std::pair<std::string, Topic>, std::size_t> places_;
    std::map<Topic, std::vector<std::size_t>> topics_;
    std::vector<Topic> topics_in_order_;
    struct Failed {
        StudyRow row;
        std::uint64_t sets = 0;
        bool some_went_well = false;
    };
    std::map<Cell, Failed> failed_;  ///< all cells, also those of which nothing failed
};

/// Whether results under a key are errors: what counts is how far they are from 0.
bool is_error_key(std::string_view key);

/// The means of a study's table, without bootstrap intervals, or those of its summary; nothing where
/// the text is neither.
/// @throws Error(input) for a line that is no row; Error(cancelled)
std::optional<std::vector<MeanRow>> read_means(std::string_view bytes, const std::string& source,
                                               const RunContext& run);

}  // namespace stipple
